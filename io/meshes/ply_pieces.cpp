// SPDX-License-Identifier: MIT
#include "io/meshes/ply_pieces.h"

#include <algorithm>
#include <cassert>
#include <fstream>
#include <utility>

#include "io/bytes/checksum.h"
#include "io/bytes/file.h"
#include "io/meshes/label_colour.h"
#include "io/meshes/ply_part.h"
#include "io/meshes/ply_records.h"

namespace loft::io {

namespace {

std::filesystem::path beside(const std::filesystem::path& path, const char* suffix) {
  std::filesystem::path result = path;
  result += suffix;
  return result;
}

void check(const std::ostream& out, const std::filesystem::path& path) {
  if (!out) throw FileError(Access::write, path, last_cause());
}

/// Calls take(bytes) for all of a file, about a megabyte at a time, in whole records.
template <class Take>
void read_back(AtomicFile& file, std::size_t record_size, Take take) {
  file.stream().flush();
  check(file.stream(), file.temporary());
  std::ifstream in(file.temporary(), std::ios::binary);
  std::string bytes(((std::size_t{1} << 20U) / record_size + 1) * record_size, '\0');
  while (in) {
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    take(std::span(bytes).first(static_cast<std::size_t>(in.gcount())));
  }
  if (!in.eof()) throw FileError(Access::read, file.temporary(), last_cause());
}

}  // namespace

PlyPieces::PlyPieces(std::filesystem::path path, std::vector<std::string> labels,
                     std::vector<std::optional<Colour>> colours)
    : path_(std::move(path)),
      labels_(std::move(labels)),
      colours_(std::move(colours)),
      is_labelled_(ply_has_labels(labels_)),
      vertices_(beside(path_, ".vertices")),
      faces_(beside(path_, ".faces")) {
  colours_.resize(labels_.size());
}

std::optional<PlyLabel> PlyPieces::label() const {
  if (!is_labelled_) return std::nullopt;
  const std::size_t part = parts_.size() - 1;
  return PlyLabel{static_cast<std::int32_t>(part),
                  colour_of({labels_[part], nullptr, colours_[part]})};
}

void PlyPieces::add_vertices(std::span<const SurfaceVertex> vertices) {
  bytes_.resize(vertices.size() * ply_vertex_size(is_labelled_));
  char* place = bytes_.data();
  const std::optional<PlyLabel> said = label();
  for (const SurfaceVertex& vertex : vertices)
    place = put_ply_vertex(place, vertex.place, vertex.origin, said);
  vertices_.stream().write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
  check(vertices_.stream(), path_);
  parts_.back().vertex_count += vertices.size();
}

/// Corners are written as they come; copy_faces() gives them their final numbers.
void PlyPieces::add_faces(std::span<const SurfaceFace> faces) {
  bytes_.resize(faces.size() * ply_face_size(is_labelled_));
  char* place = bytes_.data();
  const std::optional<PlyLabel> said = label();
  for (const SurfaceFace& face : faces)
    place = put_ply_face(place, face.corners, face.kind, face.slab, said);
  faces_.stream().write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
  check(faces_.stream(), path_);
  parts_.back().face_count += faces.size();
}

void PlyPieces::end(const VertexNumbers& numbers) {
  parts_.back().numbers = numbers;
  Part next;
  next.first_vertex = parts_.back().first_vertex + parts_.back().vertex_count;
  parts_.push_back(next);
}

void PlyPieces::skip() {
  assert(parts_.back().vertex_count == 0 && parts_.back().face_count == 0);
  const auto part = static_cast<std::ptrdiff_t>(parts_.size() - 1);
  labels_.erase(labels_.begin() + part);
  colours_.erase(colours_.begin() + part);
}

void PlyPieces::commit() {
  PlyCounts counts;
  for (const Part& part : parts_) {
    counts.vertices += part.vertex_count;
    counts.faces += part.face_count;
  }
  AtomicFile file(path_);
  const Write write = [&](std::string_view bytes) {
    file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    check(file.stream(), path_);
  };
  write(ply_header(labels_, is_labelled_, counts));
  copy_vertices(write);
  copy_faces(write);
  file.commit();
}

void PlyPieces::commit(const PlyPartNote& note, std::span<const std::uint32_t> seam_places) {
  AtomicFile file(path_);
  std::uint64_t sum = no_checksum;
  const Write write = [&](std::string_view bytes) {
    sum = checksum(bytes, sum);
    file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    check(file.stream(), path_);
  };
  write(PlyPartHeader{note, labels_}.text());
  copy_vertices(write);
  copy_faces(write);
  bytes_.resize(seam_places.size() * ply_seam_face_size);
  char* place = bytes_.data();
  for (const std::uint32_t said : seam_places) place = put(place, said);
  write(bytes_);
  bytes_.resize(ply_checksum_size);
  put(bytes_.data(), sum);
  write(bytes_);
  file.commit();
}

void PlyPieces::copy_vertices(const Write& write) {
  read_back(vertices_, ply_vertex_size(is_labelled_), [&](std::span<char> bytes) {
    write({bytes.data(), bytes.size()});
  });
}

void PlyPieces::copy_faces(const Write& write) {
  auto part = parts_.begin();
  std::uint64_t left = part->face_count;
  const std::size_t size = ply_face_size(is_labelled_);
  read_back(faces_, size, [&](std::span<char> bytes) {
    for (std::size_t at = 0; at < bytes.size(); at += size, --left) {
      while (left == 0) left = (++part)->face_count;
      for (std::size_t i = 0; i < 3; ++i) {
        char* const corner = bytes.data() + at + ply_face_corners + 4 * i;
        const std::uint64_t number =
            part->first_vertex + part->numbers.final(get<std::uint32_t>(corner));
        put(corner, static_cast<std::uint32_t>(number));
      }
    }
    write({bytes.data(), bytes.size()});
  });
}

}  // namespace loft::io
