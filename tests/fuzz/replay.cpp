// SPDX-License-Identifier: MIT
//   replay FOLDER...     plays every file in them; .txt is a script of edits, anything else is
//   bytes
#include "tests/fuzz/replay.h"

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>

#include "tests/cdt/judge.h"

namespace {

void play(const std::filesystem::path& path, const std::string& content) {
  if (path.extension() != ".txt") {
    loft::fuzz::play_bytes(content);
    return;
  }
  loft::cdt::Tally tally;
  const std::string words = verdict(loft::cdt::read_script(content), {1, 100}, tally);
  if (!words.empty()) throw std::runtime_error(words);
}

}  // namespace

int main(int argc, char** argv) {
  return loft::fuzz::replay(std::span(argv, static_cast<std::size_t>(argc)).subspan(1), play);
}
