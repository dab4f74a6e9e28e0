// SPDX-License-Identifier: MIT
#include "io/session.h"

#include <array>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/json.h"
#include "app/overwriting.h"
#include "app/report.h"
#include "app/terminal.h"
#include "io/atomic_file.h"
#include "io/file.h"
#include "io/slices_json.h"
#include "io/stack_state.h"
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
  std::cout << grouped(count) << " edits, " << grouped(state.slices().size()) << " slices now\n";
  for (const auto& [setting, value] : settings) std::cout << setting << " = " << value << '\n';
  return ExitCode::ok;
}

/// Writes as far as the session can be read; what cannot is said afterwards.
void write_export(const SessionCommand& command, std::ostream& out) {
  const io::Session session(command.file, io::Session::Access::read);
  io::StackState state;
  std::exception_ptr damage;
  try {
    session.for_each([&](std::uint64_t, Edit&& edit) {
      if (command.edits) {
        out << to_line(edit) << '\n';
      } else {
        static_cast<void>(state.apply(edit));
      }
    });
  } catch (const io::FileError&) {
    damage = std::current_exception();
  }
  if (!command.edits) io::write_slices_json(out, state.stack());
  out.flush();
  if (damage) std::rethrow_exception(damage);
}

ExitCode export_slices(const SessionCommand& command) {
  if (command.output == "-") {
    write_export(command, std::cout);
    return ExitCode::ok;
  }
  forbid_overwriting(std::array{command.file}, std::array{command.output});
  io::AtomicFile file(command.output);
  try {
    write_export(command, file.stream());
  } catch (const io::FileError&) {
    file.commit();  // what could be saved
    throw;
  }
  file.commit();
  Terminal(command.quiet).say("wrote " + command.output.string());
  return ExitCode::ok;
}

/// Everything that can be checked; edits that do not apply are listed, all of them.
ExitCode verify(const SessionCommand& command) {
  Terminal terminal(command.quiet);
  std::vector<std::string> problems;
  std::uint64_t count = 0;
  try {
    const io::Session session(command.file, io::Session::Access::read);
    session.check();
    io::StackState state;
    session.for_each([&](std::uint64_t number, Edit&& edit) {
      if (const auto problem = state.apply(edit))
        problems.push_back("edit " + std::to_string(number) + " (" + io::name(edit.kind) +
                           " z = " + exact(edit.slice.z) + "): " + *problem);
      ++count;
    });
  } catch (const io::FileError& error) {
    if (!std::filesystem::exists(command.file)) throw;
    problems.emplace_back(error.what());
  }
  if (command.json) {
    const Json report{{"schema", "loft-session-verify"},
                      {"schema_version", 1},
                      {"edits", count},
                      {"problems", problems}};
    std::cout << print(report) << '\n';
  } else {
    for (const std::string& problem : problems) terminal.complain(problem);
    if (problems.empty())
      std::cout << command.file.string() << ": " << grouped(count) << " edits, all fine\n";
  }
  return problems.empty() ? ExitCode::ok : ExitCode::check_failed;
}

}  // namespace

ExitCode run(const SessionCommand& command) {
  switch (command.what) {
    case SessionCommand::What::list:
      return list(command);
    case SessionCommand::What::export_slices:
      return export_slices(command);
    case SessionCommand::What::verify:
      break;
  }
  return verify(command);
}

}  // namespace loft::app
