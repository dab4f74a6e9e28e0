// SPDX-License-Identifier: MIT
#include "reconstruct/reconstruction.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "reconstruct/caps.h"
#include "reconstruct/heights.h"
#include "reconstruct/link_orders.h"
#include "reconstruct/links.h"
#include "reconstruct/live_surface.h"
#include "reconstruct/out_of_core.h"
#include "reconstruct/refine.h"
#include "reconstruct/region.h"
#include "reconstruct/retile.h"
#include "reconstruct/sewing.h"
#include "reconstruct/smooth.h"
#include "reconstruct/tiles.h"

namespace loft {

namespace {

/// A slice of the stack and what has been made of it.
struct Station {
  std::shared_ptr<const Slice> slice;   // null beyond the ends
  std::uint32_t number = Origin::none;  // in order of arrival
  std::shared_ptr<const Region> region;
  std::shared_ptr<const SliceShape> shape;  // where the surface is bent
  std::vector<Defect> repairs;
  Rim rim;
};

using Stations = std::map<double, Station>;

/// A layer of the surface, and where it is in it.
using Faces = std::vector<Surface::FaceHandle>;

/// A slab of the stack: what is in the surface, and what its neighbours look at.
struct LiveSlab {
  std::shared_ptr<const FrozenSlab> frozen;
  std::shared_ptr<const Pieces> found;  // before ends were linked
  std::vector<EndLink> links;
  std::array<std::shared_ptr<const SliceShape>, 4> shapes;  // what it was bent by
  Faces faces;
  Faces bottom;  // of the caps
  Faces top;
  bool is_plain = false;  // sewing has doubled nothing of it
};

using Slabs = std::map<double, LiveSlab>;

/// An edit: what is at a height from then on, if anything.
using Edits = std::vector<std::pair<double, std::optional<Slice>>>;

/// The shortest text that gives the number back.
std::string text(double number) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return {digits.data(), end};
}

InputError no_slice(double z) {
  return InputError("there is no slice at z = " + text(z) +
                    "; insert it, or give the height of one that is there");
}

/// Whether two regions are the same, but for the number of their slice.
bool are_same(const Region& a, const Region& b) {
  const auto is_same_origin = [](const Origin& p, const Origin& q) {
    return p.kind == q.kind && p.contour == q.contour && p.point == q.point;
  };
  return a.points == b.points && a.loop_vertices == b.loop_vertices &&
         a.loop_starts == b.loop_starts && std::ranges::equal(a.origins, b.origins, is_same_origin);
}

}  // namespace

/// Slices by their heights; slabs by the heights they begin at.
class Reconstruction::Stack {
 public:
  explicit Stack(Options options) : options_(std::move(options)), live_(options_.cap == Cap::open) {
    if (options_.simplify || !options_.links.empty())
      throw std::invalid_argument("simplify and links need the whole stack");
  }

  SurfaceChange apply(Edits edits);

  [[nodiscard]] const LiveSurface& live() const { return live_; }
  void collect_garbage();
  [[nodiscard]] std::size_t slab_count() const { return slabs_.size(); }
  [[nodiscard]] double volume() const {
    double sum = 0;
    for (const auto& [z, slab] : slabs_) sum += slab.frozen->volume;
    return sum;
  }
  [[nodiscard]] const Stations& stations() const { return stations_; }
  [[nodiscard]] Snapshot snapshot() const;
  [[nodiscard]] std::vector<SlabInfo> slabs() const;
  [[nodiscard]] std::vector<Defect> repairs() const;

 private:
  class Edit;

  /// The slices between which the surface is, the first and the last one that are not empty; none
  /// if there are not two such.
  using Range = std::pair<Stations::iterator, Stations::iterator>;
  [[nodiscard]] std::optional<Range> range();

  Options options_;
  Stations stations_;
  Slabs slabs_;
  std::optional<std::pair<double, double>> ends_;  // the heights between which there are slabs
  Station below_;                                  // for domes
  Station above_;
  LiveSurface live_;
  std::uint32_t next_number_ = 0;
  std::uint32_t next_id_ = 0;
  cdt::Triangulation memory_;
  TileWorkspace workspace_;
};

Reconstruction::Reconstruction(Options options)
    : stack_(std::make_unique<Stack>(std::move(options))) {}
Reconstruction::~Reconstruction() = default;
Reconstruction::Reconstruction(Reconstruction&&) noexcept = default;
Reconstruction& Reconstruction::operator=(Reconstruction&&) noexcept = default;

