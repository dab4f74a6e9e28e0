// SPDX-License-Identifier: MIT
// The scenes of the live page.
#include "app/live/scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "app/live/classes_scene.h"
#include "app/live/field_scene.h"
#include "app/live/map_scene.h"
#include "app/live/paths_scene.h"
#include "app/live/shapes_scene.h"
#include "app/live/shared_scene.h"

namespace loft::app {
namespace {

using cdt::Point;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Edit move(ItemId id, Point at) { return {.kind = Edit::Kind::move, .id = id, .at = at}; }
Edit set(const std::string& name, const std::string& text, std::optional<ItemId> id = {}) {
  return {.kind = Edit::Kind::set, .id = id, .name = name, .text = text};
}
Edit set(const std::string& name, double value, std::optional<ItemId> id = {}) {
  return {.kind = Edit::Kind::set, .id = id, .name = name, .value = value};
}
Edit insert(std::vector<Point> points, const std::string& name = "") {
  return {.kind = Edit::Kind::insert, .points = std::move(points), .name = name};
}
Edit remove(ItemId id) { return {.kind = Edit::Kind::remove, .id = id}; }

ItemId id_of(const Json& state, const char* list, const std::string& name) {
  for (const Json& one : state[list])
    if (one["name"] == name) return one["id"].get<ItemId>();
  ADD_FAILURE() << "there is no " << name;
  return 0;
}

// --- What a page knows ---

/// Edges of a border by their ends, each as often as it is there.
using Edges = std::map<std::tuple<double, double, double, double>, int>;

void add_edges(Edges& edges, const Json& flat_ones, int count) {
  for (std::size_t i = 0; i < flat_ones.size(); i += 4) {
    int& sum = edges[{flat_ones[i], flat_ones[i + 1], flat_ones[i + 2], flat_ones[i + 3]}];
    sum += count;
    EXPECT_GE(sum, 0);
    if (sum == 0) edges.erase({flat_ones[i], flat_ones[i + 1], flat_ones[i + 2], flat_ones[i + 3]});
  }
}

/// A page: what it makes of a state and of changes. Lists of things by their ids, borders of
/// results, all else by its name.
class Page {
 public:
  explicit Page(const Json& state) { take(state); }

  void take(const Json& change) {
    for (const auto& [key, value] : change.items()) {
      if (value.is_object() && value.contains("come"))
        take_border(key, value);
      else if (is_list_of_things(value))
        take_things(value);
      else if (is_list_of_points(value))
        for (const Json& point : value) things_[point[0]]["point"] = point;
      else if (key == "removed")
        for (const Json& id : value) things_.erase(id.get<ItemId>());
      else if (!is_about_the_edit(key))
        others_[key] = value;
    }
  }

  friend bool operator==(const Page&, const Page&) = default;

 private:
  static bool is_list_of_things(const Json& value) {
    return value.is_array() && !value.empty() && value[0].is_object() && value[0].contains("id");
  }
  static bool is_list_of_points(const Json& value) {
    return value.is_array() && !value.empty() && value[0].is_array() && value[0].size() == 5;
  }
  static bool is_about_the_edit(const std::string& key) {
    return key == "microseconds" || key == "made" || key == "planning" || key == "box" ||
           key == "time" || value_is_list(key);
  }
  static bool value_is_list(const std::string& key) {
    static const std::set<std::string> lists{"parts",  "items", "agents",     "samples",
                                             "lines",  "moved", "separators", "points",
                                             "shapes", "nodes", "removed"};
    return lists.contains(key);
  }
  void take_border(const std::string& key, const Json& border) {
    Edges& edges = borders_[key];
    if (border.contains("gone"))
      add_edges(edges, border["gone"], -1);
    else
      edges.clear();
    add_edges(edges, border["come"], 1);
    others_[key] = border["area"];
  }
  void take_things(const Json& list) {
    for (const Json& thing : list)
      for (const auto& [key, value] : thing.items()) things_[thing["id"]][key] = value;
  }

  std::map<std::string, Edges> borders_;
  std::map<ItemId, std::map<std::string, Json>> things_;
  std::map<std::string, Json> others_;
};

/// Edits that make sense, and some that make none.
class RandomEdits {
 public:
  explicit RandomEdits(unsigned seed) : random_(seed) {}

