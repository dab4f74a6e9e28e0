// SPDX-License-Identifier: MIT
// `loft view`: what a browser gets of a mesh and of a session.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/meshes.h"
#include "tests/app/running.h"

namespace loft::app {
namespace {

using namespace testing;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

std::string tower(int count) {
  std::string lines;
  for (int i = 0; i < count; ++i) lines += slice(i, ring(5 + 0.1 * i, 16, 0.1 * i));
  return lines;
}

/// What a viewer that starts is told.
json first_event(httplib::Client& client) {
  std::string text;
  client.Get("/events", [&](const char* data, std::size_t size) {
    text.append(data, size);
    return text.find("\n\n") == std::string::npos;
  });
  const std::size_t begin = text.find("data: ") + 6;
  EXPECT_THAT(text, HasSubstr("event: reset\n"));
  return json::parse(text.substr(begin, text.find('\n', begin) - begin));
}

/// How many faces all slabs have together.
std::size_t face_count(const Folder& folder, httplib::Client& client) {
  std::size_t count = 0;
  const json shown = first_event(client);
  for (const json& slab : shown["slabs"]) {
    const auto answer = client.Get("/slabs/" + slab["id"].get<std::string>() + ".glb");
    EXPECT_EQ(answer->status, 200);
    std::ofstream(folder / "slab.glb", std::ios::binary) << answer->body;
    count += io::read_mesh(folder / "slab.glb").faces.size();
  }
  return count;
}

TEST(View, ShowsAllFacesOfAMeshInChunks) {
  const Folder folder;
  std::ofstream(folder / "tower.ndjson") << tower(2200);
  ASSERT_EQ(run(folder, "reconstruct tower.ndjson -o tower.ply -q").exit_code, 0);
  const std::size_t faces = io::read_mesh(folder / "tower.ply").faces.size();
  Running running(folder, {"view", "tower.ply", "--port", "0", "--unit", "um"});
  const auto client = running.client();

  const json shown = first_event(*client);
  EXPECT_EQ(shown["counts"]["faces"], faces);
  EXPECT_GT(shown["slabs"].size(), 1U);
  EXPECT_EQ(shown["unit"], "um");
  EXPECT_EQ(face_count(folder, *client), faces);
  EXPECT_EQ(client->Get("/slabs/0-99.glb")->status, 404);
  EXPECT_EQ(client->Get("/slabs/7-0.glb")->status, 404);
  EXPECT_EQ(running.interrupt(), 0);
}

/// Four slices of a cube of 3, and a smaller one in it.
std::string two_cubes() {
  std::string lines;
  for (int z = 0; z < 4; ++z) {
    std::string contours = R"([[0, 0], [3, 0], [3, 3], [0, 3]])";
    std::string labels = R"("Body 1")";
    if (z < 2) {
      contours += ", [[1, 1], [2, 1], [2, 2], [1, 2]]";
      labels += R"(, "heart")";
    }
    lines += R"({"z": )" + std::to_string(z) + R"(, "contours": [)" + contours +
             R"(], "labels": [)" + labels + "]}\n";
  }
  return lines;
}

/// GLBs that follow one another, each in a file.
std::vector<std::string> apart(std::string_view glbs) {
  std::vector<std::string> files;
  while (glbs.size() >= 12) {
    std::uint32_t size = 0;
    for (std::size_t i = 0; i < 4; ++i)
      size |= std::uint32_t{static_cast<unsigned char>(glbs[8 + i])} << (8 * i);
    files.emplace_back(glbs.substr(0, size));
    glbs.remove_prefix(std::min<std::size_t>(size, glbs.size()));
  }
  return files;
}

json extras_of(const std::string& glb) {
  const std::size_t end = glb.find("BIN", 20);
  return json::parse(
      glb.substr(20, end == std::string::npos ? end : end - 24))["nodes"][0]["extras"];
}

/// Asks for all slabs until all are there; how many faces they have together.
std::size_t bundled_face_count(const Folder& folder, httplib::Client& client) {
  const auto number = [](const json& slab) {
    return std::stoi(slab["id"].get<std::string>().substr(2));
  };
  std::set<int> missing;
  const json shown = first_event(client);
  for (const json& slab : shown["slabs"]) missing.insert(number(slab));
  std::size_t count = 0;
  while (!missing.empty()) {
    const auto answer = client.Get("/slabs?ids=0-" + std::to_string(*missing.begin()) + ".." +
                                   std::to_string(*missing.rbegin()));
    EXPECT_EQ(answer->status, 200);
    if (answer->status != 200) return 0;
    for (const std::string& glb : apart(answer->body)) {
      const json extras = extras_of(glb);
      for (const json& slab : extras["slabs"]) EXPECT_EQ(missing.erase(number(slab)), 1U);
      std::ofstream(folder / "slab.glb", std::ios::binary) << glb;
      count += io::read_mesh(folder / "slab.glb").faces.size();
    }
  }
  return count;
}

TEST(View, SendsManySlabsAtOnce) {
  const Folder folder;
  std::ofstream(folder / "stdin") << tower(1200);
  ASSERT_EQ(run(folder, "stream --session kept -o out.ply").exit_code, 0);
  for (const char* file : {"kept", "out.ply"}) {
    Running running(folder, {"view", file, "--port", "0"});
    const auto client = running.client();
    const std::size_t faces = io::read_mesh(folder / "out.ply").faces.size();
    EXPECT_EQ(bundled_face_count(folder, *client), faces) << file;
    EXPECT_EQ(client->Get("/slabs?ids=0-99999,3-0..7")->status, 404);
    for (const char* wrong : {"", "0", "0-", "0-1,", "0-3..1", "0-1234567890", "a-1", "0-1;0-2"})
      EXPECT_EQ(client->Get(std::string("/slabs?ids=") + wrong)->status, 400) << wrong;
    EXPECT_EQ(client->Get("/slabs")->status, 400);
  }
}

TEST(View, ABundleHasWhatEachOfItsSlabsHas) {
  const Folder folder;
  std::ofstream(folder / "stdin") << two_cubes();
  ASSERT_EQ(run(folder, "stream --session kept").exit_code, 0);
  Running running(folder, {"view", "kept", "--port", "0"});
  const auto client = running.client();
  for (const std::string& bundle : apart(client->Get("/slabs?ids=0-0..99,1-0..99")->body)) {
    const json all = extras_of(bundle);
    for (const json& slab : all["slabs"]) {
      const auto alone = client->Get("/slabs/" + slab["id"].get<std::string>() + ".glb");
      const json own = extras_of(alone->body);
      EXPECT_EQ(all["label"], own["label"]);
      for (const char* what : {"low", "high", "edit", "confidence"})
        EXPECT_EQ(slab[what], own[what]) << what;
    }
  }
}

TEST(View, GivesTheFileItselfAndTakesNothing) {
  const Folder folder;
  std::ofstream(folder / "tower.ndjson") << tower(3);
  ASSERT_EQ(run(folder, "reconstruct tower.ndjson -o tower.stl -q").exit_code, 0);
  Running running(folder, {"view", "tower.stl", "--port", "0"});
  const auto client = running.client();
  EXPECT_EQ(first_event(*client)["downloads"], json::array({".stl"}));
  EXPECT_EQ(client->Get("/surface.stl")->body, content(folder / "tower.stl"));
  EXPECT_EQ(client->Get("/surface.ply")->status, 404);
  EXPECT_EQ(client->Post("/slices", tower(1), "application/x-ndjson")->status, 405);
}

TEST(View, ShowsTheSurfaceOfASession) {
  const Folder folder;
  std::ofstream(folder / "stdin") << tower(5) << "{\"op\": \"remove\", \"z\": 4}\n";
  ASSERT_EQ(run(folder, "stream --session kept --unit cm -o out.ply").exit_code, 0);
  const std::string before = content(folder / "kept");
  Running running(folder, {"view", "kept", "--port", "0"});
  const auto client = running.client();
  const json shown = first_event(*client);
  EXPECT_EQ(shown["slices"], json::array({0.0, 1.0, 2.0, 3.0}));
  EXPECT_EQ(shown["unit"], "cm");
  EXPECT_EQ(face_count(folder, *client), io::read_mesh(folder / "out.ply").faces.size());
  EXPECT_EQ(client->Post("/slices", tower(1), "application/x-ndjson")->status, 405);
  EXPECT_EQ(running.interrupt(), 0);
  EXPECT_EQ(content(folder / "kept"), before);
}

void expect_two_cubes(httplib::Client& client, std::size_t slices, std::size_t inner_slices) {
  const json labels = json::parse(client.Get("/labels")->body)["labels"];
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_EQ(labels[0]["label"], "Body 1");
  EXPECT_EQ(labels[1]["label"], "heart");
  EXPECT_TRUE(labels[0]["is_skin"]);
  EXPECT_FALSE(labels[1]["is_skin"]);
  EXPECT_NEAR(labels[0]["volume"].get<double>(), 27, 1e-5);
  EXPECT_NEAR(labels[0]["area"].get<double>(), 54, 1e-5);
  EXPECT_NEAR(labels[1]["volume"].get<double>(), 7.0 / 6, 1e-5);  // it ends in a point
  EXPECT_NEAR(labels[1]["area"].get<double>(), 5 + std::sqrt(2), 1e-5);
  EXPECT_GE(labels[1]["faces"], 12);
  EXPECT_EQ(labels[0]["slices"], slices);
  EXPECT_EQ(labels[1]["slices"], inner_slices);
  EXPECT_THAT(labels[0]["colour"].get<std::string>(), MatchesRegex("#[0-9a-f]+"));
  EXPECT_NE(labels[0]["colour"], labels[1]["colour"]);
}

TEST(View, TellsOfTheLabelsOfAFile) {
  const Folder folder;
  std::ofstream(folder / "cubes.ndjson") << two_cubes();
  ASSERT_EQ(run(folder, "reconstruct cubes.ndjson -o cubes.ply -q").exit_code, 0);
  Running running(folder, {"view", "cubes.ply", "--port", "0"});
  const auto client = running.client();
  const json shown = first_event(*client);
  EXPECT_EQ(shown["kind"], "file");
  EXPECT_EQ(shown["name"], "cubes.ply");
  EXPECT_EQ(shown["is_patient"], false);
  expect_two_cubes(*client, 4, 2);
}

TEST(View, TellsOfTheLabelsOfASession) {
  const Folder folder;
  std::ofstream(folder / "stdin") << two_cubes();
  ASSERT_EQ(run(folder, "stream --session kept").exit_code, 0);
  Running running(folder, {"view", "kept", "--port", "0"});
  const auto client = running.client();
  const json shown = first_event(*client);
  EXPECT_EQ(shown["kind"], "session");
  EXPECT_EQ(shown["name"], "kept");
  expect_two_cubes(*client, 4, 2);
}

TEST(View, ShowsTheContoursThatAPlyKnows) {
  const Folder folder;
  std::ofstream(folder / "cubes.ndjson") << two_cubes();
  ASSERT_EQ(run(folder, "reconstruct cubes.ndjson -o cubes.ply -o cubes.obj -q").exit_code, 0);
  Running running(folder, {"view", "cubes.ply", "--port", "0"});
  const auto client = running.client();
  EXPECT_EQ(first_event(*client)["slices"], json::array({0.0, 1.0, 2.0, 3.0}));
  const json slice = json::parse(client->Get("/slices?z=1")->body);
  EXPECT_EQ(slice["labels"], json::array({"Body 1", "heart"}));
  EXPECT_EQ(slice["contours"][1], json::parse("[[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0]]"));
  EXPECT_EQ(client->Get("/slices?z=1.5")->status, 404);
  Running without(folder, {"view", "cubes.obj", "--port", "0"});
  EXPECT_EQ(first_event(*without.client())["slices"], json::array());
}

TEST(View, ShowsAStackBeforeThereIsASurface) {
  const Folder folder;
  std::ofstream(folder / "cubes.ndjson") << R"({"stack": {"unit": "cm"}})" << '\n' << two_cubes();
  Running running(folder, {"view", "cubes.ndjson", "--port", "0"});
  const auto client = running.client();
  const json shown = first_event(*client);
  EXPECT_EQ(shown["kind"], "file");
  EXPECT_EQ(shown["unit"], "cm");
  EXPECT_EQ(shown["slices"], json::array({0.0, 1.0, 2.0, 3.0}));
  EXPECT_EQ(shown["slabs"], json::array());
  EXPECT_EQ(shown["downloads"], json::array());
  EXPECT_EQ(json::parse(client->Get("/slices?z=1")->body)["contours"].size(), 2U);
  const json labels = json::parse(client->Get("/labels")->body)["labels"];
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_EQ(labels[1]["slices"], 2);
  EXPECT_TRUE(shown["volume"].is_null() && labels[1]["volume"].is_null()) << "nobody knows it";
  EXPECT_EQ(client->Get("/surface.glb")->status, 404);
  EXPECT_EQ(client->Get("/slabs?ids=0-0..9")->status, 404);
  EXPECT_EQ(client->Get("/history")->status, 404);
}

/// What is between two marks of a file.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t begin = text.find(before) + before.size();
  return text.substr(begin, text.find(after, begin) - begin);
}

TEST(View, ExportsAPageThatNeedsNoServer) {
  const Folder folder;
  std::ofstream(folder / "cubes.ndjson") << two_cubes();
  ASSERT_EQ(run(folder, "reconstruct cubes.ndjson -o cubes.glb -o cubes.ply -q").exit_code, 0);
  const Outcome exported = run(folder, "view cubes.glb --export page");
  if (exported.err.find("built without its viewer") != std::string::npos) GTEST_SKIP();
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_EQ(content(folder / "page/surface.glb"), content(folder / "cubes.glb"));
  EXPECT_EQ(json::parse(content(folder / "page/labels.json"))["labels"].size(), 2U);
  const std::string page = content(folder / "page/index.html");
  EXPECT_THAT(page, Not(HasSubstr("module")));
  EXPECT_THAT(page, Not(HasSubstr("http")));
  const json contents =
      json::parse(between(content(folder / "page/contents.js"), "loftContents(", ");\n"));
  EXPECT_EQ(contents["slabs"].size(), 2U);
  EXPECT_EQ(contents["reset"]["name"], "cubes.glb");
  EXPECT_EQ(contents["slabs"][0].get<std::string>().substr(0, 5), "Z2xUR");  // glTF

  const Outcome refused = run(folder, "view cubes.ply --export page");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("page is not empty"));
  EXPECT_FALSE(std::filesystem::exists(folder / "page/surface.ply"));
  EXPECT_EQ(run(folder, "view cubes.ply --export page --force").exit_code, 0);
  EXPECT_EQ(content(folder / "page/surface.ply"), content(folder / "cubes.ply"));
  EXPECT_EQ(run(folder, "view cubes.ply --export cubes.glb").exit_code, 2);
  EXPECT_EQ(run(folder, "view cubes.ndjson --export contours").exit_code, 0);
}

TEST(View, SaysWhatItCannotShow) {
  const Folder folder;
  std::ofstream(folder / "words.txt") << "nothing to be seen";
  for (const char* file : {"words.txt", "nothing.ply", "nothing"}) {
    const Outcome outcome = run(folder, std::string("view --port 0 ") + file);
    EXPECT_EQ(outcome.exit_code, 3) << file;
    EXPECT_THAT(outcome.err, HasSubstr(file));
  }
}

}  // namespace
}  // namespace loft::app
