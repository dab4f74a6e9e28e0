// SPDX-License-Identifier: MIT
#include "io/planar/hues.h"

#include <algorithm>
#include <array>
#include <utility>

namespace loft::io {

namespace {

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
