// SPDX-License-Identifier: MIT
#include "app/mesh_exhibit.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>

#include "app/unit.h"
#include "io/file.h"
#include "io/meshes.h"
#include "io/slab_glb.h"
#include "io/version.h"
#include "reconstruct/measure.h"

namespace loft::app {

namespace {

/// Faces that are fetched and drawn as one.
constexpr std::size_t most_faces = 100'000;

/// Where faces meet at more than that, the edge between them looks sharp.
constexpr double crease_degrees = 40;

/// Some of a mesh's faces, with only the points that they need.
io::ShadedMesh extract(const io::ShadedMesh& mesh, std::span<const std::size_t> faces) {
  io::ShadedMesh result;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;
  for (const std::size_t face : faces) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t old = mesh.faces[face][i];
      const auto [place, is_new] =
          numbers.emplace(old, static_cast<std::uint32_t>(result.points.size()));
      if (is_new) {
        result.points.push_back(mesh.points[old]);
        result.normals.push_back(mesh.normals[old]);
      }
      corners[i] = place->second;
    }
    result.faces.push_back(corners);
  }
  return result;
}

/// Pieces of about the same number of faces, one above the other.
std::vector<io::ShadedMesh> cut(const io::ShadedMesh& mesh) {
  std::vector<double> heights;
  for (const auto& [a, b, c] : mesh.faces)
    heights.push_back(mesh.points[a][2] / 3 + mesh.points[b][2] / 3 + mesh.points[c][2] / 3);
  std::vector<std::size_t> order(mesh.faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t face) { return heights[face]; });
  std::vector<io::ShadedMesh> pieces;
  const std::size_t count = (order.size() + most_faces - 1) / most_faces;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = order.size() * i / count;
    const std::size_t end = order.size() * (i + 1) / count;
    pieces.push_back(extract(mesh, std::span(order).subspan(begin, end - begin)));
  }
  return pieces;
}

}  // namespace

MeshExhibit::MeshExhibit(const std::filesystem::path& file, const std::string& unit)
    : file_(file), unit_(unit) {
  const std::vector<io::LabelledMesh> meshes = io::read_meshes(file);
  for (std::size_t i = 0; i < meshes.size(); ++i) add(i, meshes[i].label, meshes[i].mesh);
  if (!chunks_.empty()) origin_ = chunks_.front().mesh.points.front();
}

void MeshExhibit::add(std::size_t part, const std::string& label, const Mesh& mesh) {
  const Measures measures = measure(mesh);
  vertices_ += measures.vertices;
  faces_ += measures.faces;
  volume_ += measures.volume;
  for (io::ShadedMesh& piece : cut(io::shade(mesh, crease_degrees))) {
    const auto [low, high] =
        std::ranges::minmax(piece.points, {}, [](const Vec3& point) { return point[2]; });
    const double bottom = low[2];
    const double top = high[2];
    chunks_.push_back({part, label, std::move(piece), bottom, top});
  }
}

std::pair<std::string, std::uint64_t> MeshExhibit::reset_event() const {
  Json slabs = Json::array();
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    const Chunk& chunk = chunks_[i];
    slabs.push_back({{"id", std::to_string(chunk.part) + '-' + std::to_string(i)},
                     {"low", chunk.low},
                     {"high", chunk.high},
                     {"label", chunk.label}});
  }
  const Json event{{"slabs", std::move(slabs)},
                   {"slices", Json::array()},
                   {"counts", counts()},
                   {"volume", volume_},
                   {"unit", unit_},
                   {"metres_per_unit", metres_per_unit(unit_).value_or(0.001)},
                   {"downloads", Json::array({io::extension(file_)})},
                   {"edits", 0}};
  return {event.dump(-1, ' ', false, Json::error_handler_t::replace), 1};
}

std::optional<std::string> MeshExhibit::slab_file(std::size_t part, std::uint32_t id) {
  if (id >= chunks_.size() || chunks_[id].part != part) return {};
  const Chunk& chunk = chunks_[id];
  return io::chunk_glb(chunk.mesh, chunk.low, chunk.high,
                       {chunk.label, part, 0, true, origin_,
                        metres_per_unit(unit_).value_or(0.001)});
}

std::optional<std::string> MeshExhibit::surface_file(const std::string& extension) {
  if (extension != io::extension(file_)) throw io::UnknownFormat("surface" + extension, io::extension(file_));
  return io::read_file(file_);
}

std::optional<Slice> MeshExhibit::slice(double /*z*/) const { return {}; }

Json MeshExhibit::counts() const {
  return {{"slices", 0}, {"slabs", chunks_.size()}, {"vertices", vertices_}, {"faces", faces_}};
}

Json MeshExhibit::status() const {
  Json status{{"edits", 0}, {"rejected", 0}};
  status.update(counts());
  status["volume"] = volume_;
  status["session"] = false;
  status["version"] = io::version();
  return status;
}

}  // namespace loft::app
