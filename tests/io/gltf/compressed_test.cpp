// SPDX-License-Identifier: MIT
// Smaller numbers, written and read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "io/bytes/little_endian.h"
#include "io/gltf/gltf.h"
#include "io/gltf/meshopt.h"
#include "io/meshes/grid.h"
#include "io/meshes/part.h"
#include "io/stack.h"
#include "io/surfaces.h"
#include "mesh/vec3.h"
#include "reconstruct/defect.h"
#include "reconstruct/reconstruct.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using testing::message_of;
using testing::prism;

std::vector<Compression> compressions() {
  if (!has_meshopt()) return {Compression::quantize};
  return {Compression::quantize, Compression::meshopt};
}

std::string glb_of(const std::vector<Part>& parts, Compression compression) {
  std::ostringstream out;
  write_glb(out, parts, {.compression = compression});
  return out.str();
}

std::vector<LabelledMesh> meshes_in(const std::string& bytes) {
  return read_gltf(bytes, "/nowhere", "a.glb");
}

/// The farthest that a point of one mesh is from the nearest of another.
double distance(const Mesh& from, const Mesh& to) {
  double most = 0;
  for (const Vec3& point : from.points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& other : to.points) nearest = std::min(nearest, length(minus(point, other)));
    most = std::max(most, nearest);
  }
  return most;
}

TEST(Compressed, ComesBackWithinTheErrorThatIsTold) {
  const Surface left = prism(40, {0, 0, 0}, 3);
  const Surface right = prism(9, {6, 1, 2}, 2);
  const std::vector<Part> parts{{"left", &left}, {"right", &right}};
  const double error = quantisation_error(parts);
  EXPECT_GT(error, 0);
  EXPECT_LT(error, 2 * 10.0 / 0xffff * 0.87);  // half a step along each axis
  for (const Compression how : compressions()) {
    const auto meshes = meshes_in(glb_of(parts, how));
    ASSERT_EQ(meshes.size(), 2U);
    EXPECT_EQ(meshes[1].label, "right");
    for (std::size_t i = 0; i < 2; ++i) {
      const Mesh expected = to_mesh(*parts[i].surface);
      EXPECT_EQ(meshes[i].mesh.points.size(), expected.points.size()) << "seams are closed";
      EXPECT_EQ(meshes[i].mesh.faces.size(), expected.faces.size());
      EXPECT_LE(distance(expected, meshes[i].mesh), error * (1 + 1e-9) + 1e-12);
      EXPECT_TRUE(check(meshes[i].mesh).empty());
    }
  }
}

TEST(Grid, EvenLevelsShareTheirLowerByte) {
  for (const double gap : {0.001, 0.37, 1.0, 3.65079}) {
    for (const double lowest : {0.0, 0.3, 7.7}) {
      std::vector<double> levels;
      for (int i = 0; i < 20; ++i) levels.push_back(lowest + gap * i);
      const double high = levels.back() + 0.2;
      Grid grid({-30, 0, -20}, {30, high, 20});
      const double before = grid.step();
      grid.fit(levels, high);
      EXPECT_GE(grid.step(), before);
      EXPECT_LE(grid.step(), 2 * before);
      EXPECT_LE(high, grid.place({0, Grid::last, 0})[1]);
      EXPECT_GE(0, grid.low()[1]);
      if (gap / grid.step() < 255) continue;
      for (const double level : levels) {
        const Grid::Cell cell = grid.cell({0, level, 0});
        EXPECT_EQ(cell[1] % 256, 0) << gap << ' ' << level;
        EXPECT_NEAR(grid.place(cell)[1], level, 1e-9);
      }
    }
  }
}

TEST(Grid, UnevenLevelsChangeNothing) {
  Grid grid({0, 0, 0}, {10, 10, 10});
  const double before = grid.step();
  for (const std::vector<double>& levels :
       {std::vector<double>{}, {1, 2}, {0, 1, 2.5}, {0, 1e-9, 2e-9}}) {
    grid.fit(levels, 10);
    EXPECT_EQ(grid.step(), before);
  }
}

