// SPDX-License-Identifier: MIT
#include "io/surfaces.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <array>
#include <csignal>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/bytes/zip.h"
#include "io/meshes/label_colour.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using testing::Folder;
using testing::message_of;
using testing::prism;

TEST(Surfaces, TheSameSurfacesGiveTheSameBytes) {
  const Folder folder;
  const Surface surface = prism(9, {1, 2, 3});
  const std::vector<Part> parts{{"one", &surface}, {"two", &surface}};
  for (const std::string extension : {".glb", ".gltf", ".ply", ".obj", ".stl", ".off", ".3mf"}) {
    if (extension == ".3mf" && !has_zip()) continue;
    for (const char* inner : {"one", "two"}) {
      std::filesystem::create_directories(folder / inner);
      write(folder / inner / ("a" + extension), parts);
    }
    EXPECT_EQ(testing::content(folder / "one" / ("a" + extension)),
              testing::content(folder / "two" / ("a" + extension)));
  }
}

TEST(Surfaces, AnUnknownExtensionNamesTheKnownOnes) {
  const Folder folder;
  const auto path = folder / "a.vtk";
  const std::string message =
      path.string() + ": unknown extension '.vtk'; known are .glb .gltf .ply .obj .stl .off .3mf";
  EXPECT_EQ(message_of<UnknownFormat>([&] { write(path, {}); }), message);
  EXPECT_EQ(message_of<UnknownFormat>([&] { check_writable(path); }), message);
}

TEST(Surfaces, AMissingFolderIsNamed) {
  const Folder folder;
  const auto path = folder / "none" / "a.ply";
  const std::string message = "cannot write " + path.string() + ": folder " +
                              (folder / "none").string() + " does not exist; create it first";
  EXPECT_EQ(message_of<FileError>([&] { write(path, {}); }), message);
  EXPECT_EQ(message_of<FileError>([&] { check_writable(path); }), message);
}

TEST(Surfaces, CheckingLeavesNothingBehind) {
  const Folder folder;
  check_writable(folder / "a.ply");
  EXPECT_EQ(folder.size(), 0U);
}

TEST(Surfaces, AFileThatCannotBeWrittenKeepsTheOldOne) {
  const Folder folder;
  const auto path = folder.write("a.glb", "old");
  EXPECT_NE(message_of<Error>([&] { write(path, {}); }), "nothing");  // no part: glTF needs one
  EXPECT_EQ(testing::content(path), "old");
  EXPECT_EQ(folder.size(), 1U);
}

/// The lines of a text that begin so.
std::vector<std::string> lines_with(const std::string& text, const std::string& begin) {
  std::vector<std::string> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(begin)) found.push_back(line);
  return found;
}

using Lines = std::vector<std::string>;

TEST(Obj, NamesMaterialsInAFileBesideIt) {
  const Folder folder;
  const Surface surface = prism(3);
  const std::vector<Part> parts{{"lung left", &surface, Colour{0xff, 0, 0x80}},
                                {"lung_left", &surface},
                                {"BODY", &surface, {}, {}, "EXTERNAL"}};
  write(folder / "a.obj", parts);
  const std::string obj = testing::content(folder / "a.obj");
  const std::string mtl = testing::content(folder / "a.mtl");
  EXPECT_EQ(lines_with(obj, "mtllib"), Lines{"mtllib a.mtl"});
  EXPECT_EQ(lines_with(obj, "usemtl"),
            (Lines{"usemtl lung_left", "usemtl lung_left_2", "usemtl BODY"}));
  EXPECT_EQ(lines_with(obj, "o "), (Lines{"o lung left", "o lung_left", "o BODY"}));
  EXPECT_EQ(lines_with(mtl, "newmtl"),
            (Lines{"newmtl lung_left", "newmtl lung_left_2", "newmtl BODY"}));
  EXPECT_EQ(lines_with(mtl, "Kd")[0], "Kd 1 0 0.502");
  EXPECT_EQ(lines_with(mtl, "d "), (Lines{"d 1", "d 1", "d 0.25"}));
  EXPECT_EQ(folder.size(), 2U);
}

TEST(Obj, WithoutLabelsOrColoursHasNoMaterials) {
  const Folder folder;
  const Surface surface = prism(3);
  const Part part{"", &surface};
  write(folder / "a.obj", {&part, 1});
  EXPECT_EQ(folder.size(), 1U);
  EXPECT_EQ(lines_with(testing::content(folder / "a.obj"), "mtllib"), Lines{});
}

TEST(Obj, MaterialsHaveNamesWithoutBlanksThatStayApart) {
  const Folder folder;
  const Surface surface = prism(3);
  const Part part{"x", &surface};
  std::set<std::string> names;
  for (const char* name : {"a b.obj", "a_b.obj", "a\tb.obj"}) {
    write(folder / name, {&part, 1});
    const auto line = lines_with(testing::content(folder / name), "mtllib ").at(0).substr(7);
    EXPECT_EQ(line.find_first_of(" \t"), std::string::npos) << line;
    EXPECT_TRUE(std::filesystem::exists(folder / line));
    names.insert(line);
  }
  EXPECT_EQ(names.size(), 3U);
}

TEST(ThreeMf, NeedsFaces) {
  std::ostringstream out;
  EXPECT_THROW(write(out, ".3mf", {}), Error);
}

