// SPDX-License-Identifier: MIT
#include "app/commands/reconstruct_report.h"

#include <algorithm>

#include "app/json.h"
#include "app/memory.h"
#include "io/unit.h"

namespace loft::app {

std::array<std::size_t, 4> count_kinds(const Surface& surface) {
  std::array<std::size_t, 4> counts{};
  for (const auto vertex : surface.vertices()) {
    ++counts[static_cast<std::size_t>(surface.data(vertex).origin.kind)];
  }
  return counts;
}

CleaningSummary summarize(const std::vector<Defect>& repairs) {
  CleaningSummary summary;
  std::map<std::uint32_t, CleaningSummary::Slice> slices;
  for (const Defect& repair : repairs) {
    summary.area += repair.area;
    ++summary.counts[loft::name(repair.kind)];
    auto& slice = slices[repair.slice];
    slice.slice = repair.slice;
    slice.z = repair.z;
    ++slice.repairs;
    slice.area += repair.area;
  }
  for (const auto& [number, slice] : slices) summary.slices.push_back(slice);
  std::ranges::stable_sort(summary.slices, {}, &CleaningSummary::Slice::z);
  return summary;
}

std::string describe(const CleaningSummary& summary, std::string_view unit) {
  const std::string area_unit = ' ' + unit_word(unit) + "^2";
  std::string text = "cleaning:";
  for (const auto& [kind, count] : summary.counts)
    text += (text.back() == ':' ? " " : ", ") + grouped(count) + ' ' + kind;
  text += " in " + grouped(summary.slices.size()) +
          (summary.slices.size() == 1 ? " slice" : " slices") + "; area in question " +
          rounded(summary.area) + area_unit;
  const auto worst = std::ranges::max_element(summary.slices, {}, &CleaningSummary::Slice::area);
  if (worst != summary.slices.end() && worst->area > 0 && summary.slices.size() > 1)
    text += ", most in slice " + std::to_string(worst->slice) + " (z = " + rounded(worst->z) +
            "): " + rounded(worst->area) + area_unit;
  return text;
}

namespace {

Json to_json(const Defect& defect) {
  Json json;
  json["kind"] = loft::name(defect.kind);
  json["slice"] = defect.slice;
  json["z"] = defect.z;
  json["contour"] = defect.contour ? Json(*defect.contour) : Json();
  json["point"] = defect.point ? Json(*defect.point) : Json();
  json["place"] = defect.place ? Json::array({defect.place->x, defect.place->y}) : Json();
  json["area"] = defect.area;
  json["message"] = defect.message;
  return json;
}

Json to_json(const CleaningSummary& summary) {
  Json json;
  json["area"] = summary.area;
  json["counts"] = summary.counts;
  json["slices"] = Json::array();
  for (const auto& [slice, z, repairs, area] : summary.slices)
    json["slices"].push_back({{"slice", slice}, {"z", z}, {"repairs", repairs}, {"area", area}});
  return json;
}

Json slice_index(std::uint32_t slice) { return slice == Origin::none ? Json() : Json(slice); }

Json side(const std::vector<ContourId>& contours, cdt::Point place) {
  Json json;
  json["contours"] = Json::array();
  for (const auto& [slice, contour] : contours)
    json["contours"].push_back(Json::array({slice, contour}));
  json["place"] = contours.empty() ? Json() : Json::array({place.x, place.y});
  return json;
}

Json to_json(const LinkReport& link) {
  const bool is_end = link.kind == LinkKind::birth || link.kind == LinkKind::death;
  const bool is_alone = is_end && link.reason != LinkReason::order;
  Json json;
  json["kind"] = loft::name(link.kind);
  json["of"] = link.is_solid ? "part" : "cavity";
  json["rule"] = is_alone ? Json() : Json(loft::name(link.reason));
  json["lower"] = side(link.lower, link.lower_place);
  json["upper"] = side(link.upper, link.upper_place);
  json["shift"] = link.shift;
  json["turn"] = link.turn;
  json["overlap"] = link.overlap;
  json["confidence"] = link.confidence;
  return json;
}

Json to_json(const SlabReport& slab) {
  Json json;
  json["slices"] = {slice_index(slab.lower_slice), slice_index(slab.upper_slice)};
  json["z"] = {slab.lower_z, slab.upper_z};
  json["sheet_area"] = slab.sheet_area;
  json["wall_area"] = slab.wall_area;
  json["overlap"] = slab.overlap;
  json["shift"] = slab.shift;
  json["confidence"] = slab.confidence;
  json["links"] = Json::array();
  for (const LinkReport& link : slab.links) json["links"].push_back(to_json(link));
  return json;
}

void add_size(Json& json, const StackSize& size) {
  json["slices"] = size.slices;
  json["contours"] = size.contours;
  json["vertices_in"] = size.vertices;
}

Json to_json(const PartReport& part, bool lists_slabs) {
  Json json;
  json["label"] = part.label;
  add_size(json, part.input);
  add_measures(json, part.measures);
  json["slab_volume"] = part.slab_volume;
  add_angles(json, part.measures.angles);
  json["seconds"] = part.seconds;
  json["peak_memory_mb"] = megabytes(part.peak_memory);
  const auto& [contour, cleaning, crossing, steiner] = part.vertices_of_kind;
  json["vertices_of_kind"] = {
      {"contour", contour}, {"cleaning", cleaning}, {"crossing", crossing}, {"steiner", steiner}};
  json["cleaning"] = to_json(summarize(part.repairs));
  json["repairs"] = Json::array();
  for (const Defect& repair : part.repairs) json["repairs"].push_back(to_json(repair));
  if (!lists_slabs) return json;
  json["slabs"] = Json::array();
  for (const SlabReport& slab : part.slabs) json["slabs"].push_back(to_json(slab));
  return json;
}

Measures sum(const std::vector<PartReport>& parts) {
  Measures total;
  for (const PartReport& part : parts) {
    total.vertices += part.measures.vertices;
    total.edges += part.measures.edges;
    total.faces += part.measures.faces;
    total.components += part.measures.components;
    total.genus += part.measures.genus;
    total.area += part.measures.area;
    total.volume += part.measures.volume;
  }
  return total;
}

}  // namespace

std::string to_json(const Report& report, const ReconstructCommand& command) {
  Json json = begin_report("loft-reconstruct", 2, command.inputs, command.outputs);
  json["options"] = {
      {"fill", name(command.options.fill)},
      {"keyhole_width",
       command.options.keyhole_width ? Json(*command.options.keyhole_width) : Json()},
      {"tolerance", command.options.tolerance},
      {"height_tolerance", command.options.height_tolerance},
      {"cap", name(command.options.cap)},
      {"link", name(command.options.link)},
      {"max_shift", command.options.max_shift ? Json(*command.options.max_shift) : Json()},
      {"links", command.links ? Json(command.links->string()) : Json()},
      {"smooth", command.options.smooth},
      {"metres_per_unit", *io::metres_per_unit(command.unit)}};
  for (const auto& [setting, length] : lengths(command.options)) json["options"][setting] = length;
  json["out_of_core"] = report.is_out_of_core;
  const Shard& shard = command.shard;
  json["shard"] = shard.is_all() ? Json() : Json::array({shard.index, shard.count});
  add_size(json, report.input);
  add_measures(json, sum(report.parts));
  json["seconds"] = report.seconds;
  json["peak_memory_mb"] = megabytes(report.peak_memory);
  json["skipped"] = Json::array();
  for (const auto& [label, message] : report.skipped)
    json["skipped"].push_back({{"label", label}, {"message", message}});
  json["existing"] = report.existing;
  json["parts"] = Json::array();
  for (const PartReport& part : report.parts) json["parts"].push_back(to_json(part, command.slabs));
  return print(json);
}

}  // namespace loft::app
