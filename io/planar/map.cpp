// SPDX-License-Identifier: MIT
#include "io/planar/map.h"

#include "io/bytes/json_reader.h"

namespace loft::io {

namespace {

/// Calls visit(key, json) for each property; it must take the value that comes next.
template <class Visit>
void visit_properties(const Feature& feature, Visit visit) {
  if (feature.properties.empty()) return;
  JsonReader json(feature.properties);
  if (json.peek() != JsonKind::object) return;
  json.begin_object();
  while (const auto key = json.next_key()) visit(*key, json);
}

std::optional<std::string> text_of_value(JsonReader& json) {
  const JsonKind kind = json.peek();
  if (kind == JsonKind::string) return json.string();
  const std::string_view text = json.text();
  if (kind == JsonKind::number || kind == JsonKind::boolean) return std::string(text);
  return {};
}

}  // namespace

std::optional<std::string> property(const Feature& feature, std::string_view key) {
  std::optional<std::string> result;
  visit_properties(feature, [&](const std::string& found, JsonReader& json) {
    if (found == key) {
      result = text_of_value(json);
    } else {
      json.skip();
    }
  });
  return result;
}

std::optional<std::string> id_or_name(const Feature& feature) {
  if (!feature.id.empty()) {
    JsonReader json(feature.id);
    if (auto id = text_of_value(json)) return id;
  }
  return property(feature, "name");
}

std::vector<std::string> property_names(const Feature& feature) {
  std::vector<std::string> names;
  visit_properties(feature, [&](const std::string& key, JsonReader& json) {
    names.push_back(key);
    json.skip();
  });
  return names;
}

}  // namespace loft::io
