// SPDX-License-Identifier: MIT
#include "io/dicom/rtstruct.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/utf8.h"
#include "io/dicom/pin_holes.h"
#include "io/dicom/space_contours.h"
#include "mesh/admitted.h"
#include "reconstruct/parallel.h"

namespace loft::io {

namespace {

/// A region of interest, and what came of its contours.
struct Roi {
  std::string number;
  StackLabel label;
  std::size_t contours = 0;                          // usable
  std::map<std::string, std::size_t> left_out = {};  // how many of what kind
  PinHoles pin_holes = {};
  std::size_t miscounted = 0;
  bool is_listed = true;
};

class StructureSet {
 public:
  StructureSet(DicomObject& object, const ReadOptions& options)
      : object_(object),
        has_pin_holes_(trimmed_value_of(object.data_set(), DCM_ManufacturerModelName) ==
                           "rt-utils" &&
                       options.fill.value_or(Fill::keyhole_aware) == Fill::keyhole_aware),
        threads_(options.threads) {}

  Stack read() {
    read_rois();
    read_kinds();
    name_rois();
    for_each_item(sequence_of(object_.data_set(), DCM_ROIContourSequence),
                  [this](DcmItem& item, std::size_t i) { read_contours(item, i); });
    Stack stack;
    stack.unit = "mm";
    stack.fill = is_exclusive_or_ ? Fill::even_odd : Fill::keyhole_aware;
    stack.notes = object_.notes();
    for (const Roi& roi : rois_) add_notes(roi, stack.notes);
    for (const Roi& roi : rois_) stack.labels.push_back(roi.label);
    if (contours_.empty() && problems_.is_empty())
      problems_.add(object_.name() + ": has no closed contour of three points or more, in " +
                    std::to_string(rois_.size()) + " ROIs; export the structures with contours");
    if (problems_.is_empty()) into_slices(std::move(contours_), object_.name(), stack, problems_);
    problems_.raise(object_.name());
    return stack;
  }

 private:
  void read_rois() {
    for_each_item(sequence_of(object_.data_set(), DCM_StructureSetROISequence),
                  [this](DcmItem& item, std::size_t) {
                    std::string number(trimmed_value_of(item, DCM_ROINumber));
                    if (find(number) != nullptr) return;  // the first one holds
                    add_roi(std::move(number)).label.name = object_.text(item, DCM_ROIName);
                  });
  }

  void read_kinds() {
    for_each_item(sequence_of(object_.data_set(), DCM_RTROIObservationsSequence),
                  [this](DcmItem& item, std::size_t) {
                    Roi* const roi = find(trimmed_value_of(item, DCM_ReferencedROINumber));
                    if (roi != nullptr && roi->label.kind.empty())
                      roi->label.kind = object_.text(item, DCM_RTROIInterpretedType);
                  });
  }

  /// Names that no two have: those that several have get their number.
  void name_rois() {
    std::map<std::string, std::size_t> count;
    for (Roi& roi : rois_) {
      if (roi.label.name.empty()) roi.label.name = "ROI " + roi.number;
      ++count[roi.label.name];
    }
    for (Roi& roi : rois_) {
      if (count[roi.label.name] == 1) continue;
      std::string name = roi.label.name + " (ROI " + roi.number + ')';
      while (count.contains(name)) name += '\'';
      roi.label.name = std::move(name);
    }
  }

  void read_contours(DcmItem& item, std::size_t index) {
    const std::string_view number = trimmed_value_of(item, DCM_ReferencedROINumber);
    Roi* roi = find(number);
    if (roi == nullptr) {
      roi = &add_roi(std::string(number));
      roi->is_listed = false;
      roi->label.name = "ROI " + roi->number;
      while (std::ranges::count(rois_, roi->label.name,
                                [](const Roi& other) { return other.label.name; }) > 1)
        roi->label.name += '\'';
    }
    if (!roi->label.colour) roi->label.colour = colour_of(item);
    const std::string path = "(3006,0039)[" + std::to_string(index) + "]/(3006,0040)[";
    std::vector<Claim> claims;
    for_each_item(sequence_of(item, DCM_ContourSequence), [&](DcmItem& contour, std::size_t i) {
      if (const auto claim = claim_of(contour, *roi, i)) claims.push_back(*claim);
    });
    std::vector<Points> points(claims.size());
    for_each_index(claims.size(), claims.size() < few ? 1 : threads_,
                   [&](std::size_t i, unsigned) { points[i] = read_points(claims[i]); });
    std::vector<SpaceContour> contours;
    for (std::size_t i = 0; i < claims.size(); ++i)
      if (auto contour = take(claims[i], std::move(points[i]), *roi, path))
        contours.push_back(std::move(*contour));
    if (has_pin_holes_ && problems_.is_empty()) close_holes(contours, *roi);
    add(std::move(contours), *roi);
  }

  static void close_holes(std::vector<SpaceContour>& contours, Roi& roi) {
    // Single pixels are no side of a channel.
    const std::size_t single = std::erase_if(
        contours, [](const SpaceContour& contour) { return contour.points.size() < 2; });
    if (single > 0) roi.left_out[too_few] += single;
    const PinHoles closed = close_pin_holes(contours);
    roi.pin_holes = {roi.pin_holes.count + closed.count, closed.width};
  }

  void add(std::vector<SpaceContour>&& contours, Roi& roi) {
    for (SpaceContour& contour : contours) {
      if (contour.points.size() < 3) {
        ++roi.left_out[too_few];
        continue;
      }
      ++roi.contours;
      contours_.push_back(std::move(contour));
    }
  }

