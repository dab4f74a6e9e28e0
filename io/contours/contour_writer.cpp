// SPDX-License-Identifier: MIT
#include "io/contours/contour_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <ostream>
#include <set>
#include <utility>

#include "io/contours/slice_outlines.h"
#include "mesh/vec3.h"
#include "reconstruct/number_text.h"
#include "reconstruct/world.h"

namespace loft::io {

namespace {

/// Of the slices in the world; of length 1.
Vec3 normal_of(const Stack& stack) {
  if (!stack.frame) return {0, 0, 1};
  const auto& rows = stack.frame->rows;
  Vec3 normal = cross({rows[0][0], rows[1][0], rows[2][0]}, {rows[0][1], rows[1][1], rows[2][1]});
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  for (double& part : normal) part = part == 0 ? 0 : part / length;
  return normal;
}

void append_line(std::string& text, const Vec3& numbers) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (i > 0) text += ' ';
    append_number(text, numbers[i]);
  }
}

/// The vertices and edges of a plane.
class Plane {
 public:
  explicit Plane(const Stack& stack) : stack_(stack) {}

  void add(const Region& region, std::size_t material) {
    for (std::size_t i = 0; i < region.loop_count(); ++i) {
      const auto loop = region.loop(i);
      std::size_t from = vertex(region, loop.back());
      for (const std::uint32_t v : loop) {
        const std::size_t to = vertex(region, v);
        add_edge(from, to, material);
        from = to;
      }
    }
  }

  void append_to(std::string& text) const {
    text += std::to_string(places_.size()) + ' ' + std::to_string(edges_.size()) + '\n';
    for (const Vec3& place : places_) {
      append_line(text, place);
      text += '\n';
    }
    for (const Edge& edge : edges_) {
      const char* between = "";
      for (const std::size_t number : {edge.from, edge.to, edge.left, edge.right}) {
        text += std::exchange(between, " ");
        append_number(text, number);
      }
      text += '\n';
    }
  }

 private:
  struct Edge {
    std::size_t from;
    std::size_t to;
    std::size_t left;
    std::size_t right;
  };

  /// Points at the same place are one vertex.
  std::size_t vertex(const Region& region, std::uint32_t v) {
    const cdt::Point& point = region.points[v];
    const auto [found, is_new] = vertices_.try_emplace(std::pair(point.x, point.y), places_.size());
    if (is_new)
      places_.push_back(world_place(stack_, {point.x, point.y, region.z}, region.origins[v]));
    return found->second;
  }

  void add_edge(std::size_t from, std::size_t to, std::size_t material) {
    if (const auto found = numbers_.find({to, from}); found != numbers_.end()) {
      Edge& other = edges_[found->second];
      if (other.right == 0) {
        other.right = material;
        return;
      }
    }
    numbers_.try_emplace({from, to}, edges_.size());
    edges_.push_back({from, to, material, 0});
  }

  const Stack& stack_;
  std::map<std::pair<double, double>, std::size_t> vertices_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> numbers_;  // of edges by their ends
  std::vector<Vec3> places_;
  std::vector<Edge> edges_;
};

/// Numbers from 1, by name.
std::map<std::string, std::size_t> materials_of(const Stack& stack) {
  std::map<std::string, std::size_t> materials;
  for (const Slice& slice : stack.slices)
    for (const Contour& contour : slice.contours) materials.try_emplace(contour.label, 0);
  std::size_t number = 0;
  for (auto& [label, material] : materials) material = ++number;
  return materials;
}

std::vector<std::string> losses(const std::map<std::string, std::size_t>& materials,
                                std::size_t lines) {
  std::vector<std::string> result;
  if (materials.size() > 1 || (!materials.empty() && !materials.begin()->first.empty())) {
    std::string names = ".contour has no names, and no colours: ";
    for (const auto& [label, material] : materials)
      names += (material == 1 ? "" : ", ") + std::to_string(material) + " is '" + label + "'";
    result.push_back(std::move(names));
  }
  if (materials.size() > 1)
    result.emplace_back(
        "other programs expect that labels do not overlap; where these do, --only one at a time");
  if (lines > 0)
    result.push_back("contours without an area: " + std::to_string(lines) + " left out");
  return result;
}

}  // namespace

std::vector<std::string> write_contour(std::ostream& out, const Stack& stack) {
  const auto materials = materials_of(stack);
  const Vec3 normal = normal_of(stack);
  std::vector<std::uint32_t> order(stack.slices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t s) { return stack.slices[s].z; });
  out << order.size() << '\n';
  std::size_t lines = 0;
  for (const std::uint32_t s : order) {
    const Vec3 place = world_place(stack, {0, 0, stack.slices[s].z}, {});
    Plane plane(stack);
    for (const auto& [label, region] : slice_outlines(stack, s)) {
      lines += region.line_count();
      plane.add(region, materials.at(label));
    }
    std::string text;
    append_line(text, normal);
    text += ' ';
    append_number(text, 0 - std::inner_product(normal.begin(), normal.end(), place.begin(), 0.0));
    text += '\n';
    plane.append_to(text);
    out << text;
  }
  return losses(materials, lines);
}

}  // namespace loft::io
