// SPDX-License-Identifier: MIT
#include "overlay/cut.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "overlay/distance.h"

namespace loft::overlay {

std::pair<CoverId, CoverId> covers_beside(const Overlay& overlay, EdgeId edge) {
  using cdt::Triangulation;
  return {overlay.cover(Triangulation::triangle(edge)),
          overlay.cover(Triangulation::triangle(overlay.triangulation().twin(edge)))};
}

Cover cover_along(const Overlay& overlay, EdgeId edge) {
  const auto [on_left, on_right] = covers_beside(overlay, edge);
  const auto left = overlay.layers(on_left);
  const auto right = overlay.layers(on_right);
  Cover result;
  std::ranges::set_intersection(left, right, std::back_inserter(result.inside));
  std::ranges::set_symmetric_difference(left, right, std::back_inserter(result.on_border_of));
  return result;
}

namespace {

/// Whichever is on which side.
std::pair<CoverId, CoverId> unordered(std::pair<CoverId, CoverId> covers) {
  return std::minmax(covers.first, covers.second);
}

}  // namespace

std::vector<LinePiece> pieces(const Overlay& overlay, RingId line) {
  const cdt::Triangulation& mesh = overlay.triangulation();
  const auto from = [&](EdgeId e) { return mesh.point(mesh.from(e)); };
  std::vector<LinePiece> result;
  std::pair<CoverId, CoverId> beside;
  EdgeId last;
  for (const cdt::Segment& segment : mesh.segments(line)) {
    const auto number = static_cast<std::uint32_t>(&segment - mesh.segments(line).data());
    bool is_first = true;  // of the segment, so that it starts from a point of the line
    for (const EdgeId e : mesh.pieces(cdt::SegmentId(mesh.first_segment(line).index() + number))) {
      const auto here = unordered(covers_beside(overlay, e));
      const bool may_differ = result.empty() || here != beside;
      const Cover cover = may_differ ? cover_along(overlay, e) : Cover();
      if (may_differ && (result.empty() || cover != result.back().cover)) {
        if (!result.empty()) result.back().points.push_back(from(e));
        result.push_back({{from(e)}, cover, 0});
      } else if (is_first) {
        result.back().points.push_back(from(e));
      }
      result.back().length += distance(from(e), mesh.point(mesh.to(e)));
      beside = here;
      is_first = false;
      last = e;
    }
  }
  if (!result.empty()) result.back().points.push_back(mesh.point(mesh.to(last)));
  return result;
}

std::vector<std::pair<Cover, double>> lengths(std::span<const LinePiece> pieces) {
  const auto is_before = [](const Cover& a, const Cover& b) {
    return std::tie(a.inside, a.on_border_of) < std::tie(b.inside, b.on_border_of);
  };
  std::map<Cover, double, decltype(is_before)> sums(is_before);
  for (const LinePiece& piece : pieces) sums[piece.cover] += piece.length;
  return {sums.begin(), sums.end()};
}

}  // namespace loft::overlay
