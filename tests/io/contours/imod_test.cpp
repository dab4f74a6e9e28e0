// SPDX-License-Identifier: MIT
#include "io/contours/imod.h"

#include <array>
#include <limits>

#include "tests/io/stacks/readers.h"

namespace loft::io {
namespace {

using testing::append;
using testing::problem;
using testing::read;

constexpr auto big = std::endian::big;
using Point = std::array<float, 3>;

/// A model file in the making.
class Model {
 public:
  std::uint32_t flags = 0;
  float z_scale = 2;
  float pixel_size = 0.5F;
  std::int32_t units = -9;

  Model& object(const std::string& name, std::uint32_t object_flags, std::uint32_t contours = 0) {
    ++objects_;
    bytes_ += "OBJT" + name + std::string(128 - name.size(), '\0');
    append(bytes_, contours, big);
    append(bytes_, object_flags, big);
    bytes_ += std::string(8, '\0');
    for (const float part : {1.0F, 0.5F, 0.0F}) append(bytes_, part, big);
    bytes_ += std::string(20, '\0');
    return *this;
  }
  Model& contour(const std::vector<Point>& points, std::uint32_t contour_flags = 0) {
    bytes_ += "CONT";
    append(bytes_, static_cast<std::uint32_t>(points.size()), big);
    append(bytes_, contour_flags, big);
    bytes_ += std::string(8, '\0');
    for (const Point& point : points)
      for (const float part : point) append(bytes_, part, big);
    return *this;
  }
  Model& chunk(const std::string& id, const std::string& content) {
    bytes_ += id;
    append(bytes_, static_cast<std::uint32_t>(content.size()), big);
    bytes_ += content;
    return *this;
  }
  Model& raw(const std::string& text) {
    bytes_ += text;
    return *this;
  }
  Model& image(float scale, const Point& origin) {
    std::string content(36, '\0');
    for (int i = 0; i < 3; ++i) append(content, scale, big);
    for (const float part : origin) append(content, part, big);
    return chunk("MINX", content + std::string(12, '\0'));
  }

  [[nodiscard]] std::string bytes(const std::string& end = "IEOF") const {
    std::string result = "IMODV1.2" + std::string(140, '\0');
    append(result, objects_, big);
    append(result, flags, big);
    result += std::string(36, '\0');
    append(result, z_scale, big);
    result += std::string(20, '\0');
    append(result, pixel_size, big);
    append(result, units, big);
    result += std::string(16, '\0');
    return result + bytes_ + end;
  }

