// SPDX-License-Identifier: MIT
//   replay FOLDER...     plays every file in them as bytes
#include <filesystem>
#include <span>
#include <string>

#include "tests/fuzz/replay.h"

int main(int argc, char** argv) {
  return loft::fuzz::replay(std::span(argv, static_cast<std::size_t>(argc)).subspan(1),
                            [](const std::filesystem::path&, const std::string& content) {
                              loft::fuzz::play_bytes(content);
                            });
}
