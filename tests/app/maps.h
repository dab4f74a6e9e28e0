// SPDX-License-Identifier: MIT
// Small maps, and what goes wrong with them.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace loft::app::testing {

/// `[[x, y], ...]`: a rectangle, closed.
inline std::string box(double left, double low, double right, double high) {
  std::ostringstream text;
  text << "[[" << left << ',' << low << "],[" << right << ',' << low << "],[" << right << ','
       << high << "],[" << left << ',' << high << "],[" << left << ',' << low << "]]";
  return text.str();
}

/// A feature with a name and a geometry of that type; `coordinates` as they are written.
inline std::string feature(const std::string& name, const std::string& coordinates,
                           const std::string& type = "Polygon") {
  return R"({"type":"Feature","properties":{"name":")" + name + R"("},"geometry":{"type":")" +
         type + R"(","coordinates":)" + coordinates + "}}";
}

inline std::string collection(const std::vector<std::string>& features) {
  std::string text = R"({"type":"FeatureCollection","features":[)";
  for (const std::string& one : features) text += (&one == features.data() ? "" : ",") + one;
  return text + "]}";
}

struct BadRun {
  std::string arguments;
  int exit_code;
  std::vector<std::string> words;  ///< all of them are on stderr
};

/// Each run says what is wrong, and leaves no file behind.
inline void expect_bad(const std::map<std::string, std::string>& files,
                       const std::vector<BadRun>& runs) {
  for (const auto& [arguments, exit_code, words] : runs) {
    const Folder folder;
    for (const auto& [name, text] : files) static_cast<void>(folder.write(name, text));
    const Outcome outcome = run(folder, arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments << '\n' << outcome.err;
    EXPECT_EQ(outcome.out, "") << arguments;
    for (const std::string& word : words)
      EXPECT_NE(outcome.err.find(word), std::string::npos) << arguments << '\n' << outcome.err;
    EXPECT_EQ(folder.size(), files.size() + 2) << arguments;  // and out.txt, err.txt
  }
}

}  // namespace loft::app::testing
