// SPDX-License-Identifier: MIT
#include "app/options/complaints.h"

#include <CLI/CLI.hpp>

#include "app/unit.h"
#include "mesh/admitted.h"

namespace loft::app {

std::string complain_of_unit(const std::string& unit) {
  if (metres_per_unit(unit)) return {};
  return "'" + unit + "' is no unit; known are " + std::string(unit_names);
}

std::string complain_of_length(const std::string& text) {
  double length = 0;
  if (CLI::detail::lexical_cast(text, length) && length > 0 && admitted::length.admits(length))
    return {};
  return "'" + text + "' is no length; give a number from 1e-30 to 1e70, in the unit of the input";
}

std::string complain_of_rate(const std::string& text) {
  double rate = 0;
  if (CLI::detail::lexical_cast(text, rate) && rate >= 0.001 && rate <= 1000) return {};
  return "'" + text + "' is no rate; give a number from 0.001 to 1000, edits a second";
}

std::string complain_of_distance(const std::string& text) {
  double distance = 0;
  if (CLI::detail::lexical_cast(text, distance) && admitted::length.admits_length(distance))
    return {};
  return "'" + text +
         "' is no distance; give 0 or a number from 1e-30 to 1e70, in the unit of the input";
}

std::string complain_of_epsilon(const std::string& text) {
  double epsilon = 0;
  if (CLI::detail::lexical_cast(text, epsilon) && admitted::planar.admits_length(epsilon))
    return {};
  return "'" + text + "' is no distance; give 0 or a number from 1e-50 to 1e75";
}

}  // namespace loft::app
