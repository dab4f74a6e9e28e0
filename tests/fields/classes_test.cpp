// SPDX-License-Identifier: MIT
#include "fields/classes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "cdt/check.h"
#include "tests/cases.h"
#include "tests/fields/separators.h"

namespace loft::fields {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using Signs = std::vector<Sign>;
constexpr Sign to_left = Sign::left;
constexpr Sign on_it = Sign::on;
constexpr Sign to_right = Sign::right;

Signs signs_of(const Classes& classes, PointId id) {
  const auto signs = classes.signs(id);
  return {signs.begin(), signs.end()};
}

std::vector<PointId> changed_in(const Classes& classes) {
  const auto changed = classes.changed();
  return {changed.begin(), changed.end()};
}

/// Points and separators beside which nothing is kept.
class SlowClasses {
 public:
  std::map<PointId, Point> points;
  std::map<SeparatorId, std::vector<Point>> separators;

  [[nodiscard]] std::map<PointId, Signs> signs() const {
    std::map<PointId, Signs> result;
    for (const auto& [id, p] : points)
      for (result[id]; const auto& [number, line] : separators)
        result[id].push_back(Separator(line).sign(p));
    return result;
  }
};

/// One edit of both, at random.
class Editor {
 public:
  Editor(std::uint64_t seed, PointGround ground) : random_(seed), ground_(ground) {}

  void edit() {
    switch (random_() % 10) {
      case 0:
        return insert_point();
      case 1:
        return remove_point();
      case 2:
        return move_point();
      case 3:
        return insert_separator();
      case 4:
        return remove_separator();
      case 5:
        return translate_separator();
      default:
        return move_separator();
    }
  }

  Classes fast;
  SlowClasses slow;

 private:
  template <class Things>
  [[nodiscard]] auto any_of(const Things& things) {
    return std::next(things.begin(), static_cast<std::ptrdiff_t>(random_() % things.size()))->first;
  }

  void insert_point() {
    std::vector<Point> points;
    for (std::size_t i = random_() % 8; i <= 8; ++i)
      points.push_back(random_place(random_, ground_));
    const auto ids = fast.insert(points);
    for (std::size_t i = 0; i < ids.size(); ++i) slow.points[ids[i]] = points[i];
  }
  void remove_point() {
    if (slow.points.empty()) return insert_point();
    const PointId id = any_of(slow.points);
    fast.remove(id);
    slow.points.erase(id);
  }
  void move_point() {
    if (slow.points.empty()) return insert_point();
    const PointId id = any_of(slow.points);
    const Point to = random_place(random_, ground_);
    fast.move(id, to);
    slow.points[id] = to;
  }
  void insert_separator() {
    if (slow.separators.size() > 3) return remove_separator();
    auto line = random_separator(random_, ground_);
    // Equal ones, too.
    if (!slow.separators.empty() && random_() % 4 == 0)
      line = slow.separators[any_of(slow.separators)];
    slow.separators[fast.insert_separator(line)] = line;
  }
  void remove_separator() {
    if (slow.separators.empty()) return insert_separator();
    const SeparatorId id = any_of(slow.separators);
    fast.remove(id);
    slow.separators.erase(id);
  }
  void translate_separator() {
    if (slow.separators.empty()) return insert_separator();
    const SeparatorId id = any_of(slow.separators);
    const Point by{static_cast<double>(random_() % 3) - 1, static_cast<double>(random_() % 3) - 1};
    try {
      fast.translate(id, by);
    } catch (const std::invalid_argument&) {
      return;  // far away two points may become one
    }
    for (Point& p : slow.separators[id]) p = {p.x + by.x, p.y + by.y};
  }
  /// One point moves, or goes, or another comes, or all are others.
  void move_separator() {
    if (slow.separators.empty()) return insert_separator();
    const SeparatorId id = any_of(slow.separators);
    std::vector<Point> line = slow.separators[id];
    const auto at = line.begin() + static_cast<std::ptrdiff_t>(random_() % line.size());
    const Point p = random_place(random_, ground_);
    const auto what = random_() % 6;
    if (what == 0)
      line = random_separator(random_, ground_);
    else if (what == 1 && line.size() > 2)
      line.erase(at);
    else if (what == 2 && line.size() < 60)
      line.insert(at, p);
    else
      *at = p;
    if (std::ranges::adjacent_find(line) != line.end()) return;
    fast.move(id, line);
    slow.separators[id] = line;
  }

