// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "fields/field.h"
#include "tests/cases.h"

namespace loft::fields {

/// How many random fields a test tries: as many as the environment says, for the long run.
inline std::uint64_t fields_to_try(std::uint64_t count) {
  const char* asked = std::getenv("LOFT_SOAK_FIELDS");
  return asked != nullptr ? std::strtoull(asked, nullptr, 10) : cases(count);
}

/// What a line was made of.
struct KeptLine {
  std::vector<Point> points;
  LineKind kind = LineKind::feature;
  std::vector<double> left;
  std::vector<double> right;
  Ends ends = cdt::open;

  [[nodiscard]] Line view() const {
    return {
        .points = points, .kind = kind, .values = left, .left = left, .right = right, .ends = ends};
  }
};

/// A field that is edited at random, and what it should be.
class Edited {
 public:
  explicit Edited(std::uint64_t seed) : random_(seed) {}

  void edit() {
    const unsigned dice = random(100);
    if (dice < 30 || samples_.size() < 4) return insert_sample();
    if (dice < 45) return insert_line();
    if (dice < 60) return move_sample();
    if (dice < 70) return change_value();
    if (dice < 78) return remove_sample();
    if (lines_.empty()) return;
    if (dice < 88) return move_line();
    if (dice < 92) return translate_line();
    remove_line();
  }

  [[nodiscard]] const Field& field() const { return field_; }
  /// The same, all at once, the first ones first.
  [[nodiscard]] Field built() const {
    Field fresh;
    std::map<std::uint64_t, SampleId> samples;
    for (const auto& [id, kept] : samples_) samples[kept.second] = id;
    std::map<std::uint64_t, LineId> lines;
    for (const auto& [id, kept] : lines_) lines[kept.second] = id;
    std::vector<Sample> all;
    for (const auto& [order, id] : samples) all.push_back(samples_.at(id).first);
    fresh.insert(all);
    for (const auto& [order, id] : lines) fresh.insert(lines_.at(id).first.view());
    return fresh;
  }
  [[nodiscard]] unsigned random(unsigned bound) { return static_cast<unsigned>(random_() % bound); }
  [[nodiscard]] Point place() { return {random(129) * 0.125, random(129) * 0.125}; }
  [[nodiscard]] Point anywhere() {
    std::uniform_real_distribution<double> any(-0.5, 16.5);
    return {any(random_), any(random_)};
  }
  [[nodiscard]] double height() { return std::ldexp(static_cast<double>(random(4096)), -6); }
  [[nodiscard]] std::size_t sample_count() const { return samples_.size(); }

 private:
  template <class Id, class Kept>
  [[nodiscard]] Id any_of(const std::map<Id, Kept>& kept) {
    return std::next(kept.begin(), random(static_cast<unsigned>(kept.size())))->first;
  }
  [[nodiscard]] KeptLine any_line(LineKind kind, Ends ends) {
    KeptLine line{.points = {}, .kind = kind, .left = {}, .right = {}, .ends = ends};
    const unsigned count = 2 + random(4);
    while (line.points.size() < count || line.points.front() == line.points.back()) {
      line.points.push_back(place());
      line.left.push_back(height());
      line.right.push_back(height());
    }
    return line;
  }
  void insert_sample() {
    const Sample sample{place(), height()};
    samples_[field_.insert(sample)] = {sample, order_++};
  }
  void insert_line() {
    const KeptLine line =
        any_line(static_cast<LineKind>(random(4)), random(4) == 0 ? cdt::closed : cdt::open);
    lines_[field_.insert(line.view())] = {line, order_++};
  }
  void move_sample() {
    const SampleId id = any_of(samples_);
    samples_[id].first.place = place();
    field_.move(id, samples_[id].first.place);
  }
  void change_value() {
    const SampleId id = any_of(samples_);
    samples_[id].first.value = height();
    field_.set_value(id, samples_[id].first.value);
  }
  void remove_sample() {
    const SampleId id = any_of(samples_);
    field_.remove(id);
    samples_.erase(id);
  }
  void move_line() {
    const LineId id = any_of(lines_);
    KeptLine& line = lines_[id].first;
    line = any_line(line.kind, line.ends);
    field_.move(id, line.view());
  }
  void translate_line() {
    const LineId id = any_of(lines_);
    const Point by{random(3) * 0.25, random(3) * 0.25};
    for (Point& p : lines_[id].first.points) p = {p.x + by.x, p.y + by.y};
    field_.translate(id, by);
  }
  void remove_line() {
    const LineId id = any_of(lines_);
    field_.remove(id);
    lines_.erase(id);
  }

  std::mt19937_64 random_;
  Field field_;
  std::map<SampleId, std::pair<Sample, std::uint64_t>> samples_;
  std::map<LineId, std::pair<KeptLine, std::uint64_t>> lines_;
  std::uint64_t order_ = 0;
};

inline constexpr std::array smoothnesses{Smoothness::linear, Smoothness::cubic};
inline constexpr std::array sides{Side::left, Side::right};

}  // namespace loft::fields
