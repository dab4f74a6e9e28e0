// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "io/bytes/problems.h"
#include "io/bytes/text_reader.h"
#include "mesh/admitted.h"
#include "reconstruct/usable.h"

namespace loft::io {

/// The coordinate that the word of a text is. A bad one is noted as `what` with its place, and is 0
/// until all is read.
inline double coordinate_in(const TextReader& text, std::string_view word, std::string_view what,
                            Problems& problems) {
  try {
    const double value = text.to_number(word, what);
    if (admitted::slice.admits(value)) return value;
    text.fail(std::string(what) + ": " + why_not_admitted(value, admitted::slice));
  } catch (const InputError& error) {
    problems.add(error.what());
  }
  return 0;
}

}  // namespace loft::io
