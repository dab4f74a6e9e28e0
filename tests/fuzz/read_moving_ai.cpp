// SPDX-License-Identifier: MIT
// Grids of cells, scenarios in them: outlines have the area of the free cells, and fit together.
#include <algorithm>

#include "io/planar/moving_ai.h"
#include "mesh/admitted.h"
#include "tests/fuzz/target.h"

namespace {

using namespace loft;

/// Corners of cells, each where the outline turns.
void use(const overlay::Ring& ring, int turn) {
  fuzz::require(ring.size() >= 4, "an outline without an inside");
  fuzz::require(overlay::area(ring).sign() == turn, "an outline in the wrong direction");
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const cdt::Point from = ring[i];
    const cdt::Point to = ring[(i + 1) % ring.size()];
    fuzz::require((from.x == to.x) != (from.y == to.y), "an outline that is not along cells");
    fuzz::require(i % 2 == 0 || (from.x == to.x) == (ring[1].x == ring[2].x),
                  "a corner without a turn");
  }
}

void use(const io::Map& map, std::string_view text) {
  fuzz::require(map.features.size() == 1 && io::property(map.features[0], "layer") == "free",
                "no layer of what is free");
  const overlay::MultiPolygon& polygons = map.features[0].polygons;
  fuzz::require(!polygons.empty(), "nothing is free");
  for (const overlay::Polygon& polygon : polygons) {
    use(polygon.outer, 1);
    for (const overlay::Ring& hole : polygon.holes) use(hole, -1);
  }
  const auto most =
      std::ranges::count_if(text, [](char c) { return c == '.' || c == 'G' || c == 'S'; });
  const double cells = area(polygons).to_double();
  fuzz::require(cells >= 1 && cells <= static_cast<double>(most),
                "another area than that of cells");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string text = fuzz::text_of(bytes, size);
  fuzz::try_to([&] { use(io::read_moving_ai_map(text, "a.map"), text); });
  fuzz::try_to([&] {
    const auto queries = io::read_moving_ai_scenario(text, "a.scen");
    fuzz::require(!queries.empty(), "a scenario without queries");
    for (const io::PathQuery& query : queries)
      for (const double value : {query.from.x, query.from.y, query.to.x, query.to.y})
        fuzz::require(admitted::planar.admits(value),
                      "a coordinate that a triangulation does not take");
  });
  return 0;
}
