// SPDX-License-Identifier: MIT
// `loft live`: what a browser gets, and what comes of what it sends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/running.h"

namespace loft::app {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::Not;

class Live : public ::testing::Test {
 protected:
  Folder folder_;
  Running running_{folder_, {"live", "--port", "0"}};
  std::unique_ptr<httplib::Client> client_ = running_.client();

  httplib::Result post(const std::string& tab, const std::string& body) {
    return client_->Post("/tabs/" + tab, body, "application/json");
  }
  int status(const std::string& tab, const std::string& body) { return post(tab, body)->status; }

  /// The first events of a stream, as text.
  std::string events(const std::string& query, int count, const httplib::Headers& headers = {}) {
    std::string text;
    const auto client = running_.client();
    client->Get("/events?" + query, headers, [&](const char* bytes, std::size_t size) {
      text.append(bytes, size);
      int found = 0;
      for (std::size_t at = 0; (at = text.find("\n\n", at)) != std::string::npos; at += 2) ++found;
      return found < count;
    });
    return text;
  }
};

std::string field(const std::string& event, const std::string& name) {
  const std::size_t begin = event.find(name + ": ") + name.size() + 2;
  return event.substr(begin, event.find('\n', begin) - begin);
}

TEST_F(Live, HasATabForEachApplication) {
  const nlohmann::json tabs = nlohmann::json::parse(client_->Get("/tabs")->body);
  EXPECT_EQ(tabs["first"], "shapes");
  EXPECT_GE(tabs["tabs"].size(), 3U);
  EXPECT_THAT(client_->Get("/")->body, HasSubstr("<title>"));
  EXPECT_EQ(running_.interrupt(), 0);
}

TEST_F(Live, TellsAnEditToWhoHasMissedIt) {
  const std::string first = events("tab=shapes", 1);
  EXPECT_THAT(first, HasSubstr("event: reset"));
  const std::string id = field(first, "id");
  for (const char* at : {"[1, 0]", "[2, 0]"})
    ASSERT_EQ(status("shapes", std::string(R"({"do": "move", "id": 2, "at": )") + at + "}"), 200);
  const std::string missed = events("tab=shapes", 2, {{"Last-Event-ID", id}});
  EXPECT_THAT(missed, Not(HasSubstr("event: reset")));
  EXPECT_THAT(missed, HasSubstr("[1.0,0.0]"));
  EXPECT_THAT(missed, HasSubstr("[2.0,0.0]"));
  EXPECT_THAT(events("tab=shapes&after=of-another-run.7", 1), HasSubstr("event: reset"));
}

TEST_F(Live, ForgetsNothingForWhoHasMissedTooMuch) {
  const std::string id = field(events("tab=map", 1), "id");
  for (int i = 0; i < 1100; ++i)
    ASSERT_EQ(
        status("map", R"({"do": "move", "id": 26, "at": [)" + std::to_string(i % 7) + ", 0]}"),
        200);
  const std::string all = events("tab=map&after=" + id, 1);
  EXPECT_THAT(all, HasSubstr("event: reset"));
  EXPECT_THAT(all, HasSubstr("\"at\":[0.0,0.0]"));
}

TEST_F(Live, SaysWhatIsWrong) {
  EXPECT_EQ(status("shapes", "{"), 400);
  EXPECT_EQ(status("shapes", R"({"do": "remove", "id": 4000000000})"), 422);
  EXPECT_EQ(status("weather", R"({"do": "remove", "id": 1})"), 404);
  EXPECT_EQ(status("shapes", std::string(2 << 20, ' ')), 413);
  EXPECT_EQ(client_->Get("/tabs/shapes")->status, 405);
  EXPECT_EQ(client_->Get("/tabs/shapes/weather")->status, 404);
  EXPECT_EQ(client_->Get("/tabs/map/owners?at=x")->status, 400);
  EXPECT_EQ(client_->Get("/events?tab=weather")->status, 404);
  EXPECT_EQ(client_->Put("/tabs/shapes", "{}", "application/json")->status, 405);
  EXPECT_EQ(nlohmann::json::parse(post("shapes", "[]")->body)["error"], "an edit is an object");
}

TEST_F(Live, IsForItsOwnPageAlone) {
  const std::string edit = R"({"do": "move", "id": 2, "at": [1, 0]})";
  const auto with = [&](const httplib::Headers& headers) {
    return client_->Post("/tabs/shapes", headers, edit, "application/json")->status;
  };
  EXPECT_EQ(with({{"Origin", "http://elsewhere.example"}}), 403);
  EXPECT_EQ(with({{"Sec-Fetch-Site", "cross-site"}}), 403);
  EXPECT_EQ(with({{"Host", "elsewhere.example"}}), 403);
  EXPECT_EQ(with({}), 200);
}

TEST_F(Live, AnswersQuestionsAndGivesEdges) {
  const nlohmann::json owners =
      nlohmann::json::parse(client_->Get("/tabs/map/owners?at=60,50")->body);
  EXPECT_EQ(owners["inside"].size(), 1U);
  const nlohmann::json clearance =
      nlohmann::json::parse(client_->Get("/tabs/paths/clearance?at=1,50")->body);
  EXPECT_EQ(clearance["clearance"], 1.0);
  EXPECT_GT(client_->Get("/tabs/map/edges")->body.size(), 16U * 4000);
}

TEST(LiveCommand, OpensASceneInItsTab) {
  const Folder folder;
  std::ofstream(folder / "map.geojson")
      << R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"name": "Atlantis"},
             "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 4], [0, 0]]]}}]})";
  const auto shown = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"live", "map.geojson", "--port", "0"});
    const Running running(folder, words);
    const auto client = running.client();
    const nlohmann::json tabs = nlohmann::json::parse(client->Get("/tabs")->body);
    const std::string owners = client->Get("/tabs/map/owners?at=3,1")->body;
    return std::pair(tabs["first"].get<std::string>(), owners);
  };
  EXPECT_EQ(shown({}).first, "map");
  EXPECT_THAT(shown({}).second, HasSubstr("Atlantis"));
  EXPECT_EQ(shown({"--tab", "shapes"}).first, "shapes");
}

TEST(LiveCommand, SaysWhatItCannotOpen) {
  const Folder folder;
  std::ofstream(folder / "bad.geojson") << "{";
  EXPECT_EQ(run(folder, "live bad.geojson --port 0").exit_code, 3);
  EXPECT_EQ(run(folder, "live nothing.geojson --port 0").exit_code, 3);
  EXPECT_EQ(run(folder, "live --tab weather --port 0").exit_code, 2);
}

}  // namespace
}  // namespace loft::app
