// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <exception>
#include <filesystem>

#include "app/capture/capture.h"
#include "io/gltf/replay.h"

namespace loft::app {

/// Films a capture. Where that fails, the capture goes on, and write() says why.
class Recorder {
 public:
  /// `rate`: edits a second, in the replay.
  Recorder(double metres_per_unit, double rate) : replay_(metres_per_unit), rate_(rate) {}

  /// The next picture: what an edit has changed. Never throws.
  void add(const NetChange& change, const CaptureView& view);
  /// The replay as GLB. Throws what has stopped it, and as io::AtomicFile.
  void write(const std::filesystem::path& file) const;

 private:
  void add_picture(const NetChange& change, const CaptureView& view);

  io::Replay replay_;
  double rate_;
  std::size_t count_ = 0;
  std::exception_ptr failure_;
};

}  // namespace loft::app
