// SPDX-License-Identifier: MIT
#include "io/dicom/seg_frames.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "io/bytes/problems.h"
#include "mesh/admitted.h"
#include "mesh/vec3.h"
#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

/// What a macro of functional groups says: of the frame, or else of all.
DcmItem* group_of(DcmItem& frame, DcmItem* shared, const DcmTagKey& tag) {
  if (DcmItem* const own = first_item_of(frame, tag)) return own;
  return shared == nullptr ? nullptr : first_item_of(*shared, tag);
}

using Orientation = std::array<double, 6>;

class Reading {
 public:
  Reading(DicomObject& object, bool have_segments)
      : object_(object),
        have_segments_(have_segments),
        shared_(first_item_of(object.data_set(), DCM_SharedFunctionalGroupsSequence)) {}

  SegFrames read() {
    for_each_item(sequence_of(object_.data_set(), DCM_PerFrameFunctionalGroupsSequence),
                  [this](DcmItem& item, std::size_t i) { read_frame(item, i); });
    if (result_.frames.empty() && problems_.is_empty())
      fail("(5200,9230)", "has no frames; export the segmentation again");
    problems_.raise(object_.name());
    sort_into_planes();
    find_gaps();
    return std::move(result_);
  }

 private:
  void fail(const std::string& path, const std::string& what) {
    problems_.add(object_.name() + ": " + path + ": " + what);
  }

  void read_frame(DcmItem& item, std::size_t index) {
    const std::string path = "(5200,9230)[" + std::to_string(index) + "]/";
    SegFrame& frame = result_.frames.emplace_back();
    DcmItem* const place = group_of(item, shared_, DCM_PlanePositionSequence);
    const auto origin =
        place == nullptr ? std::nullopt : numbers_of(*place, DCM_ImagePositionPatient);
    if (!are_places(origin, 3))
      fail(path + "(0020,9113)/(0020,0032)",
           "is no place x\\y\\z of the frame; export the segmentation again");
    else
      std::ranges::copy(*origin, frame.origin.begin());
    read_orientation(item, path);
    read_measures(item, path);
    if (have_segments_) read_segment(item, frame, path);
  }

  static bool are_places(const std::optional<std::vector<double>>& numbers, std::size_t count) {
    return numbers && numbers->size() == count &&
           std::ranges::all_of(*numbers, [](double n) { return admitted::slice.admits(n); });
  }

  void read_orientation(DcmItem& item, const std::string& path) {
    DcmItem* const group = group_of(item, shared_, DCM_PlaneOrientationSequence);
    const auto numbers =
        group == nullptr ? std::nullopt : numbers_of(*group, DCM_ImageOrientationPatient);
    const std::string tag = path + "(0020,9116)/(0020,0037)";
    if (!are_places(numbers, 6)) {
      fail(tag, "is no two directions of the frame's pixels; export the segmentation again");
      return;
    }
    Orientation orientation;
    std::ranges::copy(*numbers, orientation.begin());
    constexpr double rounding = 1e-3;
    const Vec3 row{orientation[0], orientation[1], orientation[2]};
    const Vec3 column{orientation[3], orientation[4], orientation[5]};
    if (std::abs(dot(row, row) - 1) > rounding || std::abs(dot(column, column) - 1) > rounding ||
        std::abs(dot(row, column)) > rounding) {
      fail(tag, "has no two directions of length 1 at right angles; export it again");
    } else if (!has_orientation_) {
      has_orientation_ = true;
      orientation_ = orientation;
    } else if (!std::ranges::equal(orientation, orientation_,
                                   [](double a, double b) { return std::abs(a - b) <= 1e-4; })) {
      fail(tag,
           "is another direction than that of the frames before: frames must be parallel; "
           "resample the segmentation to one volume");
    }
  }

  void read_measures(DcmItem& item, const std::string& path) {
    if (has_measures_) return;
    DcmItem* const group = group_of(item, shared_, DCM_PixelMeasuresSequence);
    const auto spacing = group == nullptr ? std::nullopt : numbers_of(*group, DCM_PixelSpacing);
    has_measures_ = true;  // also where they are wrong: said once
    if (!are_places(spacing, 2) || !(spacing->at(0) > 0 && spacing->at(1) > 0)) {
      fail(path + "(0028,9110)/(0028,0030)",
           "is no two distances of pixels greater than 0; export the segmentation again");
      return;
    }
    row_distance_ = spacing->at(0);
    column_distance_ = spacing->at(1);
    const auto first = [&](const DcmTagKey& tag) {
      const auto numbers = numbers_of(*group, tag);
      return are_places(numbers, 1) ? std::abs(numbers->front()) : 0.0;
    };
    result_.spacing = first(DCM_SpacingBetweenSlices);
    thickness_ = first(DCM_SliceThickness);
  }

