// SPDX-License-Identifier: MIT
#include "io/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "io/bytes/file.h"
#include "io/bytes/little_endian.h"
#include "io/meshes/label_colour.h"
#include "io/surfaces.h"
#include "reconstruct/defect.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using testing::Folder;
using testing::message_of;
using testing::prism;

const std::vector<std::string> extensions{".ply", ".obj", ".off", ".stl", ".glb", ".gltf"};

/// The faces as triples of places, in a canonical order, so that numbering does not matter.
std::vector<std::array<Vec3, 3>> triangles(const Mesh& mesh) {
  std::vector<std::array<Vec3, 3>> result;
  for (const auto& [a, b, c] : mesh.faces) {
    std::array<Vec3, 3> triangle{mesh.points[a], mesh.points[b], mesh.points[c]};
    std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
    result.push_back(triangle);
  }
  std::ranges::sort(result);
  return result;
}

TEST(Meshes, TextAndPlyComeBackExactly) {
  const Folder folder;
  const Surface surface = prism(7, {1e6 + 0.1, -1.0 / 3, 1e-9});
  const Part part{"", &surface};
  for (const char* name : {"a.ply", "a.obj", "a.off"}) {
    write(folder / name, {&part, 1});
    EXPECT_EQ(read_mesh(folder / name), to_mesh(surface)) << name;
    EXPECT_TRUE(keeps_coordinates(folder / name));
  }
}

TEST(Meshes, FloatFormatsComeBackWithTheSameFaces) {
  const Folder folder;
  const Surface surface = prism(16, {0, 0, 0}, 0.5);
  const Part part{"", &surface};
  for (const char* name : {"a.stl", "a.glb", "a.gltf"}) {
    write(folder / name, {&part, 1});
    const auto read = triangles(read_mesh(folder / name));
    const auto expected = triangles(to_mesh(surface));
    ASSERT_EQ(read_mesh(folder / name).points.size(), 32U) << name;
    ASSERT_EQ(read.size(), expected.size()) << name;
    for (const auto& triangle : expected) {
      const bool is_there = std::ranges::any_of(read, [&](const auto& other) {
        for (std::size_t i = 0; i < 9; ++i) {
          if (std::abs(triangle[i / 3][i % 3] - other[i / 3][i % 3]) > 1e-6) return false;
        }
        return true;
      });
      EXPECT_TRUE(is_there) << name;
    }
    EXPECT_FALSE(keeps_coordinates(folder / name));
  }
}

TEST(Meshes, LabelsSplitTheMeshWhereTheFormatKeepsThem) {
  const Folder folder;
  const Surface one = prism(3);
  const Surface two = prism(5, {1, 0, 0});
  const std::vector<Part> parts{{"left lung", &one}, {"r\xc3\xa9 2", &two}};
  for (const std::string& extension : extensions) {
    const auto path = folder / ("a" + extension);
    write(path, parts);
    const std::vector<LabelledMesh> meshes = read_meshes(path);
    if (extension == ".off" || extension == ".stl") {
      ASSERT_EQ(meshes.size(), 1U) << extension;
    } else {
      ASSERT_EQ(meshes.size(), 2U) << extension;
      EXPECT_EQ(meshes[0].label, "left lung") << extension;
      EXPECT_EQ(meshes[1].label, "r\xc3\xa9 2") << extension;
      EXPECT_EQ(meshes[0].mesh.points.size(), 6U) << extension;
      EXPECT_EQ(meshes[1].mesh.points.size(), 10U) << extension;
    }
    EXPECT_EQ(read_mesh(path).faces.size(), one.n_faces() + two.n_faces()) << extension;
  }
}

TEST(Meshes, HaveTheColoursOfTheirLabels) {
  const Folder folder;
  const Surface one = prism(3);
  const Surface two = prism(5, {1, 0, 0});
  const Colour red{0xd0, 0x20, 0x30};
  const std::vector<Part> parts{{"heart", &one, red}, {"lung", &two}};
  for (const char* name : {"a.ply", "a.glb", "a.gltf"}) {
    write(folder / name, parts);
    const std::vector<LabelledMesh> meshes = read_meshes(folder / name);
    ASSERT_EQ(meshes.size(), 2U) << name;
    EXPECT_EQ(meshes[0].colour, red) << name;
    EXPECT_EQ(meshes[1].colour, colour_of(parts[1])) << name;
  }
  write(folder / "a.off", parts);
  EXPECT_EQ(read_meshes(folder / "a.off")[0].colour, std::nullopt);
}

