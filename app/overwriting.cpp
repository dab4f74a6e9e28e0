// SPDX-License-Identifier: MIT
#include "app/overwriting.h"

#include <system_error>

#include "app/exit_code.h"

namespace loft::app {

using std::filesystem::path;

bool is_same_file(const path& a, const path& b) {
  std::error_code ignored;
  if (std::filesystem::equivalent(a, b, ignored)) return true;
  // Neither has to be there yet.
  return std::filesystem::weakly_canonical(std::filesystem::absolute(a), ignored) ==
         std::filesystem::weakly_canonical(std::filesystem::absolute(b), ignored);
}

void forbid_overwriting(std::span<const path> inputs, std::span<const path> outputs) {
  for (const path& output : outputs) {
    for (const path& input : inputs) {
      if (!is_same_file(input, output)) continue;
      throw UsageError(output.string() + " is an input, too; it will not be overwritten");
    }
  }
}

}  // namespace loft::app