SurfaceChange Reconstruction::insert(Slice slice) {
  const double z = slice.z;
  if (const Slice* there = find(z)) {
    Slice both = *there;
    both.contours.insert(both.contours.end(), std::make_move_iterator(slice.contours.begin()),
                         std::make_move_iterator(slice.contours.end()));
    slice = std::move(both);
  }
  return stack_->apply({{z, std::move(slice)}});
}

SurfaceChange Reconstruction::replace(double z, Slice slice) {
  if (find(z) == nullptr) throw no_slice(z);
  if (slice.z == z) return stack_->apply({{z, std::move(slice)}});
  if (find(slice.z) != nullptr)
    throw InputError("there is a slice at z = " + text(slice.z) +
                     " already; remove it first, or replace it");
  const double new_z = slice.z;
  return stack_->apply({{z, std::nullopt}, {new_z, std::move(slice)}});
}

SurfaceChange Reconstruction::replace(std::vector<Slice> slices) {
  Edits edits;
  for (Slice& slice : slices) {
    if (find(slice.z) == nullptr) throw no_slice(slice.z);
    edits.emplace_back(slice.z, std::move(slice));
  }
  std::ranges::sort(edits, {}, [](const auto& edit) { return edit.first; });
  const auto twice = std::ranges::adjacent_find(
      edits, [](const auto& a, const auto& b) { return a.first == b.first; });
  if (twice != edits.end())
    throw InputError("two slices for z = " + text(twice->first) + "; each height has one");
  if (edits.empty()) return {};
  return stack_->apply(std::move(edits));
}

SurfaceChange Reconstruction::remove(double z) {
  if (find(z) == nullptr) throw no_slice(z);
  return stack_->apply({{z, std::nullopt}});
}

SurfaceChange Reconstruction::move_contour(double z, std::size_t contour,
                                           std::vector<cdt::Point> points) {
  const Slice* there = find(z);
  if (there == nullptr) throw no_slice(z);
  if (contour >= there->contours.size())
    throw InputError("the slice at z = " + text(z) + " has no contour " + std::to_string(contour));
  Slice slice = *there;
  slice.contours[contour].points = std::move(points);
  return stack_->apply({{z, std::move(slice)}});
}

const Surface& Reconstruction::surface() const { return stack_->live().surface(); }
std::size_t Reconstruction::vertex_count() const { return stack_->live().vertex_count(); }
std::size_t Reconstruction::face_count() const { return stack_->live().face_count(); }
double Reconstruction::volume() const { return stack_->volume(); }
void Reconstruction::collect_garbage() { stack_->collect_garbage(); }
std::size_t Reconstruction::slice_count() const { return stack_->stations().size(); }

const Slice* Reconstruction::find(double z) const {
  const auto found = stack_->stations().find(z);
  return found == stack_->stations().end() ? nullptr : found->second.slice.get();
}

std::vector<Slice> Reconstruction::slices() const {
  std::vector<Slice> all;
  for (const auto& [z, station] : stack_->stations()) all.push_back(*station.slice);
  return all;
}

std::size_t Reconstruction::slab_count() const { return stack_->slab_count(); }
std::vector<SlabInfo> Reconstruction::slabs() const { return stack_->slabs(); }
std::vector<Defect> Reconstruction::repairs() const { return stack_->repairs(); }
Snapshot Reconstruction::snapshot() const { return stack_->snapshot(); }

std::optional<Reconstruction::Stack::Range> Reconstruction::Stack::range() {
  const auto is_filled = [](const auto& station) { return !station.second.region->is_empty(); };
  const auto first = std::ranges::find_if(stations_, is_filled);
  if (first == stations_.end()) return {};
  auto last = std::prev(stations_.end());
  while (!is_filled(*last)) --last;
  if (first == last) return {};
  return Range{first, last};
}

/// One edit on its way: what it makes is made first, then taken over.
class Reconstruction::Stack::Edit {
 public:
  Edit(Stack& stack, Edits edits) : stack_(stack), edits_(std::move(edits)) {}

  SurfaceChange run() {
    prepare();
    try {
      exchange_slices();
      if (!is_quiet_) {
        list_gaps();
        for (std::size_t i = 0; i < gaps_.size(); ++i) tile(gaps_[i]);
        for (std::size_t i = 0; i < gaps_.size(); ++i) link(i);
        for (std::size_t i = 0; i < gaps_.size(); ++i) bend(i);
        for (Gap& gap : gaps_) freeze(gap);
      }
    } catch (...) {
      take_back();
      throw;
    }
    if (!is_quiet_) take_over();
    return std::move(change_);
  }

