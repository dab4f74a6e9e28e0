// SPDX-License-Identifier: MIT
#include "io/dicom/dicom_inflate.h"

#include <zlib.h>

#include <algorithm>
#include <limits>

#include "reconstruct/defect.h"

namespace loft::io {

namespace {

/// A stream without zlib's header.
class Stream {
 public:
  Stream() { is_good_ = inflateInit2(&stream_, -MAX_WBITS) == Z_OK; }
  ~Stream() { inflateEnd(&stream_); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  [[nodiscard]] bool is_good() const { return is_good_; }
  z_stream& operator*() { return stream_; }

 private:
  z_stream stream_{};
  bool is_good_ = false;
};

[[noreturn]] void fail(std::string_view name, const std::string& what) {
  throw InputError(std::string(name) + ": its deflated data set " + what);
}

}  // namespace

std::string inflate(std::string_view bytes, std::string_view name) {
  constexpr std::size_t largest = std::size_t{1} << 30U;
  constexpr std::size_t step = std::size_t{1} << 16U;
  Stream stream;
  if (!stream.is_good()) fail(name, "cannot be inflated: no memory");
  std::string result;
  z_stream& state = *stream;
  // zlib does not write to what it reads.
  state.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  state.avail_in =
      static_cast<uInt>(std::min<std::size_t>(bytes.size(), std::numeric_limits<uInt>::max()));
  int status = Z_OK;
  while (status == Z_OK) {
    const std::size_t size = result.size();
    if (size >= largest) fail(name, "inflates to more than 1 GiB; store it without compression");
    result.resize(size + step);
    state.next_out = reinterpret_cast<Bytef*>(result.data() + size);
    state.avail_out = step;
    status = ::inflate(&state, Z_NO_FLUSH);
    result.resize(size + step - state.avail_out);
  }
  if (status != Z_STREAM_END)
    fail(name, "is cut off or damaged behind " + std::to_string(result.size()) +
                   " bytes; copy or export it again");
  return result;
}

}  // namespace loft::io
