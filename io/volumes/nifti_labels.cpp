// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "io/bytes/text.h"
#include "io/bytes/utf8.h"
#include "io/volumes/nifti_header.h"

namespace loft::io {

namespace {

/// The value of an attribute in the inside of a tag.
std::optional<double> attribute(std::string_view tag, std::string_view name) {
  const std::string key = ' ' + std::string(name) + "=\"";
  const std::size_t found = tag.find(key);
  if (found == std::string_view::npos) return {};
  const char* const begin = tag.data() + found + key.size();
  double number = 0;
  if (std::from_chars(begin, tag.data() + tag.size(), number).ec != std::errc()) return {};
  return number;
}

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

/// The text between tags: as it is in CDATA, with entities elsewhere.
std::string text_of(std::string_view content) {
  constexpr std::string_view begin = "<![CDATA[";
  const std::size_t found = content.find(begin);
  if (found != std::string_view::npos) {
    const std::string_view inside = content.substr(found + begin.size());
    return json_text(one_line(inside.substr(0, inside.find("]]>"))));
  }
  std::string text = one_line(content);
  replace_all(text, "&lt;", "<");
  replace_all(text, "&gt;", ">");
  replace_all(text, "&quot;", "\"");
  replace_all(text, "&apos;", "'");
  replace_all(text, "&amp;", "&");
  return json_text(std::move(text));
}

/// Shares of 1, all three or none.
std::optional<Colour> colour_of(std::string_view tag) {
  std::uint8_t parts[3];
  constexpr std::string_view names[]{"Red", "Green", "Blue"};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<double> share = attribute(tag, names[i]);
    if (!share || !(*share >= 0 && *share <= 1)) return {};
    parts[i] = static_cast<std::uint8_t>(std::lround(*share * 255));
  }
  return Colour{parts[0], parts[1], parts[2]};
}

}  // namespace

std::vector<VolumeLabel> labels_in_xml(std::string_view xml) {
  std::vector<VolumeLabel> labels;
  constexpr std::string_view begin = "<Label ";
  constexpr std::string_view end = "</Label>";
  for (std::size_t at = xml.find(begin); at != std::string_view::npos; at = xml.find(begin)) {
    xml.remove_prefix(at + begin.size() - 1);
    const std::size_t close = xml.find('>');
    const std::size_t last = xml.find(end);
    if (close == std::string_view::npos || last == std::string_view::npos || last < close) break;
    const std::string_view tag = xml.substr(0, close);
    const std::optional<double> key = attribute(tag, "Key");
    if (key && *key != 0 && std::isfinite(*key))
      labels.push_back({{text_of(xml.substr(close + 1, last - close - 1)), colour_of(tag),
                         std::to_string(std::llround(std::clamp(*key, -1e15, 1e15)))},
                        0,
                        *key});
  }
  return labels;
}

}  // namespace loft::io