 private:
  /// A slab that is to be: between two slices that follow each other in the surface.
  struct Gap {
    Station* lower;
    Station* upper;
    bool is_first;  // of the stack
    bool is_last;
    LiveSlab* there = nullptr;       // where it is there already
    std::optional<LiveSlab> made{};  // where it is not, or changes
    LiveSlab* before = nullptr;      // of which it keeps some tiles
    std::vector<std::uint32_t> kept{};
    std::vector<std::uint32_t> dropped{};
    std::optional<TileSet> tiles{};  // before ends are linked, and after
    std::optional<Pieces> pieces{};
    bool keeps_tiles = false;  // only its caps change

    [[nodiscard]] const std::shared_ptr<const Pieces>& found() const {
      return made ? made->found : there->found;
    }
    [[nodiscard]] double height() const { return upper->region->z - lower->region->z; }
  };

  // --- Slices ---

  void prepare() {
    std::vector<Defect> fatal;
    for (const auto& [z, slice] : edits_) {
      if (!slice) continue;
      std::ranges::move(find_unusable(*slice, stack_.next_number_), std::back_inserter(fatal));
      check_gap(z, fatal);
    }
    if (!fatal.empty()) throw InputError(std::move(fatal));
    for (auto& [z, slice] : edits_) {
      if (!slice) {
        is_quiet_ = false;
        stations_.emplace_back();
        continue;
      }
      stations_.push_back(make_station(z, std::move(*slice)));
    }
  }

  [[nodiscard]] bool goes(double z) const {
    return std::ranges::any_of(edits_,
                               [&](const auto& edit) { return edit.first == z && !edit.second; });
  }

  void check_gap(double z, std::vector<Defect>& fatal) const {
    const auto note = [&](double other) {
      fatal.push_back({DefectKind::slices_too_near,
                       z,
                       stack_.next_number_,
                       {},
                       {},
                       {},
                       0,
                       "is nearer to the slice at z = " + text(other) +
                           " than rounding allows at that height; give heights from an origin "
                           "nearby, or replace that slice"});
    };
    const auto above = stack_.stations_.upper_bound(z);
    if (above != stack_.stations_.end() && !goes(above->first) && are_too_near(z, above->first))
      note(above->first);
    const auto at = stack_.stations_.lower_bound(z);
    if (at == stack_.stations_.begin()) return;
    const double below = std::prev(at)->first;
    if (!goes(below) && are_too_near(below, z)) note(below);
  }

  [[nodiscard]] Station make_station(double z, Slice slice) {
    Station station;
    station.slice = std::make_shared<const Slice>(std::move(slice));
    const auto there = stack_.stations_.find(z);
    const bool is_known = there != stack_.stations_.end();
    station.number = is_known ? there->second.number : stack_.next_number_;
    const Slice* part = station.slice.get();
    station.region =
        std::make_shared<const Region>(clean(Height{z, {station.number}}, std::span(&part, 1),
                                             stack_.options_, station.repairs, stack_.memory_));
    std::ranges::copy(station.repairs, std::back_inserter(change_.repairs));
    if (is_known && are_same(*there->second.region, *station.region)) {
      station.region = there->second.region;
      station.shape = there->second.shape;
      station.rim = there->second.rim;
      return station;
    }
    is_quiet_ = false;
    if (!is_known) ++stack_.next_number_;
    add_shape(station);
    station.rim.edges.resize(station.region->loop_vertices.size());
    return station;
  }

  void add_shape(Station& station) const {
    if (stack_.options_.smooth) station.shape = std::make_shared<const SliceShape>(*station.region);
  }

  void exchange_slices() {
    old_below_ = stack_.below_;
    old_above_ = stack_.above_;
    old_.reserve(edits_.size());
    for (std::size_t i = 0; i < edits_.size(); ++i) {
      const double z = edits_[i].first;
      old_.push_back(stack_.stations_.extract(z));
      if (stations_[i].slice != nullptr) stack_.stations_.emplace(z, std::move(stations_[i]));
    }
  }

  void take_back() {
    for (std::size_t i = 0; i < old_.size(); ++i) stack_.stations_.erase(edits_[i].first);
    for (auto& node : old_)
      if (!node.empty()) stack_.stations_.insert(std::move(node));
    stack_.below_ = std::move(old_below_);
    stack_.above_ = std::move(old_above_);
  }

  // --- What there is to be made ---

