// SPDX-License-Identifier: MIT
#include "app/live/scene.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace loft::app {

namespace {

using cdt::EdgeId;
using cdt::Point;
using cdt::Triangulation;
using overlay::Overlay;

std::optional<double> number_of(const io::Feature& feature, const char* key) {
  const auto text = io::property(feature, key);
  if (!text) return {};
  double value = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error != std::errc() || end != text->data() + text->size() || !std::isfinite(value))
    return {};
  return value;
}

void append_edge(std::string& bytes, Point a, Point b) {
  for (const double number : {a.x, a.y, b.x, b.y}) append_float(bytes, number);
}

/// Each edge between finite vertices, once.
template <class Visit>
void visit_edges(const Triangulation& mesh, Visit visit) {
  for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
    const EdgeId e(i);
    if (!mesh.is_triangle(Triangulation::triangle(e)) || mesh.twin(e) < e) continue;
    if (mesh.from(e) != Triangulation::infinite && mesh.to(e) != Triangulation::infinite) visit(e);
  }
}

Json result_as_json(const Overlay& overlay, overlay::ResultId result,
                    std::span<const overlay::BorderEdge> come) {
  return {{"come", flat(come)}, {"area", overlay.area(result).to_double()}};
}

}  // namespace

Json Scene::answer(const Question& question) {
  throw Refusal(404, "nothing is known here of " + question.what);
}

std::optional<std::string> Scene::bytes(const Question& question) {
  if (question.what != "edges") return {};
  return edges_as_bytes(mesh());
}

void Scene::add_cost(Json& json) const {
  json["microseconds"] = microseconds_;
  json["made"] = mesh().changes().made.size();
  json["triangles"] = mesh().triangle_count();
  json["vertices"] = mesh().vertex_count();
}

Json flat(std::span<const Point> points) {
  Json::array_t numbers;
  numbers.reserve(2 * points.size());
  for (const Point& p : points) {
    numbers.emplace_back(p.x);
    numbers.emplace_back(p.y);
  }
  return numbers;
}

Json flat(std::span<const overlay::BorderEdge> edges) {
  Json::array_t numbers;
  numbers.reserve(4 * edges.size());
  for (const overlay::BorderEdge& edge : edges)
    for (const double number : {edge.from.x, edge.from.y, edge.to.x, edge.to.y})
      numbers.emplace_back(number);
  return numbers;
}

Json as_json(Point p) { return Json::array({p.x, p.y}); }

Json as_json(const cdt::Box& box) {
  return Json::array({box.low.x, box.low.y, box.high.x, box.high.y});
}

Json change_of(const Overlay& overlay, overlay::ResultId result) {
  const overlay::ResultChange& change = overlay.change(result);
  Json json = result_as_json(overlay, result, change.come);
  json["gone"] = flat(change.gone);
  return json;
}

Json all_of_result(const Overlay& overlay, overlay::ResultId result) {
  return result_as_json(overlay, result, overlay.border(result));
}

void append_float(std::string& bytes, double number) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(number));
  for (unsigned shift = 0; shift < 32; shift += 8)
    bytes += static_cast<char>(static_cast<unsigned char>(bits >> shift));
}

std::string edges_as_bytes(const Triangulation& mesh) {
  std::size_t free_count = 0;
  std::string free_ones;
  std::string others;
  visit_edges(mesh, [&](EdgeId e) {
    const bool is_free = !mesh.is_constrained(e);
    if (is_free) ++free_count;
    append_edge(is_free ? free_ones : others, mesh.point(mesh.from(e)), mesh.point(mesh.to(e)));
  });
  std::string bytes;
  const auto count = static_cast<double>(free_count);
  append_edge(bytes, {count, count}, {count, count});
  return bytes + free_ones + others;
}

double value_of(const io::Feature& feature) {
  for (const char* key : {"value", "z", "height"})
    if (const auto value = number_of(feature, key)) return *value;
  return 0;
}

overlay::Ring directed(overlay::Ring ring, int turn) {
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  if (overlay::area(ring).sign() * turn < 0) std::ranges::reverse(ring);
  return ring;
}

std::vector<overlay::Ring> directed_rings(const overlay::Polygon& polygon) {
  std::vector<overlay::Ring> rings{directed(polygon.outer, 1)};
  for (const overlay::Ring& hole : polygon.holes) rings.push_back(directed(hole, -1));
  return rings;
}

overlay::Ring shifted(std::span<const Point> ring, Point by) {
  overlay::Ring result;
  result.reserve(ring.size());
  for (const Point& p : ring) result.push_back({p.x + by.x, p.y + by.y});
  return result;
}

void require_usable(const Item& item, Point at) {
  for (const overlay::Ring& ring : item.rings)
    for (const Point& p : ring)
      if (!Triangulation::is_usable(Point{p.x + at.x, p.y + at.y}))
        throw Refusal(422, "there it has coordinates that are not usable");
}

void place(Overlay& overlay, Item& item, Point at) {
  for (std::size_t i = 0; i < item.rings.size(); ++i)
    overlay.move(item.ids[i], shifted(item.rings[i], at));
  item.at = at;
}

}  // namespace loft::app
