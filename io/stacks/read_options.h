// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "mesh/mesh.h"
#include "reconstruct/options.h"

namespace loft::io {

/// What becomes of contours without a label where there are several files.
enum class Unlabelled {
  keep,           ///< all files are one stack
  label_by_file,  ///< each file is a structure of its own: they take its name, see labels_of()
};

/// How outlines are drawn around the pixels of a mask.
enum class Outline {
  iso_lines,  ///< half way between pixel centres in and out; by value where pixels have shares
  edges,      ///< along the pixels' edges
  fair,       ///< as short as can be with the pixels' centres and their area inside
};

/// What becomes of lines that end at the border of the data.
enum class OpenLines {
  refuse,
  close_along_border,  ///< round the side that is higher
};

/// What readers are told beside the file. Each looks at what it knows of.
struct ReadOptions {
  unsigned threads = 0;  ///< that read at the same time; 0: as many as the machine has
  Unlabelled unlabelled = Unlabelled::keep;
  /// The rule to use instead of the one that the format means.
  std::optional<Fill> fill = {};
  /// Distances between the centres of pixels, for images that say none, or over what they say;
  /// positive.
  std::optional<Vec3> spacing = {};
  Outline outline = Outline::iso_lines;
  /// Value that pixels inside have at least, for images of grey; none: values are labels, or shares
  /// from 0 to 1 of which half is inside.
  std::optional<double> level = {};
  OpenLines open_lines = OpenLines::refuse;  ///< of isolines
  std::string z_property = {};               ///< that heights are in; empty: a name that is usual
  std::string alignment = {};  ///< which of a file's own alignments of sections; empty: its current
};

}  // namespace loft::io