  /// The slabs near the edit, as they are to be; those that are there and are not among them go.
  void list_gaps() {
    const auto range = stack_.range();
    if (!range) {
      for (auto& [z, slab] : stack_.slabs_) gone_.push_back(z);
      return;
    }
    auto [first, last] = *range;
    double low = edits_.front().first;
    double high = low;
    const auto widen = [&](double z) {
      low = std::min(low, z);
      high = std::max(high, z);
    };
    for (const auto& [z, slice] : edits_) widen(z);
    if (stack_.ends_) {
      if (stack_.ends_->first != first->first) widen(std::min(stack_.ends_->first, first->first));
      if (stack_.ends_->first != first->first) widen(std::max(stack_.ends_->first, first->first));
      if (stack_.ends_->second != last->first) widen(std::min(stack_.ends_->second, last->first));
      if (stack_.ends_->second != last->first) widen(std::max(stack_.ends_->second, last->first));
    } else {
      widen(first->first);
      widen(last->first);
    }
    ends_ = {first->first, last->first};

    constexpr int reach = 6;  // slices on either side that may matter
    auto from = stack_.stations_.lower_bound(std::clamp(low, first->first, last->first));
    const auto is_irregular = [](const auto& at) { return !at->second.rim.is_regular; };
    for (int i = 0; (i < reach || is_irregular(from)) && from != first; ++i) --from;
    auto to = stack_.stations_.upper_bound(std::clamp(high, first->first, last->first));
    if (to != stack_.stations_.begin()) --to;
    for (int i = 0; (i < reach || is_irregular(to)) && to != last; ++i) ++to;
    const bool is_bottom = from == first;
    const bool is_top = to == last;

    if (stack_.options_.cap == Cap::dome) round_off(first, last);
    if (stack_.options_.cap == Cap::dome && is_bottom) line_.push_back(&stack_.below_);
    for (auto station = from;; ++station) {
      line_.push_back(&station->second);
      if (station == to) break;
    }
    if (stack_.options_.cap == Cap::dome && is_top) line_.push_back(&stack_.above_);
    for (std::size_t i = 0; i + 1 < line_.size(); ++i)
      gaps_.push_back(
          {line_[i], line_[i + 1], is_bottom && i == 0, is_top && i + 2 == line_.size()});
    find_present(is_bottom, is_top);
  }

  /// What is beyond the ends, for domes.
  void round_off(Stations::iterator first, Stations::iterator last) {
    const auto update = [&](Station& station, const Region& end, const Region& before) {
      Region region = beyond(end, before);
      if (station.region != nullptr && station.region->z == region.z) return;
      station = {};
      station.region = std::make_shared<const Region>(std::move(region));
      add_shape(station);
    };
    update(stack_.below_, *first->second.region, *std::next(first)->second.region);
    update(stack_.above_, *last->second.region, *std::prev(last)->second.region);
  }

  void find_present(bool is_bottom, bool is_top) {
    const double low = line_.front()->region->z;
    const double high = line_.back()->region->z;
    auto slab = is_bottom ? stack_.slabs_.begin() : stack_.slabs_.lower_bound(low);
    for (; slab != stack_.slabs_.end() && (is_top || slab->first < high); ++slab) {
      auto& [z, there] = *slab;
      const auto gap = std::ranges::lower_bound(
          gaps_, z, {}, [](const Gap& one) { return one.lower->region->z; });
      if (gap == gaps_.end() || gap->lower->region != there.frozen->lower ||
          gap->upper->region != there.frozen->upper) {
        gone_.push_back(z);
      } else {
        gap->there = &there;
      }
    }
  }

  // --- Making it ---

  void tile(Gap& gap) {
    if (gap.there != nullptr) return;
    gap.made.emplace();
    if (!tile_in_part(gap)) tile_by_overlap(gap);
    gap.made->found = std::make_shared<const Pieces>(*gap.pieces);
  }

  /// Where the slab was there, but for some loops of one of its slices.
  bool tile_in_part(Gap& gap) {
    const Options& options = stack_.options_;
    if (options.smooth || options.max_edge || options.target_edge || gap.is_first || gap.is_last)
      return false;
    const auto found = stack_.slabs_.find(gap.lower->region->z);
    if (found == stack_.slabs_.end()) return false;
    LiveSlab& before = found->second;
    const FrozenSlab& old = *before.frozen;
    const bool is_lower_same = old.lower == gap.lower->region;
    if (old.info.high != gap.upper->region->z || !before.is_plain || !before.links.empty() ||
        old.has_bottom_cap || old.has_top_cap || is_lower_same == (old.upper == gap.upper->region))
      return false;
    const Station& changed = is_lower_same ? *gap.upper : *gap.lower;
    const auto& matches = match(changed, is_lower_same ? *old.upper : *old.lower);
    auto retiled =
        retile({*old.lower, *old.upper, *old.tiles, *old.pieces, *gap.lower->region,
                *gap.upper->region, is_lower_same ? Level::upper : Level::lower, matches},
               options, stack_.workspace_);
    if (!retiled) return false;
    gap.before = &before;
    gap.kept = std::move(retiled->kept);
    gap.dropped = std::move(retiled->gone);
    gap.tiles = std::move(retiled->tiles);
    gap.pieces = std::move(retiled->pieces);
    return true;
  }

