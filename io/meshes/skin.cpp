// SPDX-License-Identifier: MIT
#include "io/meshes/skin.h"

#include <algorithm>
#include <array>
#include <string>

namespace loft::io {

namespace {

/// The defined terms of (3006,00A4), but for EXTERNAL.
constexpr std::array<std::string_view, 21> inner_kinds{"PTV",
                                                       "CTV",
                                                       "GTV",
                                                       "TREATED_VOLUME",
                                                       "IRRAD_VOLUME",
                                                       "BOLUS",
                                                       "AVOIDANCE",
                                                       "ORGAN",
                                                       "MARKER",
                                                       "REGISTRATION",
                                                       "ISOCENTER",
                                                       "CONTRAST_AGENT",
                                                       "CAVITY",
                                                       "CONTROL",
                                                       "BRACHY_CHANNEL",
                                                       "BRACHY_ACCESSORY",
                                                       "BRACHY_SRC_APP",
                                                       "BRACHY_CHNL_SHLD",
                                                       "SUPPORT",
                                                       "FIXATION",
                                                       "DOSE_REGION"};

constexpr std::array<std::string_view, 3> skin_words{"body", "external", "skin"};
/// What may stand beside them.
constexpr std::array<std::string_view, 9> outline_words{
    "contour", "contours", "outer", "outline", "patient", "surface", "the", "whole", "roi"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80; }

char lower_case(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; }

}  // namespace

bool is_skin(std::string_view label, std::string_view kind) {
  if (kind == "EXTERNAL" || kind == "BODY") return true;
  if (std::ranges::find(inner_kinds, kind) != inner_kinds.end()) return false;
  bool is_named = false;
  std::string name(label);
  std::ranges::transform(name, name.begin(), lower_case);
  for (auto begin = std::ranges::find_if(name, is_letter); begin != name.end();) {
    const auto end = std::find_if_not(begin, name.end(), is_letter);
    const std::string_view word(begin, end);
    const bool is_skin_word = std::ranges::find(skin_words, word) != skin_words.end();
    if (!is_skin_word && std::ranges::find(outline_words, word) == outline_words.end())
      return false;
    is_named = is_named || is_skin_word;
    begin = std::find_if(end, name.end(), is_letter);
  }
  return is_named;
}

bool is_see_through(const Part& part, std::span<const Part> parts) {
  const auto has_faces = [](const Part& other) { return other.surface->n_faces() > 0; };
  return std::ranges::count_if(parts, has_faces) > 1 && is_skin(part.label, part.kind);
}

}  // namespace loft::io
