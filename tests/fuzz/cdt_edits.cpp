// SPDX-License-Identifier: MIT
// A target for libFuzzer: bytes are a script of edits, judged as random scripts are. Without
// libFuzzer, replay.cpp plays files of such bytes.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/cdt/edits.h"
#include "tests/cdt/judge.h"
#include "tests/fuzz/edit_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace loft::cdt;
  EditBytes decoder({bytes, size});
  const Script script = decoder.script();
  if (script.empty()) return 0;
  Tally tally;
  std::string words = verdict(script, {4, 24}, tally);
  if (words.empty() && decoder.is_on_grid() && tally.snapped_in_vain > 0)
    words = "snapped although there is an exact answer\n" + as_text(script);
  if (words.empty()) return 0;
  std::fprintf(stderr, "%s\n", words.c_str());
  std::abort();
}
