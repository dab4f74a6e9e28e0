// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "io/bytes/words.h"
#include "io/contours/cli.h"
#include "io/contours/csl.h"
#include "io/contours/csv.h"
#include "io/contours/imod.h"
#include "io/contours/jser.h"
#include "io/contours/nuages.h"
#include "io/contours/terrain.h"
#include "io/dicom/dicom.h"
#include "io/images/png.h"
#include "io/images/tiff.h"
#include "io/stacks/slices_json.h"
#include "io/stacks/stack_format.h"
#include "io/volumes/meta_image.h"
#include "io/volumes/nifti.h"
#include "io/volumes/nrrd.h"

namespace loft::io {

namespace {

constexpr std::array formats{
    StackFormat{"NDJSON", ".ndjson .jsonl .json", read_ndjson},
    StackFormat{"NIfTI", ".nii .nii.gz .hdr", read_nifti, begins_like_nifti},
    StackFormat{"NRRD", ".nrrd .nhdr", read_nrrd, begins_like_nrrd},
    StackFormat{"MetaImage", ".mha .mhd", read_meta_image, begins_like_meta_image},
    StackFormat{"DICOM", ".dcm .dicom", read_dicom, begins_like_dicom},
    StackFormat{"TIFF", ".tif .tiff", read_tiff, begins_like_tiff, read_tiff_series},
    StackFormat{"PNG", ".png", read_png, begins_like_png, read_png_series},
    StackFormat{"CLI", ".cli", read_cli, begins_like_cli},
    StackFormat{"IMOD", ".mod .imod", read_imod, begins_like_imod},
    StackFormat{"PyReconstruct", ".jser", read_jser},
    StackFormat{"GeoJSON", ".geojson", read_terrain, begins_like_terrain},
    StackFormat{"CSL", ".csl", read_csl, begins_like_csl},
    StackFormat{"contour", ".contour", read_contour},
    StackFormat{"Nuages", ".cnt", read_nuages},
    StackFormat{"CSV", ".csv .tsv .txt .xyz", read_csv},
};

struct LaterFormat {
  std::string_view extensions;
  std::string_view advice;
};

constexpr std::array later_formats{
    LaterFormat{".vtp .vtm .vtk", "3D Slicer or ParaView export it as CSV, or Slicer as RTSTRUCT"},
    LaterFormat{".ser", "open it in PyReconstruct and save it as .jser"},
    LaterFormat{".asc", "Neurolucida's contours: export them as CSV with columns x, y, z, contour"},
    LaterFormat{".ilt", "it holds hatch lines; export the closed outlines of the layers as .cli"},
    LaterFormat{".slc", "export the layers as .cli"},
    LaterFormat{".svg", "slice the model again, as .cli, or export the outlines as CSV"},
    LaterFormat{".shp .dxf", "ogr2ogr -f GeoJSON OUT.geojson IN converts it"},
    LaterFormat{".stl", "it is a mesh: loft slice cuts it into a stack"},
};

/// The file's name in lower case.
std::string name_of(const std::filesystem::path& path) {
  return in_lower_case(path.filename().string());
}

/// The longest of some extensions that a name ends in: its length, or 0.
std::size_t matching(std::string_view name, std::string_view extensions) {
  std::size_t longest = 0;
  while (!extensions.empty()) {
    const std::size_t end = std::min(extensions.find(' '), extensions.size());
    const std::string_view one = extensions.substr(0, end);
    if (name.ends_with(one)) longest = std::max(longest, one.size());
    extensions.remove_prefix(std::min(end + 1, extensions.size()));
  }
  return longest;
}

}  // namespace

std::span<const StackFormat> stack_formats() { return formats; }

const StackFormat* find_stack_format(const std::filesystem::path& path) {
  const std::string name = name_of(path);
  const auto best = std::ranges::max_element(
      formats, {}, [&](const StackFormat& format) { return matching(name, format.extensions); });
  return matching(name, best->extensions) > 0 ? &*best : nullptr;
}

const StackFormat* find_stack_format(const std::filesystem::path& path, std::string_view bytes) {
  const auto found = std::ranges::find_if(formats, [&](const StackFormat& format) {
    return format.begins_like != nullptr && format.begins_like(bytes.substr(0, enough_to_tell));
  });
  return found != formats.end() ? &*found : find_stack_format(path);
}

std::string_view advice_for(const std::filesystem::path& path) {
  const std::string name = name_of(path);
  const auto found = std::ranges::find_if(later_formats, [&](const LaterFormat& format) {
    return matching(name, format.extensions) > 0;
  });
  return found == later_formats.end() ? std::string_view() : found->advice;
}

}  // namespace loft::io