  void read_segment(DcmItem& item, SegFrame& frame, const std::string& path) {
    DcmItem* const group = group_of(item, shared_, DCM_SegmentIdentificationSequence);
    Uint16 number = 0;
    if (group == nullptr || group->findAndGetUint16(DCM_ReferencedSegmentNumber, number).bad() ||
        number == 0)
      fail(path + "(0062,000a)/(0062,000b)",
           "is no number of a segment; export the segmentation again");
    frame.segment = number;
  }

  void sort_into_planes() {
    const Vec3 row{orientation_[0], orientation_[1], orientation_[2]};
    const Vec3 column{orientation_[3], orientation_[4], orientation_[5]};
    normal_ = cross(row, column);
    std::vector<std::size_t> order(result_.frames.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto height = [&](std::size_t i) { return dot(normal_, result_.frames[i].origin); };
    std::ranges::stable_sort(order, {}, height);
    const double spacing = result_.spacing > 0 ? result_.spacing : thickness_;
    const double tolerance =
        0.01 * (spacing > 0 ? spacing : std::min(row_distance_, column_distance_));
    const double first = height(order.front());
    for (const std::size_t i : order) {
      const double position = height(i) - first;
      if (result_.positions.empty() || position - result_.positions.back() > tolerance)
        result_.positions.push_back(position);
      result_.frames[i].plane = static_cast<std::uint32_t>(result_.positions.size() - 1);
    }
    set_matrix(result_.frames[order.front()], result_.frames[order.back()]);
    require_one_volume();
  }

  /// Planes may lie slantwise behind each other, as with a tilted gantry.
  void set_matrix(const SegFrame& first, const SegFrame& last) {
    const double depth = dot(normal_, last.origin) - dot(normal_, first.origin);
    const bool has_depth = result_.positions.size() > 1;
    for (std::size_t i = 0; i < 3; ++i)
      result_.to_world[i] = {
          orientation_[i] * column_distance_, orientation_[i + 3] * row_distance_,
          has_depth ? (last.origin[i] - first.origin[i]) / depth : normal_[i], first.origin[i]};
  }

  void require_one_volume() {
    const double tolerance = 0.05 * std::min(row_distance_, column_distance_);
    for (std::size_t i = 0; i < result_.frames.size(); ++i) {
      const SegFrame& frame = result_.frames[i];
      Vec3 off{};
      for (std::size_t k = 0; k < 3; ++k)
        off[k] = frame.origin[k] - result_.to_world[k][3] -
                 result_.to_world[k][2] * result_.positions[frame.plane];
      const double along = dot(off, normal_);
      const double aside = std::sqrt(std::max(0.0, dot(off, off) - along * along));
      if (aside > tolerance)
        fail("(5200,9230)[" + std::to_string(i) + "]/(0020,9113)/(0020,0032)",
             "lies " + exact(aside) +
                 " mm aside of where the other frames' pixels are; resample "
                 "the segmentation to one volume");
    }
    problems_.raise(object_.name());
  }

  /// The distance of planes that are neighbours; a thickness is that only where some planes are so
  /// far from each other.
  [[nodiscard]] double regular_distance() const {
    if (result_.spacing > 0) return result_.spacing;
    for (std::size_t i = 1; i < result_.positions.size(); ++i)
      if (std::abs(result_.positions[i] - result_.positions[i - 1] - thickness_) <=
          0.01 * thickness_)
        return thickness_;
    return 0;
  }

  void find_gaps() {
    const double regular = regular_distance();
    if (result_.spacing == 0) result_.spacing = thickness_;
    if (regular == 0) return;
    std::vector<double> all;
    std::vector<std::uint32_t> renumbered;
    for (const double position : result_.positions) {
      if (!all.empty()) add_empty_planes(all, position, regular);
      renumbered.push_back(static_cast<std::uint32_t>(all.size()));
      all.push_back(position);
    }
    result_.positions = std::move(all);
    for (SegFrame& frame : result_.frames) frame.plane = renumbered[frame.plane];
  }

  static void add_empty_planes(std::vector<double>& all, double next, double regular) {
    const double last = all.back();
    const double steps = std::round((next - last) / regular);
    // Planes drift apart by rounding, so that far ones need not be at a multiple.
    const bool is_regular = std::abs(next - last - steps * regular) <= 0.1 * regular;
    if (steps < 2 || !is_regular) return;
    const double step = (next - last) / steps;
    all.push_back(last + step);
    if (steps > 2) all.push_back(next - step);
  }

  DicomObject& object_;
  bool have_segments_;
  DcmItem* shared_;
  SegFrames result_;
  Orientation orientation_{};
  Vec3 normal_{};
  bool has_orientation_ = false;
  bool has_measures_ = false;
  double row_distance_ = 0;
  double column_distance_ = 0;
  double thickness_ = 0;
  Problems problems_;
};

}  // namespace

SegFrames read_seg_frames(DicomObject& object, bool have_segments) {
  return Reading(object, have_segments).read();
}

}  // namespace loft::io
