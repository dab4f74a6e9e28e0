// SPDX-License-Identifier: MIT
#include "io/volumes/nifti_header.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "io/bytes/little_endian.h"
#include "reconstruct/defect.h"
#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

constexpr std::uint32_t size_1 = 348;
constexpr std::uint32_t size_2 = 540;

/// Where the fields of a version are.
struct Layout {
  std::size_t dim;
  std::size_t datatype;
  std::size_t pixdim;
  std::size_t vox_offset;
  std::size_t scl_slope;
  std::size_t units;
  std::size_t qform_code;
  std::size_t sform_code;
  std::size_t quatern;
  std::size_t qoffset;
  std::size_t srow;
};

constexpr Layout layout_1{40, 70, 76, 108, 112, 123, 252, 254, 256, 268, 280};
constexpr Layout layout_2{16, 12, 104, 168, 176, 500, 344, 348, 352, 376, 400};

bool has_size(std::string_view bytes, std::uint32_t size, std::endian order) {
  return bytes.size() >= size && get<std::uint32_t>(bytes.data(), order) == size;
}

/// The header's fields, whichever version they are of.
class Fields {
 public:
  Fields(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
      if (!has_size(bytes, size_1, order) && !has_size(bytes, size_2, order)) continue;
      order_ = order;
      is_second_ = has_size(bytes, size_2, order);
      return;
    }
    throw InputError(std::string(name) +
                     ": byte 0: no NIfTI header of 348 or 540 bytes begins "
                     "here; save the file again as .nii.gz");
  }

  [[nodiscard]] bool is_second() const { return is_second_; }
  [[nodiscard]] std::endian order() const { return order_; }
  [[nodiscard]] const Layout& layout() const { return is_second_ ? layout_2 : layout_1; }
  [[nodiscard]] std::string_view magic() const { return bytes_.substr(is_second_ ? 4 : 344, 3); }

  /// dim[i].
  [[nodiscard]] std::int64_t dim(std::size_t i) const {
    if (is_second_) return at<std::int64_t>(layout().dim + 8 * i);
    return at<std::int16_t>(layout().dim + 2 * i);
  }
  /// The i-th of numbers that begin at a place: floats, doubles in NIfTI-2.
  [[nodiscard]] double real(std::size_t place, std::size_t i = 0) const {
    return is_second_ ? at<double>(place + 8 * i) : at<float>(place + 4 * i);
  }
  [[nodiscard]] std::int64_t code(std::size_t place) const {
    return is_second_ ? at<std::int32_t>(place) : at<std::int16_t>(place);
  }
  [[nodiscard]] int units() const {
    return is_second_ ? at<std::int32_t>(layout().units) : at<std::uint8_t>(layout().units);
  }
  [[nodiscard]] std::int16_t datatype() const { return at<std::int16_t>(layout().datatype); }
  [[nodiscard]] double vox_offset() const {
    return is_second_ ? static_cast<double>(at<std::int64_t>(layout().vox_offset))
                      : at<float>(layout().vox_offset);
  }

  [[noreturn]] void fail(std::size_t place, const std::string& what) const {
    throw InputError(std::string(name_) + ": byte " + std::to_string(place) + ": " + what);
  }

 private:
  template <class Number>
  [[nodiscard]] Number at(std::size_t place) const {
    return get<Number>(bytes_.data() + place, order_);
  }

  std::string_view bytes_;
  std::string_view name_;
  std::endian order_ = std::endian::little;
  bool is_second_ = false;
};

PixelType type_of(const Fields& fields) {
  switch (fields.datatype()) {
    case 2:
      return PixelType::u8;
    case 4:
      return PixelType::i16;
    case 8:
      return PixelType::i32;
    case 16:
      return PixelType::f32;
    case 64:
      return PixelType::f64;
    case 256:
      return PixelType::i8;
    case 512:
      return PixelType::u16;
    case 768:
      return PixelType::u32;
    case 1024:
      return PixelType::i64;
    case 1280:
      return PixelType::u64;
    default:
      fields.fail(fields.layout().datatype,
                  "datatype " + std::to_string(fields.datatype()) +
                      " is no kind of number that labels are read from; save it as integers");
  }
}

void set_sizes(Volume& volume, const Fields& fields) {
  const std::int64_t count = fields.dim(0);
  if (count < 1 || count > 7)
    fields.fail(fields.layout().dim, "dim[0] is " + std::to_string(count) +
                                         ": a volume has 1 to 7 dimensions; save it again");
  std::uint64_t sizes[4]{1, 1, 1, 1};
  for (std::size_t i = 1; i <= static_cast<std::size_t>(count); ++i) {
    const std::int64_t size = fields.dim(i);
    std::uint64_t& whole = sizes[std::min<std::size_t>(i - 1, 3)];
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    if (size < 1 || static_cast<std::uint64_t>(size) > most / whole)
      fields.fail(fields.layout().dim, "dim[" + std::to_string(i) + "] is " + std::to_string(size) +
                                           ": no size; save it again");
    whole *= static_cast<std::uint64_t>(size);
  }
  volume.columns = static_cast<std::uint32_t>(sizes[0]);
  volume.rows = static_cast<std::uint32_t>(sizes[1]);
  volume.slices = static_cast<std::uint32_t>(sizes[2]);
  volume.layers = static_cast<std::uint32_t>(sizes[3]);
}

