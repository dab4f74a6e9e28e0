// SPDX-License-Identifier: MIT
#include "io/dicom/seg.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "io/dicom/cielab.h"
#include "io/dicom/seg_frames.h"
#include "io/dicom/seg_pixels.h"
#include "io/volumes/outlines.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

enum class SegKind { binary, fractional, label_map };

class Segmentation {
 public:
  Segmentation(DicomObject& object, const ReadOptions& options)
      : object_(object), options_(options) {}

  Stack read() {
    read_kind();
    read_sizes();
    frames_ = read_seg_frames(object_, kind_ != SegKind::label_map);
    read_pixels();
    read_segments();
    if (kind_ != SegKind::label_map) find_layers();
    set_volume();
    Stack stack = trace(volume_, options_);
    if (frames_.spacing > 0) stack.gap = frames_.spacing;
    return stack;
  }

 private:
  [[noreturn]] void fail(const std::string& path, const std::string& what) const {
    throw InputError(object_.name() + ": " + path + ": " + what);
  }

  void read_kind() {
    const std::string type = object_.text(object_.data_set(), DCM_SegmentationType);
    const bool is_label_map =
        object_.text(object_.data_set(), DCM_SOPClassUID) == label_map_segmentation;
    if (is_label_map || type == "LABELMAP")
      kind_ = SegKind::label_map;
    else if (type == "FRACTIONAL")
      kind_ = SegKind::fractional;
    else if (type != "BINARY")
      fail("(0062,0001)", "the type of segmentation '" + type +
                              "' is not BINARY, FRACTIONAL or LABELMAP; export it again");
  }

  [[nodiscard]] std::uint16_t number(const DcmTagKey& tag, std::uint16_t otherwise) const {
    Uint16 value = 0;
    return object_.data_set().findAndGetUint16(tag, value).good() ? value : otherwise;
  }

  void read_sizes() {
    volume_.rows = number(DCM_Rows, 0);
    volume_.columns = number(DCM_Columns, 0);
    if (volume_.rows == 0) fail("(0028,0010)", "there are no rows; export the segmentation again");
    if (volume_.columns == 0)
      fail("(0028,0011)", "there are no columns; export the segmentation again");
    if (number(DCM_SamplesPerPixel, 1) != 1)
      fail("(0028,0002)", "segments have one sample a pixel; export the segmentation again");
    bits_ = number(DCM_BitsAllocated, 0);
    const bool is_right =
        kind_ == SegKind::binary ? bits_ == 1 || bits_ == 8 : bits_ == 8 || bits_ == 16;
    if (!is_right)
      fail("(0028,0100)", std::to_string(bits_) +
                              " bits a pixel are none that such segments have; export it again");
  }

  void read_pixels() {
    const std::size_t count = frames_.frames.size();
    const auto told = to_number(trimmed_value_of(object_.data_set(), DCM_NumberOfFrames));
    if (told && *told != static_cast<double>(count))
      fail("(0028,0008)", "frames are said to be " + std::to_string(std::llround(*told)) +
                              ", but (5200,9230) has " + std::to_string(count) +
                              " of them; export the segmentation again");
    pixels_.emplace(object_, bits_, std::uint64_t{volume_.rows} * volume_.columns, count);
  }

  void read_segments() {
    for_each_item(sequence_of(object_.data_set(), DCM_SegmentSequence),
                  [this](DcmItem& item, std::size_t i) {
                    Uint16 segment = 0;
                    if (item.findAndGetUint16(DCM_SegmentNumber, segment).bad())
                      fail("(0062,0002)[" + std::to_string(i) + "]/(0062,0004)",
                           "the segment has no number; export the segmentation again");
                    if (segment != 0) segments_.try_emplace(segment, label_of(item, segment));
                  });
    for (const SegFrame& frame : frames_.frames) {
      const std::string id = std::to_string(frame.segment);
      if (frame.segment != 0 &&
          segments_.try_emplace(frame.segment, StackLabel{"segment " + id, {}, id}).second)
        volume_.notes.push_back(object_.name() + ": segment " + id +
                                " has frames, but (0062,0002) does not list it");
    }
  }

