// SPDX-License-Identifier: MIT
#include "io/gltf/packed.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "io/gltf/glb_chunks.h"
#include "io/gltf/gltf_model.h"
#include "io/gltf/meshopt.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

constexpr const char* packing_name = "EXT_meshopt_compression";
/// In the order of their enumerators.
constexpr std::array<std::string_view, 3> mode_names{"ATTRIBUTES", "TRIANGLES", "INDICES"};
constexpr std::array<std::string_view, 4> filter_names{"NONE", "OCTAHEDRAL", "QUATERNION",
                                                       "EXPONENTIAL"};

// --- Writing ---

/// Accessors of the corners of triangles: their order may be turned, unlike that of lines.
std::set<int> corner_accessors(const tinygltf::Model& model) {
  std::set<int> result;
  for (const tinygltf::Mesh& mesh : model.meshes)
    for (const tinygltf::Primitive& primitive : mesh.primitives)
      if (primitive.mode == TINYGLTF_MODE_TRIANGLES) result.insert(primitive.indices);
  return result;
}

/// For each view the accessor that reads it: they are made in pairs.
Packing packing_of(const tinygltf::Model& model, std::size_t view) {
  const tinygltf::Accessor& accessor = model.accessors[view];
  Packing packing;
  packing.count = accessor.count;
  packing.stride = model.bufferViews[view].byteStride;
  if (model.bufferViews[view].target == TINYGLTF_TARGET_ARRAY_BUFFER) return packing;
  packing.mode = PackedMode::indices;
  packing.stride = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 2 : 4;
  return packing;
}

class Packer {
 public:
  Packer(tinygltf::Model model, const std::set<int>& octahedral)
      : model_(std::move(model)), raw_(std::move(model_.buffers[0].data)) {
    const std::set<int> corners = corner_accessors(model_);
    for (int i = 0; i < static_cast<int>(model_.bufferViews.size()); ++i) {
      Packing packing = packing_of(model_, static_cast<std::size_t>(i));
      if (corners.contains(i)) packing.mode = PackedMode::triangles;
      if (octahedral.contains(i)) packing.filter = PackedFilter::octahedral;
      add(model_.bufferViews[static_cast<std::size_t>(i)], packing);
    }
    views_ += ']';
    model_.bufferViews.clear();
    model_.buffers[0].data.assign(packed_.begin(), packed_.end());
    for (auto* names : {&model_.extensionsUsed, &model_.extensionsRequired})
      names->emplace_back(packing_name);
  }

  void write(std::ostream& out, bool binary) const {
    std::ostringstream file;
    write_model(file, model_, binary, false);
    std::string text = std::move(file).str();
    if (!binary) {
      text = patched(text);
    } else {
      text = with_json(text, patched(*json_chunk(text)));
    }
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
  }

 private:
  void add(const tinygltf::BufferView& view, const Packing& packing) {
    const std::string_view bytes(reinterpret_cast<const char*>(raw_.data()) + view.byteOffset,
                                 view.byteLength);
    packed_.resize((packed_.size() + 3) / 4 * 4);
    const std::size_t begin = packed_.size();
    packed_ += pack(packing, bytes);
    views_ += views_.size() == 1 ? "{" : ",{";
    add_place(1, view.byteOffset, view.byteLength, view.byteStride);
    views_ += R"(,"target":)" + std::to_string(view.target) + R"(,"extensions":{")" + packing_name +
              "\":{";
    add_place(0, begin, packed_.size() - begin, packing.stride);
    views_ += R"(,"count":)" + std::to_string(packing.count);
    add_name("mode", mode_names[static_cast<std::size_t>(packing.mode)]);
    if (packing.filter != PackedFilter::none)
      add_name("filter", filter_names[static_cast<std::size_t>(packing.filter)]);
    views_ += "}}}";
  }

  void add_place(int buffer, std::size_t offset, std::size_t size, std::size_t stride) {
    views_ += R"("buffer":)" + std::to_string(buffer);
    if (offset > 0) views_ += R"(,"byteOffset":)" + std::to_string(offset);
    views_ += R"(,"byteLength":)" + std::to_string(size);
    if (stride > 0) views_ += R"(,"byteStride":)" + std::to_string(stride);
  }

  void add_name(std::string_view key, std::string_view name) {
    (((views_ += ",\"") += key) += "\":\"") += name;
    views_ += '"';
  }

  /// tinygltf writes neither extensions of views nor buffers without bytes.
  [[nodiscard]] std::string patched(std::string_view json) const {
    const std::size_t end = json.find("}]", json.find(R"("buffers":[{)")) + 1;
    return "{\"bufferViews\":" + views_ + ',' + std::string(json.substr(1, end - 1)) +
           R"(,{"byteLength":)" + std::to_string(raw_.size()) + R"(,"extensions":{")" +
           packing_name + R"(":{"fallback":true}}})" + std::string(json.substr(end));
  }

  tinygltf::Model model_;
  std::vector<unsigned char> raw_;
  std::string packed_;
  std::string views_ = "[";
};

