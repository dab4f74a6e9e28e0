// SPDX-License-Identifier: MIT
#include "io/gltf/slab_glb.h"

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

#include "io/bytes/utf8.h"
#include "io/gltf/gltf_model.h"

namespace loft::io {

namespace {

using Extras = tinygltf::Value::Object;

tinygltf::Value count_value(std::size_t count) {
  return tinygltf::Value(static_cast<double>(count));
}

Extras extras(const SlabInfo& info) {
  return {{"low", tinygltf::Value(info.low)}, {"high", tinygltf::Value(info.high)}};
}

Extras extras(const SlabInfo& info, const SlabView& view) {
  Extras said = extras(info);
  said["label"] = tinygltf::Value(json_text(view.label));
  return said;
}

/// What is said of a slab of a capture.
void add_history(Extras& said, double confidence, std::uint64_t edit) {
  said["confidence"] = tinygltf::Value(confidence);
  said["edit"] = tinygltf::Value(static_cast<double>(edit));
}

/// One node.
std::string glb(ShadedMesh shaded, Extras extras, const SlabView& view) {
  tinygltf::Model model = empty_model();
  const Frame frame{view.origin, view.metres_per_unit};
  Buffer buffer(model);
  const std::string name = view.label.empty() ? "surface" : json_text(view.label);
  tinygltf::Node node;
  node.name = name;
  const Vec3 translation = frame.translation();
  node.translation.assign(translation.begin(), translation.end());
  node.extras = tinygltf::Value(std::move(extras));
  if (!shaded.faces.empty()) {  // nothing is between two empty slices
    tinygltf::Mesh mesh;
    mesh.name = name;
    mesh.primitives.push_back(primitive(std::move(shaded), frame, buffer, model));
    mesh.primitives.back().material = 0;
    model.meshes.push_back(std::move(mesh));
    model.materials.push_back(material(name, view.is_double_sided, view.colour));
    node.mesh = 0;
  } else {
    model.buffers.clear();
  }
  model.nodes.push_back(std::move(node));
  model.scenes[0].nodes.push_back(0);
  std::ostringstream out;
  write_model(out, model, true);
  return std::move(out).str();
}

/// One node for slabs of which `all` says something.
std::string bundle(ShadedSlabs slabs, std::vector<Extras> all, const SlabView& view) {
  tinygltf::Value::Array said;
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i]["vertices"] = count_value(slabs.vertices[i]);
    all[i]["indices"] = count_value(3 * slabs.faces[i]);
    said.emplace_back(std::move(all[i]));
  }
  return glb(std::move(slabs.mesh),
             {{"label", tinygltf::Value(json_text(view.label))},
              {"slabs", tinygltf::Value(std::move(said))}},
             view);
}

}  // namespace

std::string slab_glb(const Snapshot& snapshot, std::size_t i, const SlabView& view) {
  const std::size_t first = i - std::min<std::size_t>(i, 1);
  const Patch patch = snapshot.patch(first, std::min(i + 2, snapshot.slab_count()));
  Extras said = extras(snapshot.slab(i), view);
  add_history(said, snapshot.report(i).confidence, view.edit);
  return glb(shade(patch, static_cast<std::uint32_t>(i)), std::move(said), view);
}

std::string bundle_glb(const Snapshot& snapshot, std::span<const BundledSlab> slabs,
                       const SlabView& view) {
  const std::size_t begin = slabs.front().index;
  const std::size_t end = slabs.back().index + 1;
  const Patch patch = snapshot.patch(begin - std::min<std::size_t>(begin, 1),
                                     std::min(end + 1, snapshot.slab_count()));
  std::vector<Extras> all;
  for (const auto& [i, id, edit] : slabs) {
    Extras& said = all.emplace_back(extras(snapshot.slab(i)));
    said["id"] = tinygltf::Value(id);
    add_history(said, snapshot.report(i).confidence, edit);
  }
  return bundle(
      shade_apart(patch, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)),
      std::move(all), view);
}

std::string bundle_glb(const Patch& patch, std::span<const SlabInfo> slabs,
                       std::span<const std::string> ids, const SlabView& view) {
  std::vector<Extras> all;
  for (std::size_t i = 0; i < slabs.size(); ++i) {
    Extras& said = all.emplace_back(extras(slabs[i]));
    said["id"] = tinygltf::Value(ids[i]);
  }
  return bundle(shade_apart(patch, slabs.front().id, slabs.back().id + 1), std::move(all), view);
}

std::string slab_glb(const Patch& patch, const SlabInfo& info, const SlabView& view) {
  return glb(shade(patch, info.id), extras(info, view), view);
}

}  // namespace loft::io
