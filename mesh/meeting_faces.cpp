// SPDX-License-Identifier: MIT
#include "mesh/meeting_faces.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>

#include "mesh/box3.h"
#include "mesh/predicates.h"
#include "mesh/triangle_pairs.h"

namespace loft {

namespace {

/// An edge across from a vertex, in one of its faces.
struct LinkEdge {
  std::uint32_t from;
  std::uint32_t to;
};

/// The edges across from each vertex.
class Links {
 public:
  Links(const Mesh& mesh, std::span<const std::uint32_t> faces) : begin_(mesh.points.size() + 2) {
    for (const std::uint32_t f : faces)
      for (const std::uint32_t v : mesh.faces[f]) ++begin_[v + 2];
    for (std::size_t i = 2; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    edges_.resize(3 * faces.size());
    for (const std::uint32_t f : faces) {
      const auto& [a, b, c] = mesh.faces[f];
      edges_[begin_[a + 1]++] = {b, c};
      edges_[begin_[b + 1]++] = {c, a};
      edges_[begin_[c + 1]++] = {a, b};
    }
  }

  [[nodiscard]] std::span<const LinkEdge> of(std::uint32_t v) const {
    return std::span(edges_).subspan(begin_[v], begin_[v + 1] - begin_[v]);
  }

 private:
  std::vector<std::uint32_t> begin_;
  std::vector<LinkEdge> edges_;
};

/// Whether each edge of a link begins where another one ends, so that it consists of rings.
bool is_closed(std::span<const LinkEdge> link) {
  for (const LinkEdge& edge : link) {
    int ends = 0;
    int begins = 0;
    for (const LinkEdge& other : link) {
      ends += other.to == edge.from ? 1 : 0;
      begins += other.from == edge.from ? 1 : 0;
    }
    if (ends != 1 || begins != 1) return false;
  }
  return true;
}

/// Whether floating point tells that the faces around a place, seen along an axis, all turn the
/// same way, and once around it in all. They turn by less than half a circle each, so they come
/// from below to above as often as they go around. Precondition: the link is closed.
bool is_once_around(const Mesh& mesh, std::uint32_t v, std::span<const LinkEdge> link,
                    std::size_t axis) {
  const std::size_t x = axis == 2 ? 0 : axis + 1;
  const std::size_t y = x == 2 ? 0 : x + 1;
  const Vec3& at = mesh.points[v];
  const auto is_below = [](double dx, double dy) { return dy < 0 || (dy == 0 && dx < 0); };
  int turn = 0;
  int rises = 0;
  for (const LinkEdge& edge : link) {
    const Vec3& a = mesh.points[edge.from];
    const Vec3& b = mesh.points[edge.to];
    const double ax = a[x] - at[x], ay = a[y] - at[y];
    const double bx = b[x] - at[x], by = b[y] - at[y];
    const double left = ax * by;
    const double right = ay * bx;
    const double bound = cdt::detail::orient_bound * (std::abs(left) + std::abs(right));
    const int side = left - right > bound ? 1 : left - right < -bound ? -1 : 0;
    if (side == 0 || side == -turn) return false;
    turn = side;
    rises += is_below(ax, ay) && !is_below(bx, by) ? 1 : 0;
  }
  return rises == 1;
}

/// Whether floating point tells that all of q is strictly on one side of p's plane.
bool is_beside(const Corners& p, const Corners& q) {
  const int side = detail::orient3d_filter(p[0], p[1], p[2], q[0]);
  return side != 0 && side == detail::orient3d_filter(p[0], p[1], p[2], q[1]) &&
         side == detail::orient3d_filter(p[0], p[1], p[2], q[2]);
}

/// Without a branch for each, as for two of three pairs it holds.
bool have_common_vertex(const std::array<std::uint32_t, 3>& f,
                        const std::array<std::uint32_t, 3>& g) {
  const auto has = [&](std::uint32_t v) {
    return static_cast<unsigned>(v == g[0]) | static_cast<unsigned>(v == g[1]) |
           static_cast<unsigned>(v == g[2]);
  };
  return (has(f[0]) | has(f[1]) | has(f[2])) != 0;
}

/// A face by its number, and what it is made of.
struct Face {
  std::uint32_t number;
  std::array<std::uint32_t, 3> vertices;
};

/// Tells whether faces meet.
class FaceTest {
 public:
  FaceTest(const Mesh& mesh, std::span<const std::uint32_t> faces)
      : mesh_(mesh), is_tidy_(detail::find_tidy_vertices(mesh, faces)) {}

