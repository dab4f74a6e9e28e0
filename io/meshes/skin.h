// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "io/meshes/part.h"

namespace loft::io {

/// Whether a label is what encloses all others, so that it hides them unless one sees through it:
/// the outline of a body. Its kind tells, where it is `EXTERNAL` or another RT interpreted type
/// (DICOM, StackLabel::kind); else its name, which then says no more than that: `BODY`, `External`,
/// `skin outline 2`, but not `external iliac artery`.
[[nodiscard]] bool is_skin(std::string_view label, std::string_view kind = {});

/// Whether a part is to be seen through: a skin that is not alone among those with faces.
[[nodiscard]] bool is_see_through(const Part& part, std::span<const Part> parts);

/// How much of a skin is seen: the alpha of its material.
inline constexpr double skin_opacity = 0.25;

}  // namespace loft::io
