// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "io/dicom/dicom.h"
#include "io/volumes/outlines.h"
#include "mesh/check.h"
#include "mesh/measure.h"
#include "reconstruct/clean/cleaning.h"
#include "reconstruct/reconstruct.h"
#include "tests/io/dicom/made_dicom.h"
#include "tests/io/volumes/masks.h"
#include "tests/io/volumes/raster.h"

namespace loft::io {
namespace {

using testing::circle;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::MadeContour;
using testing::MadeRoi;
using ::testing::Not;
using testing::problem;
using testing::read;
using testing::structure_set;

const std::vector<double> heights{0, 3, 6, 9, 12};

/// Contours of one ROI.
std::string file_of(std::vector<MadeContour> contours,
                    E_TransferSyntax syntax = EXS_LittleEndianExplicit,
                    E_EncodingType lengths = EET_UndefinedLength) {
  return structure_set({{.number = "3", .name = "organ", .contours = std::move(contours)}}, syntax,
                       lengths);
}

/// A ring by two contours a slice.
std::vector<MadeContour> ring(const std::string& type) {
  std::vector<MadeContour> contours;
  for (const double z : heights) {
    contours.push_back({type, circle(0, 0, 20, z)});
    contours.push_back({type, circle(2, 0, 8, z)});
  }
  return contours;
}

/// The same by one contour with a channel of no width.
std::vector<MadeContour> keyholes() {
  std::vector<MadeContour> contours;
  for (const double z : heights) {
    std::vector<Vec3> points = circle(0, 0, 20, z);
    points.push_back(points.front());
    std::vector<Vec3> hole = circle(2, 0, 8, z);
    points.push_back(hole.front());
    points.insert(points.end(), hole.rbegin(), hole.rend());
    contours.push_back({"CLOSED_PLANAR", points});
  }
  return contours;
}

/// A solid of circles, each point taken somewhere else.
template <class Move>
std::vector<MadeContour> moved_solid(Move move) {
  std::vector<MadeContour> contours;
  for (const double z : heights) {
    std::vector<Vec3> points = circle(1, 2, 15 - z / 4, z);
    for (Vec3& point : points) point = move(point);
    contours.push_back({"CLOSED_PLANAR", points});
  }
  return contours;
}

Vec3 as_it_is(const Vec3& point) { return point; }

Measures measures_of(const Stack& stack) {
  const Surface surface = reconstruct(stack).surface;
  EXPECT_TRUE(check(surface).empty());
  return measure(surface);
}

TEST(StructureSet, RingsDrawnInEveryWayAreOneSolid) {
  const Measures expected = measures_of(read(file_of(ring("CLOSEDPLANAR_XOR"))));
  EXPECT_EQ(expected.genus, 1);
  const double per_slice = 0.5 * 24 * std::sin(std::numbers::pi / 12) * (400 - 64);
  EXPECT_NEAR(expected.volume, per_slice * 12, 1e-9 * expected.volume);
  for (const std::string& bytes :
       {file_of(ring("CLOSED_PLANAR")), file_of(keyholes()),
        file_of(ring("CLOSEDPLANAR_XOR"), EXS_BigEndianExplicit),
        file_of(ring("CLOSEDPLANAR_XOR"), EXS_DeflatedLittleEndianExplicit),
        file_of(ring("CLOSEDPLANAR_XOR"), EXS_LittleEndianImplicit),
        file_of(ring("CLOSEDPLANAR_XOR"), EXS_LittleEndianImplicit, EET_ExplicitLength),
        file_of(ring("CLOSEDPLANAR_XOR"), EXS_LittleEndianExplicit, EET_ExplicitLength)}) {
    const Measures measures = measures_of(read(bytes));
    EXPECT_NEAR(measures.volume, expected.volume, 1e-9 * expected.volume);
    EXPECT_EQ(measures.genus, 1);
  }
}

TEST(StructureSet, ExclusiveOrIsEvenOddAndAllElseIsAwareOfKeyholes) {
  EXPECT_EQ(read(file_of(ring("CLOSEDPLANAR_XOR"))).fill, Fill::even_odd);
  EXPECT_EQ(read(file_of(ring("CLOSED_PLANAR"))).fill, Fill::keyhole_aware);
}

TEST(StructureSet, IsReadWithoutPreambleAndMetaInformation) {
  const Stack expected = read(file_of(ring("CLOSED_PLANAR")));
  for (const E_TransferSyntax syntax :
       {EXS_LittleEndianImplicit, EXS_LittleEndianExplicit, EXS_BigEndianExplicit}) {
    DcmDataset set;
    testing::make_structure_set(
        set, {{.number = "3", .name = "organ", .contours = ring("CLOSED_PLANAR")}});
    const std::string bytes = testing::bytes_of(set, syntax, EET_UndefinedLength, EWM_dataset);
    EXPECT_TRUE(begins_like_dicom(bytes));
    EXPECT_EQ(read(bytes), expected);
  }
  const std::string whole = file_of(ring("CLOSED_PLANAR"));
  EXPECT_EQ(read(whole.substr(128)), expected) << "DICM in front";
  EXPECT_EQ(read(whole.substr(132)), expected) << "meta information in front";
}

TEST(StructureSet, OtherFilesDoNotBeginLikeIt) {
  for (const std::string_view bytes :
       {"", "{\"z\": 0}", "\b\0", "IMODV1.2", "\x5c\x01\0\0data", "II*\0\b\0\0\0", "NRRD0004\n"})
    EXPECT_FALSE(begins_like_dicom(bytes)) << bytes;
  EXPECT_THAT(problem("NRRD0004\n"), HasSubstr("made.dcm: is no DICOM file"));
}

TEST(StructureSet, CoordinatesAreThoseOfTheFileBitForBit) {
  const std::vector<Vec3> points{{0.1, -0.2, 5}, {100.123456789, 0.3, 5}, {1e-7, 77.7, 5}};
  const Stack stack = read(file_of({{"CLOSED_PLANAR", points}}));
  ASSERT_EQ(stack.slices.size(), 1U);
  const Contour& contour = stack.slices[0].contours.at(0);
  ASSERT_EQ(contour.points.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(contour.points[i], (cdt::Point{points[i][0], points[i][1]}));
  EXPECT_EQ(contour.source, "ROI 3 contour 0");
  EXPECT_EQ(contour.label, "organ");
  EXPECT_FALSE(stack.frame);
  EXPECT_EQ(stack.unit, "mm");
}

TEST(StructureSet, LabelsHaveNameColourNumberAndKind) {
  const Stack stack = read(structure_set(
      {{.number = "7",
        .name = "Prostata gr\xC3\xB6\xC3\x9F"
                "er",
        .kind = "CTV",
        .contours = ring("CLOSED_PLANAR")},
       {.number = "9", .name = "plain", .kind = "", .colour = "", .contours = keyholes()},
       {.number = "10",
        .name = "odd",
        .kind = "",
        .colour = "1\\2\\300",
        .contours = keyholes()}}));
  ASSERT_EQ(stack.labels.size(), 3U);
  EXPECT_EQ(stack.labels[0], (StackLabel{"Prostata gr\xC3\xB6\xC3\x9F"
                                         "er",
                                         Colour{208, 32, 48},
                                         "7",
                                         "CTV",
                                         {}}));
  EXPECT_EQ(stack.labels[1], (StackLabel{"plain", {}, "9", "", {}}));
  EXPECT_FALSE(stack.labels[2].colour);
  EXPECT_EQ(stack.slices[0].contours[0].label, stack.labels[0].name);
}

TEST(StructureSet, NamesOfEveryCharacterSetBecomeUtf8) {
  const auto name_of = [](const std::string& set_name, const std::string& name) {
    DcmDataset set;
    testing::make_structure_set(
        set, {{.number = "1", .name = name, .contours = ring("CLOSED_PLANAR")}}, set_name);
    return read(testing::bytes_of(set)).labels.at(0).name;
  };
  EXPECT_EQ(name_of("ISO_IR 100",
                    "gr\xF6\xDF"
                    "er"),
            "gr\xC3\xB6\xC3\x9F"
            "er");
  EXPECT_EQ(name_of("ISO_IR 192",
                    "gr\xC3\xB6\xC3\x9F"
                    "er"),
            "gr\xC3\xB6\xC3\x9F"
            "er");
  EXPECT_EQ(name_of("ISO_IR 144", "\xBF\xE0"), "\xD0\x9F\xD1\x80");  // Cyrillic
  EXPECT_EQ(name_of("",
                    "gr\xC3\xB6\xC3\x9F"
                    "er"),
            "gr\xC3\xB6\xC3\x9F"
            "er");
  EXPECT_EQ(name_of("",
                    "gr\xF6\xDF"
                    "er"),
            "gr\xC3\xB6\xC3\x9F"
            "er");
  EXPECT_EQ(name_of("nonsense",
                    "gr\xF6\xDF"
                    "er"),
            "gr\xC3\xB6\xC3\x9F"
            "er");
}

TEST(StructureSet, RoisOfOneNameAreToldApartByTheirNumbers) {
  const Stack stack =
      read(structure_set({{.number = "1", .name = "GTV", .contours = ring("CLOSED_PLANAR")},
                          {.number = "4", .name = "GTV", .contours = keyholes()},
                          {.number = "5", .name = "", .contours = keyholes()}}));
  EXPECT_EQ(stack.labels[0].name, "GTV (ROI 1)");
  EXPECT_EQ(stack.labels[1].name, "GTV (ROI 4)");
  EXPECT_EQ(stack.labels[2].name, "ROI 5");
  EXPECT_THAT(labels(stack.slices), ElementsAre("GTV (ROI 1)", "GTV (ROI 4)", "ROI 5"));
}

TEST(StructureSet, WhatIsNoClosedContourIsLeftOutAndCounted) {
  std::vector<MadeContour> mixed = ring("CLOSED_PLANAR");
  mixed.push_back({"CLOSED_PLANAR", {{1, 1, 6}}});
  mixed.push_back({"CLOSED_PLANAR", {{1, 1, 6}, {2, 1, 6}}});
  mixed.push_back({"CLOSED_PLANAR", {{1, 1, 6}, {2, 1, 6}, {1, 1, 6}}});
  mixed.push_back({"CLOSED_PLANAR", {}});
  const Stack stack = read(structure_set(
      {{.number = "1", .name = "mixed", .contours = mixed},
       {.number = "2", .name = "Isocenter", .contours = {{{"POINT", {{0, 0, 6}}}}}},
       {.number = "3",
        .name = "needle",
        .contours = {{{"OPEN_NONPLANAR", {{0, 0, 0}, {1, 1, 6}, {2, 3, 12}}},
                      {"OPEN_PLANAR", {{0, 0, 6}, {1, 1, 6}, {2, 3, 6}}}}}},
       {.number = "4", .name = "no item"},
       {.number = "5", .name = "empty item", .contours = std::vector<MadeContour>()}}));
  EXPECT_THAT(stack.notes,
              ElementsAre("label 'mixed': left out 4 closed contour of less than 3 points",
                          "label 'Isocenter': left out 1 POINT; it has no closed contour",
                          "label 'needle': left out 1 OPEN_NONPLANAR, 1 OPEN_PLANAR; it has no "
                          "closed contour",
                          "label 'no item': it has no closed contour",
                          "label 'empty item': it has no closed contour"));
  EXPECT_EQ(stack.slices.size(), 5U);
  EXPECT_EQ(stack.slices[2].contours.size(), 2U);
}

TEST(StructureSet, ARepeatedFirstPointIsDropped) {
  std::vector<Vec3> points = circle(0, 0, 5, 1);
  points.push_back(points.front());
  EXPECT_EQ(read(file_of({{"CLOSED_PLANAR", points}})).slices[0].contours[0].points.size(), 24U);
}

/// What the region of a slice encloses after cleaning, in pixels.
testing::Raster region_of(const Stack& stack, const Slice& slice, std::size_t size) {
  std::vector<ContourSource> sources;
  for (std::uint32_t i = 0; i < slice.contours.size(); ++i)
    sources.push_back({slice.contours[i].points, 0, i});
  std::vector<Defect> repairs;
  const Region region = clean(sources, slice.z, {stack.fill.value()}, repairs);
  EXPECT_TRUE(repairs.empty());
  testing::Raster raster(size, size);
  for (std::size_t i = 0; i < region.loop_count(); ++i) {
    std::vector<cdt::Point> points;
    for (const std::uint32_t v : region.loop(i)) points.push_back(region.points[v]);
    raster.add(points, [](const cdt::Point& p) {
      return cdt::Point{(p.x + 180.5) / 1.3671875, (p.y + 99.25) / 1.3671875};
    });
  }
  return raster;
}

TEST(StructureSet, NestedOutlinesGiveTheirMaskBack) {
  // Parts, holes, parts in holes, all in the same direction, in decimals of 16 characters.
  constexpr std::size_t size = 40;
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  std::vector<double> pixels = testing::random_pixels(size * size * heights.size(), 3, random);
  for (double& pixel : pixels) pixel = pixel > 1 ? 1 : 0;
  const Stack outlines = trace(testing::volume_of(size, size, pixels));
  std::vector<MadeContour> contours;
  for (const Slice& slice : outlines.slices)
    for (const Contour& contour : slice.contours) {
      MadeContour made{"CLOSED_PLANAR", {}};
      for (const cdt::Point& p : contour.points)
        made.points.push_back({1.3671875 * p.x - 180.5, 1.3671875 * p.y - 99.25, 5 * slice.z});
      if (testing::area(contour.points) < 0) std::ranges::reverse(made.points);
      contours.push_back(std::move(made));
    }
  const Stack stack = read(file_of(contours));
  ASSERT_EQ(stack.slices.size(), heights.size());
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const testing::Raster raster = region_of(stack, stack.slices[k], size);
    for (std::size_t i = 0; i < size * size; ++i)
      ASSERT_EQ(raster[i], pixels[k * size * size + i] != 0) << "slice " << k << " pixel " << i;
  }
}

/// A square of pixels with a hole and a channel to it as rt-utils draws them, each pixel 2 wide.
std::vector<MadeContour> pin_holes() {
  const auto at = [](const std::vector<std::array<int, 2>>& pixels, double z) {
    std::vector<Vec3> points;
    for (const auto& [x, y] : pixels) points.push_back({10 + 2.0 * x, 20 + 2.0 * y, z});
    return points;
  };
  std::vector<MadeContour> contours;
  for (const double z : heights) {
    contours.push_back({"CLOSED_PLANAR", at({{0, 0},
                                             {8, 0},
                                             {8, 6},
                                             {7, 6},
                                             {7, 11},
                                             {14, 11},
                                             {14, 6},
                                             {12, 6},
                                             {12, 0},
                                             {20, 0},
                                             {20, 20},
                                             {0, 20}},
                                            z)});
    contours.push_back({"CLOSED_PLANAR", at({{3, 3}}, z)});
    contours.push_back({"CLOSED_PLANAR", at({{3, 3}, {4, 3}}, z)});
  }
  return contours;
}

TEST(StructureSet, ChannelsToHolesAsRtUtilsDrawsThemAreClosed) {
  const auto file = [](const std::string& model) {
    DcmDataset set;
    testing::make_structure_set(set, {{.number = "3", .name = "organ", .contours = pin_holes()}});
    testing::put(set, DCM_ManufacturerModelName, model);
    return testing::bytes_of(set);
  };
  const Stack closed = read(file("rt-utils"));
  EXPECT_THAT(closed.notes,
              ElementsAre("label 'organ': left out 10 closed contour of less than 3 points; closed "
                          "5 channels to holes, 8 wide, as rt-utils draws them (--fill evenodd "
                          "keeps them)"));
  const Measures measures = measures_of(closed);
  EXPECT_EQ(measures.genus, 1);
  EXPECT_NEAR(measures.volume, 4 * (400 - 35) * 12, 1e-9);
  // By others they are left as they are, and if that is asked for.
  const Stack drawn = read(file("other"));
  EXPECT_EQ(drawn.slices[0].contours.size(), 1U);
  EXPECT_EQ(measures_of(drawn).genus, 0);
  const std::string bytes = file("rt-utils");
  EXPECT_EQ(read_dicom({bytes, "made.dcm"}, {.fill = Fill::even_odd}).slices, drawn.slices);
}

TEST(StructureSet, PlanesAreSortedAndThoseThatDifferByRoundingAreOne) {
  std::vector<MadeContour> contours;
  for (const double z : {9.0000001, 0.0, 2.5, 12.0, 6.0, 5.9999999, 6.0})
    contours.push_back(
        {"CLOSED_PLANAR", circle(30 * static_cast<double>(contours.size()), 0, 10, z)});
  const Stack stack = read(file_of(contours));
  std::vector<double> z;
  for (const Slice& slice : stack.slices) z.push_back(slice.z);
  EXPECT_THAT(z, ElementsAre(0, 2.5, 6, 9.0000001, 12));
  EXPECT_EQ(stack.slices[2].contours.size(), 3U);
  EXPECT_THAT(stack.notes, ElementsAre("planes that differ by up to 1e-07 were taken as one in 1 "
                                       "slices"));
}

TEST(StructureSet, ContoursALittleOffTheirPlaneAreMovedThere) {
  std::vector<MadeContour> contours = moved_solid(as_it_is);
  contours[1].points[5][2] += 1e-5;
  const Stack stack = read(file_of(contours));
  EXPECT_EQ(stack.slices.size(), 5U);
  EXPECT_THAT(stack.notes, ElementsAre(HasSubstr("1 contours are a little off their planes")));
}

TEST(StructureSet, PlanesOfConstantXOrYAreTheSameSolidInTheWorld) {
  const double volume = measures_of(read(file_of(moved_solid(as_it_is)))).volume;
  for (const std::size_t turn : {std::size_t{1}, std::size_t{2}}) {
    const Stack stack = read(file_of(moved_solid([turn](const Vec3& p) {
      return Vec3{p[turn], p[(1 + turn) % 3], p[(2 + turn) % 3]};
    })));
    ASSERT_TRUE(stack.frame);
    EXPECT_EQ(stack.frame->determinant(), 1);
    EXPECT_TRUE(stack.slices[0].contours[0].places.empty()) << "the frame is exact";
    const Surface surface = reconstruct(stack).surface;
    EXPECT_NEAR(measure(surface).volume, volume, 1e-9 * volume);
    const std::size_t upright = turn == 1 ? 1 : 0;  // where z went
    for (const auto v : surface.vertices()) {
      const double height = surface.point(v)[upright];
      EXPECT_GE(height, 0);
      EXPECT_LE(height, 12);
    }
  }
}

TEST(StructureSet, TiltedPlanesAreTheSameSolidAtThePointsOfTheFile) {
  const double volume = measures_of(read(file_of(moved_solid(as_it_is)))).volume;
  const double cosine = std::cos(0.35);
  const double sine = std::sin(0.35);
  const std::vector<MadeContour> contours = moved_solid([&](const Vec3& p) {
    return Vec3{p[0], p[1] * cosine - p[2] * sine, p[1] * sine + p[2] * cosine};
  });
  const Stack stack = read(file_of(contours));
  ASSERT_TRUE(stack.frame);
  EXPECT_EQ(fault(*stack.frame), "");
  ASSERT_EQ(stack.slices.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(stack.slices[i].z, heights[i], 1e-9);
    EXPECT_EQ(stack.slices[i].contours[0].places, contours[i].points);
  }
  const Measures measures = measures_of(stack);
  EXPECT_NEAR(measures.volume, volume, 1e-9 * volume);
}

TEST(StructureSet, OfPlanesThatAreNotParallelThoseAreNamedThatAreNotToMost) {
  for (const std::size_t bad : {std::size_t{0}, std::size_t{3}}) {
    std::vector<MadeContour> contours = moved_solid(as_it_is);
    for (Vec3& point : contours[bad].points) point[2] += 0.1 * point[0];
    EXPECT_EQ(problem(file_of(contours)),
              "made.dcm: planes are not parallel: 1 of 5 contours; ROI 3 contour " +
                  std::to_string(bad) +
                  " most, by 5.71 degrees; export structures of parallel planes only, one file "
                  "each");
  }
  // A large one has more to say than all others, but is one.
  std::vector<MadeContour> contours = moved_solid(as_it_is);
  for (Vec3& point : contours[2].points)
    point = {100 * point[0], 100 * point[1], point[2] + 10 * point[0]};
  EXPECT_THAT(problem(file_of(contours)),
              HasSubstr("1 of 5 contours; ROI 3 contour 2 most, by 5.7"));
}

TEST(StructureSet, PlanesThatAreAllDifferentAreRefused) {
  std::vector<MadeContour> contours = moved_solid(as_it_is);
  for (std::size_t i = 0; i < contours.size(); ++i)
    for (Vec3& point : contours[i].points) point[2] += 0.1 * static_cast<double>(i) * point[0];
  EXPECT_THAT(problem(file_of(contours)), HasSubstr("planes are not parallel: 4 of 5 contours"));
}

TEST(StructureSet, ContoursTooLongForTheirKindAreReadAsBytes) {
  // Programs write decimals of more than 64 KiB as of unknown kind in explicit encodings.
  DcmDataset set;
  testing::make_structure_set(set, {{.number = "3", .name = "organ", .contours = keyholes()}});
  const Stack expected = read(testing::bytes_of(set));
  DcmItem* roi = nullptr;
  ASSERT_TRUE(set.findAndGetSequenceItem(DCM_ROIContourSequence, roi, 0).good());
  DcmItem* contour = nullptr;
  ASSERT_TRUE(roi->findAndGetSequenceItem(DCM_ContourSequence, contour, 2).good());
  OFString text;
  ASSERT_TRUE(contour->findAndGetOFStringArray(DCM_ContourData, text).good());
  delete contour->remove(DCM_ContourData);
  auto unknown = std::make_unique<DcmOtherByteOtherWord>(DcmTag(DCM_ContourData, DcmVR(EVR_UN)));
  const std::string padded = std::string(text.c_str()) + (text.size() % 2 == 1 ? " " : "");
  ASSERT_TRUE(
      unknown->putUint8Array(reinterpret_cast<const Uint8*>(padded.data()), padded.size()).good());
  contour->insert(unknown.release());
  EXPECT_EQ(read(testing::bytes_of(set)), expected);
}

TEST(StructureSet, AllBadNumbersAreListedWithTheirPath) {
  DcmDataset set;
  testing::make_structure_set(
      set, {{.number = "3", .name = "organ", .contours = ring("CLOSED_PLANAR")}});
  DcmItem* roi = nullptr;
  ASSERT_TRUE(set.findAndGetSequenceItem(DCM_ROIContourSequence, roi, 0).good());
  const auto spoil = [&](unsigned long i, const std::string& text) {
    DcmItem* contour = nullptr;
    ASSERT_TRUE(
        roi->findAndGetSequenceItem(DCM_ContourSequence, contour, static_cast<long>(i)).good());
    testing::put(*contour, DCM_ContourData, text);
  };
  spoil(1, "0\\0\\0\\nan\\1\\0\\1\\1\\0");
  spoil(2, "0\\0\\0\\1\\1");
  spoil(4, "0\\0\\0\\1,5\\1\\0\\1\\1\\0");
  spoil(5, "0\\0\\0\\1\\\\0\\1\\1\\0");
  spoil(6, "0\\0\\0\\1e80\\0\\0\\1\\1\\0");
  const std::string message = problem(testing::bytes_of(set));
  EXPECT_THAT(message, HasSubstr("made.dcm: (3006,0039)[0]/(3006,0040)[1]/(3006,0050): value 3, "
                                 "'nan', is no number"));
  EXPECT_THAT(message, HasSubstr("(3006,0040)[2]/(3006,0050): has 5 numbers"));
  EXPECT_THAT(message, HasSubstr("(3006,0040)[4]/(3006,0050): value 3, '1,5'"));
  EXPECT_THAT(message, HasSubstr("(3006,0040)[5]/(3006,0050): value 4, ''"));
  EXPECT_THAT(message, HasSubstr("(3006,0040)[6]/(3006,0050): value 3, '1e80'"));
  EXPECT_EQ(std::ranges::count(message, '\n'), 4);
}

TEST(StructureSet, AFileCutOffAnywhereIsAnErrorWithItsPlace) {
  const std::string defined = structure_set(
      {{.number = "3", .name = "organ", .contours = {{{"CLOSED_PLANAR", circle(0, 0, 5, 1)}}}}},
      EXS_LittleEndianExplicit, EET_ExplicitLength);
  for (const std::string& whole :
       {file_of({{"CLOSED_PLANAR", circle(0, 0, 5, 1)}}), defined,
        file_of({{"CLOSED_PLANAR", circle(0, 0, 5, 1)}}, EXS_LittleEndianImplicit),
        file_of({{"CLOSED_PLANAR", circle(0, 0, 5, 1)}}, EXS_DeflatedLittleEndianExplicit)}) {
    ASSERT_EQ(problem(whole), "nothing");
    std::size_t good = 0;
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const std::string message = problem(std::string_view(whole).substr(0, size));
      if (message == "nothing")
        ++good;  // only what is behind the contours is gone
      else
        EXPECT_THAT(message, HasSubstr("made.dcm"));
    }
    EXPECT_LE(good, 1U);
  }
}

TEST(StructureSet, ClaimedLengthsAreComparedWithTheFile) {
  std::string bytes = file_of(ring("CLOSED_PLANAR"), EXS_LittleEndianImplicit);
  const std::size_t at = bytes.find(std::string_view("\x06\x30\x50\0", 4));
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at + 4, 4, std::string_view("\xF0\xFF\xFF\x7F", 4));
  EXPECT_THAT(problem(bytes), HasSubstr("byte " + std::to_string(at + 8) +
                                        ", (3006,0039)[0]/(3006,0040)[0]/(3006,0050): claims "
                                        "2147483632 bytes where "));
}

