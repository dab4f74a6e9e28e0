// SPDX-License-Identifier: MIT
#include "io/session/session.h"

#include <array>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "app/capture/history.h"
#include "app/commands/commands.h"
#include "app/commands/settings.h"
#include "app/json.h"
#include "app/overwriting.h"
#include "app/report.h"
#include "app/terminal.h"
#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/session/stack_state.h"
#include "io/stacks/slices_json.h"
#include "reconstruct/number_text.h"

namespace loft::app {

namespace {

using io::Edit;

/// One line an edit, then what there is in all.
ExitCode list(const SessionCommand& command) {
  const io::Session session(command.file, io::Session::Access::read);
  io::StackState state;
  std::uint64_t count = 0;
  Json edits = Json::array();
  session.for_each([&](std::uint64_t number, Edit&& edit) {
    if (command.json) {
      edits.push_back({{"number", number},
                       {"op", io::name(edit.kind)},
                       {"z", edit.slice.z},
                       {"contours", edit.slice.contours.size()},
                       {"points", point_count(edit.slice)}});
    } else {
      std::cout << number << ' ' << io::name(edit.kind) << " z = " << exact(edit.slice.z) << ", "
                << edit.slice.contours.size() << " contours, " << point_count(edit.slice)
                << " points\n";
    }
    static_cast<void>(state.apply(edit));
    ++count;
  });
  const auto settings = session.settings();
  if (command.json) {
    const Json report{{"schema", "loft-session"},
                      {"schema_version", 1},
                      {"edits", std::move(edits)},
                      {"slices", state.slices().size()},
                      {"settings", settings}};
    std::cout << print(report) << '\n';
    return ExitCode::ok;
  }
  std::cout << counted(count, "edit") << ", " << counted(state.slices().size(), "slice")
            << " now\n";
  for (const auto& [setting, value] : settings) std::cout << setting << " = " << value << '\n';
  return ExitCode::ok;
}

/// What came back of a session, and what did not.
struct Salvaged {
  std::uint64_t edits = 0;
  std::vector<std::string> faults;
};

/// Writes all that is sound.
Salvaged write_export(const io::Session& session, const SessionCommand& command,
                      std::ostream& out) {
  io::StackState state;
  Salvaged salvaged;
  salvaged.faults = session.salvage([&](std::uint64_t number, Edit&& edit) {
    ++salvaged.edits;
    if (command.at && number >= *command.at) return;
    if (command.edits) {
      out << to_line(edit) << '\n';
    } else if (state.apply(edit) && edit.kind == Edit::Kind::replace) {
      // What it replaced is lost; it is not.
      edit.kind = Edit::Kind::insert;
      static_cast<void>(state.apply(edit));
    }
  });
  if (!command.edits) io::write_slices_json(out, state.stack());
  out.flush();
  return salvaged;
}

/// Exit code and words for a session that was exported.
ExitCode report(const SessionCommand& command, const Salvaged& salvaged) {
  Terminal terminal(command.quiet);
  for (const std::string& fault : salvaged.faults)
    terminal.complain(command.file.string() + ": " + fault);
  if (salvaged.edits == 0 && !salvaged.faults.empty())
    terminal.complain(command.file.string() +
                      ": no edit can be read; nothing was written; restore it from a copy");
  return salvaged.faults.empty() ? ExitCode::ok : ExitCode::bad_input;
}

/// The edits, a line each, as viewers number them.
ExitCode show_history(const SessionCommand& command) {
  const io::Session session(command.file, io::Session::Access::read);
  const Json history = history_of(session).to_json();
  if (command.json) {
    Json report{{"schema", "loft-session-history"}, {"schema_version", 1}};
    report.update(history);
    std::cout << print(report) << '\n';
    return ExitCode::ok;
  }
  for (const Json& edit : history["edits"])
    std::cout << edit["number"] << ' ' << edit["op"].get<std::string>()
              << " z = " << exact(edit["z"].get<double>())
              << (edit["is_undone"] == true ? ", undone" : "") << '\n';
  return ExitCode::ok;
}

ExitCode go(const SessionCommand& command, Way way) {
  io::Session session(command.file, io::Session::Access::write);
  const History history = history_of(session);
  Terminal terminal(command.quiet);
  const auto of = history.next(way);
  if (!of) {
    terminal.complain(command.file.string() + ": there is nothing to " + name(way));
    return ExitCode::check_failed;
  }
  io::StackState stack;
  session.for_each([&](std::uint64_t, Edit&& edit) { static_cast<void>(stack.apply(edit)); });
  const Edit edit = history.edit(way, &session, stack);
  session.append(edit, {*of, way == Way::redo});
  terminal.say(std::string(name(way)) + " of edit " + std::to_string(*of + 1) + ": " +
               io::name(edit.kind) + " z = " + exact(edit.slice.z));
  return ExitCode::ok;
}

ExitCode export_slices(const SessionCommand& command) {
  const io::Session session(command.file, io::Session::Access::read);
  if (command.at) check_at(*command.at, session, command.file);
  if (command.output == "-") return report(command, write_export(session, command, std::cout));
  forbid_overwriting(std::array{command.file}, std::array{command.output});
  io::AtomicFile file(command.output);
  const Salvaged salvaged = write_export(session, command, file.stream());
  const bool has_something = salvaged.edits > 0 || salvaged.faults.empty();
  if (has_something) file.commit();
  const ExitCode code = report(command, salvaged);
  if (has_something) Terminal(command.quiet).say("wrote " + command.output.string());
  return code;
}

/// Everything that can be checked: the file, the edits, whether they apply.
Salvaged examine(const SessionCommand& command) {
  Salvaged salvaged;
  std::vector<std::string> problems;
  try {
    const io::Session session(command.file, io::Session::Access::read);
    problems = session.check();
    io::StackState state;
    std::vector<std::string> not_applied;
    const auto damaged = session.salvage([&](std::uint64_t number, Edit&& edit) {
      if (const auto problem = state.apply(edit))
        not_applied.push_back("edit " + std::to_string(number) + " (" + io::name(edit.kind) +
                              " z = " + exact(edit.slice.z) + "): " + *problem);
      ++salvaged.edits;
    });
    problems.insert(problems.end(), damaged.begin(), damaged.end());
    problems.insert(problems.end(), not_applied.begin(), not_applied.end());
  } catch (const io::DamagedSession& error) {
    problems.emplace_back(error.what());
  }
  salvaged.faults = std::move(problems);
  return salvaged;
}

ExitCode verify(const SessionCommand& command) {
  const Salvaged salvaged = examine(command);
  if (command.json) {
    const Json report{{"schema", "loft-session-verify"},
                      {"schema_version", 1},
                      {"edits", salvaged.edits},
                      {"problems", salvaged.faults}};
    std::cout << print(report) << '\n';
  } else if (salvaged.faults.empty()) {
    std::cout << command.file.string() << ": " << grouped(salvaged.edits) << " edits, all fine\n";
  } else {
    Terminal terminal(command.quiet);
    for (const std::string& fault : salvaged.faults) terminal.complain(fault);
    if (salvaged.edits > 0)
      terminal.say(grouped(salvaged.edits) + " edits are sound; 'loft session export' saves them");
  }
  return salvaged.faults.empty() ? ExitCode::ok : ExitCode::check_failed;
}

}  // namespace

ExitCode run(const SessionCommand& command) {
  switch (command.what) {
    case SessionCommand::What::list:
      return list(command);
    case SessionCommand::What::export_slices:
      return export_slices(command);
    case SessionCommand::What::history:
      return show_history(command);
    case SessionCommand::What::undo:
      return go(command, Way::undo);
    case SessionCommand::What::redo:
      return go(command, Way::redo);
    case SessionCommand::What::verify:
      break;
  }
  return verify(command);
}

}  // namespace loft::app