  /// The loops of a slice that it had before. Its edges there stay, as long as a face is at them.
  const std::vector<std::uint32_t>& match(const Station& station, const Region& old) {
    const auto [found, is_new] = matches_.try_emplace(station.region->z);
    if (is_new) found->second = match_loops(*station.region, old);
    return found->second;
  }

  void tile_by_overlap(Gap& gap) {
    gap.before = nullptr;
    OrderedTiles tiled = tile_by_orders(*gap.lower->region, *gap.upper->region, stack_.options_, {},
                                        stack_.workspace_);
    gap.tiles = std::move(tiled.tiles);
    gap.pieces = std::move(tiled.pieces);
  }

  /// Whether all that a slab looks at is known: its neighbours, if it has any.
  [[nodiscard]] bool has_neighbours(std::size_t i) const {
    return (i > 0 || gaps_[i].is_first) && (i + 1 < gaps_.size() || gaps_[i].is_last);
  }

  [[nodiscard]] SlabPieces view(std::size_t i) const {
    if (i >= gaps_.size()) return {};
    return {gaps_[i].found().get(), gaps_[i].height()};
  }

  void link(std::size_t i) {
    Gap& gap = gaps_[i];
    if (!has_neighbours(i)) return;
    std::vector<EndLink> links;
    if (stack_.options_.link == LinkRule::automatic)
      links = match_ends(i == 0 ? SlabPieces() : view(i - 1), view(i), view(i + 1),
                         stack_.options_.max_shift, {});
    if (gap.there != nullptr) {
      if (links == gap.there->links) return;
      gap.made.emplace();
      gap.made->found = gap.there->found;
      tile_by_overlap(gap);
    } else if (gap.before != nullptr && !links.empty()) {
      tile_by_overlap(gap);  // the pieces are the same, and in the same order
    }
    link_ends(*gap.lower->region, *gap.upper->region, *gap.tiles, *gap.pieces, links);
    gap.made->links = std::move(links);
  }

  using Shapes = std::array<std::shared_ptr<const SliceShape>, 4>;

  [[nodiscard]] Shapes shapes_around(std::size_t i) const {
    Shapes shapes;
    for (std::size_t k = 0; k < shapes.size(); ++k)
      if (i + k >= 1 && i + k - 1 < line_.size()) shapes[k] = line_[i + k - 1]->shape;
    return shapes;
  }

  /// Brings the tiles of a slab into their final shape.
  void bend(std::size_t i) {
    Gap& gap = gaps_[i];
    const Options& options = stack_.options_;
    const Shapes shapes = shapes_around(i);
    if (!gap.made) {
      if (!options.smooth || !has_neighbours(i) || shapes == gap.there->shapes) return;
      gap.made.emplace();
      gap.made->found = gap.there->found;
      gap.made->links = gap.there->links;
    }
    const bool is_tiled = gap.tiles.has_value();
    auto linked = is_tiled ? std::make_shared<const TileSet>(std::move(*gap.tiles))
                           : gap.there->frozen->linked;
    auto pieces = is_tiled ? std::make_shared<const Pieces>(std::move(*gap.pieces))
                           : gap.there->frozen->pieces;
    if (gap.made->found != nullptr && is_tiled && gap.made->links.empty())
      pieces = gap.made->found;  // the same
    auto tiles = linked;
    const Region& lower = *gap.lower->region;
    const Region& upper = *gap.upper->region;
    if (options.smooth) {
      Surroundings around{};
      for (std::size_t k = 0; k < around.size(); ++k) around[k] = shapes[k].get();
      tiles = std::make_shared<const TileSet>(smooth(lower, upper, around, *pieces, *linked));
    }
    if (options.max_edge || options.target_edge)
      tiles = std::make_shared<const TileSet>(refine(lower, upper, *tiles, options));
    gap.made->shapes = shapes;
    FrozenSlab frozen{{0, lower.z, upper.z}, gap.lower->region, gap.upper->region};
    frozen.volume = loft::volume(lower, upper, *tiles);
    frozen.tiles = std::move(tiles);
    frozen.linked = std::move(linked);
    frozen.pieces = std::move(pieces);
    gap.made->frozen = std::make_shared<const FrozenSlab>(std::move(frozen));
  }

