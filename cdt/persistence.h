// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "cdt/triangulation.h"

namespace loft::cdt {

/// What does not fit in a state that was read, and in which row of which table.
struct Misfit {
  std::string_view table;
  std::size_t row;
  std::string message;
};

/// The one who may look inside: for persist.cpp the state's description, for examine.cpp what has
/// to be true of it.
class Persistence {
 public:
  template <class Archive, class Mesh>
  static void describe(Archive& archive, Mesh& mesh);

  /// Triangles and their twins, before anyone walks from one to the other. Throws Misfit.
  static void examine_triangles(const Triangulation& mesh);
  /// Everything that can only be told when all is there; sets what follows from it. Throws Misfit.
  static void examine(Triangulation& mesh);

 private:
  class Description;
  class Examination;
};

}  // namespace loft::cdt
