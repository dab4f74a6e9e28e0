// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>

#include "io/bytes/utf8.h"
#include "io/gltf/gltf.h"
#include "io/gltf/gltf_model.h"
#include "io/gltf/meshopt.h"
#include "io/gltf/node_extras.h"
#include "io/gltf/packed.h"
#include "io/gltf/shading.h"
#include "io/meshes/extent.h"
#include "io/meshes/grid.h"
#include "io/meshes/rim.h"
#include "io/meshes/skin.h"
#include "mesh/vec3.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

Vec3 place_of(const Surface& surface, Surface::VertexHandle vertex) {
  const auto& point = surface.point(vertex);
  return {point[0], point[1], point[2]};
}

Frame frame_of(std::span<const Part> parts, const WriteOptions& options) {
  return {options.origin ? *options.origin : centre_of(extent(parts)), options.metres_per_unit};
}

/// The heights of slices, around the frame's centre; of tilted ones there are too many.
std::vector<double> levels_of(std::span<const Part> parts, const Frame& frame) {
  constexpr std::size_t most = 0xffff;
  std::set<double> levels;
  for (const Part& part : parts)
    for (const auto vertex : part.surface->vertices()) {
      if (part.surface->data(vertex).origin.kind != VertexKind::contour) continue;
      if (levels.insert(frame.relative(place_of(*part.surface, vertex))[1]).second &&
          levels.size() > most)
        return {};
    }
  return {levels.begin(), levels.end()};
}

/// Of all that parts have, around the frame's centre, its axes turned.
Grid grid_of(std::span<const Part> parts, const Frame& frame) {
  Box3 box = extent(parts);
  for (const Part& part : parts)
    for (const ContourLine& contour : part.contours)
      for (const Vec3& point : contour.points) box = extended(box, point);
  if (!(box.low[0] <= box.high[0])) return {{}, {}};
  const Vec3 a = frame.relative(box.low);
  const Vec3 b = frame.relative(box.high);
  Grid grid({a[0], a[1], b[2]}, {b[0], b[1], a[2]});
  grid.fit(levels_of(parts, frame), b[1]);
  return grid;
}

