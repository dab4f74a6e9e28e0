// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <random>
#include <sstream>
#include <string>

#include "tests/app/program.h"

namespace loft::app::testing {

/// A stack of `count` labels of random sizes side by side, `slices` slices each.
inline std::string many_labels(int count, std::uint32_t seed, int slices = 3, int most = 200) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> corners(3, most);
  std::string rings[2];
  std::string names;
  for (int i = 0; i < count; ++i) {
    const std::string comma = i == 0 ? "" : ", ";
    const int n = corners(random);
    rings[0] += comma + ring(1, n, 3.0 * i);
    rings[1] += comma + ring(1.2, n, 3.0 * i);
    names += comma + "\"cell " + std::to_string(i) + '"';
  }
  std::ostringstream text;
  for (int z = 0; z < slices; ++z)
    text << R"({"z": )" << z << R"(, "contours": [)" << rings[z % 2] << R"(], "labels": [)" << names
         << "]}\n";
  return text.str();
}

/// All files below a folder of the test, by their names in it.
inline std::map<std::string, std::string> files_in(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[std::filesystem::relative(entry.path(), folder).string()] = content(entry.path());
  return files;
}

}  // namespace loft::app::testing
