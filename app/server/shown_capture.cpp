// SPDX-License-Identifier: MIT
#include "app/server/shown_capture.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "app/capture/surfaces.h"
#include "app/report.h"
#include "io/meshes/skin.h"
#include "io/surfaces.h"

namespace loft::app {

namespace {

/// So many faces make a GLB, and what the last slab has beyond.
constexpr std::size_t most_bundled_faces = 32'768;

}  // namespace

std::optional<std::string> ShownCapture::slab(std::size_t part, std::uint32_t id) {
  const auto view = capture_.view();
  if (part >= view->parts.size()) return {};
  const Snapshot& snapshot = view->parts[part].snapshot;
  const std::size_t i = snapshot.find(id);
  if (i == snapshot.slab_count()) return {};
  io::SlabView shown = view_of(*view, part);
  shown.edit = capture_.birth(part, id);
  return io::slab_glb(snapshot, i, shown);
}

io::SlabView ShownCapture::view_of(const CaptureView& view, std::size_t part) const {
  const Capture::Setup& setup = capture_.setup();
  const StackLabel* const said = find(setup.labels, view.parts[part].label);
  return {.label = view.parts[part].label,
          .is_double_sided = setup.options.cap == Cap::open,
          .origin = view.origin,
          .metres_per_unit = setup.metres_per_unit,
          .colour = said == nullptr ? std::nullopt : said->colour};
}

std::string ShownCapture::slabs(std::span<const SlabRange> ranges, std::size_t most_bytes) {
  const auto view = capture_.view();
  std::string glbs;
  for (const SlabRange& range : ranges) {
    if (range.part < view->parts.size()) append(glbs, *view, range, most_bytes);
    if (glbs.size() >= most_bytes) break;
  }
  return glbs;
}

/// Those that lie one upon the other are one GLB, unless they have too many faces for that.
void ShownCapture::append(std::string& glbs, const CaptureView& view, const SlabRange& range,
                          std::size_t most_bytes) const {
  const Snapshot& snapshot = view.parts[range.part].snapshot;
  std::vector<io::BundledSlab> run;
  std::size_t faces = 0;
  const auto finish_run = [&] {
    if (!run.empty()) glbs += io::bundle_glb(snapshot, run, view_of(view, range.part));
    run.clear();
    faces = 0;
  };
  for (std::size_t i = 0; i < snapshot.slab_count() && glbs.size() < most_bytes; ++i) {
    const std::uint32_t id = snapshot.slab(i).id;
    const bool is_wanted = id >= range.first && id <= range.last;
    if (is_wanted) {
      run.push_back({i, slab_name({range.part, id}), capture_.birth(range.part, id)});
      faces += snapshot.tile_count(i);
    }
    if (!is_wanted || faces >= most_bundled_faces) finish_run();
  }
  if (glbs.size() < most_bytes) finish_run();
}

std::vector<ShownLabel> ShownCapture::labels() {
  const auto view = capture_.view();
  const std::lock_guard lock(measured_mutex_);
  MeasuredSlabs now;
  std::vector<ShownLabel> labels;
  for (std::size_t part = 0; part < view->parts.size(); ++part)
    labels.push_back(measure(*view, part, measured_, now));
  // All parts go through the same slices.
  std::map<std::string, StackSize> sizes;
  if (!view->parts.empty()) {
    const Snapshot& snapshot = view->parts.front().snapshot;
    for (std::size_t i = 0; i < snapshot.slice_count(); ++i) add_sizes(sizes, snapshot.slice(i));
  }
  for (ShownLabel& label : labels) {
    if (const auto found = sizes.find(label.label); found != sizes.end())
      label.slices = found->second.slices;
    const StackLabel* const said = loft::find(capture_.setup().labels, label.label);
    if (said == nullptr) continue;
    label.colour = said->colour;
    label.is_skin = io::is_skin(label.label, said->kind);
  }
  measured_ = std::move(now);
  return labels;
}

ShownLabel ShownCapture::measure(const CaptureView& view, std::size_t part,
                                 const MeasuredSlabs& before, MeasuredSlabs& now) {
  const auto& [label, snapshot] = view.parts[part];
  ShownLabel about{.label = label, .is_skin = io::is_skin(label), .volume = snapshot.volume()};
  double area_of_all = 0;
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
    area_of_all += slab.area;
    about.faces += slab.faces;
    now.emplace(key, slab);
  }
  about.area = area_of_all;
  return about;
}

std::optional<std::string> ShownCapture::surface(std::string_view extension) {
  const auto view = capture_.view();
  const Surfaces surfaces(*view, capture_.setup().labels);
  if (surfaces.parts().empty()) return {};
  std::ostringstream out;
  io::write(out, extension, surfaces.parts(),
            {.metres_per_unit = capture_.setup().metres_per_unit, .sources = {}, .settings = {}});
  return std::move(out).str();
}

}  // namespace loft::app
