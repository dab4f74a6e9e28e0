// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "app/server/shown.h"

namespace loft::app {

/// Writes a folder that shows a surface on any web server, or opened from the disk: the page
/// (index.html, viewer.css, scripts that are no modules), the surface as files to download, figures
/// of the labels (labels.json), and all that the page would ask a server for (contents.js; slabs in
/// base64). Nothing in it leads elsewhere. The folder is made if need be.
///
/// Throws UsageError where it is not empty, unless `overwrites`; FileError where it cannot be
/// written; Error where the program was built without its page.
void export_page(Shown& shown, const std::filesystem::path& folder, bool overwrites);

}  // namespace loft::app
