// SPDX-License-Identifier: MIT
#include "tests/reconstruct/registration/phantoms.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "cdt/point.h"
#include "tests/reconstruct/stacks.h"

namespace loft::stacks {
namespace {

using cdt::Point;
using std::numbers::pi;

/// Draws numbers that are the same with every standard library.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  int count(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<std::uint64_t>(high - low + 1));
  }
  double angle() { return between(0, 2 * pi); }

 private:
  std::mt19937_64 random_;
};

/// A sum of two waves: 0 in the mean, at most 1, and its slope at most 1.
class Wander {
 public:
  explicit Wander(Draw& draw)
      : slow_(draw.between(0.3, 0.6)),
        fast_(draw.between(0.7, 1.2)),
        start_(draw.angle()),
        other_start_(draw.angle()) {}

  [[nodiscard]] double operator()(double z) const {
    return 0.7 * std::sin(slow_ * z + start_) + 0.3 * std::sin(fast_ * z + other_start_);
  }

 private:
  double slow_;
  double fast_;
  double start_;
  double other_start_;
};

/// A solid as a function of height. Heights run from 0 to 10.
class Solid {
 public:
  virtual ~Solid() = default;
  [[nodiscard]] virtual std::vector<Contour> cut(double z) const = 0;
  [[nodiscard]] virtual double area(double z) const = 0;
  /// Of the farthest point, in thicknesses.
  [[nodiscard]] virtual double shift(double from, double to) const = 0;
  /// What is not simply one ball.
  virtual void describe(Phantom&) const {}
};

/// The area of a regular polygon of radius 1.
double unit_area(std::size_t corners) {
  const auto n = static_cast<double>(corners);
  return n / 2 * std::sin(2 * pi / n);
}

class Tube : public Solid {
 public:
  explicit Tube(Draw& draw)
      : reach_(draw.between(2, 8)), radius_(draw.between(0.5, 1.5)), x_(draw), y_(draw), r_(draw) {}

  [[nodiscard]] std::vector<Contour> cut(double z) const override {
    return {circle(corners, radius(z), centre(z))};
  }
  [[nodiscard]] double area(double z) const override {
    return unit_area(corners) * radius(z) * radius(z);
  }
  [[nodiscard]] double shift(double from, double to) const override {
    return distance(centre(from), centre(to)) / (2 * std::min(radius(from), radius(to)));
  }

 protected:
  static constexpr std::size_t corners = 48;

  [[nodiscard]] Point centre(double z) const { return {reach_ * x_(z), reach_ * y_(z)}; }
  [[nodiscard]] double radius(double z) const { return radius_ * (1 + 0.4 * r_(z)); }
  static double distance(Point a, Point b) { return std::hypot(b.x - a.x, b.y - a.y); }

 private:
  double reach_;
  double radius_;
  Wander x_;
  Wander y_;
  Wander r_;
};

/// Two tubes that are one below a height, and go apart above it.
class Fork : public Tube {
 public:
  explicit Fork(Draw& draw)
      : Tube(draw),
        height_(draw.between(3, 6)),
        speed_(draw.between(1, 4)),
        lean_(draw.between(0.2, 0.8)),
        direction_(draw.angle()) {}

  [[nodiscard]] std::vector<Contour> cut(double z) const override {
    if (apart(z) == 0) return Tube::cut(z);
    return {circle(corners, radius(z), branch(z, lean_)),
            circle(corners, radius(z), branch(z, lean_ - 1))};
  }
  /// Of two discs, less what is in both.
  [[nodiscard]] double area(double z) const override {
    const double r = radius(z);
    const double half = std::min(apart(z) / 2, r);
    const double lens = 2 * (r * r * std::acos(half / r) - half * std::sqrt(r * r - half * half));
    return (2 * pi * r * r - lens) * unit_area(corners) / pi;
  }
  [[nodiscard]] double shift(double from, double to) const override {
    const double thickness = 2 * std::min(radius(from), radius(to));
    return std::max(distance(branch(from, lean_), branch(to, lean_)),
                    distance(branch(from, lean_ - 1), branch(to, lean_ - 1))) /
           thickness;
  }
  void describe(Phantom& phantom) const override { phantom.options.fill = Fill::nonzero; }

