// SPDX-License-Identifier: MIT
#include "app/commands/map_expression.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>

#include "app/exit_code.h"
#include "io/bytes/text.h"

namespace loft::app {

using overlay::LayerId;
using overlay::Overlay;

std::string listed_layers(const Overlay& overlay) {
  constexpr std::size_t shown = 12;
  std::string names;
  for (std::size_t i = 0; i < std::min(shown, overlay.layer_count()); ++i) {
    const LayerId layer(static_cast<std::uint32_t>(i));
    names += (i == 0 ? "" : ", ") +
             io::one_line(to_string(layer, [&](LayerId one) { return overlay.name(one); }));
  }
  return overlay.layer_count() > shown ? names + ", ..." : names;
}

overlay::Expression expression_over(const Overlay& overlay, const std::string& text,
                                    const std::string& option) {
  std::map<std::string, LayerId, std::less<>> layers;
  for (std::size_t i = 0; i < overlay.layer_count(); ++i) {
    const LayerId layer(static_cast<std::uint32_t>(i));
    layers.emplace(overlay.name(layer), layer);
  }
  try {
    return overlay::parse_expression(text, [&](std::string_view name) -> std::optional<LayerId> {
      const auto found = layers.find(name);
      if (found == layers.end()) return {};
      return found->second;
    });
  } catch (const overlay::ExpressionError& error) {
    throw UsageError(option + ": " + io::one_line(error.what()) + "; layers are " +
                     listed_layers(overlay));
  }
}

}  // namespace loft::app
