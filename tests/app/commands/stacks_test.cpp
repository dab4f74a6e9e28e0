// SPDX-License-Identifier: MIT
// Stacks that say more than their slices, and what is chosen of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/program.h"
#include "tests/io/images/made_png.h"

namespace loft::app {
namespace {

using namespace testing;
using ::testing::HasSubstr;

/// Two labels, in centimetres, one with a colour.
std::string two_labels() {
  const std::string labels = R"(,"labels":["heart","lung/left"]})";
  const auto line = [&](double z) {
    std::string slice_line = slice(z, ring(2) + ", [[9,0],[10,0],[10,1],[9,1]]");
    slice_line.erase(slice_line.find_last_of('}'));
    return slice_line + labels + '\n';
  };
  return R"({"stack":{"unit":"cm","labels":[{"name":"heart","colour":"#ff0080","id":"3"}]}})"
         "\n" +
         line(0) + line(1) + line(2);
}

TEST(Stacks, UnitAndColoursComeFromTheFile) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", two_labels()));
  const Outcome made = run(folder, "reconstruct in.ndjson -o out.gltf --json");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(nlohmann::json::parse(made.out)["options"]["metres_per_unit"], 0.01);
  const auto gltf = nlohmann::json::parse(content(folder / "out.gltf"));
  for (const auto& material : gltf["materials"]) {
    if (material["name"] != "heart") continue;
    const auto colour = material["pbrMetallicRoughness"]["baseColorFactor"];
    EXPECT_DOUBLE_EQ(colour[0], 1);
    EXPECT_DOUBLE_EQ(colour[1], 0);
    EXPECT_NEAR(colour[2], 0.2158605, 1e-7) << "0x80 of sRGB, linear";
  }
  const auto info = nlohmann::json::parse(run(folder, "info in.ndjson --json").out);
  EXPECT_EQ(info["unit"], "cm");
  EXPECT_EQ(info["labels"][0]["colour"], "#ff0080");
  EXPECT_EQ(info["labels"][0]["id"], "3");
}

TEST(Stacks, LabelsAreChosenByNameOrPattern) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", two_labels()));
  static_cast<void>(folder.write("wanted.txt", "lung/left\r\n"));
  for (const std::string how :
       {"--only 'lung*'", "--except heart", "--only @wanted.txt", "--only '*' --except 'hea?t'"}) {
    for (const std::string where : {"", " --out-of-core"}) {
      const Outcome made = run(folder, "reconstruct in.ndjson -o out.ply --json " + how + where);
      ASSERT_EQ(made.exit_code, 0) << how << made.err;
      const auto parts = nlohmann::json::parse(made.out)["parts"];
      ASSERT_EQ(parts.size(), 1U) << how;
      EXPECT_EQ(parts[0]["label"], "lung/left");
    }
  }
  const Outcome wrong = run(folder, "reconstruct in.ndjson -o out.ply --only haert");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("did you mean 'heart'"));
}

TEST(Stacks, AFileALabel) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", two_labels()));
  ASSERT_EQ(run(folder, "reconstruct in.ndjson -o '{label}.stl' -o all.glb").exit_code, 0);
  EXPECT_FALSE(content(folder / "heart.stl").empty());
  EXPECT_FALSE(content(folder / "lung_left.stl").empty());
  EXPECT_EQ(run(folder, "check heart.stl lung_left.stl all.glb").exit_code, 0);
}

TEST(Stacks, LabelsThatWouldShareAFileAreRefused) {
  const Folder folder;
  std::string text = two_labels();
  for (auto at = text.find("\"heart\",\"lung/left\""); at != std::string::npos;
       at = text.find("\"heart\",\"lung/left\""))
    text.replace(at, 19, R"("Lung:left","lung/left")");
  static_cast<void>(folder.write("in.ndjson", text));
  const Outcome made = run(folder, "reconstruct in.ndjson -o '{label}.stl'");
  EXPECT_EQ(made.exit_code, 2);
  EXPECT_THAT(made.err, HasSubstr("both be written"));
  EXPECT_FALSE(std::filesystem::exists(folder / "lung_left.stl"));
}

TEST(Stacks, VolumesAreATable) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", two_labels()));
  const Outcome made =
      run(folder, "reconstruct in.ndjson -o out.ply --csv volumes.csv --cap extend");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("volume cm^3"));
  EXPECT_THAT(content(folder / "volumes.csv"),
              HasSubstr("label,slices,contours,volume_cm3,volume,unit,area\r\n"));
  EXPECT_THAT(content(folder / "volumes.csv"), HasSubstr("lung/left,3,3,3,3,cm,"));
}

TEST(Info, GivesBothVolumes) {
  const Folder folder;
  static_cast<void>(folder.write(
      "in.ndjson", two_labels() + R"({"z":3,"contours":[[[0,20],[1,20],[0,21]]],"labels":["tip"]})"
                                  "\n"));
  const auto labels = nlohmann::json::parse(run(folder, "info in.ndjson --json").out)["labels"];
  EXPECT_EQ(labels[1]["label"], "lung/left");
  EXPECT_DOUBLE_EQ(labels[1]["volume"], 2 + 1.0 / 6) << "a tip half way to the slice without it";
  EXPECT_DOUBLE_EQ(labels[1]["slab_volume"], 3);
  EXPECT_DOUBLE_EQ(labels[2]["slab_volume"], 0.5);
  EXPECT_THAT(run(folder, "info in.ndjson").out, HasSubstr("volume 2.167 cm^3, as slabs 3"));
  const Outcome without = run(folder, "info in.ndjson --json --no-volumes");
  EXPECT_TRUE(nlohmann::json::parse(without.out)["labels"][1]["volume"].is_null());
}

