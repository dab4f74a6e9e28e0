// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"
#include "reconstruct/surface.h"

namespace loft::io::testing {

/// A regular prism of n sides: bottom cap, walls, top cap; n >= 3. Without caps it is open.
/// Provenance as reconstruct() gives it.
inline Surface prism(std::uint32_t n, const Vec3& corner = {}, double size = 1,
                     bool has_caps = true) {
  Surface surface;
  std::vector<Surface::VertexHandle> rings[2];
  for (std::uint32_t slice = 0; slice < 2; ++slice) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * i / n;
      const auto vertex =
          surface.add_vertex({corner[0] + size * (1 + std::cos(angle)),
                              corner[1] + size * (1 + std::sin(angle)), corner[2] + size * slice});
      surface.data(vertex).origin = {VertexKind::contour, slice, 0, i};
      rings[slice].push_back(vertex);
    }
  }
  const auto add = [&](auto a, auto b, auto c, FaceKind kind) {
    surface.data(surface.add_face(a, b, c)).kind = kind;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    add(rings[0][i], rings[0][j], rings[1][j], FaceKind::wall);
    add(rings[0][i], rings[1][j], rings[1][i], FaceKind::wall);
  }
  for (std::size_t i = 2; has_caps && i < n; ++i) {
    add(rings[0][0], rings[0][i], rings[0][i - 1], FaceKind::bottom_cap);
    add(rings[1][0], rings[1][i - 1], rings[1][i], FaceKind::top_cap);
  }
  return surface;
}

/// A folder that goes away with the object.
class Folder {
 public:
  Folder() {
    std::random_device random;  // the name only: two test programs may run at once
    path_ = std::filesystem::temp_directory_path() /
            ("loft-test-" + std::to_string(getpid()) + '-' + std::to_string(random()));
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return path_ / name;
  }
  [[nodiscard]] std::filesystem::path write(const std::string& name, std::string_view text) const {
    std::filesystem::remove(path_ / name);  // some file systems are slow to overwrite
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  [[nodiscard]] std::size_t size() const {
    const std::filesystem::directory_iterator files(path_);
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }

 private:
  std::filesystem::path path_;
};

inline std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// What `action` throws as an Exception, or "nothing".
template <class Exception, class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  return "nothing";
}

}  // namespace loft::io::testing
