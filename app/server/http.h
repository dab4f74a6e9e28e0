// SPDX-License-Identifier: MIT
#pragma once

#include <httplib.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "app/json.h"

namespace loft::app {

/// What every answer says: nothing is kept or guessed, pages take nothing from elsewhere, and no
/// page of another site shows them in a frame.
inline constexpr std::array<std::pair<const char*, const char*>, 4> safe_headers{{
    {"Cache-Control", "no-store"},
    {"X-Content-Type-Options", "nosniff"},
    {"Referrer-Policy", "no-referrer"},
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
     "connect-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
}};

void answer(httplib::Response& response, int status, const Json& json);

/// `{"error": why}`
void refuse(httplib::Response& response, int status, const std::string& why);

/// The same, and then the connection is closed: what is left of the request is not read.
void refuse_and_close(httplib::Response& response, int status, const std::string& why);

/// What a Host header says: `localhost:80`, `[::1]`.
struct HostName {
  std::string name;  ///< without brackets
  std::optional<int> port;
};
/// Nothing where it is not exactly that.
[[nodiscard]] std::optional<HostName> parse_host(const std::string& host);

/// Whether a name is this machine's own: `localhost` or a loopback address.
[[nodiscard]] bool is_loopback(const std::string& name);
/// Whether it is a number, not a name.
[[nodiscard]] bool is_address(const std::string& name);

/// Whether a body comes with the request: without its length its end could not be seen.
[[nodiscard]] bool has_body(const httplib::Request& request);

/// The body of a request, as far as it may be.
struct Body {
  enum class State {
    whole,
    too_large,
    cut_off,  ///< too slow, or the connection failed
  };
  State state = State::whole;
  bool is_read = true;  ///< to its end: the next request is behind it
  std::string text;
};

struct BodyLimits {
  std::size_t most_bytes;
  std::chrono::milliseconds patience;  ///< for all of it
};

/// Reads a body with little memory, whatever it says of itself. Ends early when `is_stopping`.
[[nodiscard]] Body read_body(const httplib::ContentReader& read, const BodyLimits& limits,
                             const std::atomic<bool>& is_stopping);

}  // namespace loft::app
