// SPDX-License-Identifier: MIT
#include "io/contours/imod.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/contours/imod_model.h"
#include "io/contours/stack_builder.h"

namespace loft::io {

namespace {

constexpr double no_height = 1e-6;  // of a coordinate: rounding of floats

bool is_outline(const ImodObject& object, const ImodContour& contour) {
  return !object.is_open && !object.is_scattered && !contour.is_open && contour.points.size() > 2;
}

bool is_level(const ImodContour& contour, std::size_t axis) {
  float least = contour.points[0][axis];
  float most = least;
  for (const auto& point : contour.points) {
    least = std::min(least, point[axis]);
    most = std::max(most, point[axis]);
  }
  return static_cast<double>(most - least) <=
         no_height * static_cast<double>(std::max(std::abs(least), std::abs(most)));
}

/// The axis across the planes that most outlines are in; z unless another has more.
std::size_t find_axis(const ImodModel& model) {
  std::array<std::size_t, 3> level{};
  for (const ImodObject& object : model.objects)
    for (const ImodContour& contour : object.contours)
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (is_outline(object, contour) && is_level(contour, axis)) ++level[axis];
  std::size_t best = 2;
  for (const std::size_t axis : {std::size_t{1}, std::size_t{0}})
    if (level[axis] > level[best]) best = axis;
  return best;
}

/// Where slices across an axis lie: its two followers, then the axis itself, and the origin of the
/// image. None where that changes nothing.
std::optional<WorldFrame> find_frame(const ImodModel& model, std::size_t axis, Stack& stack) {
  WorldFrame frame;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) frame.rows[i][k] = i == (axis + 1 + k) % 3 ? 1 : 0;
  if (model.has_origin && model.image) {
    WorldFrame moved = frame;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto origin = static_cast<double>(model.image->origin[i]);
      // Both are in the image's unit, Angstrom as a rule; the model's may be another.
      moved.rows[i][3] =
          origin == 0 ? 0
                      : -origin * (model.pixel_size / static_cast<double>(model.image->scale[i]));
    }
    if (fault(moved).empty()) {
      frame = moved;
    } else {
      stack.notes.emplace_back("the origin of the image in MINX is no place; left out");
    }
  }
  return frame.is_identity() ? std::nullopt : std::optional(frame);
}

std::string label_of(const ImodModel& model, std::size_t number) {
  const std::string& name = model.objects[number].name;
  const std::string place = "object " + std::to_string(number + 1);
  if (name.empty()) return place;
  const auto same = std::ranges::count(model.objects, name, &ImodObject::name);
  return same == 1 ? name : name + " (" + place + ')';
}

class Converter {
 public:
  Converter(const ImodModel& model, std::string_view name)
      : model_(model), builder_(name), axis_(find_axis(model)) {}

  Stack convert() {
    Stack stack;
    stack.unit = model_.unit;
    stack.fill = Fill::even_odd;
    stack.frame = find_frame(model_, axis_, stack);
    for (std::size_t i = 0; i < model_.objects.size(); ++i) {
      const ImodObject& object = model_.objects[i];
      const std::string label = label_of(model_, i);
      stack.labels.push_back({label, object.colour, std::to_string(i + 1), "", {}});
      for (std::size_t k = 0; k < object.contours.size(); ++k)
        add(object, object.contours[k], label,
            "object " + std::to_string(i + 1) + " contour " + std::to_string(k + 1));
    }
    builder_.finish(stack,
                    "a surface needs closed contours, each in one section: the object's type "
                    "in 3dmod (Edit, Object, Type) must be closed");
    return stack;
  }

 private:
  void add(const ImodObject& object, const ImodContour& contour, const std::string& label,
           std::string source) {
    if (object.is_scattered) return builder_.skip(label, "scattered point", contour.points.size());
    if (object.is_open || contour.is_open) return builder_.skip(label, "open line");
    Contour result{{}, label, std::move(source)};
    result.points.reserve(contour.points.size());
    double lowest = 0;
    double highest = 0;
    for (const auto& point : contour.points) {
      const double z = scaled(point, axis_);
      lowest = result.points.empty() ? z : std::min(lowest, z);
      highest = result.points.empty() ? z : std::max(highest, z);
      result.points.push_back({scaled(point, (axis_ + 1) % 3), scaled(point, (axis_ + 2) % 3)});
    }
    builder_.add(std::move(result), lowest, highest);
  }

  [[nodiscard]] double scaled(const std::array<float, 3>& point, std::size_t axis) const {
    const double pixels = static_cast<double>(point[axis]) * model_.pixel_size;
    return axis == 2 ? pixels * model_.z_scale : pixels;
  }

  const ImodModel& model_;
  StackBuilder builder_;
  std::size_t axis_;
};

}  // namespace

Stack read_imod(const StackInput& input, const ReadOptions&) {
  return Converter(read_imod_model(input.bytes, input.name), input.name).convert();
}

bool begins_like_imod(std::string_view bytes) { return bytes.starts_with("IMODV1."); }

}  // namespace loft::io
