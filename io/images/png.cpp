// SPDX-License-Identifier: MIT
#include "io/images/png.h"

#include <utility>
#include <vector>

#include "io/images/image_distances.h"
#include "io/images/png_image.h"
#include "reconstruct/defect.h"

namespace loft::io {

Stack read_png(const StackInput& input, const ReadOptions& options) {
  return read_png_series({&input, 1}, options);
}

Stack read_png_series(std::span<const StackInput> inputs, const ReadOptions& options) {
  std::vector<PngHeader> headers;
  std::vector<LabelImage> images;
  for (const StackInput& input : inputs) {
    headers.push_back(read_png_header(input.bytes, input.name));
    images.push_back(headers.back().image);
  }
  ImageDistances distances;
  distances.x = headers.front().x_distance;
  distances.y = headers.front().y_distance;
  distances.unit = "mm";
  Volume volume;
  volume.name = inputs.front().name;
  set_distances(volume, distances, options);
  const auto read = [&](std::size_t image, std::span<double> pixels) {
    read_png_pixels(inputs[image].bytes, headers[image], pixels);
  };
  return trace_images(std::move(volume), images, read, options, false);
}

}  // namespace loft::io
