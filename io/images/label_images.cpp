// SPDX-License-Identifier: MIT
#include "io/images/label_images.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/volumes/outlines.h"
#include "io/volumes/raw_pixels.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

std::uint32_t number_of(const Colour& colour) {
  return std::uint32_t{colour.red} << 16U | std::uint32_t{colour.green} << 8U | colour.blue;
}

StackLabel label_of_colour(std::uint32_t number) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string name = "#";
  for (int shift = 20; shift >= 0; shift -= 4) name += digits[number >> shift & 0xfU];
  const auto part = [&](unsigned shift) { return static_cast<std::uint8_t>(number >> shift); };
  return {name, Colour{part(16), part(8), part(0)}, name};
}

/// Whether one is the other's beginning.
bool agree(const std::vector<PaletteColour>& a, const std::vector<PaletteColour>& b) {
  const auto shorter = static_cast<std::ptrdiff_t>(std::min(a.size(), b.size()));
  return std::equal(a.begin(), a.begin() + shorter, b.begin());
}

/// How often each of 256 values is met: those of soft edges are seldom, but of many kinds.
class Shades {
 public:
  void count(std::span<const double> values) {
    for (const double value : values)
      if (value >= 0 && value < 256) ++counts_[static_cast<std::size_t>(value)];
  }
  [[nodiscard]] std::string note(const std::string& name) const {
    constexpr std::ptrdiff_t many = 32;
    std::uint64_t between = 0;
    for (std::size_t value = 1; value < 255; ++value) between += counts_[value];
    const auto kinds = 254 - std::count(counts_.begin() + 1, counts_.end() - 1, 0U);
    if (kinds < many || counts_[0] == 0 || counts_[255] < 3 * between) return {};
    return name + ": " + std::to_string(kinds) +
           " of its values look like soft edges of what is white, and became labels; if they are "
           "edges, give --level 128";
  }

 private:
  std::array<std::uint64_t, 256> counts_{};
};

class Series {
 public:
  Series(const std::vector<LabelImage>& images, const ReadImage& read)
      : images_(images), read_(read) {}

  Stack operator()(Volume volume, const ReadOptions& options, bool may_be_shares) {
    require_one_size();
    volume.columns = images_.front().columns;
    volume.rows = images_.front().rows;
    volume.slices = static_cast<std::uint32_t>(images_.size());
    find_ink();
    if (ink_ != Ink::grey && options.level)
      throw InputError(volume.name +
                       ": a level is for images of grey, not of colours; leave out --level, or "
                       "save the images in grey");
    if (ink_ == Ink::palette) volume.label_of = [this](std::uint32_t i) { return of_palette(i); };
    if (ink_ == Ink::colour) volume.label_of = label_of_colour;
    volume.read = [this](std::uint32_t slice, std::uint32_t, std::span<double> pixels) {
      read_slice(slice, pixels);
    };
    set_level(volume, options, may_be_shares && ink_ == Ink::grey);
    Stack stack = trace(volume, options);
    if (const auto note = shades_.note(volume.name); !volume.level && !note.empty())
      stack.notes.push_back(note);
    return stack;
  }

 private:
  void require_one_size() const {
    const LabelImage& first = images_.front();
    for (const LabelImage& image : images_)
      if (image.columns != first.columns || image.rows != first.rows)
        throw InputError(image.name + ": is of " + std::to_string(image.columns) + " x " +
                         std::to_string(image.rows) + " pixels, " + first.name + " of " +
                         std::to_string(first.columns) + " x " + std::to_string(first.rows) +
                         "; slices of a stack are of one size");
  }

  /// What the numbers are that all images can give.
  void find_ink() {
    ink_ = images_.front().ink;
    for (const LabelImage& image : images_) {
      white_ = std::max(white_, image.white);
      if (image.ink != ink_ || !agree(image.palette, palette())) ink_ = Ink::colour;
      if (image.palette.size() > palette().size()) longest_ = &image;
    }
    if (ink_ != Ink::colour) return;
    for (const LabelImage& image : images_)
      if (image.ink == Ink::grey && image.white == 0)
        throw InputError(image.name +
                         ": is grey, others of the series have colours; save all alike");
  }

  [[nodiscard]] const std::vector<PaletteColour>& palette() const {
    return longest_ == nullptr ? images_.front().palette : longest_->palette;
  }

  [[nodiscard]] StackLabel of_palette(std::uint32_t index) const {
    StackLabel label{std::to_string(index), {}, std::to_string(index)};
    if (index < palette().size()) label.colour = palette()[index].colour;
    return label;
  }

  void read_slice(std::size_t slice, std::span<double> pixels) {
    read_(slice, pixels);
    const LabelImage& image = images_[slice];
    if (image.ink == Ink::palette)
      use_palette(image, pixels);
    else if (image.ink == Ink::grey)
      use_grey(image, pixels);
  }

  void use_palette(const LabelImage& image, std::span<double> pixels) const {
    for (double& pixel : pixels) {
      const auto index = static_cast<std::size_t>(pixel);
      if (index >= image.palette.size()) {
        if (ink_ == Ink::colour) pixel = 0;
      } else if (image.palette[index].is_clear) {
        pixel = 0;
      } else if (ink_ == Ink::colour) {
        pixel = number_of(image.palette[index].colour);
      }
    }
  }

  void use_grey(const LabelImage& image, std::span<double> pixels) {
    if (ink_ == Ink::grey) {
      if (image.white != white_)
        for (double& pixel : pixels) pixel *= white_ / image.white;
      shades_.count(pixels);
      return;
    }
    for (double& pixel : pixels) {
      const auto part = static_cast<std::uint8_t>(std::lround(pixel / image.white * 255));
      pixel = number_of({part, part, part});
    }
  }

  const std::vector<LabelImage>& images_;
  const ReadImage& read_;
  Ink ink_ = Ink::grey;
  double white_ = 0;
  const LabelImage* longest_ = nullptr;  // of palettes
  Shades shades_;
};

}  // namespace

Stack trace_images(Volume volume, const std::vector<LabelImage>& images, const ReadImage& read,
                   const ReadOptions& options, bool may_be_shares) {
  if (images.empty()) throw InputError(volume.name + ": has no image; give a file with slices");
  return Series(images, read)(std::move(volume), options, may_be_shares);
}

}  // namespace loft::io
