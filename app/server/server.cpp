// SPDX-License-Identifier: MIT
#include "app/server/server.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <list>
#include <optional>
#include <regex>
#include <string_view>
#include <utility>
#include <vector>

#include "app/capture/surfaces.h"
#include "app/server/assets.h"
#include "app/server/http.h"
#include "app/server/site.h"
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

constexpr milliseconds patience{5000};  // of a POST while the queue is full

/// So many bytes of slabs go into an answer, and what the last one has beyond.
constexpr std::size_t most_slab_bytes = std::size_t{4} << 20U;

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
      : shown_(shown), feed_(feed), capture_(capture), site_(site_setup(setup)) {
    add_routes();
  }

  [[nodiscard]] std::string bind() { return site_.bind(); }

  void serve() { site_.serve(); }

 private:
  [[nodiscard]] Site::Setup site_setup(const Setup& setup) const {
    return {.host = setup.host,
            .token = setup.token,
            .port = setup.port,
            .most_bytes = setup.most_bytes,
            .assets = assets(),
            .methods = [this](const std::string& path) { return methods(path); }};
  }

  [[nodiscard]] std::string methods(const std::string& path) const {
    static const std::regex known(
        R"(/|/slices|/slabs|/events|/status|/labels|/history|/surface\..*|/slabs/.*)");
    if (capture_ != nullptr && path == "/slices") return "GET, HEAD, POST";
    if (capture_ != nullptr && (path == "/undo" || path == "/redo")) return "POST";
    return std::regex_match(path, known) ? "GET, HEAD" : "";
  }

  void add_routes() {
    Gate& http = site_.routes();
    if (capture_ != nullptr) add_changes();
    http.Get("/slices",
             [this](const Request& request, Response& response) { slices(request, response); });
    http.Get("/slabs",
             [this](const Request& request, Response& response) { slabs(request, response); });
    http.Get(R"(/slabs/(\d{1,9})-(\d{1,9})\.glb)",
             [this](const Request& request, Response& response) { slab(request, response); });
    http.Get(R"(/surface(\.[a-z]{3,4}))",
             [this](const Request& request, Response& response) { surface(request, response); });
    http.Get("/events", [this](const Request& request, Response& response) {
      site_.stream(request, response, feed_, [this] { return shown_.reset_event(); });
    });
    http.Get("/history", [this](const Request&, Response& response) { tell_history(response); });
    http.Get("/labels", [this](const Request&, Response& response) {
      answer(response, 200, to_json(shown_.labels()));
    });
    http.Get("/status", [this](const Request&, Response& response) {
      Json status = shown_.status();
      status["viewers"] = site_.viewers();
      answer(response, 200, status);
    });
  }

  void add_changes() {
    Gate& http = site_.routes();
    http.Post("/slices",
              [this](const Request& request, Response& response,
                     const httplib::ContentReader& read) { post(request, response, read); });
    for (const Way way : {Way::undo, Way::redo})
      http.Post(way == Way::undo ? "/undo" : "/redo",
                [this, way](const Request& request, Response& response,
                            const httplib::ContentReader& read) {
                  if (has_body(request) && !site_.take_body(request, response, read)) return;
                  if (site_.admit(request, response)) go(way, response);
                });
  }

  // --- Edits ---

  /// Back or forth.
  void go(Way way, Response& response) {
    auto promise = std::make_shared<std::promise<Answer>>();
    std::future<Answer> future = promise->get_future();
    const auto submission = capture_->submit(
        way, [promise](const Answer& given) { promise->set_value(given); }, patience);
    if (submission != Capture::Submission::taken) {
      response.set_header("Retry-After", "1");
      return refuse(response, 503,
                    submission == Capture::Submission::full
                        ? "too many edits are waiting; send it again"
                        : "the capture has ended");
    }
    const Answer given = future.get();
    if (given.outcome != Answer::Outcome::taken)
      return refuse(response, status_of(given), given.error);
    Json result{{"z", given.z}, {"op", io::name(given.kind)}};
    tell(given, result);
    answer(response, 200, {{"results", Json::array({std::move(result)})}});
  }

  void post(const Request& request, Response& response, const httplib::ContentReader& read) {
    if (!has_body(request))
      return refuse_and_close(response, 411, "a body needs its length, or to come in chunks");
    const std::optional<std::string> body = site_.take_body(request, response, read);
    if (!body || !site_.admit(request, response)) return;
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

  static void tell(const Answer& given, Json& json) {
    json["removed"] = given.removed;
    json["added"] = given.added;
    json["repairs"] = cut(given.repairs);
    json["latency_ms"] = given.latency_ms;
  }

  [[nodiscard]] static int status_of(const Answer& given) {
    switch (given.outcome) {
      case Answer::Outcome::taken:
        return 200;
      case Answer::Outcome::nothing:
        return 409;
      case Answer::Outcome::rejected:
        return 422;
      case Answer::Outcome::ended:
        return 503;
      case Answer::Outcome::not_kept:
        break;
    }
    return 507;
  }

  [[nodiscard]] static Json result(Line& line) {
    Json json{{"line", line.number}};
    if (line.read.z) json["z"] = *line.read.z;
    json["op"] = io::name(line.read.edit.kind);
    if (line.status == 200) {
      const Answer given = line.answer.get();
      if (given.outcome == Answer::Outcome::taken) {
        tell(given, json);
        return json;
      }
      line.status = status_of(given);
      line.error = given.error;
    }
    json["error"] = line.error;
    return json;
  }

  // --- What there is ---

  void slices(const Request& request, Response& response) const {
    if (!request.has_param("z")) return answer(response, 200, {{"slices", shown_.heights()}});
    const auto z = whole_number(request.get_param_value("z"));
    if (!z || !std::isfinite(*z)) return refuse(response, 400, "z is no number");
    const auto slice = shown_.slice(*z);
    if (!slice) return refuse(response, 404, "there is no slice at that height");
    std::string line;
    io::append_slice(line, *slice);
    response.set_content(line + '\n', "application/x-ndjson");
  }

  void tell_history(Response& response) const {
    std::optional<Json> history = shown_.history();
    if (!history) return refuse(response, 404, "there are no edits");
    if (capture_ == nullptr) (*history)["can_undo"] = (*history)["can_redo"] = false;
    answer(response, 200, *history);
  }

  void slab(const Request& request, Response& response) {
    const auto part = std::stoul(request.matches[1].str());
    const auto id = static_cast<std::uint32_t>(std::stoul(request.matches[2].str()));
    const auto glb = shown_.slab(part, id);
    if (!glb) return refuse(response, 404, "there is no such slab; it is gone, or never was");
    response.set_content(*glb, "model/gltf-binary");
  }

  void slabs(const Request& request, Response& response) {
    const auto ranges = parse_slab_ranges(request.get_param_value("ids"));
    if (!ranges) return refuse(response, 400, "ids are like 0-17,1-3..65");
    const std::string glbs = shown_.slabs(*ranges, most_slab_bytes);
    if (glbs.empty()) return refuse(response, 404, "there are no such slabs; they are gone");
    response.set_content(glbs, "model/gltf-binary");
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

  Shown& shown_;
  const Feed& feed_;
  Capture* capture_;
  Site site_;  // ends before what its requests use
};

Server::Server(const Setup& wanted, Shown& shown, const Feed& feed, Capture* capture) {
  Setup setup = wanted;
  if (setup.token.empty() && capture != nullptr && !is_loopback(setup.host))
    setup.token = random_token();
  token_ = setup.token;
  routes_ = std::make_unique<Routes>(setup, shown, feed, capture);
  url_ = routes_->bind();
  routes_->serve();
}

Server::~Server() = default;

}  // namespace loft::app
