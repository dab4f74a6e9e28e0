// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "reconstruct/defect.h"

namespace loft::io {

/// Whether bytes begin as a gzip file does.
[[nodiscard]] bool is_gzip(std::string_view bytes);

/// What gzip (all of its members) or zlib has packed, from its front on, piece by piece.
class InflateStream {
 public:
  /// `bytes` must outlive it. `name` and `offset` as inflate_first(), for messages.
  InflateStream(std::string_view bytes, std::string_view name, std::uint64_t offset = 0);
  ~InflateStream();
  InflateStream(InflateStream&&) noexcept;
  InflateStream& operator=(InflateStream&&) noexcept;

  /// Fills in what comes next; returns how many bytes that were, fewer than asked for only at the
  /// end. Throws InputError as inflate_first().
  std::size_t read(std::span<char> out);

 private:
  class Inflater;
  std::unique_ptr<Inflater> inflater_;
};

/// The first `most` bytes of what gzip (all of its members) or zlib has packed; fewer if there are
/// no more. What follows them is not looked at. Memory: what comes out.
///
/// Throws InputError, with `name` and the byte offset in `bytes` where the packed bytes are wrong
/// or end too early; `offset` is that of their first one.
[[nodiscard]] std::string inflate_first(std::string_view bytes, std::uint64_t most,
                                        std::string_view name, std::uint64_t offset = 0);

/// The same for exactly `size` bytes. Throws InputError if there are fewer, before any memory is
/// taken where packed bytes are too few to hold so many.
[[nodiscard]] std::string inflate_all(std::string_view bytes, std::uint64_t size,
                                      std::string_view name, std::uint64_t offset = 0);

/// Throws InputError, as inflate_all() does, where packed bytes are too few to hold `size` ones.
void require_room_for(std::uint64_t size, std::string_view bytes, std::string_view name,
                      std::uint64_t offset = 0);
/// What is wrong where only `found` of the `size` bytes come out.
[[nodiscard]] InputError too_few_packed(std::uint64_t size, std::uint64_t found,
                                        std::string_view name, std::uint64_t offset = 0);

}  // namespace loft::io