  std::mt19937_64 random_;
  PointGround ground_;
};

TEST(Classes, AreWhatEachSeparatorSays) {
  for (const PointGround ground : point_grounds)
    for (std::uint64_t seed = 0; seed < cases(60); ++seed) {
      SCOPED_TRACE("ground " + std::to_string(static_cast<int>(ground)) + ", seed " +
                   std::to_string(seed));
      Editor editor(seed, ground);
      std::map<PointId, Signs> before;
      for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE("edit " + std::to_string(i));
        const auto points_before = editor.slow.points;
        const auto separators_before = editor.slow.separators;
        editor.edit();
        const std::map<PointId, Signs> now = editor.slow.signs();
        for (const auto& [id, signs] : now) ASSERT_EQ(signs_of(editor.fast, id), signs) << id;
        if (points_before == editor.slow.points && separators_before == editor.slow.separators)
          continue;  // there may have been no edit
        std::vector<PointId> changed;
        const bool is_all = separators_before.size() != editor.slow.separators.size();
        for (const auto& [id, signs] : now)
          if (is_all || !before.contains(id) || before[id] != signs) changed.push_back(id);
        ASSERT_EQ(changed_in(editor.fast), changed);
        before = now;
      }
      EXPECT_EQ(editor.fast.point_count(), editor.slow.points.size());
      EXPECT_TRUE(cdt::check(editor.fast.triangulation()).empty());
    }
}

TEST(Classes, AreCountedAsInAFreshBuild) {
  for (const PointGround ground : point_grounds)
    for (std::uint64_t seed = 0; seed < cases(20); ++seed) {
      SCOPED_TRACE("ground " + std::to_string(static_cast<int>(ground)) + ", seed " +
                   std::to_string(seed));
      Editor editor(seed, ground);
      for (int i = 0; i < 80; ++i) editor.edit();
      Classes fresh;
      for (const auto& [id, line] : editor.slow.separators) fresh.insert_separator(line);
      for (const auto& [id, p] : editor.slow.points) fresh.insert(p);
      EXPECT_EQ(editor.fast.classes(), fresh.classes());
      std::size_t sum = 0;
      for (const ClassCount& one : editor.fast.classes()) {
        EXPECT_EQ(editor.fast.points_with(one.signs).size(), one.points);
        sum += one.points;
      }
      EXPECT_EQ(sum, editor.slow.points.size());
    }
}

/// Whether a place is inside a polygon; anything on its outline.
bool is_inside(const overlay::Polygon& polygon, Point p) {
  bool result = false;
  const auto turn = [&](const overlay::Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i];
      const Point b = ring[(i + 1) % ring.size()];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
        result = !result;
    }
  };
  turn(polygon.outer);
  for (const overlay::Ring& hole : polygon.holes) turn(hole);
  return result;
}

TEST(Classes, FacesFillABoxAndHaveTheSignsOfTheirPlaces) {
  for (std::uint64_t seed = 0; seed < cases(100); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    Classes classes;
    for (int i = 0; i < 3; ++i)
      classes.insert_separator(random_separator(random, PointGround::grid));
    const std::vector<ClassFace> faces = classes.faces({{-6, -4}, {5, 7}});
    double area = 0;
    for (const ClassFace& face : faces) area += overlay::area(face.polygon).to_double();
    EXPECT_NEAR(area, 121, 1e-9);
    for (int i = 0; i < 200; ++i) {
      const Point p{std::uniform_real_distribution<double>(-6, 5)(random),
                    std::uniform_real_distribution<double>(-4, 7)(random)};
      const auto found = std::ranges::find_if(
          faces, [&](const ClassFace& face) { return is_inside(face.polygon, p); });
      ASSERT_NE(found, faces.end()) << p;
      EXPECT_EQ(found->signs, classes.signs(p)) << p;
    }
  }
}

TEST(Classes, KnowPointsOnASeparatorItsVertexAndItsEnds) {
  Classes classes;
  const auto ids = classes.insert(
      std::vector<Point>{{0, 0}, {1, 0}, {-7, 0}, {2, 1}, {5, 4}, {0, 3}, {0, -3}, {1, 0}});
  const SeparatorId line = classes.insert_separator(std::vector<Point>{{0, 0}, {1, 0}, {2, 1}});
  EXPECT_EQ(classes.changed().size(), 8U);
  for (const std::size_t i : {0U, 1U, 2U, 3U, 4U, 7U})
    EXPECT_EQ(classes.sign(ids[i], line), on_it) << i;
  EXPECT_EQ(classes.sign(ids[5], line), to_left);
  EXPECT_EQ(classes.sign(ids[6], line), to_right);
  classes.move(line, std::vector<Point>{{0, 0}, {1, 0}, {2, 0}});
  EXPECT_EQ(changed_in(classes), (std::vector<PointId>{ids[3], ids[4]}));
}