TEST(Info, SaysWhyThereIsNoVolume) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", slice(0, ring(4)) + '\n'));
  const Outcome info = run(folder, "info in.ndjson");
  EXPECT_EQ(info.exit_code, 0);
  EXPECT_THAT(info.out, HasSubstr("no surface: "));
}

TEST(Convert, WritesLayersAndPlanes) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", two_labels()));
  const Outcome cli = run(folder, "convert in.ndjson -o out.cli");
  ASSERT_EQ(cli.exit_code, 0) << cli.err;
  EXPECT_THAT(cli.err, HasSubstr("CLI has no colours"));
  const Outcome planes = run(folder, "convert in.ndjson -o out.contour");
  ASSERT_EQ(planes.exit_code, 0) << planes.err;
  EXPECT_THAT(planes.err, HasSubstr("1 is 'heart', 2 is 'lung/left'"));
  EXPECT_EQ(run(folder, "reconstruct out.cli -o out.ply").exit_code, 0);
  EXPECT_EQ(run(folder, "check out.ply").exit_code, 0);
  const auto info = nlohmann::json::parse(run(folder, "info out.contour --json").out);
  EXPECT_EQ(info["labels"][1]["slab_volume"], 3);
}

TEST(Convert, GivesTheSameStack) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", two_labels()));
  ASSERT_EQ(run(folder, "convert in.ndjson -o out.ndjson --only heart").exit_code, 0);
  ASSERT_EQ(run(folder, "convert out.ndjson -o again.ndjson").exit_code, 0);
  EXPECT_EQ(content(folder / "out.ndjson"), content(folder / "again.ndjson"));
  EXPECT_THAT(content(folder / "out.ndjson"), HasSubstr("#ff0080"));
  EXPECT_EQ(run(folder, "convert in.ndjson -o out.xyz").exit_code, 2);
}

TEST(SliceCommand, AndReconstructIsARoundTrip) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel()));
  ASSERT_EQ(run(folder, "reconstruct in.ndjson -o solid.ply").exit_code, 0);
  for (const std::string how :
       {"--gap 0.3", "--heights 0.5,3,1.25", "--gap 0.4 --normal 1,2,0.5"}) {
    ASSERT_EQ(run(folder, "slice solid.ply -o cut.ndjson " + how).exit_code, 0) << how;
    ASSERT_EQ(run(folder, "reconstruct cut.ndjson -o again.ply").exit_code, 0) << how;
    const Outcome check = run(folder, "check again.ply --stack cut.ndjson");
    EXPECT_EQ(check.exit_code, 0) << how << check.out;
  }
  EXPECT_EQ(run(folder, "slice solid.ply -o cut.ndjson").exit_code, 2);
  EXPECT_EQ(run(folder, "slice solid.ply -o cut.ndjson --heights 99").exit_code, 3);
}

/// Three slices in a folder, of which a shell has the second last; red beside blue.
void write_images(const Folder& folder) {
  std::filesystem::create_directory(folder / "images");
  io::testing::MadePng made{.columns = 6, .rows = 4, .kind = 2, .samples = std::vector<int>(72)};
  for (std::size_t pixel = 7; pixel < 17; ++pixel)
    if (pixel % 6 > 0 && pixel % 6 < 5) made.samples[3 * pixel + (pixel % 6 < 3 ? 0 : 2)] = 255;
  for (const char* const name : {"images/a1.png", "images/a2.png", "images/a10.png"})
    static_cast<void>(folder.write(name, made.bytes()));
}

TEST(Stacks, AFolderOfImagesIsOne) {
  const Folder folder;
  write_images(folder);
  const Outcome asked = run(folder, "info images");
  EXPECT_EQ(asked.exit_code, 3);
  if (asked.err.find("this build reads no PNG") != std::string::npos) GTEST_SKIP();
  EXPECT_THAT(asked.err, HasSubstr("--spacing x,y,z"));
  const Outcome info = run(folder, "info images --spacing 1,1,2 --json");
  ASSERT_EQ(info.exit_code, 0) << info.err;
  EXPECT_EQ(nlohmann::json::parse(info.out)["labels"].size(), 2U);
  EXPECT_THAT(run(folder, "info images --spacing 1,1,2 --level 1").err,
              HasSubstr("a level is for images of grey"));
  for (const std::string how : {"images", "images/*.png", "images --out-of-core"}) {
    const Outcome made = run(folder, "reconstruct " + how +
                                         " --spacing 1,1,2 --outline edges --only '#ff*' "
                                         "--json -o out.ply");
    ASSERT_EQ(made.exit_code, 0) << how << made.err;
    const auto parts = nlohmann::json::parse(made.out)["parts"];
    ASSERT_EQ(parts.size(), 1U) << how;
    EXPECT_EQ(parts[0]["label"], "#ff0000");
    EXPECT_DOUBLE_EQ(parts[0]["volume"], 2 * 2 * 4) << how;
  }
}

}  // namespace
}  // namespace loft::app
