// SPDX-License-Identifier: MIT
// What makes the program easy to use: it names what was meant, counts, and says units.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/app/program.h"

namespace loft::app {
namespace {

using namespace testing;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(Manners, MisspeltCommandsAndOptionsNameTheNearest) {
  const std::map<std::string, std::string> cases{
      {"recnstruct in.ndjson -o a.ply",
       "error: 'recnstruct' is no subcommand of loft; did you mean 'reconstruct'?\n"},
      {"recon", "error: 'recon' is no subcommand of loft; did you mean 'reconstruct'?\n"},
      {"s", "error: 's' is no subcommand of loft; 'loft help' lists them\n"},
      {"triang", "error: 'triang' is no subcommand of loft; did you mean 'triangulate'?\n"},
      {"session exprot a.session",
       "error: 'exprot' is no subcommand of loft session; did you mean 'export'?\n"},
      {"reconstruct in.ndjson -o a.ply --smoth",
       "error: '--smoth' is no option of loft reconstruct; did you mean '--smooth'?\n"},
      {"reconstruct in.ndjson -o a.ply --keyhole_width=1",
       "error: '--keyhole_width' is no option of loft reconstruct; did you mean "
       "'--keyhole-width'?\n"},
      {"check a.ply --frobnicate",
       "error: '--frobnicate' is no option of loft check; 'loft help check' lists them\n"},
      {"help chek", "error: 'chek' is no subcommand of loft; did you mean 'check'?\n"},
  };
  const Folder folder;
  for (const auto& [arguments, words] : cases) {
    const Outcome outcome = run(folder, arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.err, words);
    EXPECT_EQ(outcome.out, "");
  }
}

TEST(Manners, HelpIsACommand) {
  const Folder folder;
  EXPECT_EQ(run(folder, "help").out, run(folder, "--help").out);
  EXPECT_EQ(run(folder, "help reconstruct").out, run(folder, "reconstruct --help").out);
  EXPECT_THAT(run(folder, "help session list").out, HasSubstr("Usage: loft session list"));
  EXPECT_THAT(run(folder, "help").out, Not(HasSubstr("completion")));
}

TEST(Manners, DocumentsTellOfEveryOption) {
  const Folder folder;
  const std::string manual = run(folder, "man").out;
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const Outcome outcome = run(folder, std::string("completion ") + shell);
    EXPECT_EQ(outcome.exit_code, 0);
    for (const char* word : {"keyhole-width", "keyhole-aware", "replay-rate", "verify", "no-fill"})
      EXPECT_THAT(outcome.out, HasSubstr(word)) << shell;
  }
  for (const char* words : {".SS \"loft session export\"", "\\fB\\-\\-keyhole\\-width\\fR",
                            "\\fB\\-\\-no\\-fill\\fR", "Exit codes"})
    EXPECT_THAT(manual, HasSubstr(words));
  EXPECT_EQ(run(folder, "completion tcsh").exit_code, 2);
}

TEST(Manners, HelpShowsTheOptionsOfACommandUnderHeadings) {
  const Folder folder;
  EXPECT_THAT(run(folder, "reconstruct --help").out,
              AllOf(HasSubstr("\nLabels:\n"), HasSubstr("\nTriangles:\n"), HasSubstr("--smooth")));
  EXPECT_THAT(run(folder, "convert --help").out,
              AllOf(HasSubstr("\nReading:\n"), Not(HasSubstr("--smooth")), HasSubstr("--only")));
}

TEST(Manners, ExamplesInHelpUseOptionsThatAreThere) {
  const Folder folder;
  std::size_t options = 0;
  for (const std::string command :
       {"", "reconstruct", "convert", "slice", "info", "check", "stream", "view", "overlay",
        "query", "coverage", "path", "classify", "field"}) {
    std::istringstream lines(run(folder, "help " + command).out);
    for (std::string line; std::getline(lines, line);) {
      const std::size_t begin = line.find("  loft ");
      if (begin == std::string::npos || line.find_first_not_of(' ') != begin + 2) continue;
      std::istringstream words(line);
      std::string used;
      words >> used >> used;
      const std::string help = run(folder, "help " + used).out;
      for (std::string word; words >> word;) {
        if (word[0] != '-') continue;
        ++options;
        EXPECT_THAT(help, HasSubstr(word)) << line;
      }
    }
  }
  EXPECT_GT(options, 20U);
}

TEST(Manners, InfoAndCheckTakeSeveralFiles) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel()));
  static_cast<void>(folder.write("bad.ply", "no mesh"));
  ASSERT_EQ(run(folder, "reconstruct in.ndjson -o a.ply -o a.off -q").exit_code, 0);
  ASSERT_EQ(run(folder, "reconstruct in.ndjson -o open.ply --cap open -q").exit_code, 0);

  EXPECT_THAT(run(folder, "info a.ply in.ndjson").out,
              AllOf(StartsWith("a.ply\n"), HasSubstr("\nin.ndjson\n")));
  EXPECT_EQ(run(folder, "check a.ply a.off --stack in.ndjson").exit_code, 0);
  EXPECT_EQ(run(folder, "check a.ply open.ply a.off").exit_code, 1);
  const Outcome outcome = run(folder, "check bad.ply open.ply a.ply --json");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("bad.ply"));
  const json list = json::parse(outcome.out);
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0]["mesh"], "bad.ply");
  EXPECT_THAT(list[0]["error"].get<std::string>(), HasSubstr("bad.ply"));
  EXPECT_EQ(list[1]["valid"], false);
  EXPECT_EQ(list[2], json::parse(run(folder, "check a.ply --json").out));
  EXPECT_EQ(json::parse(run(folder, "info a.ply in.ndjson --json").out)[1],
            json::parse(run(folder, "info in.ndjson --json").out));
  EXPECT_EQ(run(folder, "info a.ply missing.ply").exit_code, 3);
}

