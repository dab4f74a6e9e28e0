// SPDX-License-Identifier: MIT
#include "io/meshes/materials.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>

#include "io/bytes/checksum.h"
#include "io/bytes/text.h"
#include "io/meshes/label_colour.h"
#include "io/meshes/skin.h"
#include "io/version.h"
#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

/// Letters of any language, digits and a few signs stay.
std::string as_one_word(std::string_view name) {
  constexpr std::string_view signs = "-_.+";
  std::string word(name);
  for (char& c : word) {
    const bool is_letter =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
    if (!is_letter && !is_digit(c) && signs.find(c) == std::string_view::npos) c = '_';
  }
  return word;
}

/// A share of 1 with four digits.
void append_share(std::string& text, std::uint8_t value) {
  constexpr double places = 1e4;
  text += ' ';
  append_number(text, std::round(value / 255.0 * places) / places);
}

}  // namespace

std::vector<std::string> material_names(std::span<const Part> parts) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const Part& part : parts) {
    const std::string word = part.label.empty() ? "surface" : as_one_word(part.label);
    std::string name = word;
    for (std::size_t i = 2; !taken.insert(name).second; ++i) name = word + '_' + std::to_string(i);
    names.push_back(std::move(name));
  }
  return names;
}

std::string materials_name(const std::filesystem::path& obj) {
  const std::string stem = obj.stem().string();
  std::string name = as_one_word(stem);
  if (name != stem) name += '-' + std::to_string(checksum(stem) % 1'000'000);
  return name + ".mtl";
}

bool has_materials(std::span<const Part> parts) {
  return parts.size() > 1 || std::ranges::any_of(parts, [](const Part& part) {
           return !part.label.empty() || part.colour;
         });
}

void write_mtl(std::ostream& out, std::span<const Part> parts) {
  std::string text = "# " + std::string(generator()) + '\n';
  const std::vector<std::string> names = material_names(parts);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Colour colour = colour_of(parts[i]);
    text += "newmtl " + names[i] + "\nKd";
    for (const std::uint8_t share : {colour.red, colour.green, colour.blue})
      append_share(text, share);
    text += "\nKs 0 0 0\nd ";
    append_number(text, is_see_through(parts[i], parts) ? skin_opacity : 1.0);
    text += "\nillum 1\n";
  }
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

}  // namespace loft::io
