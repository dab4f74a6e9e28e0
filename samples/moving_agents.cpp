// SPDX-License-Identifier: MIT
// Figure 6 of Kallmann, Bieri and Thalmann (2003), below: forty agents go their ways among
// polygons, all of them constraints of one triangulation: moving_agents moving_agents.svg
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "cdt/triangulation.h"
#include "io/planar/path_points.h"
#include "overlay/overlay.h"
#include "paths/distance.h"
#include "paths/shortest.h"
#include "samples/drawing.h"

namespace {

using loft::overlay::Expression;
using loft::overlay::LayerId;
using loft::overlay::Overlay;
using loft::overlay::Ring;
using loft::overlay::RingId;
using loft::paths::distance_between;
using samples::Dice;
using samples::Drawing;
using samples::fill;
using samples::Point;
using samples::star;

constexpr double width = 160;
constexpr double height = 100;
constexpr double agent_radius = 2;
constexpr int agent_count = 40;

/// Who goes a way, and where he is.
struct Agent {
  std::vector<Point> way;
  Point place;
  RingId ring{};
};

/// The point of a line that has a part of it behind it.
Point point_along(const std::vector<Point>& line, double part) {
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
    for (int i = 0; i < agent_count; ++i) agents_.push_back(agent_with_long_way(space));
    for (Agent& agent : agents_)  // only now, as the space would have to follow
      agent.ring = overlay_.insert(walkers_, star(agent.place, agent_radius, agent_radius, 6));
  }

  /// All agents move on, as one edit.
  void go_to(double part) {
    const auto start = std::chrono::steady_clock::now();
    overlay_.begin_batch();
    for (Agent& agent : agents_) {
      const Point next = point_along(agent.way, part);
      overlay_.translate(agent.ring, {next.x - agent.place.x, next.y - agent.place.y});
      agent.place = next;
    }
    overlay_.end_batch();
    took_ += std::chrono::steady_clock::now() - start;
    ++steps_;
  }

  void draw(Drawing& drawing) const {
    const loft::cdt::Triangulation& mesh = overlay_.triangulation();
    for (const RingId ring : overlay_.rings(polygons_))
      drawing.area({mesh.points(ring)}, fill(samples::solid_tone));
    draw_free_edges(drawing, mesh);
    for (const RingId ring : overlay_.rings(polygons_))
      draw_constraint(drawing, mesh, ring, samples::border_tone, 1.2);
    for (std::size_t i = 0; i < agents_.size(); ++i)
      drawing.area({mesh.points(agents_[i].ring)}, fill(loft::io::dark_tone(i % 2 == 0 ? 6 : 7)));
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
  std::chrono::duration<double, std::micro> took_{};
  int steps_ = 0;
};

void run(const std::string& path) {
  constexpr int frames = 8;
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
  return samples::run_sample(argc, argv, "moving_agents.svg", run);
}
