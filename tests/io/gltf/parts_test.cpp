// SPDX-License-Identifier: MIT
// What glTF says of parts: colours, extras, skins, what is hidden, contours.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <sstream>
#include <string>
#include <vector>

#include "io/bytes/hexadecimal.h"
#include "io/gltf/gltf.h"
#include "io/gltf/meshopt.h"
#include "io/meshes.h"
#include "io/meshes/label_colour.h"
#include "io/meshes/skin.h"
#include "io/surfaces.h"
#include "tests/io/gltf/glb.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using testing::prism;

tinygltf::Model model_of(const std::vector<Part>& parts) {
  std::ostringstream out;
  write_glb(out, parts, {.metres_per_unit = 0.01});
  return testing::load_glb(out.str());
}

TEST(GltfParts, EveryColourComesOutAsItWentIn) {
  for (int value = 0; value < 256; ++value) {
    const auto share = static_cast<std::uint8_t>(value);
    const Colour colour{share, static_cast<std::uint8_t>(255 - value), 0x80};
    EXPECT_EQ(srgb(linear(colour)), colour);
  }
  const Surface surface = prism(3);
  const auto model = model_of({{"heart", &surface, Colour{0xd0, 0x20, 0x30}}});
  const std::vector<double>& factor = model.materials[0].pbrMetallicRoughness.baseColorFactor;
  EXPECT_EQ(hexadecimal(srgb({factor[0], factor[1], factor[2]})), "#d02030");
}

TEST(GltfParts, ANodeSaysWhatIsKnownOfItsLabel) {
  const Surface closed = prism(4, {0, 0, 0}, 2);  // a square of 8, 2 high
  const Surface open = prism(4, {0, 0, 0}, 2, false);
  const auto model = model_of({{"heart", &closed, {}, "3", "ORGAN", "plan.dcm", 2},
                               {"lung", &open, {}, "0x1a", "", "", {}}});
  const tinygltf::Value& heart = model.nodes[0].extras;
  EXPECT_EQ(heart.Get("label").Get<std::string>(), "heart");
  EXPECT_EQ(heart.Get("id").GetNumberAsInt(), 3);
  EXPECT_EQ(heart.Get("kind").Get<std::string>(), "ORGAN");
  EXPECT_EQ(heart.Get("source").Get<std::string>(), "plan.dcm");
  EXPECT_EQ(heart.Get("slices").GetNumberAsInt(), 2);
  EXPECT_NEAR(heart.Get("volume_m3").GetNumberAsDouble(), 16e-6, 1e-12);
  EXPECT_NEAR(heart.Get("area_m2").GetNumberAsDouble(), (16 + 8 * std::sqrt(8)) * 1e-4, 1e-12);
  const tinygltf::Value& lung = model.nodes[1].extras;
  EXPECT_EQ(lung.Get("id").Get<std::string>(), "0x1a");
  EXPECT_FALSE(lung.Has("volume_m3")) << "it is open";
  EXPECT_FALSE(lung.Has("kind"));
  EXPECT_TRUE(model.extensionsUsed.empty());
}

TEST(GltfParts, SkinsAreTransparentUnlessAlone) {
  const Surface surface = prism(3);
  const auto both = model_of({{"BODY", &surface}, {"heart", &surface}});
  EXPECT_EQ(both.materials[0].alphaMode, "BLEND");
  EXPECT_EQ(both.materials[0].pbrMetallicRoughness.baseColorFactor[3], skin_opacity);
  EXPECT_EQ(both.materials[1].alphaMode, "OPAQUE");
  const auto alone = model_of({{"BODY", &surface}});
  EXPECT_EQ(alone.materials[0].alphaMode, "OPAQUE");
  EXPECT_EQ(alone.materials[0].pbrMetallicRoughness.baseColorFactor[3], 1);
}

TEST(GltfParts, WhatIsHiddenIsSaidAndNotRequired) {
  const Surface surface = prism(3);
  Part hidden{"BODY", &surface};
  hidden.is_hidden = true;
  const auto model = model_of({hidden, {"heart", &surface}});
  EXPECT_EQ(model.extensionsUsed, std::vector<std::string>{"KHR_node_visibility"});
  EXPECT_TRUE(model.extensionsRequired.empty());
  EXPECT_FALSE(model.nodes[0].extensions.at("KHR_node_visibility").Get("visible").Get<bool>());
  EXPECT_TRUE(model.nodes[1].extensions.empty());
}

