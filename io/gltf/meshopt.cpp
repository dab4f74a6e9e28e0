// SPDX-License-Identifier: MIT
#include "io/gltf/meshopt.h"

#include <meshoptimizer.h>

#include "io/bytes/little_endian.h"
#include "io/gltf/gltf_model.h"

namespace loft::io {

namespace {

std::vector<std::uint32_t> numbers_of(const Packing& packing, std::string_view bytes) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(packing.count);
  for (std::size_t i = 0; i < packing.count; ++i) {
    const char* const place = bytes.data() + i * packing.stride;
    numbers.push_back(packing.stride == 2 ? get<std::uint16_t>(place) : get<std::uint32_t>(place));
  }
  return numbers;
}

/// What `encode` writes into room for it.
template <class Encode>
std::string encoded(std::size_t room, Encode encode) {
  std::string result(room, '\0');
  result.resize(encode(reinterpret_cast<unsigned char*>(result.data()), room));
  return result;
}

template <class Attribute>
void move_vertices(std::vector<Attribute>& attributes, std::span<const unsigned> places) {
  std::vector<Attribute> moved(attributes.size());
  for (std::size_t i = 0; i < attributes.size(); ++i) moved[places[i]] = attributes[i];
  attributes = std::move(moved);
}

}  // namespace

bool has_meshopt() { return true; }

void reorder(ShadedMesh& mesh) {
  const std::span<const std::uint32_t> corners = corners_of(mesh);
  std::vector<unsigned> ordered(corners.size());
  meshopt_optimizeVertexCacheStrip(ordered.data(), corners.data(), corners.size(),
                                   mesh.points.size());
  std::vector<unsigned> places(mesh.points.size());
  meshopt_optimizeVertexFetchRemap(places.data(), ordered.data(), ordered.size(), places.size());
  move_vertices(mesh.points, places);
  move_vertices(mesh.normals, places);
  for (std::size_t i = 0; i < ordered.size(); ++i) mesh.faces[i / 3][i % 3] = places[ordered[i]];
}

std::vector<OctahedralNormal> octahedral(std::span<const Vec3> normals) {
  std::vector<std::array<float, 4>> vectors;
  vectors.reserve(normals.size());
  for (const Vec3& normal : normals)
    vectors.push_back({static_cast<float>(normal[0]), static_cast<float>(normal[1]),
                       static_cast<float>(normal[2]), 0});
  std::vector<OctahedralNormal> result(normals.size());
  constexpr int bits = 8;
  meshopt_encodeFilterOct(result.data(), result.size(), sizeof(OctahedralNormal), bits,
                          vectors.data()->data());
  return result;
}

std::string pack(const Packing& packing, std::string_view bytes) {
  if (packing.mode == PackedMode::attributes)
    return encoded(meshopt_encodeVertexBufferBound(packing.count, packing.stride),
                   [&](unsigned char* place, std::size_t room) {
                     return meshopt_encodeVertexBuffer(place, room, bytes.data(), packing.count,
                                                       packing.stride);
                   });
  const std::vector<std::uint32_t> indices = numbers_of(packing, bytes);
  meshopt_encodeIndexVersion(1);  // the one of the extension
  if (packing.mode == PackedMode::indices)
    return encoded(meshopt_encodeIndexSequenceBound(indices.size(), indices.size()),
                   [&](unsigned char* place, std::size_t room) {
                     return meshopt_encodeIndexSequence(place, room, indices.data(),
                                                        indices.size());
                   });
  return encoded(meshopt_encodeIndexBufferBound(indices.size(), indices.size()),
                 [&](unsigned char* place, std::size_t room) {
                   return meshopt_encodeIndexBuffer(place, room, indices.data(), indices.size());
                 });
}

namespace {

int decode(const Packing& packing, std::string_view packed, unsigned char* place) {
  const auto* const bytes = reinterpret_cast<const unsigned char*>(packed.data());
  switch (packing.mode) {
    case PackedMode::attributes:
      return meshopt_decodeVertexBuffer(place, packing.count, packing.stride, bytes, packed.size());
    case PackedMode::triangles:
      return meshopt_decodeIndexBuffer(place, packing.count, packing.stride, bytes, packed.size());
    case PackedMode::indices:
      return meshopt_decodeIndexSequence(place, packing.count, packing.stride, bytes,
                                         packed.size());
  }
  return -1;
}

void apply_filter(const Packing& packing, unsigned char* place) {
  if (packing.filter == PackedFilter::octahedral)
    meshopt_decodeFilterOct(place, packing.count, packing.stride);
  if (packing.filter == PackedFilter::quaternion)
    meshopt_decodeFilterQuat(place, packing.count, packing.stride);
  if (packing.filter == PackedFilter::exponential)
    meshopt_decodeFilterExp(place, packing.count, packing.stride);
}

}  // namespace

std::vector<unsigned char> unpack(const Packing& packing, std::string_view packed) {
  std::vector<unsigned char> result(packing.count * packing.stride);
  if (decode(packing, packed, result.data()) != 0) return {};
  apply_filter(packing, result.data());
  return result;
}

}  // namespace loft::io
