// SPDX-License-Identifier: MIT
#include "app/live/paths_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "io/planar/path_points.h"
#include "overlay/area.h"
#include "paths/channel.h"
#include "paths/clearance.h"
#include "paths/walk.h"

namespace loft::app {

namespace {

using cdt::Point;
using overlay::Expression;
using overlay::Ring;
using paths::Path;
using paths::Status;

constexpr double pause = 0.5;  // seconds between attempts of an agent that has no way

/// 4 to 8 corners on an ellipse.
Ring random_ring(Dice& dice, Point middle, double across, double deep) {
  const int count = static_cast<int>(dice.between(4, 9));
  const double turn = dice.between(0, std::numbers::pi);
  Ring ring;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (i + dice.between(-0.2, 0.2)) / count;
    const double x = across * std::cos(angle);
    const double y = deep * std::sin(angle);
    ring.push_back({middle.x + std::cos(turn) * x - std::sin(turn) * y,
                    middle.y + std::sin(turn) * x + std::cos(turn) * y});
  }
  return ring;
}

void add_all(cdt::Box& box, std::span<const Point> points) {
  for (const Point& p : points) box.add(p);
}

cdt::Box box_around(const io::Map& map) {
  cdt::Box box;
  for (const io::Feature& feature : map.features) {
    for (const overlay::Polygon& polygon : feature.polygons) add_all(box, polygon.outer);
    for (const auto& line : feature.lines) add_all(box, line);
    add_all(box, feature.points);
  }
  return box;
}

double extent_of(const cdt::Box& box) {
  return std::max(box.high.x - box.low.x, box.high.y - box.low.y);
}

}  // namespace

// --- What there is at first ---

PathsScene::PathsScene() {
  frame({{0, 0}, {160, 100}});
  add_wall({{52, 0}, {52, 38}});
  add_wall({{52, 52}, {52, 100}});
  add_wall({{108, 0}, {108, 20}});
  add_wall({{108, 34}, {108, 72}});
  add_wall({{108, 86}, {108, 100}});
  add_wall({{52, 62}, {84, 62}});
  Dice dice(11);
  add_boxes(dice, 14);
  begin(8);
}

PathsScene::PathsScene(const io::Map& map) {
  cdt::Box box = box_around(map);
  const double margin = extent_of(box) > 0 ? extent_of(box) / 10 : 1;
  frame({{box.low.x - margin, box.low.y - margin}, {box.high.x + margin, box.high.y + margin}});
  std::vector<Point> starts;
  for (const io::Feature& feature : map.features) {
    for (const overlay::Polygon& polygon : feature.polygons) {
      add_item({.name = "box", .rings = directed_rings(polygon)});
    }
    for (const auto& line : feature.lines) add_wall(line);
    starts.insert(starts.end(), feature.points.begin(), feature.points.end());
  }
  begin(starts.empty() ? 8 : 0);
  if (starts.size() > most_agents) starts.resize(most_agents);
  for (const Point start : starts) add_agent(start);
}

void PathsScene::frame(const cdt::Box& box) {
  box_ = box;
  radius_ = extent_of(box) / 160;
  pace_ = extent_of(box) / 14;
  const auto& [low, high] = box;
  overlay_.insert(frame_, Ring{low, {high.x, low.y}, high, {low.x, high.y}});
}

ItemId PathsScene::add_item(Item item) {
  item.layer = item.ends == overlay::open ? walls_ : boxes_;
  for (const Ring& ring : item.rings)
    item.ids.push_back(overlay_.insert(item.layer, ring, item.ends));
  items_.emplace(next_, std::move(item));
  return next_++;
}

ItemId PathsScene::add_wall(Ring line) {
  return add_item({.name = "wall", .rings = {std::move(line)}, .ends = overlay::open});
}

/// Apart from one another, as if they were round.
void PathsScene::add_boxes(Dice& dice, std::size_t count) {
  std::vector<std::pair<Point, double>> there;
  while (there.size() < count) {
    const double across = dice.between(5, 10);
    const Point middle{dice.between(box_.low.x + across, box_.high.x - across),
                       dice.between(box_.low.y + across, box_.high.y - across)};
    const bool is_apart = std::ranges::all_of(there, [&](const auto& other) {
      return std::hypot(middle.x - other.first.x, middle.y - other.first.y) >
             across + other.second + 3;
    });
    if (!is_apart) continue;
    there.emplace_back(middle, across);
    add_box(directed(random_ring(dice, middle, across, dice.between(0.6, 1) * across), 1));
  }
}

/// Once all that is in the way is there.
void PathsScene::begin(std::size_t agent_count) {
  space_.emplace(overlay_, Expression(frame_) - boxes_, std::span(&walls_, 1));
  space_->keep_gaps();
  planner_.emplace(*space_);
  for (std::size_t i = 0; i < agent_count; ++i)
    if (const auto start = random_place()) add_agent(*start);
}

// --- Agents ---

