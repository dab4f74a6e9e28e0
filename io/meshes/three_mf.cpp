// SPDX-License-Identifier: MIT
#include "io/meshes/three_mf.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/bytes/hexadecimal.h"
#include "io/bytes/text.h"
#include "io/bytes/utf8.h"
#include "io/bytes/zip.h"
#include "io/meshes/label_colour.h"
#include "io/meshes/rim.h"
#include "io/version.h"
#include "reconstruct/defect.h"
#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

constexpr std::string_view xml_line = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

constexpr std::string_view content_types =
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
    "<Default Extension=\"rels\" "
    "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
    "<Default Extension=\"model\" "
    "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";

constexpr std::string_view relationships =
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
    "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n";

/// A unit of 3MF, and what numbers are multiplied by to be in it.
struct ModelUnit {
  std::string_view name;
  double factor = 1;
};

ModelUnit unit_of(double metres_per_unit) {
  constexpr std::array<std::pair<double, std::string_view>, 6> units{{{1e-6, "micron"},
                                                                      {1e-3, "millimeter"},
                                                                      {1e-2, "centimeter"},
                                                                      {0.0254, "inch"},
                                                                      {0.3048, "foot"},
                                                                      {1, "meter"}}};
  for (const auto& [metres, name] : units)
    if (metres == metres_per_unit) return {name};
  return {"millimeter", metres_per_unit * 1000};
}

/// As the value of an attribute.
std::string xml_text(const std::string& text) {
  std::string result;
  for (const char c : json_text(one_line(text))) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string object_name(const Part& part) {
  return part.label.empty() ? "surface" : xml_text(part.label);
}

void append_xml_vertices(std::string& xml, const Mesh& mesh, double factor) {
  constexpr std::array<std::string_view, 3> axes{"<vertex x=\"", "\" y=\"", "\" z=\""};
  xml += "<vertices>\n";
  for (const Vec3& point : mesh.points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      xml += axes[axis];
      append_number(xml, point[axis] * factor);
    }
    xml += "\"/>\n";
  }
  xml += "</vertices>\n";
}

void append_xml_triangles(std::string& xml, const Mesh& mesh) {
  constexpr std::array<std::string_view, 3> corners{"<triangle v1=\"", "\" v2=\"", "\" v3=\""};
  xml += "<triangles>\n";
  for (const auto& face : mesh.faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      xml += corners[i];
      append_number(xml, std::size_t{face[i]});
    }
    xml += "\"/>\n";
  }
  xml += "</triangles>\n";
}

/// Resource 1 is the list of colours, object i is i + 2.
std::string model_xml(std::span<const Part> parts, const WriteOptions& options) {
  const ModelUnit unit = unit_of(options.metres_per_unit);
  std::string colours;
  std::string objects;
  std::string items;
  std::size_t count = 0;
  for (const Part& part : parts) {
    if (part.surface->n_faces() == 0) continue;
    const Mesh mesh = to_mesh(*part.surface);
    const std::string name = object_name(part);
    const std::string id = std::to_string(count + 2);
    colours +=
        "<base name=\"" + name + "\" displaycolor=\"" + hexadecimal(colour_of(part)) + "\"/>\n";
    objects += "<object id=\"" + id + "\" name=\"" + name + "\" type=\"" +
               (has_rim(*part.surface) ? "surface" : "model") + "\" pid=\"1\" pindex=\"" +
               std::to_string(count) + "\"><mesh>\n";
    append_xml_vertices(objects, mesh, unit.factor);
    append_xml_triangles(objects, mesh);
    objects += "</mesh></object>\n";
    items += "<item objectid=\"" + id + "\"/>\n";
    ++count;
  }
  if (count == 0) throw Error("3MF cannot hold a surface without faces");
  return std::string(xml_line) + "<model unit=\"" + std::string(unit.name) +
         "\" xml:lang=\"en-US\" "
         "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
         "<metadata name=\"Application\">" +
         std::string(generator()) + "</metadata>\n<resources>\n<basematerials id=\"1\">\n" +
         colours + "</basematerials>\n" + objects + "</resources>\n<build>\n" + items +
         "</build>\n</model>\n";
}

}  // namespace

double three_mf_factor(double metres_per_unit) { return unit_of(metres_per_unit).factor; }

void write_3mf(std::ostream& out, std::span<const Part> parts, const WriteOptions& options) {
  const std::string types = std::string(xml_line) + std::string(content_types);
  const std::string rels = std::string(xml_line) + std::string(relationships);
  const std::string model = model_xml(parts, options);
  const std::array entries{ZipEntry{"[Content_Types].xml", types}, ZipEntry{"_rels/.rels", rels},
                           ZipEntry{"3D/3dmodel.model", model}};
  const std::string bytes = zip(entries);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace loft::io
