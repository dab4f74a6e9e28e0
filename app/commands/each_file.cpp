// SPDX-License-Identifier: MIT
#include "app/commands/each_file.h"

#include <algorithm>
#include <iostream>
#include <utility>

#include "app/failure.h"
#include "app/terminal.h"

namespace loft::app {

Json EachFile::begin(const std::filesystem::path& file) const {
  return {{"schema", schema_}, {"schema_version", 1}, {name_, file.string()}};
}

ExitCode EachFile::run(std::span<const std::filesystem::path> files, const Look& look) const {
  Terminal terminal;
  Json list = Json::array();
  ExitCode worst = ExitCode::ok;
  for (const std::filesystem::path& file : files) {
    Json json = begin(file);
    ExitCode code = ExitCode::ok;
    try {
      code = look(file, json);
    } catch (...) {
      if (files.size() == 1) throw;
      const Failure failure = current_failure();
      std::cout.flush();  // what is said about files stays in their order
      terminal.complain(failure.words);
      code = failure.code;
      json = begin(file);
      json["error"] = failure.words;
    }
    worst = std::max(worst, code);
    list.push_back(std::move(json));
  }
  if (is_json_) std::cout << print(files.size() == 1 ? list.front() : list) << '\n';
  return worst;
}

}  // namespace loft::app
