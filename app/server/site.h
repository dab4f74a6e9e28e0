// SPDX-License-Identifier: MIT
#pragma once

#include <httplib.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "app/capture/feed.h"
#include "app/server/assets.h"
#include "app/server/gate.h"

namespace loft::app {

/// What all sites of Loft have in common: the gate, who is let in, the files of the page, answers
/// where there is nothing to be found, and events for pages. Routes are added to routes() before
/// serve().
///
/// The `Host` of a request must be this machine (or what `host` names, or an address) with the
/// port; changes from pages of other sites (`Origin`, `Sec-Fetch-Site`) are refused: 403. Where
/// `token` is not empty changes need `Authorization: Bearer TOKEN`: 401.
class Site {
 public:
  struct Setup {
    std::string host = "127.0.0.1";
    std::string token = {};
    int port = 0;                                     ///< 0: any that is free
    std::size_t most_bytes = std::size_t{16} << 20U;  ///< of a body
    std::span<const Asset> assets = {};
    /// The methods that a path takes, `GET, HEAD`; empty where there is no such path.
    std::function<std::string(const std::string& path)> methods = {};
  };

  explicit Site(const Setup& setup);
  ~Site() { stop(); }
  Site(const Site&) = delete;
  Site& operator=(const Site&) = delete;

  [[nodiscard]] Gate& routes() { return http_; }
  /// Its address, `http://127.0.0.1:8080/`. Throws Error where it cannot be bound.
  [[nodiscard]] std::string bind();
  /// In threads of its own.
  void serve();
  /// Lets requests end that have begun.
  void stop();
  [[nodiscard]] const std::atomic<bool>& is_stopping() const { return is_stopping_; }

  /// Whether a request is let in; if not it has been answered.
  [[nodiscard]] bool admit(const httplib::Request& request, httplib::Response& response) const;
  /// The body; none if that was answered already. The library reads what calls itself a form to
  /// 8 KiB only, so bodies are read here.
  [[nodiscard]] std::optional<std::string> take_body(const httplib::Request& request,
                                                     httplib::Response& response,
                                                     const httplib::ContentReader& read) const;

  /// All that there is, and the number of the event after it.
  using Reset = std::function<std::pair<std::string, std::uint64_t>()>;
  /// Answers with server-sent events: `reset` with all that there is, then a `change` for each
  /// event of the feed. A reader that comes back with Last-Event-ID, or `?after=` with the last
  /// one's id, gets what it has missed; all of it anew where that is kept no longer, and in place
  /// of an empty event. The feed must outlive the site.
  void stream(const httplib::Request& request, httplib::Response& response, const Feed& feed,
              const Reset& reset);
  [[nodiscard]] int viewers() const { return viewers_; }

 private:
  /// Where a viewer is in the feed.
  struct Cursor {
    const Feed& feed;
    Reset reset;
    std::uint64_t next = 0;  // 0: it is to start with all that there is
    std::chrono::milliseconds idle{0};
  };

  [[nodiscard]] static Gate::Limits limits(const Setup& setup);
  [[nodiscard]] bool is_own(const std::string& host) const;
  void handle_what_is_refused();
  void explain(const httplib::Request& request, httplib::Response& response) const;
  void explain_method(const httplib::Request& request, httplib::Response& response) const;
  void add_assets();
  void refuse_bodies();
  [[nodiscard]] std::uint64_t next_event(std::string_view id) const;
  bool feed(Cursor& cursor, httplib::DataSink& sink) const;
  bool start(Cursor& cursor, httplib::DataSink& sink) const;
  bool send(httplib::DataSink& sink, const char* event, std::uint64_t id,
            const std::string& text) const;

  Setup setup_;
  int port_ = 0;
  std::string run_;  // tells events of this run from those of others
  std::atomic<bool> is_stopping_ = false;
  std::atomic<int> viewers_ = 0;
  Gate http_;  // ends before what its requests use
};

/// A token for changes that nobody guesses.
[[nodiscard]] std::string random_token();

/// The number that a text is, all of it.
[[nodiscard]] std::optional<double> whole_number(std::string_view text);

}  // namespace loft::app