  static std::optional<Colour> colour_of(DcmItem& item) {
    constexpr double most = 255;
    const auto parts = numbers_of(item, DCM_ROIDisplayColor);
    if (!parts || parts->size() != 3 ||
        !std::ranges::all_of(*parts, [](double part) { return part >= 0 && part <= most; }))
      return {};
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>((*parts)[i]); };
    return Colour{byte(0), byte(1), byte(2)};
  }

  /// A closed contour as its item has it, its numbers not yet read.
  struct Claim {
    std::size_t index = 0;
    bool is_exclusive_or = false;
    std::optional<double> count;  ///< of points
    DcmElement* numbers = nullptr;
  };
  struct Points {
    std::vector<Vec3> points;
    std::string problem;
  };

  /// None for what is not closed.
  static std::optional<Claim> claim_of(DcmItem& item, Roi& roi, std::size_t index) {
    const std::string_view type = trimmed_value_of(item, DCM_ContourGeometricType);
    const bool is_exclusive_or = type == "CLOSEDPLANAR_XOR";
    if (is_exclusive_or || type == "CLOSED_PLANAR")
      return Claim{index, is_exclusive_or,
                   to_number(trimmed_value_of(item, DCM_NumberOfContourPoints)),
                   element_of(item, DCM_ContourData)};
    ++roi.left_out[type.empty() ? "contour of no type" : in_words(type)];
    return {};
  }

  static std::string in_words(std::string_view type) { return one_line(type.substr(0, 40)); }

  /// By several threads at once.
  static Points read_points(const Claim& claim) {
    if (claim.numbers == nullptr) return {};
    Points result = points_in(trimmed_value_of(*claim.numbers), claim.count);
    claim.numbers->compact();
    return result;
  }

  static Points points_in(std::string_view text, std::optional<double> claimed) {
    constexpr std::size_t least = 6;  // bytes that a point takes
    const std::size_t room = text.size() / least + 1;
    Points result;
    result.points.reserve(
        static_cast<std::size_t>(std::clamp(claimed.value_or(0), 0.0, static_cast<double>(room))));
    std::size_t count = 0;
    Vec3 point{};
    std::size_t axis = 0;
    for (; !text.empty(); ++count) {
      std::string_view before = text;
      const auto number = next_number(text);
      if (!number || !admitted::slice.admits(*number)) {
        result.problem = "value " + std::to_string(count) + ", " + in_quotes(next_value(before)) +
                         ", is no number of a usable size; export the structure again";
        return result;
      }
      point[axis] = *number;
      if (++axis < point.size()) continue;
      result.points.push_back(point);
      axis = 0;
    }
    if (axis != 0)
      result.problem = "has " + std::to_string(count) +
                       " numbers, which are no triples x\\y\\z; export the structure again";
    return result;
  }

  /// None where a number is none.
  std::optional<SpaceContour> take(const Claim& claim, Points&& read, Roi& roi,
                                   const std::string& path) {
    if (!read.problem.empty()) {
      problems_.add(object_.name() + ": " + path + std::to_string(claim.index) +
                    "]/(3006,0050): " + read.problem);
      return {};
    }
    std::vector<Vec3>& points = read.points;
    if (claim.count && *claim.count != static_cast<double>(points.size())) ++roi.miscounted;
    while (points.size() > 1 && points.front() == points.back()) points.pop_back();
    if (points.size() > 2) is_exclusive_or_ = is_exclusive_or_ && claim.is_exclusive_or;
    return SpaceContour{std::move(points), roi.label.name,
                        "ROI " + roi.number + " contour " + std::to_string(claim.index)};
  }

  /// `label 'Isocenter': left out 1 POINT; it has no closed contour`.
  static void add_notes(const Roi& roi, std::vector<std::string>& notes) {
    std::string note;
    for (const auto& [kind, count] : roi.left_out)
      note += (note.empty() ? "left out " : ", ") + std::to_string(count) + ' ' + kind;
    const auto add = [&](const std::string& words) { note += (note.empty() ? "" : "; ") + words; };
    if (roi.miscounted > 0)
      add(std::to_string(roi.miscounted) +
          " contours have another number of points than the file says");
    if (!roi.is_listed) add("the file's list of ROIs does not have it");
    if (roi.pin_holes.count > 0)
      add("closed " + std::to_string(roi.pin_holes.count) + " channels to holes, " +
          short_number(roi.pin_holes.width) +
          " wide, as rt-utils draws them (--fill evenodd keeps them)");
    if (roi.contours == 0) add("it has no closed contour");
    if (!note.empty()) notes.push_back("label '" + roi.label.name + "': " + note);
  }

  [[nodiscard]] Roi* find(std::string_view number) {
    const auto found = by_number_.find(number);
    return found == by_number_.end() ? nullptr : &rois_[found->second];
  }

  Roi& add_roi(std::string number) {
    by_number_.emplace(number, rois_.size());
    Roi& roi = rois_.emplace_back();
    roi.number = json_text(one_line(number));
    roi.label.id = roi.number;
    return roi;
  }

  static constexpr std::size_t few = 16;  // contours that are no work for threads
  static constexpr const char* too_few = "closed contour of less than 3 points";

  DicomObject& object_;
  bool has_pin_holes_;
  unsigned threads_;
  std::vector<Roi> rois_;
  std::map<std::string, std::size_t, std::less<>> by_number_;
  std::vector<SpaceContour> contours_;
  bool is_exclusive_or_ = true;  // all of them
  Problems problems_;
};

}  // namespace

Stack read_structure_set(DicomObject& object, const ReadOptions& options) {
  return StructureSet(object, options).read();
}

}  // namespace loft::io
