// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cdt/triangulation.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/defect.h"
#include "reconstruct/options.h"
#include "reconstruct/slice.h"

namespace loft {

/// All slices of one height, by their numbers in the input; the first one stands for it.
struct Height {
  double z;
  std::vector<std::uint32_t> slices;
};

/// Whether two heights leave no room for others between them: they need to be different numbers.
[[nodiscard]] bool are_too_near(double lower, double upper);

/// The heights of slices, ascending; `z` are theirs, in the order of the input. Those that differ
/// by rounding are one, the lowest of them: gaps of which each, and each run of them, is at most
/// `tolerance` of the least gap that is larger than they are. Notes those that are merged. Throws
/// InputError where two are nearer than rounding allows.
[[nodiscard]] std::vector<Height> find_heights(std::span<const double> z, double tolerance,
                                               std::vector<Defect>& repairs);

/// Cleans what is at a height: the contours with the label wanted, of the slices `parts`, which are
/// those that `height` names; first makes them fair where the options ask for that.
[[nodiscard]] Region clean(const Height& height, std::span<const Slice* const> parts,
                           const Options& options, std::vector<Defect>& repairs,
                           cdt::Triangulation& memory);

/// The same, with the contours wanted known and fair already: `contours` are those of the stack, in
/// order.
[[nodiscard]] Region clean(const Height& height, std::span<const Slice> stack,
                           std::span<const ContourId> contours, const Options& options,
                           std::vector<Defect>& repairs, cdt::Triangulation& memory);

/// The warning that a region between others is empty.
[[nodiscard]] Defect empty_slice(const Region& region);
/// The warning that no tiles were found that link a region to the next one above.
[[nodiscard]] Defect unlinked_slices(const Region& lower);
/// What is missing where there are not two regions, one of them with an area: `only` is the one
/// that has, or null.
[[nodiscard]] InputError too_few_slices(const Region* only);

/// Of each slice its area times its thickness, half the gap to either neighbour: the ends are
/// continued by half their one gap, a slice that is alone by half of `alone` either way.
class SlabVolume {
 public:
  explicit SlabVolume(double alone) : alone_(alone) {}
  /// From the lowest upwards; empty ones, too.
  void add(const Region& region);
  [[nodiscard]] double volume() const;

 private:
  double alone_;
  double sum_ = 0;   // but for the upper half of the last slice
  double z_ = 0;     // of the last slice
  double gap_ = 0;   // below it
  double area_ = 0;  // of it
  bool is_first_ = true;
  bool is_second_ = false;
};

/// For Cap::extend: the end of a stack half a gap further out.
[[nodiscard]] Region extended(const Region& end, double half_gap);

/// For Cap::dome: an empty region one gap beyond the end of a stack, into which it rounds off.
/// `before` is the region next to the last one.
[[nodiscard]] Region beyond(const Region& end, const Region& before);

}  // namespace loft
