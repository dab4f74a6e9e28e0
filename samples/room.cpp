// SPDX-License-Identifier: MIT
// An agent goes through a room whose boxes drift and turn, and looks for another way whenever one
// of them has come into its own: room room.svg
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "io/planar/palette.h"
#include "io/planar/path_points.h"
#include "overlay/overlay.h"
#include "paths/distance.h"
#include "paths/planner.h"
#include "paths/walk.h"
#include "samples/drawing.h"

namespace {

using loft::Colour;
using loft::overlay::LayerId;
using loft::overlay::Overlay;
using loft::overlay::Point;
using loft::overlay::Ring;
using loft::overlay::RingId;
using loft::paths::distance_between;
using loft::paths::FreeSpace;
using loft::paths::length;
using loft::paths::Path;
using loft::paths::PathId;
using loft::paths::Piece;
using loft::paths::Planner;
using loft::paths::point_on;
using loft::paths::Query;
using loft::paths::Status;
using samples::Dice;
using samples::Drawing;
using samples::fill;
using samples::stroke;

constexpr double width = 160;
constexpr double height = 100;
constexpr Point start{5, 6};
constexpr Point goal{155, 94};
constexpr double radius = 1.5;  // of the agent
constexpr double pace = 0.75;   // a step
constexpr int most_steps = 2000;
constexpr int box_count = 12;

;

struct Box {
  Ring shape{};      // around the origin
  double reach = 0;  // no corner is further from there
  Point place{};
  double angle = 0;
  Point drift{};  // a step
  double turn = 0;
};

/// 4 to 8 corners on an ellipse.
Box random_box(Dice& dice) {
  const double across = dice.between(10, 15);
  const double deep = dice.between(7, 10);
  const int corner_count = static_cast<int>(dice.between(4, 9));
  Box box{.reach = std::max(across, deep)};
  for (int i = 0; i < corner_count; ++i) {
    const double angle = 2 * std::numbers::pi * (i + dice.between(-0.2, 0.2)) / corner_count;
    box.shape.push_back({across * std::cos(angle), deep * std::sin(angle)});
  }
  box.place = {dice.between(box.reach, width - box.reach),
               dice.between(box.reach, height - box.reach)};
  box.angle = dice.between(0, 2 * std::numbers::pi);
  const double way = dice.between(0, 2 * std::numbers::pi);
  const double speed = dice.between(0.08, 0.22);
  box.drift = {speed * std::cos(way), speed * std::sin(way)};
  box.turn = dice.between(-0.012, 0.012);
  return box;
}

Ring corners(const Box& box) {
  Ring ring = box.shape;
  const double c = std::cos(box.angle);
  const double s = std::sin(box.angle);
  for (Point& p : ring) p = {box.place.x + c * p.x - s * p.y, box.place.y + s * p.x + c * p.y};
  return ring;
}

bool is_in_room(const Box& box) {
  return box.place.x >= box.reach && box.place.x <= width - box.reach && box.place.y >= box.reach &&
         box.place.y <= height - box.reach;
}

/// Boxes keep off each other as if they were round.
bool is_apart(const Box& a, const Box& b) {
  return distance_between(a.place, b.place) >= a.reach + b.reach;
}

bool keeps_off(const Box& box, Point p, double distance) {
  return distance_between(box.place, p) >= box.reach + distance;
}

std::vector<Box> random_boxes(Dice& dice) {
  std::vector<Box> boxes;
  while (boxes.size() < box_count) {
    const Box box = random_box(dice);
    if (keeps_off(box, start, 3 * radius) && keeps_off(box, goal, 3 * radius) &&
        std::ranges::all_of(boxes, [&](const Box& other) { return is_apart(box, other); }))
      boxes.push_back(box);
  }
  return boxes;
}

/// A box drifts and turns; where something is in its way it turns back. It lets the agent pass.
void drift(std::vector<Box>& boxes, std::size_t which, Point agent) {
  Box& box = boxes[which];
  Box moved = box;
  moved.place = {box.place.x + box.drift.x, box.place.y + box.drift.y};
  moved.angle += box.turn;
  bool is_clear = is_in_room(moved) && keeps_off(moved, goal, 2 * radius) &&
                  keeps_off(moved, agent, 2 * radius);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    is_clear = is_clear && (i == which || is_apart(moved, boxes[i]));
  if (is_clear) {
    box = moved;
  } else {
    box.drift = {-box.drift.x, -box.drift.y};
    box.turn = -box.turn;
  }
}

/// Takes the first of a way off; returns where it then begins.
Point walk(Path& way, Point from, double distance) {
  while (!way.pieces.empty()) {
    Piece& piece = way.pieces.front();
    const double here = length(piece);
    if (distance < here) return piece.from = point_on(piece, distance / here);
    distance -= here;
    from = piece.to;
    way.pieces.erase(way.pieces.begin());
  }
  return from;
}

/// What is drawn of a time.
struct Moment {
  std::vector<Ring> boxes{};
  std::vector<Point> walked{};
  std::vector<Point> left{};
};

using Clock = std::chrono::steady_clock;
using Microseconds = std::chrono::duration<double, std::micro>;

/// The room, the boxes and the agent in it.
class Room {
 public:
  Room() {
    overlay_.insert(frame_, Ring{{0, 0}, {width, 0}, {width, height}, {0, height}});
    for (const Box& box : boxes_) rings_.push_back(overlay_.insert(things_, corners(box)));
    space_.follow();
    space_.keep_gaps();
    path_ = planner_.keep({.from = start, .to = goal, .radius = radius});
    way_ = planner_.path(path_);
  }