  Edit next() {
    switch (pick(12)) {
      case 0:
        return insert(ring(), pick(2) == 0 ? "wall" : pick(2) == 0 ? "agent" : "");
      case 1:
        return remove(id());
      case 2:
        return set("operation", pick(2) == 0 ? "subtract" : "exclude", id());
      case 3:
        return set("parent", id(), id());
      case 4:
        return set("angle", number(3), id());
      case 5:
        return set("expression", pick(2) == 0 ? "at_least(2, bore, body, port)" : "");
      case 6:
        return set("radius", std::abs(number(3)));
      case 7:
        return {.kind = Edit::Kind::reshape, .id = id(), .points = ring()};
      case 8:
        return move(id(), {pick(2) == 0 ? 1e75 : 1e-50, 0});
      default:
        return move(id(), {number(60), number(60)});
    }
  }

 private:
  unsigned pick(unsigned bound) { return static_cast<unsigned>(random_() % bound); }
  ItemId id() { return pick(40); }
  double number(double size) { return std::uniform_real_distribution<>(-size, size)(random_); }
  std::vector<Point> ring() {
    std::vector<Point> points;
    const Point middle{number(60), number(40)};
    for (unsigned i = 0; i < 3 + pick(6); ++i)
      points.push_back({middle.x + number(12), middle.y + number(12)});
    return points;
  }