TEST(StructureSet, SequencesInEachOtherWithoutEndAreRefused) {
  std::string bytes = file_of(ring("CLOSED_PLANAR"));
  for (int i = 0; i < 100000; ++i)
    bytes +=
        std::string("\x06\x30\x39\x00SQ\0\0\xFF\xFF\xFF\xFF\xFE\xFF\x00\xE0\xFF\xFF\xFF\xFF", 20);
  EXPECT_THAT(problem(bytes), HasSubstr("more than 64 sequences deep"));
}

TEST(StructureSet, OtherObjectsAndTransferSyntaxesAreNamed) {
  DcmDataset image;
  testing::put(image, DCM_SOPClassUID, UID_CTImageStorage);
  testing::put(image, DCM_SOPInstanceUID, "1.2.3");
  EXPECT_THAT(problem(testing::bytes_of(image)),
              HasSubstr("made.dcm: is CTImageStorage (1.2.840.10008.5.1.4.1.1.2)"));
  std::string bytes = file_of(ring("CLOSED_PLANAR"));
  const std::string uid = "1.2.840.10008.1.2.1";
  bytes.replace(bytes.find(uid), uid.size(), "1.2.840.10008.9.9.9");
  EXPECT_THAT(problem(bytes), HasSubstr("transfer syntax 1.2.840.10008.9.9.9 cannot be read"));
}

TEST(StructureSet, WithoutAClosedContourThereIsNothingToMake) {
  EXPECT_THAT(problem(structure_set({{.number = "1", .name = "a"}})),
              HasSubstr("has no closed contour of three points or more, in 1 ROIs"));
  EXPECT_THAT(problem(structure_set({})), HasSubstr("in 0 ROIs"));
}

}  // namespace
}  // namespace loft::io
