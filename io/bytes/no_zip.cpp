// SPDX-License-Identifier: MIT
// In the place of zip.cpp where there is no libzip.
#include "io/bytes/zip.h"
#include "reconstruct/defect.h"

namespace loft::io {

bool has_zip() { return false; }
std::string zip(std::span<const ZipEntry>) { throw Error(std::string(no_zip)); }

}  // namespace loft::io
