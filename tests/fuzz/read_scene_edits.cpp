// SPDX-License-Identifier: MIT
// Edits of scenes, one a line; what is read of them fits into an overlay.
#include "io/planar/scene_edits.h"
#include "mesh/admitted.h"
#include "tests/fuzz/target.h"

namespace {

using namespace loft;

void use(const io::SceneEdit& edit) {
  using Kind = io::SceneEdit::Kind;
  const bool has_points = edit.kind == Kind::insert || edit.kind == Kind::reshape;
  fuzz::require(!has_points || !edit.points.empty(), "a shape without points");
  fuzz::require(admitted::planar.admits(edit.by.x) && admitted::planar.admits(edit.by.y),
                "a move that a triangulation does not take");
  for (const cdt::Point& p : edit.points)
    fuzz::require(admitted::planar.admits(p.x) && admitted::planar.admits(p.y),
                  "a coordinate that a triangulation does not take");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string text = fuzz::text_of(bytes, size);
  fuzz::try_to([&] {
    const auto edits = io::read_scene_edits(text, "a.ndjson");
    fuzz::require(!edits.empty(), "a file without edits");
    for (const io::SceneEdit& edit : edits) use(edit);
  });
  return 0;
}
