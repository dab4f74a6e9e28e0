// SPDX-License-Identifier: MIT
#include "io/meshes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "io/bytes/file.h"
#include "io/bytes/format_table.h"
#include "io/gltf/gltf.h"
#include "io/meshes/obj.h"
#include "io/meshes/off.h"
#include "io/meshes/ply.h"
#include "io/meshes/stl.h"
#include "io/precomputed.h"

namespace loft::io {

namespace {

using Parser = std::vector<LabelledMesh> (*)(const std::string& content, std::string_view name);

template <Parser parse>
std::vector<LabelledMesh> read_with(const std::filesystem::path& path) {
  return parse(read_file(path), path.string());
}

std::vector<LabelledMesh> read_gltf_file(const std::filesystem::path& path) {
  return read_gltf(path);
}

struct MeshReader {
  std::string_view extension;
  std::vector<LabelledMesh> (*read)(const std::filesystem::path&);
  bool keeps_coordinates;
};

constexpr std::array mesh_readers{
    MeshReader{".ply", read_with<read_ply>, true}, MeshReader{".obj", read_with<read_obj>, true},
    MeshReader{".off", read_with<read_off>, true}, MeshReader{".stl", read_with<read_stl>, false},
    MeshReader{".glb", read_gltf_file, false},     MeshReader{".gltf", read_gltf_file, false},
};

}  // namespace

std::string mesh_extensions() { return extensions_of(mesh_readers); }

bool is_mesh_file(const std::filesystem::path& path) {
  return precomputed_folder(path) || find_format(mesh_readers, path) != nullptr;
}

bool keeps_coordinates(const std::filesystem::path& path) {
  const MeshReader* const format = find_format(mesh_readers, path);
  return format != nullptr && format->keeps_coordinates;
}

std::vector<LabelledMesh> read_meshes(const std::filesystem::path& path) {
  if (const auto folder = precomputed_folder(path)) return read_precomputed(*folder);
  return format_of(mesh_readers, path).read(path);
}

std::vector<Slice> read_contours(const std::filesystem::path& path) {
  const std::string format = extension(path);
  if (format == ".glb" || format == ".gltf") return read_gltf_contours(path);
  if (format != ".ply") return {};
  return read_ply_contours(read_file(path), path.string());
}

Mesh read_mesh(const std::filesystem::path& path) {
  std::vector<LabelledMesh> parts = read_meshes(path);
  Mesh result = std::move(parts.front().mesh);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const auto first = static_cast<std::uint32_t>(result.points.size());
    const Mesh& mesh = parts[i].mesh;
    result.points.insert(result.points.end(), mesh.points.begin(), mesh.points.end());
    for (const auto& [a, b, c] : mesh.faces)
      result.faces.push_back({first + a, first + b, first + c});
  }
  return result;
}

}  // namespace loft::io