  std::mt19937 random_;
};

class AnyScene : public ::testing::TestWithParam<std::string> {};

TEST_P(AnyScene, IsKnownFromItsStateAndChanges) {
  const auto scene = make_scene(GetParam(), nullptr);
  Page page(scene->state());
  RandomEdits edits(5);
  int taken = 0;
  for (int i = 0; i < 300; ++i) {
    try {
      page.take(scene->apply(edits.next()));
      ++taken;
    } catch (const Refusal&) {
    } catch (const std::invalid_argument&) {
    }
    if (const Json change = scene->advance(0.05); !change.is_null()) page.take(change);
    if (i % 10 != 0) continue;
    ASSERT_EQ(page, Page(scene->state())) << i;
  }
  EXPECT_GT(taken, 60);
}

TEST_P(AnyScene, IsAsBeforeAfterARefusal) {
  const auto scene = make_scene(GetParam(), nullptr);
  const Page before(scene->state());
  const std::vector<Edit> refused{move(4'000'000'000, {0, 0}), remove(0),
                                  remove(4'000'000'000),       set("nothing", 1.0),
                                  set("nothing", "x"),         set("expression", "no such | name"),
                                  set("radius", -1.0),         set("parent", 1.0, 1U)};
  for (const Edit& edit : refused) {
    EXPECT_ANY_THROW(scene->apply(edit)) << edit.name;
    EXPECT_EQ(Page(scene->state()), before) << edit.name;
  }
}

TEST_P(AnyScene, TellsAllItsEdges) {
  const auto scene = make_scene(GetParam(), nullptr);
  const std::string bytes = edges_as_bytes(scene->mesh());
  EXPECT_EQ(bytes.size() % 16, 0U);
  // Euler: edges of a triangulated convex hull, and the line of their number.
  EXPECT_GT(bytes.size() / 16, 2 * scene->mesh().vertex_count());
  EXPECT_LT(bytes.size() / 16, 3 * scene->mesh().vertex_count());
}

TEST_P(AnyScene, RefusesWhatItDoesNotKnow) {
  const auto scene = make_scene(GetParam(), nullptr);
  EXPECT_THROW(static_cast<void>(scene->answer({.what = "weather"})), Refusal);
  EXPECT_THROW(static_cast<void>(scene->answer({.what = "channel", .id = 4'000'000'000U})),
               Refusal);
}

INSTANTIATE_TEST_SUITE_P(Tabs, AnyScene, ::testing::ValuesIn(tab_names()),
                         [](const auto& tab) { return tab.param; });

// --- Shapes ---

TEST(ShapesScene, FollowsAHoleThatMoves) {
  ShapesScene scene;
  const ItemId port = id_of(scene.state(), "nodes", "port");
  const double before = scene.solid().area().to_double();
  const Json inside = scene.apply(move(port, {0, 0}));  // within the bore
  EXPECT_GT(inside["result"]["area"], before + 180);
  EXPECT_EQ(scene.apply(move(port, {52, 0}))["result"]["area"], before);
}

TEST(ShapesScene, MovesAGroupAsOne) {
  ShapesScene scene;
  const ItemId slots = id_of(scene.state(), "nodes", "slots");
  const double before = scene.solid().area().to_double();
  const Json change = scene.apply(move(slots, {-48, 0}));
  EXPECT_NEAR(change["result"]["area"].get<double>(), before, 1e-9);
  EXPECT_EQ(change["nodes"].size(), 1U);
  EXPECT_FALSE(change["result"]["come"].empty());
}

TEST(ShapesScene, ShowsAnExpressionUntilTheTreeIsWanted) {
  ShapesScene scene;
  const Json shown = scene.apply(set("expression", "bore & body"));
  EXPECT_TRUE(shown["is_typed"]);
  EXPECT_NEAR(shown["result"]["area"].get<double>(), 1254.6, 0.1);  // of the bore
  EXPECT_EQ(shown["expression"], "bore & body");
  EXPECT_THROW(scene.apply(set("expression", "bore &")), Refusal);
  EXPECT_THROW(scene.apply(set("expression", "~bore")), Refusal);
  EXPECT_TRUE(scene.state()["is_typed"]);
  EXPECT_FALSE(scene.apply(set("expression", " "))["is_typed"]);
  EXPECT_EQ(scene.state()["result"]["area"], scene.solid().area().to_double());
}

TEST(ShapesScene, ForgetsAnExpressionWithShapesThatAreGone) {
  ShapesScene scene;
  scene.apply(set("expression", "bore | port"));
  scene.apply(remove(id_of(scene.state(), "nodes", "bolt")));
  EXPECT_TRUE(scene.state()["is_typed"]);
  scene.apply(remove(id_of(scene.state(), "nodes", "port")));
  EXPECT_FALSE(scene.state()["is_typed"]);
}

TEST(ShapesScene, TakesShapesIntoAnyOperation) {
  ShapesScene scene;
  Edit edit = insert({{-2, 20}, {2, 20}, {2, 25}, {-2, 25}}, "notch");
  edit.id = id_of(scene.state(), "nodes", "cuts");
  const double before = scene.solid().area().to_double();
  const Json change = scene.apply(edit);
  EXPECT_NEAR(change["result"]["area"].get<double>(), before - 20 + 0.02, 0.3);
  EXPECT_EQ(change["shapes"][0]["name"], "notch");
  EXPECT_EQ(scene.apply(edit)["shapes"][0]["name"], "notch2");
}

// --- Map ---

TEST(MapScene, LightsUpWhatAnIslandCovers) {
  MapScene scene;
  const Json state = scene.state();
  ItemId island = 0;
  for (const Json& part : state["parts"])
    if (part["name"] == "Zelos") island = part["id"].get<ItemId>();
  const double before = state["overlaps"]["area"].get<double>();
  const Json change = scene.apply(move(island, {-36, -57}));
  EXPECT_GT(change["overlaps"]["area"], before + 100);
  const Json here = scene.answer({.what = "owners", .at = Point{72, 60}});
  EXPECT_THAT(here["inside"], Contains("Zelos"));
  EXPECT_EQ(here["inside"].size(), 2U);
  const Json faults = scene.answer({.what = "faults"});
  EXPECT_GE(faults["overlap_count"], 1U);
  EXPECT_EQ(scene.apply(move(island, {0, 0}))["overlaps"]["area"], before);
}

TEST(MapScene, NothingLeavesThePlane) {
  const io::Map map{{{.polygons = {{{{0, 0}, {6e74, 0}, {6e74, 1}}, {}}}}}, ""};
  MapScene scene(map);
  EXPECT_THROW(scene.apply(move(1, {6e74, 0})), Refusal);
  EXPECT_EQ(scene.state()["parts"][0]["at"], as_json(Point{0, 0}));
}

TEST(MapScene, IslandsBesideTheirOwnLandAreNoHoles) {
  const io::Map map{{{.polygons = {{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {}},
                                   {{{6, 0}, {6, 2}, {8, 2}, {8, 0}}, {}}},
                      .properties = R"({"name": "A"})"}},
                    ""};
  MapScene scene(map);
  EXPECT_EQ(scene.state()["land"]["area"], 20.0);
  EXPECT_EQ(scene.apply(move(2, {-5, 1}))["land"]["area"], 16.0);
}

// --- Paths ---

TEST(PathsScene, AgentsWalkFromGoalToGoal) {
  PathsScene scene;
  std::map<ItemId, Point> goals;
  for (const auto& [id, agent] : scene.agents()) goals[id] = agent.goal;
  std::size_t others = 0;
  for (int i = 0; i < 600; ++i) {
    const Json change = scene.advance(0.1);
    if (!change.is_null()) others += change["agents"].size();
    for (const auto& [id, agent] : scene.agents())
      EXPECT_TRUE(scene.space().is_free(scene.place_of(agent)));
  }
  EXPECT_GT(others, goals.size());
}

TEST(PathsScene, ABoxInTheWayIsWalkedAround) {
  PathsScene scene;
  scene.apply(set("radius", 0.5));
  auto& [id, agent] = *scene.agents().begin();
  const Point goal = scene.place_of(agent);
  scene.apply(move(id, {goal.x + 1e-3, goal.y}));
  for (int i = 0; i < 30; ++i) scene.advance(0.1);
  for (int i = 0; i < 200; ++i) {
    const auto& walker = scene.agents().begin()->second;
    const Point at = scene.place_of(walker);
    const Json change =
        scene.apply(insert({{at.x + 2, at.y - 1}, {at.x + 3, at.y - 1}, {at.x + 3, at.y + 1}}));
    const ItemId box = change["items"][0]["id"];
    scene.advance(0.05);
    EXPECT_TRUE(scene.space().is_free(scene.place_of(walker)));
    scene.apply(remove(box));
  }
}

TEST(PathsScene, SaysHowWideAWayIs) {
  const io::Map map{{{.polygons = {{{{0, 0}, {10, 0}, {10, 4}, {0, 4}}, {}},
                                   {{{0, 8}, {10, 8}, {10, 12}, {0, 12}}, {}}}},
                     {.points = {{-0.5, 6}}}},
                    ""};
  PathsScene scene(map);
  const ItemId agent = scene.agents().begin()->first;
  scene.apply(set("pace", 0.0));
  scene.apply(move(agent, {10.5, 6}));
  const Json known = scene.answer({.what = "channel", .id = agent});
  EXPECT_NEAR(known["widest"].get<double>(), 0.7, 1e-9);  // beside the frame
  EXPECT_FALSE(known["triangles"].empty());
  EXPECT_NEAR(scene.answer({.what = "clearance", .at = Point{5, 6}})["clearance"].get<double>(), 2,
              1e-12);
}

// --- Field ---

TEST(FieldScene, FollowsASampleAndTellsTheProfile) {
  const io::Map map{{{.points = {{0, 0}}, .properties = R"({"value": 1})"},
                     {.points = {{4, 0}}, .properties = R"({"value": 5})"},
                     {.points = {{0, 4}}, .properties = R"({"value": 1})"},
                     {.points = {{4, 4}}, .properties = R"({"value": 5})"}},
                    ""};
  FieldScene scene(map);
  const auto value = [&](Point p) { return scene.answer({.what = "value", .at = p})["value"]; };
  EXPECT_EQ(value({2, 2}), 3.0);
  EXPECT_TRUE(value({9, 9}).is_null());
  EXPECT_EQ(scene.apply(set("value", 9.0, 2U))["samples"][0]["value"], 9.0);
  EXPECT_EQ(value({4, 0}), 9.0);
  const ItemId profile = scene.state()["profile"];
  Edit edit{.kind = Edit::Kind::reshape, .id = profile, .points = {{0, 4}, {4, 4}}};
  scene.apply(edit);
  const Json told = scene.answer({.what = "profile"});
  EXPECT_EQ(told["points"].front(), Json::array({0.0, 1.0, 1.0}));
  EXPECT_EQ(told["points"].back()[1], 5.0);
  EXPECT_EQ(told["up"], 4.0);
  EXPECT_THROW(scene.apply(remove(profile)), Refusal);
}

TEST(FieldScene, ItsDamHoldsTheLake) {
  FieldScene scene;
  const auto value = [&](double x) {
    return scene.answer({.what = "value", .at = Point{x, 63}})["value"].get<double>();
  };
  const double lake = 112;
  EXPECT_EQ(value(50), lake);
  EXPECT_LT(value(69), lake - 10);
  EXPECT_FALSE(scene.answer({.what = "isolines"})["lines"].empty());
  const auto raster = scene.bytes({.what = "raster"});
  EXPECT_GT(raster->size(), 4U * 280 * 170);
}

// --- Classes ---

TEST(ClassesScene, TellsWhichPointsHaveChanged) {
  const io::Map map{{{.points = {{1, 1}, {3, 1}, {1, 3}, {3, 3}}},
                     {.lines = {{{2, 0}, {2, 4}}}},
                     {.lines = {{{0, 2}, {4, 2}}}}},
                    ""};
  ClassesScene scene(map);
  const Json state = scene.state();
  EXPECT_EQ(state["points"][0], Json::array({1, 1.0, 1.0, 0.0, "+-"}));
  EXPECT_EQ(state["faces"].size(), 4U);
  const ItemId first = state["separators"][0]["id"];
  EXPECT_TRUE(scene.apply(move(first, {0.5, 0}))["points"].empty());
  const Json change = scene.apply(move(first, {1.5, 0}));
  EXPECT_EQ(change["points"].size(), 2U);
  EXPECT_EQ(change["points"][0][4], "+-");
  EXPECT_THAT(change["separators"][0]["at"], ElementsAre(1.5, 0.0));
}

// --- Which tab ---

TEST(Tabs, AreChosenByWhatIsInAMap) {
  const io::Feature square{.polygons = {{{{0, 0}, {1, 0}, {1, 1}}, {}}}};
  io::Feature named = square;
  named.properties = R"({"name": "A"})";
  const io::Feature line{.lines = {{{0, 0}, {1, 1}}}};
  EXPECT_EQ(tab_for({{square, named}, ""}), "shapes");
  EXPECT_EQ(tab_for({{named, named}, ""}), "map");
  EXPECT_EQ(tab_for({{named, line}, ""}), "paths");
  EXPECT_EQ(tab_for({{line}, ""}), "classes");
  const io::Feature sample{.points = {{0, 0}}, .properties = R"({"value": 1})"};
  EXPECT_EQ(tab_for({{sample, line}, ""}), "field");
}

TEST(Tabs, TakeAnyMap) {
  io::Map map{{{.polygons = {{{{0, 0}, {0, 0}}, {}}, {{}, {}}}}, {.lines = {{}, {{1, 1}}}}, {}},
              ""};
  map.features[0].polygons[1].outer = {{1, 1}};
  map.features[1].lines[0] = {{2, 2}, {3, 3}};
  for (const std::string& tab : tab_names()) {
    const auto scene = make_scene(tab, &map);
    EXPECT_FALSE(scene->state().is_null()) << tab;
    static_cast<void>(scene->advance(1));
  }
}

// --- Among pages ---

TEST(SharedScene, TellsPagesWhatTheyHaveMissed) {
  SharedScene scene(std::make_unique<ShapesScene>());
  const auto [state, next] = scene.state();
  EXPECT_EQ(next, 1U);
  const Json answer = scene.apply(R"({"do": "move", "id": 2, "at": [1, 1]})");
  EXPECT_EQ(answer["event"], 1U);
  EXPECT_GT(answer["microseconds"], 0);
  const auto reading = scene.feed().read(1, std::chrono::milliseconds(0));
  EXPECT_THAT(reading.data, HasSubstr("\"result\""));
  EXPECT_EQ(scene.state().second, 2U);
}

TEST(SharedScene, RefusesWithAStatusWhateverIsThrown) {
  SharedScene scene(std::make_unique<PathsScene>());
  const auto status = [&](const std::string& text) {
    try {
      scene.apply(text);
      return 200;
    } catch (const Refusal& refused) {
      return refused.status();
    }
  };
  EXPECT_EQ(status("{"), 400);
  EXPECT_EQ(status(R"({"do": "move", "id": 99999, "at": [0, 0]})"), 422);
  EXPECT_EQ(status(R"({"do": "set", "name": "radius", "value": 2})"), 200);
}

}  // namespace
}  // namespace loft::app
