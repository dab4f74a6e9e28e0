// SPDX-License-Identifier: MIT
#include "io/palette.h"

#include <algorithm>
#include <utility>

namespace loft::io {

namespace {

struct Hue {
  Colour full;
  Colour dark;
};

constexpr std::array<Hue, hue_count> hues{{
    {{0xe6, 0xd3, 0xa3}, {0x8f, 0x6f, 0x22}},  // sand
    {{0xbf, 0xd8, 0xaa}, {0x4c, 0x7d, 0x2c}},  // sage
    {{0xf2, 0xc4, 0xa0}, {0xb3, 0x58, 0x1c}},  // apricot
    {{0xd5, 0xc0, 0xdf}, {0x7d, 0x4b, 0x92}},  // lilac
    {{0xb0, 0xd8, 0xcc}, {0x22, 0x7d, 0x66}},  // mint
    {{0xf1, 0xdf, 0x8e}, {0x96, 0x7a, 0x08}},  // straw
    {{0xea, 0xb8, 0xb2}, {0xa8, 0x3c, 0x34}},  // rose
    {{0xb9, 0xc9, 0xe6}, {0x37, 0x5c, 0xa0}},  // periwinkle
}};

using Keys = std::vector<std::uint64_t>;

std::size_t place_of(const Keys& keys, std::uint64_t key) {
  return static_cast<std::size_t>(std::ranges::lower_bound(keys, key) - keys.begin());
}

/// The keys of all regions, sorted, each once.
Keys keys_of(const PlanarMesh& mesh) {
  Keys keys;
  for (const PlanarMesh::Region& region : mesh.regions) keys.push_back(region.key);
  std::ranges::sort(keys);
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

/// The pairs of keys that meet along an edge, both ways round, sorted.
std::vector<std::pair<std::size_t, std::size_t>> meetings(const PlanarMesh& mesh,
                                                          const Keys& keys) {
  std::vector<std::size_t> place;
  for (const PlanarMesh::Region& region : mesh.regions) {
    place.push_back(place_of(keys, region.key));
  }
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t e = 0; e < mesh.neighbours.size(); ++e) {
    if (mesh.neighbours[e] == PlanarMesh::none) continue;
    const std::size_t here = place[mesh.region_of[e / 3]];
    const std::size_t there = place[mesh.region_of[mesh.neighbours[e] / 3]];
    if (here != there) pairs.emplace_back(here, there);
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// The first hue from the preferred one on that is not taken; the preferred one if all are.
std::uint8_t choose(std::uint64_t key, const std::array<bool, hue_count>& is_taken) {
  for (std::size_t i = 0; i < hue_count; ++i) {
    const std::size_t hue = (key + i) % hue_count;
    if (!is_taken[hue]) return static_cast<std::uint8_t>(hue);
  }
  return static_cast<std::uint8_t>(key % hue_count);
}

/// One hue a key, greedily.
std::vector<std::uint8_t> colour(const PlanarMesh& mesh, const Keys& keys) {
  const auto pairs = meetings(mesh, keys);
  std::vector<std::uint8_t> hues_of_keys(keys.size());
  auto pair = pairs.begin();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    std::array<bool, hue_count> is_taken{};
    for (; pair != pairs.end() && pair->first == i; ++pair)
      if (pair->second < i && keys[pair->second] != 0) is_taken[hues_of_keys[pair->second]] = true;
    hues_of_keys[i] = choose(keys[i], is_taken);
  }
  return hues_of_keys;
}

}  // namespace

std::string to_hex(Colour colour) {
  constexpr const char* digits = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t part : {colour.red, colour.green, colour.blue}) {
    text += digits[part >> 4U];
    text += digits[part & 0xfU];
  }
  return text;
}

Colour full_tone(std::size_t hue) { return hues[hue].full; }

Colour pale_tone(std::size_t hue) {
  const auto paler = [](std::uint8_t part) {
    return static_cast<std::uint8_t>(255 - (255 - part) * 2 / 5);
  };
  const Colour full = full_tone(hue);
  return {paler(full.red), paler(full.green), paler(full.blue)};
}

Colour dark_tone(std::size_t hue) { return hues[hue].dark; }

Colour fill_of(const PlanarMesh::Region& region, std::size_t hue) {
  if (region.is_odd) return full_tone(hue);
  return region.key == 0 ? outside_tone : pale_tone(hue);
}

Hues choose_hues(const PlanarMesh& mesh) {
  const Keys keys = keys_of(mesh);
  const std::vector<std::uint8_t> hues_of_keys = colour(mesh, keys);
  Hues result;
  for (const PlanarMesh::Region& region : mesh.regions) {
    result.of_region.push_back(hues_of_keys[place_of(keys, region.key)]);
  }
  for (const PlanarMesh::Course& course : mesh.constraints) {
    const std::size_t place = place_of(keys, course.key);
    const bool is_known = place < keys.size() && keys[place] == course.key;
    result.of_constraint.push_back(is_known ? hues_of_keys[place]
                                            : static_cast<std::uint8_t>(course.key % hue_count));
  }
  return result;
}

}  // namespace loft::io
