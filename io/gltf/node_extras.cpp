// SPDX-License-Identifier: MIT
#include "io/gltf/node_extras.h"

#include <charconv>
#include <string>
#include <utility>

#include "io/bytes/utf8.h"

namespace loft::io {

namespace {

using Members = tinygltf::Value::Object;

/// A number where it is one.
tinygltf::Value id_value(const std::string& id) {
  int number = 0;
  const auto [end, error] = std::from_chars(id.data(), id.data() + id.size(), number);
  const bool is_number = error == std::errc() && end == id.data() + id.size();
  return is_number && std::to_string(number) == id ? tinygltf::Value(number)
                                                   : tinygltf::Value(json_text(id));
}

void add_text(Members& members, const char* key, const std::string& text) {
  if (!text.empty()) members[key] = tinygltf::Value(json_text(text));
}

}  // namespace

tinygltf::Value part_extras(const Part& part, bool is_open, double metres_per_unit) {
  Members members;
  add_text(members, "label", part.label);
  if (!part.id.empty()) members["id"] = id_value(part.id);
  add_text(members, "kind", part.kind);
  add_text(members, "source", part.source);
  if (part.slices) members["slices"] = tinygltf::Value(static_cast<int>(*part.slices));
  const Measures measures = measure(*part.surface);
  const double square_metres = metres_per_unit * metres_per_unit;
  members["area_m2"] = tinygltf::Value(measures.area * square_metres);
  if (!is_open)
    members["volume_m3"] = tinygltf::Value(measures.volume * square_metres * metres_per_unit);
  return tinygltf::Value(std::move(members));
}

tinygltf::Value contour_extras(const Part& part, const std::string& name) {
  tinygltf::Value::Array heights;
  std::vector<int> counts;
  for (std::size_t i = 0; i < part.contours.size(); ++i) {
    const ContourLine& contour = part.contours[i];
    if (i == 0 || contour.height != part.contours[i - 1].height) {
      heights.emplace_back(contour.height);
      counts.push_back(0);
    }
    counts.back() += static_cast<int>(contour.points.size());
  }
  Members members;
  add_text(members, "label", part.label);
  add_text(members, "contours_of", name);
  members["heights"] = tinygltf::Value(std::move(heights));
  members["vertices"] = tinygltf::Value(tinygltf::Value::Array(counts.begin(), counts.end()));
  return tinygltf::Value(std::move(members));
}

}  // namespace loft::io
