// SPDX-License-Identifier: MIT
#include "io/gltf/replay.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstring>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "reconstruct/defect.h"
#include "reconstruct/reconstruction.h"
#include "tests/io/gltf/glb.h"
#include "tests/reconstruct/stacks.h"

namespace loft::io {
namespace {

using stacks::circle;

std::vector<float> numbers(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  const auto& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
  const auto size = static_cast<std::size_t>(
      tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
  std::vector<float> result(accessor.count * size);
  std::memcpy(result.data(), model.buffers[0].data.data() + view.byteOffset + accessor.byteOffset,
              result.size() * sizeof(float));
  return result;
}

tinygltf::Model load(const Replay& replay) {
  std::ostringstream out;
  replay.write(out);
  return testing::load_glb(out.str());
}

/// The scale that the animation gives to each of its nodes at a time.
std::vector<float> scales(const tinygltf::Model& model, float time) {
  const tinygltf::Animation& animation = model.animations.at(0);
  std::vector<float> result(model.nodes.size(), 1);
  for (const tinygltf::AnimationChannel& channel : animation.channels) {
    EXPECT_EQ(channel.target_path, "scale");
    const auto& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
    EXPECT_EQ(sampler.interpolation, "STEP");
    const std::vector<float> times = numbers(model, sampler.input);
    const std::vector<float> values = numbers(model, sampler.output);
    for (std::size_t i = 0; i < times.size() && times[i] <= time; ++i)
      result[static_cast<std::size_t>(channel.target_node)] = values[3 * i];
  }
  return result;
}

std::size_t shown_faces(const tinygltf::Model& model, float time) {
  const std::vector<float> scale = scales(model, time);
  std::size_t count = 0;
  for (std::size_t i = 0; i < scale.size(); ++i) {
    if (scale[i] == 0) continue;
    const auto& mesh = model.meshes[static_cast<std::size_t>(model.nodes[i].mesh)];
    count += model.accessors[static_cast<std::size_t>(mesh.primitives[0].indices)].count / 3;
  }
  return count;
}

/// Normals of what is to be seen, by the positions that they belong to.
std::map<std::vector<float>, std::vector<float>> shown_normals(const tinygltf::Model& model,
                                                               float time) {
  const std::vector<float> scale = scales(model, time);
  std::map<std::vector<float>, std::vector<float>> shapes;
  for (std::size_t i = 0; i < scale.size(); ++i) {
    if (scale[i] == 0) continue;
    const auto& mesh = model.meshes[static_cast<std::size_t>(model.nodes[i].mesh)];
    const auto& attributes = mesh.primitives[0].attributes;
    const bool is_new = shapes
                            .emplace(numbers(model, attributes.at("POSITION")),
                                     numbers(model, attributes.at("NORMAL")))
                            .second;
    EXPECT_TRUE(is_new) << "two nodes show the same slab at " << time;
  }
  return shapes;
}

/// Films all slabs of a stack.
void film(Replay& replay, double time, const SurfaceChange& change, const Reconstruction& stack) {
  const Snapshot now = stack.snapshot();
  for (const std::uint32_t id : change.removed) replay.remove(time, std::to_string(id));
  for (std::size_t i = 0; i < now.slab_count(); ++i)
    replay.add(time, std::to_string(now.slab(i).id), now, i, "heart");
}

TEST(Replay, ShowsTheSurfaceAsItWasAfterEachEdit) {
  Reconstruction live;
  Replay replay(1);
  std::vector<std::size_t> faces;
  const auto edit = [&](const SurfaceChange& change) {
    film(replay, static_cast<double>(faces.size()), change, live);
    faces.push_back(live.face_count());
  };
  for (const double z : {0.0, 4.0, 1.0, 3.0, 2.0}) edit(live.insert({z, {circle(20, 5 + z)}}));
  edit(live.replace(2, {2, {circle(30, 4), circle(9, 2)}}));
  edit(live.remove(4));
  edit(live.remove(1));
  const tinygltf::Model model = load(replay);
  ASSERT_EQ(model.animations.size(), 1U);
  for (std::size_t i = 0; i < faces.size(); ++i)
    EXPECT_EQ(shown_faces(model, static_cast<float>(i) + 0.5F), faces[i]) << "after edit " << i;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {  // for viewers that play nothing
    const bool is_hidden = model.nodes[i].scale == std::vector<double>{0, 0, 0};
    EXPECT_EQ(is_hidden, scales(model, 100)[i] == 0) << model.nodes[i].name;
  }
}

TEST(Replay, ShadesSlabsAnewWhoseNeighboursHaveChanged) {
  Reconstruction live;
  Replay replay(1);
  for (int z = 0; z < 6; ++z) film(replay, z, live.insert({1.0 * z, {circle(20, 5)}}), live);
  film(replay, 6, live.replace(3, {3, {circle(20, 3)}}), live);
  Replay afresh(1);
  film(afresh, 0, {}, live);
  const auto shown = shown_normals(load(replay), 100);
  const auto wanted = shown_normals(load(afresh), 100);
  ASSERT_EQ(wanted.size(), 5U);
  ASSERT_EQ(shown.size(), 5U);
  for (const auto& [positions, normals] : wanted) {
    ASSERT_TRUE(shown.contains(positions));
    const std::vector<float>& there = shown.at(positions);
    ASSERT_EQ(there.size(), normals.size());
    for (std::size_t i = 0; i < normals.size(); ++i) ASSERT_NEAR(there[i], normals[i], 0.002);
  }
}

TEST(Replay, LeavesAloneWhatLooksAsBefore) {
  Reconstruction live;
  Replay replay(1);
  for (int z = 0; z < 4; ++z) live.insert({1.0 * z, {circle(20, 5)}});
  film(replay, 0, {}, live);
  film(replay, 1, {}, live);
  EXPECT_EQ(load(replay).nodes.size(), 3U);
}

TEST(Replay, SaysWhenThereIsNothingToShow) {
  std::ostringstream out;
  EXPECT_THROW(Replay(1).write(out), Error);
}

}  // namespace
}  // namespace loft::io
