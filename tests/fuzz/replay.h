// SPDX-License-Identifier: MIT
// Plays the inputs of a fuzz target without libFuzzer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include "tests/fuzz/inputs.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

namespace loft::fuzz {

inline void play_bytes(const std::string& content) {
  const std::vector<std::uint8_t> bytes(content.begin(), content.end());
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
}

/// A program: calls play(path, content) for every file in the folders named by its arguments.
/// Fails where there is none, and where one throws.
template <class Play>
int replay(std::span<char* const> folders, Play play) {
  try {
    std::size_t count = 0;
    for (const char* folder : folders) {
      for (const auto& file : files_in(folder)) {
        std::printf("%s\n", file.filename().c_str());
        std::fflush(stdout);
        play(file, read(file));
        ++count;
      }
    }
    std::printf("%zu files played\n", count);
    return count > 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

}  // namespace loft::fuzz
