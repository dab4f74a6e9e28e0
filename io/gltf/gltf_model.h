// SPDX-License-Identifier: MIT
// What writers of glTF have in common; for their sources only, as it shows tinygltf.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "io/bytes/little_endian.h"
#include "io/gltf/shading.h"
#include "mesh/mesh.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// From the input's axes and unit to glTF's.
struct Frame {
  Vec3 centre{};  ///< in the input's axes and unit
  double metres_per_unit = 1;

  [[nodiscard]] static Vec3 turned(const Vec3& v) { return {v[0], v[2], -v[1]}; }
  [[nodiscard]] Vec3 relative(const Vec3& p) const {
    return turned({(p[0] - centre[0]) * metres_per_unit, (p[1] - centre[1]) * metres_per_unit,
                   (p[2] - centre[2]) * metres_per_unit});
  }
  [[nodiscard]] Vec3 translation() const {
    return turned(
        {centre[0] * metres_per_unit, centre[1] * metres_per_unit, centre[2] * metres_per_unit});
  }
};

/// Puts numbers behind one another into the model's only buffer.
class Buffer {
 public:
  explicit Buffer(tinygltf::Model& model) : model_(model) { model_.buffers.resize(1); }

  /// A view of `size` bytes for the numbers that are put next, and the accessor that reads them.
  /// `target`: 0 for what is no vertex and no index; `stride`: 0 where no bytes are between them.
  void begin(std::size_t size, int target, int component_type, int type, std::size_t count,
             std::size_t stride = 0) {
    std::vector<unsigned char>& data = model_.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = size;
    view.target = target;
    view.byteStride = stride;
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size());
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = count;
    model_.bufferViews.push_back(std::move(view));
    model_.accessors.push_back(std::move(accessor));
    data.resize(data.size() + size);
    place_ = reinterpret_cast<char*>(data.data() + data.size() - size);
  }

  template <class Number>
  void add(Number number) {
    place_ = put(place_, number);
  }

  [[nodiscard]] int last_accessor() const { return static_cast<int>(model_.accessors.size()) - 1; }

 private:
  tinygltf::Model& model_;
  char* place_ = nullptr;
};

/// Adds numbers to the buffer and the model's accessors, and returns the accessor.
[[nodiscard]] int add_vectors(Buffer& buffer, std::span<const Vec3> vectors);
/// With their bounds. Throws Error where they are too large for `float`.
[[nodiscard]] int add_positions(Buffer& buffer, tinygltf::Model& model,
                                std::span<const Vec3> points);
/// In 16 bits where that is enough for so many vertices.
[[nodiscard]] int add_indices(Buffer& buffer, std::span<const std::uint32_t> indices,
                              std::size_t vertex_count);

/// The corners of all faces, one behind the other.
[[nodiscard]] std::span<const std::uint32_t> corners_of(const ShadedMesh& mesh);

/// Adds a mesh to the buffer and the model's accessors. Throws Error where it is too large for
/// `float`.
[[nodiscard]] tinygltf::Primitive primitive(ShadedMesh mesh, const Frame& frame, Buffer& buffer,
                                            tinygltf::Model& model);

/// Not metallic, in that colour, or that of the label of that name.
[[nodiscard]] tinygltf::Material material(const std::string& name, bool is_double_sided,
                                          std::optional<Colour> colour = {});

/// An empty model with its version, the program's name and a scene.
[[nodiscard]] tinygltf::Model empty_model();

/// `on_lines`: JSON that is no GLB's has a line for each value. Throws Error where that fails, and
/// where the buffer is larger than glTF can say.
void write_model(std::ostream& out, const tinygltf::Model& model, bool binary,
                 bool on_lines = true);

}  // namespace loft::io
