// SPDX-License-Identifier: MIT
#include "app/server/http.h"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace loft::app {

namespace {

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

/// The host without its port and brackets: `127.0.0.1`, `::1`.
std::string bare(const std::string& host) {
  if (host.starts_with('[')) return host.substr(1, host.find(']') - 1);
  const std::size_t colon = host.find(':');
  const bool is_v6 = colon != host.rfind(':');
  return is_v6 ? host : host.substr(0, colon);
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

bool is_loopback(const std::string& host) {
  std::string name = bare(host);
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
  if (name == "localhost" || name == "localhost.") return true;
  in_addr v4{};
  if (inet_pton(AF_INET, name.c_str(), &v4) == 1) return ntohl(v4.s_addr) >> 24U == 127;
  in6_addr v6{};
  return inet_pton(AF_INET6, name.c_str(), &v6) == 1 && IN6_IS_ADDR_LOOPBACK(&v6);
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
