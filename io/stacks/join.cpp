// SPDX-License-Identifier: MIT
#include "io/stacks/join.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "reconstruct/defect.h"

namespace loft::io {

void join(Stack& whole, Stack&& part, const std::string& file, bool is_first) {
  if (is_first) {
    whole = std::move(part);
    return;
  }
  const auto require = [&](bool is_same, const char* what) {
    if (!is_same)
      throw InputError(file + ": its " + what +
                       " is not that of the files before; reconstruct them one by one");
  };
  require(whole.unit == part.unit, "unit");
  require(whole.frame == part.frame, "frame");
  require(whole.fill == part.fill, "fill rule");
  std::ranges::move(part.slices, std::back_inserter(whole.slices));
  for (StackLabel& label : part.labels)
    if (whole.find_label(label.name) == nullptr) whole.labels.push_back(std::move(label));
  std::ranges::move(part.notes, std::back_inserter(whole.notes));
}

}  // namespace loft::io
