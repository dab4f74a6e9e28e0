// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <exception>
#include <filesystem>
#include <utility>
#include <vector>

#include "app/capture/capture.h"
#include "io/gltf/replay.h"
#include "reconstruct/stack.h"

namespace loft::app {

/// Films a capture. Where that fails, the capture goes on, and write() says why.
class Recorder {
 public:
  /// `rate`: edits a second, in the replay.
  /// `labels`: what the source tells of them.
  Recorder(double metres_per_unit, double rate, std::vector<StackLabel> labels)
      : replay_(metres_per_unit), rate_(rate), labels_(std::move(labels)) {}

  /// The next picture: what an edit has changed. Never throws.
  void add(const NetChange& change, const CaptureView& view);
  /// The replay as GLB. Throws what has stopped it, and as io::AtomicFile.
  void write(const std::filesystem::path& file) const;

 private:
  void add_picture(const NetChange& change, const CaptureView& view);

  io::Replay replay_;
  double rate_;
  std::vector<StackLabel> labels_;
  std::size_t count_ = 0;
  std::exception_ptr failure_;
};

}  // namespace loft::app
