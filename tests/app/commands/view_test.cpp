// SPDX-License-Identifier: MIT
// `loft view`: what a browser gets of a mesh and of a session.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "io/meshes.h"
#include "tests/app/running.h"

namespace loft::app {
namespace {

using namespace testing;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

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
  expect_two_cubes(*client, 0, 0);
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

TEST(View, SaysWhatItCannotShow) {
  const Folder folder;
  std::ofstream(folder / "stack.ndjson") << tower(2);
  for (const char* file : {"stack.ndjson", "nothing.ply", "nothing"}) {
    const Outcome outcome = run(folder, std::string("view --port 0 ") + file);
    EXPECT_EQ(outcome.exit_code, 3) << file;
    EXPECT_THAT(outcome.err, HasSubstr(file));
  }
}

}  // namespace
}  // namespace loft::app