 private:
  std::uint32_t objects_ = 0;
  std::string bytes_;
};

std::vector<Point> square_at(float z, float side = 10) {
  return {{0, 0, z}, {side, 0, z}, {side, side, z}, {0, side, z}};
}

TEST(Imod, ReadsObjectsAsLabelsInRealSizes) {
  const Stack stack = read(read_imod, Model()
                                          .object("cell", 0, 2)
                                          .contour(square_at(3))
                                          .contour(square_at(3, 4))
                                          .object("", 0)
                                          .contour(square_at(4))
                                          .bytes());
  EXPECT_EQ(stack.unit, "nm");
  EXPECT_EQ(stack.fill, Fill::even_odd);  // nested ones are holes
  EXPECT_FALSE(stack.frame);
  EXPECT_EQ(stack.labels,
            (std::vector<StackLabel>{{"cell", Colour{255, 128, 0}, "1", "", {}},
                                     {"object 2", Colour{255, 128, 0}, "2", "", {}}}));
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_EQ(stack.slices[0].z, 3 * 0.5 * 2);
  ASSERT_EQ(stack.slices[0].contours.size(), 2U);
  EXPECT_EQ(stack.slices[0].contours[1],
            (Contour{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, "cell", "object 1 contour 2"}));
  EXPECT_EQ(stack.slices[1].contours[0].label, "object 2");
}

TEST(Imod, LeavesOutWhatIsOpenScatteredOrInNoPlane) {
  constexpr std::uint32_t open = 1U << 3U;
  constexpr std::uint32_t wild = 1U << 4U;
  constexpr std::uint32_t scattered = 1U << 9U;
  std::vector<Point> tilted = square_at(1);
  tilted[2][2] = 5;
  const Stack stack = read(read_imod, Model()
                                          .object("a", 0)
                                          .contour(square_at(1))
                                          .contour(square_at(2), wild)  // an old flag: it is level
                                          .contour(square_at(3), open)
                                          .contour({{1, 1, 1}})
                                          .contour({})
                                          .contour(tilted, wild)
                                          .object("lines", open)
                                          .contour(square_at(1))
                                          .object("balls", scattered)
                                          .contour(square_at(1))
                                          .bytes());
  EXPECT_EQ(stack.slices.size(), 2U);
  EXPECT_EQ(stack.notes, (std::vector<std::string>{
                             "label 'a': 2 contours of 1 or 2 points, 1 contour that is in "
                             "no plane, 1 open line left out",
                             "label 'balls': 4 scattered points left out",
                             "label 'lines': 1 open line left out"}));
}

TEST(Imod, BringsSectionsTogetherThatDifferByRounding) {
  std::vector<Point> drifting = square_at(36);
  drifting[1][2] = 36.000004F;
  const Stack stack = read(read_imod, Model()
                                          .object("a", 0)
                                          .contour(square_at(36))
                                          .contour(drifting)
                                          .contour(square_at(36.000004F))
                                          .contour(square_at(1.97e-06F))
                                          .contour(square_at(0))
                                          .contour(square_at(1))
                                          .bytes());
  ASSERT_EQ(stack.slices.size(), 3U);
  EXPECT_EQ(stack.slices[0].z, 0);
  EXPECT_EQ(stack.slices[2].z, 36);
  EXPECT_EQ(stack.slices[2].contours.size(), 3U);
}

TEST(Imod, ReadsModelsThatWereDrawnOnFlippedImages) {
  Model model;
  model.flags = 1U << 16U;
  model.object("a", 0)
      .contour({{1, 7, 0}, {2, 7, 0}, {2, 7, 5}})
      .contour({{1, 8, 0}, {2, 8, 0}, {2, 8, 5}});
  const Stack stack = read(read_imod, model.bytes());
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_EQ(stack.slices[0].z, 3.5);
  ASSERT_TRUE(stack.frame);
  EXPECT_EQ(stack.frame->determinant(), 1);
  const cdt::Point last = stack.slices[1].contours.at(0).points.at(2);
  EXPECT_EQ(stack.frame->at({last.x, last.y, stack.slices[1].z}), (Vec3{1, 4, 5}));
}

TEST(Imod, PutsTheOriginOfTheImageIntoTheFrameWhereItCounts) {
  Model model;
  model.object("a", 0).contour(square_at(1)).contour(square_at(2)).image(5, {-20, 30, 0});
  EXPECT_FALSE(read(read_imod, model.bytes()).frame);
  model.flags = 1U << 14U;
  const Stack stack = read(read_imod, model.bytes());
  ASSERT_TRUE(stack.frame);  // pixels are 5 Angstrom, 0.5 nm
  EXPECT_EQ(stack.frame->at({0, 0, 2}), (Vec3{2, -3, 2}));
}

TEST(Imod, LeavesOutAnOriginThatIsNone) {
  Model model;
  model.flags = 1U << 14U;
  model.object("a", 0).contour(square_at(1)).image(0, {-20, 30, std::numeric_limits<float>::max()});
  const Stack stack = read(read_imod, model.bytes());
  EXPECT_FALSE(stack.frame);
  EXPECT_EQ(stack.notes.at(0), "the origin of the image in MINX is no place; left out");
}

TEST(Imod, PassesOverOtherChunks) {
  Model model;
  model.object("a", 0).contour(square_at(1)).chunk("IMAT", "0123").chunk("MEPA", "");
  std::string mesh = "MESH";
  for (const std::uint32_t count : {1U, 2U, 0U, 0U}) append(mesh, count, big);
  model.raw(mesh + std::string(12 + 8, '\0')).contour(square_at(2));
  EXPECT_EQ(read(read_imod, model.bytes("IEOFmore")).slices.size(), 2U);
}

TEST(Imod, TellsObjectsOfOneNameApart) {
  const Stack stack = read(
      read_imod,
      Model().object("a", 0).contour(square_at(1)).object("a", 0).contour(square_at(1)).bytes());
  EXPECT_EQ(testing::labels_in(stack.slices.at(0)),
            (std::vector<std::string>{"a (object 1)", "a (object 2)"}));
}

TEST(Imod, SaysThatNothingIsClosed) {
  const std::string text = problem(read_imod, Model().object("a", 8).contour(square_at(1)).bytes());
  EXPECT_NE(text.find("no closed outline in it, only 1 open line"), std::string::npos) << text;
}

TEST(Imod, NamesTheByteOfWhatIsWrong) {
  EXPECT_NE(problem(read_imod, "IMODV1.1 and more").find("byte 0: begins with 'IMODV1.1' instead"),
            std::string::npos);
  Model model;
  model.pixel_size = 0;
  model.z_scale = std::numeric_limits<float>::quiet_NaN();
  model.object("a", 0).contour({{0, 0, 0}, {1, std::numeric_limits<float>::infinity(), 0}});
  EXPECT_EQ(problem(read_imod, model.bytes()),
            "a.file: byte 192: the z scale is NaN; set it in 3dmod: Edit, Model, Header\n"
            "a.file: byte 216: the pixel size is not positive; set it in 3dmod: Edit, Model, "
            "Header\n"
            "a.file: byte 456: object 1 contour 1 point 1: inf is not finite");
  EXPECT_NE(
      problem(read_imod, Model().object("a", 0).bytes("")).find("without its last mark, IEOF"),
      std::string::npos);
  EXPECT_NE(problem(read_imod, Model().object("a", 0, 1U << 31U).bytes())
                .find("more than the file has room"),
            std::string::npos);
  EXPECT_NE(
      problem(read_imod, Model().contour(square_at(1)).bytes()).find("before the first object"),
      std::string::npos);
  std::string huge = "CONT";
  append(huge, 0x80000000U, big);
  EXPECT_NE(problem(read_imod, Model().object("a", 0).raw(huge + std::string(12, '\0')).bytes())
                .find("25769803776 bytes should come"),
            std::string::npos);
}

TEST(Imod, IsHurtByNoCut) {
  Model model;
  model.flags = 1U << 14U;
  model.object("a", 0).contour(square_at(1)).contour(square_at(2)).image(5, {1, 2, 3});
  testing::expect_no_cut_hurts(read_imod, model.bytes());
}

}  // namespace
}  // namespace loft::io
