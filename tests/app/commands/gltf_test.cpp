// SPDX-License-Identifier: MIT
// What loft reconstruct is told of glTF and its like.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/program.h"

namespace loft::app {
namespace {

using namespace testing;
using ::testing::HasSubstr;

/// A body around a heart, with all that a stack can say of them.
std::string plan() {
  const auto line = [](double z) {
    std::string slice_line = slice(z, ring(9) + ", " + ring(2));
    slice_line.erase(slice_line.find_last_of('}'));
    return slice_line + R"(,"labels":["outside","heart"]})" + '\n';
  };
  return R"({"stack":{"unit":"cm","labels":[{"name":"heart","colour":"#ff0080","id":"3","kind":)"
         R"("ORGAN"},{"name":"outside","kind":"EXTERNAL"}]}})"
         "\n" +
         line(0) + line(1) + line(2);
}

TEST(GltfOptions, NodesSayWhatTheStackSays) {
  const Folder folder;
  static_cast<void>(folder.write("plan.ndjson", plan()));
  const Outcome made =
      run(folder, "reconstruct plan.ndjson -o out.gltf --with-contours --hide 'out*'");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto gltf = nlohmann::json::parse(content(folder / "out.gltf"));
  ASSERT_EQ(gltf["nodes"].size(), 4U);
  const auto& heart = gltf["nodes"][0];
  EXPECT_EQ(heart["extras"]["id"], 3);
  EXPECT_EQ(heart["extras"]["kind"], "ORGAN");
  EXPECT_EQ(heart["extras"]["source"], "plan.ndjson");
  EXPECT_EQ(heart["extras"]["slices"], 3);
  EXPECT_FALSE(heart.contains("extensions"));
  EXPECT_EQ(gltf["nodes"][1]["name"], "heart contours");
  EXPECT_EQ(gltf["nodes"][1]["extras"]["heights"], nlohmann::json({0.0, 1.0, 2.0}));
  for (const std::size_t hidden : {2U, 3U})
    EXPECT_EQ(gltf["nodes"][hidden]["extensions"]["KHR_node_visibility"]["visible"], false);
  EXPECT_EQ(gltf["materials"][2]["alphaMode"], "BLEND");
}

TEST(GltfOptions, CompressedFilesAreCheckedAndDescribed) {
  const Folder folder;
  static_cast<void>(folder.write("plan.ndjson", plan()));
  for (const std::string how : {"quantize", "meshopt"}) {
    const Outcome made = run(folder, "reconstruct plan.ndjson -o out.glb --compress " + how);
    if (made.exit_code == 2) {
      EXPECT_THAT(made.err, HasSubstr("libmeshoptimizer-dev"));
      continue;
    }
    EXPECT_THAT(made.err, HasSubstr("out.glb: positions are rounded by at most 0.0"));
    EXPECT_EQ(run(folder, "check out.glb").exit_code, 0);
    const auto info = nlohmann::json::parse(run(folder, "info out.glb --json").out);
    EXPECT_EQ(info["parts"].size(), 2U) << info;
  }
}

TEST(GltfOptions, AreRefusedWhereThereIsNoGltf) {
  const Folder folder;
  static_cast<void>(folder.write("plan.ndjson", plan()));
  for (const std::string option : {"--compress quantize", "--with-contours", "--hide heart"}) {
    const Outcome made = run(folder, "reconstruct plan.ndjson -o out.ply " + option);
    EXPECT_EQ(made.exit_code, 2);
    EXPECT_THAT(made.err, HasSubstr(option.substr(0, option.find(' ')) + " is for glTF"));
  }
  const Outcome made = run(folder, "reconstruct plan.ndjson -o out.glb --hide hart");
  EXPECT_EQ(made.exit_code, 2);
  EXPECT_THAT(made.err, HasSubstr("did you mean 'heart'?"));
  EXPECT_EQ(run(folder, "reconstruct plan.ndjson -o out.glb --compress zip").exit_code, 2);
}

TEST(GltfOptions, PlyHasTheSameColoursOutOfCore) {
  const Folder folder;
  static_cast<void>(folder.write("plan.ndjson", plan()));
  static_cast<void>(run(folder, "reconstruct plan.ndjson -o a.ply -q"));
  static_cast<void>(run(folder, "reconstruct plan.ndjson -o b.ply -q --out-of-core"));
  EXPECT_THAT(content(folder / "a.ply"), HasSubstr("property uchar red"));
  EXPECT_EQ(content(folder / "a.ply"), content(folder / "b.ply"));
}

}  // namespace
}  // namespace loft::app
