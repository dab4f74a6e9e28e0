// SPDX-License-Identifier: MIT
#include <chrono>
#include <memory>
#include <thread>

#include "app/capture/capture.h"
#include "app/capture/feed.h"
#include "app/commands/commands.h"
#include "app/commands/settings.h"
#include "app/interrupt.h"
#include "app/server/exported_page.h"
#include "app/server/server.h"
#include "app/server/shown_capture.h"
#include "app/server/shown_mesh.h"
#include "app/server/shown_stack.h"
#include "app/terminal.h"
#include "io/meshes.h"
#include "io/session/session.h"
#include "io/stack.h"

namespace loft::app {

namespace {

/// The surface of a session, as it is now.
class SessionView {
 public:
  explicit SessionView(const ViewCommand& command)
      : capture_(setup_of(command), io::Session(command.file, io::Session::Access::read), feed_) {}

  [[nodiscard]] Shown& shown() { return shown_; }

 private:
  /// As it was begun.
  static Capture::Setup setup_of(const ViewCommand& command) {
    StreamCommand begun;
    if (command.unit != begun.unit) begun.given.insert("unit");
    begun.unit = command.unit;
    take_over(io::Session(command.file, io::Session::Access::read).settings(), begun);
    Capture::Setup setup = app::setup_of(begun);
    setup.kind = "session";
    setup.most_edits = command.at;
    setup.name = command.file.filename().string();
    return setup;
  }

  Feed feed_;
  Capture capture_;
  ShownCapture shown_{capture_};
};

void show(const ViewCommand& command, Shown& shown) {
  if (command.folder) {
    export_page(shown, *command.folder, command.overwrites);
    return Terminal(command.quiet).say("wrote " + command.folder->string());
  }
  const Feed nothing_changes;
  const Server server({.host = command.host, .port = command.port}, shown, nothing_changes,
                      nullptr);
  Terminal(command.quiet).say(command.file.string() + ": listening on " + server.url());
  while (!is_interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

}  // namespace

ExitCode run(const ViewCommand& command) {
  catch_interrupts();
  if (io::is_mesh_file(command.file)) {
    ShownMesh mesh(command.file, command.unit);
    show(command, mesh);
  } else if (!io::is_session_file(command.file) && io::is_stack_file(command.file)) {
    ShownStack stack(command.file, command.unit);
    show(command, stack);
  } else {
    if (command.at)
      check_at(*command.at, io::Session(command.file, io::Session::Access::read), command.file);
    SessionView session(command);
    show(command, session.shown());
  }
  return ExitCode::ok;
}

}  // namespace loft::app
