// SPDX-License-Identifier: MIT
#include "app/server/server.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <future>
#include <list>
#include <optional>
#include <random>
#include <regex>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "app/capture/surfaces.h"
#include "app/server/assets.h"
#include "app/server/gate.h"
#include "app/server/http.h"
#include "io/bytes/file.h"
#include "io/bytes/text.h"
#include "io/gltf/slab_glb.h"
#include "io/stacks/slices_json.h"
#include "io/stacks/stack_line.h"
#include "io/surfaces.h"

namespace loft::app {

namespace {

using httplib::Request;
using httplib::Response;
using std::chrono::milliseconds;

constexpr int most_viewers = 32;

constexpr milliseconds patience{5000};         // of a POST while the queue is full
constexpr milliseconds body_patience{60'000};  // until all of it is there
constexpr milliseconds heartbeat{10'000};

/// The number that a text is, all of it.
template <class Number>
std::optional<Number> number(std::string_view text) {
  Number value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

std::string random_token() {
  std::random_device random;  // of the system
  std::string token;
  for (int i = 0; i < 32; ++i) token += "0123456789abcdef"[random() % 16];
  return token;
}

/// So many lines, problems of a line or repairs are answered; the others are counted.
constexpr std::size_t most_lines = 1 << 16;
constexpr std::size_t most_words = 20;

/// The first of some words, and how many others there are.
std::vector<std::string> cut(std::vector<std::string> words) {
  if (words.size() <= most_words) return words;
  const std::size_t more = words.size() - most_words;
  words.resize(most_words);
  words.push_back("and " + std::to_string(more) + " more");
  return words;
}

/// One line of a body, and what became of it.
struct Line {
  std::size_t number;
  io::EditLine read;
  std::future<Answer> answer;
  int status = 200;
  std::string error;
};

}  // namespace

class Server::Routes {
 public:
  Routes(const Setup& setup, Shown& shown, const Feed& feed, Capture* capture)
      : setup_(setup), shown_(shown), feed_(feed), capture_(capture), http_(limits(setup)) {
    http_.set_payload_max_length(setup.most_bytes);
    http_.set_default_headers({{"Cache-Control", "no-store"},
                               {"X-Content-Type-Options", "nosniff"},
                               {"Referrer-Policy", "no-referrer"}});
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
    add_routes();
  }

  [[nodiscard]] int bind() { return port_ = http_.open(setup_.host, setup_.port); }

  void serve() { http_.serve(); }

  void stop() {
    is_stopping_ = true;
    http_.close();
  }

 private:
  [[nodiscard]] static Gate::Limits limits(const Setup& setup) {
    Gate::Limits limits;
    limits.request.most_body = setup.most_bytes;
    limits.most_bytes_in = std::max(4 * setup.most_bytes, limits.most_bytes_in);
    return limits;
  }

  /// Pages of other sites can make a browser send requests here, and can name this machine as they
  /// like: only what names the address that is listened to is answered, and changes come from our
  /// own page or from none.
  [[nodiscard]] bool admit(const Request& request, Response& response) const {
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
  [[nodiscard]] bool is_own(const std::string& host) const {
    const auto named = parse_host(host);
    if (!named || named->port.value_or(80) != port_) return false;
    if (is_loopback(named->name)) return true;
    if (is_loopback(setup_.host)) return false;
    // Names lead here that a page of another site has chosen; addresses do not.
    return named->name == setup_.host || is_address(named->name);
  }

  /// In the same time wherever they differ.
  [[nodiscard]] static bool is_same(const std::string& given, const std::string& wanted) {
    std::size_t difference = given.size() == wanted.size() ? 0 : 1;
    for (std::size_t i = 0; i < given.size() && i < wanted.size(); ++i)
      if (given[i] != wanted[i]) ++difference;
    return difference == 0;
  }

  [[nodiscard]] static bool is_known(const std::string& path) {
    static const std::regex known(R"(/|/slices|/events|/status|/surface\..*|/slabs/.*)");
    return std::regex_match(path, known);
  }

  void explain(const Request& request, Response& response) const {
    if (response.status == 404 && is_known(request.path) && request.method != "GET")
      return explain_method(request, response);
    if (response.status == 404) return refuse(response, 404, "there is no " + request.path);
    refuse(response, std::max(response.status, 400), "the request was not understood");
  }

  void explain_method(const Request& request, Response& response) const {
    const bool takes_edits = capture_ != nullptr && request.path == "/slices";
    response.set_header("Allow", takes_edits ? "GET, HEAD, POST" : "GET, HEAD");
    refuse(response, 405, request.method + " is not what can be done with " + request.path);
  }

  void add_routes() {
    if (capture_ != nullptr)
      http_.Post("/slices",
                 [this](const Request& request, Response& response,
                        const httplib::ContentReader& read) { post(request, response, read); });
    // The library would keep the bodies of requests that nothing takes.
    const auto refuse_body = [this](const Request& request, Response& response,
                                    const httplib::ContentReader& read) {
      if (!has_body(request) || take_body(request, response, read)) {
        response.status = 404;
        if (admit(request, response)) explain(request, response);
      }
    };
    http_.Post(".*", refuse_body).Put(".*", refuse_body).Patch(".*", refuse_body);
    http_.Delete(".*", refuse_body);
    http_.Get("/slices",
              [this](const Request& request, Response& response) { slices(request, response); });
    http_.Get(R"(/slabs/(\d{1,9})-(\d{1,9})\.glb)",
              [this](const Request& request, Response& response) { slab(request, response); });
    http_.Get(R"(/surface(\.[a-z]{3,4}))",
              [this](const Request& request, Response& response) { surface(request, response); });
    http_.Get("/events",
              [this](const Request& request, Response& response) { events(request, response); });
    http_.Get("/status", [this](const Request&, Response& response) {
      Json status = shown_.status();
      status["viewers"] = viewers_.load();
      answer(response, 200, status);
    });
    for (const Asset& asset : assets())
      http_.Get(std::string(asset.path), [&asset](const Request&, Response& response) {
        response.set_header("Content-Security-Policy",
                            "default-src 'self'; img-src 'self' blob: data:; connect-src 'self' "
                            "blob:; object-src 'none'; frame-ancestors 'none'");
        response.set_content(asset.content.data(), asset.content.size(), std::string(asset.type));
      });
  }

  // --- Edits ---

  /// Reads the body itself: where a client calls it a form, as curl does unless told otherwise, the
  /// library would take 8 KiB only.
  void post(const Request& request, Response& response, const httplib::ContentReader& read) {
    if (!has_body(request))
      return refuse_and_close(response, 411, "a body needs its length, or to come in chunks");
    const std::optional<std::string> body = take_body(request, response, read);
    if (!body || !admit(request, response)) return;
    if (static_cast<std::size_t>(std::ranges::count(*body, '\n')) > most_lines)
      return refuse(response, 413,
                    "more than " + std::to_string(most_lines) + " lines; send fewer edits at once");
    std::list<Line> lines = submit(io::without_mark(*body));
    if (lines.empty()) return refuse(response, 400, "no edits in the body; a line each");
    int status = 200;
    Json results = Json::array();
    for (Line& line : lines) {
      results.push_back(result(line));
      // What is worst is said: the machine's trouble before the sender's.
      status = std::max(status, line.status);
    }
    if (status == 503) response.set_header("Retry-After", "1");
    answer(response, status, {{"results", std::move(results)}});
  }

  /// The body; none if that was answered already.
  std::optional<std::string> take_body(const Request& request, Response& response,
                                       const httplib::ContentReader& read) {
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

  /// Once there is no room for a line those behind it are not taken either: they may rest on it.
  std::list<Line> submit(std::string_view body) {
    std::list<Line> lines;
    const auto end_of_patience = std::chrono::steady_clock::now() + patience;
    bool has_room = true;
    std::size_t count = 0;
    while (!body.empty()) {
      const std::size_t end = std::min(body.find('\n'), body.size());
      const std::string_view text = body.substr(0, end);
      body.remove_prefix(std::min(end + 1, body.size()));
      ++count;
      if (text.find_first_not_of(" \t\r") == std::string_view::npos) continue;
      if (io::begins_like_stack_line(text)) continue;  // no edit: the capture has its settings
      Line& line = lines.emplace_back(Line{count, io::parse_edit_line(text), {}, 200, {}});
      if (!line.read.problems.empty()) {
        line.status = 400;
        for (const std::string& problem : cut(std::move(line.read.problems)))
          line.error += (line.error.empty() ? "" : "\n") + problem;
      } else if (has_room) {
        has_room = submit(line, end_of_patience);
      } else {
        line.status = 503;
        line.error = "not taken, as a line before it was not; send it again";
      }
    }
    return lines;
  }

  /// Whether there was room for it.
  bool submit(Line& line, std::chrono::steady_clock::time_point end_of_patience) {
    auto promise = std::make_shared<std::promise<Answer>>();
    line.answer = promise->get_future();
    const auto left = std::chrono::duration_cast<milliseconds>(end_of_patience -
                                                               std::chrono::steady_clock::now());
    const auto submission = capture_->submit(
        std::move(line.read.edit), [promise](const Answer& given) { promise->set_value(given); },
        std::max(left, milliseconds(0)));
    if (submission == Capture::Submission::taken) return true;
    line.status = 503;
    line.error = submission == Capture::Submission::full
                     ? "too many edits are waiting; send it again"
                     : "the capture has ended";
    return false;
  }

  [[nodiscard]] static Json result(Line& line) {
    Json json{{"line", line.number}};
    if (line.read.z) json["z"] = *line.read.z;
    json["op"] = io::name(line.read.edit.kind);
    if (line.status == 200) {
      const Answer given = line.answer.get();
      if (given.outcome == Answer::Outcome::taken) {
        json["removed"] = given.removed;
        json["added"] = given.added;
        json["repairs"] = cut(given.repairs);
        json["latency_ms"] = given.latency_ms;
        return json;
      }
      line.status = given.outcome == Answer::Outcome::rejected ? 422
                    : given.outcome == Answer::Outcome::ended  ? 503
                                                               : 507;
      line.error = given.error;
    }
    json["error"] = line.error;
    return json;
  }

  // --- What there is ---

  void slices(const Request& request, Response& response) const {
    if (!request.has_param("z")) return answer(response, 200, {{"slices", shown_.heights()}});
    const auto z = number<double>(request.get_param_value("z"));
    if (!z || !std::isfinite(*z)) return refuse(response, 400, "z is no number");
    const auto slice = shown_.slice(*z);
    if (!slice) return refuse(response, 404, "there is no slice at that height");
    std::string line;
    io::append_slice(line, *slice);
    response.set_content(line + '\n', "application/x-ndjson");
  }

  void slab(const Request& request, Response& response) {
    const auto part = std::stoul(request.matches[1].str());
    const auto id = static_cast<std::uint32_t>(std::stoul(request.matches[2].str()));
    const auto glb = shown_.slab(part, id);
    if (!glb) return refuse(response, 404, "there is no such slab; it is gone, or never was");
    response.set_content(*glb, "model/gltf-binary");
  }

  void surface(const Request& request, Response& response) {
    const std::string extension = request.matches[1].str();
    try {
      const auto content = shown_.surface(extension);
      if (!content) return refuse(response, 404, "there is no surface yet; it needs two slices");
      response.set_header("Content-Disposition",
                          "attachment; filename=\"surface" + extension + '"');
      response.set_content(*content,
                           extension == ".glb" ? "model/gltf-binary" : "application/octet-stream");
    } catch (const io::UnknownFormat& error) {
      refuse(response, 404, error.what());
    }
  }

  // --- Events ---

  /// Where a viewer is in the feed.
  struct Cursor {
    std::uint64_t next = 0;  // 0: it is to start with all that there is
    milliseconds idle{0};
  };

  void events(const Request& request, Response& response) {
    if (viewers_.fetch_add(1) >= most_viewers) {
      --viewers_;
      response.set_header("Retry-After", "10");
      return refuse(response, 503, "too many viewers");
    }
    auto cursor = std::make_shared<Cursor>();
    // Browsers send the header when they come back by themselves; pages that do it can't.
    const std::string last = request.has_header("Last-Event-ID")
                                 ? request.get_header_value("Last-Event-ID")
                                 : request.get_param_value("after");
    cursor->next = next_event(last);
    response.set_header("X-Accel-Buffering", "no");
    response.set_chunked_content_provider(
        "text/event-stream",
        [this, cursor](std::size_t, httplib::DataSink& sink) { return feed(*cursor, sink); },
        [this](bool) { --viewers_; });
  }

  /// The event after one that this server has sent; 0 for others.
  [[nodiscard]] std::uint64_t next_event(std::string_view id) const {
    if (!id.starts_with(token_)) return 0;
    const auto last = number<std::uint64_t>(id.substr(token_.size()));
    return last ? *last + 1 : 0;
  }

  /// Sends one event, or nothing for a while. False ends the stream: a reader that takes nothing
  /// runs into the write timeout.
  bool feed(Cursor& cursor, httplib::DataSink& sink) const {
    constexpr milliseconds step{200};
    if (is_stopping_ || !sink.is_writable()) return false;
    if (cursor.next == 0) return start(cursor, sink);
    const Feed::Reading reading = feed_.read(cursor.next, step);
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

  bool start(Cursor& cursor, httplib::DataSink& sink) const {
    const auto [data, next] = shown_.reset_event();
    cursor.next = next;
    return send(sink, "reset", next - 1, data);
  }

  bool send(httplib::DataSink& sink, const char* event, std::uint64_t id,
            const std::string& data) const {
    const std::string text = "id: " + token_ + std::to_string(id) + "\nevent: " + event +
                             "\nretry: 1000\ndata: " + data + "\n\n";
    return sink.write(text.data(), text.size());
  }

  Setup setup_;
  int port_ = 0;
  Shown& shown_;
  const Feed& feed_;
  Capture* capture_;
  /// Tells events of this run from those of others.
  std::string token_ = std::to_string(std::random_device()()) + '.';
  std::atomic<bool> is_stopping_ = false;
  std::atomic<int> viewers_ = 0;
  Gate http_;  // ends before what its requests use
};

Server::Server(const Setup& wanted, Shown& shown, const Feed& feed, Capture* capture) {
  Setup setup = wanted;
  if (setup.token.empty() && capture != nullptr && !is_loopback(setup.host))
    setup.token = random_token();
  token_ = setup.token;
  routes_ = std::make_unique<Routes>(setup, shown, feed, capture);
  errno = 0;
  const int port = routes_->bind();
  if (port < 0)
    throw Error("cannot listen on " + setup.host + " port " + std::to_string(setup.port) + ": " +
                (errno == 0 ? "there is no such address" : io::last_cause()) +
                "; choose another with --host and --port");
  const bool is_v6 = setup.host.find(':') != std::string::npos;
  url_ =
      "http://" + (is_v6 ? '[' + setup.host + ']' : setup.host) + ':' + std::to_string(port) + '/';
  routes_->serve();
}

Server::~Server() { routes_->stop(); }

}  // namespace loft::app
