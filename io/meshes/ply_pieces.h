// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/bytes/atomic_file.h"
#include "reconstruct/sew/surface_sink.h"
#include "reconstruct/stack.h"

namespace loft::io {

struct PlyLabel;  // io/meshes/ply_records.h
struct PlyPartNote;

/// Writes a PLY file from surfaces that come piece by piece: the bytes of write_ply().
///
/// Vertices and faces go into files of their own beside the output, `.OUT.vertices.N.part` and
/// `.OUT.faces.N.part`; commit() joins them, so that for a while twice the room is needed. Nothing
/// is left behind if it does not come to that. All functions throw FileError where a file cannot be
/// written.
class PlyPieces : public SurfaceSink {
 public:
  /// Each label is one surface, in this order; a single empty one if there are none. As many
  /// colours; those that are none are by the labels' names.
  PlyPieces(std::filesystem::path path, std::vector<std::string> labels,
            std::vector<std::optional<Colour>> colours = {});

  void add_vertices(std::span<const SurfaceVertex> vertices) override;
  void add_faces(std::span<const SurfaceFace> faces) override;
  /// The end of one surface; what comes then is the next one.
  void end(const VertexNumbers& numbers) override;

  /// In the place of end(): the surface at hand does not come, after all. Precondition: nothing of
  /// it has come.
  void skip();

  /// Puts the file in its place. Precondition: all surfaces have ended.
  void commit();
  /// The same for a part (PlyPartHeader), each of whose surfaces came from reconstruct_slabs().
  /// `note.surfaces` has their sizes, `seam_places` the places of their seam faces, in order.
  void commit(const PlyPartNote& note, std::span<const std::uint32_t> seam_places);

 private:
  using Write = std::function<void(std::string_view)>;

  struct Part {
    std::uint64_t first_vertex = 0;
    std::uint64_t vertex_count = 0;
    std::uint64_t face_count = 0;
    VertexNumbers numbers;
  };

  [[nodiscard]] std::optional<PlyLabel> label() const;
  void copy_vertices(const Write& write);
  void copy_faces(const Write& write);

  std::filesystem::path path_;
  std::vector<std::string> labels_;
  std::vector<std::optional<Colour>> colours_;
  bool is_labelled_;
  AtomicFile vertices_;  // never committed: these two go away in the end
  AtomicFile faces_;
  std::vector<Part> parts_{1};  // the last one is at hand
  std::string bytes_;
};

}  // namespace loft::io
