// SPDX-License-Identifier: MIT
// What holds of every field, after any edits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <thread>
#include <vector>

#include "cdt/predicates.h"
#include "fields/field.h"
#include "fields/patch.h"
#include "tests/cases.h"
#include "tests/fields/edited.h"

namespace loft::fields {
namespace {

void expect_same(const Field& a, const Field& b, Point p) {
  for (const Smoothness smoothness : smoothnesses)
    for (const Side side : sides) {
      ASSERT_EQ(a.value(p, smoothness, side), b.value(p, smoothness, side)) << p;
      ASSERT_EQ(a.value(p, smoothness, side, Outside::nearest),
                b.value(p, smoothness, side, Outside::nearest))
          << p;
    }
}

TEST(Fields, AreWhateverTheOrderOfEdits) {
  std::uint64_t compared = 0;
  for (std::uint64_t seed = 0; seed < fields_to_try(120); ++seed) {
    SCOPED_TRACE(seed);
    Edited edited(seed);
    for (int i = 0; i < 60; ++i) {
      edited.edit();
      if (i % 6 != 0 && i < 40) continue;
      const Field fresh = edited.built();
      if (!edited.field().mesh().snaps().empty() || !fresh.mesh().snaps().empty()) continue;
      ASSERT_EQ(edited.field().mesh().vertex_count(), fresh.mesh().vertex_count());
      ASSERT_EQ(edited.field().conflicts().size(), fresh.conflicts().size());
      const Triangulation& mesh = fresh.mesh();
      for (std::uint32_t v = 1; v < mesh.vertex_bound(); ++v) {
        if (!mesh.is_vertex(VertexId(v))) continue;
        ASSERT_NO_FATAL_FAILURE(expect_same(edited.field(), fresh, mesh.point(VertexId(v))));
      }
      for (int k = 0; k < 12; ++k)
        ASSERT_NO_FATAL_FAILURE(expect_same(edited.field(), fresh, edited.anywhere()));
      ++compared;
    }
  }
  EXPECT_GT(compared, cases(2000));
}

TEST(Fields, AreSoAlsoWhereManyEdgesMeet) {
  for (unsigned count = 3; count < 40; ++count) {
    SCOPED_TRACE(count);
    const auto land = [](Point p) { return 1 + p.x + p.x * p.y; };
    std::vector<Sample> all{{{0, 0}, 1}};
    for (unsigned i = 0; i < count; ++i) {
      const double angle = 2 * 3.141592653589793 * i / count;
      for (const double radius : {1, 3}) {
        const Point p{radius * std::cos(angle), radius * std::sin(angle)};
        all.push_back({p, land(p)});
      }
    }
    Field forwards;
    for (const Sample& sample : all) forwards.insert(sample);
    Field backwards;
    std::reverse(all.begin(), all.end());
    for (const Sample& sample : all) backwards.insert(sample);
    for (const Sample& sample : all)
      ASSERT_EQ(forwards.gradient(sample.place, Smoothness::cubic),
                backwards.gradient(sample.place, Smoothness::cubic));
    if (count < 5) continue;  // too few for a quadratic polynomial
    EXPECT_NEAR(forwards.gradient({0, 0}, Smoothness::cubic)->x, 1, 1e-9);
    EXPECT_NEAR(forwards.gradient({0, 0}, Smoothness::cubic)->y, 0, 1e-9);
  }
}

/// Edges of a field with what is on both sides of them.
template <class Visit>
void for_each_free_edge(const Field& field, Visit visit) {
  const Triangulation& mesh = field.mesh();
  for (std::uint32_t e = 0; e < mesh.edge_bound(); ++e) {
    const EdgeId edge(e);
    if (!mesh.is_triangle(Triangulation::triangle(edge)) || field.is_separating(edge) ||
        mesh.twin(edge) < edge)
      continue;
    const Patch left(field, Triangulation::triangle(edge), Smoothness::cubic);
    const Patch right(field, Triangulation::triangle(mesh.twin(edge)), Smoothness::cubic);
    if (left.has_values() && right.has_values()) visit(edge, left, right);
  }
}

[[nodiscard]] Point on(const Triangulation& mesh, EdgeId e, double t) {
  const Point a = mesh.point(mesh.from(e));
  const Point b = mesh.point(mesh.to(e));
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/// The least angle of a triangle, as the sine: with less, rounding decides more.
[[nodiscard]] double least_sine(const Triangulation& mesh, TriangleId t) {
  double least = 1;
  for (unsigned corner = 0; corner < 3; ++corner) {
    const EdgeId e = Triangulation::edge(t, corner);
    const Vector a = way(mesh.point(mesh.from(e)), mesh.point(mesh.to(e)));
    const Vector b = way(mesh.point(mesh.from(e)), mesh.point(mesh.apex(e)));
    least = std::min(least, std::abs(cross(a, b)) / std::sqrt(dot(a, a) * dot(b, b)));
  }
  return least;
}

/// The largest gradient at the corners of both triangles of an edge.
[[nodiscard]] double steepest(const Field& field, EdgeId e) {
  double most = 0;
  for (const EdgeId side : {e, field.mesh().twin(e)})
    for (unsigned corner = 0; corner < 3; ++corner) {
      const Vector gradient =
          field.corner_gradient(Triangulation::edge(Triangulation::triangle(side), corner));
      most = std::max(most, std::sqrt(dot(gradient, gradient)));
    }
  return most;
}

TEST(Fields, AreSmoothAcrossEdgesButFeatures) {
  std::uint64_t smooth = 0;
  std::uint64_t creased = 0;
  for (std::uint64_t seed = 1000; seed < 1000 + fields_to_try(60); ++seed) {
    SCOPED_TRACE(seed);
    Edited edited(seed);
    for (int i = 0; i < 60; ++i) edited.edit();
    const Field& field = edited.field();
    const Triangulation& mesh = field.mesh();
    for_each_free_edge(field, [&](EdgeId e, const Patch& left, const Patch& right) {
      if (std::min(least_sine(mesh, Triangulation::triangle(e)),
                   least_sine(mesh, Triangulation::triangle(mesh.twin(e)))) < 0.01)
        return;
      for (const double t : {0.1, 0.25, 0.5, 0.9}) {
        const Point p = on(mesh, e, t);
        const double scale = 64 + 16 * steepest(field, e);
        EXPECT_NEAR(left.value(p), right.value(p), 1e-11 * scale);
        EXPECT_NEAR(left.value(p), field.edge_value(e, p, Smoothness::cubic), 1e-11 * scale);
        EXPECT_EQ(field.edge_value(e, p, Smoothness::cubic),
                  field.edge_value(mesh.twin(e), p, Smoothness::cubic));
        EXPECT_EQ(field.edge_value(e, p), field.edge_value(mesh.twin(e), p));
        const Vector a = left.gradient(p);
        const Vector b = right.gradient(p);
        const double size = 1 + std::sqrt(dot(a, a) + dot(b, b)) + steepest(field, e);
        const Vector difference = a + -1 * b;
        if (!field.is_crease(e)) {
          EXPECT_LT(std::sqrt(dot(difference, difference)), 1e-9 * size)
              << mesh.point(mesh.from(e));
          ++smooth;
        } else if (std::sqrt(dot(difference, difference)) > 1e-3 * size) {
          ++creased;
        }
      }
    });
  }
  EXPECT_GT(smooth, 1000U);
  EXPECT_GT(creased, 100U);
}

TEST(Fields, SlopeAsTheirValuesDo) {
  for (std::uint64_t seed = 2000; seed < 2000 + fields_to_try(40); ++seed) {
    SCOPED_TRACE(seed);
    Edited edited(seed);
    for (int i = 0; i < 60; ++i) edited.edit();
    const Field& field = edited.field();
    const Triangulation& mesh = field.mesh();
    for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i) {
      const TriangleId t(i);
      if (!mesh.is_triangle(t) || mesh.is_infinite(t) || least_sine(mesh, t) < 0.05) continue;
      const EdgeId e = Triangulation::edge(t);
      const Point middle = on(mesh, e, 0.4);
      const Point apex = mesh.point(mesh.apex(e));
      const Point p{middle.x + 0.37 * (apex.x - middle.x), middle.y + 0.37 * (apex.y - middle.y)};
      const Vector edge = way(mesh.point(mesh.from(e)), mesh.point(mesh.to(e)));
      const double step = 1e-5 * std::sqrt(dot(edge, edge));
      for (const Smoothness smoothness : smoothnesses) {
        const Patch patch(field, t, smoothness);
        if (!patch.has_values()) continue;
        const Vector gradient = patch.gradient(p);
        const double by_x =
            (patch.value({p.x + step, p.y}) - patch.value({p.x - step, p.y})) / (2 * step);
        const double by_y =
            (patch.value({p.x, p.y + step}) - patch.value({p.x, p.y - step})) / (2 * step);
        const double size = 1e3 * (1 + std::sqrt(dot(gradient, gradient)));
        EXPECT_NEAR(gradient.x, by_x, 1e-4 * size);
        EXPECT_NEAR(gradient.y, by_y, 1e-4 * size);
      }
    }
  }
}

TEST(Fields, AreBetweenTheCornersWhereLinear) {
  for (std::uint64_t seed = 3000; seed < 3000 + fields_to_try(40); ++seed) {
    SCOPED_TRACE(seed);
    Edited edited(seed);
    for (int i = 0; i < 60; ++i) edited.edit();
    const Triangulation& mesh = edited.field().mesh();
    for (int i = 0; i < 200; ++i) {
      const Point p = edited.anywhere();
      const cdt::Location place = mesh.locate(p);
      if (place.kind != cdt::Location::Kind::triangle) continue;
      const EdgeId e = place.edge;
      const double a = edited.field().corner_value(e);
      const double b = edited.field().corner_value(Triangulation::next(e));
      const double c = edited.field().corner_value(Triangulation::prev(e));
      const std::optional<double> value = edited.field().value(p);
      if (!value) continue;
      EXPECT_LE(*value, std::max({a, b, c}));
      EXPECT_GE(*value, std::min({a, b, c}));
    }
  }
}

TEST(Fields, ReproduceAPlane) {
  const auto plane = [](Point p) { return 3 + 2 * p.x - 5 * p.y; };
  for (std::uint64_t seed = 4000; seed < 4000 + fields_to_try(40); ++seed) {
    SCOPED_TRACE(seed);
    Edited random(seed);
    Field field;
    for (const Point p : {Point{-1, -1}, Point{17, -1}, Point{17, 17}, Point{-1, 17}})
      field.insert(Sample{p, plane(p)});
    for (int i = 0; i < 40; ++i) {
      const Point p = random.place();
      field.insert(Sample{p, plane(p)});
    }
    std::vector<Point> wall;
    for (unsigned i = 0; i < 6; ++i) {
      const auto kind = static_cast<LineKind>(i % 4);
      std::vector<Point> points{random.place(), random.place(), random.place()};
      if (points.front() == points.back()) continue;
      if (kind == LineKind::wall) wall = points;
      // What a barrier encloses may have values in one line, which are those of no plane.
      if (kind == LineKind::barrier) points.pop_back();
      if (kind == LineKind::barrier && !wall.empty() &&
          (cdt::orient(points[0], points[1], wall[0]) !=
               cdt::orient(points[0], points[1], wall[1]) ||
           cdt::orient(points[0], points[1], wall[1]) !=
               cdt::orient(points[0], points[1], wall[2])))
        continue;
      if (points.front() == points.back()) continue;
      std::vector<double> values;
      for (const Point p : points) values.push_back(plane(p));
      field.insert(
          Line{.points = points, .kind = kind, .values = values, .left = values, .right = values});
    }
    for (int i = 0; i < 100; ++i) {
      const Point p = random.anywhere();
      for (const Smoothness smoothness : smoothnesses) {
        const std::optional<double> value = field.value(p, smoothness);
        if (!value) continue;
        EXPECT_NEAR(*value, plane(p), 1e-10) << p;  // triangles may be thin
        const std::optional<Vector> gradient = field.gradient(p, smoothness);
        ASSERT_TRUE(gradient);
        EXPECT_NEAR(gradient->x, 2, 1e-8);
        EXPECT_NEAR(gradient->y, -5, 1e-8);
      }
    }
  }
}

TEST(Fields, AreNotChangedFromBeyondAWallOrBarrier) {
  for (std::uint64_t seed = 5000; seed < 5000 + fields_to_try(60); ++seed) {
    SCOPED_TRACE(seed);
    Edited random(seed);
    const std::vector<Point> fence{{8, -1}, {7, 4}, {9, 9}, {8, 17}};
    const std::vector<double> low(4, 1.0);
    const std::vector<double> high(4, 5.0);
    const LineKind kind = seed % 2 == 0 ? LineKind::wall : LineKind::barrier;
    const auto is_west = [&](Point p) {
      for (std::size_t i = 0; i + 1 < fence.size(); ++i)
        if (fence[i].y <= p.y && p.y <= fence[i + 1].y)
          return cdt::orient(fence[i], fence[i + 1], p) > 0;
      return p.x < 8;
    };
    Field field;
    field.insert(Line{.points = fence, .kind = kind, .left = low, .right = high});
    std::vector<SampleId> beyond;
    std::vector<Point> here;
    for (int i = 0; i < 60; ++i) {
      // Samples on the fence count on both sides.
      const Point grid = random.place();
      const Point p{grid.x + 0.013, grid.y + 0.007};
      const SampleId id = field.insert(Sample{p, random.height()});
      if (is_west(p))
        here.push_back(p);
      else
        beyond.push_back(id);
    }
    const std::vector<Point> across{{2, 3}, {14, 11}};
    field.insert(Line{.points = across, .kind = LineKind::soft});
    for (int i = 0; i < 40; ++i)
      if (const Point p = random.anywhere(); is_west(p)) here.push_back(p);
    std::vector<std::optional<double>> before;
    for (const Point p : here)
      for (const Smoothness smoothness : smoothnesses) before.push_back(field.value(p, smoothness));
    for (const SampleId id : beyond) field.set_value(id, random.height() + 1000);
    std::size_t i = 0;
    for (const Point p : here)
      for (const Smoothness smoothness : smoothnesses)
        ASSERT_EQ(field.value(p, smoothness), before[i++]) << p;
  }
}

TEST(Fields, AnswerSeveralThreadsAtOnce) {
  Edited edited(6000);
  for (int i = 0; i < 150; ++i) edited.edit();
  const auto ask = [&](const Field& field) {
    std::vector<std::optional<double>> answers;
    for (double x = 0; x < 16; x += 0.37)
      for (double y = 0; y < 16; y += 0.41)
        answers.push_back(field.value({x, y}, Smoothness::cubic));
    return answers;
  };
  const std::vector<std::optional<double>> expected = ask(edited.built());
  std::vector<std::vector<std::optional<double>>> got(4);
  std::vector<std::thread> threads;
  for (auto& answers : got) threads.emplace_back([&] { answers = ask(edited.field()); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& answers : got) EXPECT_EQ(answers, expected);
}

}  // namespace
}  // namespace loft::fields