using Matrix = std::array<std::array<double, 4>, 3>;

Matrix sform(const Fields& fields) {
  Matrix matrix;
  for (std::size_t i = 0; i < 12; ++i) matrix[i / 4][i % 4] = fields.real(fields.layout().srow, i);
  return matrix;
}

/// The rotation of a quaternion, of which the file leaves out the real part.
Matrix qform(const Fields& fields, const Vec3& spacing) {
  const double b = fields.real(fields.layout().quatern, 0);
  const double c = fields.real(fields.layout().quatern, 1);
  const double d = fields.real(fields.layout().quatern, 2);
  const double a = std::sqrt(std::max(0.0, 1 - (b * b + c * c + d * d)));
  const Matrix turn{{{a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c), 0},
                     {2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b), 0},
                     {2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - c * c - b * b, 0}}};
  const double mirrored = fields.real(fields.layout().pixdim) < 0 ? -1 : 1;
  Matrix matrix;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      matrix[row][axis] = turn[row][axis] * spacing[axis] * (axis == 2 ? mirrored : 1);
    matrix[row][3] = fields.real(fields.layout().qoffset, row);
  }
  return matrix;
}

Matrix place_of(const Fields& fields, const Volume& volume) {
  const Layout& layout = fields.layout();
  if (fields.code(layout.sform_code) > 0) return sform(fields);
  Vec3 spacing{};
  const std::uint32_t sizes[]{volume.columns, volume.rows, volume.slices};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    spacing[axis] = std::abs(fields.real(layout.pixdim, axis + 1));
    if (spacing[axis] == 0 && sizes[axis] == 1) spacing[axis] = 1;  // nothing is that far apart
  }
  if (fields.code(layout.qform_code) > 0) return qform(fields, spacing);
  return {{{spacing[0], 0, 0, 0}, {0, spacing[1], 0, 0}, {0, 0, spacing[2], 0}}};
}

std::string unit_of(const Fields& fields) {
  switch (fields.units() & 7) {
    case 1:
      return "m";
    case 2:
      return "mm";
    case 3:
      return "um";
    default:
      return {};
  }
}

std::uint64_t pixel_offset(const Fields& fields, const NiftiHeader& header) {
  const double offset = fields.vox_offset();
  const double least = header.is_pair ? 0.0 : static_cast<double>(header.size);
  constexpr double most = 9e15;  // of those that are exact
  if (!(offset >= least && offset <= most) || offset != std::floor(offset))
    fields.fail(fields.layout().vox_offset,
                "vox_offset " + exact(offset) +
                    " is no place behind the header; the file is damaged, save it again");
  return static_cast<std::uint64_t>(offset);
}

/// A slope of 0 or none means that there is none.
void set_scale(RawPixels& pixels, const Fields& fields) {
  const double slope = fields.real(fields.layout().scl_slope, 0);
  const double intercept = fields.real(fields.layout().scl_slope, 1);
  if (!std::isfinite(slope) || slope == 0) return;
  pixels.slope = slope;
  pixels.intercept = std::isfinite(intercept) ? intercept : 0;
}

}  // namespace

bool is_nifti_header(std::string_view bytes) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    if (has_size(bytes, size_1, order)) {
      const std::string_view magic = bytes.substr(344, 3);
      if (magic == "n+1" || magic == "ni1") return true;
    }
    if (has_size(bytes, size_2, order)) {
      const std::string_view magic = bytes.substr(4, 3);
      if (magic == "n+2" || magic == "ni2") return true;
    }
  }
  return false;
}

NiftiHeader read_nifti_header(std::string_view bytes, std::string_view name) {
  const Fields fields(bytes, name);
  NiftiHeader header{};
  header.size = fields.is_second() ? size_2 : size_1;
  const std::string_view magic = fields.magic();
  header.is_pair = magic.starts_with("ni");
  if (!is_nifti_header(bytes))
    fields.fail(fields.is_second() ? 4 : 344,
                "the magic is not n+1, ni1, n+2 or ni2; Analyze 7.5 does not say where its pixels "
                "are: save the file as NIfTI");
  header.volume.name = name;
  set_sizes(header.volume, fields);
  header.volume.unit = unit_of(fields);
  header.volume.to_world = place_of(fields, header.volume);
  header.pixels.type = type_of(fields);
  header.pixels.order = fields.order();
  set_scale(header.pixels, fields);
  header.offset = pixel_offset(fields, header);
  header.has_extensions = bytes.size() > header.size && bytes[header.size] != 0;
  return header;
}

}  // namespace loft::io
