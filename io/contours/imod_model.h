// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reconstruct/stack.h"

namespace loft::io {

/// A contour of a model: x, y, z of its points in pixels and sections.
struct ImodContour {
  std::vector<std::array<float, 3>> points;
  bool is_open = false;
};

struct ImodObject {
  std::string name;
  Colour colour;
  bool is_open = false;
  bool is_scattered = false;
  std::vector<ImodContour> contours;
};

/// Where an image is: of the chunk MINX.
struct ImodImage {
  std::array<float, 3> scale;
  std::array<float, 3> origin;
};

/// What a model file says of outlines.
struct ImodModel {
  std::string name;
  double z_scale = 1;
  double pixel_size = 1;
  std::string unit;
  bool has_origin = false;  ///< its image's origin counts
  std::optional<ImodImage> image;
  std::vector<ImodObject> objects;
};

/// Throws InputError that names the byte, and lists what is wrong with numbers.
[[nodiscard]] ImodModel read_imod_model(std::string_view bytes, std::string_view name);

}  // namespace loft::io
