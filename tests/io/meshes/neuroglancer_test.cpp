// SPDX-License-Identifier: MIT
#include "io/meshes/neuroglancer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>

#include "io/precomputed.h"
#include "mesh/check.h"
#include "reconstruct/defect.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using namespace testing;

std::uint64_t id_of(const std::vector<Segment>& segments, const std::string& label) {
  return std::ranges::find(segments, label, &Segment::label)->id;
}

TEST(Segments, TakeTheNumberOfTheSourceThenThatInTheNameThenAnyThatIsFree) {
  const std::vector<StackLabel> known{{"liver", {}, "7"}, {"dendrite 7", {}, ""}, {"odd", {}, "x"}};
  const auto segments =
      segments_of({"liver", "dendrite 7", "odd", "axon 12", "t2 of 5", "00", ""}, known);
  EXPECT_EQ(id_of(segments, "liver"), 7U);
  EXPECT_EQ(id_of(segments, "axon 12"), 12U);
  EXPECT_EQ(id_of(segments, ""), 1U);
  EXPECT_EQ(id_of(segments, "00"), 2U);
  EXPECT_EQ(id_of(segments, "dendrite 7"), 3U);
  EXPECT_EQ(id_of(segments, "odd"), 4U);
  EXPECT_EQ(id_of(segments, "t2 of 5"), 5U);
}

TEST(Segments, HaveDifferentNumbersThatDependOnTheSetOfLabelsOnly) {
  std::mt19937 random(3);
  for (int round = 0; round < 100; ++round) {
    std::vector<std::string> labels;
    std::vector<StackLabel> known;
    for (std::size_t i = random() % 30; i > 0; --i) {
      labels.push_back((random() % 2 == 0 ? "a" : "b ") + std::to_string(random() % 20));
      if (random() % 2 == 0) known.push_back({labels.back(), {}, std::to_string(random() % 9)});
    }
    const auto segments = segments_of(labels, known);
    std::ranges::shuffle(labels, random);
    EXPECT_EQ(segments_of(labels, known), segments);
    std::vector<std::uint64_t> ids;
    for (const Segment& segment : segments) ids.push_back(segment.id);
    std::ranges::sort(ids);
    EXPECT_EQ(std::ranges::adjacent_find(ids), ids.end());
    EXPECT_TRUE(ids.empty() || ids[0] > 0);
  }
}

/// Decodes a fragment as the format's description has it, without the reader that is tested.
Mesh decoded(const std::string& bytes) {
  const auto word = [&bytes](std::size_t place) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
      value = value << 8U | static_cast<unsigned char>(bytes.at(4 * place + i));
    return value;
  };
  Mesh mesh;
  const std::size_t count = word(0);
  std::size_t at = 1;
  for (std::size_t v = 0; v < count; ++v, at += 3) {
    const auto number = [&](std::size_t i) {
      return static_cast<double>(std::bit_cast<float>(word(at + i)));
    };
    mesh.points.push_back({number(0), number(1), number(2)});
  }
  for (; 4 * at < bytes.size(); at += 3)
    mesh.faces.push_back({word(at), word(at + 1), word(at + 2)});
  return mesh;
}

TEST(Fragment, IsWhatTheFormatSaysInNanometres) {
  const Surface surface = prism(5, {1, 2, 3});
  std::ostringstream out;
  write_fragment(out, {"", &surface}, 1e-6);
  const std::string bytes = out.str();
  ASSERT_EQ(bytes.size(), 4 + 12 * (surface.n_vertices() + surface.n_faces()));
  const Mesh mesh = decoded(bytes);
  const Mesh exact = to_mesh(surface);
  EXPECT_EQ(mesh.faces, exact.faces);
  ASSERT_EQ(mesh.points.size(), exact.points.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(mesh.points[v][i], 1000 * exact.points[v][i], 1e-3);
  EXPECT_EQ(read_fragment(bytes, "f"), mesh);
}

TEST(Fragment, BytesThatAreNoneAreRefused) {
  const Surface surface = prism(4);
  std::ostringstream out;
  write_fragment(out, {"", &surface}, 1e-6);
  const std::string bytes = out.str();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    try {
      EXPECT_FALSE(read_fragment(bytes.substr(0, size), "f").faces.empty());
    } catch (const InputError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("f: ")) << error.what();
    }
  }
  std::mt19937 random(1);
  for (int round = 0; round < 1000; ++round) {
    std::string broken = bytes;
    broken[random() % broken.size()] = static_cast<char>(random());
    try {
      const Mesh mesh = read_fragment(broken, "f");
      for (const auto& face : mesh.faces)
        for (const std::uint32_t corner : face) EXPECT_LT(corner, mesh.points.size());
    } catch (const InputError&) {
    }
  }
}

