// SPDX-License-Identifier: MIT
#include "app/server/shown_capture.h"

#include <sstream>

#include "app/capture/surfaces.h"
#include "io/gltf/slab_glb.h"
#include "io/surfaces.h"

namespace loft::app {

std::optional<std::string> ShownCapture::slab(std::size_t part, std::uint32_t id) {
  const auto view = capture_.view();
  if (part >= view->parts.size()) return {};
  const auto& [label, snapshot] = view->parts[part];
  const std::size_t i = snapshot.find(id);
  if (i == snapshot.slab_count()) return {};
  const Capture::Setup& setup = capture_.setup();
  return io::slab_glb(snapshot, i,
                      {label, capture_.birth(part, id), setup.options.cap == Cap::open,
                       view->origin, setup.metres_per_unit});
}

std::optional<std::string> ShownCapture::surface(std::string_view extension) {
  const auto view = capture_.view();
  const Surfaces surfaces(*view);
  if (surfaces.parts().empty()) return {};
  std::ostringstream out;
  io::write(out, extension, surfaces.parts(),
            {.metres_per_unit = capture_.setup().metres_per_unit, .sources = {}, .settings = {}});
  return std::move(out).str();
}

}  // namespace loft::app
