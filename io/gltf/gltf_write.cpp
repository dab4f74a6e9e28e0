// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "io/bytes/utf8.h"
#include "io/gltf/gltf.h"
#include "io/gltf/gltf_model.h"
#include "io/gltf/shading.h"
#include "io/meshes/extent.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

bool is_open(const Surface& surface) {
  return std::ranges::any_of(surface.halfedges(),
                             [&](const auto halfedge) { return surface.is_boundary(halfedge); });
}

std::string name_of(const Part& part) {
  return part.label.empty() ? "surface" : json_text(part.label);
}

void add_part(const Part& part, const Frame& frame, Buffer& buffer, tinygltf::Model& model) {
  const auto number = model.nodes.size();
  tinygltf::Mesh mesh;
  mesh.name = name_of(part);
  mesh.primitives.push_back(primitive(shade(*part.surface), frame, buffer, model));
  mesh.primitives.back().material = static_cast<int>(number);
  model.meshes.push_back(std::move(mesh));
  model.materials.push_back(material(name_of(part), is_open(*part.surface), part.colour));

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
  tinygltf::Model model = empty_model();
  model.asset.extras = extras(options);
  const Frame frame{options.origin ? *options.origin : centre_of(extent(parts)),
                    options.metres_per_unit};
  Buffer buffer(model);
  for (const Part& part : parts) {
    if (part.surface->n_faces() > 0) add_part(part, frame, buffer, model);
  }
  if (model.nodes.empty()) throw Error("glTF cannot hold a surface without faces");
  return model;
}

}  // namespace

void write_glb(std::ostream& out, std::span<const Part> parts, const WriteOptions& options) {
  write_model(out, to_model(parts, options), true);
}

void write_gltf(std::ostream& out, std::span<const Part> parts, const WriteOptions& options) {
  write_model(out, to_model(parts, options), false);
}

}  // namespace loft::io
