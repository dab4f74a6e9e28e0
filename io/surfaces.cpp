// SPDX-License-Identifier: MIT
#include "io/surfaces.h"

#include <algorithm>
#include <array>
#include <ostream>
#include <string_view>

#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/bytes/format_table.h"
#include "io/gltf/gltf.h"
#include "io/meshes/obj.h"
#include "io/meshes/off.h"
#include "io/meshes/ply.h"
#include "io/meshes/stl.h"

namespace loft::io {

namespace {

struct SurfaceWriter {
  std::string_view extension;
  void (*write)(std::ostream&, std::span<const Part>, const WriteOptions&);
};

constexpr std::array surface_writers{
    SurfaceWriter{".glb", write_glb}, SurfaceWriter{".gltf", write_gltf},
    SurfaceWriter{".ply", write_ply}, SurfaceWriter{".obj", write_obj},
    SurfaceWriter{".stl", write_stl}, SurfaceWriter{".off", write_off},
};

}  // namespace

std::string surface_extensions() { return extensions_of(surface_writers); }

void check_writable(const std::filesystem::path& path) {
  static_cast<void>(format_of(surface_writers, path));
  const AtomicFile tried(path);
}

void write(const std::filesystem::path& path, std::span<const Part> parts,
           const WriteOptions& options) {
  const SurfaceWriter& format = format_of(surface_writers, path);
  AtomicFile file(path);
  format.write(file.stream(), parts, options);
  file.commit();
}

void write(std::ostream& out, std::string_view extension, std::span<const Part> parts,
           const WriteOptions& options) {
  format_of(surface_writers, "surface" + std::string(extension)).write(out, parts, options);
}

}  // namespace loft::io
