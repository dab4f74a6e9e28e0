// SPDX-License-Identifier: MIT
// Figure 6 of Kallmann, Bieri and Thalmann (2003): one constraint is moved over many that overlap;
// forty agents go their ways among polygons, all of them constraints of one triangulation:
// moving_shapes FOLDER
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "cdt/triangulation.h"
#include "io/planar/path_points.h"
#include "overlay/overlay.h"
#include "paths/distance.h"
#include "paths/shortest.h"
#include "samples/drawing.h"

namespace {

using loft::cdt::ConstraintId;
using loft::cdt::Triangulation;
using loft::io::dark_tone;
using loft::io::full_tone;
using loft::overlay::Expression;
using loft::overlay::LayerId;
using loft::overlay::Overlay;
using loft::overlay::Ring;
using loft::overlay::RingId;
using samples::Dice;
using samples::Drawing;
using samples::fill;
using samples::Point;
using samples::stroke;

constexpr int frames = 8;

using Clock = std::chrono::steady_clock;
using Microseconds = std::chrono::duration<double, std::micro>;

/// Corners on circles around a place, in turn on an outer and an inner one.
Ring star(Point centre, double outer, double inner, int corners, double turn = 0) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = turn + 2 * std::numbers::pi * i / corners;
    const double radius = i % 2 == 0 ? outer : inner;
    ring.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return ring;
}

/// Squares side by side, which share edges, and polygons across them, two of them the same.
std::vector<Ring> shapes_that_overlap(Dice& dice) {
  std::vector<Ring> rings;
  for (const double x : {24.0, 48.0, 72.0})
    rings.push_back({{x, 26}, {x + 24, 26}, {x + 24, 50}, {x, 50}});
  for (int i = 0; i < 12; ++i) {
    const Point centre{18.0 + 7.5 * i + dice.between(-2, 2), i % 2 == 0 ? 54.0 : 22.0};
    const double radius = dice.between(9, 15);
    rings.push_back(star(centre, radius, radius, 4 + i % 5, dice.between(0, 3)));
  }
  rings.push_back(rings.back());
  return rings;
}

void move_one(const std::string& path) {
  Dice dice(5);
  Triangulation mesh;
  std::vector<ConstraintId> others;
  for (const Ring& ring : shapes_that_overlap(dice))
    others.push_back(mesh.insert(ring, loft::cdt::closed));
  const ConstraintId moved = mesh.insert(star({13, 60}, 10, 5, 12), loft::cdt::closed);

  Drawing drawing(path, "One constraint is moved",
                  {.shown = {{0, 0}, {120, 76}}, .columns = 4, .rows = 2, .width = 1000});
  constexpr int steps = 20;  // from picture to picture
  Microseconds took{};
  for (int frame = 0; frame < frames; ++frame) {
    drawing.turn_to(frame);
    for (std::size_t i = 0; i < others.size(); ++i)
      drawing.area({mesh.points(others[i])}, fill(full_tone(i % 6)) + "fill-opacity=\"0.6\"");
    drawing.area({mesh.points(moved)}, fill(full_tone(6)));
    draw_free_edges(drawing, mesh);
    for (std::size_t i = 0; i < others.size(); ++i)
      draw_constraint(drawing, mesh, others[i], dark_tone(i % 6), 1.3);
    draw_constraint(drawing, mesh, moved, dark_tone(6), 2.2);
    drawing.caption(std::to_string(mesh.vertex_count()) + " vertices");
    const auto start = Clock::now();
    for (int step = 0; step < steps; ++step)
      mesh.translate(moved, {13.5 / steps, (frame % 4 < 2 ? -20.0 : 20.0) / steps});
    took += Clock::now() - start;
  }
  drawing.finish();
  std::printf("a star of 12 corners moves over %zu shapes: %.1f us a step\n", others.size(),
              took.count() / (frames * steps));
}

/// Who goes a way, and where he is.
struct Agent {
  std::vector<Point> way;
  Point place;
  RingId ring;
};

/// The point of a line that has a part of it behind it.
Point point_along(const std::vector<Point>& line, double part) {
  using loft::paths::distance_between;
  double left = 0;
  for (std::size_t i = 1; i < line.size(); ++i) left += distance_between(line[i - 1], line[i]);
  left *= part;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point a = line[i - 1];
    const Point b = line[i];
    const double length = distance_between(a, b);
    if (left < length)
      return {a.x + left / length * (b.x - a.x), a.y + left / length * (b.y - a.y)};
    left -= length;
  }
  return line.back();
}

