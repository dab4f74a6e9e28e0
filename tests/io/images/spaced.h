// SPDX-License-Identifier: MIT
#pragma once

#include "io/stacks/read_options.h"

namespace loft::io::testing {

/// How far pixels and images are apart, for images that do not say.
inline const ReadOptions spaced{.spacing = Vec3{2, 3, 5}};

}  // namespace loft::io::testing