TEST(Fragment, BeyondAllFloatsIsRefused) {
  const Surface surface = prism(4);
  std::ostringstream out;
  EXPECT_THROW(write_fragment(out, {"", &surface}, 1e30), Error);
}

TEST(Precomputed, FolderComesBackWithItsNames) {
  const Folder folder;
  const Surface a = prism(5);
  const Surface b = prism(7, {4, 0, 0});
  const Precomputed meshes(folder / "new/meshes", segments_of({"a", "b 9", "none"}, {}));
  EXPECT_FALSE(std::filesystem::exists(folder / "new"));
  meshes.begin();
  EXPECT_FALSE(meshes.has("a"));
  EXPECT_EQ(meshes.write({"a", &a}, 0.001).rounding.left, 0U);
  static_cast<void>(meshes.write({"b 9", &b}, 0.001));
  EXPECT_TRUE(meshes.has("a"));
  EXPECT_FALSE(meshes.has("none"));
  const auto read = read_precomputed(folder / "new/meshes");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].label, "a");
  EXPECT_EQ(read[1].label, "b 9");
  EXPECT_TRUE(check(read[1].mesh).empty());
  const auto info = nlohmann::json::parse(content(folder / "new/meshes/info"));
  EXPECT_EQ(info["@type"], "neuroglancer_legacy_mesh");
  const std::string names = info["segment_properties"].get<std::string>() + "/info";
  const auto properties = nlohmann::json::parse(content(folder / "new/meshes" / names));
  EXPECT_EQ(properties["@type"], "neuroglancer_segment_properties");
  EXPECT_EQ(properties["inline"]["ids"], nlohmann::json::array({"1", "9", "2"}));
  EXPECT_EQ(properties["inline"]["properties"][0]["values"],
            nlohmann::json::array({"a", "b 9", "none"}));
}

TEST(Precomputed, WhatIsNoFolderOfMeshesIsRefusedByName) {
  const Folder folder;
  EXPECT_THROW(static_cast<void>(read_precomputed(folder / "none")), Error);
  EXPECT_THROW(static_cast<void>(read_precomputed(folder / "")), InputError);
  for (const char* manifest : {"", "{", "[]", R"({"fragments":[1]})", R"({"fragments":["../x"]})",
                               R"({"fragments":["x"]})", R"({"fragments":"x"})"}) {
    static_cast<void>(folder.write("5:0", manifest));
    EXPECT_THROW(static_cast<void>(read_precomputed(folder / "")), Error) << manifest;
  }
}

/// Many thin walls far from 0, where neighbouring floats are far apart.
TEST(Precomputed, MeshesAreSolidsStillWhenTheyAreRounded) {
  const Folder folder;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> far(1, 5);
  const Precomputed meshes(folder / "meshes", segments_of({"a"}, {}));
  meshes.begin();
  for (int round = 0; round < 20; ++round) {
    const Surface surface = prism(100, {far(random), far(random), far(random)}, 1e-3);
    EXPECT_EQ(meshes.write({"a", &surface}, 0.001).rounding.left, 0U);
    EXPECT_TRUE(check(read_precomputed(folder / "meshes")[0].mesh).empty());
  }
}

}  // namespace
}  // namespace loft::io
