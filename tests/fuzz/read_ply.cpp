// SPDX-License-Identifier: MIT
#include "io/meshes/ply.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace loft;
  fuzz::try_to([&] { fuzz::use(io::read_ply(fuzz::text_of(bytes, size), "a.ply")); });
  fuzz::try_to([&] {
    const auto slices = io::read_ply_contours(fuzz::text_of(bytes, size), "a.ply");
    for (const Slice& slice : slices)
      for (const Contour& contour : slice.contours)
        fuzz::require(!contour.points.empty(), "a contour without points");
  });
  return 0;
}