  [[nodiscard]] bool meet(const Face& f, const Face& g) const {
    const bool is_joined = have_common_vertex(f.vertices, g.vertices);
    if (is_joined && have_common_tidy_vertex(f, g)) return false;
    const Corners p = corners(mesh_, f.number);
    const Corners q = corners(mesh_, g.number);
    if (!is_joined && (is_beside(p, q) || is_beside(q, p))) return false;
    return triangles_meet(p, q);
  }

 private:
  [[nodiscard]] bool have_common_tidy_vertex(const Face& f, const Face& g) const {
    return std::ranges::any_of(f.vertices, [&](std::uint32_t v) {
      return is_tidy_[v] != 0 && std::ranges::find(g.vertices, v) != g.vertices.end();
    });
  }

  const Mesh& mesh_;
  std::vector<char> is_tidy_;
};

// --- Boxes in whole numbers ---

/// Three numbers of 20 bits side by side, each below a bit of its own.
constexpr unsigned field_bits = 20;
constexpr std::uint64_t field = (std::uint64_t{1} << field_bits) - 1;
constexpr unsigned stride = field_bits + 1;
constexpr std::uint64_t guards =
    (std::uint64_t{1} | std::uint64_t{1} << stride | std::uint64_t{1} << 2 * stride) << field_bits;

/// The guards of those numbers in which a is at least b.
constexpr std::uint64_t at_least(std::uint64_t a, std::uint64_t b) {
  return ((a | guards) - b) & guards;
}
/// All bits of the numbers at some guards.
constexpr std::uint64_t numbers_at(std::uint64_t some) { return some - (some >> field_bits); }

/// A box between numbered planes.
struct PackedBox {
  std::uint64_t low = field | field << stride | field << 2 * stride;  // around nothing
  std::uint64_t high = 0;
};

bool boxes_meet(const PackedBox& a, const PackedBox& b) {
  return (at_least(a.high, b.low) & at_least(b.high, a.low)) == guards;
}

PackedBox joined(const PackedBox& a, const PackedBox& b) {
  const std::uint64_t b_is_lower = numbers_at(at_least(a.low, b.low));
  const std::uint64_t a_is_higher = numbers_at(at_least(a.high, b.high));
  return {(b.low & b_is_lower) | (a.low & ~b_is_lower),
          (a.high & a_is_higher) | (b.high & ~a_is_higher)};
}

/// Numbers planes across all of a box, along each axis. What is in order is so still.
class Planes {
 public:
  explicit Planes(const Box3& all) : low_(all.low) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double size = all.high[axis] - all.low[axis];
      scale_[axis] = size > 0 ? static_cast<double>(field) / size : 0;
    }
  }
  [[nodiscard]] std::uint64_t number(const Vec3& place) const {
    std::uint64_t result = 0;
    for (std::size_t axis = 3; axis-- > 0;) {
      const double number = (place[axis] - low_[axis]) * scale_[axis];
      result = result << stride | (number > 0 ? static_cast<std::uint64_t>(number) & field : 0);
    }
    return result;
  }
  [[nodiscard]] PackedBox number(const Box3& box) const {
    return {number(box.low), number(box.high)};
  }

 private:
  Vec3 low_;
  Vec3 scale_{};
};

/// Sorts by the lowest bits, digit by digit.
void sort_by_low_bits(std::vector<std::uint64_t>& keys, unsigned bits) {
  constexpr unsigned digit = 10;
  std::vector<std::uint64_t> sorted(keys.size());
  for (unsigned shift = 0; shift < bits; shift += digit) {
    std::array<std::uint32_t, (1U << digit) + 1> begin{};
    const auto place = [&](std::uint64_t key) { return (key >> shift) & ((1U << digit) - 1); };
    for (const std::uint64_t key : keys) ++begin[place(key) + 1];
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    for (const std::uint64_t key : keys) sorted[begin[place(key)]++] = key;
    keys.swap(sorted);
  }
}

/// Two zeros between the bits of a number of ten.
constexpr std::uint64_t spread_bits(std::uint64_t number) {
  number = (number | number << 16) & 0x3000'0ff;
  number = (number | number << 8) & 0x300'f00f;
  number = (number | number << 4) & 0x30c'30c3;
  return (number | number << 2) & 0x924'9249;
}

/// Where the middle of a box is on a curve through all of space: in 30 bits.
std::uint64_t place_on_curve(const PackedBox& box) {
  std::uint64_t result = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const std::uint64_t sum =
        (box.low >> axis * stride & field) + (box.high >> axis * stride & field);
    result |= spread_bits(sum >> (field_bits + 1 - 10)) << axis;
  }
  return result;
}

