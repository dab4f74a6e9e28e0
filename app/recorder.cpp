// SPDX-License-Identifier: MIT
#include "app/recorder.h"

#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include "io/atomic_file.h"

namespace loft::app {

namespace {

using Place = std::pair<std::size_t, std::size_t>;  // part, slab

/// The slabs that came and those beside them, whose normals they smooth.
std::set<Place> looking_different(const Answer& answer, const CaptureView& view) {
  std::set<Place> places;
  for (const std::string& slab : answer.added) {
    const std::size_t dash = slab.find('-');
    const std::size_t part = std::stoul(slab.substr(0, dash));
    const Snapshot& snapshot = view.parts[part].snapshot;
    const std::size_t i =
        snapshot.find(static_cast<std::uint32_t>(std::stoul(slab.substr(dash + 1))));
    if (i > 0) places.emplace(part, i - 1);
    places.emplace(part, i);
    if (i + 1 < snapshot.slab_count()) places.emplace(part, i + 1);
  }
  return places;
}

}  // namespace

void Recorder::add(const Answer& answer, const CaptureView& view) {
  if (failure_) return;
  try {
    add_picture(answer, view);
  } catch (const std::exception&) {
    failure_ = std::current_exception();
  }
}

void Recorder::add_picture(const Answer& answer, const CaptureView& view) {
  const double time = static_cast<double>(count_++) / rate_;
  for (const std::string& slab : answer.removed) replay_.remove(time, slab);
  for (const auto& [part, i] : looking_different(answer, view)) {
    const auto& [label, snapshot] = view.parts[part];
    replay_.add(time, slab_name({part, snapshot.slab(i).id}), snapshot, i, label, part);
  }
}

void Recorder::write(const std::filesystem::path& file) const {
  if (failure_) std::rethrow_exception(failure_);
  io::AtomicFile output(file);
  replay_.write(output.stream());
  output.commit();
}

}  // namespace loft::app
