// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "app/live/shared_scene.h"
#include "app/server/site.h"

namespace loft::app {

/// A scene, and how the page calls it.
struct Tab {
  std::string name;  ///< in addresses: `shapes`
  std::unique_ptr<SharedScene> scene;
};

/// Serves the page with its tabs.
///
///     POST /tabs/NAME          an edit (edit.h): 200 once it is done, with the number of its
///     event;
///                              400 it is none, 404 no such tab, 413 too large, 422 the scene has
///                              no such thing, or it would leave the plane, 507 no room
///     GET /tabs/NAME/WHAT      ?id=7&at=x,y: what the scene knows of that, as JSON or numbers
///                              (Scene::bytes()); 404 nothing
///     GET /events?tab=NAME     server-sent events: `reset` with the whole state, then `change`s
///     GET /tabs                their names, that which is shown at first, events and viewers
///     GET /                    the page
///
/// Who is let in, and what becomes of too large or unclear requests: site.h.
class LiveServer {
 public:
  struct Setup {
    std::string host = "127.0.0.1";
    std::string token = {};  ///< drawn where the host is not this machine alone
    int port = 0;
    std::string first = {};  ///< the tab that is shown at first
  };

  /// Binds and serves, in threads of its own. Throws Error where the address cannot be bound.
  LiveServer(const Setup& setup, std::vector<Tab> tabs);
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  [[nodiscard]] const std::string& url() const { return url_; }
  [[nodiscard]] const std::string& token() const { return token_; }

 private:
  [[nodiscard]] SharedScene* find(const std::string& name) const;
  [[nodiscard]] Site::Setup site_setup(const Setup& setup) const;
  [[nodiscard]] std::string methods(const std::string& path) const;
  void add_routes();
  void post(const httplib::Request& request, httplib::Response& response,
            const httplib::ContentReader& read);
  void ask(const httplib::Request& request, httplib::Response& response) const;
  void send_events(const httplib::Request& request, httplib::Response& response);
  [[nodiscard]] Json overview() const;
  void keep_time();

  std::vector<Tab> tabs_;
  std::string first_;
  std::string token_;
  std::string url_;
  std::atomic<bool> is_ending_ = false;
  Site site_;  // ends before what its requests use
  std::thread clock_;
};

}  // namespace loft::app
