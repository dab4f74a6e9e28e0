// SPDX-License-Identifier: MIT
#include "app/report.h"

#include <nlohmann/json.hpp>
#include <sstream>

#include "app/json.h"
#include "io/version.h"

namespace loft::app {

StackSize size_of(const std::vector<Slice>& stack, const std::optional<std::string>& label) {
  StackSize size;
  for (const Slice& slice : stack) {
    const std::size_t before = size.contours;
    for (const Contour& contour : slice.contours) {
      if (label && contour.label != *label) continue;
      ++size.contours;
      size.vertices += contour.points.size();
    }
    if (size.contours > before) ++size.slices;
  }
  return size;
}

std::array<std::size_t, 4> count_kinds(const Surface& surface) {
  std::array<std::size_t, 4> counts{};
  for (const auto vertex : surface.vertices()) {
    ++counts[static_cast<std::size_t>(surface.data(vertex).origin.kind)];
  }
  return counts;
}

const char* name(Fill fill) { return fill == Fill::even_odd ? "evenodd" : "nonzero"; }

const char* name(Cap cap) {
  switch (cap) {
    case Cap::flat:
      return "flat";
    case Cap::dome:
      return "dome";
    case Cap::open:
      break;
  }
  return "open";
}

const char* name(LinkRule rule) {
  switch (rule) {
    case LinkRule::automatic:
      return "auto";
    case LinkRule::overlap:
      return "overlap";
    case LinkRule::none:
      break;
  }
  return "none";
}

const char* name(Stage stage) {
  switch (stage) {
    case Stage::clean:
      return "clean";
    case Stage::tile:
      return "tile";
    case Stage::sew:
      break;
  }
  return "sew";
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

Json to_json(const PartReport& part) {
  Json json;
  json["label"] = part.label;
  add_size(json, part.input);
  add_measures(json, part.measures);
  json["seconds"] = part.seconds;
  const auto& [contour, cleaning, crossing, steiner] = part.vertices_of_kind;
  json["vertices_of_kind"] = {
      {"contour", contour}, {"cleaning", cleaning}, {"crossing", crossing}, {"steiner", steiner}};
  json["repairs"] = Json::array();
  for (const Defect& repair : part.repairs) json["repairs"].push_back(to_json(repair));
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
  Json json;
  json["schema"] = "loft-reconstruct";
  json["schema_version"] = 1;
  json["loft"] = io::version();
  json["inputs"] = names(command.inputs);
  json["outputs"] = names(command.outputs);
  json["options"] = {
      {"fill", name(command.options.fill)},
      {"cap", name(command.options.cap)},
      {"link", name(command.options.link)},
      {"max_shift", command.options.max_shift ? Json(*command.options.max_shift) : Json()},
      {"links", command.links ? Json(command.links->string()) : Json()},
      {"metres_per_unit", command.metres_per_unit}};
  add_size(json, report.input);
  add_measures(json, sum(report.parts));
  json["seconds"] = report.seconds;
  json["parts"] = Json::array();
  for (const PartReport& part : report.parts) json["parts"].push_back(to_json(part));
  return print(json);
}

std::string grouped(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t place = digits.size(); place > 3; place -= 3) digits.insert(place - 3, 1, ',');
  return digits;
}

std::string rounded(double number) {
  std::ostringstream text;
  text.precision(4);
  text << number;
  return text.str();
}

std::string describe(const Measures& measures) {
  return grouped(measures.faces) + " triangles, " + grouped(measures.vertices) + " vertices, " +
         grouped(measures.components) +
         (measures.components == 1 ? " component, genus " : " components, genus ") +
         std::to_string(measures.genus) + ", area " + rounded(measures.area) + ", volume " +
         rounded(measures.volume);
}

}  // namespace loft::app
