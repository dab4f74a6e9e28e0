// SPDX-License-Identifier: MIT
#pragma once

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "tests/sanitized.h"

namespace loft::app::testing {

/// A connection that may send what it likes.
class Raw {
 public:
  explicit Raw(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    is_open_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    set_patience(std::chrono::seconds(5));
  }
  ~Raw() { ::close(socket_); }
  Raw(const Raw&) = delete;
  Raw& operator=(const Raw&) = delete;

  void set_patience(std::chrono::microseconds time) const {
    timeval patience{time.count() / 1'000'000, time.count() % 1'000'000};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  }
  [[nodiscard]] bool is_open() const { return is_open_; }
  /// Whether all of it went out.
  bool send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (count <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
  }
  /// All that comes until the other side ends it, or is silent; then `is_ended` says which.
  std::string read_all(bool* is_ended = nullptr) const {
    std::string text;
    char bytes[4096];
    ssize_t count = 0;
    while ((count = ::recv(socket_, bytes, sizeof bytes, 0)) > 0)
      text.append(bytes, static_cast<std::size_t>(count));
    if (is_ended != nullptr) *is_ended = count == 0;
    return text;
  }

 private:
  int socket_;
  bool is_open_ = false;
};

/// AddressSanitizer keeps what is freed for a while, and shadows all of it.
#ifdef LOFT_SANITIZED
inline constexpr double memory_factor = 8;
#else
inline constexpr double memory_factor = 1;
#endif

}  // namespace loft::app::testing
