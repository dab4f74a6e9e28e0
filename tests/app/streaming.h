// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/meshes.h"
#include "tests/app/running.h"

namespace loft::app::testing {

using nlohmann::json;

/// A number from the environment, for long runs.
inline int count_from(const char* variable, int usual) {
  const char* const wanted = std::getenv(variable);
  return wanted == nullptr ? usual : std::atoi(wanted);
}

/// The triangles of a mesh file by their places, in an order of their own.
inline std::vector<std::array<Vec3, 3>> triangles(const std::filesystem::path& path) {
  std::vector<std::array<Vec3, 3>> all;
  for (const io::LabelledMesh& part : io::read_meshes(path)) {
    for (const auto& [a, b, c] : part.mesh.faces) {
      auto& corners = all.emplace_back(
          std::array{part.mesh.points[a], part.mesh.points[b], part.mesh.points[c]});
      std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    }
  }
  std::ranges::sort(all);
  return all;
}

/// A slice of a cone that leans, with n points.
inline std::string leaning(int i, int n = 16) { return slice(i, ring(5 + 0.1 * i, n, 0.2 * i)); }

inline std::string stack(int count, int n = 16) {
  std::string lines;
  for (int i = 0; i < count; ++i) lines += leaning(i, n);
  return lines;
}

/// The surface that a file holds is that of a stack built at once.
inline void expect_surface_of(const Folder& folder, const std::string& stack,
                              const std::string& file) {
  std::ofstream(folder / "at_once.ndjson") << stack;
  ASSERT_EQ(run(folder, "reconstruct at_once.ndjson -o at_once.ply").exit_code, 0);
  EXPECT_EQ(triangles(folder / file), triangles(folder / "at_once.ply"));
}

/// Reads server-sent events until it is enough.
inline std::vector<std::string> read_events(httplib::Client& client,
                                            const httplib::Headers& headers, std::size_t count,
                                            const std::string& path = "/events") {
  std::vector<std::string> events;
  std::string text;
  client.Get(path, headers, [&](const char* bytes, std::size_t size) {
    text.append(bytes, size);
    for (std::size_t end = text.find("\n\n"); end != std::string::npos; end = text.find("\n\n")) {
      if (text[0] != ':') events.push_back(text.substr(0, end));
      text.erase(0, end + 2);
    }
    return events.size() < count;
  });
  return events;
}

/// The event that tells a viewer of all that there is.
inline json reset_event(httplib::Client& client) {
  const std::string text = read_events(client, {}, 1).at(0);
  return json::parse(text.substr(text.find("data: ") + 6));
}

/// Edits that take all slices away.
inline std::string remove_all(httplib::Client& client) {
  std::string lines;
  const json heights = json::parse(client.Get("/slices")->body)["slices"];
  for (const json& z : heights) lines += "{\"op\":\"remove\",\"z\":" + z.dump() + "}\n";
  return lines;
}

}  // namespace loft::app::testing
