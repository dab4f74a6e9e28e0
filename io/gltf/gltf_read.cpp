// SPDX-License-Identifier: MIT
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <type_traits>
#include <utility>

#include "io/bytes/file.h"
#include "io/bytes/little_endian.h"
#include "io/gltf/affine.h"
#include "io/gltf/gltf.h"
#include "io/gltf/gltf_load.h"
#include "io/meshes/label_colour.h"
#include "io/meshes/polygons.h"
#include "io/meshes/seam.h"
#include "mesh/box3.h"
#include "mesh/vec3.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

/// A node's own transform: its matrix (column after column), or translation * rotation * scale.
Affine transform(const tinygltf::Node& node) {
  Affine result;
  if (node.matrix.size() == 16) {
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 4; ++column) {
        result.rows[row][column] = node.matrix[4 * column + row];
      }
    }
    return result;
  }
  if (const auto& q = node.rotation; q.size() == 4) result = rotation(q[0], q[1], q[2], q[3]);
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3 && node.scale.size() == 3; ++column) {
      result.rows[row][column] *= node.scale[column];
    }
    if (node.translation.size() == 3) result.rows[row][3] = node.translation[row];
  }
  return result;
}

/// An element of a list of the model, by an index that the file gives.
template <class Element>
const Element* at(const std::vector<Element>& list, int index) {
  const auto place = static_cast<std::size_t>(index);
  return index >= 0 && place < list.size() ? &list[place] : nullptr;
}

/// The elements of an accessor, proved to lie within their buffer.
struct Elements {
  const char* first = nullptr;
  std::size_t count = 0;
  std::size_t stride = 0;
  int component_type = 0;
  bool is_normalized = false;
};

/// A number of an element; an integer stands for a share of its largest one where that is said
/// (KHR_mesh_quantization).
template <class Number>
double number_at(const char* place, std::size_t i, bool is_normalized) {
  const auto number = static_cast<double>(get<Number>(place + i * sizeof(Number)));
  if constexpr (std::is_integral_v<Number>) {
    constexpr auto most = static_cast<double>(std::numeric_limits<Number>::max());
    if (is_normalized) return std::max(number / most, -1.0);
  }
  return number;
}

bool is_number(int component_type) {
  constexpr std::array types{TINYGLTF_COMPONENT_TYPE_BYTE, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                             TINYGLTF_COMPONENT_TYPE_SHORT, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                             TINYGLTF_COMPONENT_TYPE_FLOAT};
  return std::ranges::find(types, component_type) != types.end();
}