TEST(Meshes, SeveralColoursOfOneMeshAreNone) {
  const Folder folder;
  const auto ply = [&](const char* last) {
    return folder.write("a.ply",
                        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                        "property float y\nproperty float z\nproperty uchar red\n"
                        "property uchar green\nproperty uchar blue\nelement face 1\n"
                        "property list uchar int vertex_indices\nend_header\n"
                        "0 0 0 9 8 7\n1 0 0 9 8 7\n0 1 0 " +
                            std::string(last) + "\n3 0 1 2\n");
  };
  EXPECT_EQ(read_meshes(ply("9 8 7"))[0].colour, (Colour{9, 8, 7}));
  EXPECT_EQ(read_meshes(ply("9 8 6"))[0].colour, std::nullopt);
  EXPECT_EQ(read_meshes(ply("1e9 -8 nan"))[0].colour, std::nullopt);
}

TEST(Meshes, ReadsAsciiPlyWithOtherElementsAndProperties) {
  const Folder folder;
  const auto path = folder.write("a.ply",
                                 "ply\r\nformat ascii 1.0\r\nobj_info x\r\nelement material 1\r\n"
                                 "property list uchar float a\r\nproperty int b\r\n"
                                 "element vertex 4\r\nproperty uchar red\r\nproperty float z\r\n"
                                 "property float y\r\nproperty float x\r\nelement face 1\r\n"
                                 "property list uchar uint vertex_index\r\nproperty uchar q\r\n"
                                 "end_header\r\n2 1 2 7\r\n"
                                 "9 0 0 0\r\n9 0 0 1\r\n9 0 1 1\r\n9 0.5 1 0\r\n4 0 1 2 3 8\r\n");
  const Mesh expected{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}}, {{0, 1, 2}, {0, 2, 3}}};
  EXPECT_EQ(read_mesh(path), expected);
}

TEST(Meshes, ReadsBigEndianPly) {
  const Folder folder;
  const auto big = [](auto number) {
    std::string bytes(sizeof number, '\0');
    put(bytes.data(), number);
    std::ranges::reverse(bytes);
    return bytes;
  };
  std::string text =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty double y\n"
      "property short z\nelement face 1\nproperty list uchar ushort vertex_indices\nend_header\n";
  text += big(0.0F) + big(0.0) + big(std::int16_t{0});
  text += big(0.5F) + big(0.1) + big(std::int16_t{-1});
  text += big(1.0F) + big(0.4) + big(std::int16_t{-300});
  text += big(std::uint8_t{3}) + big(std::uint16_t{2}) + big(std::uint16_t{1});
  text += big(std::uint16_t{0});
  const Mesh expected{{{0, 0, 0}, {0.5, 0.1, -1}, {1, 0.4, -300}}, {{2, 1, 0}}};
  EXPECT_EQ(read_mesh(folder.write("a.ply", text)), expected);
}

