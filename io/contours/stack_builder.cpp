// SPDX-License-Identifier: MIT
#include "io/contours/stack_builder.h"

#include <algorithm>
#include <cmath>

#include "io/bytes/text.h"
#include "io/contours/heights.h"
#include "reconstruct/defect.h"

namespace loft::io {

std::string counted(std::size_t count, std::string_view what) {
  std::string text = std::to_string(count) + ' ' + std::string(what);
  if (count == 1) return text;
  const std::size_t noun = std::min(text.find(" of "), std::min(text.find(" that "), text.size()));
  const bool is_hatch = text.substr(0, noun).ends_with("ch");
  return text.insert(noun, is_hatch ? "es" : "s");
}

namespace {

std::string listed(const std::map<std::string, std::size_t>& counts) {
  std::string text;
  for (const auto& [what, count] : counts) {
    if (!text.empty()) text += ", ";
    text += counted(count, what);
  }
  return text;
}

}  // namespace

void StackBuilder::add(Contour contour, double lowest, double highest) {
  std::vector<cdt::Point>& points = contour.points;
  if (points.size() > 1 && points.front() == points.back()) {
    points.pop_back();
    if (!contour.places.empty()) contour.places.pop_back();
  }
  if (points.size() < 3) {
    skip(contour.label, "contour of 1 or 2 points");
  } else {
    contours_.push_back({std::move(contour), lowest, highest});
  }
}

std::vector<std::string> StackBuilder::notes() const {
  std::vector<std::string> result;
  for (const auto& [label, counts] : skipped_) {
    const std::string whose = label.empty() ? "" : "label " + in_quotes(label) + ": ";
    result.push_back(whose + listed(counts) + " left out");
  }
  return result;
}

void StackBuilder::fail(std::string_view advice) const {
  std::map<std::string, std::size_t> sum;
  for (const auto& [label, counts] : skipped_)
    for (const auto& [what, count] : counts) sum[what] += count;
  throw InputError(std::string(name_) + ": no closed outline in it" +
                   (sum.empty() ? "" : ", only " + listed(sum)) + "; " + std::string(advice));
}

/// How far apart the heights of a contour may be.
double StackBuilder::tolerance() const {
  std::vector<double> level = heights_;
  std::vector<double> all = heights_;
  double largest = 0;
  for (const Raised& raised : contours_) {
    all.push_back(raised.lowest);
    if (raised.lowest == raised.highest) level.push_back(raised.lowest);
    largest = std::max({largest, std::abs(raised.lowest), std::abs(raised.highest)});
  }
  // What is tilted has gaps of its own, which count only where rounding left nothing level.
  const double of_level = HeightGroups(std::move(level)).tolerance();
  if (of_level > 0) return of_level;
  constexpr double rounding = 1e-6;  // of floats, in a single slice
  const double of_all = HeightGroups(std::move(all)).tolerance();
  return of_all > 0 ? of_all : rounding * largest;
}

/// Leaves out what is in no plane; the heights of the others are those of their planes.
void StackBuilder::sort_out() {
  const double most = tolerance();
  std::erase_if(contours_, [&](const Raised& raised) {
    const bool is_tilted = raised.highest - raised.lowest > most;
    if (is_tilted) skip(raised.contour.label, "contour that is in no plane");
    return is_tilted;
  });
  std::vector<double> heights = heights_;
  for (const Raised& raised : contours_) heights.push_back(raised.lowest);
  const HeightGroups groups(std::move(heights));
  for (Raised& raised : contours_) raised.lowest = groups.of(raised.lowest);
  for (double& height : heights_) height = groups.of(height);
}

void StackBuilder::finish(Stack& stack, std::string_view advice) {
  sort_out();
  if (contours_.empty()) fail(advice);
  for (const Raised& raised : contours_) heights_.push_back(raised.lowest);
  std::ranges::sort(heights_);
  heights_.erase(std::unique(heights_.begin(), heights_.end()), heights_.end());
  const std::size_t before = stack.slices.size();
  for (const double height : heights_) stack.slices.push_back({height, {}});
  for (Raised& raised : contours_) {
    const auto place = std::ranges::lower_bound(heights_, raised.lowest) - heights_.begin();
    stack.slices[before + static_cast<std::size_t>(place)].contours.push_back(
        std::move(raised.contour));
  }
  for (std::string& note : notes()) stack.notes.push_back(std::move(note));
  contours_.clear();
}

}  // namespace loft::io
