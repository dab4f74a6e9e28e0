// SPDX-License-Identifier: MIT
// The bytes are laid over a sound session: a place (two bytes), a length, that many bytes, and so
// on. Whatever comes of it, it is read without a crash, and what is saved are edits.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/session/session.h"
#include "tests/fuzz/target.h"

namespace {

using namespace loft;
using std::filesystem::path;

path scratch() {
  return std::filesystem::temp_directory_path() /
         ("fuzz-" + std::to_string(::getpid()) + ".session");
}

std::string sound_session() {
  std::filesystem::remove(scratch());
  {
    io::Session session(scratch(), io::Session::Access::write);
    for (int z = 0; z < 6; ++z) {
      const io::Edit edit{io::Edit::Kind::insert, {double(z), {{{{0, 0}, {4, 0}, {0, 4}}, "a"}}}};
      session.append({&edit, 1});
    }
  }
  std::ifstream in(scratch(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void lay_over(std::string& session, const std::uint8_t* bytes, std::size_t size) {
  for (std::size_t i = 0; i + 3 < size;) {
    const std::size_t place = (bytes[i] * 256U + bytes[i + 1]) % session.size();
    const std::size_t length = bytes[i + 2] % 16 + 1U;
    for (std::size_t k = 0; k < length && i + 3 + k < size && place + k < session.size(); ++k)
      session[place + k] = static_cast<char>(bytes[i + 3 + k]);
    i += 3 + length;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const std::string sound = sound_session();
  std::string session = sound;
  lay_over(session, bytes, size);
  std::ofstream(scratch(), std::ios::binary) << session;
  fuzz::try_to([&] {
    const io::Session read(scratch(), io::Session::Access::read);
    std::size_t count = 0;
    const auto faults = read.salvage([&](std::uint64_t, io::Edit&&) { ++count; });
    fuzz::require(count <= 6 || !faults.empty(), "more edits than there were");
    static_cast<void>(read.check());
    static_cast<void>(read.settings());
    read.for_each([](std::uint64_t, io::Edit&&) {});
  });
  std::filesystem::remove(scratch());
  return 0;
}