TEST(AtomicFile, AppearsOnlyWhenItIsComplete) {
  const Folder folder;
  const auto path = folder / "a.txt";
  {
    AtomicFile file(path);
    file.stream() << "half";
  }
  EXPECT_EQ(folder.size(), 0U);
  AtomicFile first(path);
  AtomicFile second(path);
  first.stream() << "first";
  second.stream() << "second";
  EXPECT_FALSE(std::filesystem::exists(path));
  first.commit();
  EXPECT_EQ(testing::content(path), "first");
  second.commit();
  EXPECT_EQ(testing::content(path), "second");
  EXPECT_EQ(folder.size(), 1U);
}

TEST(AtomicFile, WritesIntoAPipeAndLeavesItThere) {
  const Folder folder;
  const auto path = folder / "pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  { const AtomicFile tried(path); }  // waits for no reader
  const int reader = ::open(path.c_str(), O_RDONLY | O_NONBLOCK);
  AtomicFile file(path);
  file.stream() << "through";
  file.commit();
  std::array<char, 16> read{};
  EXPECT_EQ(::read(reader, read.data(), read.size()), 7);
  EXPECT_STREQ(read.data(), "through");
  ::close(reader);
  EXPECT_TRUE(std::filesystem::is_fifo(path));
  EXPECT_EQ(folder.size(), 1U);
}

TEST(AtomicFile, AppendsToWhatADescriptorHasOpen) {
  const Folder folder;
  const auto path = folder.write("a.txt", "before, ");
  const int descriptor = ::open(path.c_str(), O_WRONLY);
  AtomicFile file("/dev/fd/" + std::to_string(descriptor));
  file.stream() << "after";
  file.commit();
  ::close(descriptor);
  EXPECT_EQ(testing::content(path), "before, after");
}

TEST(AtomicFile, ReplacesWhatALinkLeadsTo) {
  const Folder folder;
  std::filesystem::create_directory(folder / "kept");
  std::filesystem::create_symlink("kept/a.txt", folder / "link");
  for (const std::string text : {"new", "newer"}) {
    AtomicFile file(folder / "link");
    EXPECT_EQ(file.temporary().parent_path(), folder / "kept");
    file.stream() << text;
    file.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(testing::content(folder / "kept" / "a.txt"), text);
  }
}

TEST(AtomicFile, HandsOnPermissionsAndRefusesWhatIsReadOnly) {
  const Folder folder;
  const auto path = folder.write("a", "old");
  using std::filesystem::perms;
  std::filesystem::permissions(path, perms(0600));
  {
    AtomicFile file(path);
    EXPECT_EQ(std::filesystem::status(file.temporary()).permissions(), perms(0600));
    file.stream() << "new";
    file.commit();
  }
  EXPECT_EQ(std::filesystem::status(path).permissions(), perms(0600));
  EXPECT_EQ(read_file(path), "new");
  std::filesystem::permissions(path, perms(0444));
  EXPECT_THROW(AtomicFile{path}, FileError);
  EXPECT_EQ(read_file(path), "new");
  EXPECT_EQ(folder.size(), 1U);
}

TEST(AtomicFile, TakesOverWhatAKilledProcessLeft) {
  const Folder folder;
  const auto path = folder / "a.txt";
  const pid_t child = ::fork();
  if (child == 0) {
    AtomicFile file(path);
    file.stream() << "half of something longer" << std::flush;
    ::kill(::getpid(), SIGKILL);
  }
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(folder.size(), 1U);
  AtomicFile file(path);
  file.stream() << "whole";
  file.commit();
  EXPECT_EQ(testing::content(path), "whole");
  EXPECT_EQ(folder.size(), 1U);
}

TEST(Ply, CarriesProvenanceAndLabels) {
  const Folder folder;
  const Surface surface = prism(3);
  const std::vector<Part> parts{{"two\nlines", &surface}};
  write(folder / "a.ply", parts);
  const std::string text = testing::content(folder / "a.ply");
  for (const char* line :
       {"comment label 0 two_lines\n", "element vertex 6\n", "property double x\n",
        "property uchar kind\nproperty int slice\nproperty int contour\nproperty int point\n",
        "property list uchar int vertex_indices\nproperty uchar kind\nproperty int slab\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
}

TEST(Ply, HasTheColoursOfItsLabels) {
  const Folder folder;
  const Surface surface = prism(3);
  const std::vector<Part> parts{{"a", &surface, Colour{1, 2, 3}}, {"b", &surface}};
  write(folder / "a.ply", parts);
  Surface read;
  read.request_vertex_colors();
  OpenMesh::IO::Options wanted(OpenMesh::IO::Options::VertexColor);
  ASSERT_TRUE(OpenMesh::IO::read_mesh(read, (folder / "a.ply").string(), wanted));
  ASSERT_TRUE(wanted.vertex_has_color());
  EXPECT_EQ(read.color(Surface::VertexHandle(0)), Surface::Color(1, 2, 3));
  const Colour other = colour_of(parts[1]);
  EXPECT_EQ(read.color(Surface::VertexHandle(6)),
            Surface::Color(other.red, other.green, other.blue));
}

TEST(Ply, IsReadByOpenMesh) {
  const Folder folder;
  const Surface surface = prism(12, {0.1, 0.2, 0.3});
  const std::vector<Part> parts{{"a", &surface}, {"b", &surface}};
  write(folder / "a.ply", parts);
  Surface read;
  ASSERT_TRUE(OpenMesh::IO::read_mesh(read, (folder / "a.ply").string()));
  EXPECT_EQ(read.n_faces(), 2 * surface.n_faces());
  const Surface::VertexHandle vertex(5);  // OpenMesh reads coordinates as float
  EXPECT_LT((read.point(vertex) - surface.point(vertex)).norm(), 1e-6);
}

}  // namespace
}  // namespace loft::io
