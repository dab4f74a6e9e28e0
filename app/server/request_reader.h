// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace loft::app {

struct RequestLimits {
  std::size_t most_head = std::size_t{64} << 10U;
  std::size_t most_headers = 100;
  std::size_t most_body = std::size_t{16} << 20U;
};

/// Finds where requests begin and end in the bytes of a connection, with no more memory than the
/// limits say. What can be read in two ways is refused: a length given twice, or next to chunks;
/// lines that end without a carriage return; folded headers; control characters. After a refusal no
/// byte of the connection is read as a request.
class RequestReader {
 public:
  enum class State { head, body, whole, refused };
  struct Refusal {
    int status = 400;
    std::string why;
  };

  explicit RequestReader(const RequestLimits& limits) : limits_(limits) {}

  /// Takes bytes as they come; those behind the end of a request wait for next().
  State read(std::string_view bytes);
  /// Goes on behind a whole request.
  State next();

  /// Nothing more is wanted of it.
  void give_up(int status, std::string why) { refuse(status, std::move(why)); }

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] const Refusal& refusal() const { return refusal_; }
  [[nodiscard]] bool has_begun() const { return state_ != State::head || !pending_.empty(); }
  [[nodiscard]] const std::string& method() const { return method_; }
  [[nodiscard]] std::string_view path() const;  ///< without its query
  /// Whether the client waits for a word before it sends its body; true once.
  [[nodiscard]] bool take_expectation() { return std::exchange(is_expecting_, false); }
  /// What it holds, in bytes.
  [[nodiscard]] std::size_t size() const { return pending_.size() + body_.size(); }

  /// A whole request as it would come from a plain client: its body with its length, no ranges.
  [[nodiscard]] std::string take_request();

 private:
  enum class Framing { none, length, chunks };
  enum class Chunk { size, data, data_end, trailer };

  State step();
  State read_head();
  void read_request_line(std::string_view line);
  void read_header(std::string_view line);
  void read_framing(const std::string& name, std::string_view value);
  State read_length();
  State read_chunks();
  bool read_chunk_line(std::string_view line);
  State refuse(int status, std::string why);

  RequestLimits limits_;
  State state_ = State::head;
  Refusal refusal_;
  std::string pending_;      // not looked at yet
  std::size_t scanned_ = 0;  // of it, for the end of the head
  std::string method_;
  std::string target_;
  std::string head_;  // lines that are passed on
  std::string body_;
  Framing framing_ = Framing::none;
  Chunk chunk_ = Chunk::size;
  std::size_t left_ = 0;  // of the body, or of the chunk
  std::size_t trailer_size_ = 0;
  bool has_host_ = false;
  bool is_expecting_ = false;
};

}  // namespace loft::app
