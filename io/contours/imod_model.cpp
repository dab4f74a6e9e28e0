// SPDX-License-Identifier: MIT
#include "io/contours/imod_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/bytes/byte_reader.h"
#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/utf8.h"
#include "mesh/admitted.h"
#include "reconstruct/usable.h"

namespace loft::io {

namespace {

constexpr std::uint32_t open_flag = 1U << 3U;       // of objects and of contours
constexpr std::uint32_t scattered_flag = 1U << 9U;  // of objects
constexpr std::uint32_t origin_flag = 1U << 14U;    // of models

/// A text of fixed size, padded with zeros.
std::string padded_text(std::string_view bytes) {
  return json_text(one_line(bytes.substr(0, bytes.find('\0'))));
}

std::string unit_name(std::int32_t code) {
  switch (code) {
    case 3:
      return "km";
    case 1:
      return "m";
    case -2:
      return "cm";
    case -3:
      return "mm";
    case -6:
      return "um";
    case -9:
      return "nm";
    case -10:
      return "angstrom";
    case -12:
      return "pm";
    default:
      return "";  // pixels
  }
}

class ModelReader {
 public:
  ModelReader(std::string_view bytes, std::string_view name)
      : in_(bytes, name, std::endian::big), name_(name) {}

  ImodModel read() {
    try {
      read_header();
      while (!at_end_ && in_.left() > 0) read_chunk();
      require_end();
    } catch (const InputError& error) {
      problems_.add(error.what());  // what is behind cannot be told apart
    }
    problems_.raise(name_);
    return std::move(model_);
  }

 private:
  void require_end() {
    if (!at_end_)
      problems_.add(std::string(name_) + ": byte " + std::to_string(in_.place()) +
                    ": the file ends without its last mark, IEOF; it is cut off: copy it again");
    if (model_.objects.size() != wanted_objects_)
      problems_.add(std::string(name_) + ": has " + std::to_string(model_.objects.size()) +
                    " objects instead of the " + std::to_string(wanted_objects_) +
                    " of its header; it is damaged");
  }

  void complain(std::size_t byte, const std::string& problem) {
    problems_.add(std::string(name_) + ": byte " + std::to_string(byte) + ": " + problem);
  }

  void read_header() {
    const std::string_view magic = in_.take(8, "the first word of a model");
    if (magic != "IMODV1.2")
      in_.fail(0,
               "begins with " + in_quotes(magic) +
                   " instead of 'IMODV1.2'; save it as a binary model by 3dmod of IMOD 3 or later");
    model_.name = padded_text(in_.take(128, "the model's name"));
    static_cast<void>(in_.take(12, "the header"));  // size of the image
    wanted_objects_ = in_.number<std::uint32_t>("the count of objects");
    model_.has_origin = (in_.number<std::uint32_t>("the flags") & origin_flag) != 0;
    static_cast<void>(in_.take(16 + 12 + 8, "the header"));  // of the display; offsets; x, y scale
    model_.z_scale = read_length("the z scale");
    static_cast<void>(in_.take(20, "the header"));  // what is selected
    model_.pixel_size = read_length("the pixel size");
    model_.unit = unit_name(in_.number<std::int32_t>("the unit"));
    static_cast<void>(in_.take(16, "the header"));  // check sum, angles
  }

  double read_length(const char* what) {
    const std::size_t byte = in_.place();
    const double length = static_cast<double>(in_.number<float>(what));
    if (length > 0 && admitted::length.admits(length)) return length;
    complain(byte, std::string(what) + " is " + (std::isnan(length) ? "NaN" : "not positive") +
                       "; set it in 3dmod: Edit, Model, Header");
    return 1;
  }

  void read_chunk() {
    const std::size_t byte = in_.place();
    const std::string_view id = in_.take(4, "the name of a chunk");
    if (id == "IEOF") {
      at_end_ = true;
    } else if (id == "OBJT") {
      read_object(byte);
    } else if (id == "CONT") {
      read_contour(byte);
    } else if (id == "MESH") {
      const auto vertices = in_.number<std::uint32_t>("a mesh");
      const auto indices = in_.number<std::uint32_t>("a mesh");
      static_cast<void>(in_.take(8, "a mesh"));
      static_cast<void>(
          in_.take(std::uint64_t{vertices} * 12 + std::uint64_t{indices} * 4, "a mesh"));
    } else {
      const auto size = in_.number<std::uint32_t>("the size of a chunk");
      if (id == "MINX" && size >= 72) {
        read_image(in_.take(size, "the place of the image"));
      } else {
        static_cast<void>(in_.take(size, "chunk " + in_quotes(id)));
      }
    }
  }

  void read_object(std::size_t byte) {
    ImodObject object;
    object.name = padded_text(in_.take(64, "an object"));
    static_cast<void>(in_.take(64, "an object"));
    const auto contours = in_.number<std::uint32_t>("an object");
    const auto flags = in_.number<std::uint32_t>("an object");
    static_cast<void>(in_.take(8, "an object"));
    for (std::uint8_t* part : {&object.colour.red, &object.colour.green, &object.colour.blue}) {
      const float share = in_.number<float>("a colour");
      *part = share > 0 ? static_cast<std::uint8_t>(std::lround(std::min(share, 1.0F) * 255)) : 0;
    }
    static_cast<void>(in_.take(20, "an object"));
    object.is_open = (flags & open_flag) != 0;
    object.is_scattered = (flags & scattered_flag) != 0;
    if (std::uint64_t{contours} * 20 > in_.left())
      in_.fail(byte, "object " + std::to_string(model_.objects.size() + 1) + " should have " +
                         std::to_string(contours) + " contours, more than the file has room for; " +
                         "it is cut off or damaged");
    model_.objects.push_back(std::move(object));
  }

  void read_contour(std::size_t byte) {
    if (model_.objects.empty()) in_.fail(byte, "a contour comes before the first object");
    std::vector<ImodContour>& contours = model_.objects.back().contours;
    const std::string what = "object " + std::to_string(model_.objects.size()) + " contour " +
                             std::to_string(contours.size() + 1);
    const auto count = in_.number<std::uint32_t>(what);
    const auto flags = in_.number<std::uint32_t>(what);
    static_cast<void>(in_.take(8, what));  // time, surface
    const std::size_t first = in_.place();
    const std::string_view taken = in_.take(std::uint64_t{count} * 12, what);
    ImodContour contour{std::vector<std::array<float, 3>>(count), (flags & open_flag) != 0};
    for (std::size_t i = 0; i < std::size_t{count} * 3; ++i) {
      const float value = in_.number_in<float>(taken, i);
      contour.points[i / 3][i % 3] = value;
      if (!admitted::slice.admits(static_cast<double>(value)))
        complain(first + i * 4, what + " point " + std::to_string(i / 3) + ": " +
                                    why_not_admitted(static_cast<double>(value), admitted::slice));
    }
    contours.push_back(std::move(contour));
  }

  void read_image(std::string_view chunk) {
    ImodImage image{};
    for (std::size_t i = 0; i < 3; ++i) {
      image.scale[i] = in_.number_in<float>(chunk, 9 + i);
      image.origin[i] = in_.number_in<float>(chunk, 12 + i);
    }
    model_.image = image;
  }

  ByteReader in_;
  std::string_view name_;
  ImodModel model_;
  Problems problems_;
  std::size_t wanted_objects_ = 0;
  bool at_end_ = false;
};

}  // namespace

ImodModel read_imod_model(std::string_view bytes, std::string_view name) {
  return ModelReader(bytes, name).read();
}

}  // namespace loft::io
