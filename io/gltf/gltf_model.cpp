// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_model.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "io/gltf/label_colour.h"
#include "io/version.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

int add_vectors(Buffer& buffer, std::span<const Vec3> vectors) {
  buffer.begin(vectors.size() * 3 * sizeof(float), TINYGLTF_TARGET_ARRAY_BUFFER,
               TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, vectors.size());
  for (const Vec3& vector : vectors) {
    for (const double coordinate : vector) buffer.add(static_cast<float>(coordinate));
  }
  return buffer.last_accessor();
}

/// The smallest and largest coordinates, as `float` holds them.
void set_bounds(tinygltf::Accessor& accessor, std::span<const Vec3> points) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::ranges::minmax(points, {}, [axis](const Vec3& point) { return point[axis]; });
    accessor.minValues.push_back(static_cast<double>(static_cast<float>(low[axis])));
    accessor.maxValues.push_back(static_cast<double>(static_cast<float>(high[axis])));
    if (!std::isfinite(accessor.minValues[axis]) || !std::isfinite(accessor.maxValues[axis])) {
      throw Error("too large for glTF, which has float coordinates in metres; set the unit");
    }
  }
}

template <class Index>
int add_indices(Buffer& buffer, const ShadedMesh& mesh, int component_type) {
  const std::size_t count = 3 * mesh.faces.size();
  buffer.begin(count * sizeof(Index), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, component_type,
               TINYGLTF_TYPE_SCALAR, count);
  for (const auto& face : mesh.faces) {
    for (const std::uint32_t corner : face) buffer.add(static_cast<Index>(corner));
  }
  return buffer.last_accessor();
}

}  // namespace

tinygltf::Primitive primitive(ShadedMesh mesh, const Frame& frame, Buffer& buffer,
                              tinygltf::Model& model) {
  for (Vec3& point : mesh.points) point = frame.relative(point);
  for (Vec3& normal : mesh.normals) normal = Frame::turned(normal);
  tinygltf::Primitive result;
  result.mode = TINYGLTF_MODE_TRIANGLES;
  result.attributes["POSITION"] = add_vectors(buffer, mesh.points);
  set_bounds(model.accessors.back(), mesh.points);
  result.attributes["NORMAL"] = add_vectors(buffer, mesh.normals);
  // Of 16-bit indices the largest value is reserved.
  result.indices =
      mesh.points.size() <= 0xffff
          ? add_indices<std::uint16_t>(buffer, mesh, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
          : add_indices<std::uint32_t>(buffer, mesh, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
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

void write_model(std::ostream& out, const tinygltf::Model& model, bool binary) {
  constexpr std::size_t limit = 0xff00'0000;  // GLB counts its bytes in 32 bits
  if (!model.buffers.empty() && model.buffers[0].data.size() > limit)
    throw Error("too large for glTF: more than 4 GiB");
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&model, out, !binary, binary)) {
    throw Error("tinygltf failed to write glTF");
  }
}

}  // namespace loft::io
