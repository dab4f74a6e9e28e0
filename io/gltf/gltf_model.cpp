// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_model.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "io/meshes/label_colour.h"
#include "io/rounding/float_frame.h"
#include "io/version.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

/// The smallest and largest coordinates, as `float` holds them.
void set_bounds(tinygltf::Accessor& accessor, std::span<const Vec3> points) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::ranges::minmax(points, {}, [axis](const Vec3& point) { return point[axis]; });
    accessor.minValues.push_back(as_float(low[axis]));
    accessor.maxValues.push_back(as_float(high[axis]));
    if (!std::isfinite(accessor.minValues[axis]) || !std::isfinite(accessor.maxValues[axis])) {
      throw Error("too large for glTF, which has float coordinates in metres; set the unit");
    }
  }
}

template <class Index>
int add_indices_as(Buffer& buffer, std::span<const std::uint32_t> indices, int component_type) {
  buffer.begin(indices.size() * sizeof(Index), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, component_type,
               TINYGLTF_TYPE_SCALAR, indices.size());
  for (const std::uint32_t index : indices) buffer.add(static_cast<Index>(index));
  return buffer.last_accessor();
}

}  // namespace

int add_vectors(Buffer& buffer, std::span<const Vec3> vectors) {
  buffer.begin(vectors.size() * 3 * sizeof(float), TINYGLTF_TARGET_ARRAY_BUFFER,
               TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, vectors.size());
  for (const Vec3& vector : vectors) {
    for (const double coordinate : vector) buffer.add(static_cast<float>(coordinate));
  }
  return buffer.last_accessor();
}

int add_positions(Buffer& buffer, tinygltf::Model& model, std::span<const Vec3> points) {
  const int accessor = add_vectors(buffer, points);
  set_bounds(model.accessors.back(), points);
  return accessor;
}

int add_indices(Buffer& buffer, std::span<const std::uint32_t> indices, std::size_t vertex_count) {
  // Of 16-bit indices the largest value is reserved.
  return vertex_count <= 0xffff
             ? add_indices_as<std::uint16_t>(buffer, indices,
                                             TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
             : add_indices_as<std::uint32_t>(buffer, indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
}

std::span<const std::uint32_t> corners_of(const ShadedMesh& mesh) {
  static_assert(sizeof(mesh.faces[0]) == 3 * sizeof(std::uint32_t));
  if (mesh.faces.empty()) return {};
  return {mesh.faces.front().data(), 3 * mesh.faces.size()};
}

tinygltf::Primitive primitive(ShadedMesh mesh, const Frame& frame, Buffer& buffer,
                              tinygltf::Model& model) {
  for (Vec3& point : mesh.points) point = frame.relative(point);
  for (Vec3& normal : mesh.normals) normal = Frame::turned(normal);
  tinygltf::Primitive result;
  result.mode = TINYGLTF_MODE_TRIANGLES;
  result.attributes["POSITION"] = add_positions(buffer, model, mesh.points);
  result.attributes["NORMAL"] = add_vectors(buffer, mesh.normals);
  result.indices = add_indices(buffer, corners_of(mesh), mesh.points.size());
  return result;
}

tinygltf::Material material(const std::string& name, bool is_double_sided,
                            std::optional<Colour> colour) {
  const auto [red, green, blue] = colour ? linear(*colour) : label_colour(name);
  tinygltf::Material result;
  result.name = name;
  result.pbrMetallicRoughness.baseColorFactor = {red, green, blue, 1.0};
  result.pbrMetallicRoughness.metallicFactor = 0;
  result.pbrMetallicRoughness.roughnessFactor = 0.7;
  result.doubleSided = is_double_sided;
  return result;
}

tinygltf::Model empty_model() {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = std::string(generator());
  model.scenes.resize(1);
  model.defaultScene = 0;
  return model;
}

void write_model(std::ostream& out, const tinygltf::Model& model, bool binary, bool on_lines) {
  constexpr std::size_t limit = 0xff00'0000;  // GLB counts its bytes in 32 bits
  if (!model.buffers.empty() && model.buffers[0].data.size() > limit)
    throw Error("too large for glTF: more than 4 GiB");
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&model, out, on_lines && !binary, binary)) {
    throw Error("tinygltf failed to write glTF");
  }
}

}  // namespace loft::io