TEST(GltfParts, ContoursAreASecondNodeOfLines) {
  const Surface surface = prism(3);
  Part part{"heart", &surface, Colour{255, 255, 255}};
  part.contours = {{0, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                   {0, {{4, 0, 0}, {5, 0, 0}}},
                   {2.5, {{0, 0, 2.5}, {1, 0, 2.5}, {0, 1, 2.5}, {-1, 0, 2.5}}}};
  const auto model = model_of({part});
  ASSERT_EQ(model.nodes.size(), 2U);
  EXPECT_EQ(model.nodes[1].name, "heart contours");
  const tinygltf::Value& extras = model.nodes[1].extras;
  EXPECT_EQ(extras.Get("contours_of").Get<std::string>(), "heart");
  EXPECT_EQ(extras.Get("heights").ArrayLen(), 2U);
  EXPECT_EQ(extras.Get("heights").Get(1).GetNumberAsDouble(), 2.5);
  EXPECT_EQ(extras.Get("vertices").Get(0).GetNumberAsInt(), 5);
  EXPECT_EQ(extras.Get("vertices").Get(1).GetNumberAsInt(), 4);
  const tinygltf::Primitive& lines = model.meshes[1].primitives[0];
  EXPECT_EQ(lines.mode, TINYGLTF_MODE_LINE);
  EXPECT_EQ(model.accessors[static_cast<std::size_t>(lines.indices)].count, 18U);
}

/// What comes back of contours; `slant`: how far one of their points is above its slice.
std::vector<Slice> contours_back(Compression compression, double slant = 0) {
  const testing::Folder folder;
  const Surface surface = prism(3);
  Part heart{"heart", &surface};
  heart.contours = {{0, {{0, 0, 0}, {1, 0, slant}, {0, 1, 0}}},
                    {0, {{4, 0, 0}, {5, 0, 0}, {5, 1, 0}}},
                    {2.5, {{0, 0, 2.5}, {1, 0, 2.5}, {0, 1, 2.5}, {-1, 0, 2.5}}}};
  Part lung{"", &surface};
  lung.contours = {{2.5, {{7, 7, 2.5}, {8, 7, 2.5}, {7, 8, 2.5}}}};
  const std::vector<Part> parts{heart, lung};
  write(folder / "a.glb", parts, {.metres_per_unit = 0.01, .compression = compression});
  EXPECT_EQ(read_meshes(folder / "a.glb").size(), 2U) << "lines are no meshes";
  return read_contours(folder / "a.glb");
}

TEST(GltfParts, ContoursComeBack) {
  for (const Compression compression :
       {Compression::none, Compression::quantize, Compression::meshopt}) {
    if (compression == Compression::meshopt && !has_meshopt()) continue;
    const std::vector<Slice> slices = contours_back(compression);
    ASSERT_EQ(slices.size(), 2U);
    EXPECT_EQ(slices[0].z, 0);
    EXPECT_EQ(slices[1].z, 2.5);
    ASSERT_EQ(slices[0].contours.size(), 2U);
    EXPECT_EQ(slices[0].contours[1].points.size(), 3U);
    EXPECT_NEAR(slices[0].contours[1].points[0].x, 4, 1e-3);
    ASSERT_EQ(slices[1].contours.size(), 2U);
    EXPECT_EQ(slices[1].contours[0].label, "heart");
    EXPECT_EQ(slices[1].contours[0].points.size(), 4U);
    EXPECT_EQ(slices[1].contours[1].label, "");
  }
}

TEST(GltfParts, ContoursThatAreNotLevelAreNoSlices) {
  EXPECT_TRUE(contours_back(Compression::none, 0.2).empty());
}

TEST(Skin, IsToldByItsKindElseByAName) {
  for (const char* name : {"BODY", "External", "skin", "Body Contour", "outer_skin-2", "BODY_1"})
    EXPECT_TRUE(is_skin(name)) << name;
  for (const char* name : {"", "heart", "antibody", "vertebral body", "external iliac artery",
                           "skin tumour", "contour", "k\xc3\xb6rper body"})
    EXPECT_FALSE(is_skin(name)) << name;
  EXPECT_TRUE(is_skin("Couch outline", "EXTERNAL"));
  EXPECT_FALSE(is_skin("BODY", "PTV"));
  EXPECT_FALSE(is_skin("BODY", "ORGAN"));
  EXPECT_TRUE(is_skin("skin", "Anatomical Structure"));
}

}  // namespace
}  // namespace loft::io
