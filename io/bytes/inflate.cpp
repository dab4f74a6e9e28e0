// SPDX-License-Identifier: MIT
#include "io/bytes/inflate.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>

namespace loft::io {

/// A stream of zlib's that is given back in any case.
class InflateStream::Inflater {
 public:
  Inflater(std::string_view bytes, std::string_view name, std::uint64_t offset)
      : bytes_(bytes), name_(name), offset_(offset) {
    constexpr int zlib_or_gzip = 15 + 32;
    if (inflateInit2(&stream_, zlib_or_gzip) != Z_OK) throw InputError("zlib has no memory left");
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  std::size_t read(std::span<char> out) {
    std::size_t count = 0;
    while (count < out.size() && !has_ended_) count += fill(out.subspan(count));
    return count;
  }

 private:
  std::size_t fill(std::span<char> out) {
    constexpr std::size_t most = std::numeric_limits<uInt>::max() / 2;
    const std::size_t room = std::min(out.size(), most);
    stream_.next_out = reinterpret_cast<Bytef*>(out.data());
    stream_.avail_out = static_cast<uInt>(room);
    while (stream_.avail_out > 0 && !has_ended_) {
      feed();
      const int answer = inflate(&stream_, Z_NO_FLUSH);
      if (answer == Z_STREAM_END) {
        next_member();
      } else if (answer == Z_BUF_ERROR || (answer == Z_OK && is_used_up() && room_is_left())) {
        fail("ends too early; it was cut off, get it again");
      } else if (answer != Z_OK) {
        fail(std::string("is damaged (") + (stream_.msg == nullptr ? "?" : stream_.msg) +
             "); get the file again");
      }
    }
    return room - stream_.avail_out;
  }

  void feed() {
    if (stream_.avail_in > 0) return;
    const std::size_t count =
        std::min<std::size_t>(bytes_.size() - fed_, std::numeric_limits<uInt>::max() / 2);
    // zlib does not write there; its older interface only does not say so.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes_.data() + fed_));
    stream_.avail_in = static_cast<uInt>(count);
    fed_ += count;
  }

  [[nodiscard]] bool is_used_up() const { return stream_.avail_in == 0 && fed_ == bytes_.size(); }
  [[nodiscard]] bool room_is_left() const { return stream_.avail_out > 0; }

  /// A gzip file may be several ones, one behind the other; anything else behind is none.
  void next_member() {
    const std::size_t behind = fed_ - stream_.avail_in;
    has_ended_ = !is_gzip(bytes_.substr(behind)) || inflateReset(&stream_) != Z_OK;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(std::string(name_) + ": byte " +
                     std::to_string(offset_ + fed_ - stream_.avail_in) + ": what is packed here " +
                     what);
  }

  std::string_view bytes_;
  std::string name_;
  std::uint64_t offset_;
  z_stream stream_{};
  std::size_t fed_ = 0;
  bool has_ended_ = false;
};

InflateStream::InflateStream(std::string_view bytes, std::string_view name, std::uint64_t offset)
    : inflater_(std::make_unique<Inflater>(bytes, name, offset)) {}
InflateStream::~InflateStream() = default;
InflateStream::InflateStream(InflateStream&&) noexcept = default;
InflateStream& InflateStream::operator=(InflateStream&&) noexcept = default;

std::size_t InflateStream::read(std::span<char> out) { return inflater_->read(out); }

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b\x08"); }

std::string inflate_first(std::string_view bytes, std::uint64_t most, std::string_view name,
                          std::uint64_t offset) {
  InflateStream stream(bytes, name, offset);
  std::string result;
  std::array<char, 1 << 16> piece;
  while (result.size() < most) {
    const std::size_t room =
        static_cast<std::size_t>(std::min<std::uint64_t>(piece.size(), most - result.size()));
    const std::size_t count = stream.read(std::span(piece).first(room));
    result.append(piece.data(), count);
    if (count < room) break;
  }
  return result;
}

std::string inflate_all(std::string_view bytes, std::uint64_t size, std::string_view name,
                        std::uint64_t offset) {
  require_room_for(size, bytes, name, offset);
  std::string result = inflate_first(bytes, size, name, offset);
  if (result.size() < size) throw too_few_packed(size, result.size(), name, offset);
  return result;
}

namespace {

InputError cut_off(std::uint64_t size, std::string_view name, std::uint64_t offset,
                   const std::string& held) {
  return InputError(std::string(name) + ": byte " + std::to_string(offset) + ": its header says " +
                    std::to_string(size) + " bytes of pixels, " + held +
                    "; it was cut off, or its sizes are wrong");
}

}  // namespace

void require_room_for(std::uint64_t size, std::string_view bytes, std::string_view name,
                      std::uint64_t offset) {
  constexpr std::uint64_t best = 1100;  // deflate cannot pack more into a byte
  if (size / best > bytes.size())
    throw cut_off(size, name, offset,
                  std::to_string(bytes.size()) + " packed ones cannot hold so many");
}

InputError too_few_packed(std::uint64_t size, std::uint64_t found, std::string_view name,
                          std::uint64_t offset) {
  return cut_off(size, name, offset, "but packed there are " + std::to_string(found));
}

}  // namespace loft::io
