// SPDX-License-Identifier: MIT
#include "app/server/shown_stack.h"

#include <algorithm>
#include <fstream>
#include <utility>

#include "io/dicom/dicom.h"
#include "io/meshes/skin.h"
#include "io/stack.h"
#include "io/unit.h"
#include "io/version.h"

namespace loft::app {

namespace {

/// Coordinates in DICOM are a patient's.
bool is_dicom(const std::filesystem::path& file) {
  std::string head(1024, '\0');
  std::ifstream bytes(file, std::ios::binary);
  bytes.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(bytes.gcount()));
  return io::begins_like_dicom(head);
}

}  // namespace

ShownStack::ShownStack(const std::filesystem::path& file, const std::string& unit)
    : ShownStack(file, io::read_stack(file), unit) {}

ShownStack::ShownStack(const std::filesystem::path& file, Stack stack, const std::string& unit)
    : name_(file.filename().string()),
      is_patient_(is_dicom(file)),
      unit_(stack.unit.empty() ? unit : stack.unit),
      contours_(std::exchange(stack.slices, {})) {
  about_ = std::move(stack);
}

std::pair<std::string, std::uint64_t> ShownStack::reset_event() const {
  const Json event{{"kind", "file"},
                   {"name", name_},
                   {"is_patient", is_patient_},
                   {"slabs", Json::array()},
                   {"slices", heights()},
                   {"counts", {{"slices", contours_.slices().size()}}},
                   {"volume", nullptr},
                   {"unit", unit_},
                   {"metres_per_unit", io::metres_per_unit(unit_).value_or(0.001)},
                   {"downloads", Json::array()}};
  return {event.dump(-1, ' ', false, Json::error_handler_t::replace), 1};
}

Json ShownStack::status() const {
  return {{"slices", contours_.slices().size()}, {"version", io::version()}};
}

std::vector<ShownLabel> ShownStack::labels() {
  std::vector<ShownLabel> labels;
  for (const auto& [z, slice] : contours_.slices()) {
    for (const Contour& contour : slice.contours) {
      if (std::ranges::find(labels, contour.label, &ShownLabel::label) != labels.end()) continue;
      const StackLabel* const said = about_.find_label(contour.label);
      labels.push_back({.label = contour.label,
                        .colour = said == nullptr ? std::nullopt : said->colour,
                        .is_skin = io::is_skin(contour.label, said == nullptr ? "" : said->kind),
                        .slices = contours_.count(contour.label),
                        .volume = {},
                        .area = {}});
    }
  }
  return labels;
}

}  // namespace loft::app