std::string name_of(const Part& part) {
  return part.label.empty() ? "surface" : json_text(part.label);
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

void add_name(std::vector<std::string>& names, const char* name) {
  if (std::ranges::find(names, name) == names.end()) names.emplace_back(name);
}

/// A line from each point of an contour to the next, and from the last to the first.
std::vector<std::uint32_t> sides_of(std::span<const ContourLine> contours) {
  std::vector<std::uint32_t> ends;
  std::uint32_t first = 0;
  for (const ContourLine& contour : contours) {
    const auto count = static_cast<std::uint32_t>(contour.points.size());
    for (std::uint32_t i = 0; i < count; ++i)
      ends.insert(ends.end(), {first + i, first + (i + 1) % count});
    first += count;
  }
  return ends;
}

/// Makes the model of all parts.
class Composer {
 public:
  Composer(std::span<const Part> parts, const WriteOptions& options)
      : parts_(parts), options_(options), frame_(frame_of(parts, options)) {
    if (options.compression == Compression::none) return;
    grid_ = options.grid ? *options.grid : grid_of(parts, frame_);
  }

  void write(std::ostream& out, bool binary) {
    model_.asset.extras = extras(options_);
    for (const Part& part : parts_) {
      if (!has_faces(part)) continue;
      add_surface(part);
      if (!part.contours.empty()) add_contours(part);
    }
    if (model_.nodes.empty()) throw Error("glTF cannot hold a surface without faces");
    if (grid_) {
      add_name(model_.extensionsUsed, "KHR_mesh_quantization");
      add_name(model_.extensionsRequired, "KHR_mesh_quantization");
    }
    if (options_.compression == Compression::meshopt) {
      write_packed(out, std::move(model_), octahedral_, binary);
    } else {
      write_model(out, model_, binary);
    }
  }

 private:
  static bool has_faces(const Part& part) { return part.surface->n_faces() > 0; }

  void add_surface(const Part& part) {
    const bool is_open = has_rim(*part.surface);
    tinygltf::Material look = material(name_of(part), is_open, part.colour);
    if (is_see_through(part, parts_)) {
      look.alphaMode = "BLEND";
      look.pbrMetallicRoughness.baseColorFactor[3] = skin_opacity;
    }
    tinygltf::Node& node = add_node(name_of(part), triangles(*part.surface), std::move(look), part);
    node.extras = part_extras(part, is_open, options_.metres_per_unit);
  }

  /// In a darker colour, to be seen on the surface.
  void add_contours(const Part& part) {
    constexpr double darker = 0.35;
    const std::string name = name_of(part) + " contours";
    tinygltf::Material look = material(name_of(part), false, part.colour);
    look.name = name;
    for (std::size_t i = 0; i < 3; ++i) look.pbrMetallicRoughness.baseColorFactor[i] *= darker;
    tinygltf::Node& node = add_node(name, lines(part.contours), std::move(look), part);
    node.extras = contour_extras(part, name_of(part));
  }

  tinygltf::Node& add_node(const std::string& name, tinygltf::Primitive primitive,
                           tinygltf::Material look, const Part& part) {
    const auto number = static_cast<int>(model_.nodes.size());
    primitive.material = number;
    tinygltf::Mesh mesh;
    mesh.name = name;
    mesh.primitives.push_back(std::move(primitive));
    model_.meshes.push_back(std::move(mesh));
    model_.materials.push_back(std::move(look));
    model_.scenes[0].nodes.push_back(number);
    tinygltf::Node& node = model_.nodes.emplace_back();
    node.name = name;
    node.mesh = number;
    put_in_place(node);
    if (part.is_hidden) hide(node);
    return node;
  }

  void put_in_place(tinygltf::Node& node) const {
    Vec3 translation = frame_.translation();
    if (grid_) {
      for (std::size_t axis = 0; axis < 3; ++axis) translation[axis] += grid_->low()[axis];
      node.scale.assign(3, grid_->step());
    }
    node.translation.assign(translation.begin(), translation.end());
  }

  void hide(tinygltf::Node& node) {
    constexpr const char* visibility = "KHR_node_visibility";
    add_name(model_.extensionsUsed, visibility);
    node.extensions[visibility] =
        tinygltf::Value(tinygltf::Value::Object{{"visible", tinygltf::Value(false)}});
  }

  tinygltf::Primitive triangles(const Surface& surface) {
    ShadedMesh mesh = shade(surface);
    if (!grid_) return primitive(std::move(mesh), frame_, buffer_, model_);
    if (options_.compression == Compression::meshopt) reorder(mesh);
    for (Vec3& normal : mesh.normals) normal = Frame::turned(normal);
    tinygltf::Primitive result;
    result.mode = TINYGLTF_MODE_TRIANGLES;
    result.attributes["POSITION"] = add_places(mesh.points);
    result.attributes["NORMAL"] = add_normals(mesh.normals);
    result.indices = add_indices(buffer_, corners_of(mesh), mesh.points.size());
    return result;
  }

  tinygltf::Primitive lines(std::span<const ContourLine> contours) {
    std::vector<Vec3> points;
    for (const ContourLine& contour : contours)
      points.insert(points.end(), contour.points.begin(), contour.points.end());
    tinygltf::Primitive result;
    result.mode = TINYGLTF_MODE_LINE;
    result.attributes["POSITION"] = add_places(points);
    result.indices = add_indices(buffer_, sides_of(contours), points.size());
    return result;
  }

  int add_places(std::vector<Vec3> points) {
    for (Vec3& point : points) point = frame_.relative(point);
    return grid_ ? add_cells(points) : add_positions(buffer_, model_, points);
  }

  int add_cells(std::span<const Vec3> points) {
    constexpr std::size_t stride = 8;  // vertices begin at multiples of four
    if (!std::isfinite(static_cast<float>(grid_->step() * Grid::last)))
      throw Error("too large for glTF, which has float coordinates in metres; set the unit");
    buffer_.begin(points.size() * stride, TINYGLTF_TARGET_ARRAY_BUFFER,
                  TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC3, points.size(),
                  stride);
    Grid::Cell low{Grid::last, Grid::last, Grid::last};
    Grid::Cell high{};
    for (const Vec3& point : points) {
      const Grid::Cell cell = grid_->cell(point);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], cell[axis]);
        high[axis] = std::max(high[axis], cell[axis]);
        buffer_.add(cell[axis]);
      }
      buffer_.add(std::uint16_t{0});
    }
    model_.accessors.back().minValues.assign(low.begin(), low.end());
    model_.accessors.back().maxValues.assign(high.begin(), high.end());
    return buffer_.last_accessor();
  }

  int add_normals(std::span<const Vec3> normals) {
    constexpr std::size_t stride = 4;
    buffer_.begin(normals.size() * stride, TINYGLTF_TARGET_ARRAY_BUFFER,
                  TINYGLTF_COMPONENT_TYPE_BYTE, TINYGLTF_TYPE_VEC3, normals.size(), stride);
    model_.accessors.back().normalized = true;
    if (options_.compression == Compression::meshopt) {
      octahedral_.insert(model_.accessors.back().bufferView);
      for (const OctahedralNormal& normal : octahedral(normals))
        for (const std::int8_t number : normal) buffer_.add(number);
    } else {
      for (const Vec3& normal : normals) add_in_bytes(normal);
    }
    return buffer_.last_accessor();
  }

  void add_in_bytes(const Vec3& normal) {
    constexpr double most = 127;
    for (const double coordinate : normal)
      buffer_.add(static_cast<std::int8_t>(std::round(coordinate * most)));
    buffer_.add(std::int8_t{0});
  }

  std::span<const Part> parts_;
  const WriteOptions& options_;
  Frame frame_;
  std::optional<Grid> grid_;
  tinygltf::Model model_ = empty_model();
  Buffer buffer_{model_};
  std::set<int> octahedral_;  // views of normals
};

}  // namespace

void write_glb(std::ostream& out, std::span<const Part> parts, const WriteOptions& options) {
  Composer(parts, options).write(out, true);
}

void write_gltf(std::ostream& out, std::span<const Part> parts, const WriteOptions& options) {
  Composer(parts, options).write(out, false);
}

Grid compression_grid(std::span<const Part> parts, const WriteOptions& options) {
  return grid_of(parts, frame_of(parts, options));
}

double quantisation_error(std::span<const Part> parts) {
  const Frame frame = frame_of(parts, {.metres_per_unit = 1});
  const Grid grid = grid_of(parts, frame);
  double most = 0;
  for (const Part& part : parts) {
    for (const auto vertex : part.surface->vertices()) {
      const Vec3 place = frame.relative(place_of(*part.surface, vertex));
      most = std::max(most, length(minus(place, grid.place(grid.cell(place)))));
    }
  }
  return most;
}

}  // namespace loft::io