  [[nodiscard]] StackLabel label_of(DcmItem& item, std::uint16_t segment) {
    StackLabel label{object_.text(item, DCM_SegmentLabel), {}, std::to_string(segment)};
    if (label.name.empty()) label.name = "segment " + label.id;
    std::array<Uint16, 3> parts{};
    bool has_colour = true;
    for (std::size_t i = 0; i < parts.size(); ++i)
      has_colour = has_colour && item.findAndGetUint16(DCM_RecommendedDisplayCIELabValue, parts[i],
                                                       static_cast<unsigned long>(i))
                                     .good();
    if (has_colour) label.colour = from_cielab(parts);
    if (DcmItem* const category = first_item_of(item, DCM_SegmentedPropertyCategoryCodeSequence))
      label.kind = object_.text(*category, DCM_CodeMeaning);
    return label;
  }

  /// Segments that have frames get a layer each.
  void find_layers() {
    std::map<std::uint16_t, std::uint32_t> layers;
    for (const SegFrame& frame : frames_.frames) layers.emplace(frame.segment, 0);
    std::uint32_t count = 0;
    for (auto& [segment, layer] : layers) layer = count++;
    volume_.layers = count;
    for (std::size_t i = 0; i < frames_.frames.size(); ++i) {
      const SegFrame& frame = frames_.frames[i];
      add_frame(frame.plane, layers.at(frame.segment), i);
    }
    std::string absent;
    for (const auto& [segment, label] : segments_) {
      const auto found = layers.find(segment);
      if (found != layers.end())
        volume_.labels.push_back({label, found->second, 1});
      else
        absent += (absent.empty() ? "" : ", ") + label.name;
    }
    if (!absent.empty())
      volume_.notes.push_back(object_.name() + ": segments without a frame, left out: " + absent);
  }

  void add_frame(std::uint32_t plane, std::uint32_t layer, std::size_t frame) {
    const auto [other, is_new] = frame_at_.try_emplace({plane, layer}, frame);
    if (is_new) return;
    fail("(5200,9230)[" + std::to_string(frame) + "]",
         "is in the plane of frame " + std::to_string(other->second) +
             ", and of the same segment; export one point of time, or one segmentation");
  }

  [[nodiscard]] double half_of_largest() const {
    const std::uint16_t largest = number(DCM_MaximumFractionalValue, 255);
    if (largest == 0)
      fail("(0062,000e)", "the largest value is 0, of which no pixel is a share; export it again");
    return largest / 2.0;
  }

  void set_volume() {
    volume_.name = object_.name();
    volume_.slices = static_cast<std::uint32_t>(frames_.positions.size());
    volume_.to_world = frames_.to_world;
    volume_.positions = frames_.positions;
    volume_.unit = "mm";
    volume_.notes.insert(volume_.notes.end(), object_.notes().begin(), object_.notes().end());
    if (kind_ == SegKind::fractional) volume_.level = options_.level.value_or(half_of_largest());
    if (kind_ == SegKind::label_map) {
      for (std::size_t i = 0; i < frames_.frames.size(); ++i)
        add_frame(frames_.frames[i].plane, 0, i);
      for (const auto& [segment, label] : segments_)
        volume_.labels.push_back({label, 0, static_cast<double>(segment)});
    }
    volume_.read = [this](std::uint32_t slice, std::uint32_t layer, std::span<double> out) {
      const auto found = frame_at_.find({slice, layer});
      if (found == frame_at_.end())
        std::ranges::fill(out, 0);
      else
        read_frame(found->second, out);
    };
  }

  void read_frame(std::size_t frame, std::span<double> out) const {
    pixels_->read(frame, out);
    if (kind_ == SegKind::binary)
      for (double& value : out) value = value != 0 ? 1 : 0;
  }

  DicomObject& object_;
  const ReadOptions& options_;
  SegKind kind_ = SegKind::binary;
  std::uint16_t bits_ = 0;
  std::optional<SegPixels> pixels_;
  SegFrames frames_;
  std::map<std::uint16_t, StackLabel> segments_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> frame_at_;  // by plane, layer
  Volume volume_;
};

}  // namespace

Stack read_segmentation(DicomObject& object, const ReadOptions& options) {
  return Segmentation(object, options).read();
}

}  // namespace loft::io