constexpr double width = 160;
constexpr double height = 100;
constexpr double agent_radius = 2;

/// Polygons, and forty agents among them, each with a way to somewhere.
class Crowd {
 public:
  Crowd() {
    overlay_.insert(frame_, Ring{{0, 0}, {width, 0}, {width, height}, {0, height}});
    for (int i = 0; i < 22; ++i) {
      const Point centre{dice_.between(16, width - 16), dice_.between(8, height - 8)};
      const double radius = dice_.between(4, 8);
      overlay_.insert(polygons_, star(centre, radius, radius, 3 + i % 5, dice_.between(0, 3)));
    }
    loft::paths::FreeSpace space(overlay_, Expression(frame_) - polygons_);
    space.keep_gaps();
    for (int i = 0; i < 40; ++i) agents_.push_back(agent_with_long_way(space));
    for (Agent& agent : agents_)  // only now, as the space would have to follow
      agent.ring = overlay_.insert(walkers_, star(agent.place, agent_radius, agent_radius, 6));
  }

  /// All agents move on, as one edit.
  void go_to(double part) {
    const auto start = Clock::now();
    overlay_.begin_batch();
    for (Agent& agent : agents_) {
      const Point next = point_along(agent.way, part);
      overlay_.translate(agent.ring, {next.x - agent.place.x, next.y - agent.place.y});
      agent.place = next;
    }
    overlay_.end_batch();
    took_ += Clock::now() - start;
    ++steps_;
  }

  void draw(Drawing& drawing) const {
    const Triangulation& mesh = overlay_.triangulation();
    for (const RingId ring : overlay_.rings(polygons_))
      drawing.area({mesh.points(ring)}, fill(samples::solid_tone));
    draw_free_edges(drawing, mesh);
    for (const RingId ring : overlay_.rings(polygons_))
      draw_constraint(drawing, mesh, ring, samples::border_tone, 1.2);
    for (std::size_t i = 0; i < agents_.size(); ++i)
      drawing.area({mesh.points(agents_[i].ring)}, fill(dark_tone(i % 2 == 0 ? 6 : 7)));
    drawing.caption(std::to_string(mesh.vertex_count()) + " vertices");
  }

  void report() const {
    std::printf("%zu agents move on: %.1f us all together\n", agents_.size(),
                took_.count() / steps_);
  }

 private:
  Point any_place() { return {dice_.between(3, width - 3), dice_.between(3, height - 3)}; }

  /// From somewhere to somewhere else that is not near.
  Agent agent_with_long_way(const loft::paths::FreeSpace& space) {
    for (;;) {
      const loft::paths::Query query{
          .from = any_place(), .to = any_place(), .radius = agent_radius};
      const loft::paths::Path path = shortest_path(space, query);
      if (path.status == loft::paths::Status::found && path.length > width / 2)
        return {.way = loft::io::points_along(path, query.from), .place = query.from};
    }
  }

  Dice dice_{8};
  Overlay overlay_;
  LayerId frame_ = overlay_.add_layer("frame");
  LayerId polygons_ = overlay_.add_layer("polygons", loft::overlay::FillRule::nonzero);
  LayerId walkers_ = overlay_.add_layer("walkers", loft::overlay::FillRule::nonzero);
  std::vector<Agent> agents_;
  Microseconds took_{};
  int steps_ = 0;
};

void move_many(const std::string& path) {
  Crowd crowd;
  Drawing drawing(path, "Forty agents among polygons",
                  {.shown = {{0, 0}, {width, height}}, .columns = 4, .rows = 2, .width = 1000});
  constexpr int steps = 20;  // from picture to picture
  for (int step = 0; step <= steps * (frames - 1); ++step) {
    crowd.go_to(step / (steps * (frames - 1.0)));
    if (step % steps != 0) continue;
    drawing.turn_to(step / steps);
    crowd.draw(drawing);
  }
  drawing.finish();
  crowd.report();
}

}  // namespace

int main(int argc, char** argv) {
  return samples::run_sample(argc, argv, ".", [](const std::string& folder) {
    move_one(folder + "/figure_6_shapes.svg");
    move_many(folder + "/figure_6_agents.svg");
  });
}
