// SPDX-License-Identifier: MIT
#pragma once

// Moved; this header stays until 1.0.
#include "mesh/check.h"
#include "reconstruct/surface.h"
