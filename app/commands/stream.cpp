// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/capture/capture.h"
#include "app/capture/edit_source.h"
#include "app/capture/feed.h"
#include "app/capture/intake.h"
#include "app/capture/recorder.h"
#include "app/capture/saver.h"
#include "app/capture/surfaces.h"
#include "app/commands/commands.h"
#include "app/commands/labels.h"
#include "app/commands/settings.h"
#include "app/commands/written.h"
#include "app/interrupt.h"
#include "app/overwriting.h"
#include "app/place.h"
#include "app/report.h"
#include "app/server/server.h"
#include "app/server/shown_capture.h"
#include "app/stopwatch.h"
#include "app/terminal.h"
#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/bytes/text.h"
#include "io/stacks/edit.h"
#include "io/stacks/stack_line.h"
#include "io/surfaces.h"
#include "io/unit.h"

namespace loft::app {

namespace {

using std::chrono::milliseconds;
using std::filesystem::path;

constexpr milliseconds tick{100};

void check_outputs(const StreamCommand& command) {
  std::vector<path> inputs;
  if (command.input) inputs.push_back(*command.input);
  if (command.session) inputs.push_back(*command.session);
  forbid_overwriting(inputs, command.outputs);
  for (const path& output : command.outputs) io::check_writable(output);
  if (!command.replay) return;
  forbid_overwriting(inputs, std::array{*command.replay});
  for (const path& output : command.outputs)
    if (is_same_file(output, *command.replay))
      throw UsageError(output.string() + " is an output and the replay; give them two names");
  if (io::extension(*command.replay) != ".glb")
    throw UsageError(command.replay->string() + ": a replay is a .glb file");
  io::check_writable(*command.replay);
}

/// What the first line of a file says of the stack holds where the command line says nothing.
void take_over_stack_line(StreamCommand& command) {
  constexpr std::streamsize most = 1 << 20;
  if (!command.input || !std::filesystem::is_regular_file(*command.input)) return;
  std::string line(most, '\0');
  std::ifstream file(*command.input, std::ios::binary);
  file.getline(line.data(), most);
  line.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount() - 1, 0)));
  const auto said = io::parse_stack_line(io::without_mark(line));
  if (!said || !said->problems.empty()) return;
  command.takes_stack_line = true;
  const Stack& stack = said->stack;
  command.labels = stack.labels;
  const auto is_open = [&](const char* setting) { return !command.given.contains(setting); };
  if (is_open("unit") && io::metres_per_unit(stack.unit)) command.unit = stack.unit;
  if (is_open("fill") && stack.fill) command.options.fill = *stack.fill;
  if (is_open("keyhole_width") && stack.keyhole_width)
    command.options.keyhole_width = stack.keyhole_width;
}

/// Opens or begins the session; what it was begun with holds.
std::optional<io::Session> open_session(StreamCommand& command) {
  if (!command.session) return {};
  io::Session session(*command.session, io::Session::Access::write);
  const auto settings = session.settings();
  if (!settings.empty()) take_over(settings, command);
  session.set_settings(settings_of(command));
  return session;
}

/// Actions of which one may fail and the others are done all the same.
class Attempts {
 public:
  template <class Action>
  void make(Action action) {
    try {
      action();
    } catch (const Error& error) {
      errors_.emplace_back(error.what());
    }
  }
  [[nodiscard]] const std::vector<std::string>& errors() const { return errors_; }
  /// Throws Error if there was any.
  void check() const {
    std::string words;
    for (const std::string& error : errors_) words += (words.empty() ? "" : "\n") + error;
    if (!words.empty()) throw Error(words);
  }

 private:
  std::vector<std::string> errors_;
};

bool is_file(const std::optional<path>& input) { return input && *input != "-"; }

/// How far the session has the input already.
std::optional<io::InputPosition> position_of(const StreamCommand& command,
                                             const std::optional<io::Session>& session) {
  if (!session || !is_file(command.input)) return {};
  return session->input_position(EditSource::full_name(*command.input));
}

/// A stream while it runs.
class Stream {
 public:
  Stream(const StreamCommand& command, std::optional<io::Session> session)
      : command_(command),
        input_position_(position_of(command, session)),
        terminal_(command.quiet),
        recorder_(io::metres_per_unit(command.unit).value_or(0.001), command.replay_rate,
                  command.labels),
        capture_(setup(), std::move(session), feed_),
        saver_([this] { write_outputs(); }) {}

  ExitCode run() {
    if (capture_.edit_count() > 0)
      terminal_.say("resumed: " + grouped(capture_.edit_count()) + " edits in the session");
    saved_edits_ = capture_.edit_count();
    if (command_.serves) serve();
    if (command_.has_input) read_input();
    while (command_.serves && !is_interrupted()) {
      std::this_thread::sleep_for(tick);
      look_after_outputs();
    }
    return finish();
  }

