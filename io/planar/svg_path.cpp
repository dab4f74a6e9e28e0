// SPDX-License-Identifier: MIT
#include "io/planar/svg_path.h"

#include <utility>

#include "reconstruct/number_text.h"

namespace loft::io {

/// Numbers need no blank in front where a letter or a minus sign tells them apart.
void SvgPath::append(GridPoint place) {
  const GridPoint step{place.x - at_.x, place.y - at_.y};
  if (step.x >= 0 && data_.back() != 'm') data_ += ' ';
  append_number(data_, step.x);
  if (step.y >= 0) data_ += ' ';
  append_number(data_, step.y);
  at_ = place;
}

void SvgPath::move(GridPoint place) {
  data_ += 'm';
  append(place);
}

void SvgPath::line(GridPoint place) {
  if (place != at_) append(place);
}

void SvgPath::loop(const std::vector<GridPoint>& points) {
  std::vector<GridPoint> corners;
  for (const GridPoint& point : points)
    if (corners.empty() || point != corners.back()) corners.push_back(point);
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  if (corners.size() < 3) return;
  move(corners.front());
  for (const GridPoint& corner : corners) line(corner);
  data_ += 'z';
  at_ = corners.front();
}

void SvgPath::dot(GridPoint place) {
  move(place);
  data_ += "h0";
}

void SvgPath::allow_cut() {
  constexpr std::size_t enough = 1'000'000;
  if (data_.size() < enough) return;
  finished_.push_back(std::exchange(data_, {}));
  at_ = {};
}

void SvgPath::write(std::ostream& out, std::string_view attributes) const {
  const auto write_one = [&](const std::string& data) {
    if (!data.empty()) out << "<path " << attributes << " d=\"" << data << "\"/>\n";
  };
  for (const std::string& data : finished_) write_one(data);
  write_one(data_);
}

}  // namespace loft::io
