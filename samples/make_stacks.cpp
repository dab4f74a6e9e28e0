// SPDX-License-Identifier: MIT
// Makes two stacks of contours out of nothing but formulas, and prints one of them:
//   make_stacks vessels > samples/data/vessels.ndjson     a tree of 31 branches
//   make_stacks shells > samples/data/shells.ndjson       solids inside hollow solids
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iomanip>
#include <iostream>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

namespace {

struct Vec {
  double x = 0;
  double y = 0;
  double z = 0;
};

Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec operator*(double s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

struct Point {
  double x = 0;
  double y = 0;
};
using Contour = std::vector<Point>;
using Contours = std::vector<Contour>;

// ---- Vessels: an implicit function, cut by marching squares

/// A straight tube that gets thinner, round at both ends.
struct Branch {
  Vec from;
  Vec to;
  double from_radius;
  double to_radius;
};

/// Negative inside the branch; near it about the distance.
double distance(const Branch& branch, Vec p) {
  const Vec axis = branch.to - branch.from;
  const double along = std::clamp(dot(p - branch.from, axis) / dot(axis, axis), 0.0, 1.0);
  const Vec offset = p - (branch.from + along * axis);
  const double radius = std::lerp(branch.from_radius, branch.to_radius, along);
  return std::sqrt(dot(offset, offset)) - radius;
}

/// The smaller of two distances, rounded off where they are nearly the same.
double smooth_min(double a, double b) {
  constexpr double blend = 1.5;
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - h * h * blend / 4;
}

void grow(std::vector<Branch>& tree, Branch branch, double azimuth, int forks) {
  tree.push_back(branch);
  if (forks == 0) return;
  const Vec axis = branch.to - branch.from;
  const double length = std::sqrt(dot(axis, axis));
  for (const double side : {0.55, -0.75}) {
    const Vec spread{side * std::cos(azimuth), side * std::sin(azimuth), 0};
    const Vec direction = (1 / length) * axis + spread;
    const Vec step = (0.82 * length / std::sqrt(dot(direction, direction))) * direction;
    const double radius = branch.to_radius;
    grow(tree, {branch.to, branch.to + step, radius, 0.75 * radius}, azimuth + 1.3 + side,
         forks - 1);
  }
}

/// Values at the nodes of a square grid around the origin, row by row. An edge of the grid is named
/// by its first node, times two, plus one if it is upright.
struct Grid {
  std::size_t nodes_per_row;
  double half_width;
  std::vector<double> values;

  Point place(std::size_t node) const {
    const std::size_t row = node / nodes_per_row;
    const std::size_t column = node % nodes_per_row;
    const double step = 2 * half_width / static_cast<double>(nodes_per_row - 1);
    return {static_cast<double>(column) * step - half_width,
            static_cast<double>(row) * step - half_width};
  }

  /// Where the value is 0 on an edge whose ends have different signs.
  Point zero(std::size_t edge) const {
    const std::size_t first = edge / 2;
    const std::size_t last = edge % 2 == 0 ? first + 1 : first + nodes_per_row;
    const double t = values[first] / (values[first] - values[last]);
    const Point a = place(first);
    const Point b = place(last);
    return {std::lerp(a.x, b.x, t), std::lerp(a.y, b.y, t)};
  }
};

Grid sample(const std::function<double(Point)>& value, double half_width, std::size_t rows) {
  Grid grid{rows, half_width, std::vector<double>(rows * rows)};
  for (std::size_t node = 0; node < rows * rows; ++node) {
    grid.values[node] = value(grid.place(node));
  }
  return grid;
}

/// In one cell, leads each edge where the contour comes in to the edge where it goes out; inside
/// (negative) is on its left. With four such edges the mean of the corners decides.
void link_cell(const Grid& grid, std::size_t node, std::vector<std::size_t>& next) {
  const std::size_t above = node + grid.nodes_per_row;
  const std::size_t corners[] = {node, node + 1, above + 1, above};
  const std::size_t edges[] = {2 * node, 2 * (node + 1) + 1, 2 * above, 2 * node + 1};
  const auto is_inside = [&](std::size_t k) { return grid.values[corners[k % 4]] < 0; };
  double sum = 0;
  for (const std::size_t corner : corners) sum += grid.values[corner];
  const std::size_t turn = sum < 0 ? 1 : 3;  // round the outside corner, or round the inside one
  for (std::size_t k = 0; k < 4; ++k) {
    if (!is_inside(k) || is_inside(k + 1)) continue;
    std::size_t end = k + turn;
    while (is_inside(end) || !is_inside(end + 1)) end += turn;
    next[edges[k]] = edges[end % 4];
  }
}

/// The contours around what is negative, by marching squares. Values at the border are positive.
Contours isolines(const Grid& grid) {
  const std::size_t none = 2 * grid.values.size();
  std::vector<std::size_t> next(none, none);
  for (std::size_t row = 0; row + 1 < grid.nodes_per_row; ++row) {
    for (std::size_t column = 0; column + 1 < grid.nodes_per_row; ++column) {
      link_cell(grid, row * grid.nodes_per_row + column, next);
    }
  }

  Contours contours;
  for (std::size_t start = 0; start < none; ++start) {
    Contour contour;
    for (std::size_t edge = start; next[edge] != none;) {
      contour.push_back(grid.zero(edge));
      edge = std::exchange(next[edge], none);
    }
    if (!contour.empty()) contours.push_back(contour);
  }
  return contours;
}

Contours cut_vessels(const std::vector<Branch>& tree, double z) {
  const auto value = [&](Point p) {
    double nearest = 1e9;
    for (const Branch& branch : tree) {
      nearest = smooth_min(nearest, distance(branch, {p.x, p.y, z}));
    }
    return nearest;
  };
  return isolines(sample(value, 44, 111));
}

// ---- Shells: circles

Contour circle(Point centre, double radius, double phase) {
  constexpr double spacing = 2.5;
  const double turn = 2 * std::numbers::pi;
  const auto count = std::max(12L, std::lround(turn * radius / spacing));
  Contour contour;
  for (long i = 0; i < count; ++i) {
    const double angle = phase + turn * static_cast<double>(i) / static_cast<double>(count);
    contour.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return contour;
}

/// A hollow ball; in it a hollow ring, lying, and a ball in the middle of the ring.
Contours cut_shells(double z) {
  Contours contours;
  const auto add_circle = [&](Point centre, double radius) {
    contours.push_back(circle(centre, radius, 0.1 * z + 0.01 * radius));
  };
  const auto add_ball = [&](Vec centre, double radius) {
    const double square = radius * radius - (z - centre.z) * (z - centre.z);
    if (square > 0) add_circle({centre.x, centre.y}, std::sqrt(square));
  };
  const auto add_ring = [&](Vec centre, double radius, double tube) {
    const double square = tube * tube - (z - centre.z) * (z - centre.z);
    if (square <= 0) return;
    add_circle({centre.x, centre.y}, radius + std::sqrt(square));
    add_circle({centre.x, centre.y}, radius - std::sqrt(square));
  };
  add_ball({0, 0, 0}, 30);
  add_ball({0.5, 0, 0.3}, 27);
  add_ring({0, 1, 1}, 16, 7.5);
  add_ring({0, 1, 1.2}, 16, 4.5);
  add_ball({-0.5, 0.5, 2}, 5);
  return contours;
}

// ---- Output

double rounded(double value) {
  constexpr double decimals = 1e6;
  return std::round(value * decimals) / decimals + 0.0;  // + 0: no negative zero
}

void print(double z, const Contours& contours) {
  std::cout << std::setprecision(10) << "{\"z\":" << rounded(z) << ",\"contours\":[";
  for (std::size_t i = 0; i < contours.size(); ++i) {
    std::cout << (i == 0 ? "[" : ",[");
    for (std::size_t k = 0; k < contours[i].size(); ++k) {
      const Point p = contours[i][k];
      std::cout << (k == 0 ? "[" : ",[") << rounded(p.x) << ',' << rounded(p.y) << ']';
    }
    std::cout << ']';
  }
  std::cout << "]}\n";
}

void print_stack(double from, double to, int slices, const std::function<Contours(double)>& cut) {
  for (int i = 0; i < slices; ++i) {
    const double z = rounded(from + (to - from) * (i + 0.5) / slices);
    print(z, cut(z));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view name = argc == 2 ? argv[1] : "";
  if (name == "vessels") {
    std::vector<Branch> tree;
    grow(tree, {{0, 0, 0}, {0, 0, 20}, 4.5, 3.6}, 0.4, 4);
    print_stack(0, 64, 50, [&](double z) { return cut_vessels(tree, z); });
  } else if (name == "shells") {
    print_stack(-30, 30, 48, cut_shells);
  } else {
    std::cerr << "usage: make_stacks vessels|shells\n";
    return 2;
  }
}
