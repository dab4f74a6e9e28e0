// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cdt/ids.h"
#include "paths/cell_grid.h"
#include "paths/free_space.h"
#include "paths/path.h"
#include "paths/shortest.h"
#include "paths/sweep.h"

namespace loft::paths {

struct PathTag {
  static constexpr char prefix = 'p';
};
using PathId = cdt::Id<PathTag>;

/// Whether a kept path should be told of what might be shorter.
enum class Wish { valid, shortest };

/// Paths that are kept while obstacles move: which edit broke which of them is known at once; they
/// are found anew when they are asked for.
///
///     planner.keep({.from = a, .to = b});
///     overlay.move(box, points);         // or a batch: many obstacles and agents, one edit
///     space.follow();
///     for (PathId broken : planner.after_edit()) use(planner.path(broken));
///
/// An agent that has moved on along its path stands at a rounded place, which may be inside an
/// obstacle by as much: nearest_free() is where it can start from again; a disc starts with a
/// radius that is smaller by 2^-40.
///
/// Not for several threads at once.
class Planner {
 public:
  /// The space must outlive this and stay in its place.
  explicit Planner(const FreeSpace& space) : space_(&space), state_(space.state()) {}

  /// From now on a path is kept. It is found when it is asked for. Paths that wish to be `shortest`
  /// are named by after_edit(), too, when something is gone that a shorter path may use.
  PathId keep(const Query& query, Wish wish = Wish::valid);
  /// The same path for another query, as when an agent has moved on.
  void change(PathId path, const Query& query);
  void forget(PathId path);
  [[nodiscard]] bool is_kept(PathId path) const {
    return path.index() < kept_.size() && kept_[path.index()].is_kept;
  }
  [[nodiscard]] const Query& query(PathId path) const { return kept_[path.index()].query; }

  /// The paths, of those that were found, that the last edit broke or, if they wish to be shortest,
  /// may have made needless; sorted. To be asked after each FreeSpace::follow(): if that was left
  /// out once, all paths are looked at. A path of a disc may be named that is as before. Cost: the
  /// paths near to what came, and for those that wish to be shortest, each times what is gone.
  std::span<const PathId> after_edit();
  /// The path, found anew if it was broken or there was none. Precondition: it is kept; the space
  /// is not stale.
  const Path& path(PathId path);

 private:
  static constexpr std::uint32_t start_part = 0xffff'ffff;

  struct Kept {
    Query query;
    Wish wish = Wish::valid;
    Path path;
    std::uint64_t state = 0;  // of the space, when it was found
    bool is_kept = false;
    bool is_known = false;  // `path` is right
    bool is_listed = false;
  };

  void list(std::uint32_t number);
  void unlist(std::uint32_t number);
  template <class Visit>
  static void for_each_part(const Kept& kept, Visit visit);
  void find_near();
  [[nodiscard]] bool is_broken(const Kept& kept);
  [[nodiscard]] bool is_broken(const Kept& kept, std::uint32_t part);
  [[nodiscard]] bool is_way(const Kept& kept, const Piece& piece);
  [[nodiscard]] static bool is_near(const Kept& kept, const Piece& piece, const Side& side);
  [[nodiscard]] static bool may_be_shorter(const Kept& kept, std::span<const Side> gone);

  const FreeSpace* space_;
  std::uint64_t state_;  // the last one that was looked at
  std::vector<Kept> kept_;
  std::vector<std::uint32_t> spare_;
  std::vector<std::uint32_t> shortest_;  // those that wish to be
  CellGrid grid_;
  Workspace workspace_;
  Sweep sweep_;
  cdt::Box came_;
  std::vector<CellGrid::Item> near_;
  std::vector<PathId> broken_;
};

}  // namespace loft::paths