/// Faces along a curve through all of their places, and boxes around each, around leaves of some
/// that follow one another, around two leaves, four, and so on.
class BoxPyramid {
 public:
  BoxPyramid(const Mesh& mesh, std::span<const std::uint32_t> faces) {
    const std::vector<PackedBox> boxes = numbered_boxes(mesh, faces);
    std::vector<std::uint64_t> keys;
    keys.reserve(faces.size());
    for (std::uint32_t i = 0; i < faces.size(); ++i)
      keys.push_back(std::uint64_t{i} << 32 | place_on_curve(boxes[i]));
    sort_by_low_bits(keys, 30);
    items_.reserve(faces.size());
    for (const std::uint64_t key : keys) {
      const std::uint32_t i = static_cast<std::uint32_t>(key >> 32);
      items_.push_back({boxes[i], {faces[i], mesh.faces[faces[i]]}});
    }
    levels_.push_back(leaf_boxes());
    while (levels_.back().size() > 1) levels_.push_back(halved(levels_.back()));
  }

  /// The pairs are looked at in so many tasks.
  [[nodiscard]] std::size_t task_count() const {
    return items_.empty() ? 0 : levels_[task_level()].size();
  }
  /// Whether test(f, g) holds for all pairs of a task whose boxes meet; stops where it does not,
  /// and where far more boxes met than usually do.
  template <class Test>
  [[nodiscard]] bool all_of(std::size_t task, Test test) const {
    const std::size_t level = task_level();
    Walk<Test> walk{*this, patience(), test};
    if (!walk.within(level, task)) return false;
    for (std::size_t other = task + 1; other < levels_[level].size(); ++other)
      if (meet(level, task, other) && !walk.between(level, task, other)) return false;
    return true;
  }

 private:
  static constexpr std::size_t leaf_size = 8;
  static constexpr std::size_t most_tasks = 64;

  [[nodiscard]] std::size_t task_level() const {
    std::size_t level = 0;
    while (levels_[level].size() > most_tasks) ++level;
    return level;
  }
  /// On usual surfaces it takes ten for each face.
  [[nodiscard]] std::size_t patience() const {
    return 10'000 + 100 * (items_.size() / task_count());
  }

  struct Item {
    PackedBox box;
    Face face;
  };

  static std::vector<PackedBox> numbered_boxes(const Mesh& mesh,
                                               std::span<const std::uint32_t> faces) {
    Box3 all = no_box;
    for (const std::uint32_t f : faces)
      for (const std::uint32_t v : mesh.faces[f]) all = extended(all, mesh.points[v]);
    const Planes planes(all);
    std::vector<PackedBox> result;
    result.reserve(faces.size());
    for (const std::uint32_t f : faces)
      result.push_back(planes.number(box_around(corners(mesh, f))));
    return result;
  }

  [[nodiscard]] std::vector<PackedBox> leaf_boxes() const {
    std::vector<PackedBox> result((items_.size() + leaf_size - 1) / leaf_size);
    for (std::size_t i = 0; i < items_.size(); ++i)
      result[i / leaf_size] = joined(result[i / leaf_size], items_[i].box);
    return result;
  }

  static std::vector<PackedBox> halved(const std::vector<PackedBox>& boxes) {
    std::vector<PackedBox> result((boxes.size() + 1) / 2);
    for (std::size_t i = 0; i < boxes.size(); ++i) result[i / 2] = joined(result[i / 2], boxes[i]);
    return result;
  }

  [[nodiscard]] bool meet(std::size_t level, std::size_t i, std::size_t j) const {
    return boxes_meet(levels_[level][i], levels_[level][j]);
  }
  /// Through the pairs of one task.
  template <class Test>
  struct Walk {
    const BoxPyramid& boxes;
    std::size_t patience;
    Test& test;