ItemId PathsScene::add_agent(Point start) {
  Agent agent{.path = planner_->keep({.from = start, .to = start}, paths::Wish::shortest),
              .way = {},
              .from = start,
              .goal = start};
  agent.way.status = Status::found;
  agent.since = time_;
  choose_goal(agent);
  agents_.emplace(next_, std::move(agent));
  return next_++;
}

Point PathsScene::place_of(const Agent& agent) const {
  return paths::point_along(agent.way, agent.from, pace_ * (time_ - agent.since));
}

/// Where it stands is rounded, so that it may be nearer to a corner than its radius, by a hair: it
/// gets as much thinner each time.
double PathsScene::standing_radius(const Agent& agent) const {
  const double hair = 0x1p-40 * (radius_ + 0x1p-8 * extent_of(box_));
  return std::max(0.0, radius_ - hair * agent.replans);
}

/// Where an agent can stand; none where that is hard to find.
std::optional<Point> PathsScene::random_place() {
  for (int i = 0; i < 50; ++i) {
    const Point p{dice_.between(box_.low.x, box_.high.x), dice_.between(box_.low.y, box_.high.y)};
    if (cdt::Triangulation::is_usable(p) && is_clear(*space_, p, 1.2 * radius_)) return p;
  }
  return {};
}

/// The next goal of an agent that is there, or can never be.
void PathsScene::choose_goal(Agent& agent) {
  const Point here = place_of(agent);
  for (int i = 0; i < 4; ++i) {
    const auto goal = random_place();
    if (!goal) break;
    agent.goal = *goal;
    agent.replans = is_clear(*space_, here, radius_) ? 1 : agent.replans + 1;
    plan(agent, here);
    if (agent.way.status != Status::unreachable) return;
  }
  plan(agent, here);
}

void PathsScene::plan(Agent& agent, Point from) {
  agent.from = from;
  agent.since = time_;
  planner_->change(agent.path, {.from = from, .to = agent.goal, .radius = standing_radius(agent)});
  agent.way = planner_->path(agent.path);
  agent.next_try = time_ + pause;
}

Json PathsScene::advance(double seconds) {
  time_ += seconds;
  Json change;
  for (auto& [id, agent] : agents_) {
    const bool is_walking = agent.way.status == Status::found;
    if (is_walking && pace_ * (time_ - agent.since) < agent.way.length) continue;
    if (!is_walking && time_ < agent.next_try) continue;
    choose_goal(agent);
    add_agent_to(change, id);
  }
  if (!change.is_null()) {
    change["time"] = time_;
    add_cost(change);
  }
  return change;
}

void PathsScene::add_agent_to(Json& change, ItemId id) const {
  change["agents"].push_back(as_json(id, agents_.at(id)));
}

/// After an edit: those whose way is broken, or may be shorter now, and those that wait.
void PathsScene::replan_broken(Json& change) {
  Stopwatch stopwatch;
  for (auto& [id, agent] : agents_) {
    const bool is_waiting = agent.way.status != Status::found;
    if (!is_waiting && !std::ranges::binary_search(broken_, agent.path)) continue;
    const Point here = place_of(agent);
    ++agent.replans;
    plan(agent, here);
    if (agent.way.status == Status::goal_blocked) choose_goal(agent);
    add_agent_to(change, id);
  }
  change["planning"] = 1e6 * stopwatch.lap();
}

// --- What the page is told ---

Json PathsScene::as_json(ItemId id, const Agent& agent) const {
  Json json{{"id", id},
            {"status", paths::name_of(agent.way.status)},
            {"since", agent.since},
            {"goal", app::as_json(agent.goal)}};
  const bool is_found = agent.way.status == Status::found;
  json["way"] = is_found ? flat(io::points_along(agent.way, agent.from)) : flat({{agent.from}});
  json["length"] = is_found ? Json(agent.way.length) : Json(nullptr);
  return json;
}

Json PathsScene::as_json(ItemId id, const Item& item) const {
  Json json{{"id", id}, {"kind", item.name}, {"at", app::as_json(item.at)}};
  json["rings"] = Json::array();
  for (const Ring& ring : item.rings) json["rings"].push_back(flat(ring));
  return json;
}

Json PathsScene::state() const {
  Json state{{"box", app::as_json(box_)}, {"radius", radius_}, {"pace", pace_}, {"time", time_}};
  state["largest_radius"] = extent_of(box_) / 20;
  state["items"] = Json::array();
  for (const auto& [id, item] : items_) state["items"].push_back(as_json(id, item));
  state["agents"] = Json::array();
  for (const auto& [id, agent] : agents_) state["agents"].push_back(as_json(id, agent));
  add_cost(state);
  return state;
}

Json PathsScene::answer(const Question& question) {
  if (question.what == "channel") {
    const auto agent = agents_.find(question.id.value_or(0));
    if (agent == agents_.end()) throw Refusal(404, "there is no such agent");
    return channel_of(agent->second);
  }
  if (question.what == "clearance" && question.at)
    return {{"clearance", paths::clearance(*space_, *question.at)}};
  return Scene::answer(question);
}