 private:
  [[nodiscard]] Capture::Setup setup() {
    Capture::Setup setup = setup_of(command_);
    setup.name = name();
    if (command_.replay)
      setup.observe = [this](const NetChange& change, const CaptureView& view) {
        recorder_.add(change, view);
      };
    return setup;
  }

  /// Of the file that stands for it; empty if there is none.
  [[nodiscard]] std::string name() const {
    if (command_.session) return command_.session->filename().string();
    return is_file(command_.input) ? command_.input->filename().string() : "";
  }

  void serve() {
    server_.emplace(Server::Setup{.host = command_.host,
                                  .token = command_.token,
                                  .port = command_.port,
                                  .most_bytes = command_.most_megabytes << 20U},
                    shown_, feed_, &capture_);
    // A token that was drawn is said even with --quiet: without it nobody could send an edit.
    // Behind the # it stays in the browser.
    if (!server_->token().empty() && command_.token.empty())
      std::cerr << "listening on " << server_->url() << "#token=" << server_->token() << std::endl;
    else
      terminal_.say("listening on " + server_->url());
  }

  void read_input() {
    EditSource source(source_setup());
    try {
      while (!is_interrupted() && read_some(source)) look_after_outputs();
    } catch (const io::FileError& error) {
      complain(error.what());
      is_unreadable_ = true;
    }
    if (const std::size_t bytes = source.unfinished_bytes(); bytes > 0)
      say(source.name() + ": the last " + grouped(bytes) +
          " bytes were left out: their line has no end yet");
    while (!is_interrupted() && !intake_.is_idle(tick)) look_after_outputs();
  }

  [[nodiscard]] EditSource::Setup source_setup() {
    EditSource::Setup setup;
    if (is_file(command_.input)) {
      setup.path = *command_.input;
      setup.is_followed = command_.follows;
      setup.start = input_position_;
    }
    setup.say = [this](const std::string& words) { say(words); };
    return setup;
  }

  /// Whether there may be more.
  bool read_some(EditSource& source) {
    std::string line;
    switch (source.next(line, tick)) {
      case EditSource::State::line:
        take(source, line);
        return true;
      case EditSource::State::too_long:
        complain(place_in(source) +
                 "the line is longer than 256 MiB and is left out; slices are a line each");
        ++bad_lines_;
        return true;
      case EditSource::State::waiting:
        return true;
      case EditSource::State::ended:
        break;
    }
    return false;
  }

  [[nodiscard]] static std::string place_in(const EditSource& source) {
    return source.name() + ':' + std::to_string(source.line_number()) + ": ";
  }