TEST(Meshes, ReadsObjWithRelativeIndicesAndTextures) {
  const Folder folder;
  const auto path = folder.write("a.obj",
                                 "mtllib x.mtl # comment\nv 0 0 0 0.5 0.5 0.5\nv 1 0 0\nv 1 1 0\n"
                                 "vt 0 0\nvn 0 0 1\no a\nf 1/1/1 2//1 3/1\nl 1 2\no b\n"
                                 "v 0 1 0\nf -4 -2 -1\n");
  const Mesh expected{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  EXPECT_EQ(read_mesh(path), expected);
}

TEST(Meshes, ReadsOffWithColoursAndComments) {
  const Folder folder;
  const auto path = folder.write("a.off",
                                 "COFF # x\n# y\n4 1 0\n0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n"
                                 "1 1 0 1 1 1 1\n0 1 0 1 1 1 1\n4 0 1 2 3 255 0 0\n");
  const Mesh expected{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  EXPECT_EQ(read_mesh(path), expected);
}

TEST(Meshes, ReadsAsciiStl) {
  const Folder folder;
  const std::string facet =
      "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 1 1 0\n endloop\n"
      "endfacet\nfacet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 1 0\n  vertex 0 1 0\n"
      " endloop\nendfacet\n";
  const Mesh expected{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  EXPECT_EQ(read_mesh(folder.write("a.stl", "solid a b\n" + facet + "endsolid a b\n")), expected);
}

struct Bad {
  const char* name;
  const char* text;
  const char* message;  ///< behind the file's name
};

TEST(Meshes, NamesFileAndPlaceOfWhatIsWrong) {
  const std::string triangle = "0 0 0\n1 0 0\n0 1 0\n";
  const Bad cases[] = {
      {"a.ply", "plx\n", ":1: does not begin with 'ply'"},
      {"a.ply", "ply\nformat ascii 1.0\n", ":2: the file ends in its header"},
      {"a.ply", "ply\nformat odd 1.0\n", ":2: 'odd' is no format of PLY"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\n",
       ":4: 'quad' is no number type of PLY"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nend_header\n0\n",
       ":5: element vertex has no property y"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\nproperty int z\n"
       "end_header\n0 0\n",
       ":8: the file ends where a number should be"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\nproperty int z\n"
       "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n3 0 77 0\n",
       ": triangle 0 names vertex 77, but there are only 1"},
      {"a.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty int x\n"
       "property int y\nproperty int z\nend_header\n0123",
       ": byte 122: the file ends in the middle"},
      {"a.obj", "v 0 0 x\n", ":1: expected z, found 'x'"},
      {"a.obj", "v 0 0 0\nf 1 2 0\n", ":2: there is no vertex 0"},
      {"a.obj", "v 0 0 0\nf 1 2\n", ":2: a face of 2 corners"},
      {"a.obj", "v 0 0 0\n", ": no faces in it"},
      {"a.off", "PLY\n", ":1: does not begin with 'OFF'"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n", ":3: the file ends where a vertex should be"},
      {"a.off", "OFF BINARY\n", ":1: binary OFF cannot be read; convert it to PLY"},
      {"a.stl", "x", ": neither ASCII STL nor binary of the size it says; is it cut off?"},
      {"a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n",
       ":4: the file ends where z should be"},
      {"a.glb", "glTF", ": not glTF: cut off"},
  };
  const Folder folder;
  for (const auto& [name, text, message] : cases) {
    const auto path = folder.write(name, text);
    EXPECT_EQ(message_of<InputError>([&] { static_cast<void>(read_mesh(path)); }),
              path.string() + message)
        << text;
  }
}

/// Either a mesh with valid indices, or an InputError: never a crash, never a huge allocation.
void expect_survival(const std::filesystem::path& path) {
  try {
    const Mesh mesh = read_mesh(path);
    for (const auto& face : mesh.faces) {
      for (const std::uint32_t corner : face) ASSERT_LT(corner, mesh.points.size()) << path;
    }
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string_view(error.what()).starts_with(path.string())) << error.what();
  }
}

std::string small_file(const Folder& folder, const std::string& extension) {
  const Surface surface = prism(3);
  const std::vector<Part> parts{{"a", &surface}, {"b", &surface}};
  write(folder / ("good" + extension), parts);
  return testing::content(folder / ("good" + extension));
}

TEST(Meshes, SurvivesTruncationAtEveryByte) {
  const Folder folder;
  for (const std::string& extension : extensions) {
    const std::string good = small_file(folder, extension);
    for (std::size_t size = 0; size < good.size(); ++size) {
      expect_survival(folder.write("bad" + extension, good.substr(0, size)));
    }
  }
}

TEST(Meshes, SurvivesRandomDamage) {
  const Folder folder;
  for (const std::string& extension : extensions) {
    const std::string good = small_file(folder, extension);
    std::mt19937 random(7);
    for (int round = 0; round < 2000; ++round) {
      std::string bad = good;
      for (int edits = 1 + static_cast<int>(random() % 3); edits > 0; --edits) {
        const bool is_digit = random() % 2 == 0;
        bad[random() % bad.size()] =
            static_cast<char>(is_digit ? '0' + random() % 10 : random() % 256);
      }
      expect_survival(folder.write("bad" + extension, bad));
    }
  }
}

TEST(Meshes, MissingFilesAndUnknownExtensionsAreNamed) {
  const Folder folder;
  for (const std::string& extension : extensions) {
    const auto path = folder / ("none" + extension);
    EXPECT_EQ(message_of<FileError>([&] { static_cast<void>(read_mesh(path)); }),
              "cannot read " + path.string() + ": No such file or directory");
  }
  const auto path = folder.write("a.vtk", "");
  EXPECT_EQ(message_of<UnknownFormat>([&] { static_cast<void>(read_mesh(path)); }),
            path.string() + ": unknown extension '.vtk'; known are .ply .obj .off .stl .glb .gltf");
}

}  // namespace
}  // namespace loft::io
