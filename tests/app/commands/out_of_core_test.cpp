// SPDX-License-Identifier: MIT
// `loft reconstruct --out-of-core` makes what it makes in memory.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/program.h"
#include "tests/sanitized.h"

namespace loft::app {
namespace {

using namespace testing;

nlohmann::json without_seconds(const std::string& report) {
  auto json = nlohmann::json::parse(report);
  for (const char* key : {"seconds", "peak_memory_mb", "outputs", "out_of_core"}) json.erase(key);
  for (auto& part : json["parts"])
    for (const char* key : {"seconds", "peak_memory_mb"}) part.erase(key);
  return json;
}

void expect_same(const Folder& folder, const std::string& arguments) {
  const Outcome in = run(folder, "reconstruct " + arguments + " -o in.ply --in-memory --json");
  const Outcome out = run(folder, "reconstruct " + arguments + " -o out.ply --out-of-core --json");
  EXPECT_EQ(in.exit_code, 0) << in.err;
  EXPECT_EQ(out.exit_code, 0) << out.err;
  EXPECT_TRUE(content(folder / "in.ply") == content(folder / "out.ply")) << arguments;
  EXPECT_EQ(without_seconds(in.out), without_seconds(out.out));
  EXPECT_TRUE(nlohmann::json::parse(out.out)["out_of_core"]);
}

TEST(OutOfCore, WritesTheSameBytesAndReport) {
  const Folder folder;
  static_cast<void>(
      folder.write("a.ndjson", "\xEF\xBB\xBF" + barrel(slice(2, ring(10) + ", [[1, 1]]"))));
  static_cast<void>(folder.write(
      "b.ndjson", "\n" + slice(2.5, ring(5) + "," + ring(5, 8, 8)) + "\r\n" + slice(-1, ring(2))));
  for (const std::string options : {"", " --threads 1", " --threads 3 --cap dome", " --smooth",
                                    " --fill nonzero --cap open", " --target-edge 0.7"})
    expect_same(folder, "--merge a.ndjson b.ndjson" + options);
}

#ifndef LOFT_SANITIZED
TEST(OutOfCore, VolumesMayBeLargerThanMemory) {
  const Folder folder;
  const std::string header =
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 512 512 400\nspacings: 1 1 1\nencoding: raw\n\n";
  constexpr std::size_t slice_size = std::size_t{512} * 512;
  std::string front = header + std::string(3 * slice_size, '\0');
  for (const std::size_t k : {1U, 2U})
    for (const std::size_t y : {5U, 6U, 7U})
      front.replace(header.size() + k * slice_size + y * 512 + 10, 3, "\1\1\1");
  const auto path = folder.write("large.nrrd", front);
  std::filesystem::resize_file(path, header.size() + 400 * slice_size);  // a hole of 100 MB
  const std::string program = std::getenv("LOFT");
  const std::string in_60_megabytes = "cd '" + (folder / "").string() +
                                      "' && ulimit -d 60000 && '" + program +
                                      "' reconstruct large.nrrd -o out.ply --threads 1 -q";
  ASSERT_EQ(std::system((in_60_megabytes + " --out-of-core").c_str()), 0);
  EXPECT_EQ(run(folder, "check out.ply").exit_code, 0);
}
#endif

TEST(OutOfCore, WritesAllLabelsIntoOneFile) {
  const Folder folder;
  std::string stack;
  for (const int z : {3, 0, 1, 2})
    stack += R"({"z": )" + std::to_string(z) + R"(, "contours": [)" + ring(2) + ", " +
             ring(3, 12, 4, 0) + ", " + ring(1 + z, 9) +
             R"(], "labels": ["heart", "lung", "lung"]})" + "\n";
  static_cast<void>(folder.write("in.ndjson", stack));
  expect_same(folder, "in.ndjson");
  EXPECT_EQ(run(folder, "check out.ply").exit_code, 0);
}

TEST(OutOfCore, ListsTheSameErrorsAndLeavesNothingBehind) {
  const Folder folder;
  static_cast<void>(folder.write("syntax.ndjson", "{\"z\": 1\n[]\n" + barrel()));
  static_cast<void>(folder.write(
      "huge.ndjson", slice(1, "[[0,0],[1e80,0],[0,1]]") + slice(2, "[[0,0],[0,1e90],[0,1]]")));
  static_cast<void>(folder.write("single.ndjson", slice(1, ring(3))));
  static_cast<void>(folder.write("empty.ndjson", ""));
  const std::size_t files = folder.size();
  for (const std::string name : {"syntax", "huge", "single", "empty", "missing"}) {
    const Outcome in = run(folder, "reconstruct " + name + ".ndjson -o x.ply");
    const Outcome out = run(folder, "reconstruct " + name + ".ndjson -o x.ply --out-of-core");
    EXPECT_EQ(in.exit_code, 3);
    EXPECT_EQ(out.exit_code, 3);
    EXPECT_EQ(in.err, out.err);
  }
  EXPECT_EQ(folder.size(), files + 2) << "only out.txt and err.txt are new";
}

TEST(OutOfCore, SaysWhatItCannotDo) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel()));
  const Outcome formats = run(folder, "reconstruct in.ndjson -o a.glb --out-of-core");
  EXPECT_EQ(formats.exit_code, 2);
  EXPECT_NE(formats.err.find("--out-of-core writes one PLY file"), std::string::npos)
      << formats.err;
  EXPECT_EQ(run(folder, "reconstruct in.ndjson -o a.ply -o b.ply --out-of-core").exit_code, 2);
  EXPECT_EQ(run(folder, "reconstruct in.ndjson -o a.ply --out-of-core --in-memory").exit_code, 2);
  const Outcome simplify =
      run(folder, "reconstruct in.ndjson -o a.ply --out-of-core --simplify 0.1");
  EXPECT_EQ(simplify.exit_code, 2);
  EXPECT_NE(simplify.err.find("--simplify"), std::string::npos) << simplify.err;
  const Outcome input = run(folder, "reconstruct - -o a.ply --out-of-core");
  EXPECT_EQ(input.exit_code, 3);
  EXPECT_NE(input.err.find("standard input"), std::string::npos) << input.err;
}

}  // namespace
}  // namespace loft::app
