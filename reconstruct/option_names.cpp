// SPDX-License-Identifier: MIT
#include "reconstruct/option_names.h"

#include <optional>

#include "reconstruct/number_text.h"

namespace loft {

const char* name(Fill fill) {
  switch (fill) {
    case Fill::even_odd:
      return "evenodd";
    case Fill::nonzero:
      return "nonzero";
    case Fill::keyhole_aware:
      break;
  }
  return "keyhole-aware";
}

const char* name(Cap cap) {
  switch (cap) {
    case Cap::flat:
      return "flat";
    case Cap::dome:
      return "dome";
    case Cap::extend:
      return "extend";
    case Cap::open:
      break;
  }
  return "open";
}

const char* name(LinkRule rule) {
  switch (rule) {
    case LinkRule::automatic:
      return "auto";
    case LinkRule::overlap:
      return "overlap";
    case LinkRule::none:
      break;
  }
  return "none";
}

std::vector<std::pair<std::string, double>> lengths(const Options& options) {
  std::vector<std::pair<std::string, double>> result;
  const auto add = [&](const char* name, const std::optional<double>& length) {
    if (length) result.emplace_back(name, *length);
  };
  add("fair", options.fair);
  add("smooth_tolerance", options.smooth_tolerance);
  add("max_edge", options.max_edge);
  add("target_edge", options.target_edge);
  add("simplify", options.simplify);
  return result;
}

std::map<std::string, std::string> settings_of(const Options& options) {
  std::map<std::string, std::string> settings{
      {"fill", name(options.fill)}, {"cap", name(options.cap)}, {"link", name(options.link)}};
  if (options.smooth) settings["smooth"] = "true";
  for (const auto& [setting, length] : lengths(options)) settings[setting] = exact(length);
  return settings;
}

}  // namespace loft
