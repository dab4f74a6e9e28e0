// SPDX-License-Identifier: MIT
// What fuzz targets of readers have in common.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "io/meshes/labelled_mesh.h"
#include "mesh/check.h"
#include "mesh/measure.h"
#include "reconstruct/defect.h"

namespace loft::fuzz {

inline std::string text_of(const std::uint8_t* bytes, std::size_t size) {
  return {reinterpret_cast<const char*>(bytes), size};
}

/// Ends the run: a finding.
inline void require(bool is_right, std::string_view what) {
  if (is_right) return;
  std::fprintf(stderr, "%.*s\n", static_cast<int>(what.size()), what.data());
  std::abort();
}

/// What a reader may do with bad input: throw Error with words. All else is a finding.
template <class Read>
void try_to(Read read) {
  try {
    read();
  } catch (const Error& error) {
    require(error.what()[0] != '\0', "an error without words");
  }
}

/// What was read has vertices for its faces, and can be checked and measured whatever it is.
inline void use(const std::vector<io::LabelledMesh>& meshes) {
  constexpr std::size_t most_faces = 200;  // check() may look at all pairs
  for (const io::LabelledMesh& part : meshes) {
    for (const auto& face : part.mesh.faces)
      for (const std::uint32_t corner : face)
        require(corner < part.mesh.points.size(), "a face without its vertex");
    if (part.mesh.faces.size() > most_faces) continue;
    static_cast<void>(check(part.mesh));
    static_cast<void>(contacts(part.mesh));
    const Angles angles = measure(part.mesh).angles;
    require(angles.smallest >= 0 && angles.median <= 60.01, "an angle that is none");
  }
}

}  // namespace loft::fuzz
