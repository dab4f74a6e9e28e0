// SPDX-License-Identifier: MIT
#include "io/surfaces.h"

#include <algorithm>
#include <array>
#include <ostream>
#include <string_view>

#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/gltf/gltf.h"
#include "io/meshes/obj.h"
#include "io/meshes/off.h"
#include "io/meshes/ply.h"
#include "io/meshes/stl.h"

namespace loft::io {

namespace {

using Writer = void (*)(std::ostream&, std::span<const Part>, const WriteOptions&);

struct Format {
  std::string_view extension;
  Writer write;
};

constexpr std::array formats{
    Format{".glb", write_glb}, Format{".gltf", write_gltf}, Format{".ply", write_ply},
    Format{".obj", write_obj}, Format{".stl", write_stl},   Format{".off", write_off},
};

const Format& find_format(const std::filesystem::path& path, std::string_view extension) {
  const auto found = std::ranges::find(formats, extension, &Format::extension);
  if (found == formats.end()) throw UnknownFormat(path, surface_extensions());
  return *found;
}

const Format& find_format(const std::filesystem::path& path) {
  return find_format(path, extension(path));
}

}  // namespace

std::string surface_extensions() {
  std::string result;
  for (const Format& format : formats) {
    if (!result.empty()) result += ' ';
    result += format.extension;
  }
  return result;
}

void check_writable(const std::filesystem::path& path) {
  static_cast<void>(find_format(path));
  const AtomicFile tried(path);
}

void write(const std::filesystem::path& path, std::span<const Part> parts,
           const WriteOptions& options) {
  const Format& format = find_format(path);
  AtomicFile file(path);
  format.write(file.stream(), parts, options);
  file.commit();
}

void write(std::ostream& out, std::string_view extension, std::span<const Part> parts,
           const WriteOptions& options) {
  find_format("surface" + std::string(extension), extension).write(out, parts, options);
}

}  // namespace loft::io
