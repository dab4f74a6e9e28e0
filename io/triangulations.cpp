// SPDX-License-Identifier: MIT
#include "io/triangulations.h"

#include <algorithm>
#include <array>
#include <ostream>
#include <string_view>

#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/planar/planar_json.h"
#include "io/planar/planar_ply.h"

namespace loft::io {

namespace {

using Writer = void (*)(std::ostream&, const PlanarMesh&, const SvgOptions&);

struct Format {
  std::string_view extension;
  Writer write;
};

/// For formats that have no options.
template <void (*write_plain)(std::ostream&, const PlanarMesh&)>
void write_with(std::ostream& out, const PlanarMesh& mesh, const SvgOptions&) {
  write_plain(out, mesh);
}

constexpr std::array formats{
    Format{".svg", write_svg},
    Format{".ply", write_with<write_planar_ply>},
    Format{".json", write_with<write_planar_json>},
};

const Format& find_format(const std::filesystem::path& path) {
  const auto found = std::ranges::find(formats, extension(path), &Format::extension);
  if (found == formats.end()) throw UnknownFormat(path, triangulation_extensions());
  return *found;
}

}  // namespace

std::string triangulation_extensions() {
  std::string result;
  for (const Format& format : formats) {
    if (!result.empty()) result += ' ';
    result += format.extension;
  }
  return result;
}

void check_writable_triangulation(const std::filesystem::path& path) {
  static_cast<void>(find_format(path));
  const AtomicFile tried(path);
}

void write(const std::filesystem::path& path, const PlanarMesh& mesh, const SvgOptions& options) {
  const Format& format = find_format(path);
  AtomicFile file(path);
  format.write(file.stream(), mesh, options);
  file.commit();
}

}  // namespace loft::io
