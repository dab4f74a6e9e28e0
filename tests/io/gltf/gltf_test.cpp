// SPDX-License-Identifier: MIT
#include "io/gltf/gltf.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <tiny_gltf.h>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "io/gltf/shading.h"
#include "io/gltf/slab_glb.h"
#include "io/meshes.h"
#include "io/meshes/label_colour.h"
#include "io/meshes/seam.h"
#include "io/surfaces.h"
#include "reconstruct/defect.h"
#include "reconstruct/reconstruction.h"
#include "tests/io/gltf/glb.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using testing::Folder;
using testing::prism;

tinygltf::Model load(const std::vector<Part>& parts, const WriteOptions& options = {}) {
  std::ostringstream out;
  write_glb(out, parts, options);
  return testing::load_glb(out.str());
}

std::vector<Vec3> vectors(const tinygltf::Model& model, std::size_t mesh, const char* attribute) {
  const int index = model.meshes[mesh].primitives[0].attributes.at(attribute);
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  const auto& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
  const unsigned char* place = model.buffers[0].data.data() + view.byteOffset;
  std::vector<Vec3> result(accessor.count);
  for (Vec3& vector : result) {
    for (double& coordinate : vector) {
      float number = 0;
      std::memcpy(&number, place, sizeof number);
      coordinate = static_cast<double>(number);
      place += sizeof number;
    }
  }
  return result;
}

TEST(Gltf, TurnsTheStackUprightAndIntoMetres) {
  const Surface surface = prism(4, {0, 0, 0}, 500);  // 1000 x 1000 x 500 mm
  const tinygltf::Model model = load({{"", &surface}});
  const auto& accessor = model.accessors[0];
  const std::vector<double>& translation = model.nodes[0].translation;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double height = axis == 1 ? 0.5 : 1.0;
    EXPECT_NEAR(accessor.maxValues[axis] - accessor.minValues[axis], height, 1e-6) << axis;
  }
  EXPECT_NEAR(translation[0], 0.5, 1e-12);
  EXPECT_NEAR(translation[1], 0.25, 1e-12);
  EXPECT_NEAR(translation[2], -0.5, 1e-12);
}

