// SPDX-License-Identifier: MIT
#include "io/triangulations.h"

#include <algorithm>
#include <array>
#include <ostream>
#include <string_view>

#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/bytes/format_table.h"
#include "io/planar/planar_json.h"
#include "io/planar/planar_ply.h"

namespace loft::io {

namespace {

struct TriangulationWriter {
  std::string_view extension;
  void (*write)(std::ostream&, const PlanarMesh&, const SvgOptions&);
};

/// For formats that have no options.
template <void (*write_plain)(std::ostream&, const PlanarMesh&)>
void write_with(std::ostream& out, const PlanarMesh& mesh, const SvgOptions&) {
  write_plain(out, mesh);
}

constexpr std::array triangulation_writers{
    TriangulationWriter{".svg", write_svg},
    TriangulationWriter{".ply", write_with<write_planar_ply>},
    TriangulationWriter{".json", write_with<write_planar_json>},
};

}  // namespace

std::string triangulation_extensions() { return extensions_of(triangulation_writers); }

void check_writable_triangulation(const std::filesystem::path& path) {
  static_cast<void>(format_of(triangulation_writers, path));
  const AtomicFile tried(path);
}

void write(const std::filesystem::path& path, const PlanarMesh& mesh, const SvgOptions& options) {
  const TriangulationWriter& format = format_of(triangulation_writers, path);
  AtomicFile file(path);
  format.write(file.stream(), mesh, options);
  file.commit();
}

}  // namespace loft::io