TEST(Compressed, WhatTouchesStillDoes) {
  Surface lower = prism(8, {0, 0, 0}, 1);
  Surface upper = prism(8, {0, 0, 1}, 1);
  for (const Compression how : compressions()) {
    const auto meshes = meshes_in(glb_of({{"a", &lower}, {"b", &upper}}, how));
    std::set<Vec3> shared;
    for (const Vec3& point : meshes[0].mesh.points)
      if (std::ranges::find(meshes[1].mesh.points, point) != meshes[1].mesh.points.end())
        shared.insert(point);
    EXPECT_EQ(shared.size(), 8U);
  }
}

TEST(Compressed, WhatRoundingBreaksIsMended) {
  const Reconstructed skull = reconstruct(read_stack(LOFT_SAMPLES "/skull.ndjson"), {});
  const Part part{"", &skull.surface};
  const WriteOptions options{.compression = Compression::quantize};
  EXPECT_FALSE(check(meshes_in(glb_of({part}, Compression::quantize))[0].mesh).empty());
  std::ostringstream out;
  const Written written = write(out, ".glb", {&part, 1}, options);
  EXPECT_GT(written.rounding.faults, 0U);
  EXPECT_EQ(written.rounding.left, 0U);
  EXPECT_TRUE(check(meshes_in(out.str())[0].mesh).empty());
}

TEST(Compressed, PointsAndPlanesHaveAGrid) {
  Surface flat;  // no height, far away
  flat.add_face(flat.add_vertex({1e6, 1e6, 5}), flat.add_vertex({1e6 + 1, 1e6, 5}),
                flat.add_vertex({1e6, 1e6 + 1, 5}));
  Surface point;
  point.add_face(point.add_vertex({3, 3, 3}), point.add_vertex({3, 3, 3}),
                 point.add_vertex({3, 3, 3}));
  for (const Compression how : compressions()) {
    const Mesh mesh = meshes_in(glb_of({{"", &flat}}, how))[0].mesh;
    EXPECT_LT(distance(to_mesh(flat), mesh), 1e-8);
    EXPECT_NEAR(meshes_in(glb_of({{"", &point}}, how))[0].mesh.points[0][0], 3, 1e-12);
  }
}

TEST(Compressed, TextHoldsTheSame) {
  const Surface surface = prism(12);
  const Part part{"x", &surface};
  for (const Compression how : compressions()) {
    std::ostringstream out;
    write_gltf(out, {&part, 1}, {.compression = how});
    EXPECT_EQ(read_gltf(out.str(), "/nowhere", "a.gltf"), meshes_in(glb_of({part}, how)));
  }
}

TEST(Compressed, IsSmaller) {
  const Surface surface = prism(2000);
  std::size_t before = glb_of({{"", &surface}}, Compression::none).size();
  for (const Compression how : compressions()) {
    const std::size_t size = glb_of({{"", &surface}}, how).size();
    EXPECT_LT(size, before * 8 / 10);
    before = size;
  }
}

