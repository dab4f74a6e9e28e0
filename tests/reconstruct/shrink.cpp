// SPDX-License-Identifier: MIT
#include "tests/reconstruct/shrink.h"

#include <cmath>
#include <cstddef>
#include <sstream>

namespace loft::stacks {

namespace {

class Shrinking {
 public:
  Shrinking(std::vector<Slice> slices, const Fails& fails)
      : slices_(std::move(slices)), fails_(fails) {}

  std::vector<Slice> run() {
    while (drop_contours() || drop_points() || round_coordinates()) {
    }
    return std::move(slices_);
  }

 private:
  /// Takes the smaller or rounder stack if it fails, too.
  bool accept(std::vector<Slice> candidate) {
    if (tries_ == most_tries || candidate == slices_) return false;
    ++tries_;
    if (!fails_(candidate)) return false;
    slices_ = std::move(candidate);
    return true;
  }

  bool drop_contours() {
    bool is_smaller = false;
    for (std::size_t s = 0; s < slices_.size(); ++s)
      for (std::size_t c = slices_[s].contours.size(); c-- > 0;) {
        auto candidate = slices_;
        auto& contours = candidate[s].contours;
        contours.erase(contours.begin() + static_cast<std::ptrdiff_t>(c));
        is_smaller |= accept(std::move(candidate));
      }
    return is_smaller;
  }

  /// Longer runs of points first.
  bool drop_points() {
    bool is_smaller = false;
    for (std::size_t s = 0; s < slices_.size(); ++s)
      for (std::size_t c = 0; c < slices_[s].contours.size(); ++c)
        for (std::size_t run = slices_[s].contours[c].points.size() / 2; run > 0; run /= 2)
          for (std::size_t p = 0; p + run <= slices_[s].contours[c].points.size();)
            if (without(s, c, p, run)) {
              is_smaller = true;
            } else {
              p += run;
            }
    return is_smaller;
  }

  bool without(std::size_t s, std::size_t c, std::size_t p, std::size_t run) {
    auto candidate = slices_;
    auto& points = candidate[s].contours[c].points;
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(p);
    points.erase(first, first + static_cast<std::ptrdiff_t>(run));
    return accept(std::move(candidate));
  }

  /// To whole numbers, if that is possible, else to few digits; all at once, then one by one.
  bool round_coordinates() {
    bool is_rounder = false;
    for (const double step : {1.0, 0.5, 0.1, 0.01, 1e-4, 1e-8}) {
      const auto rounded = [step](cdt::Point p) {
        return cdt::Point{std::round(p.x / step) * step, std::round(p.y / step) * step};
      };
      auto all = slices_;
      for (Slice& slice : all)
        for (Contour& contour : slice.contours)
          for (cdt::Point& p : contour.points) p = rounded(p);
      if (accept(std::move(all))) return true;
      for (std::size_t s = 0; s < slices_.size(); ++s)
        for (std::size_t c = 0; c < slices_[s].contours.size(); ++c)
          for (std::size_t p = 0; p < slices_[s].contours[c].points.size(); ++p) {
            const cdt::Point old = slices_[s].contours[c].points[p];
            if (std::round(old.x / 10 / step) * 10 * step == old.x &&
                std::round(old.y / 10 / step) * 10 * step == old.y)
              continue;
            auto candidate = slices_;
            candidate[s].contours[c].points[p] = rounded(old);
            is_rounder |= accept(std::move(candidate));
          }
    }
    return is_rounder;
  }

  static constexpr int most_tries = 4000;

  std::vector<Slice> slices_;
  const Fails& fails_;
  int tries_ = 0;
};

}  // namespace

std::vector<Slice> shrink(std::vector<Slice> slices, const Fails& fails) {
  return Shrinking(std::move(slices), fails).run();
}

std::string as_code(const std::vector<Slice>& slices) {
  std::ostringstream out;
  out.precision(17);
  out << "const std::vector<Slice> slices{";
  for (const Slice& slice : slices) {
    out << "\n    {" << slice.z << ", {";
    for (const Contour& contour : slice.contours) {
      out << "\n      {{";
      for (const cdt::Point p : contour.points) out << '{' << p.x << ", " << p.y << "}, ";
      out << "}, {}},";
    }
    out << "}},";
  }
  out << "};\n";
  return out.str();
}

}  // namespace loft::stacks
