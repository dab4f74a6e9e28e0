// SPDX-License-Identifier: MIT
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "app/capture.h"
#include "app/commands.h"
#include "app/feed.h"
#include "app/interrupt.h"
#include "app/mesh_exhibit.h"
#include "app/server.h"
#include "app/settings.h"
#include "app/terminal.h"
#include "app/unit.h"
#include "io/meshes.h"
#include "io/session.h"

namespace loft::app {

namespace {

/// The surface of a session, as its own settings have it; the session is only read.
std::unique_ptr<Exhibit> show_session(const ViewCommand& command, Feed& feed) {
  io::Session session(command.file, io::Session::Access::read);
  StreamCommand stream;
  if (command.unit) stream.unit = *command.unit;
  take_over(session.settings(), stream);
  Capture::Setup setup;
  setup.options = stream.options;
  setup.unit = stream.unit;
  setup.metres_per_unit = metres_per_unit(stream.unit).value_or(0.001);
  return std::make_unique<Capture>(std::move(setup), std::move(session), feed);
}

std::unique_ptr<Exhibit> show(const ViewCommand& command, Feed& feed) {
  if (io::is_mesh_file(command.file))
    return std::make_unique<MeshExhibit>(command.file, command.unit.value_or("mm"));
  return show_session(command, feed);
}

}  // namespace

ExitCode run(const ViewCommand& command) {
  catch_interrupts();
  const Terminal terminal(command.quiet);
  Feed feed;
  const std::unique_ptr<Exhibit> exhibit = show(command, feed);
  const Server server({.host = command.host, .port = command.port}, *exhibit, feed);
  terminal.say("listening on " + server.url());
  while (!is_interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  return ExitCode::ok;
}

}  // namespace loft::app
