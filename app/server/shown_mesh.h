// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "app/server/shown.h"
#include "app/server/shown_contours.h"
#include "io/gltf/slab_glb.h"
#include "io/unit.h"
#include "mesh/measure.h"
#include "mesh/mesh.h"
#include "reconstruct/live/snapshot.h"

namespace loft::app {

/// The meshes of a file, which do not change, for viewers: in place of slabs there are chunks of
/// faces, numbered from 0 in each mesh; slices, where the file knows them.
class ShownMesh : public Shown {
 public:
  /// Throws as io::read_meshes().
  ShownMesh(std::filesystem::path file, std::string unit);

  [[nodiscard]] std::pair<std::string, std::uint64_t> reset_event() const override;
  [[nodiscard]] Json status() const override;
  [[nodiscard]] std::vector<ShownLabel> labels() override;
  [[nodiscard]] std::optional<std::string> slab(std::size_t part, std::uint32_t id) override;
  [[nodiscard]] std::string slabs(std::span<const SlabRange> ranges,
                                  std::size_t most_bytes) override;
  /// The file itself.
  [[nodiscard]] std::optional<std::string> surface(std::string_view extension) override;
  [[nodiscard]] std::optional<Slice> slice(double z) const override { return contours_.slice(z); }
  [[nodiscard]] std::vector<double> heights() const override { return contours_.heights(); }

 private:
  struct Part {
    Patch patch;                   // its slabs are the chunks
    std::vector<SlabInfo> chunks;  // with their lowest and highest place
    ShownLabel about;
  };
  [[nodiscard]] static Part cut(Mesh mesh, ShownLabel about);
  [[nodiscard]] Json counts() const;
  [[nodiscard]] io::SlabView view_of(const Part& part) const;
  void append(std::string& glbs, const SlabRange& range, std::size_t most_bytes) const;

  std::filesystem::path file_;
  std::string unit_;
  double metres_per_unit_;
  std::vector<Part> parts_;
  ShownContours contours_;
  Measures sum_;  // of all parts
  Vec3 origin_{};
};

}  // namespace loft::app