TEST(Compressed, ContoursStayLines) {
  const Surface surface = prism(3);
  Part part{"x", &surface};
  part.contours = {{0, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {1, {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}}};
  for (const Compression how : compressions()) {
    const auto meshes = meshes_in(glb_of({part}, how));
    ASSERT_EQ(meshes.size(), 1U) << "lines are no surface";
    EXPECT_EQ(meshes[0].mesh.faces.size(), surface.n_faces());
  }
}

TEST(Compressed, ReadsNormalizedIntegersOfEachKind) {
  // One triangle: 0, 0, 0; most, 0, 0; 0, most, 0; rows of four numbers.
  const auto point_of = [](int type, const std::string& base64, int stride, int size) {
    const std::string text =
        R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
        R"({"POSITION":0}}]}],"buffers":[{"byteLength":)" +
        std::to_string(size) + R"(,"uri":"data:application/octet-stream;base64,)" + base64 +
        R"("}],"bufferViews":[{"buffer":0,"byteStride":)" + std::to_string(stride) +
        R"(,"byteLength":)" + std::to_string(size) +
        R"(}],"accessors":[{"bufferView":0,"normalized":true,"componentType":)" +
        std::to_string(type) + R"(,"count":3,"type":"VEC3"}]})";
    return read_gltf(text, "/nowhere", "a.gltf")[0].mesh.points;
  };
  const std::vector<Vec3> expected{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  EXPECT_EQ(point_of(5120, "AAAAAH8AAAAAfwAA", 4, 12), expected);
  EXPECT_EQ(point_of(5121, "AAAAAP8AAAAA/wAA", 4, 12), expected);
  EXPECT_EQ(point_of(5122, "AAAAAAAAAAD/fwAAAAAAAAAA/38AAAAA", 8, 24), expected);
  EXPECT_EQ(point_of(5123, "AAAAAAAAAAD//wAAAAAAAAAA//8AAAAA", 8, 24), expected);
}

TEST(Compressed, BrokenFilesAreRefusedNotTrusted) {
  const Surface surface = prism(30);
  std::mt19937_64 random(7);
  for (const Compression how : compressions()) {
    const std::string whole = glb_of({{"x", &surface}}, how);
    const auto try_to_read = [](const std::string& bytes) {
      try {
        static_cast<void>(meshes_in(bytes));
      } catch (const InputError&) {
      }
    };
    for (std::size_t size = 0; size < whole.size(); ++size) try_to_read(whole.substr(0, size));
    for (int i = 0; i < 2000; ++i) {
      std::string damaged = whole;
      for (int k = 0; k < 3; ++k)
        damaged[random() % damaged.size()] = static_cast<char>(random() & 0xffU);
      try_to_read(damaged);
    }
  }
}

// tinygltf 2.7 let a chunk of bytes be 8 bytes longer than the file, and read these.
TEST(Gltf, AChunkOfBytesBeyondTheEndIsRefused) {
  const Surface surface = prism(5);
  const std::string whole = glb_of({{"x", &surface}}, Compression::none);
  const std::size_t json_size = get<std::uint32_t>(whole.data() + 12);
  const std::size_t bytes_size = get<std::uint32_t>(whole.data() + 20 + json_size);
  for (const std::uint32_t more : {4U, 8U, 12U}) {
    std::string damaged = whole;
    put(damaged.data() + 20 + json_size, static_cast<std::uint32_t>(bytes_size + more));
    const auto read = [&] { static_cast<void>(meshes_in(damaged)); };
    EXPECT_THAT(message_of<InputError>(read), ::testing::HasSubstr("cut off"));
  }
}

TEST(Compressed, CountsBeyondTheBytesAreRefused) {
  if (!has_meshopt()) GTEST_SKIP();
  const Surface surface = prism(30);
  std::ostringstream out;
  const Part part{"", &surface};
  write_gltf(out, {&part, 1}, {.compression = Compression::meshopt});
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = out.str();
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    text.replace(place, from.size(), to);
    return message_of<InputError>([&] { static_cast<void>(read_gltf(text, "/nowhere", "a")); });
  };
  EXPECT_EQ(with(R"("count":120,"mode")", R"("count":4000000000,"mode")"),
            "a: buffer view 0: its packing cannot be");
  EXPECT_EQ(with(R"("mode":"ATTRIBUTES")", R"("mode":"TRIANGLES")"),
            "a: buffer view 0: its packing cannot be");
  EXPECT_EQ(with(R"("mode":"ATTRIBUTES")", R"("mode":"OTHER")"),
            "a: buffer view 0: there is no such \"mode\"");
  EXPECT_EQ(with(R"("filter":"OCTAHEDRAL")", R"("filter":"X")"),
            "a: buffer view 1: there is no such \"filter\"");
}

}  // namespace
}  // namespace loft::io
