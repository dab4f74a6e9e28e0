// SPDX-License-Identifier: MIT
// Every door that numbers come in by admits what mesh/admitted.h says, and nothing else: a number
// beyond it is refused with its place, the largest and smallest make a surface that can be checked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/bytes/little_endian.h"
#include "io/contours/cli.h"
#include "io/contours/csl.h"
#include "io/contours/csv.h"
#include "io/contours/jser.h"
#include "io/contours/nuages.h"
#include "io/contours/terrain.h"
#include "io/meshes/obj.h"
#include "io/meshes/off.h"
#include "io/meshes/ply.h"
#include "io/meshes/stl.h"
#include "io/planar/features_geojson.h"
#include "io/planar/moving_ai.h"
#include "io/planar/path_queries.h"
#include "io/planar/point_table.h"
#include "io/planar/points_csv.h"
#include "io/planar/polylines_geojson.h"
#include "io/planar/polylines_text.h"
#include "io/planar/scene_edits.h"
#include "io/stacks/edit.h"
#include "io/stacks/slices_json.h"
#include "mesh/admitted.h"
#include "mesh/check.h"
#include "mesh/measure.h"
#include "reconstruct/number_text.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/reconstruction.h"

namespace loft {
namespace {

using cdt::Point;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Just outside of a range, and far from it.
std::vector<double> beyond(const Range& range) {
  std::vector<double> all{nan,
                          infinity,
                          -infinity,
                          1e308,
                          -1e308,
                          5e-324,
                          -5e-324,
                          std::nextafter(range.largest, infinity),
                          -1e3 * range.largest,
                          std::nextafter(range.smallest, 0.0)};
  return all;
}

std::vector<Slice> prism(double z0, double z1, Point corner, double size) {
  const Contour contour{{corner, {corner.x + size, corner.y}, {corner.x, corner.y + size}}, ""};
  return {{z0, {contour}}, {z1, {contour}}};
}

/// What goes wrong; empty if nothing does.
std::string refusal(const std::function<void()>& action) {
  try {
    action();
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

void expect_named(const std::string& words, const std::string& place, double value) {
  EXPECT_NE(words.find(place), std::string::npos) << exact(value) << ": '" << words << "'";
}

TEST(Doors, StacksRefuseNumbersWithTheirPlaces) {
  for (const double bad : beyond(admitted::slice)) {
    for (const LinkRule link : {LinkRule::automatic, LinkRule::overlap, LinkRule::none}) {
      auto slices = prism(0, 1, {1, 1}, 2);
      slices[1].z = bad;
      expect_named(refusal([&] { static_cast<void>(reconstruct(slices, {.link = link})); }),
                   "slice 1 (z = ", bad);
      for (double Point::*axis : {&Point::x, &Point::y}) {
        slices = prism(0, 1, {1, 1}, 2);
        slices[1].contours[0].points[2].*axis = bad;
        expect_named(refusal([&] { static_cast<void>(reconstruct(slices, {.link = link})); }),
                     "slice 1 (z = 1) contour 0 point 2: a coordinate", bad);
      }
    }
  }
}

TEST(Doors, LiveStacksRefuseNumbersAndStayAsTheyWere) {
  for (const double bad : beyond(admitted::slice)) {
    Reconstruction live;
    for (const Slice& slice : prism(0, 1, {1, 1}, 2)) live.insert(slice);
    const double volume = live.volume();
    Slice slice = prism(2, 3, {1, 1}, 2)[0];
    slice.contours[0].points[1].y = bad;
    expect_named(refusal([&] { live.insert(slice); }), "contour 0 point 1", bad);
    expect_named(refusal([&] { live.replace(1, slice); }), "contour 0 point 1", bad);
    slice = prism(bad, 3, {1, 1}, 2)[0];
    expect_named(refusal([&] { live.insert(slice); }), "the height", bad);
    EXPECT_EQ(live.volume(), volume);
  }
}

TEST(Doors, OptionsRefuseLengthsByName) {
  struct Door {
    const char* name;
    std::optional<double> Options::*option;
    bool admits_zero;
  };
  for (const Door& door :
       {Door{"keyhole_width", &Options::keyhole_width, true},
        Door{"max_edge", &Options::max_edge, false},
        Door{"target_edge", &Options::target_edge, false},
        Door{"simplify", &Options::simplify, true}, Door{"max_shift", &Options::max_shift, true},
        Door{"smooth_tolerance", &Options::smooth_tolerance, true}}) {
    std::vector<double> bad = beyond(admitted::length);
    bad.push_back(-1);
    if (!door.admits_zero) bad.push_back(0);
    for (const double value : bad) {
      Options options;
      options.*door.option = value;
      expect_named(refusal([&] {
                     static_cast<void>(reconstruct(prism(0, 1, {1, 1}, 2), options));
                   }),
                   door.name, value);
    }
    Options options;
    options.*door.option = admitted::length.largest;
    EXPECT_EQ(refusal([&] {
                static_cast<void>(reconstruct(prism(0, 1, {1, 1}, 2), options));
              }),
              "")
        << door.name;
  }
}

TEST(Doors, ExtremesThatAreAdmittedMakeValidSurfaces) {
  const double large = admitted::slice.largest;
  const double small = admitted::slice.smallest;
  const std::vector<std::vector<Slice>> stacks{
      prism(-large, large, {-large, -large}, large),
      prism(0, small, {0, 0}, small),
      prism(small, 3 * small, {small, -small}, 2 * small),
      prism(0, small, {-1, -1}, 2),
      prism(-large, large, {small, small}, small),
      // Crossings of far larger sides may be nearer to 0 than check() can hold.
      {{0, {{{{-1, -1}, {1, -1}, {1, 1}}, ""}}}, {small, {{{{-1, 1}, {1, -1}, {0, small}}, ""}}}}};
  for (std::size_t i = 0; i < stacks.size(); ++i) {
    for (const LinkRule link : {LinkRule::automatic, LinkRule::overlap, LinkRule::none}) {
      for (const Cap cap : {Cap::flat, Cap::dome}) {
        for (const bool smooth : {false, true}) {
          const Options options{.cap = cap, .smooth = smooth, .link = link};
          const std::string wrong = refusal([&] {
            for (const Finding& finding : check(to_mesh(reconstruct(stacks[i], options).surface)))
              ADD_FAILURE() << "stack " << i << ' ' << name(finding.fault);
          });
          EXPECT_TRUE(wrong.empty() || wrong.starts_with("slice ")) << "stack " << i << wrong;
        }
      }
    }
  }
}

TEST(Doors, LinesOfNumbersBeyondDoubleAreRefused) {
  for (const char* bad : {"NaN", "Infinity", "-Infinity", "1e999", "nan", "null", "\"1\""}) {
    const std::string number(bad);
    const std::vector<std::string> lines{
        "{\"z\": " + number + ", \"contours\": []}",
        "{\"z\": 1, \"contours\": [[[0, 0], [1, " + number + "], [1, 1]]]}",
        "{\"op\": \"remove\", \"z\": " + number + "}"};
    for (const std::string& line : lines)
      EXPECT_FALSE(io::parse_edit_line(line).problems.empty()) << line;
    std::istringstream in(lines[1]);
    expect_named(refusal([&] { static_cast<void>(io::read_slices_json(in, "a.ndjson")); }),
                 "a.ndjson:1: slice 0 (z = 1) contour 0 point 1", 0);
  }
}

TEST(Doors, FilesOfStacksRefuseNumbersWithTheirPlaces) {
  struct Door {
    Stack (*read)(const io::StackInput&, const io::ReadOptions&);
    const char* before;
    const char* after;
    const char* place;
  };
  for (const Door& door :
       {Door{io::read_csv, "x y z\n0 0 1\n1 ", " 1\n0 1 1\n", "a.file:3: y"},
        Door{io::read_nuages, "S 1\nv 3 z 0\n{\n0 0\n1 0\n0 ", "\n}\n", "a.file:6: y"},
        Door{io::read_csl, "CSLC\n1 2\n1 3 1 0 0 1 0\n0 0 0\n1 0 ", "\n0 1 0\n3 1 0 1 2\n",
             "a.file:5: a coordinate"},
        Door{io::read_contour, "1\n0 0 1 0\n3 3\n0 0 0\n1 0 0\n0 ",
             " 0\n0 1 1 0\n1 2 1 0\n2 0 1 0\n", "a.file:6: a coordinate"},
        Door{io::read_cli,
             "$$HEADERSTART\n$$UNITS/1\n$$HEADEREND\n$$LAYER/0\n$$POLYLINE/1,1,3,0,0,", ",0,0,1\n",
             "a.file: line 5: "},
        Door{io::read_jser, R"({"sections":[{"thickness":1,"contours":{"a":[[[0,1,0],[0,0,)",
             R"(],[0,0,0],true,false,false]]}}]})", "a.file: section 0: 'a' trace 0: y"},
        Door{io::read_terrain, R"({"type":"LineString","coordinates":[[0,0,1],[1,)",
             R"(,2],[0,1,1],[0,0,1]]})", "a.file: "},
        Door{io::read_terrain, R"({"type":"LineString","coordinates":[[0,0,1],[1,0,)",
             R"(],[0,1,1],[0,0,1]]})", "a.file: geometry: height: "}}) {
    for (const double bad : beyond(admitted::slice)) {
      const std::string text = door.before + exact(bad) + door.after;
      expect_named(refusal([&] {
                     static_cast<void>(door.read({text, "a.file"}, {}));
                   }),
                   door.place, bad);
    }
  }
}

TEST(Doors, PolylinesRefuseCoordinatesWithTheirPlaces) {
  for (const double bad : beyond(admitted::planar)) {
    const std::string text = "2 0\n0 0\n" + exact(bad) + " 1\n";
    expect_named(refusal([&] { static_cast<void>(io::read_polylines_text(text, "a.txt")); }),
                 "a.txt:3", bad);
    const std::string json =
        R"({"type": "LineString", "coordinates": [[0, 0], [1, )" + exact(bad) + "]]}";
    EXPECT_NE(refusal([&] { static_cast<void>(io::read_polylines_geojson(json, "a.geojson")); }),
              "")
        << bad;
    EXPECT_NE(refusal([&] { static_cast<void>(io::read_features_geojson(json, "a.geojson")); }), "")
        << bad;
    const std::string table = "x,y\n0,0\n1," + exact(bad) + "\n";
    expect_named(refusal([&] { static_cast<void>(io::read_points_csv(table, "a.csv")); }),
                 "a.csv:3", bad);
    expect_named(refusal([&] { static_cast<void>(io::read_point_table_csv(table, "a.csv", {})); }),
                 "a.csv:3: y", bad);
  }
  for (const double bad : beyond(admitted::planar))
    EXPECT_THROW(cdt::Triangulation().insert(Point{bad, 0}), std::invalid_argument) << bad;
  for (const double bad : {nan, infinity, -1.0, 1e76})
    EXPECT_THROW(cdt::Triangulation{bad}, std::invalid_argument) << bad;
}

TEST(Doors, ScenesRefuseNumbersWithTheirPlaces) {
  for (const double bad : beyond(admitted::planar)) {
    const std::string table = "0,0,1," + exact(bad) + "\n";
    expect_named(refusal([&] { static_cast<void>(io::read_path_queries_csv(table, "a.csv")); }),
                 "a.csv:1: y1", bad);
    const std::string scenario = "version 1\n0 a 1 1 0 " + exact(bad) + " 1 1 1\n";
    expect_named(
        refusal([&] { static_cast<void>(io::read_moving_ai_scenario(scenario, "a.scen")); }),
        "a.scen:2: y0", bad);
    const std::string edit = R"({"move": "a", "by": [0, )" + exact(bad) + "]}";
    expect_named(refusal([&] { static_cast<void>(io::read_scene_edits(edit, "a.ndjson")); }),
                 "a.ndjson:1: \"by\"", bad);
  }
  std::vector<double> lengths = beyond(admitted::length);
  lengths.push_back(-1);
  for (const double bad : lengths) {
    const std::string table = "0,0,1,1," + exact(bad) + "\n";
    expect_named(refusal([&] { static_cast<void>(io::read_path_queries_csv(table, "a.csv")); }),
                 "a.csv:1: radius", bad);
  }
}

std::string ply(const std::string& number) {
  return "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\n"
         "property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0\n1 0 0\n0 1 0\n0 0 " +
         number + "\n0 0 1\n3 0 2 1\n3 0 1 4\n3 1 2 3\n3 0 3 2\n";
}

std::string stl(double number) {
  std::string bytes(84, '\0');
  io::put(bytes.data() + 80, std::uint32_t{1});
  for (const double value : {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, number, 1.0}) {
    bytes.resize(bytes.size() + 4);
    io::put(bytes.data() + bytes.size() - 4, static_cast<float>(value));
  }
  return bytes + std::string(2, '\0');
}

/// Whatever is in a mesh, check() tells, and the rest is tested.
TEST(Doors, MeshesAreReadAndTheCheckNamesWhatExactTestsCannotHold) {
  const auto has_fault = [](const std::vector<io::LabelledMesh>& meshes) {
    const auto findings = check(meshes.front().mesh);
    const Angles angles = measure(meshes.front().mesh).angles;
    EXPECT_TRUE(angles.smallest >= 0 && angles.median <= 60.01);
    return std::ranges::any_of(findings, [](const Finding& finding) {
      return finding.fault == Fault::out_of_range || finding.fault == Fault::not_finite;
    });
  };
  for (const double bad : beyond(admitted::mesh)) {
    const std::string text = exact(bad);
    EXPECT_TRUE(has_fault(io::read_ply(ply(text), "a.ply"))) << bad;
    EXPECT_TRUE(has_fault(io::read_obj("v 0 0 0\nv 1 0 0\nv 0 1 " + text + "\nf 1 2 3\n", "a.obj")))
        << bad;
    EXPECT_TRUE(
        has_fault(io::read_off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 " + text + "\n3 0 1 2\n", "a.off")))
        << bad;
  }
  for (const double bad : {nan, infinity, -infinity})
    EXPECT_TRUE(has_fault(io::read_stl(stl(bad), "a.stl"))) << bad;
  for (const double good : {0.0, 1e-45, -3e38})
    EXPECT_FALSE(has_fault(io::read_stl(stl(good), "a.stl"))) << good;
  for (const double good : {admitted::mesh.largest, -admitted::mesh.smallest, 0.0})
    EXPECT_FALSE(has_fault(io::read_ply(ply(exact(good)), "a.ply"))) << good;
}

TEST(Doors, TheRestOfAMeshIsTestedWhereACoordinateIsOutOfRange) {
  const auto findings = check(io::read_ply(ply("1e308"), "a.ply").front().mesh);
  std::vector<Fault> faults;
  for (const Finding& finding : findings) faults.push_back(finding.fault);
  EXPECT_EQ(std::ranges::count(faults, Fault::out_of_range), 1);
  EXPECT_GT(std::ranges::count(faults, Fault::boundary_edge), 0);
}

}  // namespace
}  // namespace loft