  void take(const EditSource& source, const std::string& line) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) return;
    const std::string place = place_in(source);
    if (io::begins_like_stack_line(line)) return look_at_stack(line, place);
    io::EditLine read = io::parse_edit_line(line);
    for (const std::string& problem : read.problems) complain(with_place(problem, place));
    if (!read.problems.empty()) {
      ++bad_lines_;
      return;
    }
    const Intake::Line edit{std::move(read.edit), place, source.position()};
    // What comes faster than it can be worked on waits where it comes from.
    while (!is_interrupted() && !intake_.hand_over(edit, tick)) look_after_outputs();
  }

  /// What a line that is no edit says of the whole stack has been taken over, if it could be.
  void look_at_stack(const std::string& line, const std::string& place) {
    const auto said = io::parse_stack_line(line);
    if (!said) return complain(place + "\"stack\" is no object");
    for (const std::string& problem : said->problems) complain(with_place(problem, place));
    if (!said->problems.empty()) {
      ++bad_lines_;
      return;
    }
    if (said->stack.frame)
      say(place + "a stream has no frame: coordinates stay those of the slices");
    if (!command_.takes_stack_line && (!said->stack.unit.empty() || said->stack.fill))
      say(place +
          "unit and fill rule are taken from the first line of a file only; give --unit and "
          "--fill");
  }

  void say(const std::string& words) {
    const std::lock_guard lock(words_mutex_);
    terminal_.say(words);
  }

  /// From any thread.
  void complain(const std::string& words) {
    const std::lock_guard lock(words_mutex_);
    terminal_.complain(words);
  }

  /// In a terminal: how far it is, ten times a second at most.
  void show_count() {
    if (!terminal_.shows_progress()) return;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_count_) return;
    next_count_ = now + tick;
    const std::string words = counts(capture_.status());
    const std::lock_guard lock(words_mutex_);
    terminal_.show_count(words);
  }

  /// `1,234 edits, 2 rejected; 1,232 slices, 98,765 triangles`
  [[nodiscard]] std::string counts(const Json& status) const {
    const auto count = [&](const char* key) { return grouped(status[key].get<std::size_t>()); };
    return count("edits") + " edits, " + grouped(bad_lines_ + capture_.rejected_count()) +
           " rejected; " + count("slices") + " slices, " + count("faces") + " triangles";
  }

  void look_after_outputs() {
    show_count();
    bool is_wanted = take_output_request();
    if (command_.every > 0 && capture_.edit_count() >= saved_edits_ + command_.every) {
      saved_edits_ = capture_.edit_count();
      is_wanted = true;
    }
    if (is_wanted) saver_.request();
    if (const std::string error = saver_.take_error(); !error.empty()) complain(error);
  }

  /// Of the surface as it is; none as long as there is none. All that can be written are; throws
  /// what was wrong with the others.
  void write_outputs() {
    const std::shared_ptr<const CaptureView> view = capture_.view();
    const Surfaces surfaces(*view, command_.labels);
    if (surfaces.parts().empty()) return;
    io::WriteOptions options;
    options.metres_per_unit = capture_.setup().metres_per_unit;
    options.settings = settings_of(command_);
    options.settings.erase("unit");
    options.settings.erase("labels");
    if (!command_.options.smooth) options.settings.erase("smooth");
    Attempts attempts;
    for (const path& output : command_.outputs)
      attempts.make([&] {
        check_labels_fit(surfaces.parts().size(), output);
        tell(output, io::write(output, surfaces.parts(), options), terminal_);
      });
    attempts.check();
  }

  /// The outputs come first: requests that take long may hold the server up.
  ExitCode finish() {
    if (is_interrupted()) capture_.close(milliseconds(400));
    capture_.close();
    saver_.finish();  // what it writes is older
    if (const std::string error = saver_.take_error(); !error.empty()) complain(error);
    const Json status = capture_.status();
    const bool has_surface = status["faces"] > 0;
    const bool is_written = !has_surface || write_all();
    if (!has_surface && (!command_.outputs.empty() || command_.replay))
      terminal_.warn("there is no surface: it needs two slices with an area; nothing was written");
    feed_.close();
    server_.reset();
    const std::uint64_t rejected = bad_lines_ + capture_.rejected_count();
    terminal_.say(counts(status));
    if (command_.json) print_report(status, rejected);
    if (const std::size_t count = intake_.held_count(); count > 0) {
      complain(grouped(count) + " edits were not kept; send them again");
      return ExitCode::cannot_write;
    }
    if (!is_written) return ExitCode::cannot_write;
    if (is_unreadable_) return ExitCode::bad_input;
    if (rejected > 0 && command_.strict) return ExitCode::bad_input;
    return ExitCode::ok;
  }

  /// Outputs and replay. Whether all of them could be written.
  bool write_all() {
    Attempts attempts;
    attempts.make([&] {
      write_outputs();
      for (const path& output : command_.outputs) terminal_.say("wrote " + output.string());
    });
    if (command_.replay)
      attempts.make([&] {
        recorder_.write(*command_.replay);
        terminal_.say("wrote " + command_.replay->string());
      });
    for (const std::string& error : attempts.errors()) complain(error);
    return attempts.errors().empty();
  }

  void print_report(Json status, std::uint64_t rejected) const {
    status["rejected"] = rejected;
    status.erase("queue");
    status.erase("memory_bytes");
    Json report{{"schema", "loft-stream"}, {"schema_version", 1}};
    report.update(status);
    report["outputs"] = names(command_.outputs);
    std::cout << print(report) << '\n';
  }

  const StreamCommand& command_;
  std::optional<io::InputPosition> input_position_;  // where reading goes on
  Terminal terminal_;
  std::mutex words_mutex_;
  Feed feed_;
  Recorder recorder_;
  Capture capture_;
  ShownCapture shown_{capture_};
  std::optional<Server> server_;
  std::uint64_t bad_lines_ = 0;
  std::uint64_t saved_edits_ = 0;
  std::chrono::steady_clock::time_point next_count_;
  bool is_unreadable_ = false;
  Intake intake_{capture_, [this](const std::string& words) { complain(words); }};
  Saver saver_;  // looks at the capture: ends before it
};

}  // namespace

ExitCode run(const StreamCommand& wanted) {
  StreamCommand command = wanted;
  check_outputs(command);
  catch_interrupts();
  ignore_closed_pipes();
  catch_output_requests();
  take_over_stack_line(command);
  std::optional<io::Session> session = open_session(command);
  return Stream(command, std::move(session)).run();
}

}  // namespace loft::app
