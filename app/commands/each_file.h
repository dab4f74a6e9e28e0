// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "app/exit_code.h"
#include "app/json.h"

namespace loft::app {

/// What `loft info` and `loft check` have in common: they look at one file after the other. With
/// `--json` one file gives an object (schema, schema_version, the file's name, what the command
/// adds), several give a list of them; of one that cannot be read that has `error` and nothing
/// more.
class EachFile {
 public:
  /// Adds what it finds to the object where that is asked for, prints it otherwise.
  using Look = std::function<ExitCode(const std::filesystem::path& file, Json& json)>;

  /// `name`: the key of the file's name.
  EachFile(const char* schema, const char* name, bool is_json)
      : schema_(schema), name_(name), is_json_(is_json) {}

  /// The worst exit code of all. What is wrong with one of several files is said, and the others
  /// are looked at all the same; of a single file, look's exception is thrown.
  ExitCode run(std::span<const std::filesystem::path> files, const Look& look) const;

 private:
  [[nodiscard]] Json begin(const std::filesystem::path& file) const;

  std::string schema_;
  std::string name_;
  bool is_json_;
};

}  // namespace loft::app