  /// Gives a slab that is new or changed its number.
  void freeze(Gap& gap) {
    const bool is_capped = stack_.options_.cap == Cap::flat;
    const bool has_bottom = is_capped && gap.is_first;
    const bool has_top = is_capped && gap.is_last;
    if (!gap.made) {
      const FrozenSlab& there = *gap.there->frozen;
      if (there.has_bottom_cap == has_bottom && there.has_top_cap == has_top) return;
      gap.keeps_tiles = true;
      gap.made.emplace();
      gap.made->frozen = gap.there->frozen;
      gap.made->found = gap.there->found;
      gap.made->links = gap.there->links;
      gap.made->shapes = gap.there->shapes;
      gap.made->is_plain = gap.there->is_plain;
    }
    auto frozen = std::make_shared<FrozenSlab>(*gap.made->frozen);
    frozen->info.id = stack_.next_id_++;
    frozen->has_bottom_cap = has_bottom;
    frozen->has_top_cap = has_top;
    if (!frozen->tiles->is_linked)
      change_.repairs.push_back(unlinked_slices(*frozen->lower, *frozen->upper));
    change_.added.push_back(frozen->info);
    gap.made->frozen = std::move(frozen);
  }

  // --- Taking it over ---

  /// A layer of the surface as it is to be, from low to high.
  struct Unit {
    Gap* gap;
    enum class Kind { bottom_cap, slab, top_cap } kind;
    bool is_new;
    Faces* faces;  // where they are kept
  };

  void take_over() {
    keep_rims();
    for (const double z : gone_) let_go(stack_.slabs_.find(z)->second);
    for (Gap& gap : gaps_) list_units(gap);
    for (std::size_t i = 0; i < units_.size();) {
      std::size_t end = i;
      while (end < units_.size() && units_[end].is_new) ++end;
      if (end > i) splice(i, end);
      i = std::max(end, i + 1);
    }
    if (!removed_.empty())
      add(stack_.live_.splice(
          {.layers = {}, .removed = std::move(removed_), .rims = std::move(rims_)}));

    for (const double z : gone_) stack_.slabs_.erase(z);
    for (Gap& gap : gaps_)
      if (gap.made) stack_.slabs_[gap.lower->region->z] = std::move(*gap.made);
    stack_.ends_ = ends_;
    std::ranges::sort(change_.removed);
  }

  void let_go(const LiveSlab& slab) {
    change_.removed.push_back(slab.frozen->info.id);
    for (const double z : {slab.frozen->info.low, slab.frozen->info.high}) {
      const auto station = stack_.stations_.find(z);
      if (station != stack_.stations_.end()) rims_.push_back(&station->second.rim);
    }
    for (const Faces* faces : {&slab.bottom, &slab.faces, &slab.top})
      if (faces != &slab.faces || !is_kept_in_part(slab))
        removed_.insert(removed_.end(), faces->begin(), faces->end());
  }

  [[nodiscard]] bool is_kept_in_part(const LiveSlab& slab) const {
    return std::ranges::any_of(gaps_, [&](const Gap& gap) { return gap.before == &slab; });
  }

  /// The edges of contours that a new slice has from the one before, as far as faces stay there.
  void keep_rims() {
    for (std::size_t i = 0; i < edits_.size(); ++i) {
      const auto matched = matches_.find(edits_[i].first);
      if (matched == matches_.end() || old_[i].empty()) continue;
      const Station& old = old_[i].mapped();
      Station& now = stack_.stations_.find(edits_[i].first)->second;
      for (std::uint32_t l = 0; l < matched->second.size(); ++l) {
        if (matched->second[l] == Origin::none) continue;
        const auto from = old.rim.edges.begin() + old.region->loop_starts[matched->second[l]];
        std::copy_n(from, now.region->loop(l).size(),
                    now.rim.edges.begin() + now.region->loop_starts[l]);
      }
      rims_.push_back(&now.rim);
    }
  }

