// SPDX-License-Identifier: MIT
// Bytes are a small stack (tests/reconstruct/any_stack.h) and its options: what is made of it is a
// valid solid, and the region of each slice has the exact area of its contours.
#include "reconstruct/reconstruct.h"
#include "tests/fuzz/target.h"
#include "tests/reconstruct/any_stack.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace loft;
  const stacks::AnyStack any = stacks::stack_from_bytes({bytes, size});
  const std::string wrong = stacks::complaint(any);
  if (!wrong.empty()) std::fprintf(stderr, "%s\n", stacks::as_words(any).c_str());
  fuzz::require(wrong.empty(), wrong);
  return 0;
}