 private:
  [[nodiscard]] double apart(double z) const { return speed_ * std::max(z - height_, 0.0); }
  [[nodiscard]] Point branch(double z, double share) const {
    const Point c = centre(z);
    return {c.x + share * apart(z) * std::cos(direction_),
            c.y + share * apart(z) * std::sin(direction_)};
  }

  double height_;
  double speed_;
  double lean_;
  double direction_;
};

class Membrane : public Solid {
 public:
  explicit Membrane(Draw& draw)
      : thickness_(draw.between(0.3, 1.5)),
        height_(draw.between(1, 3)),
        length_(draw.between(8, 16)),
        folds_(draw.between(1, 4)),
        speed_(draw.between(0.3, 0.9)) {}

  [[nodiscard]] std::vector<Contour> cut(double z) const override {
    std::vector<Point> outline;
    for (int side = 0; side < 2; ++side) {
      for (int i = 0; i <= steps; ++i) {
        const double x = length_ * (side == 0 ? i : steps - i) / steps;
        outline.push_back({x, wave(x, z) + (side == 0 ? -0.5 : 0.5) * upright()});
      }
    }
    return {{outline, ""}};
  }
  [[nodiscard]] double area(double) const override { return length_ * upright(); }
  [[nodiscard]] double shift(double from, double to) const override {
    double most = 0;
    for (int i = 0; i <= steps; ++i) {
      const double x = length_ * i / steps;
      most = std::max(most, std::abs(wave(x, from) - wave(x, to)));
    }
    return most / upright();
  }

 private:
  static constexpr int steps = 160;

  [[nodiscard]] double wave(double x, double z) const {
    return height_ * std::sin(2 * pi * folds_ * x / length_ + speed_ * z);
  }
  /// Its size along y, so that it is as thick as wanted in the middle between two folds' sides.
  [[nodiscard]] double upright() const {
    const double slope = 2 * pi * folds_ / length_ * height_;
    return thickness_ * std::sqrt(1 + slope * slope / 2);
  }

  double thickness_;
  double height_;
  double length_;
  double folds_;
  double speed_;
};

class Blade : public Solid {
 public:
  explicit Blade(Draw& draw)
      : half_length_(draw.between(3, 10)),
        half_thickness_(draw.between(0.2, 0.6)),
        start_(draw.angle()),
        speed_(draw.between(0.1, 0.3)) {}