  void list_units(Gap& gap) {
    LiveSlab* const there = gap.there;
    LiveSlab& slab = gap.made ? *gap.made : *there;
    if (gap.made && there != nullptr) {
      change_.removed.push_back(there->frozen->info.id);
      rims_.insert(rims_.end(), {&gap.lower->rim, &gap.upper->rim});
      for (auto faces : {&LiveSlab::bottom, &LiveSlab::faces, &LiveSlab::top}) {
        const bool is_kept = faces == &LiveSlab::faces    ? gap.keeps_tiles
                             : faces == &LiveSlab::bottom ? slab.frozen->has_bottom_cap
                                                          : slab.frozen->has_top_cap;
        if (is_kept) {
          slab.*faces = there->*faces;
        } else {
          removed_.insert(removed_.end(), (there->*faces).begin(), (there->*faces).end());
        }
      }
      if (gap.keeps_tiles) stack_.live_.set_slab(slab.faces, slab.frozen->info.id);
      stack_.live_.set_slab(slab.bottom, slab.frozen->info.id);
      stack_.live_.set_slab(slab.top, slab.frozen->info.id);
    }
    if (gap.before != nullptr) {
      for (const std::uint32_t tile : gap.kept) slab.faces.push_back(gap.before->faces[tile]);
      for (const std::uint32_t tile : gap.dropped) removed_.push_back(gap.before->faces[tile]);
      stack_.live_.set_slab(slab.faces, slab.frozen->info.id);
    }
    if (slab.frozen->has_bottom_cap)
      units_.push_back({&gap, Unit::Kind::bottom_cap, slab.bottom.empty(), &slab.bottom});
    units_.push_back({&gap, Unit::Kind::slab, gap.made && !gap.keeps_tiles, &slab.faces});
    if (slab.frozen->has_top_cap)
      units_.push_back({&gap, Unit::Kind::top_cap, slab.top.empty(), &slab.top});
  }

  [[nodiscard]] static const FrozenSlab& frozen(const Unit& unit) {
    return *(unit.gap->made ? *unit.gap->made : *unit.gap->there).frozen;
  }

  [[nodiscard]] static Layer layer(const Unit& unit) {
    const FrozenSlab& slab = frozen(unit);
    if (unit.kind == Unit::Kind::bottom_cap) {
      Layer cap = bottom_cap(*slab.lower);
      cap.slab = slab.info.id;
      return cap;
    }
    if (unit.kind == Unit::Kind::top_cap)
      return top_cap(*slab.upper, slab.info.id, slab.lower->slice);
    Layer layer{slab.lower.get(), slab.upper.get(), {}, slab.info.id, slab.lower->slice};
    layer.tiles.inner = slab.tiles->inner;
    const bool is_partial = unit.is_new && unit.gap->before != nullptr;
    const std::size_t kept = is_partial ? unit.gap->kept.size() : 0;
    layer.tiles.tiles.assign(slab.tiles->tiles.begin() + static_cast<std::ptrdiff_t>(kept),
                             slab.tiles->tiles.end());
    return layer;
  }

  [[nodiscard]] static RimmedSlice below(const Unit& unit) {
    if (unit.kind == Unit::Kind::bottom_cap) return {};
    Station& station = unit.kind == Unit::Kind::slab ? *unit.gap->lower : *unit.gap->upper;
    return {station.region.get(), &station.rim};
  }
  [[nodiscard]] static RimmedSlice above(const Unit& unit) {
    if (unit.kind == Unit::Kind::top_cap) return {};
    Station& station = unit.kind == Unit::Kind::slab ? *unit.gap->upper : *unit.gap->lower;
    return {station.region.get(), &station.rim};
  }

  /// Whether there are places in a slice where its contours touch.
  [[nodiscard]] static bool is_touching(const RimmedSlice& slice) {
    return slice.region != nullptr && !is_simple(*slice.region);
  }
  [[nodiscard]] bool touches_below(std::size_t unit) const {
    return unit > 0 && is_touching(below(units_[unit]));
  }
  [[nodiscard]] bool touches_above(std::size_t unit) const {
    return unit + 1 < units_.size() && is_touching(above(units_[unit]));
  }

  /// Puts the new units from `begin` to `end` into the surface, with as many beside them as have to
  /// be sewn with them: where contours of a slice touch, so may the layers below and above it.
  void splice(std::size_t begin, std::size_t end) {
    std::size_t first = begin - (touches_below(begin) ? 1 : 0);
    std::size_t last = end + (touches_above(end - 1) ? 1 : 0);
    for (;;) {
      while (first > 0 && !below(units_[first]).rim->is_regular) --first;
      while (last < units_.size() && !above(units_[last - 1]).rim->is_regular) ++last;
      const Spliced spliced = stack_.live_.splice(make_splice(begin, end, first, last));
      if ((spliced.needs_below || spliced.needs_above) && make_whole(begin, end)) continue;
      if (spliced.needs_below) --first;
      if (spliced.needs_above) ++last;
      if (spliced.needs_below || spliced.needs_above) continue;
      for (std::size_t i = first; i < last; ++i) {
        Faces& faces = *units_[i].faces;
        if (units_[i].gap->before == nullptr || !units_[i].is_new) faces.clear();
        faces.insert(faces.end(), spliced.faces[i - first].begin(), spliced.faces[i - first].end());
        Gap& gap = *units_[i].gap;
        (gap.made ? *gap.made : *gap.there).is_plain = spliced.is_plain;
        units_[i].is_new = false;
      }
      add(spliced);
      removed_.clear();
      rims_.clear();
      return;
    }
  }

