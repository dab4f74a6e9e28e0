// SPDX-License-Identifier: MIT
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "io/gltf.h"
#include "io/little_endian.h"
#include "io/shading.h"
#include "io/utf8.h"
#include "io/version.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

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

Vec3 centre_of(std::span<const Part> parts) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec3 low{infinity, infinity, infinity};
  Vec3 high{-infinity, -infinity, -infinity};
  for (const Part& part : parts) {
    for (const auto vertex : part.surface->vertices()) {
      const auto& point = part.surface->point(vertex);
      for (unsigned axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], point[axis]);
        high[axis] = std::max(high[axis], point[axis]);
      }
    }
  }
  if (!(low[0] <= high[0])) return {};
  return {low[0] / 2 + high[0] / 2, low[1] / 2 + high[1] / 2, low[2] / 2 + high[2] / 2};
}

/// Puts numbers behind one another into the model's only buffer.
class Buffer {
 public:
  explicit Buffer(tinygltf::Model& model) : model_(model) { model_.buffers.resize(1); }

  /// A view of `size` bytes for the numbers that are put next, and the accessor that reads them.
  void begin(std::size_t size, int target, int component_type, int type, std::size_t count) {
    std::vector<unsigned char>& data = model_.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = size;
    view.target = target;
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

/// Colours as far apart as can be for any number of parts: hues a golden angle apart, the first
/// that of bone. Linear, as glTF has them.
std::vector<double> colour(std::size_t number) {
  if (number == 0) return {0.80, 0.72, 0.58, 1.0};
  constexpr double golden = 0.618'033'988'749'895;
  const double hue = std::fmod(0.02 + golden * static_cast<double>(number), 1.0) * 6;
  const auto channel = [hue](double shift) {
    const double k = std::fmod(hue + shift, 6.0);
    return 0.75 - 0.6 * std::clamp(std::min(k, 4 - k), 0.0, 1.0);
  };
  return {channel(5), channel(3), channel(1), 1.0};
}

bool is_open(const Surface& surface) {
  return std::ranges::any_of(surface.halfedges(),
                             [&](const auto halfedge) { return surface.is_boundary(halfedge); });
}

/// Text that JSON can hold: where it is no UTF-8 (a file's name can be anything), its odd bytes are
/// replaced.
std::string json_text(std::string text) {
  if (is_utf8(text)) return text;
  std::ranges::replace_if(
      text, [](char c) { return (c & 0x80) != 0; }, '?');
  return text;
}

std::string name_of(const Part& part) {
  return part.label.empty() ? "surface" : json_text(part.label);
}

tinygltf::Material material(const Part& part, std::size_t number) {
  tinygltf::Material result;
  result.name = name_of(part);
  result.pbrMetallicRoughness.baseColorFactor = colour(number);
  result.pbrMetallicRoughness.metallicFactor = 0;
  result.pbrMetallicRoughness.roughnessFactor = 0.7;
  result.doubleSided = is_open(*part.surface);
  return result;
}

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

void add_part(const Part& part, const Frame& frame, Buffer& buffer, tinygltf::Model& model) {
  const auto number = model.nodes.size();
  tinygltf::Mesh mesh;
  mesh.name = name_of(part);
  mesh.primitives.push_back(primitive(shade(*part.surface), frame, buffer, model));
  mesh.primitives.back().material = static_cast<int>(number);
  model.meshes.push_back(std::move(mesh));
  model.materials.push_back(material(part, number));

  tinygltf::Node node;
  node.name = name_of(part);
  node.mesh = static_cast<int>(number);
  const Vec3 translation = frame.translation();
  node.translation.assign(translation.begin(), translation.end());
  model.nodes.push_back(std::move(node));
  model.scenes[0].nodes.push_back(static_cast<int>(number));
}

tinygltf::Value extras(const WriteOptions& options) {
  tinygltf::Value::Array sources;
  for (const std::string& source : options.sources) sources.emplace_back(json_text(source));
  tinygltf::Value::Object settings;
  for (const auto& [key, value] : options.settings)
    settings[json_text(key)] = tinygltf::Value(json_text(value));
  tinygltf::Value::Object result;
  result["metres_per_unit"] = tinygltf::Value(options.metres_per_unit);
  result["up"] = tinygltf::Value(std::string("z"));
  if (!sources.empty()) result["sources"] = tinygltf::Value(std::move(sources));
  if (!settings.empty()) result["settings"] = tinygltf::Value(std::move(settings));
  return tinygltf::Value(std::move(result));
}

tinygltf::Model to_model(std::span<const Part> parts, const WriteOptions& options) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = std::string(generator());
  model.asset.extras = extras(options);
  model.scenes.resize(1);
  model.defaultScene = 0;
  const Frame frame{centre_of(parts), options.metres_per_unit};
  Buffer buffer(model);
  for (const Part& part : parts) {
    if (part.surface->n_faces() > 0) add_part(part, frame, buffer, model);
  }
  if (model.nodes.empty()) throw Error("glTF cannot hold a surface without faces");
  constexpr std::size_t limit = 0xff00'0000;  // GLB counts its bytes in 32 bits
  if (model.buffers[0].data.size() > limit) throw Error("too large for glTF: more than 4 GiB");
  return model;
}

void write_model(std::ostream& out, const tinygltf::Model& model, bool binary) {
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&model, out, !binary, binary)) {
    throw Error("tinygltf failed to write glTF");
  }
}

}  // namespace

void write_glb(std::ostream& out, std::span<const Part> parts, const WriteOptions& options) {
  write_model(out, to_model(parts, options), true);
}

void write_gltf(std::ostream& out, std::span<const Part> parts, const WriteOptions& options) {
  write_model(out, to_model(parts, options), false);
}

}  // namespace loft::io