    bool within(std::size_t level, std::size_t i) {
      if (level == 0) return within_leaf(i);
      const std::size_t first = 2 * i;
      const std::size_t second = first + 1;
      if (second == boxes.levels_[level - 1].size()) return within(level - 1, first);
      return within(level - 1, first) && within(level - 1, second) &&
             (!boxes.meet(level - 1, first, second) || between(level - 1, first, second));
    }
    /// Of two that meet.
    bool between(std::size_t level, std::size_t i, std::size_t j) {
      if (!has_patience()) return false;
      if (level == 0) return between_leaves(i, j);
      const std::size_t below = level - 1;
      const std::size_t end_i = std::min(2 * i + 2, boxes.levels_[below].size());
      const std::size_t end_j = std::min(2 * j + 2, boxes.levels_[below].size());
      for (std::size_t k = 2 * i; k < end_i; ++k)
        for (std::size_t l = 2 * j; l < end_j; ++l)
          if (boxes.meet(below, k, l) && !between(below, k, l)) return false;
      return true;
    }
    bool within_leaf(std::size_t leaf) {
      const std::span<const Item> items = boxes.leaf_items(leaf);
      for (std::size_t i = 0; i < items.size(); ++i)
        for (std::size_t j = i + 1; j < items.size(); ++j)
          if (!pair(items[i], items[j])) return false;
      return true;
    }
    bool between_leaves(std::size_t a, std::size_t b) {
      for (const Item& item : boxes.leaf_items(a)) {
        if (!boxes_meet(item.box, boxes.levels_[0][b])) continue;
        for (const Item& other : boxes.leaf_items(b))
          if (!pair(item, other)) return false;
      }
      return true;
    }
    bool pair(const Item& a, const Item& b) {
      return !boxes_meet(a.box, b.box) || (has_patience() && test(a.face, b.face));
    }
    bool has_patience() { return patience > 0 && patience-- > 0; }
  };
  [[nodiscard]] std::span<const Item> leaf_items(std::size_t leaf) const {
    const std::size_t first = leaf * leaf_size;
    return std::span(items_).subspan(first, std::min(leaf_size, items_.size() - first));
  }

  std::vector<Item> items_;
  std::vector<std::vector<PackedBox>> levels_;
};

/// None where boxes alone are no help, or there are too many pairs.
std::optional<std::vector<FacePair>> meeting_by_boxes(const BoxPyramid& boxes, const FaceTest& test,
                                                      std::size_t most, const Runner& run) {
  std::vector<std::vector<FacePair>> found(boxes.task_count());
  std::atomic<bool> gives_up = false;  // one that does is enough
  run(boxes.task_count(), [&](std::size_t task) {
    if (gives_up) return;
    const auto look_at = [&](const Face& f, const Face& g) {
      if (test.meet(f, g)) found[task].emplace_back(std::minmax(f.number, g.number));
      return found[task].size() < most;
    };
    if (!boxes.all_of(task, look_at)) gives_up = true;
  });
  if (gives_up) return std::nullopt;
  std::vector<FacePair> result;
  for (const auto& pairs : found) result.insert(result.end(), pairs.begin(), pairs.end());
  return result.size() < most ? std::optional(result) : std::nullopt;
}

std::vector<FacePair> meeting_by_turned_boxes(const Mesh& mesh,
                                              std::span<const std::uint32_t> faces,
                                              const FaceTest& test, std::size_t most) {
  std::vector<Corners> places;
  std::vector<TrianglePairs::Vertices> vertices;
  for (const std::uint32_t face : faces) {
    places.push_back(corners(mesh, face));
    vertices.push_back(mesh.faces[face]);
  }
  std::vector<FacePair> result;
  const TrianglePairs pairs(places, vertices, mesh.points.size());
  static_cast<void>(pairs.all_of([&](std::uint32_t i, std::uint32_t j) {
    if (test.meet({faces[i], vertices[i]}, {faces[j], vertices[j]}))
      result.emplace_back(std::minmax(faces[i], faces[j]));
    return result.size() < most;
  }));
  return result;
}

}  // namespace

std::vector<char> detail::find_tidy_vertices(const Mesh& mesh,
                                             std::span<const std::uint32_t> faces) {
  constexpr std::size_t most_edges = 24;  // with more it takes too long
  const Links links(mesh, faces);
  std::vector<char> result(mesh.points.size());
  std::size_t axis = 0;
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    const std::span<const LinkEdge> link = links.of(v);
    if (link.size() < 3 || link.size() > most_edges || !is_closed(link)) continue;
    for (int i = 0; i < 3 && result[v] == 0; ++i) {
      if (i > 0) axis = (axis + 1) % 3;  // what held for the last one is tried first
      result[v] = is_once_around(mesh, v, link, axis) ? 1 : 0;
    }
  }
  return result;
}

std::vector<FacePair> meeting_faces(const Mesh& mesh, std::span<const std::uint32_t> faces,
                                    std::size_t most, const Runner& run) {
  std::optional<FaceTest> test;
  std::optional<BoxPyramid> boxes;
  run(2, [&](std::size_t part) {
    if (part == 0)
      test.emplace(mesh, faces);
    else
      boxes.emplace(mesh, faces);
  });
  auto result = meeting_by_boxes(*boxes, *test, most, run);
  if (!result) result = meeting_by_turned_boxes(mesh, faces, *test, most);
  std::ranges::sort(*result);
  return *std::move(result);
}

}  // namespace loft
