// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "app/server/shown.h"
#include "app/server/shown_contours.h"
#include "reconstruct/stack.h"

namespace loft::app {

/// The contours of a stack, for viewers: there is no surface yet.
class ShownStack : public Shown {
 public:
  /// `unit` holds where the file has none. Throws as io::read_stack().
  ShownStack(const std::filesystem::path& file, const std::string& unit);

  [[nodiscard]] std::pair<std::string, std::uint64_t> reset_event() const override;
  [[nodiscard]] Json status() const override;
  [[nodiscard]] std::vector<ShownLabel> labels() override;
  [[nodiscard]] std::optional<std::string> slab(std::size_t, std::uint32_t) override { return {}; }
  [[nodiscard]] std::string slabs(std::span<const SlabRange>, std::size_t) override { return {}; }
  [[nodiscard]] std::optional<std::string> surface(std::string_view) override { return {}; }
  [[nodiscard]] std::optional<Slice> slice(double z) const override { return contours_.slice(z); }
  [[nodiscard]] std::vector<double> heights() const override { return contours_.heights(); }

 private:
  ShownStack(const std::filesystem::path& file, Stack stack, const std::string& unit);

  std::string name_;
  bool is_patient_ = false;
  std::string unit_;
  Stack about_;  // without slices
  ShownContours contours_;
};

}  // namespace loft::app
