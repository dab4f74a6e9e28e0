// SPDX-License-Identifier: MIT
#include "app/server/shown_capture.h"

#include <algorithm>
#include <sstream>
#include <utility>

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

std::vector<ShownLabel> ShownCapture::labels() {
  const auto view = capture_.view();
  const std::lock_guard lock(measured_mutex_);
  MeasuredSlabs now;
  std::vector<ShownLabel> labels;
  for (std::size_t part = 0; part < view->parts.size(); ++part)
    labels.push_back(measure(*view, part, measured_, now));
  measured_ = std::move(now);
  return labels;
}

ShownLabel ShownCapture::measure(const CaptureView& view, std::size_t part,
                                 const MeasuredSlabs& before, MeasuredSlabs& now) {
  const auto& [label, snapshot] = view.parts[part];
  ShownLabel about{.label = label, .is_skin = is_skin(label), .volume = snapshot.volume()};
  for (std::size_t i = 0; i < snapshot.slab_count(); ++i) {
    const SlabKey key{part, snapshot.slab(i).id};
    const auto known = before.find(key);
    Measured slab;
    if (known != before.end()) {
      slab = known->second;
    } else {
      const Mesh mesh = snapshot.patch(i, i + 1).mesh;
      slab = {area(mesh), mesh.faces.size()};
    }
    about.area += slab.area;
    about.faces += slab.faces;
    now.emplace(key, slab);
  }
  const auto has_label = [&](const Contour& contour) { return contour.label == label; };
  for (std::size_t i = 0; i < snapshot.slice_count(); ++i)
    if (std::ranges::any_of(snapshot.slice(i).contours, has_label)) ++about.slices;
  return about;
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
