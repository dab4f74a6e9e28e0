// SPDX-License-Identifier: MIT
#include "app/server/shown_mesh.h"

#include <algorithm>
#include <utility>

#include "app/capture/net_change.h"
#include "io/bytes/file.h"
#include "io/gltf/slab_glb.h"
#include "io/meshes.h"
#include "io/meshes/skin.h"
#include "io/version.h"

namespace loft::app {

namespace {

/// So many faces are sent at once.
constexpr std::size_t chunk_size = 65'536;

/// So many chunks go into one GLB: all faces are looked at for each of those.
constexpr std::size_t most_bundled = 4;

/// Flat faces across z are taken for the caps of a stack: the edge around them looks sharp.
FaceKind kind_of(const Corners& corners) {
  const auto& [a, b, c] = corners;
  if (a[2] != b[2] || b[2] != c[2]) return FaceKind::sheet;
  const double turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  return turn > 0 ? FaceKind::top_cap : FaceKind::bottom_cap;
}

void add(Measures& sum, const Measures& part) {
  sum.vertices += part.vertices;
  sum.faces += part.faces;
  sum.volume += part.volume;
}

}  // namespace

ShownMesh::ShownMesh(std::filesystem::path file, std::string unit)
    : file_(std::move(file)),
      unit_(std::move(unit)),
      metres_per_unit_(io::metres_per_unit(unit_).value_or(1)),
      contours_(io::read_contours(file_)) {
  for (io::LabelledMesh& mesh : io::read_meshes(file_)) {
    const Measures measures = measure(mesh.mesh);
    add(sum_, measures);
    ShownLabel about{.label = mesh.label,
                     .colour = mesh.colour,
                     .is_skin = io::is_skin(mesh.label),
                     .slices = contours_.count(mesh.label),
                     .volume = measures.volume,
                     .area = measures.area,
                     .faces = measures.faces};
    parts_.push_back(cut(std::move(mesh.mesh), std::move(about)));
  }
  const Mesh& first = parts_.front().patch.mesh;
  origin_ = first.points[first.faces.front()[0]];
}

ShownMesh::Part ShownMesh::cut(Mesh mesh, ShownLabel about) {
  Part part{{std::move(mesh), {}, {}, {}}, {}, std::move(about)};
  Patch& patch = part.patch;
  for (std::size_t f = 0; f < patch.mesh.faces.size(); ++f) {
    const auto& [a, b, c] = patch.mesh.faces[f];
    const Corners corners{patch.mesh.points[a], patch.mesh.points[b], patch.mesh.points[c]};
    const auto chunk = static_cast<std::uint32_t>(f / chunk_size);
    if (chunk == part.chunks.size()) part.chunks.push_back({chunk, corners[0][2], corners[0][2]});
    for (const Vec3& corner : corners) {
      part.chunks.back().low = std::min(part.chunks.back().low, corner[2]);
      part.chunks.back().high = std::max(part.chunks.back().high, corner[2]);
    }
    patch.kinds.push_back(kind_of(corners));
    patch.slabs.push_back(chunk);
  }
  return part;
}

std::pair<std::string, std::uint64_t> ShownMesh::reset_event() const {
  Json slabs = Json::array();
  for (std::size_t i = 0; i < parts_.size(); ++i)
    for (const SlabInfo& chunk : parts_[i].chunks)
      slabs.push_back({{"id", slab_name({i, chunk.id})},
                       {"low", chunk.low},
                       {"high", chunk.high},
                       {"label", parts_[i].about.label}});
  const Json event{{"kind", "file"},
                   {"name", file_.filename().string()},
                   {"is_patient", false},
                   {"slabs", std::move(slabs)},
                   {"slices", heights()},
                   {"counts", counts()},
                   {"volume", sum_.volume},
                   {"unit", unit_},
                   {"metres_per_unit", metres_per_unit_},
                   {"downloads", {io::extension(file_)}}};
  return {event.dump(-1, ' ', false, Json::error_handler_t::replace), 1};
}

Json ShownMesh::status() const {
  Json status = counts();
  status["volume"] = sum_.volume;
  status["version"] = io::version();
  return status;
}

std::vector<ShownLabel> ShownMesh::labels() {
  std::vector<ShownLabel> labels;
  for (const Part& part : parts_) labels.push_back(part.about);
  return labels;
}

Json ShownMesh::counts() const {
  Json counts{{"vertices", sum_.vertices}, {"faces", sum_.faces}};
  if (const std::size_t slices = heights().size(); slices > 0) counts["slices"] = slices;
  return counts;
}

std::optional<std::string> ShownMesh::slab(std::size_t part, std::uint32_t id) {
  if (part >= parts_.size() || id >= parts_[part].chunks.size()) return {};
  const Part& shown = parts_[part];
  return io::slab_glb(shown.patch, shown.chunks[id], view_of(shown));
}

io::SlabView ShownMesh::view_of(const Part& part) const {
  return {.label = part.about.label,
          .is_double_sided = true,
          .origin = origin_,
          .metres_per_unit = metres_per_unit_,
          .colour = part.about.colour};
}

std::string ShownMesh::slabs(std::span<const SlabRange> ranges, std::size_t most_bytes) {
  std::string glbs;
  for (const SlabRange& range : ranges) {
    if (range.part < parts_.size()) append(glbs, range, most_bytes);
    if (glbs.size() >= most_bytes) break;
  }
  return glbs;
}

void ShownMesh::append(std::string& glbs, const SlabRange& range, std::size_t most_bytes) const {
  const Part& part = parts_[range.part];
  const std::size_t end = std::min<std::size_t>(std::size_t{range.last} + 1, part.chunks.size());
  for (std::size_t begin = range.first; begin < end && glbs.size() < most_bytes;) {
    const std::size_t count = std::min(end - begin, most_bundled);
    std::vector<std::string> ids;
    for (std::size_t i = begin; i < begin + count; ++i)
      ids.push_back(slab_name({range.part, static_cast<std::uint32_t>(i)}));
    glbs += io::bundle_glb(part.patch, std::span(part.chunks).subspan(begin, count), ids,
                           view_of(part));
    begin += count;
  }
}

std::optional<std::string> ShownMesh::surface(std::string_view extension) {
  if (extension != io::extension(file_))
    throw io::UnknownFormat("surface" + std::string(extension), io::extension(file_));
  return io::read_file(file_);
}

}  // namespace loft::app
