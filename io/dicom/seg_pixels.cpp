// SPDX-License-Identifier: MIT
#include "io/dicom/seg_pixels.h"

#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dcxfer.h>

#include <bit>

#include "io/bytes/little_endian.h"
#include "io/dicom/rle.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

constexpr std::string_view rle_lossless = "1.2.840.10008.1.2.5";

/// As they are in memory, words in the order of the machine.
std::string_view pixel_bytes(DcmItem& item) {
  const Uint8* bytes = nullptr;
  const Uint16* words = nullptr;
  unsigned long count = 0;
  if (item.findAndGetUint8Array(DCM_PixelData, bytes, &count).good() && bytes != nullptr)
    return {reinterpret_cast<const char*>(bytes), count};
  if (item.findAndGetUint16Array(DCM_PixelData, words, &count).good() && words != nullptr)
    return {reinterpret_cast<const char*>(words), 2 * count};
  return {};
}

/// What is packed, in fragments of which the first is a table of the others; null if nothing is.
DcmPixelSequence* pixel_sequence(DcmItem& item, E_TransferSyntax syntax) {
  DcmElement* element = nullptr;
  if (item.findAndGetElement(DCM_PixelData, element).bad()) return nullptr;
  auto* const data = dynamic_cast<DcmPixelData*>(element);
  DcmPixelSequence* sequence = nullptr;
  if (data == nullptr || data->getEncapsulatedRepresentation(syntax, nullptr, sequence).bad())
    return nullptr;
  return sequence;
}

}  // namespace

SegPixels::SegPixels(DicomObject& object, std::uint16_t bits, std::uint64_t frame_pixels,
                     std::size_t count)
    : object_(object), bits_(bits), frame_pixels_(frame_pixels) {
  const std::string& uid = object.transfer_syntax();
  const DcmXfer syntax(uid.c_str());
  if (uid.empty() || !syntax.isEncapsulated())
    find_bytes(count);
  else if (uid == rle_lossless)
    find_fragments(count);
  else
    fail("pixels are compressed by " + std::string(syntax.getXferName()) + " (" + uid +
         "), which is not read; convert it with gdcmconv --raw IN OUT");
}

void SegPixels::fail(const std::string& what) const {
  throw InputError(object_.name() + ": (7fe0,0010): " + what);
}

void SegPixels::find_bytes(std::size_t count) {
  bytes_ = pixel_bytes(object_.data_set());
  const std::uint64_t needed = (frame_pixels_ * bits_ * count + 7) / 8;
  if (bytes_.size() < needed)
    fail("has " + std::to_string(bytes_.size()) + " bytes where " + std::to_string(count) +
         " frames need " + std::to_string(needed) + "; the file was cut off, export it again");
}

void SegPixels::find_fragments(std::size_t count) {
  DcmPixelSequence* const sequence = pixel_sequence(object_.data_set(), EXS_RLELossless);
  DcmObject* item = sequence == nullptr ? nullptr : sequence->nextInContainer(nullptr);
  while (item != nullptr && (item = sequence->nextInContainer(item)) != nullptr) {
    Uint8* bytes = nullptr;
    auto& fragment = static_cast<DcmPixelItem&>(*item);
    if (fragment.getUint8Array(bytes).bad()) bytes = nullptr;
    fragments_.emplace_back(reinterpret_cast<const char*>(bytes),
                            bytes == nullptr ? 0 : fragment.getLength());
  }
  if (fragments_.size() != count)
    fail("has " + std::to_string(fragments_.size()) + " fragments for " + std::to_string(count) +
         " frames; export the segmentation again");
  const std::uint64_t needed = (frame_pixels_ * bits_ + 7) / 8;
  for (std::size_t i = 0; i < count; ++i)
    if (fragments_[i].size() < needed / most_by_rle)
      fail("fragment " + std::to_string(i) + " has " + std::to_string(fragments_[i].size()) +
           " bytes, in which no frame of " + std::to_string(needed) +
           " can be packed; the file was cut off, export it again");
}

/// Bits of frames follow each other without any between, also within a byte.
void SegPixels::read(std::size_t frame, std::span<double> values) const {
  if (fragments_.empty()) {
    std::uint64_t bit = frame_pixels_ * bits_ * frame;
    for (double& number : values) {
      number = value(bytes_, bit);
      bit += bits_;
    }
    return;
  }
  const std::size_t segments = bits_ == 16 ? 2 : 1;
  const std::size_t segment_size = (frame_pixels_ * bits_ + 7) / 8 / segments;
  const std::string bytes =
      unpack_rle(fragments_[frame], segments, segment_size,
                 object_.name() + ": (7fe0,0010): fragment " + std::to_string(frame));
  std::uint64_t bit = 0;
  for (std::size_t i = 0; i < values.size(); ++i, bit += bits_) {
    if (segments == 1)
      values[i] = value(bytes, bit);
    else
      values[i] = static_cast<unsigned char>(bytes[i]) * 256.0 +
                  static_cast<unsigned char>(bytes[segment_size + i]);
  }
}

double SegPixels::value(std::string_view bytes, std::uint64_t bit) const {
  const char* const place = bytes.data() + bit / 8;
  if (bits_ == 1) return static_cast<unsigned char>(*place) >> (bit % 8) & 1U;
  if (bits_ == 8) return static_cast<unsigned char>(*place);
  return get<std::uint16_t>(place, std::endian::native);
}

}  // namespace loft::io
