// SPDX-License-Identifier: MIT
#include "io/gltf/glb_chunks.h"

#include <cstddef>
#include <cstdint>

#include "io/bytes/little_endian.h"

namespace loft::io {

namespace {

constexpr std::size_t glb_header = 12;
constexpr std::size_t chunk_header = 8;

/// Whether there is nothing, or a chunk and all of it.
bool begins_with_whole_chunk(std::string_view rest) {
  if (rest.empty()) return true;
  return rest.size() >= chunk_header &&
         get<std::uint32_t>(rest.data()) <= rest.size() - chunk_header;
}

}  // namespace

std::optional<std::string_view> json_chunk(std::string_view glb) {
  constexpr std::uint32_t json_type = 0x4e4f534a;
  if (glb.size() < glb_header + chunk_header) return {};
  const std::size_t size = get<std::uint32_t>(glb.data() + glb_header);
  const bool is_json = get<std::uint32_t>(glb.data() + glb_header + 4) == json_type;
  if (!is_json || size > glb.size() - glb_header - chunk_header) return {};
  // tinygltf 2.7 forgets the head of the chunk of bytes, and would read beyond the end.
  if (!begins_with_whole_chunk(glb.substr(glb_header + chunk_header + size))) return {};
  return glb.substr(glb_header + chunk_header, size);
}

std::string with_json(std::string_view glb, std::string json) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t old_size = json_chunk(glb)->size();
  std::string result(glb.substr(0, glb_header + chunk_header));
  result += json;
  result += glb.substr(glb_header + chunk_header + old_size);
  put(result.data() + 8, static_cast<std::uint32_t>(result.size()));
  put(result.data() + glb_header, static_cast<std::uint32_t>(json.size()));
  return result;
}

}  // namespace loft::io
