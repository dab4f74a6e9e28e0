// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

#include "paths/free_space.h"

namespace loft::paths {

/// Throws std::logic_error if a space is stale.
inline void expect_followed(const FreeSpace& space) {
  if (space.is_stale())
    throw std::logic_error("paths: the free space has not followed the overlay's last edit");
}

}  // namespace loft::paths
