// SPDX-License-Identifier: MIT
#include "bench/workload.h"

#include <charconv>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace loft::bench {

namespace {

/// Numbers of a text, one after the other.
class Numbers {
 public:
  explicit Numbers(std::filesystem::path path) : path_(std::move(path)) {
    std::ifstream file(path_, std::ios::binary);
    if (!file) throw std::runtime_error(path_.string() + ": cannot be read");
    text_.assign(std::istreambuf_iterator<char>(file), {});
    skip_blanks();
  }

  [[nodiscard]] bool is_at_end() const { return at_ == text_.size(); }

  template <class Number>
  [[nodiscard]] Number next() {
    Number number{};
    const auto [end, error] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), number);
    if (error != std::errc())
      throw std::runtime_error(path_.string() + ": no number at byte " + std::to_string(at_));
    at_ = static_cast<std::size_t>(end - text_.data());
    skip_blanks();
    return number;
  }

 private:
  void skip_blanks() {
    while (at_ < text_.size() && static_cast<unsigned char>(text_[at_]) <= ' ') ++at_;
  }

  std::filesystem::path path_;
  std::string text_;
  std::size_t at_ = 0;
};

}  // namespace

Workload read_workload(const std::filesystem::path& path) {
  Numbers numbers(path);
  Workload workload;
  while (!numbers.is_at_end()) {
    const auto size = numbers.next<std::size_t>();
    Outline& outline = workload.emplace_back();
    outline.ends = numbers.next<int>() != 0 ? cdt::closed : cdt::open;
    for (std::size_t i = 0; i < size; ++i) {
      const auto x = numbers.next<double>();
      outline.points.push_back({x, numbers.next<double>()});
    }
    outline.points.shrink_to_fit();
  }
  return workload;
}

std::size_t point_count(const Workload& workload) {
  std::size_t count = 0;
  for (const Outline& outline : workload) count += outline.points.size();
  return count;
}

std::vector<cdt::Polyline> views(const Workload& workload) {
  std::vector<cdt::Polyline> views;
  views.reserve(workload.size());
  for (const Outline& outline : workload) views.push_back({outline.points, outline.ends});
  return views;
}

Outline displaced(const Outline& outline, cdt::Point by) {
  Outline result = outline;
  for (cdt::Point& p : result.points) p = {p.x + by.x, p.y + by.y};
  return result;
}

}  // namespace loft::bench