TEST(Classes, KnowEqualAndCrossingSeparators) {
  Classes classes;
  const PointId point = classes.insert({1, 1}, 7);
  EXPECT_TRUE(classes.signs(point).empty());
  const std::vector<Point> across{{0, 0}, {1, 0}};
  const SeparatorId first = classes.insert_separator(across);
  const SeparatorId second = classes.insert_separator(across);
  classes.insert_separator(std::vector<Point>{{0, 0}, {0, 1}});
  EXPECT_EQ(signs_of(classes, point), (Signs{to_left, to_left, to_right}));
  classes.translate(first, {0, 2});
  EXPECT_EQ(signs_of(classes, point), (Signs{to_right, to_left, to_right}));
  EXPECT_THAT(changed_in(classes), ElementsAre(point));
  classes.translate(second, {0, 0.5});
  EXPECT_TRUE(classes.changed().empty());
  classes.remove(first);
  EXPECT_EQ(signs_of(classes, point), (Signs{to_left, to_right}));
  EXPECT_EQ(classes.insert_separator(across), first);
  EXPECT_EQ(classes.separators().size(), 3U);
  EXPECT_EQ(classes.signs(Point{0, 0}), (Signs{on_it, to_right, on_it}));
  EXPECT_EQ(classes.classes(), (std::vector<ClassCount>{{{to_left, to_left, to_right}, 1}}));
  EXPECT_EQ(classes.value(point), 7);
  classes.set_value(point, 8);
  EXPECT_EQ(classes.value(point), 8);
}

/// What an edit throws; it changes nothing.
template <class Edit>
std::string complaint(Classes& classes, Edit edit) {
  const auto before = classes.classes();
  try {
    edit();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(classes.classes(), before);
    EXPECT_TRUE(cdt::check(classes.triangulation()).empty());
    return error.what();
  }
  return "";
}

TEST(Classes, RefuseWhatCannotBeAndStayAsTheyAre) {
  Classes classes;
  const PointId point = classes.insert({1, 1});
  const SeparatorId line = classes.insert_separator(std::vector<Point>{{0, 0}, {1, 0}});
  const auto refused = [&](auto edit) { return complaint(classes, edit); };
  const std::vector<Point> one{{3, 3}};
  const std::vector<Point> repeated{{3, 3}, {4, 4}, {4, 4}};
  const Point unusable{1e99, 0};
  EXPECT_THAT(refused([&] { classes.insert_separator(one); }), HasSubstr("has 1"));
  EXPECT_THAT(refused([&] { classes.move(line, one); }), HasSubstr("has 1"));
  EXPECT_THAT(refused([&] { classes.insert_separator(repeated); }),
              HasSubstr("point 2 of the separator repeats"));
  EXPECT_THAT(refused([&] { classes.move(line, repeated); }),
              HasSubstr("point 2 of the separator repeats"));
  EXPECT_THAT(refused([&] {
                classes.translate(line, {1e30, 0});
              }),
              HasSubstr("point 1 of the separator repeats"));
  EXPECT_THAT(refused([&] { classes.translate(line, unusable); }), HasSubstr("not usable"));
  EXPECT_THAT(refused([&] { classes.move(SeparatorId(5), repeated); }), HasSubstr("separator 5"));
  EXPECT_THAT(refused([&] { classes.remove(SeparatorId(5)); }), HasSubstr("separator 5"));
  EXPECT_THAT(refused([&] { classes.remove(PointId(5)); }), HasSubstr("point 5"));
  EXPECT_THAT(refused([&] { classes.set_value(PointId(5), 1); }), HasSubstr("point 5"));
  EXPECT_THAT(refused([&] { classes.move(PointId(5), {0, 0}); }), HasSubstr("point 5"));
  EXPECT_THAT(refused([&] { classes.move(point, unusable); }), HasSubstr("not usable"));
  EXPECT_NE(refused([&] { classes.insert(unusable); }), "");
  EXPECT_NE(refused([&] { classes.insert(one, std::vector<double>{1, 2}); }), "");
}

TEST(Classes, CopiesAreIndependent) {
  Classes classes;
  const PointId point = classes.insert({1, 1});
  const SeparatorId line = classes.insert_separator(std::vector<Point>{{0, 0}, {1, 0}});
  Classes copy = classes;
  copy.translate(line, {0, 5});
  EXPECT_EQ(classes.sign(point, line), to_left);
  EXPECT_EQ(copy.sign(point, line), to_right);
}

}  // namespace
}  // namespace loft::fields
