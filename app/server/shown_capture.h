// SPDX-License-Identifier: MIT
#pragma once

#include "app/capture/capture.h"
#include "app/server/shown.h"

namespace loft::app {

/// A capture for its viewers.
class ShownCapture : public Shown {
 public:
  explicit ShownCapture(Capture& capture) : capture_(capture) {}

  [[nodiscard]] std::pair<std::string, std::uint64_t> reset_event() const override {
    return capture_.reset_event();
  }
  [[nodiscard]] Json status() const override { return capture_.status(); }
  [[nodiscard]] std::optional<std::string> slab(std::size_t part, std::uint32_t id) override;
  [[nodiscard]] std::optional<std::string> surface(std::string_view extension) override;
  [[nodiscard]] std::optional<Slice> slice(double z) const override { return capture_.slice(z); }
  [[nodiscard]] std::vector<double> heights() const override { return capture_.heights(); }

 private:
  Capture& capture_;
};

}  // namespace loft::app