TEST(Manners, VolumesAndAreasHaveUnits) {
  const Folder folder;
  static_cast<void>(folder.write(
      "in.ndjson", slice(0, "[[0,0],[2,0],[2,2],[0,2]]") + slice(3, "[[0,0],[2,0],[2,2],[0,2]]")));
  EXPECT_THAT(run(folder, "reconstruct in.ndjson -o a.ply").err,
              HasSubstr("area 32 mm^2, volume 12 mm^3"));
  EXPECT_THAT(run(folder, "reconstruct in.ndjson -o a.ply --unit cm").err,
              HasSubstr("area 32 cm^2, volume 12 cm^3"));
  EXPECT_THAT(run(folder, "reconstruct in.ndjson -o a.ply --unit 1e-4").err,
              HasSubstr("area 32 unit^2, volume 12 unit^3"));
  EXPECT_THAT(run(folder, "check a.ply").out, HasSubstr("volume 12 unit^3"));
}

TEST(Manners, ReportsListSlabsOnlyWhereThatIsAsked) {
  const Folder folder;
  std::string labels;
  std::string rings;
  for (int i = 0; i < 490; ++i) {
    labels += (i == 0 ? "\"label " : ", \"label ") + std::to_string(i) + '"';
    rings += (i == 0 ? "" : ", ") + ring(1, 6, 3 * (i % 25), 3 * (i / 25));
  }
  std::string stack;
  for (int z = 0; z < 8; ++z)
    stack += "{\"z\": " + std::to_string(z) + ", \"contours\": [" + rings + "], \"labels\": [" +
             labels + "]}\n";
  static_cast<void>(folder.write("in.ndjson", stack));
  const std::string brief = run(folder, "reconstruct in.ndjson -o a.ply --json -q").out;
  EXPECT_LT(brief.size(), 2'000'000U);
  const json parts = json::parse(brief)["parts"];
  EXPECT_EQ(parts.size(), 490U);
  EXPECT_FALSE(parts[0].contains("slabs"));
  const std::string full = run(folder, "reconstruct in.ndjson -o a.ply --json --list-slabs -q").out;
  EXPECT_EQ(json::parse(full)["parts"][489]["slabs"].size(), 7U);
}

/// The colours of a glTF file's labels.
std::map<std::string, json> colours(const Folder& folder, const std::string& file) {
  std::map<std::string, json> colours;
  const json model = json::parse(content(folder / file));
  for (const json& material : model["materials"])
    colours[material["name"]] = material["pbrMetallicRoughness"]["baseColorFactor"];
  return colours;
}

TEST(Manners, ALabelHasTheSameColourInEveryCommand) {
  const Folder folder;
  const auto line = [](double z, const std::string& contours, const std::string& labels) {
    std::string text = slice(z, contours);
    return text.insert(text.size() - 2, ", \"labels\": [" + labels + "]");
  };
  const std::string lung = ring(2, 8, 9);
  static_cast<void>(
      folder.write("both.ndjson", line(0, ring(2) + ", " + lung, R"("heart", "lung")") +
                                      line(1, ring(2) + ", " + lung, R"("heart", "lung")")));
  static_cast<void>(
      folder.write("lung.ndjson", line(0, lung, R"("lung")") + line(1, lung, R"("lung")")));
  ASSERT_EQ(run(folder, "reconstruct both.ndjson -o both.gltf -q").exit_code, 0);
  ASSERT_EQ(run(folder, "reconstruct lung.ndjson -o lung.gltf -q").exit_code, 0);
  ASSERT_EQ(run(folder, "stream both.ndjson -o stream.gltf -q").exit_code, 0);
  auto both = colours(folder, "both.gltf");
  EXPECT_EQ(both.size(), 2U);
  EXPECT_NE(both["heart"], both["lung"]);
  EXPECT_EQ(colours(folder, "lung.gltf")["lung"], both["lung"]);
  EXPECT_EQ(colours(folder, "stream.gltf"), both);
}

TEST(Manners, AStreamCountsInATerminalOnly) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel()));
  EXPECT_THAT(run(folder, "stream in.ndjson").err, Not(HasSubstr("\r")));
  const std::string command = "cd '" + (folder / "").string() + "' && TERM=xterm script -qec \"'" +
                              std::getenv("LOFT") +
                              "' stream in.ndjson\" typescript </dev/null >shown.txt 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << content(folder / "shown.txt");
  const std::string shown = content(folder / "shown.txt");
  EXPECT_THAT(shown, AllOf(HasSubstr("\r\x1b[K"), HasSubstr(" edits, 0 rejected; ")));
  EXPECT_THAT(shown, HasSubstr("5 edits, 0 rejected; 5 slices, "));
}

}  // namespace
}  // namespace loft::app
