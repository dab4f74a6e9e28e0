// SPDX-License-Identifier: MIT
#include "app/options/complaints.h"

#include <CLI/CLI.hpp>
#include <cmath>

#include "app/unit.h"

namespace loft::app {

std::string complain_of_unit(const std::string& unit) {
  if (metres_per_unit(unit)) return {};
  return "'" + unit + "' is no unit; known are " + std::string(unit_names);
}

std::string complain_of_length(const std::string& text) {
  double length = 0;
  if (CLI::detail::lexical_cast(text, length) && std::isfinite(length) && length > 0) return {};
  return "'" + text + "' is no length; give a number above 0, in the unit of the input";
}

std::string complain_of_rate(const std::string& text) {
  double rate = 0;
  if (CLI::detail::lexical_cast(text, rate) && rate >= 0.001 && rate <= 1000) return {};
  return "'" + text + "' is no rate; give a number from 0.001 to 1000, edits a second";
}

std::string complain_of_distance(const std::string& text) {
  double distance = 0;
  if (CLI::detail::lexical_cast(text, distance) && std::isfinite(distance) && distance >= 0)
    return {};
  return "'" + text + "' is no distance; give 0 or a number above, in the unit of the input";
}

}  // namespace loft::app
