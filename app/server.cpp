// SPDX-License-Identifier: MIT
#include "app/server.h"

#include <httplib.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <future>
#include <list>
#include <optional>
#include <random>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "app/assets.h"
#include "app/surfaces.h"
#include "io/file.h"
#include "io/slab_glb.h"
#include "io/slices_json.h"
#include "io/surfaces.h"

namespace loft::app {

namespace {

using httplib::Request;
using httplib::Response;
using std::chrono::milliseconds;

/// Each viewer and each request that is being answered takes one.
constexpr std::size_t thread_count = 48;
constexpr int most_viewers = 32;

constexpr milliseconds patience{5000};  // of a POST while the queue is full
constexpr milliseconds heartbeat{10'000};

void answer(Response& response, int status, const Json& json) {
  response.status = status;
  response.set_content(json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n',
                       "application/json");
}

void refuse(Response& response, int status, const std::string& why) {
  answer(response, status, {{"error", why}});
}

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

/// The host without its port: `127.0.0.1`, `[::1]`.
std::string without_port(const std::string& host) {
  const std::size_t colon = host.rfind(':');
  const bool is_bare_v6 = !host.empty() && host.back() == ']';
  return colon == std::string::npos || is_bare_v6 ? host : host.substr(0, colon);
}

bool is_loopback(const std::string& host) {
  return host == "localhost" || host == "[::1]" || host == "::1" || host.starts_with("127.");
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
      : setup_(setup), shown_(shown), feed_(feed), capture_(capture) {
    http_.new_task_queue = [] { return new httplib::ThreadPool(thread_count); };
    http_.set_payload_max_length(setup.most_bytes);
    http_.set_read_timeout(10);
    http_.set_write_timeout(5);
    http_.set_keep_alive_timeout(2);
    http_.set_keep_alive_max_count(100'000);
    http_.set_tcp_nodelay(true);
    http_.set_default_headers({{"Cache-Control", "no-store"},
                               {"X-Content-Type-Options", "nosniff"},
                               {"Referrer-Policy", "no-referrer"}});
    http_.set_pre_routing_handler([this](const Request& request, Response& response) {
      // A body has to be read before it is refused: else it would be taken for the next request.
      const bool has_no_body = request.method == "GET" || request.method == "HEAD";
      return has_no_body && !admit(request, response) ? httplib::Server::HandlerResponse::Handled
                                                      : httplib::Server::HandlerResponse::Unhandled;
    });
    http_.set_error_handler([](const Request& request, Response& response) {
      if (response.body.empty()) explain(request, response);
    });
    http_.set_exception_handler(
        [](const Request&, Response& response, const std::exception_ptr& thrown) {
          try {
            std::rethrow_exception(thrown);
          } catch (const std::exception& error) {
            refuse(response, 500, error.what());
          }
        });
    add_routes();
  }

  [[nodiscard]] int bind() {
    if (setup_.port == 0) return http_.bind_to_any_port(setup_.host);
    return http_.bind_to_port(setup_.host, setup_.port) ? setup_.port : -1;
  }

  void serve() {
    thread_ = std::thread([this] { http_.listen_after_bind(); });
    while (!http_.is_running()) std::this_thread::sleep_for(milliseconds(1));
  }

  void stop() {
    is_stopping_ = true;
    http_.stop();
    if (thread_.joinable()) thread_.join();
  }

 private:
  /// Pages of other sites can make a browser send requests here, and can name this machine as they
  /// like.
  [[nodiscard]] bool admit(const Request& request, Response& response) const {
    const std::string host = request.get_header_value("Host");
    if (is_loopback(setup_.host) && !is_loopback(without_port(host))) {
      refuse(response, 403, "the host is not this machine; start with --host to allow others");
      return false;
    }
    const std::string origin = request.get_header_value("Origin");
    if (!origin.empty() && origin != "http://" + host && request.method != "GET") {
      refuse(response, 403, "pages of other sites may not send edits");
      return false;
    }
    return true;
  }

  static void explain(const Request& request, Response& response) {
    static const std::array paths{"/slices", "/events", "/status", "/"};
    const bool is_known = std::ranges::find(paths, request.path) != paths.end();
    if (response.status == 404 && is_known) {
      response.set_header("Allow", request.path == "/slices" ? "GET, POST" : "GET");
      return refuse(response, 405, "this is not what can be done with " + request.path);
    }
    if (response.status == 413)
      return refuse(response, 413, "the body is too large; send fewer slices at once");
    if (response.status == 404) return refuse(response, 404, "there is no " + request.path);
    refuse(response, std::max(response.status, 400), "the request was not understood");
  }

  void add_routes() {
    if (capture_ != nullptr)
      http_.Post("/slices",
                 [this](const Request& request, Response& response,
                        const httplib::ContentReader& read) { post(request, response, read); });
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
    if (request.is_multipart_form_data()) {
      read([](const auto&) { return true; }, [](const char*, std::size_t) { return true; });
      return refuse(response, 415, "send the edits themselves, a line each, and no form");
    }
    std::string body;
    bool is_too_large = false;
    const bool is_whole = read([&](const char* bytes, std::size_t size) {
      // The library has no limit for bodies that come in chunks. What is too much is read, so that
      // the next request is found behind it, and forgotten.
      is_too_large = is_too_large || size > setup_.most_bytes - body.size();
      if (!is_too_large) body.append(bytes, size);
      return true;
    });
    if (is_too_large) response.status = 413;
    if (!is_whole || is_too_large) return explain(request, response);
    if (!admit(request, response)) return;
    std::list<Line> lines = submit(body);
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

  std::list<Line> submit(std::string_view body) {
    std::list<Line> lines;
    std::size_t count = 0;
    while (!body.empty()) {
      const std::size_t end = std::min(body.find('\n'), body.size());
      const std::string_view text = body.substr(0, end);
      body.remove_prefix(std::min(end + 1, body.size()));
      ++count;
      if (text.find_first_not_of(" \t\r") == std::string_view::npos) continue;
      Line& line = lines.emplace_back(Line{count, io::parse_edit_line(text), {}, 200, {}});
      if (line.read.problems.empty()) {
        submit(line);
      } else {
        line.status = 400;
        for (const std::string& problem : line.read.problems)
          line.error += (line.error.empty() ? "" : "\n") + problem;
      }
    }
    return lines;
  }

  void submit(Line& line) {
    auto promise = std::make_shared<std::promise<Answer>>();
    line.answer = promise->get_future();
    const auto submission = capture_->submit(
        line.read.edit, [promise](const Answer& given) { promise->set_value(given); }, patience);
    if (submission == Capture::Submission::taken) return;
    line.status = 503;
    line.error = submission == Capture::Submission::full
                     ? "too many edits are waiting; send it again"
                     : "the capture has ended";
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
        json["repairs"] = given.repairs;
        json["latency_ms"] = given.latency_ms;
        return json;
      }
      line.status = given.outcome == Answer::Outcome::rejected ? 422 : 507;
      line.error = given.error;
    }
    json["error"] = line.error;
    return json;
  }

  // --- What there is ---

  void slices(const Request& request, Response& response) const {
    if (!request.has_param("z")) return answer(response, 200, {{"slices", shown_.heights()}});
    const auto z = number(request.get_param_value("z"));
    if (!z) return refuse(response, 400, "z is no number");
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
    cursor->next = next_event(request.get_header_value("Last-Event-ID"));
    response.set_header("X-Accel-Buffering", "no");
    response.set_chunked_content_provider(
        "text/event-stream",
        [this, cursor](std::size_t, httplib::DataSink& sink) { return feed(*cursor, sink); },
        [this](bool) { --viewers_; });
  }

  /// The event after one that this server has sent; 0 for others.
  [[nodiscard]] std::uint64_t next_event(std::string_view id) const {
    if (!id.starts_with(token_)) return 0;
    const auto last = number(id.substr(token_.size()));
    return last && *last >= 0 ? static_cast<std::uint64_t>(*last) + 1 : 0;
  }

  /// Sends one event, or nothing for a while. False ends the stream: a reader that takes nothing
  /// runs into the write timeout.
  bool feed(Cursor& cursor, httplib::DataSink& sink) const {
    constexpr milliseconds step{200};
    if (is_stopping_) return false;
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
  Shown& shown_;
  const Feed& feed_;
  Capture* capture_;
  httplib::Server http_;
  /// Tells events of this run from those of others.
  std::string token_ = std::to_string(std::random_device()()) + '.';
  std::thread thread_;
  std::atomic<bool> is_stopping_ = false;
  std::atomic<int> viewers_ = 0;
};

Server::Server(const Setup& setup, Shown& shown, const Feed& feed, Capture* capture)
    : routes_(std::make_unique<Routes>(setup, shown, feed, capture)) {
  const int port = routes_->bind();
  if (port < 0)
    throw Error("cannot listen on " + setup.host + " port " + std::to_string(setup.port) +
                "; it is in use, or not an address of this machine");
  url_ = "http://" + setup.host + ':' + std::to_string(port) + '/';
  routes_->serve();
}

Server::~Server() { routes_->stop(); }

}  // namespace loft::app