TEST(Gltf, CoordinatesFarFromZeroSurvive) {
  const Folder folder;
  const Surface surface = prism(64, {500'000.25, 5'000'000.5, 120}, 0.01);
  const Part part{"", &surface};
  WriteOptions options;
  options.metres_per_unit = 1;
  write(folder / "a.glb", {&part, 1}, options);
  const Mesh read = read_mesh(folder / "a.glb");
  ASSERT_EQ(read.points.size(), 128U);
  for (const Vec3& point : to_mesh(surface).points) {
    double nearest = 1;
    for (const Vec3& other : read.points) {
      nearest = std::min(nearest,
                         std::hypot(point[0] - other[0], point[1] - other[1], point[2] - other[2]));
    }
    EXPECT_LT(nearest, 4e-9);  // float of 0.01 m, and double of 5,000,000 m
  }
}

TEST(Gltf, NormalsAreUnitAndSharpAtCaps) {
  const Surface surface = prism(8);
  const tinygltf::Model model = load({{"", &surface}});
  const std::vector<Vec3> normals = vectors(model, 0, "NORMAL");
  EXPECT_EQ(normals.size(), 32U);  // 16 vertices, each at a cap
  std::size_t upright = 0;
  for (const Vec3& normal : normals) {
    EXPECT_NEAR(std::hypot(normal[0], normal[1], normal[2]), 1, 1e-6);
    const double height = std::abs(normal[1]);
    EXPECT_NEAR(height, std::round(height), 1e-6) << "neither level nor upright";
    if (height > 0.5) ++upright;
  }
  EXPECT_EQ(upright, 16U);
}

TEST(Gltf, NormalsThatCancelFallBackToOneFace) {
  Surface surface;  // a leaf: two triangles back to back
  const auto a = surface.add_vertex({0, 0, 0});
  const auto b = surface.add_vertex({1, 0, 0});
  const auto c = surface.add_vertex({0, 1, 0});
  surface.add_face(a, b, c);
  surface.add_face(c, b, a);
  for (const Vec3& normal : shade(surface).normals) {
    EXPECT_DOUBLE_EQ(std::hypot(normal[0], normal[1], normal[2]), 1);
  }
}

TEST(Gltf, FacesWithoutAreaStillHaveNormals) {
  for (const double size : {0.0, 1e-200, 1e-320, 1e300}) {
    Surface surface;
    const auto a = surface.add_vertex({0, 0, 0});
    const auto b = surface.add_vertex({size, 0, 0});
    const auto c = surface.add_vertex({size * 2, 0, 0});
    surface.add_face(a, b, c);
    for (const Vec3& normal : shade(surface).normals) {
      EXPECT_DOUBLE_EQ(std::hypot(normal[0], normal[1], normal[2]), 1) << size;
    }
  }
}

TEST(Gltf, IndicesAreAsShortAsTheyCanBe) {
  for (const std::uint32_t sides : {32767U, 32768U}) {
    const Surface surface = prism(sides, {}, 1, false);
    const tinygltf::Model model = load({{"", &surface}});
    const auto& primitive = model.meshes[0].primitives[0];
    EXPECT_EQ(model.accessors[static_cast<std::size_t>(primitive.indices)].componentType,
              sides == 32767 ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT
                             : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
  }
}

TEST(Gltf, NamesColoursAndNotes) {
  const Surface closed = prism(3);
  const Surface open = prism(3, {}, 1, false);
  WriteOptions options;
  options.metres_per_unit = 0.5;
  options.sources = {"stack.ndjson"};
  options.settings = {{"fill", "evenodd"}};
  const tinygltf::Model model = load({{"heart", &closed}, {"", &open}}, options);
  EXPECT_EQ(model.nodes[0].name, "heart");
  EXPECT_EQ(model.nodes[1].name, "surface");
  EXPECT_FALSE(model.materials[0].doubleSided);
  EXPECT_TRUE(model.materials[1].doubleSided);
  EXPECT_NE(model.materials[0].pbrMetallicRoughness.baseColorFactor,
            model.materials[1].pbrMetallicRoughness.baseColorFactor);
  EXPECT_EQ(model.materials[0].pbrMetallicRoughness.metallicFactor, 0);
  EXPECT_TRUE(model.asset.generator.starts_with("loft "));
  const tinygltf::Value& extras = model.asset.extras;
  EXPECT_EQ(extras.Get("metres_per_unit").GetNumberAsDouble(), 0.5);
  EXPECT_EQ(extras.Get("sources").Get(0).Get<std::string>(), "stack.ndjson");
  EXPECT_EQ(extras.Get("settings").Get("fill").Get<std::string>(), "evenodd");
}

TEST(Gltf, ALabelKeepsItsColourWhateverOthersThereAre) {
  const Surface surface = prism(3);
  const auto colour = [](const tinygltf::Model& model, std::size_t i) {
    return model.materials[i].pbrMetallicRoughness.baseColorFactor;
  };
  const auto alone = load({{"lung", &surface}});
  const auto among = load({{"heart", &surface}, {"", &surface}, {"lung", &surface}});
  EXPECT_EQ(colour(alone, 0), colour(among, 2));
  const auto unlabelled = load({{"", &surface}});
  EXPECT_EQ(colour(unlabelled, 0), colour(among, 1));

  Reconstruction live;
  live.insert({0, {{{{0, 0}, {1, 0}, {0, 1}}, ""}}});
  live.insert({1, {{{{0, 0}, {1, 0}, {0, 1}}, ""}}});
  const auto slab = testing::load_glb(slab_glb(live.snapshot(), 0, {.label = "lung"}));
  EXPECT_EQ(colour(slab, 0), colour(alone, 0));
}

TEST(Gltf, FormatsThatCannotHoldANameDoNotChangeItsColour) {
  EXPECT_EQ(label_colour("a\tb"), label_colour("a_b"));
  EXPECT_EQ(label_colour("a\xe9"), label_colour("a?"));
  EXPECT_EQ(label_colour(""), label_colour("surface"));
}

TEST(Gltf, ColoursOfLabelsAreToldApart) {
  std::set<std::array<double, 3>> colours;
  std::array<int, 6> hues{};
  for (int i = 0; i < 600; ++i) {
    const auto [red, green, blue] = label_colour("label_" + std::to_string(i));
    EXPECT_TRUE(colours.insert({red, green, blue}).second) << i;
    for (const double channel : {red, green, blue}) {
      EXPECT_GT(channel, 0);
      EXPECT_LT(channel, 1);
    }
    const bool is_red = red >= green && red >= blue;
    const bool is_green = !is_red && green >= blue;
    const bool rises = is_red ? green > blue : is_green ? blue > red : red > green;
    ++hues[(is_red ? 0U : is_green ? 2U : 4U) + (rises ? 1U : 0U)];
  }
  for (const int count : hues) EXPECT_GT(count, 60);  // 100 if they were spread evenly
}

TEST(Gltf, NamesThatAreNotUtf8AreReplaced) {
  const Surface surface = prism(3);
  WriteOptions options;
  options.sources = {"\xff.ndjson"};
  const tinygltf::Model model = load({{"a\xe9", &surface}}, options);
  EXPECT_EQ(model.nodes[0].name, "a?");
  EXPECT_EQ(model.asset.extras.Get("sources").Get(0).Get<std::string>(), "?.ndjson");
}

TEST(Gltf, WhatFloatCannotHoldIsRefused) {
  const Surface surface = prism(3, {}, 1e300);
  std::ostringstream out;
  const Part part{"", &surface};
  EXPECT_THROW(write_glb(out, {&part, 1}), Error);
}

TEST(Gltf, NodeTransformsApply) {
  const Folder folder;
  // One triangle (0,0,0) (1,0,0) (0,1,0), below a node that turns and one that moves and mirrors.
  const auto path = folder.write("a.gltf", R"({"asset":{"version":"2.0"},"scene":0,
    "scenes":[{"nodes":[0]}],
    "nodes":[{"translation":[10,0,0],"scale":[-1,1,1],"children":[1]},
             {"matrix":[0,1,0,0, -1,0,0,0, 0,0,1,0, 5,0,0,1],"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
                  "min":[0,0,0],"max":[1,1,0]}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
                                           "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}");
  const Mesh expected{{{5, 0, 0}, {5, 0, 1}, {6, 0, 0}}, {{0, 2, 1}}};
  EXPECT_EQ(read_mesh(path), expected);
}

/// Triangles that share no vertex, as in STL.
Mesh soup(const Mesh& mesh) {
  Mesh result;
  for (const auto& face : mesh.faces) {
    const auto first = static_cast<std::uint32_t>(result.points.size());
    for (const std::uint32_t corner : face) result.points.push_back(mesh.points[corner]);
    result.faces.push_back({first, first + 1, first + 2});
  }
  return result;
}

TEST(Seam, TurnsTrianglesIntoTheirMesh) {
  const Mesh mesh = to_mesh(prism(50));
  const Mesh sewn = sew_seams(soup(mesh));
  EXPECT_EQ(sewn.points.size(), mesh.points.size());
  EXPECT_EQ(sewn.faces.size(), mesh.faces.size());
  EXPECT_EQ(sew_seams(sewn), sewn);
}

TEST(Seam, KeepsApartWhatOnlyTouches) {
  // Two tetrahedra with one corner at the same place.
  const std::vector<std::array<std::uint32_t, 3>> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, faces};
  for (const Vec3& point : std::vector<Vec3>{{0, 0, 0}, {0, -1, 0}, {-1, 0, 0}, {0, 0, -1}}) {
    mesh.points.push_back(point);
  }
  for (const auto& [a, b, c] : faces) mesh.faces.push_back({a + 4, b + 4, c + 4});
  EXPECT_EQ(sew_seams(soup(mesh)).points.size(), 8U);
}

/// One triangle, its numbers in `buffer`.
std::string triangle(const std::string& buffer, const std::string& more = "") {
  return R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
         R"({"POSITION":0}}]}],"buffers":[{"byteLength":36,)" +
         buffer +
         R"(}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,)"
         R"("componentType":5126,"count":3,"type":"VEC3"}])" +
         more + "}";
}

std::string refusal(const std::filesystem::path& path) {
  try {
    static_cast<void>(read_gltf(path));
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(Gltf, ReadsBuffersFromRegularFilesInItsFolderOnly) {
  const Folder folder;
  std::string numbers(36, '\0');
  numbers[12 + 3] = 0x40;  // 2, 0, 0
  numbers[24 + 7] = 0x40;  // 0, 2, 0
  const auto inner = folder / "inner";
  std::filesystem::create_directories(inner);
  std::ofstream(folder / "out.bin") << numbers;
  std::ofstream(inner / "a b.bin") << numbers;
  ASSERT_EQ(::mkfifo((inner / "fifo").c_str(), 0600), 0);
  std::filesystem::create_symlink(folder / "out.bin", inner / "link.bin");
  const auto with_uri = [&](const std::string& uri) {
    std::ofstream(inner / "a.gltf") << triangle(R"("uri":")" + uri + '"');
    return refusal(inner / "a.gltf");
  };
  EXPECT_EQ(with_uri("a%20b.bin"), "");
  for (const std::string uri : {"../out.bin", "%2e%2e/out.bin", "../inner/a%20b.bin", "fifo",
                                "link.bin", "/dev/zero", "missing.bin", "."})
    EXPECT_NE(with_uri(uri).find("is no file in its folder"), std::string::npos) << uri;
  EXPECT_NE(with_uri((folder / "out.bin").string()), "");
}

TEST(Gltf, OpensNoImagesAndNoDeepBrackets) {
  const Folder folder;
  const std::string data = R"("uri":"data:application/octet-stream;base64,)" +
                           std::string("AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAAAAAAEAAAAAA") + '"';
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);  // it would wait for ever
  EXPECT_EQ(refusal(folder.write("a.gltf", triangle(data, R"(,"images":[{"uri":"fifo"}])"))), "");
  const std::string deep = std::string(101, '[') + std::string(101, ']');
  EXPECT_NE(refusal(folder.write("a.gltf", triangle(data, ",\"extras\":" + deep)))
                .find("nested more than 100 deep"),
            std::string::npos);
}

TEST(Gltf, RefusesMeshesThatNodesRepeatWithoutEnd) {
  const Folder folder;
  std::string nodes;
  std::string roots;
  for (int i = 0; i < 3000; ++i) {
    nodes += (i == 0 ? "" : ",") + std::string(R"({"mesh":0})");
    roots += (i == 0 ? "" : ",") + std::to_string(i);
  }
  std::string primitives;
  for (int i = 0; i < 1000; ++i)
    primitives += (i == 0 ? "" : ",") + std::string(R"({"attributes":{"POSITION":0}})");
  const std::string text =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" + roots + R"(]}],"nodes":[)" +
      nodes + R"(],"meshes":[{"primitives":[)" + primitives +
      R"(]}],"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)" +
      "AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAAAAAAEAAAAAA" +
      R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,)"
      R"("componentType":5126,"count":3,"type":"VEC3"}]})";
  EXPECT_NE(refusal(folder.write("a.gltf", text)).find("repeat its meshes"), std::string::npos);
}

}  // namespace
}  // namespace loft::io
