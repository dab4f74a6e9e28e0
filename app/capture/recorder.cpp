// SPDX-License-Identifier: MIT
#include "app/capture/recorder.h"

#include <set>
#include <utility>

#include "io/bytes/atomic_file.h"

namespace loft::app {

namespace {

using Place = std::pair<std::size_t, std::size_t>;  // part, slab

/// The slabs that came and those beside them, whose normals they smooth.
std::set<Place> looking_different(const NetChange& change, const CaptureView& view) {
  std::set<Place> places;
  for (const auto& [part, id] : change.added()) {
    const Snapshot& snapshot = view.parts[part].snapshot;
    const std::size_t i = snapshot.find(id);
    if (i > 0) places.emplace(part, i - 1);
    places.emplace(part, i);
    if (i + 1 < snapshot.slab_count()) places.emplace(part, i + 1);
  }
  return places;
}

}  // namespace

void Recorder::add(const NetChange& change, const CaptureView& view) {
  if (failure_) return;
  try {
    add_picture(change, view);
  } catch (const std::exception&) {
    failure_ = std::current_exception();
  }
}

void Recorder::add_picture(const NetChange& change, const CaptureView& view) {
  const double time = static_cast<double>(count_++) / rate_;
  for (const SlabKey& slab : change.removed()) replay_.remove(time, slab_name(slab));
  for (const auto& [part, i] : looking_different(change, view)) {
    const auto& [label, snapshot] = view.parts[part];
    const StackLabel* const said = find(labels_, label);
    replay_.add(time, slab_name({part, snapshot.slab(i).id}), snapshot, i, label,
                said == nullptr ? std::nullopt : said->colour);
  }
}

void Recorder::write(const std::filesystem::path& file) const {
  if (failure_) std::rethrow_exception(failure_);
  io::AtomicFile output(file);
  replay_.write(output.stream());
  output.commit();
}

}  // namespace loft::app
