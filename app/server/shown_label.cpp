// SPDX-License-Identifier: MIT
#include "app/server/shown_label.h"

#include "io/bytes/hexadecimal.h"
#include "io/meshes/label_colour.h"
#include "mesh/vec3.h"

namespace loft::app {

namespace {

Json number_or_null(std::optional<double> number) { return number ? Json(*number) : Json(); }

Json one_to_json(const ShownLabel& label) {
  return {
      {"label", label.label},
      {"colour", io::hexadecimal(label.colour.value_or(io::srgb(io::label_colour(label.label))))},
      {"is_skin", label.is_skin},
      {"slices", label.slices},
      {"volume", number_or_null(label.volume)},
      {"area", number_or_null(label.area)},
      {"faces", label.faces}};
}

}  // namespace

Json to_json(std::span<const ShownLabel> labels) {
  Json all = Json::array();
  for (const ShownLabel& label : labels) all.push_back(one_to_json(label));
  return {{"labels", std::move(all)}};
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [i, j, k] : mesh.faces) {
    const Vec3& origin = mesh.points[i];
    sum += length(cross(minus(mesh.points[j], origin), minus(mesh.points[k], origin)));
  }
  return sum / 2;
}

}  // namespace loft::app