Json PathsScene::channel_of(const Agent& agent) const {
  const Point here = place_of(agent);
  paths::ChannelSearch search;
  paths::Channel channel;
  search.find(*space_, here, agent.goal, channel);
  std::vector<Point> corners;
  for (const cdt::TriangleId t : channel.triangles)
    for (const unsigned corner : {0U, 1U, 2U})
      corners.push_back(mesh().point(mesh().from(cdt::Triangulation::edge(t, corner))));
  return {{"triangles", flat(corners)},
          {"widest", paths::widest(*space_, here, agent.goal)},
          {"clearance", paths::clearance(*space_, here)}};
}

// --- Edits ---

Json PathsScene::apply(const Edit& edit) {
  Json change;
  switch (edit.kind) {
    case Edit::Kind::move:
      move(edit, change);
      break;
    case Edit::Kind::reshape:
      throw Refusal(422, "boxes are moved, not bent");
    case Edit::Kind::insert:
      insert(edit, change);
      break;
    case Edit::Kind::remove:
      remove(edit, change);
      break;
    case Edit::Kind::set:
      set(edit, change);
  }
  change["time"] = time_;
  add_cost(change);
  return change;
}

/// What an edit does to the overlay, then to all that stands on it.
template <class Do>
void PathsScene::edit_boxes(Do edit, Json& change) {
  measure_edit([&] {
    overlay_.begin_batch();
    try {
      edit();
    } catch (...) {
      overlay_.end_batch();
      space_->follow();
      throw;
    }
    overlay_.end_batch();
    space_->follow();
    const auto broken = planner_->after_edit();
    broken_.assign(broken.begin(), broken.end());
  });
  replan_broken(change);
}

void PathsScene::move(const Edit& edit, Json& change) {
  if (const auto agent = agents_.find(*edit.id); agent != agents_.end()) {
    agent->second.goal = *edit.at;
    ++agent->second.replans;
    measure_edit([&] { plan(agent->second, place_of(agent->second)); });
    return add_agent_to(change, *edit.id);
  }
  const auto item = items_.find(*edit.id);
  if (item == items_.end()) throw Refusal(422, "there is no such box, wall or agent");
  require_usable(item->second, *edit.at);
  edit_boxes([&] { place(overlay_, item->second, *edit.at); }, change);
  change["moved"] = Json::array({{{"id", *edit.id}, {"at", app::as_json(*edit.at)}}});
}

void PathsScene::insert(const Edit& edit, Json& change) {
  if (items_.size() >= most_items || agents_.size() >= most_agents)
    throw Refusal(422, "there is as much as there may be");
  if (edit.name == "agent") {
    ItemId id = 0;
    measure_edit([&] { id = add_agent(edit.points.front()); });
    return add_agent_to(change, id);
  }
  Item item{.name = edit.name == "wall" ? "wall" : "box", .rings = {edit.points}};
  if (edit.name == "wall")
    item.ends = overlay::open;
  else
    item.rings.front() = directed(std::move(item.rings.front()), 1);
  const ItemId id = next_;
  edit_boxes([&] { add_item(std::move(item)); }, change);
  change["items"] = Json::array({as_json(id, items_.at(id))});
}

void PathsScene::remove(const Edit& edit, Json& change) {
  if (const auto agent = agents_.find(*edit.id); agent != agents_.end()) {
    measure_edit([&] { planner_->forget(agent->second.path); });
    agents_.erase(agent);
  } else {
    const auto item = items_.find(*edit.id);
    if (item == items_.end()) throw Refusal(422, "there is no such box, wall or agent");
    edit_boxes(
        [&] { std::ranges::for_each(item->second.ids, [&](auto id) { overlay_.remove(id); }); },
        change);
    items_.erase(item);
  }
  change["removed"] = Json::array({*edit.id});
}

void PathsScene::set(const Edit& edit, Json& change) {
  const double value = edit.value.value_or(-1);
  const bool is_radius = edit.name == "radius";
  const double largest = is_radius ? extent_of(box_) / 20 : extent_of(box_);
  if (!(is_radius || edit.name == "pace") || !(value >= 0) || value > largest)
    throw Refusal(422,
                  "radius and pace can be set, to a twentieth of the room and its size at most");
  measure_edit([&] {
    std::vector<Point> here;
    for (const auto& [id, agent] : agents_) here.push_back(place_of(agent));
    (is_radius ? radius_ : pace_) = value;
    auto next = here.begin();
    for (auto& [id, agent] : agents_) {
      ++agent.replans;
      plan(agent, *next++);
    }
  });
  for (const auto& [id, agent] : agents_) add_agent_to(change, id);
  change["radius"] = radius_;
  change["pace"] = pace_;
}

}  // namespace loft::app