  /// Gives up that slabs keep some of their tiles. Whether any did.
  bool make_whole(std::size_t begin, std::size_t end) {
    bool has_any = false;
    for (std::size_t i = begin; i < end; ++i) {
      Gap& gap = *units_[i].gap;
      if (gap.before == nullptr) continue;
      removed_.insert(removed_.end(), units_[i].faces->begin(), units_[i].faces->end());
      units_[i].faces->clear();
      gap.before = nullptr;
      has_any = true;
    }
    return has_any;
  }

  [[nodiscard]] Splice make_splice(std::size_t begin, std::size_t end, std::size_t first,
                                   std::size_t last) const {
    Splice splice;
    const std::size_t context_begin = first - (touches_below(first) ? 1 : 0);
    const std::size_t context_end = last + (touches_above(last - 1) ? 1 : 0);
    for (std::size_t i = context_begin; i < context_end; ++i)
      splice.layers.push_back(layer(units_[i]));
    splice.first = first - context_begin;
    splice.last = last - context_begin;
    splice.is_partial =
        std::any_of(units_.begin() + static_cast<std::ptrdiff_t>(first),
                    units_.begin() + static_cast<std::ptrdiff_t>(last),
                    [](const Unit& unit) { return unit.is_new && unit.gap->before != nullptr; });
    splice.has_below = first > 0;
    splice.has_above = last < units_.size();
    splice.removed = removed_;
    splice.rims = rims_;
    for (std::size_t i = first; i < last; ++i) {
      splice.slices.push_back(below(units_[i]));
      const Faces* present = i < begin || i >= end ? units_[i].faces : nullptr;
      splice.present.push_back(present);
      if (present != nullptr)
        splice.removed.insert(splice.removed.end(), present->begin(), present->end());
    }
    splice.slices.push_back(above(units_[last - 1]));
    return splice;
  }

  void add(const Spliced& spliced) {
    change_.vertices_added += spliced.vertices_added;
    change_.vertices_removed += spliced.vertices_removed;
    change_.faces_added += spliced.faces_added;
    change_.faces_removed += spliced.faces_removed;
    if (!spliced.bounds) return;
    change_.bounds = change_.bounds ? joined(*change_.bounds, *spliced.bounds) : *spliced.bounds;
  }

  Stack& stack_;
  Edits edits_;
  bool is_quiet_ = true;  // no region changes
  std::vector<Station> stations_;
  std::vector<Stations::node_type> old_;
  Station old_below_;
  Station old_above_;
  std::optional<std::pair<double, double>> ends_;
  std::vector<Station*> line_;                            // the slices near the edit
  std::vector<Gap> gaps_;                                 // between them
  std::vector<double> gone_;                              // where slabs begin that go
  std::map<double, std::vector<std::uint32_t>> matches_;  // loops that slices had before
  std::vector<Unit> units_;
  Faces removed_;
  std::vector<Rim*> rims_;  // of the slices at the faces that go
  SurfaceChange change_;
};

SurfaceChange Reconstruction::Stack::apply(Edits edits) {
  return Edit(*this, std::move(edits)).run();
}

void Reconstruction::Stack::collect_garbage() {
  std::vector<Faces*> faces;
  std::vector<Rim*> rims;
  for (auto& [z, slab] : slabs_)
    for (Faces* some : {&slab.bottom, &slab.faces, &slab.top}) faces.push_back(some);
  for (auto& [z, station] : stations_) rims.push_back(&station.rim);
  live_.collect_garbage(faces, rims);
}

Snapshot Reconstruction::Stack::snapshot() const {
  std::vector<std::shared_ptr<const FrozenSlab>> slabs;
  for (const auto& [z, slab] : slabs_) slabs.push_back(slab.frozen);
  std::vector<std::shared_ptr<const Slice>> slices;
  std::vector<std::uint32_t> numbers;
  for (const auto& [z, station] : stations_) {
    slices.push_back(station.slice);
    numbers.push_back(station.number);
  }
  return {std::move(slabs), std::move(slices), numbers, options_.cap};
}

std::vector<SlabInfo> Reconstruction::Stack::slabs() const {
  std::vector<SlabInfo> all;
  for (const auto& [z, slab] : slabs_) all.push_back(slab.frozen->info);
  return all;
}

std::vector<Defect> Reconstruction::Stack::repairs() const {
  std::vector<Defect> all;
  std::uint32_t rank = 0;
  for (const auto& [z, station] : stations_) {
    for (Defect repair : station.repairs) {
      repair.slice = rank;
      all.push_back(std::move(repair));
    }
    ++rank;
  }
  return all;
}

}  // namespace loft