// --- Reading ---

class Unpacker {
 public:
  Unpacker(tinygltf::Model& model, std::string_view name) : model_(model), name_(name) {}

  void run() {
    for (std::size_t i = 0; i < model_.bufferViews.size(); ++i) {
      const auto found = model_.bufferViews[i].extensions.find(packing_name);
      if (found == model_.bufferViews[i].extensions.end()) continue;
      place_ = "buffer view " + std::to_string(i) + ": ";
      unpack_view(i, found->second);
    }
  }

 private:
  [[noreturn]] void fail(std::string_view message) const {
    throw InputError(std::string(name_) + ": " + place_ + std::string(message));
  }

  void unpack_view(std::size_t i, const tinygltf::Value& said) {
    if (!has_meshopt()) fail("packed by meshopt: " + std::string(no_meshopt));
    const std::string_view packed = bytes_of(said);
    Packing packing;
    packing.mode = PackedMode{name_of(said, "mode", mode_names, mode_names.size())};
    packing.filter = PackedFilter{name_of(said, "filter", filter_names, 0)};
    packing.count = number(said, "count");
    packing.stride = number(said, "byteStride");
    if (!is_fit(packing, packed.size())) fail("its packing cannot be");
    std::vector<unsigned char> bytes = unpack(packing, packed);
    if (bytes.empty()) fail("it is not packed by meshopt, or broken");
    tinygltf::BufferView& view = model_.bufferViews[i];
    view.buffer = static_cast<int>(model_.buffers.size());
    view.byteOffset = 0;
    view.byteLength = bytes.size();
    model_.buffers.emplace_back().data = std::move(bytes);
  }

  /// A whole number; 0 where there is none.
  [[nodiscard]] static std::size_t number(const tinygltf::Value& said, const char* key) {
    if (!said.IsObject() || !said.Has(key) || !said.Get(key).IsNumber()) return 0;
    const double value = said.Get(key).GetNumberAsDouble();
    constexpr double most = 0xffff'ffff;
    return value >= 0 && value <= most ? static_cast<std::size_t>(value) : 0;
  }

  template <std::size_t size>
  [[nodiscard]] int name_of(const tinygltf::Value& said, const char* key,
                            const std::array<std::string_view, size>& names,
                            std::size_t otherwise) const {
    std::size_t place = otherwise;
    if (said.IsObject() && said.Has(key) && said.Get(key).IsString())
      place = static_cast<std::size_t>(std::ranges::find(names, said.Get(key).Get<std::string>()) -
                                       names.begin());
    if (place == size) fail(std::string("there is no such \"") + key + '"');
    return static_cast<int>(place);
  }

  [[nodiscard]] std::string_view bytes_of(const tinygltf::Value& said) const {
    const std::size_t buffer = number(said, "buffer");
    if (buffer >= model_.buffers.size()) fail("there is no buffer " + std::to_string(buffer));
    const std::vector<unsigned char>& bytes = model_.buffers[buffer].data;
    const std::size_t offset = number(said, "byteOffset");
    const std::size_t size = number(said, "byteLength");
    if (offset > bytes.size() || size > bytes.size() - offset) fail("it reaches beyond its buffer");
    return {reinterpret_cast<const char*>(bytes.data()) + offset, size};
  }

  tinygltf::Model& model_;
  std::string_view name_;
  std::string place_;
};

}  // namespace

void write_packed(std::ostream& out, tinygltf::Model model, const std::set<int>& octahedral,
                  bool binary) {
  Packer(std::move(model), octahedral).write(out, binary);
}

void unpack_views(tinygltf::Model& model, std::string_view name) { Unpacker(model, name).run(); }

}  // namespace loft::io
