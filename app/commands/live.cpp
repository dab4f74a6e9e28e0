// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/commands/commands.h"
#include "app/exit_code.h"
#include "app/interrupt.h"
#include "app/json.h"
#include "app/live/live_server.h"
#include "app/live/scenes.h"
#include "app/terminal.h"
#include "io/bytes/file.h"
#include "io/scenes.h"
#include "io/tables.h"

namespace loft::app {

namespace {

/// The map to open, and the tab that it goes to.
struct LiveScene {
  io::Scene scene;
  std::string tab;
};

bool is_point_table(const std::filesystem::path& file) {
  const std::string known = io::point_table_extensions() + ' ';
  return known.find(io::extension(file) + ' ') != std::string::npos;
}

/// Points in rows as features, with their values as a property.
io::Map read_points_as_map(const std::filesystem::path& file) {
  const std::vector<io::WantedColumn> wanted{{{"value", "z", "height", "weight"}, false}};
  const io::PointTable table = io::read_point_table(file, wanted);
  const auto& values = table.values().front();
  io::Map map;
  for (std::size_t i = 0; i < table.points().size(); ++i) {
    io::Feature& feature = map.features.emplace_back();
    feature.points.push_back(table.points()[i]);
    if (values) feature.properties = Json{{"value", values->values[i]}}.dump();
  }
  return map;
}

io::Scene read_any_scene(const std::filesystem::path& file) {
  if (is_point_table(file)) return {.map = read_points_as_map(file)};
  return io::read_scene(file);
}

LiveScene opened(const LiveCommand& command) {
  LiveScene live{read_any_scene(*command.scene), command.tab.value_or("")};
  std::size_t vertices = 0;
  for (const io::Feature& feature : live.scene.map.features)
    for (const overlay::Polygon& polygon : feature.polygons) vertices += polygon.outer.size();
  if (live.scene.map.features.size() > most_items || vertices > 2'000'000)
    throw InputError(command.scene->string() +
                     ": a page shows 20,000 features and 2,000,000 vertices at most");
  if (live.tab.empty())
    live.tab = io::extension(*command.scene) == ".map" ? "paths" : tab_for(live.scene.map);
  return live;
}

std::vector<Tab> tabs_of(const LiveCommand& command, std::string& first) {
  LiveScene live{.scene = {}, .tab = command.tab.value_or(tab_names().front())};
  if (command.scene) live = opened(command);
  first = live.tab;
  std::vector<Tab> tabs;
  for (const std::string& name : tab_names()) {
    const bool is_opened = command.scene && name == live.tab;
    tabs.push_back({name, std::make_unique<SharedScene>(
                              make_scene(name, is_opened ? &live.scene.map : nullptr))});
  }
  return tabs;
}

}  // namespace

ExitCode run(const LiveCommand& command) {
  catch_interrupts();
  LiveServer::Setup setup{.host = command.host, .token = command.token, .port = command.port};
  std::vector<Tab> tabs = tabs_of(command, setup.first);
  const LiveServer server(setup, std::move(tabs));
  Terminal terminal(command.quiet);
  // A token that was drawn is said even with --quiet: without it nobody could send an edit.
  if (!server.token().empty() && command.token.empty())
    std::cerr << "listening on " << server.url() << "#token=" << server.token() << std::endl;
  else
    terminal.say("listening on " + server.url());
  while (!is_interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  return ExitCode::ok;
}

}  // namespace loft::app
