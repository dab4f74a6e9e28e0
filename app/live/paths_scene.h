// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/live/dice.h"
#include "app/live/scene.h"
#include "io/planar/map.h"
#include "paths/planner.h"

namespace loft::app {

/// Tab Paths: a room with boxes and walls, and agents, discs of one size, that walk to goals one
/// after the other, each its shortest way; a way that an edit breaks, or makes needless, is looked
/// for anew from where the agent is then.
///
///     move      a box or wall; of an agent: its goal
///     insert    points of a box; with the name `wall` a line; with `agent` where it starts
///     remove    a box, a wall, an agent
///     set       radius (value), pace (value, a second)
///
/// It knows `channel` (id): the triangles that an agent's way may be in, and `widest`, the radius
/// of the largest disc that gets to its goal from where it is; `clearance` (at): the distance to
/// the nearest thing in the way.
class PathsScene : public Scene {
 public:
  PathsScene();
  /// Polygons are boxes, lines walls; agents start at the points, or some anywhere.
  explicit PathsScene(const io::Map& map);

  [[nodiscard]] Json state() const override;
  Json apply(const Edit& edit) override;
  [[nodiscard]] Json answer(const Question& question) override;
  Json advance(double seconds) override;
  [[nodiscard]] const cdt::Triangulation& mesh() const override { return overlay_.triangulation(); }
  [[nodiscard]] const paths::FreeSpace& space() const { return *space_; }

  struct Agent {
    paths::PathId path;
    paths::Path way;  ///< from where it was at `since`
    cdt::Point from;
    cdt::Point goal;
    double since = 0;
    double next_try = 0;  ///< of an agent without a way
    int replans = 0;      ///< since the last goal
  };
  [[nodiscard]] const std::map<ItemId, Agent>& agents() const { return agents_; }
  [[nodiscard]] cdt::Point place_of(const Agent& agent) const;

 private:
  static constexpr std::size_t most_agents = 1000;

  void frame(const cdt::Box& box);
  ItemId add_item(Item item);
  ItemId add_box(overlay::Ring ring) {
    return add_item({.name = "box", .rings = {std::move(ring)}});
  }
  ItemId add_wall(overlay::Ring line);
  void add_boxes(Dice& dice, std::size_t count);
  void begin(std::size_t agent_count);
  ItemId add_agent(cdt::Point start);
  void add_agents(std::size_t count);

  [[nodiscard]] double standing_radius(const Agent& agent) const;
  [[nodiscard]] std::optional<cdt::Point> random_place();
  void set_out(Agent& agent);
  void choose_goal(Agent& agent);
  void plan(Agent& agent, cdt::Point from);
  template <class Do>
  void edit_boxes(Do edit, Json& change);
  void replan_broken(Json& change);

  void move(const Edit& edit, Json& change);
  void insert(const Edit& edit, Json& change);
  void remove(const Edit& edit, Json& change);
  void set(const Edit& edit, Json& change);
  [[nodiscard]] Json as_json(ItemId id, const Agent& agent) const;
  [[nodiscard]] Json as_json(ItemId id, const Item& item) const;
  [[nodiscard]] Json channel_of(const Agent& agent) const;
  void add_agent_to(Json& change, ItemId id) const;

  overlay::Overlay overlay_;
  overlay::LayerId frame_ = overlay_.add_layer("frame");
  overlay::LayerId boxes_ = overlay_.add_layer("boxes", overlay::FillRule::nonzero);
  overlay::LayerId walls_ = overlay_.add_layer("walls");
  cdt::Box box_;
  std::map<ItemId, Item> items_;
  std::map<ItemId, Agent> agents_;
  ItemId next_ = 1;
  std::optional<paths::FreeSpace> space_;
  std::optional<paths::Planner> planner_;
  std::vector<paths::PathId> broken_;  // by the last edit; sorted
  Dice dice_{7};
  double radius_ = 0;
  double pace_ = 0;
  double time_ = 0;
};

}  // namespace loft::app
