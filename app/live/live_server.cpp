// SPDX-License-Identifier: MIT
#include "app/live/live_server.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <regex>
#include <utility>

#include "app/server/http.h"

namespace loft::app {

namespace {

using httplib::Request;
using httplib::Response;

constexpr std::size_t most_edit_bytes = std::size_t{1} << 20U;
constexpr std::chrono::milliseconds tick{40};

/// Whatever goes wrong, the others go on; whoever edits that scene is told.
void advance(SharedScene& scene) {
  try {
    scene.advance();
  } catch (const std::exception&) {
  }
}

template <class Do>
void answer_or_refuse(Response& response, Do act) {
  try {
    act();
  } catch (const Refusal& refusal) {
    refuse(response, refusal.status(), refusal.what());
  }
}

}  // namespace

LiveServer::LiveServer(const Setup& setup, std::vector<Tab> tabs)
    : tabs_(std::move(tabs)),
      first_(setup.first),
      token_(setup.token.empty() && !is_loopback(setup.host) ? random_token() : setup.token),
      site_(site_setup(setup)) {
  add_routes();
  url_ = site_.bind();
  site_.serve();
  clock_ = std::thread([this] { keep_time(); });
}

LiveServer::~LiveServer() {
  is_ending_ = true;
  clock_.join();
}

SharedScene* LiveServer::find(const std::string& name) const {
  const auto found = std::ranges::find(tabs_, name, &Tab::name);
  return found == tabs_.end() ? nullptr : found->scene.get();
}

Site::Setup LiveServer::site_setup(const Setup& setup) const {
  return {.host = setup.host,
          .token = token_,
          .port = setup.port,
          .most_bytes = most_edit_bytes,
          .assets = live_assets(),
          .methods = [this](const std::string& path) { return methods(path); }};
}

std::string LiveServer::methods(const std::string& path) const {
  static const std::regex known(R"(/|/events|/tabs|/tabs/[a-z]+/[a-z]+)");
  if (path.starts_with("/tabs/") && find(path.substr(6)) != nullptr) return "POST";
  return std::regex_match(path, known) ? "GET, HEAD" : "";
}

void LiveServer::add_routes() {
  Gate& http = site_.routes();
  http.Post(R"(/tabs/([a-z]+))",
            [this](const Request& request, Response& response, const httplib::ContentReader& read) {
              post(request, response, read);
            });
  http.Get(R"(/tabs/([a-z]+)/([a-z]+))",
           [this](const Request& request, Response& response) { ask(request, response); });
  http.Get("/events",
           [this](const Request& request, Response& response) { send_events(request, response); });
  http.Get("/tabs",
           [this](const Request&, Response& response) { answer(response, 200, overview()); });
}

void LiveServer::post(const Request& request, Response& response,
                      const httplib::ContentReader& read) {
  if (!has_body(request))
    return refuse_and_close(response, 411, "a body needs its length, or to come in chunks");
  const auto body = site_.take_body(request, response, read);
  if (!body || !site_.admit(request, response)) return;
  SharedScene* const scene = find(request.matches[1].str());
  if (scene == nullptr) return refuse(response, 404, "there is no such tab");
  answer_or_refuse(response, [&] { answer(response, 200, scene->apply(*body)); });
}

void LiveServer::ask(const Request& request, Response& response) const {
  SharedScene* const scene = find(request.matches[1].str());
  if (scene == nullptr) return refuse(response, 404, "there is no such tab");
  const std::string what = request.matches[2].str();
  answer_or_refuse(response, [&] {
    const Question question =
        read_question(what, request.get_param_value("id"), request.get_param_value("at"));
    if (const auto bytes = scene->bytes(question))
      response.set_content(*bytes, "application/octet-stream");
    else
      answer(response, 200, scene->answer(question));
  });
}

void LiveServer::send_events(const Request& request, Response& response) {
  SharedScene* const scene = find(request.get_param_value("tab"));
  if (scene == nullptr) return refuse(response, 404, "there is no such tab");
  site_.stream(request, response, scene->feed(), [scene] { return scene->state(); });
}

Json LiveServer::overview() const {
  Json tabs = Json::array();
  for (const Tab& tab : tabs_)
    tabs.push_back({{"name", tab.name}, {"events", tab.scene->feed().last()}});
  return {{"tabs", std::move(tabs)}, {"first", first_}, {"viewers", site_.viewers()}};
}

/// Time stands still while nobody looks.
void LiveServer::keep_time() {
  while (!is_ending_) {
    std::this_thread::sleep_for(tick);
    if (site_.viewers() == 0) continue;
    for (const Tab& tab : tabs_) advance(*tab.scene);
  }
}

}  // namespace loft::app
