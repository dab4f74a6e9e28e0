// SPDX-License-Identifier: MIT
#include "reconstruct/progress.h"

namespace loft {

const char* name(Stage stage) {
  switch (stage) {
    case Stage::clean:
      return "clean";
    case Stage::tile:
      return "tile";
    case Stage::smooth:
      return "smooth";
    case Stage::refine:
      return "refine";
    case Stage::sew:
      return "sew";
    case Stage::simplify:
      break;
  }
  return "simplify";
}

double overall(Stage stage, double fraction) {
  switch (stage) {
    case Stage::clean:
      return 0.1 * fraction;
    case Stage::tile:
      return 0.1 + 0.3 * fraction;
    case Stage::smooth:
      return 0.4 + 0.2 * fraction;
    case Stage::refine:
      return 0.6 + 0.2 * fraction;
    case Stage::sew:
      return 0.8 + 0.1 * fraction;
    case Stage::simplify:
      break;
  }
  return 0.9 + 0.1 * fraction;
}

}  // namespace loft
