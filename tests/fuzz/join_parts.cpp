// SPDX-License-Identifier: MIT
// The bytes are laid over the second of two sound parts: a place (two bytes), a length, that many
// bytes, and so on; a length of 0 ends the file there. With a checksum that is right again they are
// joined to something, or refused.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/bytes/checksum.h"
#include "io/bytes/little_endian.h"
#include "io/meshes.h"
#include "io/meshes/ply_join.h"
#include "io/meshes/ply_part.h"
#include "io/meshes/ply_pieces.h"
#include "reconstruct/out_of_core.h"
#include "tests/fuzz/target.h"

namespace {

using namespace loft;
using std::filesystem::path;

path scratch(const char* name) {
  return std::filesystem::temp_directory_path() /
         ("fuzz-" + std::to_string(::getpid()) + '-' + name + ".ply");
}

/// Squares that touch in corners, so that vertices are doubled.
Slice slice_at(std::uint32_t i) {
  const double x = i % 2;
  return {static_cast<double>(i),
          {{{{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}}, ""},
           {{{x + 1, 1}, {x + 2, 1}, {x + 2, 2}, {x + 1, 2}}, ""}}};
}

void make_part(SlabRange range, const path& output) {
  SliceSource source;
  for (std::uint32_t i = 0; i < 6; ++i) source.slices.push_back({static_cast<double>(i), 8});
  source.read = slice_at;
  io::PlyPieces pieces(output, {""});
  const SlabsReport made = reconstruct_slabs(source, {.threads = 1}, range, {}, pieces);
  std::vector<std::uint32_t> places = made.lower_places;
  places.insert(places.end(), made.upper_places.begin(), made.upper_places.end());
  pieces.commit({range, 5, {{"stack", "0"}}, {made.sizes}}, places);
}

std::string sound_part() {
  static const std::string bytes = [] {
    make_part({0, 3}, scratch("low"));
    make_part({3, 5}, scratch("high"));
    std::ifstream in(scratch("high"), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }();
  return bytes;
}

void lay_over_part(std::string& part, const std::uint8_t* bytes, std::size_t size) {
  for (std::size_t i = 0; i + 2 < size && !part.empty();) {
    const std::size_t place = (bytes[i] * 256U + bytes[i + 1]) % part.size();
    const std::size_t length = bytes[i + 2] % 16U;
    i += 3;
    if (length == 0) part.resize(place);
    for (std::size_t k = 0; k < length && i < size && place + k < part.size(); ++k, ++i)
      part[place + k] = static_cast<char>(bytes[i]);
  }
}

void mend_checksum(std::string& part) {
  if (part.size() < io::ply_checksum_size) return;
  const std::size_t body = part.size() - io::ply_checksum_size;
  io::put(part.data() + body, io::checksum(std::string_view(part).substr(0, body)));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  std::string part = sound_part();
  lay_over_part(part, bytes, size);
  mend_checksum(part);
  std::ofstream(scratch("high"), std::ios::binary) << part;
  fuzz::try_to([&] {
    static_cast<void>(
        io::join_ply_parts(std::array{scratch("high"), scratch("low")}, scratch("joined")));
    fuzz::use(io::read_meshes(scratch("joined")));
  });
  return 0;
}
