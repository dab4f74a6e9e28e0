// SPDX-License-Identifier: MIT
// A target for libFuzzer: bytes are what a connection sends. However they are cut into pieces the
// same requests must be found in them, within the limits. The first byte says how they are cut.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "app/server/request_reader.h"

namespace {

using loft::app::RequestLimits;
using loft::app::RequestReader;

constexpr RequestLimits limits{.most_head = 512, .most_headers = 8, .most_body = 256};

void expect(bool is_so, const char* what) {
  if (is_so) return;
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

/// What the library is given: one request, which ends where its length says.
void judge(const std::string& request) {
  const std::size_t end = request.find("\r\n\r\n");
  expect(end != std::string::npos, "no end of the head");
  const std::size_t mark = request.find("\r\nContent-Length: ");
  const bool has_length = mark < end;
  const std::size_t length =
      has_length ? std::strtoul(request.c_str() + mark + 18, nullptr, 10) : 0;
  expect(request.size() == end + 4 + length, "the length is not that of the body");
  expect(length <= limits.most_body, "the body is too large");
}

std::vector<std::string> requests(std::string_view bytes, std::size_t piece) {
  RequestReader reader(limits);
  std::vector<std::string> found;
  while (!bytes.empty()) {
    const std::size_t size = piece < bytes.size() ? piece : bytes.size();
    auto state = reader.read(bytes.substr(0, size));
    bytes.remove_prefix(size);
    while (state == RequestReader::State::whole) {
      found.push_back(reader.take_request());
      judge(found.back());
      state = reader.next();
    }
    expect(state != RequestReader::State::refused || reader.size() == 0, "a refusal keeps bytes");
    expect(reader.size() <= limits.most_head + limits.most_body + piece + 512, "too much is kept");
    if (state == RequestReader::State::refused) found.push_back("refused");
    if (state == RequestReader::State::refused) break;
  }
  return found;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(bytes) + 1, size - 1);
  const auto whole = requests(text, size);
  expect(requests(text, 1 + bytes[0] % 32) == whole, "pieces make other requests");
  return 0;
}
