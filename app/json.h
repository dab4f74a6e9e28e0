// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "io/version.h"
#include "mesh/measure.h"

namespace loft::app {

/// Keys stay in the order in which they were added.
using Json = nlohmann::ordered_json;

/// The report as text; bytes that are not UTF-8 (file names) are replaced.
inline std::string print(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

/// A list of file names.
inline Json names(std::span<const std::filesystem::path> paths) {
  Json json = Json::array();
  for (const auto& path : paths) json.push_back(path.string());
  return json;
}

/// How the report of a command begins that makes files out of files: schema, schema_version, loft
/// (version), inputs, outputs.
inline Json begin_report(const char* schema, int version,
                         std::span<const std::filesystem::path> inputs,
                         std::span<const std::filesystem::path> outputs) {
  Json json;
  json["schema"] = schema;
  json["schema_version"] = version;
  json["loft"] = io::version();
  json["inputs"] = names(inputs);
  json["outputs"] = names(outputs);
  return json;
}

/// vertices, faces, components, genus, area, volume.
inline void add_measures(Json& json, const Measures& measures) {
  json["vertices"] = measures.vertices;
  json["faces"] = measures.faces;
  json["components"] = measures.components;
  json["genus"] = measures.genus;
  json["area"] = measures.area;
  json["volume"] = measures.volume;
}

/// angles: least, percentile_5, median of the faces' smallest ones, in degrees; worst_aspect.
inline void add_angles(Json& json, const Angles& angles) {
  json["angles"] = {{"least", angles.smallest},
                    {"percentile_5", angles.fifth_percentile},
                    {"median", angles.median},
                    {"worst_aspect", angles.worst_aspect}};
}

}  // namespace loft::app
