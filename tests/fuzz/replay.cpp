// SPDX-License-Identifier: MIT
// Plays the inputs of a fuzz target without libFuzzer.
//   replay FOLDER...     every file in them; .txt is a script of edits, anything else is bytes
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/cdt/judge.h"
#include "tests/fuzz/inputs.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

namespace {

void replay(const std::filesystem::path& path) {
  std::printf("%s\n", path.filename().c_str());
  std::fflush(stdout);
  const std::string content = loft::fuzz::read(path);
  if (path.extension() != ".txt") {
    const std::vector<std::uint8_t> bytes(content.begin(), content.end());
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    return;
  }
  loft::cdt::Tally tally;
  const std::string words = verdict(loft::cdt::read_script(content), {1, 100}, tally);
  if (!words.empty()) throw std::runtime_error(words);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::size_t count = 0;
    for (int i = 1; i < argc; ++i) {
      for (const auto& file : loft::fuzz::files_in(argv[i])) {
        replay(file);
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
