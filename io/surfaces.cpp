// SPDX-License-Identifier: MIT
#include "io/surfaces.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <ostream>
#include <string_view>
#include <system_error>

#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/bytes/format_table.h"
#include "io/bytes/zip.h"
#include "io/gltf/gltf.h"
#include "io/meshes/extent.h"
#include "io/meshes/materials.h"
#include "io/meshes/obj.h"
#include "io/meshes/off.h"
#include "io/meshes/ply.h"
#include "io/meshes/stl.h"
#include "io/meshes/three_mf.h"
#include "io/rounding/near_origin.h"
#include "io/rounding/rounded_parts.h"

namespace loft::io {

namespace {

/// How a format keeps coordinates.
enum class Coordinates { exact, float_in_metres, float_as_they_are, read_as_float };

struct SurfaceWriter {
  std::string_view extension;
  void (*write)(std::ostream&, std::span<const Part>, const WriteOptions&);
  Coordinates coordinates = Coordinates::exact;
};

constexpr std::array surface_writers{
    SurfaceWriter{".glb", write_glb, Coordinates::float_in_metres},
    SurfaceWriter{".gltf", write_gltf, Coordinates::float_in_metres},
    SurfaceWriter{".ply", write_ply},
    SurfaceWriter{".obj", write_obj},
    SurfaceWriter{".stl", write_stl, Coordinates::float_as_they_are},
    SurfaceWriter{".off", write_off},
    SurfaceWriter{".3mf", write_3mf, Coordinates::read_as_float},
};

Written write_in_metres(const SurfaceWriter& format, std::ostream& out, std::span<const Part> parts,
                        WriteOptions options) {
  if (!options.origin) options.origin = centre_of(extent(parts));
  FloatFrame frame{*options.origin, options.metres_per_unit};
  if (options.compression != Compression::none) {
    if (!options.grid) options.grid = compression_grid(parts, options);
    frame.grid = options.grid;
  }
  const RoundedParts rounded(parts, frame, false, options.threads);
  format.write(out, rounded.parts(), options);
  return {rounded.rounding()};
}

Written write_as_they_are(const SurfaceWriter& format, std::ostream& out,
                          std::span<const Part> parts, WriteOptions options) {
  const RoundedParts rounded = round_as_they_are(parts, options.origin, options.threads);
  format.write(out, rounded.parts(), options);
  return {rounded.rounding(), options.origin};
}

/// 3MF, whose readers make `float` of its exact coordinates.
Written write_to_be_rounded(const SurfaceWriter& format, std::ostream& out,
                            std::span<const Part> parts, const WriteOptions& options) {
  const RoundedParts rounded(parts, {{}, three_mf_factor(options.metres_per_unit)}, false,
                             options.threads);
  format.write(out, rounded.parts(), options);
  return {rounded.rounding()};
}

Written write_surfaces(const SurfaceWriter& format, std::ostream& out, std::span<const Part> parts,
                       const WriteOptions& options) {
  switch (format.coordinates) {
    case Coordinates::float_in_metres:
      return write_in_metres(format, out, parts, options);
    case Coordinates::float_as_they_are:
      return write_as_they_are(format, out, parts, options);
    case Coordinates::read_as_float:
      return write_to_be_rounded(format, out, parts, options);
    case Coordinates::exact:
      break;
  }
  format.write(out, parts, options);
  return {};
}

/// Where an OBJ has a file of materials beside it: not at the end of a pipe.
std::optional<std::filesystem::path> materials_of(const std::filesystem::path& path,
                                                  std::span<const Part> parts) {
  if (extension(path) != ".obj" || !has_materials(parts)) return {};
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) return {};
  return path.parent_path() / materials_name(path);
}

}  // namespace

std::string surface_extensions() { return extensions_of(surface_writers); }

void check_writable(const std::filesystem::path& path) {
  static_cast<void>(format_of(surface_writers, path));
  if (extension(path) == ".3mf" && !has_zip())
    throw Error(path.string() + ": " + std::string(no_zip));
  const AtomicFile tried(path);
}

Written write(const std::filesystem::path& path, std::span<const Part> parts,
              const WriteOptions& options) {
  const SurfaceWriter& format = format_of(surface_writers, path);
  WriteOptions named = options;
  AtomicFile file(path);
  if (const auto materials = materials_of(path, parts)) {
    named.materials = materials->filename().string();
    AtomicFile beside(*materials);  // first, so that no OBJ lacks it
    write_mtl(beside.stream(), parts);
    beside.commit();
  }
  const Written written = write_surfaces(format, file.stream(), parts, named);
  file.commit();
  return written;
}

Written write(std::ostream& out, std::string_view extension, std::span<const Part> parts,
              const WriteOptions& options) {
  const SurfaceWriter& format = format_of(surface_writers, "surface" + std::string(extension));
  return write_surfaces(format, out, parts, options);
}

}  // namespace loft::io
