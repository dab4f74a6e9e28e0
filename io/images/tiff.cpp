// SPDX-License-Identifier: MIT
#include "io/images/tiff.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>

#include "io/images/tiff_file.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

/// What pages may take once they are unpacked: more is in no file but of nothing at all.
std::uint64_t most_bytes_of(std::span<const StackInput> inputs) {
  constexpr std::uint64_t most_packed = 1100;  // bytes in one, by deflate
  constexpr std::uint64_t always = std::uint64_t{8} << 20U;
  std::uint64_t total = 0;
  for (const StackInput& input : inputs) total += input.bytes.size();
  return std::min<std::uint64_t>(total, std::numeric_limits<std::uint32_t>::max()) * most_packed +
         always;
}

/// A slice: a page of a file, or one of the images behind its only page.
struct Place {
  std::size_t file;
  std::size_t page;
  std::uint64_t image;
  bool has_page;  ///< of its own
};

void require_one_channel(const ImageDistances& told, const TiffPage& page,
                         const std::string& name) {
  if (told.channels > 1 && told.channels != page.samples)
    throw InputError(name + ": has " + std::to_string(told.channels) +
                     " channels; save the one that has the labels");
  if (told.times > 1)
    throw InputError(name + ": has " + std::to_string(told.times) +
                     " points of time; save one of them");
}

class Tiffs {
 public:
  explicit Tiffs(std::span<const StackInput> inputs) {
    const std::uint64_t most_bytes = most_bytes_of(inputs);
    for (const StackInput& input : inputs) {
      files_.push_back(std::make_unique<TiffFile>(input.bytes, input.name, most_bytes));
      add_pages(input.name, inputs.size() > 1);
    }
  }

  Stack trace(const ReadOptions& options, const std::string& name) const {
    Volume volume;
    volume.name = name;
    set_distances(volume, files_.front()->distances(), options);
    std::vector<LabelImage> images;
    images.reserve(places_.size());
    for (const Place& place : places_) images.push_back(pages_[place.page].image);
    const bool is_real = std::ranges::any_of(
        pages_, [](const TiffPage& page) { return page.format == SAMPLEFORMAT_IEEEFP; });
    const auto read = [this](std::size_t slice, std::span<double> pixels) {
      const Place& place = places_[slice];
      if (place.has_page)
        files_[place.file]->read(pages_[place.page], pixels);
      else
        files_[place.file]->read_image(pages_[place.page], place.image, pixels);
    };
    return trace_images(std::move(volume), images, read, options, is_real);
  }

 private:
  void add_pages(const std::string& name, bool is_series) {
    TiffFile& file = *files_.back();
    std::vector<TiffPage> pages = file.pages();
    require_one_channel(file.distances(), pages.front(), name);
    const std::uint64_t images = pages.size() > 1 ? pages.size() : file.image_count(pages.front());
    if (is_series && images > 1)
      throw InputError(name + ": has " + std::to_string(images) +
                       " pages; of several files each may have one: give such volumes one by one");
    const bool have_pages = images == pages.size();
    for (std::uint64_t i = 0; i < images; ++i)
      places_.push_back({files_.size() - 1, pages_.size() + (have_pages ? i : 0), i, have_pages});
    std::ranges::move(pages, std::back_inserter(pages_));
  }

  std::vector<std::unique_ptr<TiffFile>> files_;
  std::vector<TiffPage> pages_;
  std::vector<Place> places_;
};

}  // namespace

Stack read_tiff(const StackInput& input, const ReadOptions& options) {
  return read_tiff_series({&input, 1}, options);
}

Stack read_tiff_series(std::span<const StackInput> inputs, const ReadOptions& options) {
  return Tiffs(inputs).trace(options, inputs.front().name);
}

}  // namespace loft::io
