// SPDX-License-Identifier: MIT
// Drags an island over a border, step by step, and says after each whom it overlaps: Sicily comes
// to lie on Tunisia and Algeria. island world.geojson island.svg
#include <array>
#include <chrono>
#include <cstdio>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/maps.h"
#include "overlay/faces.h"
#include "overlay/overlay.h"
#include "overlay/query.h"
#include "samples/drawing.h"

namespace {

using loft::cdt::Box;
using loft::overlay::Expression;
using loft::overlay::LayerId;
using loft::overlay::Overlay;
using loft::overlay::Point;
using loft::overlay::ResultId;
using loft::overlay::Ring;
using loft::overlay::RingId;
using samples::Drawing;
using samples::fill;
using samples::stroke;

constexpr Point in_sicily{14, 37.5};
constexpr Point way{-5.4, -1.6};
constexpr int steps = 12;
constexpr Box shown{{4, 31}, {18, 41}};

Box box_around(const Ring& ring) {
  Box box;
  for (const Point p : ring) box.add(p);
  return box;
}

bool is_in(const Box& box, Point p) {
  return box.low.x < p.x && p.x < box.high.x && box.low.y < p.y && p.y < box.high.y;
}

/// Every country is a layer, and the island one of its own.
RingId insert_world(Overlay& overlay, const loft::io::Map& map) {
  const LayerId island = overlay.add_layer("Sicily");
  std::vector<loft::overlay::Shape> shapes;
  std::size_t which = 0;
  for (const loft::io::Feature& feature : map.features) {
    const LayerId country = overlay.add_layer(property(feature, "name").value_or("?"));
    for (const auto& polygon : feature.polygons) {
      const Box box = box_around(polygon.outer);
      const bool is_island = is_in(box, in_sicily) && box.high.x - box.low.x < 5;
      if (is_island) which = shapes.size();
      shapes.push_back({is_island ? island : country, polygon.outer});
      for (const Ring& hole : polygon.holes) shapes.push_back({country, hole});
    }
  }
  if (shapes.empty() || shapes[which].layer != island)
    throw std::runtime_error("there is no Sicily on this map");
  return overlay.insert(shapes)[which];
}

/// The areas that more than one layer claims, by their names.
std::map<std::string, loft::overlay::ExactArea> overlaps(const Overlay& overlay) {
  std::map<std::string, loft::overlay::ExactArea> result;
  for (const loft::overlay::Face& face : faces(overlay)) {
    if (face.layers.size() < 2) continue;
    std::string names;
    for (const LayerId layer : face.layers)
      names += (names.empty() ? "" : " and ") + overlay.name(layer);
    result[names] += area(face.polygon);
  }
  return result;
}

std::vector<Ring> rings_of(const loft::overlay::MultiPolygon& polygons) {
  std::vector<Ring> rings;
  for (const auto& polygon : polygons) {
    rings.push_back(polygon.outer);
    rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
  }
  return rings;
}

/// The part of the map that is shown: the countries, what is claimed twice, and where the island
/// came from.
void draw(Drawing& drawing, Overlay& overlay, const Ring& before) {
  const Ring box{shown.low, {shown.high.x, shown.low.y}, shown.high, {shown.low.x, shown.high.y}};
  const std::vector<LayerId> countries = layers_in(overlay, shown);
  const LayerId frame = overlay.add_layer("frame");
  overlay.insert(frame, box);
  const auto polygons = [&](const Expression& what) {
    return rings_of(overlay.polygons(overlay.watch(what & frame)));
  };
  drawing.turn_to(0);
  drawing.area({box}, fill(loft::io::outside_tone));
  std::vector<Expression> all;
  for (const LayerId layer : countries) {
    const std::size_t hue = all.size() % loft::io::hue_count;
    drawing.area(polygons(layer),
                 fill(loft::io::full_tone(hue)) + stroke(loft::io::dark_tone(hue), 1.2));
    all.emplace_back(layer);
  }
  drawing.area(polygons(at_least(2, all)), fill(loft::io::dark_tone(6)) + "fill-opacity=\"0.75\"");
  drawing.area({before}, stroke(samples::ink_tone, 1.4) + "stroke-dasharray=\"500 400\"");
}

void run(const std::string& in, const std::string& out) {
  using Clock = std::chrono::steady_clock;
  Overlay overlay;
  const RingId island = insert_world(overlay, loft::io::read_map(in));
  const Ring before = overlay.triangulation().points(island);
  std::vector<Expression> all;
  for (std::uint32_t l = 0; l < overlay.layer_count(); ++l) all.emplace_back(LayerId(l));
  const ResultId twice = overlay.watch(at_least(2, all));
  for (int step = 1; step <= steps; ++step) {
    const auto start = Clock::now();
    overlay.translate(island, {way.x / steps, way.y / steps});
    const std::chrono::duration<double, std::micro> took = Clock::now() - start;
    std::printf("step %2d: claimed twice %.9f square degrees, in %zu polygons; %.0f us\n", step,
                overlay.area(twice).to_double(), overlay.polygons(twice).size(), took.count());
  }
  for (const auto& [names, area] : overlaps(overlay))
    std::printf("%s: %.9f square degrees\n", names.c_str(), area.to_double());
  Drawing drawing(out, "Sicily is dragged over a border", {.shown = shown});
  draw(drawing, overlay, before);
  std::array<char, 64> words{};
  std::snprintf(words.data(), words.size(), "claimed twice: %.6f square degrees",
                overlay.area(twice).to_double());
  drawing.caption(words.data());
  drawing.finish();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: island world.geojson island.svg\n");
    return 2;
  }
  try {
    run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
