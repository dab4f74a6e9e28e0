// SPDX-License-Identifier: MIT
#include "io/unit.h"

#include <array>
#include <charconv>
#include <system_error>

#include "mesh/admitted.h"

namespace loft::io {

std::optional<double> metres_per_unit(std::string_view unit) {
  struct Unit {
    std::string_view name;
    double metres;
  };
  constexpr std::array units{Unit{"m", 1.0},    Unit{"cm", 0.01}, Unit{"mm", 0.001},
                             Unit{"um", 1e-6},  Unit{"nm", 1e-9}, Unit{"in", 0.0254},
                             Unit{"ft", 0.3048}};
  for (const Unit& known : units) {
    if (known.name == unit) return known.metres;
  }
  double metres = 0;
  const auto [end, error] = std::from_chars(unit.data(), unit.data() + unit.size(), metres);
  if (error != std::errc() || end != unit.data() + unit.size()) return std::nullopt;
  if (metres <= 0 || !admitted::unit.admits(metres)) return std::nullopt;
  return metres;
}

}  // namespace loft::io
