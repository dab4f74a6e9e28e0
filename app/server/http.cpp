// SPDX-License-Identifier: MIT
#include "app/server/http.h"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <utility>

namespace loft::app {

namespace {

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace

void answer(httplib::Response& response, int status, const Json& json) {
  response.status = status;
  response.set_content(text_of(json), "application/json");
}

void refuse(httplib::Response& response, int status, const std::string& why) {
  answer(response, status, {{"error", why}});
}

void refuse_and_close(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_header("Connection", "close");
  // The library closes a connection only where content fails: it does so behind its end.
  response.set_chunked_content_provider(
      "application/json", [text = text_of({{"error", why}})](std::size_t, httplib::DataSink& sink) {
        sink.write(text.data(), text.size());
        sink.done();
        return false;
      });
}

std::optional<HostName> parse_host(const std::string& host) {
  HostName named;
  const bool has_brackets = host.starts_with('[');
  const std::size_t end = has_brackets ? host.find(']') : host.find(':');
  named.name = host.substr(has_brackets ? 1 : 0, has_brackets ? end - 1 : end);
  std::ranges::transform(named.name, named.name.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (named.name.empty() || (has_brackets && end == std::string::npos)) return {};
  std::string rest = end == std::string::npos ? "" : host.substr(end + (has_brackets ? 1 : 0));
  if (rest.empty()) return named;
  int port = 0;
  const char* const last = rest.data() + rest.size();
  const auto [stop, error] = std::from_chars(rest.data() + 1, last, port);
  if (rest[0] != ':' || error != std::errc() || stop != last || port < 1 || port > 65535) return {};
  named.port = port;
  return named;
}

bool is_loopback(const std::string& name) {
  if (name == "localhost" || name == "localhost.") return true;
  in_addr v4{};
  if (inet_pton(AF_INET, name.c_str(), &v4) == 1) return ntohl(v4.s_addr) >> 24U == 127;
  in6_addr v6{};
  return inet_pton(AF_INET6, name.c_str(), &v6) == 1 && IN6_IS_ADDR_LOOPBACK(&v6);
}

bool is_address(const std::string& name) {
  in_addr v4{};
  in6_addr v6{};
  return inet_pton(AF_INET, name.c_str(), &v4) == 1 || inet_pton(AF_INET6, name.c_str(), &v6) == 1;
}

bool has_body(const httplib::Request& request) {
  return request.has_header("Content-Length") || request.has_header("Transfer-Encoding");
}

Body read_body(const httplib::ContentReader& read, const BodyLimits& limits,
               const std::atomic<bool>& is_stopping) {
  const auto end = std::chrono::steady_clock::now() + limits.patience;
  Body body;
  std::size_t size = 0;
  body.is_read = read([&](const char* bytes, std::size_t count) {
    size += count;
    if (size <= limits.most_bytes) {
      body.text.append(bytes, count);
    } else {
      body.text.clear();
    }
    // What is a little too much is read all the same: then the answer is sure to arrive.
    return size / 4 <= limits.most_bytes && std::chrono::steady_clock::now() < end && !is_stopping;
  });
  if (size > limits.most_bytes) {
    body.state = Body::State::too_large;
  } else if (!body.is_read) {
    body.state = Body::State::cut_off;
  }
  return body;
}

}  // namespace loft::app
