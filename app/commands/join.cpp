// SPDX-License-Identifier: MIT
#include <iostream>

#include "app/commands/commands.h"
#include "app/interrupt.h"
#include "app/json.h"
#include "app/overwriting.h"
#include "app/report.h"
#include "app/terminal.h"
#include "io/bytes/file.h"
#include "io/meshes/ply_join.h"
#include "io/surfaces.h"

namespace loft::app {

namespace {

std::string to_json(const JoinCommand& command, const io::JoinedPly& joined) {
  Json json = begin_report("loft-join", 1, command.parts, {&command.output, 1});
  json["labels"] = joined.labels;
  json["vertices"] = joined.vertices;
  json["faces"] = joined.faces;
  return print(json);
}

}  // namespace

ExitCode run(const JoinCommand& command) {
  Terminal terminal(command.quiet);
  if (io::extension(command.output) != ".ply")
    throw UsageError("loft join writes a PLY file; give -o OUT.ply");
  forbid_overwriting(command.parts, {&command.output, 1});
  io::check_writable(command.output);
  catch_interrupts();
  const io::JoinedPly joined = io::join_ply_parts(command.parts, command.output, [&](double share) {
    terminal.show_progress("join", share);
    return !is_interrupted();
  });
  terminal.clear_progress();
  terminal.say(counted(command.parts.size(), "part") + " joined: " + grouped(joined.faces) +
               " triangles, " + grouped(joined.vertices) + " vertices");
  terminal.say("wrote " + command.output.string());
  if (command.json) std::cout << to_json(command, joined) << '\n';
  return ExitCode::ok;
}

}  // namespace loft::app