  [[nodiscard]] std::vector<Contour> cut(double z) const override {
    const double angle = start_ + speed_ * z;
    std::vector<Point> outline;
    for (const auto [x, y] : {Point{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      const Point p{x * half_length_, y * half_thickness_};
      outline.push_back({p.x * std::cos(angle) - p.y * std::sin(angle),
                         p.x * std::sin(angle) + p.y * std::cos(angle)});
    }
    return {{outline, ""}};
  }
  [[nodiscard]] double area(double) const override { return 4 * half_length_ * half_thickness_; }
  [[nodiscard]] double shift(double from, double to) const override {
    return half_length_ * 2 * std::sin(speed_ * std::abs(to - from) / 2) / (2 * half_thickness_);
  }

 private:
  double half_length_;
  double half_thickness_;
  double start_;
  double speed_;
};

/// Walls between ellipses, with room between one and the next for both to drift.
class Walls : public Solid {
 public:
  explicit Walls(Draw& draw)
      : count_(draw.count(1, 3)),
        thickness_(draw.between(0.2, 0.6)),
        room_(thickness_ * draw.between(2, 6)),
        hollow_(draw.between(3, 6)),
        oblong_(draw.between(1, 1.6)),
        reach_(draw.between(1, 4)),
        x_(draw),
        y_(draw) {}

  [[nodiscard]] std::vector<Contour> cut(double z) const override {
    std::vector<Contour> contours;
    for (int i = 0; i < count_; ++i) {
      contours.push_back(ellipse(inner(i), z));
      contours.push_back(ellipse(inner(i) + thickness_, z));
    }
    return contours;
  }
  [[nodiscard]] double area(double) const override {
    double sum = 0;
    for (int i = 0; i < count_; ++i) {
      const double outer = inner(i) + thickness_;
      sum += unit_area(corners) * oblong_ * (outer * outer - inner(i) * inner(i));
    }
    return sum;
  }
  [[nodiscard]] double shift(double from, double to) const override {
    return reach_ * std::hypot(x_(to) - x_(from), y_(to) - y_(from)) / thickness_;
  }
  void describe(Phantom& phantom) const override {
    phantom.components = static_cast<std::size_t>(count_);
    phantom.genus = count_;
  }

 private:
  static constexpr std::size_t corners = 72;

  [[nodiscard]] double inner(int i) const { return hollow_ + i * (thickness_ + room_); }
  [[nodiscard]] Contour ellipse(double radius, double z) const {
    Contour contour = circle(corners, radius);
    for (Point& p : contour.points) p = {reach_ * x_(z) + oblong_ * p.x, reach_ * y_(z) + p.y};
    return contour;
  }

  int count_;
  double thickness_;
  double room_;
  double hollow_;
  double oblong_;
  double reach_;
  Wander x_;
  Wander y_;
};

std::unique_ptr<Solid> draw_solid(PhantomKind kind, Draw& draw) {
  switch (kind) {
    case PhantomKind::tube:
      return std::make_unique<Tube>(draw);
    case PhantomKind::fork:
      return std::make_unique<Fork>(draw);
    case PhantomKind::membrane:
      return std::make_unique<Membrane>(draw);
    case PhantomKind::blade:
      return std::make_unique<Blade>(draw);
    case PhantomKind::walls:
      break;
  }
  return std::make_unique<Walls>(draw);
}

constexpr double top = 10;

double greatest_shift(const Solid& solid, int slices) {
  double most = 0;
  for (int i = 0; i + 1 < slices; ++i)
    most = std::max(most, solid.shift(top * i / (slices - 1), top * (i + 1) / (slices - 1)));
  return most;
}

/// By Simpson's rule.
double volume(const Solid& solid) {
  constexpr int steps = 2000;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const bool is_end = i == 0 || i == steps;
    sum += solid.area(top * i / steps) * (is_end ? 1 : i % 2 == 0 ? 2 : 4);
  }
  return sum * top / steps / 3;
}

}  // namespace

const char* name(PhantomKind kind) {
  switch (kind) {
    case PhantomKind::tube:
      return "tube";
    case PhantomKind::fork:
      return "fork";
    case PhantomKind::membrane:
      return "membrane";
    case PhantomKind::blade:
      return "blade";
    case PhantomKind::walls:
      break;
  }
  return "walls";
}

Phantom phantom_from_seed(std::uint64_t seed) {
  Phantom phantom;
  phantom.kind = phantom_kinds[seed % phantom_kinds.size()];
  Draw draw(seed);
  const std::unique_ptr<Solid> solid = draw_solid(phantom.kind, draw);
  const double wanted = draw.between(0.05, 2.25);
  int count = 4;
  while (count < 400 && greatest_shift(*solid, count) > wanted) ++count;
  for (int i = 0; i < count; ++i) {
    const double z = top * i / (count - 1);
    phantom.slices.push_back({z, solid->cut(z)});
  }
  phantom.shift = greatest_shift(*solid, count);
  phantom.volume = volume(*solid);
  solid->describe(phantom);
  return phantom;
}

}  // namespace loft::stacks
