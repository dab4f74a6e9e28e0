// SPDX-License-Identifier: MIT
#include "app/server/site.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <exception>
#include <random>

#include "app/server/http.h"
#include "io/bytes/file.h"
#include "reconstruct/defect.h"

namespace loft::app {

namespace {

using httplib::Request;
using httplib::Response;
using std::chrono::milliseconds;

constexpr int most_viewers = 32;

constexpr milliseconds body_patience{60'000};  // until all of it is there
constexpr milliseconds heartbeat{10'000};

template <class Number>
std::optional<Number> number_of(std::string_view text) {
  Number value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

/// In the same time wherever they differ.
bool is_same(const std::string& given, const std::string& wanted) {
  std::size_t difference = given.size() == wanted.size() ? 0 : 1;
  for (std::size_t i = 0; i < given.size() && i < wanted.size(); ++i)
    if (given[i] != wanted[i]) ++difference;
  return difference == 0;
}

}  // namespace

std::string random_token() {
  std::random_device random;  // of the system
  std::string token;
  for (int i = 0; i < 32; ++i) token += "0123456789abcdef"[random() % 16];
  return token;
}

std::optional<double> whole_number(std::string_view text) { return number_of<double>(text); }

Site::Site(const Setup& setup)
    : setup_(setup), run_(std::to_string(std::random_device()()) + '.'), http_(limits(setup)) {
  http_.set_payload_max_length(setup.most_bytes);
  http_.set_default_headers({safe_headers.begin(), safe_headers.end()});
  handle_what_is_refused();
  add_assets();
}

Gate::Limits Site::limits(const Setup& setup) {
  Gate::Limits limits;
  limits.request.most_body = setup.most_bytes;
  limits.most_bytes_in = std::max(4 * setup.most_bytes, limits.most_bytes_in);
  return limits;
}

std::string Site::bind() {
  errno = 0;
  port_ = http_.open(setup_.host, setup_.port);
  if (port_ < 0)
    throw Error("cannot listen on " + setup_.host + " port " + std::to_string(setup_.port) + ": " +
                (errno == 0 ? "there is no such address" : io::last_cause()) +
                "; choose another with --host and --port");
  const bool is_v6 = setup_.host.find(':') != std::string::npos;
  return "http://" + (is_v6 ? '[' + setup_.host + ']' : setup_.host) + ':' + std::to_string(port_) +
         '/';
}

void Site::serve() {
  refuse_bodies();
  http_.serve();
}

void Site::stop() {
  is_stopping_ = true;
  http_.close();
}

// --- Who is let in ---

/// Pages of other sites can make a browser send requests here, and can name this machine as they
/// like: only what names the address that is listened to is answered, and changes come from our
/// own page or from none.
bool Site::admit(const Request& request, Response& response) const {
  const std::string host = request.get_header_value("Host");
  if (!is_own(host)) {
    refuse(response, 403,
           "the host is not this machine at port " + std::to_string(port_) +
               "; start with --host to allow others");
    return false;
  }
  if (request.method == "GET" || request.method == "HEAD") return true;
  const bool is_foreign =
      request.has_header("Origin") && request.get_header_value("Origin") != "http://" + host;
  const std::string site = request.get_header_value("Sec-Fetch-Site");
  if (is_foreign || (!site.empty() && site != "same-origin" && site != "none")) {
    refuse(response, 403, "pages of other sites may not send edits");
    return false;
  }
  if (setup_.token.empty() ||
      is_same(request.get_header_value("Authorization"), "Bearer " + setup_.token))
    return true;
  response.set_header("WWW-Authenticate", "Bearer");
  refuse(response, 401,
         "edits need the token that was printed at the start: Authorization: "
         "Bearer TOKEN");
  return false;
}

/// Whether a Host header names this machine, or what --host says, and the port.
bool Site::is_own(const std::string& host) const {
  const auto named = parse_host(host);
  if (!named || named->port.value_or(80) != port_) return false;
  if (is_loopback(named->name)) return true;
  if (is_loopback(setup_.host)) return false;
  // Names lead here that a page of another site has chosen; addresses do not.
  return named->name == setup_.host || is_address(named->name);
}

void Site::handle_what_is_refused() {
  http_.set_pre_routing_handler([this](const Request& request, Response& response) {
    static const std::array with_body{"POST", "PUT", "PATCH", "DELETE"};
    // A body has to be read before it is refused: else it would be taken for the next request.
    if (std::ranges::find(with_body, request.method) != with_body.end())
      return httplib::Server::HandlerResponse::Unhandled;
    const bool is_known = request.method == "GET" || request.method == "HEAD";
    if (!is_known) explain_method(request, response);
    return is_known && admit(request, response) ? httplib::Server::HandlerResponse::Unhandled
                                                : httplib::Server::HandlerResponse::Handled;
  });
  http_.set_error_handler([this](const Request& request, Response& response) {
    if (!response.has_header("Content-Type")) explain(request, response);
  });
  http_.set_exception_handler(
      [](const Request&, Response& response, const std::exception_ptr& thrown) {
        try {
          std::rethrow_exception(thrown);
        } catch (const std::exception& error) {
          refuse(response, 500, error.what());
        } catch (...) {
          refuse(response, 500, "something went wrong");
        }
      });
}

void Site::explain(const Request& request, Response& response) const {
  const bool is_known = !setup_.methods(request.path).empty();
  if (response.status == 404 && is_known && request.method != "GET")
    return explain_method(request, response);
  if (response.status == 404) return refuse(response, 404, "there is no " + request.path);
  refuse(response, std::max(response.status, 400), "the request was not understood");
}

void Site::explain_method(const Request& request, Response& response) const {
  const std::string methods = setup_.methods(request.path);
  response.set_header("Allow", methods.empty() ? "GET, HEAD" : methods);
  refuse(response, 405, request.method + " is not what can be done with " + request.path);
}

/// The library would keep the bodies of requests that nothing takes.
void Site::refuse_bodies() {
  const auto refuse_body = [this](const Request& request, Response& response,
                                  const httplib::ContentReader& read) {
    if (!has_body(request) || take_body(request, response, read)) {
      response.status = 404;
      if (admit(request, response)) explain(request, response);
    }
  };
  http_.Post(".*", refuse_body).Put(".*", refuse_body).Patch(".*", refuse_body);
  http_.Delete(".*", refuse_body);
}

std::optional<std::string> Site::take_body(const Request& request, Response& response,
                                           const httplib::ContentReader& read) const {
  if (request.is_multipart_form_data()) {
    refuse_and_close(response, 415, "send the edits themselves, a line each, and no form");
    return {};
  }
  Body body = read_body(read, {setup_.most_bytes, body_patience}, is_stopping_);
  if (body.state == Body::State::whole) return std::move(body.text);
  const auto refuse_it = body.is_read ? refuse : refuse_and_close;
  if (body.state == Body::State::too_large || response.status == 413) {
    refuse_it(response, 413, "the body is too large; send fewer slices at once");
  } else {
    refuse_and_close(response, 408, "the body did not come in time, or not all of it");
  }
  return {};
}

void Site::add_assets() {
  for (const Asset& asset : setup_.assets)
    http_.Get(std::string(asset.path), [&asset](const Request&, Response& response) {
      response.set_content(asset.content.data(), asset.content.size(), std::string(asset.type));
    });
}

// --- Events ---

void Site::stream(const Request& request, Response& response, const Feed& events,
                  const Reset& reset) {
  if (viewers_.fetch_add(1) >= most_viewers) {
    --viewers_;
    response.set_header("Retry-After", "10");
    return refuse(response, 503, "too many viewers");
  }
  // Browsers send the header when they come back by themselves; pages that do it can't.
  const std::string last = request.has_header("Last-Event-ID")
                               ? request.get_header_value("Last-Event-ID")
                               : request.get_param_value("after");
  auto cursor = std::make_shared<Cursor>(Cursor{events, reset, next_event(last)});
  response.set_header("X-Accel-Buffering", "no");
  response.set_chunked_content_provider(
      "text/event-stream",
      [this, cursor](std::size_t, httplib::DataSink& sink) { return feed(*cursor, sink); },
      [this](bool) { --viewers_; });
}

/// The event after one that this server has sent; 0 for others.
std::uint64_t Site::next_event(std::string_view id) const {
  if (!id.starts_with(run_)) return 0;
  const auto last = number_of<std::uint64_t>(id.substr(run_.size()));
  return last ? *last + 1 : 0;
}

/// Sends one event, or nothing for a while. False ends the stream: a reader that takes nothing
/// runs into the write timeout.
bool Site::feed(Cursor& cursor, httplib::DataSink& sink) const {
  constexpr milliseconds step{200};
  if (is_stopping_ || !sink.is_writable()) return false;
  if (cursor.next == 0) return start(cursor, sink);
  const Feed::Reading reading = cursor.feed.read(cursor.next, step);
  switch (reading.outcome) {
    case Feed::Reading::Outcome::event:
      cursor.idle = milliseconds(0);
      if (reading.data.empty()) return start(cursor, sink);
      return send(sink, "change", cursor.next++, reading.data);
    case Feed::Reading::Outcome::too_late:
      return start(cursor, sink);
    case Feed::Reading::Outcome::closed:
      return false;
    case Feed::Reading::Outcome::nothing_new:
      break;
  }
  cursor.idle += step;
  if (cursor.idle < heartbeat) return true;
  cursor.idle = milliseconds(0);
  return sink.write(": still there\n\n", 15);
}

bool Site::start(Cursor& cursor, httplib::DataSink& sink) const {
  const auto [text, next] = cursor.reset();
  cursor.next = next;
  return send(sink, "reset", next - 1, text);
}

bool Site::send(httplib::DataSink& sink, const char* event, std::uint64_t id,
                const std::string& text) const {
  const std::string lines = "id: " + run_ + std::to_string(id) + "\nevent: " + event +
                            "\nretry: 1000\ndata: " + text + "\n\n";
  return sink.write(lines.data(), lines.size());
}

}  // namespace loft::app
