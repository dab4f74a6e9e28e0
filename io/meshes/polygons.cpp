// SPDX-License-Identifier: MIT
#include "io/meshes/polygons.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <map>
#include <utility>

#include "reconstruct/defect.h"

namespace loft::io {

void Polygons::add(std::span<const std::uint32_t> corners, std::uint32_t label) {
  assert(corners.size() >= 3);
  for (std::size_t i = 2; i < corners.size(); ++i) {
    mesh.faces.push_back({corners[0], corners[i - 1], corners[i]});
    label_of.push_back(label);
  }
}

void require_valid(const Mesh& mesh, std::string_view name) {
  if (mesh.faces.empty()) throw InputError(std::string(name) + ": no faces in it");
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const std::uint32_t largest = std::ranges::max(mesh.faces[i]);
    if (largest < mesh.points.size()) continue;
    throw InputError(std::string(name) + ": triangle " + std::to_string(i) + " names vertex " +
                     std::to_string(largest) + ", but there are only " +
                     std::to_string(mesh.points.size()));
  }
}

namespace {

/// The faces of one label, with the points they use renumbered in the order of use.
Mesh extract(const Mesh& mesh, std::span<const std::size_t> faces) {
  constexpr std::uint32_t unused = 0xffff'ffff;
  std::vector<std::uint32_t> number(mesh.points.size(), unused);
  Mesh result;
  for (const std::size_t face : faces) {
    std::array<std::uint32_t, 3> corners = mesh.faces[face];
    for (std::uint32_t& corner : corners) {
      if (number[corner] == unused) {
        number[corner] = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back(mesh.points[corner]);
      }
      corner = number[corner];
    }
    result.faces.push_back(corners);
  }
  return result;
}

/// What all of them have.
std::optional<Colour> colour_of(std::span<const std::optional<Colour>> colours,
                                std::span<const std::size_t> faces) {
  if (colours.empty() || faces.empty()) return {};
  const std::optional<Colour>& first = colours[faces.front()];
  const auto has_it = [&](std::size_t face) { return colours[face] == first; };
  return std::ranges::all_of(faces, has_it) ? first : std::nullopt;
}

}  // namespace

std::vector<LabelledMesh> split(Polygons polygons) {
  std::map<std::uint32_t, std::vector<std::size_t>> faces_of;
  for (std::size_t i = 0; i < polygons.label_of.size(); ++i) {
    faces_of[polygons.label_of[i]].push_back(i);
  }
  const auto label = [&](std::uint32_t number) {
    return number < polygons.labels.size() ? polygons.labels[number] : std::string();
  };
  std::vector<LabelledMesh> result;
  if (faces_of.size() <= 1) {
    if (faces_of.empty()) faces_of[0] = {};
    const auto& [number, faces] = *faces_of.begin();
    result.push_back({label(number), std::move(polygons.mesh), colour_of(polygons.colours, faces)});
    return result;
  }
  for (const auto& [number, faces] : faces_of) {
    result.push_back(
        {label(number), extract(polygons.mesh, faces), colour_of(polygons.colours, faces)});
  }
  return result;
}

}  // namespace loft::io
