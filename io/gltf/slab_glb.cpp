// SPDX-License-Identifier: MIT
#include "io/gltf/slab_glb.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "io/bytes/utf8.h"
#include "io/gltf/gltf_model.h"

namespace loft::io {

namespace {

using Extras = tinygltf::Value::Object;

Extras extras(const SlabInfo& info, const SlabView& view) {
  return {{"label", tinygltf::Value(json_text(view.label))},
          {"low", tinygltf::Value(info.low)},
          {"high", tinygltf::Value(info.high)}};
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
    model.materials.push_back(material(name, view.is_double_sided));
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

}  // namespace

std::string slab_glb(const Snapshot& snapshot, std::size_t i, const SlabView& view) {
  const std::size_t first = i - std::min<std::size_t>(i, 1);
  const Patch patch = snapshot.patch(first, std::min(i + 2, snapshot.slab_count()));
  Extras said = extras(snapshot.slab(i), view);
  said["confidence"] = tinygltf::Value(snapshot.report(i).confidence);
  said["edit"] = tinygltf::Value(static_cast<double>(view.edit));
  return glb(shade(patch, static_cast<std::uint32_t>(i)), std::move(said), view);
}

std::string slab_glb(const Patch& patch, const SlabInfo& info, const SlabView& view) {
  return glb(shade(patch, info.id), extras(info, view), view);
}

}  // namespace loft::io
