// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/exhibit.h"
#include "io/shading.h"
#include "reconstruct/vec3.h"

namespace loft::app {

/// The meshes of a file, cut into chunks across z that are shown as slabs are. It never changes.
class MeshExhibit : public Exhibit {
 public:
  /// Throws as io::read_meshes().
  MeshExhibit(const std::filesystem::path& file, const std::string& unit);

  [[nodiscard]] std::pair<std::string, std::uint64_t> reset_event() const override;
  [[nodiscard]] std::optional<std::string> slab_file(std::size_t part, std::uint32_t id) override;
  /// The file itself, by its own extension.
  [[nodiscard]] std::optional<std::string> surface_file(const std::string& extension) override;
  [[nodiscard]] std::optional<Slice> slice(double z) const override;
  [[nodiscard]] std::vector<double> heights() const override { return {}; }
  [[nodiscard]] Json status() const override;

 private:
  struct Chunk {
    std::size_t part = 0;
    std::string label;
    io::ShadedMesh mesh;
    double low = 0;
    double high = 0;
  };

  void add(std::size_t part, const std::string& label, const Mesh& mesh);
  [[nodiscard]] Json counts() const;

  std::filesystem::path file_;
  std::string unit_;
  std::vector<Chunk> chunks_;
  Vec3 origin_{};
  std::size_t vertices_ = 0;
  std::size_t faces_ = 0;
  double volume_ = 0;
};

}  // namespace loft::app
