// SPDX-License-Identifier: MIT
#include "io/stacks/rtstruct.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/utf8.h"
#include "io/stacks/pin_holes.h"
#include "io/stacks/space_contours.h"
#include "mesh/admitted.h"

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
                       options.fill.value_or(Fill::keyhole_aware) == Fill::keyhole_aware) {}

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
    std::vector<SpaceContour> contours;
    for_each_item(sequence_of(item, DCM_ContourSequence), [&](DcmItem& contour, std::size_t i) {
      if (auto read = read_contour(contour, *roi, i, path + std::to_string(i) + ']'))
        contours.push_back(std::move(*read));
    });
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

  /// None for what is not closed, or has a number that is none.
  std::optional<SpaceContour> read_contour(DcmItem& item, Roi& roi, std::size_t index,
                                           const std::string& path) {
    const std::string_view type = trimmed_value_of(item, DCM_ContourGeometricType);
    const bool is_exclusive_or = type == "CLOSEDPLANAR_XOR";
    if (!is_exclusive_or && type != "CLOSED_PLANAR") {
      ++roi.left_out[type.empty() ? "contour of no type" : in_words(type)];
      return {};
    }
    SpaceContour contour{
        {}, roi.label.name, "ROI " + roi.number + " contour " + std::to_string(index)};
    if (!read_points(item, contour.points, path)) return {};
    const auto count = to_number(trimmed_value_of(item, DCM_NumberOfContourPoints));
    if (count && *count != static_cast<double>(contour.points.size())) ++roi.miscounted;
    while (contour.points.size() > 1 && contour.points.front() == contour.points.back())
      contour.points.pop_back();
    if (contour.points.size() > 2) is_exclusive_or_ = is_exclusive_or_ && is_exclusive_or;
    return contour;
  }

  static std::string in_words(std::string_view type) { return one_line(type.substr(0, 40)); }

  bool read_points(DcmItem& item, std::vector<Vec3>& points, const std::string& path) {
    std::string_view text = trimmed_value_of(item, DCM_ContourData);
    const auto fail = [&](const std::string& message) {
      problems_.add(object_.name() + ": " + path + "/(3006,0050): " + message);
      return false;
    };
    const auto count = static_cast<std::size_t>(std::ranges::count(text, '\\')) + 1;
    if (text.empty()) return true;
    if (count % 3 != 0)
      return fail("has " + std::to_string(count) +
                  " numbers, which are no triples x\\y\\z; export the structure again");
    points.reserve(count / 3);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view word = next_value(text);
      const auto number = to_number(word);
      if (!number || !admitted::slice.admits(*number))
        return fail("value " + std::to_string(i) + ", " + in_quotes(word) +
                    ", is no number of a usable size; export the structure again");
      if (i % 3 == 0) points.emplace_back();
      points.back()[i % 3] = *number;
    }
    return true;
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

  static constexpr const char* too_few = "closed contour of less than 3 points";

  DicomObject& object_;
  bool has_pin_holes_;
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
