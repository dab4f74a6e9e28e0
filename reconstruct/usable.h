// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/admitted.h"
#include "reconstruct/defect.h"
#include "reconstruct/options.h"
#include "reconstruct/slice.h"

namespace loft {

/// Why a range does not admit a number: `NaN is not a number`, `1e+80 is beyond 1e+70`,
/// `5e-324 is nearer to 0 than 1e-30, but not 0`. Precondition: it does not, or it is below 0.
[[nodiscard]] std::string why_not_admitted(double value, const Range& range);

/// What is wrong with the numbers of a slice (DefectKind::not_finite), of its contours with one
/// label or of all; `index` is its number in the stack. Admitted are those of admitted::slice.
[[nodiscard]] std::vector<Defect> find_unusable(const Slice& slice, std::uint32_t index,
                                                const std::optional<std::string>& label = {});

/// Throws InputError where contours have different labels and none is chosen: one solid of several
/// structures is nothing that anyone asked for.
class OneLabel {
 public:
  /// `chosen`: Options::label.
  explicit OneLabel(const std::optional<std::string>& chosen) : is_chosen_(chosen.has_value()) {}

  void add(const Slice& slice);
  void add(const std::string& label);

 private:
  bool is_chosen_;
  std::optional<std::string> label_;
};

/// Throws InputError that names all that is unusable in a stack.
void require_usable(std::span<const Slice> slices);

/// Throws InputError that names each length of the options that admitted::length has not.
void require_usable(const Options& options);

}  // namespace loft