/// Precondition: is_number().
double coordinate(const Elements& elements, const char* place, std::size_t axis) {
  switch (elements.component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return number_at<std::int8_t>(place, axis, elements.is_normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return number_at<std::uint8_t>(place, axis, elements.is_normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return number_at<std::int16_t>(place, axis, elements.is_normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return number_at<std::uint16_t>(place, axis, elements.is_normalized);
    default:
      return number_at<float>(place, axis, false);
  }
}

/// Contours as points in space, of a slice that should be level.
struct FlatSlice {
  Box3 box = no_box;
  std::vector<Contour> contours;

  void add(const Vec3& place, Contour& contour) {
    box = extended(box, place);
    contour.points.push_back({place[0], place[1]});
  }
};

/// By the heights that the file says.
class FlatSlices {
 public:
  FlatSlice& at(double height) { return slices_[height]; }

  /// From low to high; none where one of them is not level, but for rounding. One that is said to
  /// be at another height is where it is.
  [[nodiscard]] std::vector<Slice> slices() const {
    Box3 box = no_box;
    for (const auto& [height, slice] : slices_) box = joined(box, slice.box);
    const double tolerance = 1e-4 * length(minus(box.high, box.low));
    std::vector<Slice> result;
    for (const auto& [height, slice] : slices_) {
      const double z = (slice.box.low[2] + slice.box.high[2]) / 2;
      if (!(slice.box.high[2] - slice.box.low[2] <= tolerance)) return {};
      result.push_back({std::abs(z - height) <= tolerance ? height : z, slice.contours});
    }
    std::ranges::stable_sort(result, {}, &Slice::z);
    return result;
  }

 private:
  std::map<double, FlatSlice> slices_;
};

class Reader {
 public:
  Reader(const tinygltf::Model& model, std::string name) : model_(model), name_(std::move(name)) {}

  std::vector<LabelledMesh> read() {
    visit_all();
    require_valid(polygons_.mesh, name_);
    std::vector<LabelledMesh> meshes = split(std::move(polygons_));
    for (LabelledMesh& part : meshes) part.mesh = sew_seams(part.mesh);
    return meshes;
  }

  std::vector<Slice> read_contours() {
    reads_contours_ = true;
    visit_all();
    return contours_.slices();
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(name_ + ": " + message);
  }

  void visit_all() {
    read_extras();
    for (const tinygltf::Buffer& buffer : model_.buffers) most_elements_ += buffer.data.size();
    for (const int root : roots()) visit(root, Affine(), 0);
  }

  void read_extras() {
    is_ours_ = model_.asset.generator.starts_with("loft ");
    if (!is_ours_ || !model_.asset.extras.Has("metres_per_unit")) return;
    const tinygltf::Value& value = model_.asset.extras.Get("metres_per_unit");
    if (!value.IsNumber()) return;
    const double unit = value.GetNumberAsDouble();
    if (unit > 0 && unit < std::numeric_limits<double>::infinity()) metres_per_unit_ = unit;
  }

  /// The nodes of the scene that is shown; without scenes, those that are nobody's children.
  [[nodiscard]] std::vector<int> roots() const {
    if (const auto* scene = at(model_.scenes, model_.defaultScene)) return scene->nodes;
    if (!model_.scenes.empty()) return model_.scenes.front().nodes;
    std::vector<bool> is_child(model_.nodes.size());
    for (const tinygltf::Node& node : model_.nodes) {
      for (const int child : node.children) {
        if (at(model_.nodes, child) != nullptr) is_child[static_cast<std::size_t>(child)] = true;
      }
    }
    std::vector<int> result;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) result.push_back(static_cast<int>(i));
    }
    return result;
  }

  void visit(int index, const Affine& above, int depth) {
    constexpr int deepest_node = 1000;
    const tinygltf::Node* node = at(model_.nodes, index);
    if (node == nullptr) fail("there is no node " + std::to_string(index));
    // glTF's nodes are trees; without this check a small file could ask for endless work.
    if (depth > deepest_node || ++visits_ > model_.nodes.size()) fail("its nodes are no trees");
    const Affine map = above * transform(*node);
    if (const auto* mesh = at(model_.meshes, node->mesh)) {
      if (!reads_contours_)
        read_mesh(*mesh, map, node->name);
      else if (is_ours_ && node->extras.Has("contours_of"))
        read_lines(*mesh, map, node->extras);
    }
    for (const int child : node->children) visit(child, map, depth + 1);
  }

  void read_mesh(const tinygltf::Mesh& mesh, const Affine& map, const std::string& label) {
    std::uint32_t number = 0;
    if (is_ours_) {
      number = static_cast<std::uint32_t>(polygons_.labels.size());
      polygons_.labels.push_back(label == "surface" ? "" : label);
    }
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      read_primitive(primitive, map, number);
    }
  }

  void read_primitive(const tinygltf::Primitive& primitive, const Affine& map,
                      std::uint32_t label) {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode < TINYGLTF_MODE_TRIANGLES) return;  // points and lines
    const auto found = primitive.attributes.find("POSITION");
    if (found == primitive.attributes.end()) fail("triangles without POSITION");
    const Elements positions = elements(found->second, TINYGLTF_TYPE_VEC3);
    if (!is_number(positions.component_type)) fail("POSITION has numbers of a wrong type");

    count_elements(primitive, positions.count);
    const std::vector<std::uint32_t> corners = read_indices(primitive, positions.count);
    const std::size_t first = polygons_.mesh.points.size();
    if (first + positions.count >= 0xffff'ffff) fail("more than 2^32 vertices");
    for (std::size_t i = 0; i < positions.count; ++i) add_point(positions, i, map);
    const bool is_mirrored = determinant(map) < 0;
    add_triangles(corners, mode, static_cast<std::uint32_t>(first), is_mirrored, label);
    polygons_.fill(colour_of(primitive));
  }

  /// None where there is no material: that is white, and nobody has chosen it.
  [[nodiscard]] std::optional<Colour> colour_of(const tinygltf::Primitive& primitive) const {
    const tinygltf::Material* const material = at(model_.materials, primitive.material);
    if (material == nullptr) return {};
    const std::vector<double>& factor = material->pbrMetallicRoughness.baseColorFactor;
    if (factor.size() < 3 || std::ranges::all_of(factor, [](double share) { return share == 1; }))
      return {};
    return srgb({factor[0], factor[1], factor[2]});
  }

  /// Before memory is taken for them: nodes and primitives may name the same numbers many times.
  void count_elements(const tinygltf::Primitive& primitive, std::size_t vertex_count) {
    elements_ += vertex_count + (primitive.indices < 0
                                     ? vertex_count
                                     : elements(primitive.indices, TINYGLTF_TYPE_SCALAR).count);
    if (elements_ > most_elements_)
      fail("its nodes repeat its meshes to more than " + std::to_string(most_elements_) +
           " vertices and corners");
  }

  /// Those of one label, as contour_extras() tells them apart by slices. A contour ends where a
  /// line leads back to its first point.
  void read_lines(const tinygltf::Mesh& mesh, const Affine& map, const tinygltf::Value& extras) {
    const std::vector<double> heights = numbers(extras.Get("heights"));
    const std::vector<double> counts = numbers(extras.Get("vertices"));
    if (mesh.primitives.empty() || mesh.primitives[0].mode != TINYGLTF_MODE_LINE) return;
    const auto found = mesh.primitives[0].attributes.find("POSITION");
    if (found == mesh.primitives[0].attributes.end()) fail("lines without POSITION");
    const Elements positions = elements(found->second, TINYGLTF_TYPE_VEC3);
    if (!is_number(positions.component_type)) fail("POSITION has numbers of a wrong type");
    count_elements(mesh.primitives[0], positions.count);
    const std::vector<std::uint32_t> ends = read_indices(mesh.primitives[0], positions.count);
    const std::string label =
        extras.Get("label").IsString() ? extras.Get("label").Get<std::string>() : "";
    std::size_t slice = 0;
    double end = counts.empty() ? 0 : counts[0];  // of the slice's vertices
    for (std::size_t i = 0; i + 1 < ends.size();) {
      const std::uint32_t first = ends[i];
      while (slice + 1 < counts.size() && first >= end) end += counts[++slice];
      if (slice >= heights.size()) return;
      FlatSlice& flat = contours_.at(heights[slice]);
      Contour& contour = flat.contours.emplace_back(Contour{{}, label});
      for (bool is_open = true; is_open && i + 1 < ends.size(); i += 2) {
        const Vec3 place = place_of(positions, ends[i], map);
        if (!std::ranges::all_of(place, [](double c) { return std::isfinite(c); }))
          fail("POSITION of lines has what is no number");
        flat.add(place, contour);
        is_open = ends[i + 1] != first;
      }
    }
  }

  [[nodiscard]] static std::vector<double> numbers(const tinygltf::Value& list) {
    std::vector<double> result;
    for (int i = 0; list.IsArray() && i < static_cast<int>(list.ArrayLen()); ++i)
      result.push_back(list.Get(i).IsNumber() ? list.Get(i).GetNumberAsDouble() : 0);
    return result;
  }

  void add_point(const Elements& positions, std::size_t i, const Affine& map) {
    polygons_.mesh.points.push_back(place_of(positions, i, map));
  }

  /// In the axes and the unit of the stack.
  [[nodiscard]] Vec3 place_of(const Elements& positions, std::size_t i, const Affine& map) const {
    const char* place = positions.first + i * positions.stride;
    Vec3 point{};
    for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = coordinate(positions, place, axis);
    const Vec3 placed = map(point);
    return {placed[0] / metres_per_unit_, -placed[2] / metres_per_unit_,
            placed[1] / metres_per_unit_};
  }

  void add_triangles(std::span<const std::uint32_t> corners, int mode, std::uint32_t first,
                     bool is_mirrored, std::uint32_t label) {
    const auto add = [&](std::size_t i, std::size_t j, std::size_t k) {
      if (is_mirrored) std::swap(j, k);
      const std::array triangle{first + corners[i], first + corners[j], first + corners[k]};
      polygons_.add(triangle, label);
    };
    if (mode == TINYGLTF_MODE_TRIANGLES) {
      for (std::size_t i = 2; i < corners.size(); i += 3) add(i - 2, i - 1, i);
    } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      for (std::size_t i = 2; i < corners.size(); ++i) {
        i % 2 == 0 ? add(i - 2, i - 1, i) : add(i - 1, i - 2, i);
      }
    } else {
      for (std::size_t i = 2; i < corners.size(); ++i) add(0, i - 1, i);
    }
  }

  [[nodiscard]] std::vector<std::uint32_t> read_indices(const tinygltf::Primitive& primitive,
                                                        std::size_t vertex_count) const {
    std::vector<std::uint32_t> result;
    if (primitive.indices < 0) {
      for (std::uint32_t i = 0; i < vertex_count; ++i) result.push_back(i);
      return result;
    }
    const Elements indices = elements(primitive.indices, TINYGLTF_TYPE_SCALAR);
    for (std::size_t i = 0; i < indices.count; ++i) {
      const char* place = indices.first + i * indices.stride;
      const std::uint32_t index = read_index(place, indices.component_type);
      if (index >= vertex_count) fail("a triangle names vertex " + std::to_string(index));
      result.push_back(index);
    }
    return result;
  }

  [[nodiscard]] std::uint32_t read_index(const char* place, int component_type) const {
    switch (component_type) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return get<std::uint8_t>(place);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return get<std::uint16_t>(place);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return get<std::uint32_t>(place);
      default:
        fail("vertex numbers of a wrong type");
    }
  }

  [[nodiscard]] Elements elements(int index, int type) const {
    const tinygltf::Accessor* accessor = at(model_.accessors, index);
    if (accessor == nullptr || accessor->type != type)
      fail("an accessor is missing or of a wrong type");
    if (accessor->sparse.isSparse) fail("sparse accessors cannot be read");
    const tinygltf::BufferView* view = at(model_.bufferViews, accessor->bufferView);
    if (view == nullptr) fail("geometry that is missing, or packed by Draco, cannot be read");
    const tinygltf::Buffer* buffer = at(model_.buffers, view->buffer);
    const int component_size =
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor->componentType));
    const int stride = accessor->ByteStride(*view);
    if (buffer == nullptr || component_size <= 0 || stride <= 0) fail("a buffer view is broken");

    Elements result;
    result.count = accessor->count;
    result.stride = static_cast<std::size_t>(stride);
    result.component_type = accessor->componentType;
    result.is_normalized = accessor->normalized;
    const auto size = static_cast<std::size_t>(component_size) *
                      (type == TINYGLTF_TYPE_VEC3 ? std::size_t{3} : std::size_t{1});
    const std::size_t available = available_bytes(*accessor, *view, *buffer);
    if (result.count == 0 || size > available ||
        (result.count - 1) > (available - size) / result.stride) {
      fail("an accessor reaches beyond its buffer");
    }
    result.first = reinterpret_cast<const char*>(buffer->data.data()) + view->byteOffset +
                   accessor->byteOffset;
    return result;
  }

  /// From the accessor's first byte to the end of its view or buffer; 0 where it begins beyond.
  static std::size_t available_bytes(const tinygltf::Accessor& accessor,
                                     const tinygltf::BufferView& view,
                                     const tinygltf::Buffer& buffer) {
    if (view.byteOffset > buffer.data.size()) return 0;
    const std::size_t in_buffer = buffer.data.size() - view.byteOffset;
    const std::size_t in_view = std::min(view.byteLength, in_buffer);
    return accessor.byteOffset > in_view ? 0 : in_view - accessor.byteOffset;
  }

  const tinygltf::Model& model_;
  std::string name_;
  Polygons polygons_;
  FlatSlices contours_;
  bool reads_contours_ = false;
  bool is_ours_ = false;
  double metres_per_unit_ = 1;
  std::size_t visits_ = 0;
  std::size_t elements_ = 0;  // vertices and corners so far
  /// Each number takes a byte at least; repeated ones may be some more.
  std::size_t most_elements_ = std::size_t{1} << 24U;
};

}  // namespace

std::vector<LabelledMesh> read_gltf(std::string_view content, const std::filesystem::path& folder,
                                    std::string_view name) {
  const tinygltf::Model model = load_gltf(content, folder, name);
  return Reader(model, std::string(name)).read();
}

std::vector<LabelledMesh> read_gltf(const std::filesystem::path& path) {
  return read_gltf(read_file(path), path.parent_path(), path.string());
}

std::vector<Slice> read_gltf_contours(const std::filesystem::path& path) {
  const tinygltf::Model model = load_gltf(read_file(path), path.parent_path(), path.string());
  return Reader(model, path.string()).read_contours();
}

}  // namespace loft::io
