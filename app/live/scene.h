// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/json.h"
#include "app/live/edit.h"
#include "app/stopwatch.h"
#include "cdt/triangulation.h"
#include "io/planar/map.h"
#include "overlay/overlay.h"

namespace loft::app {

/// What a tab of the page shows, and what can be done with it. A scene lives in one thread at a
/// time; it knows no network.
///
/// Law: a page that has the state() of some time, and all changes since, knows what state() says
/// now.
class Scene {
 public:
  virtual ~Scene() = default;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// All that the page needs to begin.
  [[nodiscard]] virtual Json state() const = 0;
  /// Does what is asked for; what has changed by it. Throws Refusal, or std::invalid_argument where
  /// what follows from it is no usable coordinate: then nothing has changed.
  virtual Json apply(const Edit& edit) = 0;
  /// Throws Refusal: 404 where nothing is known of it.
  [[nodiscard]] virtual Json answer(const Question& question);
  /// An answer that is numbers alone, of 4 bytes, lowest first; none where it is no such question.
  /// All scenes know `edges`, edges_as_bytes().
  [[nodiscard]] virtual std::optional<std::string> bytes(const Question& question);
  /// Lets time pass; what has changed by it, or null.
  virtual Json advance(double) { return nullptr; }

  [[nodiscard]] virtual const cdt::Triangulation& mesh() const = 0;

 protected:
  Scene() = default;

  /// Does an edit, and notes what it cost: `cost` of a change. Between the two nothing but what a
  /// program does that needs no page.
  template <class Do>
  void measure_edit(Do edit) {
    Stopwatch stopwatch;
    edit();
    microseconds_ = 1e6 * stopwatch.lap();
  }
  /// Adds microseconds of the last edit, triangles that it made, and how many there are.
  void add_cost(Json& json) const;

 private:
  double microseconds_ = 0;
};

/// Bounds on what a scene holds, whoever asks for more.
inline constexpr std::size_t most_items = 20'000;

/// x, y, x, y, ...
[[nodiscard]] Json flat(std::span<const cdt::Point> points);
/// From where to where: x, y, x, y of each edge.
[[nodiscard]] Json flat(std::span<const overlay::BorderEdge> edges);
[[nodiscard]] Json as_json(cdt::Point p);
[[nodiscard]] Json as_json(const cdt::Box& box);
/// `{"gone": edges, "come": edges, "area": number}`: what the last edit did to a result.
[[nodiscard]] Json change_of(const overlay::Overlay& overlay, overlay::ResultId result);
/// The same for who knows nothing yet.
[[nodiscard]] Json all_of_result(const overlay::Overlay& overlay, overlay::ResultId result);

/// As 4 bytes, lowest first.
void append_float(std::string& bytes, double number);
/// The edges of a triangulation as such numbers, x, y, x, y of each: how many are free, as an edge
/// of four times that number, the free ones, then the constrained ones.
[[nodiscard]] std::string edges_as_bytes(const cdt::Triangulation& mesh);

/// Something that can be dragged: rings or lines as they were given, and how far they are from
/// there. So nothing is rounded twice.
struct Item {
  std::string name = {};
  std::vector<overlay::Ring> rings = {};
  overlay::Ends ends = overlay::closed;
  overlay::LayerId layer = {};
  cdt::Point at = {};
  std::vector<overlay::RingId> ids = {};
};

/// What is measured at the points of a feature: its property value, z or height; 0 where it has
/// none.
[[nodiscard]] double value_of(const io::Feature& feature);

/// The ring counter-clockwise (1) or clockwise (-1), its first point not repeated: so winding
/// numbers unite what overlaps, and holes stay holes.
[[nodiscard]] overlay::Ring directed(overlay::Ring ring, int turn);
/// Outer ring and holes, directed so.
[[nodiscard]] std::vector<overlay::Ring> directed_rings(const overlay::Polygon& polygon);
[[nodiscard]] overlay::Ring shifted(std::span<const cdt::Point> ring, cdt::Point by);
/// Throws Refusal (422) unless all points of an item are usable at that place.
void require_usable(const Item& item, cdt::Point at);
/// The item to another place, as a part of a batch, or as an edit where it has one ring.
void place(overlay::Overlay& overlay, Item& item, cdt::Point at);

}  // namespace loft::app
