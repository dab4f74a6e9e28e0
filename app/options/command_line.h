// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/commands.h"
#include "app/exit_code.h"

namespace loft::app {

/// The one description of all commands and options: what reads the command line, and what help, the
/// manual page and completions are made of (tree.h).
class CommandLine {
 public:
  CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  [[nodiscard]] CLI::App& app() { return app_; }
  /// Runs the command that was parsed. Throws as the commands do.
  [[nodiscard]] ExitCode run() const;

 private:
  CLI::App app_;
  ReconstructCommand reconstruct_;
  StreamCommand stream_;
  ViewCommand view_;
  LiveCommand live_;
  SessionCommand session_;
  TriangulateCommand triangulate_;
  OverlayCommand overlay_;
  CoverageCommand coverage_;
  QueryCommand query_;
  PathCommand path_;
  ClassifyCommand classify_;
  FieldCommand field_;
  CheckCommand check_;
  InfoCommand info_;
  ConvertCommand convert_;
  SliceCommand slice_;
  JoinCommand join_;
  std::vector<std::string> help_;  // the words behind it
  std::string shell_;
  std::vector<std::pair<const CLI::App*, std::function<ExitCode()>>> runs_;
};

}  // namespace loft::app
