// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <mutex>

#include "app/capture/capture.h"
#include "app/server/shown.h"
#include "io/gltf/slab_glb.h"

namespace loft::app {

/// A capture for its viewers.
class ShownCapture : public Shown {
 public:
  explicit ShownCapture(Capture& capture) : capture_(capture) {}

  [[nodiscard]] std::pair<std::string, std::uint64_t> reset_event() const override {
    return capture_.reset_event();
  }
  [[nodiscard]] Json status() const override { return capture_.status(); }
  [[nodiscard]] std::optional<Json> history() const override { return capture_.history(); }
  /// Cost: that of the slabs that have come since it was called last.
  [[nodiscard]] std::vector<ShownLabel> labels() override;
  [[nodiscard]] std::optional<std::string> slab(std::size_t part, std::uint32_t id) override;
  [[nodiscard]] std::string slabs(std::span<const SlabRange> ranges,
                                  std::size_t most_bytes) override;
  [[nodiscard]] std::optional<std::string> surface(std::string_view extension) override;
  [[nodiscard]] std::optional<Slice> slice(double z) const override { return capture_.slice(z); }
  [[nodiscard]] std::vector<double> heights() const override { return capture_.heights(); }

 private:
  struct Measured {
    double area = 0;
    std::size_t faces = 0;
  };
  void append(std::string& glbs, const CaptureView& view, const SlabRange& range,
              std::size_t most_bytes) const;
  [[nodiscard]] io::SlabView view_of(const CaptureView& view, std::size_t part) const;

  using MeasuredSlabs = std::map<SlabKey, Measured>;
  [[nodiscard]] static ShownLabel measure(const CaptureView& view, std::size_t part,
                                          const MeasuredSlabs& before, MeasuredSlabs& now);

  Capture& capture_;
  std::mutex measured_mutex_;
  MeasuredSlabs measured_;  // slabs never change
};

}  // namespace loft::app