  [[nodiscard]] bool is_there() const { return walked_.back() == goal; }

  void step() {
    for (std::size_t i = 0; i < boxes_.size(); ++i) drift(boxes_, i, walked_.back());
    const auto begin = Clock::now();
    move_boxes();
    space_.follow();
    const bool is_broken = !planner_.after_edit().empty();
    edits_took_ += Clock::now() - begin;
    ++steps_;
    if (is_broken || way_.status != Status::found) replan();
    if (way_.status == Status::found) walked_.push_back(walk(way_, walked_.back(), pace));
  }

  [[nodiscard]] Moment moment() const {
    Moment now{.walked = walked_, .left = loft::io::points_along(way_, walked_.back())};
    for (const Box& box : boxes_) now.boxes.push_back(corners(box));
    return now;
  }

  void report() const {
    std::printf("%d steps, another way looked for %d times; %s after %.9f\n", steps_, replans_,
                is_there() ? "there" : "not there", length());
    std::printf(
        "%.1f us to move %d boxes, follow, and know whether the way is broken; %.1f us to "
        "find another\n",
        edits_took_.count() / steps_, box_count, replans_took_.count() / replans_);
  }

 private:
  void move_boxes() {
    overlay_.begin_batch();
    for (std::size_t i = 0; i < boxes_.size(); ++i) overlay_.move(rings_[i], corners(boxes_[i]));
    overlay_.end_batch();
  }

  /// From where the agent is. As that is rounded, it may be nearer to a corner than its radius, by
  /// a hair: it gets as much thinner.
  void replan() {
    constexpr double less = 1 - 0x1p-40;
    const auto begin = Clock::now();
    const double thinner = less * planner_.query(path_).radius;
    planner_.change(path_, {.from = walked_.back(), .to = goal, .radius = thinner});
    way_ = planner_.path(path_);
    replans_took_ += Clock::now() - begin;
    ++replans_;
  }

  [[nodiscard]] double length() const {
    double sum = 0;
    for (std::size_t i = 1; i < walked_.size(); ++i)
      sum += distance_between(walked_[i - 1], walked_[i]);
    return sum;
  }

  Dice dice_{9};
  std::vector<Box> boxes_ = random_boxes(dice_);
  Overlay overlay_;
  LayerId frame_ = overlay_.add_layer("frame");
  LayerId things_ = overlay_.add_layer("boxes", loft::overlay::FillRule::nonzero);
  std::vector<RingId> rings_;
  FreeSpace space_{overlay_, loft::overlay::Expression(frame_) - things_};
  Planner planner_{space_};
  PathId path_;
  Path way_;  // what is left of it
  std::vector<Point> walked_{start};
  int steps_ = 0;
  int replans_ = 0;
  Microseconds edits_took_{};
  Microseconds replans_took_{};
};

constexpr Colour ghost_tone{0xea, 0xea, 0xe8};
const Colour walked_tone = loft::io::dark_tone(7);
const Colour left_tone = loft::io::dark_tone(6);

/// The line, and what the agent sweeps.
void draw_way(Drawing& drawing, const std::vector<Point>& points, Colour tone) {
  drawing.line(points, stroke(tone, drawing.pixels(2 * radius)) + "stroke-opacity=\"0.2\"");
  drawing.line(points, stroke(tone, 1.8));
}

/// With it, pale, where the boxes were in the moment before, and the way that was meant then.
void draw(Drawing& drawing, const Moment& now, const Moment& before) {
  drawing.area(before.boxes, fill(ghost_tone));
  drawing.area(now.boxes, stroke(samples::border_tone, 0.8) + fill(samples::solid_tone));
  drawing.line(before.left,
               stroke(left_tone, 1.2) + "stroke-opacity=\"0.5\" stroke-dasharray=\"300 400\"");
  draw_way(drawing, now.walked, walked_tone);
  draw_way(drawing, now.left, left_tone);
  drawing.dots({goal}, left_tone, 7);
  drawing.dots({start}, walked_tone, 7);
  drawing.dots({now.walked.back()}, left_tone, drawing.pixels(2 * radius));
}

void run(const std::string& out) {
  Room room;
  std::vector<Moment> moments{room.moment()};
  while (!room.is_there() && moments.size() < most_steps) {
    room.step();
    moments.push_back(room.moment());
  }
  room.report();

  Drawing drawing(out, "A room whose boxes move",
                  {.shown = {{0, 0}, {width, height}}, .columns = 2, .rows = 2, .caption_size = 0});
  std::size_t before = 0;
  for (int i = 0; i < 4; ++i) {
    const std::size_t now = (moments.size() - 1) * 3 * static_cast<std::size_t>(i) / 10;
    drawing.turn_to(i);
    draw(drawing, moments[now], moments[before]);
    before = now;
  }
  drawing.finish();
}

}  // namespace

int main(int argc, char** argv) { return samples::run_sample(argc, argv, "room.svg", run); }
