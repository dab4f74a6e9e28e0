// SPDX-License-Identifier: MIT
// Plays the inputs of a fuzz target without libFuzzer: replay FOLDER, every file in it as bytes.
#include <cstdint>
#include <cstdio>
#include <exception>

#include "tests/fuzz/inputs.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

int main(int argc, char** argv) {
  try {
    std::size_t count = 0;
    for (int i = 1; i < argc; ++i) {
      for (const auto& file : loft::fuzz::files_in(argv[i])) {
        std::printf("%s\n", file.filename().c_str());
        std::fflush(stdout);
        const std::string content = loft::fuzz::read(file);
        const std::vector<std::uint8_t> bytes(content.begin(), content.end());
        LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
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
