// SPDX-License-Identifier: MIT
// `loft stream` as its users have it: pipes, files that grow, HTTP, kills.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "io/meshes.h"
#include "tests/app/running.h"

namespace loft::app {
namespace {

using namespace testing;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

int count_from(const char* variable, int usual) {
  const char* const wanted = std::getenv(variable);
  return wanted == nullptr ? usual : std::atoi(wanted);
}

/// The triangles of a mesh file by their places, in an order of their own.
std::vector<std::array<Vec3, 3>> triangles(const std::filesystem::path& path) {
  std::vector<std::array<Vec3, 3>> all;
  for (const io::LabelledMesh& part : io::read_meshes(path)) {
    for (const auto& [a, b, c] : part.mesh.faces) {
      auto& corners = all.emplace_back(
          std::array{part.mesh.points[a], part.mesh.points[b], part.mesh.points[c]});
      std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    }
  }
  std::ranges::sort(all);
  return all;
}

/// A slice of a cone that leans, with n points.
std::string leaning(int i, int n = 16) { return slice(i, ring(5 + 0.1 * i, n, 0.2 * i)); }

std::string stack(int count, int n = 16) {
  std::string lines;
  for (int i = 0; i < count; ++i) lines += leaning(i, n);
  return lines;
}

/// The surface that a file holds is that of a stack built at once.
void expect_surface_of(const Folder& folder, const std::string& stack, const std::string& file) {
  std::ofstream(folder / "at_once.ndjson") << stack;
  ASSERT_EQ(run(folder, "reconstruct at_once.ndjson -o at_once.ply").exit_code, 0);
  EXPECT_EQ(triangles(folder / file), triangles(folder / "at_once.ply"));
}

TEST(Stream, EditsFromAPipeMakeTheSurfaceOfWhatIsLeft) {
  const Folder folder;
  std::ofstream(folder / "stdin") << leaning(3) << leaning(0) << "{\"op\": \"remove\", \"z\": 0}\n"
                                  << leaning(1) << "\n"
                                  << leaning(9) << leaning(2)
                                  << R"({"op": "replace", "z": 9, "contours": [)" << ring(3)
                                  << "]}";
  const Outcome outcome = run(folder, "stream -o out.ply --json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["edits"], 7);
  expect_surface_of(folder, leaning(1) + leaning(2) + leaning(3) + slice(9, ring(3)), "out.ply");
}

TEST(Stream, BadLinesAreNamedAndLeftOut) {
  const Folder folder;
  std::ofstream(folder / "stdin") << leaning(0) << "{\"z\": 1, \"contours\": [[[0, NaN]]]}\n"
                                  << "{\"op\": \"replace\", \"z\": 7, \"contours\": []}\nnonsense\n"
                                  << leaning(1);
  const Outcome outcome = run(folder, "stream -o out.ply");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("standard input:2: contour 0 point 0: NaN"),
                                 HasSubstr("standard input:3: there is no slice at"),
                                 HasSubstr("standard input:4: "), HasSubstr("3 rejected")));
  expect_surface_of(folder, stack(2), "out.ply");
  EXPECT_EQ(run(folder, "stream --strict").exit_code, 3);
}

TEST(Stream, EachLineOfAComplaintSaysWhere) {
  const Folder folder;
  std::ofstream(folder / "stdin") << leaning(0)
                                  << R"({"z": 1, "contours": [[[0, 0], [1e200, 0], [0, 1e200]]]})"
                                  << '\n';
  const std::string words = run(folder, "stream").err;
  EXPECT_THAT(words, HasSubstr("standard input:2: slice 1 (z = 1) contour 0 point 1"));
  EXPECT_THAT(words, HasSubstr("standard input:2: slice 1 (z = 1) contour 0 point 2"));
}

TEST(Stream, AnEndlessLineIsLeftOut) {
  const Folder folder;
  std::ofstream(folder / "stdin") << leaning(0) << std::string(std::size_t{257} << 20U, ' ') << '\n'
                                  << leaning(1);
  const Outcome outcome = run(folder, "stream -o out.ply");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("standard input:2: the line is longer than 256 MiB"));
  expect_surface_of(folder, stack(2), "out.ply");
}

TEST(Stream, LabelsAreSurfacesOfTheirOwn) {
  const Folder folder;
  const auto line = [](int z, bool has_bone) {
    return R"({"z": )" + std::to_string(z) + R"(, "contours": [)" + ring(9) +
           (has_bone ? ", " + ring(2) : "") + R"(], "labels": ["skin")" +
           (has_bone ? R"(, "bone")" : "") + "]}\n";
  };
  std::string lines;
  for (int z = 0; z < 5; ++z) lines += line(z, z > 1);
  std::ofstream(folder / "stdin") << lines;
  EXPECT_EQ(run(folder, "stream -o out.ply").exit_code, 0);
  expect_surface_of(folder, lines, "out.ply");
}

TEST(Stream, FollowsAFileWhileItGrows) {
  const Folder folder;
  std::ofstream file(folder / "in.ndjson");
  file << leaning(0) << std::flush;
  Running running(folder, {"stream", "in.ndjson", "--follow", "-o", "out.ply", "--port", "0"});
  const auto client = running.client();
  const auto slices = [&] {
    const auto answer = client->Get("/status");
    return answer ? json::parse(answer->body)["slices"].get<int>() : -1;
  };
  const auto wait_for = [&](int count) {
    for (int i = 0; i < 1000 && slices() != count; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return slices();
  };
  EXPECT_EQ(wait_for(1), 1);
  const std::string next = leaning(1);
  file << next.substr(0, 20) << std::flush;  // the rest of the line is still to come
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(slices(), 1);
  file << next.substr(20) << leaning(2) << std::flush;
  EXPECT_EQ(wait_for(3), 3);
  EXPECT_EQ(running.interrupt(), 0);
  expect_surface_of(folder, stack(3), "out.ply");
}

/// Follows a file of edits; has written out.ply when it has taken in a stack of three.
class Following : public ::testing::Test {
 protected:
  Folder folder_;
  std::ofstream file_{folder_ / "in.ndjson"};
  std::optional<Running> running_;

  void start(const std::vector<std::string>& more = {}) {
    file_ << stack(3) << std::flush;
    std::vector<std::string> words{"stream",  "in.ndjson", "--follow", "-o",
                                   "out.ply", "--every",   "3"};
    words.insert(words.end(), more.begin(), more.end());
    running_.emplace(folder_, words);
    for (int i = 0; i < 3000 && !std::filesystem::exists(folder_ / "out.ply"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_TRUE(std::filesystem::exists(folder_ / "out.ply"));
    std::filesystem::remove(folder_ / "out.ply");
  }
};

TEST_F(Following, ALostTerminalIsARequestToEnd) {
  std::signal(SIGHUP, SIG_DFL);  // the tests themselves may be run by nohup
  std::signal(SIGPIPE, SIG_DFL);
  start();
  running_->send(SIGPIPE);
  running_->send(SIGHUP);
  EXPECT_EQ(running_->wait(), 0);
  expect_surface_of(folder_, stack(3), "out.ply");
}

TEST_F(Following, WhatCannotBeReadAnyMoreEndsTheInputOnly) {
  start();
  std::filesystem::remove(folder_ / "in.ndjson");
  std::filesystem::create_directory(folder_ / "in.ndjson");
  EXPECT_EQ(running_->wait(), 3);
  EXPECT_THAT(content(folder_ / "err.txt"), HasSubstr("cannot read in.ndjson: it is a folder"));
  expect_surface_of(folder_, stack(3), "out.ply");
}

TEST_F(Following, ALineWithoutItsEndIsNoEditYet) {
  start({"--session", "c.session"});
  file_ << leaning(3).substr(0, 10) << std::flush;
  ASSERT_EQ(running_->interrupt(), 0);
  EXPECT_THAT(content(folder_ / "err.txt"),
              HasSubstr("in.ndjson: the last 10 bytes were left out"));
  expect_surface_of(folder_, stack(3), "out.ply");
  file_ << leaning(3).substr(10) << std::flush;
  ASSERT_EQ(run(folder_, "stream in.ndjson --session c.session -o out.ply").exit_code, 0);
  expect_surface_of(folder_, stack(4), "out.ply");
}

TEST(Stream, WritesItsOutputsOnRequestAndEverySoOften) {
  const Folder folder;
  Running running(folder, {"stream", "--no-input", "--port", "0", "-o", "out.ply", "--every", "5"});
  const auto client = running.client();
  ASSERT_TRUE(client->Post("/slices", stack(3), "application/x-ndjson"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out.ply"));
  const auto wait_for_output = [&] {
    for (int i = 0; i < 1000 && !std::filesystem::exists(folder / "out.ply"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return std::filesystem::exists(folder / "out.ply");
  };
  running.send(SIGUSR1);
  ASSERT_TRUE(wait_for_output());
  expect_surface_of(folder, stack(3), "out.ply");
  std::filesystem::remove(folder / "out.ply");
  ASSERT_TRUE(client->Post("/slices", leaning(3) + leaning(4), "application/x-ndjson"));
  ASSERT_TRUE(wait_for_output());
  expect_surface_of(folder, stack(5), "out.ply");
}

/// Reads server-sent events until it is enough.
std::vector<std::string> read_events(httplib::Client& client, const httplib::Headers& headers,
                                     std::size_t count, const std::string& path = "/events") {
  std::vector<std::string> events;
  std::string text;
  client.Get(path, headers, [&](const char* bytes, std::size_t size) {
    text.append(bytes, size);
    for (std::size_t end = text.find("\n\n"); end != std::string::npos; end = text.find("\n\n")) {
      if (text[0] != ':') events.push_back(text.substr(0, end));
      text.erase(0, end + 2);
    }
    return events.size() < count;
  });
  return events;
}

/// The event that tells a viewer of all that there is.
json reset_event(httplib::Client& client) {
  const std::string text = read_events(client, {}, 1).at(0);
  return json::parse(text.substr(text.find("data: ") + 6));
}

class Posting : public ::testing::Test {
 protected:
  Folder folder_;
  Running running_{folder_, {"stream", "--no-input", "--port", "0", "--max-body", "1"}};
  std::unique_ptr<httplib::Client> client_ = running_.client();

  httplib::Result post(const std::string& body) {
    return client_->Post("/slices", body, "application/x-ndjson");
  }
};

TEST_F(Posting, AnswersEachLine) {
  auto answer = post(stack(3));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  json results = json::parse(answer->body)["results"];
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(results[2]["added"].size(), 2U);  // the new slab, and the one that has no cap any more
  EXPECT_EQ(results[2]["removed"].size(), 1U);

  answer = post(leaning(3) + "{\"op\": \"remove\", \"z\": 77}\n" + leaning(4));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 422);
  results = json::parse(answer->body)["results"];
  EXPECT_THAT(results[1]["error"], HasSubstr("there is no slice at"));
  EXPECT_FALSE(results[2].contains("error"));
  const json status = json::parse(client_->Get("/status")->body);
  EXPECT_EQ(status["slices"], 5);
  EXPECT_EQ(status["rejected"], 1);
}

TEST_F(Posting, SaysWhatIsWrongWithARequest) {
  const auto expect = [&](const httplib::Result& answer, int status, const std::string& words) {
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, status) << answer->body;
    EXPECT_THAT(answer->body, HasSubstr(words));
  };
  expect(post(""), 400, "no edits");
  expect(post("\n \n"), 400, "no edits");
  expect(post("nonsense"), 400, "line");
  expect(post("{\"z\": 1, \"contours\": [], \"labels\": [\"\xff\"]}"), 400, "");
  expect(post("{\"z\": 1e400, \"contours\": []}"), 400, "too large");
  expect(post(std::string(2 << 20, ' ')), 413, "too large");
  expect(client_->Get("/slices?z=abc"), 400, "no number");
  expect(client_->Get("/slices?z=3"), 404, "no slice");
  expect(client_->Get("/slabs/0-99.glb"), 404, "gone, or never was");
  expect(client_->Get("/slabs/9-9.glb"), 404, "gone, or never was");
  expect(client_->Get("/surface.glb"), 404, "no surface yet");
  expect(client_->Get("/surface.doc"), 404, "");
  expect(client_->Get("/../etc/passwd"), 404, "there is no");
  expect(client_->Get("/slices?z=nan"), 400, "no number");
  expect(client_->Delete("/slices"), 405, "not what can be done");
  expect(client_->Put("/surface.glb", "x", "text/plain"), 405, "PUT is not what can be done");
  expect(client_->Options("/slices"), 405, "OPTIONS is not what can be done");
  expect(client_->Post("/nothing", "x", "text/plain"), 404, "there is no /nothing");
  expect(post(std::string(70'000, '\n')), 413, "more than 65536 lines");
  expect(client_->Get("/status", {{"Host", "example.com"}}), 403, "not this machine");
  for (const char* host : {"127.example.com", "127.0.0.1.example.com:80", "[::2]", "localhost.x"})
    expect(client_->Post("/slices", {{"Host", host}}, leaning(1), "text/plain"), 403,
           "not this machine");
  for (const char* host : {"127.0.0.1", "127.1.2.3:80", "[::1]:80", "LOCALHOST", "localhost.:80"})
    expect(client_->Get("/status", {{"Host", host}}), 200, "");
  expect(client_->Post("/slices", {{"Origin", "http://example.com"}}, leaning(1), "text/plain"),
         403, "other sites");
  EXPECT_EQ(json::parse(client_->Get("/status")->body)["slices"], 0);
}

TEST_F(Posting, TakesWhatCurlCallsAForm) {
  const auto answer = client_->Post("/slices", stack(40), "application/x-www-form-urlencoded");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(json::parse(client_->Get("/status")->body)["slices"], 40);
  const httplib::MultipartFormDataItems items{{"slices", stack(2), "slices.ndjson", ""}};
  const auto form = client_->Post("/slices", items);
  ASSERT_TRUE(form);
  EXPECT_EQ(form->status, 415);
}

TEST_F(Posting, SaysThatThePortIsInUse) {
  const std::string port = std::to_string(running_.port());
  const Outcome second = run(folder_, "stream --no-input --port " + port);
  EXPECT_EQ(second.exit_code, 4);
  EXPECT_THAT(second.err, AllOf(HasSubstr("port " + port), HasSubstr("in use")));
}

TEST_F(Posting, SaysSoMuchOfALineAndCountsTheRest) {
  std::string contours = "[]";
  for (int i = 0; i < 999; ++i) contours += ",[]";
  const auto repaired = post("{\"z\":1,\"contours\":[" + contours + "]}");
  ASSERT_TRUE(repaired);
  const json repairs = json::parse(repaired->body)["results"][0]["repairs"];
  ASSERT_EQ(repairs.size(), 101U);
  EXPECT_EQ(repairs.back(), "and 900 more");
  std::string points = "[1,null]";
  for (int i = 0; i < 999; ++i) points += ",[1,null]";
  const auto refused = post("{\"z\":1,\"contours\":[[" + points + "]]}");
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->status, 400);
  EXPECT_THAT(refused->body, HasSubstr("and 900 more"));
}

TEST_F(Posting, TakesABodyWithAByteOrderMark) {
  const auto answer = post("\xEF\xBB\xBF" + leaning(1));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200) << answer->body;
}

TEST_F(Posting, SaysThatASliceCameTwice) {
  const auto answer = post(leaning(1) + leaning(1));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  const json results = json::parse(answer->body)["results"];
  EXPECT_TRUE(results[0]["repairs"].empty());
  EXPECT_THAT(results[1]["repairs"].dump(), HasSubstr("where there was a slice already"));
}

TEST_F(Posting, RefusesLargeBodiesThatComeInChunks) {
  for (const char* path : {"/slices", "/nothing"}) {
    std::size_t sent = 0;
    const auto send = [&](std::size_t, httplib::DataSink& sink) {
      const std::string blanks(1 << 16, ' ');
      sent += blanks.size();
      sink.write(blanks.data(), blanks.size());
      if (sent >= std::size_t{3} << 20U) sink.done();
      return true;
    };
    const auto answer = client_->Post(path, httplib::Headers{}, send, "application/x-ndjson");
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 413);
  }
  EXPECT_EQ(json::parse(client_->Get("/status")->body)["slices"], 0);
}

TEST_F(Posting, GivesTheSurfaceAndItsParts) {
  ASSERT_TRUE(post(stack(4)));
  for (const std::string name : {"surface.ply", "surface.glb", "surface.stl", "surface.obj"}) {
    const auto answer = client_->Get("/" + name);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 200);
    std::ofstream(folder_ / name, std::ios::binary) << answer->body;
    EXPECT_EQ(io::read_meshes(folder_ / name).size(), 1U);
  }
  expect_surface_of(folder_, stack(4), "surface.ply");
  EXPECT_EQ(client_->Get("/slabs/0-0.glb")->status, 404);  // it had a cap: it is another one now
  const auto line = client_->Get("/slices?z=2");
  ASSERT_TRUE(line);
  EXPECT_EQ(json::parse(line->body), json::parse(leaning(2)));
  EXPECT_EQ(json::parse(client_->Get("/slices")->body)["slices"], (std::vector{0, 1, 2, 3}));

  // All slabs together are the whole surface.
  const json event = reset_event(*client_);
  std::size_t faces = 0;
  for (const json& slab : event["slabs"]) {
    const auto glb = client_->Get("/slabs/" + slab["id"].get<std::string>() + ".glb");
    ASSERT_TRUE(glb);
    ASSERT_EQ(glb->status, 200);
    std::ofstream(folder_ / "slab.glb", std::ios::binary) << glb->body;
    faces += triangles(folder_ / "slab.glb").size();
  }
  EXPECT_EQ(faces, triangles(folder_ / "surface.ply").size());
  EXPECT_EQ(event["counts"]["faces"], faces);
}

TEST_F(Posting, AReaderThatComesBackGetsWhatItHasMissed) {
  ASSERT_TRUE(post(stack(2)));
  auto reader = running_.client();
  const auto first = read_events(*reader, {}, 1);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_THAT(first[0], HasSubstr("event: reset"));
  const std::string id = first[0].substr(4, first[0].find('\n') - 4);
  ASSERT_TRUE(post(leaning(2) + leaning(3)));
  auto again = running_.client();
  const auto missed = read_events(*again, {{"Last-Event-ID", id}}, 2);
  ASSERT_EQ(missed.size(), 2U);
  EXPECT_THAT(missed[0], AllOf(HasSubstr("event: change"), HasSubstr("\"slices_added\":[2.0]")));
  EXPECT_THAT(missed[1], AllOf(HasSubstr("event: change"), HasSubstr("\"slices_added\":[3.0]")));
  const auto after = read_events(*running_.client(), {}, 2, "/events?after=" + id);
  EXPECT_EQ(after, missed);
  auto stranger = running_.client();
  EXPECT_THAT(read_events(*stranger, {{"Last-Event-ID", "12345.1"}}, 1)[0],
              HasSubstr("event: reset"));
}

/// Edits that take all slices away.
std::string remove_all(httplib::Client& client) {
  std::string lines;
  const json heights = json::parse(client.Get("/slices")->body)["slices"];
  for (const json& z : heights) lines += "{\"op\":\"remove\",\"z\":" + z.dump() + "}\n";
  return lines;
}

/// A body that is nearly right, and now and then entirely.
std::string random_body(std::mt19937& random) {
  std::string body;
  for (auto lines = 1 + random() % 3; lines > 0; --lines) {
    std::string line = leaning(static_cast<int>(random() % 4), 5);
    if (random() % 4 == 0) line.insert(1, "\"op\":\"replace\",");
    body += line;
  }
  if (random() % 4 == 0) body = body.substr(random() % 40, random() % body.size());
  const bool keeps_form = random() % 2 == 0;
  for (auto k = random() % 6; k > 0 && !body.empty(); --k) {
    const std::size_t place = random() % body.size();
    const auto kind = keeps_form ? 2 : random() % 3;
    if (kind == 0) {
      body[place] = static_cast<char>(random());
    } else if (kind == 1) {
      body.insert(place, std::array{"[", "]", "\"", "-", "e9", "{", "null", "\n"}[random() % 8]);
    } else if (body[place] >= '1' && body[place] <= '9') {
      body[place] = static_cast<char>('1' + random() % 9);
    }
  }
  return body;
}

/// What a reader knows that starts while edits come in: what the first event says, then each
/// change.
TEST(Session, AReaderThatStartsBetweenEditsKnowsEachSlabOnce) {
  const Folder folder;
  // A session: keeping edits takes a while, in which they are applied but not told.
  Running running(folder, {"stream", "--no-input", "--port", "0", "--session", "c"});
  const auto client = running.client();
  for (int round = 0; round < 30; ++round) {
    std::thread sender([&] {
      const auto poster = running.client();
      ASSERT_TRUE(poster->Post("/slices", stack(50, 100), "application/x-ndjson"));
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(round));
    std::set<std::string> known;
    const int end = 100 * round + 50;
    int last = -1;
    std::string text;
    running.client()->Get("/events", [&](const char* bytes, std::size_t size) {
      text.append(bytes, size);
      for (auto stop = text.find("\n\n"); stop != std::string::npos; stop = text.find("\n\n")) {
        const auto begin = text.find("data: ") + 6;
        const json event = json::parse(text.substr(begin, stop - begin));
        text.erase(0, stop + 2);
        for (const json& id : event.value("removed", json::array()))
          EXPECT_EQ(known.erase(id.get<std::string>()), 1U) << id;
        for (const json& slab : event.contains("slabs") ? event["slabs"] : event["added"])
          EXPECT_TRUE(known.insert(slab["id"].get<std::string>()).second) << slab["id"];
        last = event["edits"];
      }
      return last < end;
    });
    sender.join();
    EXPECT_EQ(known.size(), 49U);
    ASSERT_TRUE(client->Post("/slices", remove_all(*client), "application/x-ndjson"));
  }
}

TEST_F(Posting, NoBodyMakesItFall) {
  const int count = count_from("LOFT_SOAK_BODIES", 300);
  const auto seed = std::random_device()();
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  int taken = 0;
  for (int i = 0; i < count; ++i) {
    // Else the contours at a height become more and more.
    const std::string body = i % 50 == 49 ? remove_all(*client_) : random_body(random);
    const auto answer = post(body);
    ASSERT_TRUE(answer) << body;
    ASSERT_TRUE(answer->status == 200 || (answer->status >= 400 && answer->status < 500))
        << answer->status << '\n'
        << body;
    if (answer->status == 200) ++taken;
  }
  EXPECT_GT(taken, count / 8);
  EXPECT_LT(taken, count / 8 * 7);
  EXPECT_EQ(client_->Get("/status")->status, 200);
}

TEST(Session, WhatWasAcknowledgedIsThereAfterAKill) {
  const int kills = count_from("LOFT_SOAK_KILLS", 5);
  const auto seed = std::random_device()();
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  const Folder folder;
  int acknowledged = 0;
  for (int i = 0; i < kills; ++i) {
    Running running(folder, {"stream", "--no-input", "--port", "0", "--session", "c.session"});
    const auto client = running.client();
    std::thread sender([&] {
      for (;;) {
        const auto answer = client->Post("/slices", leaning(acknowledged), "application/x-ndjson");
        if (!answer || answer->status != 200) break;
        ++acknowledged;
      }
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 300));
    running.kill();
    sender.join();
    ASSERT_EQ(run(folder, "session verify c.session").exit_code, 0);
    const auto exported = run(folder, "session export c.session -o -").out;
    ASSERT_GE(std::ranges::count(exported, '\n'), acknowledged);
    // One may be in the session that was not acknowledged any more.
    acknowledged = static_cast<int>(std::ranges::count(exported, '\n'));
  }
  ASSERT_GT(acknowledged, 1);
  std::ofstream(folder / "stdin");
  ASSERT_EQ(run(folder, "stream --session c.session -o out.ply").exit_code, 0);
  expect_surface_of(folder, stack(acknowledged), "out.ply");
}

TEST(Session, ResumesWithItsSettings) {
  const Folder folder;
  std::ofstream(folder / "stdin") << stack(3);
  ASSERT_EQ(run(folder, "stream --session c.session --cap dome --unit um").exit_code, 0);
  std::ofstream(folder / "stdin") << leaning(3);
  ASSERT_EQ(run(folder, "stream --session c.session -o out.ply").exit_code, 0);
  std::ofstream(folder / "all.ndjson") << stack(4);
  ASSERT_EQ(run(folder, "reconstruct all.ndjson --cap dome -o all.ply").exit_code, 0);
  EXPECT_EQ(triangles(folder / "out.ply"), triangles(folder / "all.ply"));
  for (const std::string cap : {"open", "flat"}) {
    const Outcome other = run(folder, "stream --session c.session --cap " + cap);
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_THAT(other.err, HasSubstr("was begun with cap dome, not " + cap));
  }
  EXPECT_EQ(run(folder, "stream --session c.session --max-shift 3").exit_code, 2);
  EXPECT_EQ(run(folder, "stream --session c.session --cap dome --unit um").exit_code, 0);
}

TEST(Stream, OptionsThatMakeNoSenseAreRefused) {
  const Folder folder;
  std::ofstream(folder / "in.ndjson") << stack(3);
  const std::vector<std::pair<std::string, std::string>> cases{
      {"in.ndjson --no-input --port 0", "exclude each other"},
      {"--no-input -o a.ply", "nothing to do"},
      {"--follow", "needs a file"},
      {"- --follow", "needs a file"},
      {"in.ndjson --host ::1", "needs --port or --view"},
      {"in.ndjson --every -1", "--every"},
      {"in.ndjson -o same.glb --replay same.glb", "two names"},
      {"in.ndjson -o ./same.ply --session same.ply", "will not be overwritten"},
  };
  for (const auto& [words, expected] : cases) {
    const Outcome outcome = run(folder, "stream " + words);
    EXPECT_EQ(outcome.exit_code, 2) << words;
    EXPECT_THAT(outcome.err, HasSubstr(expected)) << words;
  }
}

TEST(Stream, AnOutputThatCannotBeWrittenLeavesTheOthers) {
  const Folder folder;
  std::filesystem::create_directory(folder / "gone");
  Running running(folder, {"stream", "--no-input", "--port", "0", "-o", "gone/a.ply", "-o", "b.ply",
                           "--replay", "c.glb", "--json"});
  ASSERT_TRUE(running.client()->Post("/slices", stack(3), "application/x-ndjson"));
  std::filesystem::remove_all(folder / "gone");
  EXPECT_EQ(running.interrupt(), 4);
  EXPECT_THAT(content(folder / "err.txt"), HasSubstr("gone/a.ply"));
  EXPECT_THAT(content(folder / "out.txt"), HasSubstr("loft-stream"));
  EXPECT_TRUE(std::filesystem::exists(folder / "c.glb"));
  expect_surface_of(folder, stack(3), "b.ply");
}

TEST(Session, AFileIsTakenInOnce) {
  const Folder folder;
  std::ofstream file(folder / "in.ndjson");
  const std::string remove = "{\"op\": \"remove\", \"z\": 9}\n";
  file << stack(3) << remove << std::flush;
  const std::string words = "stream in.ndjson --session c.session";
  EXPECT_THAT(run(folder, words).err, HasSubstr("3 edits, 1 rejected"));
  // A slice comes in between that an edit of the file, rejected before, would remove.
  std::ofstream(folder / "stdin") << leaning(9);
  ASSERT_EQ(run(folder, "stream --session c.session").exit_code, 0);
  EXPECT_THAT(run(folder, words).err,
              AllOf(HasSubstr("resumed at line 5 of in.ndjson"), HasSubstr("4 edits, 0 rejected")));
  file << leaning(4) << std::flush;
  EXPECT_THAT(run(folder, words).err, HasSubstr("5 edits, 0 rejected; 5 slices"));
  EXPECT_THAT(run(folder, "session list c.session").out, Not(HasSubstr("in.ndjson")));

  std::ofstream(folder / "in.ndjson") << leaning(5);
  EXPECT_THAT(run(folder, words).err,
              AllOf(HasSubstr("is not the file any more"), HasSubstr("6 slices")));
}

TEST(Session, SlabsAreAsOldAsTheLastEditsOfTheirSlices) {
  const Folder folder;
  const std::vector<std::string> words{"stream", "--no-input", "--port", "0", "--session", "c"};
  {
    Running running(folder, words);
    const std::string edits = stack(4) + "{\"op\": \"remove\", \"z\": 1}\n" +
                              "{\"op\": \"replace\"," + leaning(0).substr(1) + leaning(1);
    ASSERT_EQ(running.client()->Post("/slices", edits, "application/x-ndjson")->status, 200);
  }
  Running running(folder, words);
  const json event = reset_event(*running.client());
  EXPECT_EQ(event["edits"], 7);
  std::vector<int> ages;
  for (const json& slab : event["slabs"]) ages.push_back(slab["edit"]);
  EXPECT_THAT(ages, ::testing::ElementsAre(7, 7, 4));
}

TEST(Stream, AReplayShowsASessionAsItWasCaptured) {
  const Folder folder;
  std::ofstream(folder / "stdin") << stack(5) << "{\"op\": \"remove\", \"z\": 2}\n";
  ASSERT_EQ(run(folder, "stream --session c.session --replay first.glb").exit_code, 0);
  std::ofstream(folder / "stdin") << "";
  ASSERT_EQ(run(folder, "stream --session c.session --replay again.glb").exit_code, 0);
  EXPECT_EQ(content(folder / "first.glb"), content(folder / "again.glb"));
  EXPECT_THAT(content(folder / "again.glb"), HasSubstr("\"STEP\""));
  for (const std::string rate : {"0", "1e-9", "1e9", "nan", "fast"}) {
    const Outcome outcome = run(folder, "stream --replay r.glb --replay-rate " + rate);
    EXPECT_EQ(outcome.exit_code, 2) << rate;
    EXPECT_THAT(outcome.err, HasSubstr("is no rate"));
  }
  EXPECT_EQ(run(folder, "stream --replay r.ply").exit_code, 2);
}

TEST(Stream, AReplayThatFailsDoesNotStopTheCapture) {
  const Folder folder;
  std::ofstream edits(folder / "stdin");
  for (const char* z : {"0", "1e38", "2e38"})
    edits << R"({"z": )" << z << R"(, "contours": [[[0,0],[1e39,0],[1e39,1e39],[0,1e39]]]})"
          << '\n';
  edits.close();
  const Outcome outcome =
      run(folder, "stream --unit m --session c.session -o out.ply --replay replay.glb");
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("too large for glTF"));
  EXPECT_THAT(run(folder, "session list c.session").out, HasSubstr("3 edits, 3 slices now"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out.ply"));
  EXPECT_FALSE(std::filesystem::exists(folder / "replay.glb"));
}

TEST(Session, CommandsLookInside) {
  const Folder folder;
  std::ofstream(folder / "stdin") << stack(3) << "{\"op\": \"remove\", \"z\": 1}\n";
  ASSERT_EQ(run(folder, "stream --session c.session").exit_code, 0);
  EXPECT_THAT(run(folder, "session list c.session").out,
              AllOf(HasSubstr("3 remove z = 1"), HasSubstr("4 edits, 2 slices now"),
                    HasSubstr("fill = evenodd")));
  EXPECT_EQ(json::parse(run(folder, "session list c.session --json").out)["edits"].size(), 4U);
  ASSERT_EQ(run(folder, "session export c.session -o out.ndjson").exit_code, 0);
  EXPECT_EQ(std::ranges::count(content(folder / "out.ndjson"), '\n'), 2);
  EXPECT_THAT(run(folder, "session export c.session --edits").out, HasSubstr("\"op\":\"remove\""));
  EXPECT_EQ(run(folder, "session verify c.session").exit_code, 0);
  EXPECT_EQ(run(folder, "session verify nothing").exit_code, 3);
  std::fstream file(folder / "c.session");
  file.seekp(8192 - 40);
  file << "damaged";
  file.close();
  const Outcome outcome = run(folder, "session verify c.session");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out;
  EXPECT_THAT(outcome.err, HasSubstr("damaged"));
}

TEST(Session, WhatCannotBeKeptIsNotTaken) {
  const Folder folder;
  {
    std::ofstream(folder / "stdin") << stack(2);
    ASSERT_EQ(run(folder, "stream --session c.session").exit_code, 0);
  }
  // No file of this process may grow beyond that.
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{100'000, before.rlim_max};
  std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &small);
  Running running(folder, {"stream", "--no-input", "--port", "0", "--session", "c.session"});
  const auto client = running.client();
  ::setrlimit(RLIMIT_FSIZE, &before);
  const auto answer = client->Post("/slices", leaning(2) + leaning(3, 5000), "text/plain");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 507) << answer->body;
  EXPECT_THAT(answer->body, HasSubstr("cannot write"));
  const json status = json::parse(client->Get("/status")->body);
  const int kept = status["slices"];
  EXPECT_THAT(kept, ::testing::AnyOf(2, 3));  // the first line may have been a batch of its own
  std::ofstream(folder / "live.ply", std::ios::binary) << client->Get("/surface.ply")->body;
  expect_surface_of(folder, stack(kept), "live.ply");
  running.kill();
  const auto exported = run(folder, "session export c.session").out;
  EXPECT_EQ(std::ranges::count(exported, '\n'), kept);
}

/// While the session may not grow, edits of a file wait.
class Waiting : public ::testing::Test {
 protected:
  Folder folder_;
  rlimit before_{};
  std::optional<Running> running_;

  void start(const std::vector<std::string>& more) {
    std::ofstream(folder_ / "stdin") << stack(2);
    ASSERT_EQ(run(folder_, "stream --session c.session").exit_code, 0);
    std::ofstream(folder_ / "in.ndjson") << leaning(2, 5000) << leaning(3) << leaning(4);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{100'000, before_.rlim_max};
    std::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &small);
    std::vector<std::string> words{"stream", "in.ndjson", "--session", "c.session"};
    words.insert(words.end(), more.begin(), more.end());
    running_.emplace(folder_, words);
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ASSERT_TRUE(running_->says("in.ndjson:1: cannot write c.session"));
  }
};

TEST_F(Waiting, EditsThatCannotBeKeptAreTakenInTheirOrderLater) {
  start({"--port", "0"});
  const auto client = running_->client();
  const auto has_slices = [&](int count) {
    for (int i = 0; i < 1000; ++i) {
      if (json::parse(client->Get("/status")->body)["slices"] == count) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  };
  EXPECT_EQ(client->Post("/slices", leaning(9, 5000), "text/plain")->status, 507);
  EXPECT_TRUE(has_slices(2));  // one is tried now and then, and taken out again
  ASSERT_EQ(::prlimit(running_->process(), RLIMIT_FSIZE, &before_, nullptr), 0);
  EXPECT_TRUE(has_slices(5));
  EXPECT_EQ(running_->interrupt(), 0);
  EXPECT_THAT(content(folder_ / "err.txt"), HasSubstr("5 edits, 1 rejected"));
  const std::string list = run(folder_, "session list c.session").out;
  EXPECT_THAT(list, HasSubstr("2 insert z = 2, 1 contours, 5000 points\n3 insert z = 3, "));
  EXPECT_THAT(list, HasSubstr("5 edits, 5 slices now"));
}

TEST_F(Waiting, EditsThatWereNotKeptAreSaidAtTheEnd) {
  start({});
  EXPECT_EQ(running_->interrupt(), 4);
  EXPECT_THAT(content(folder_ / "err.txt"), HasSubstr("3 edits were not kept"));
}

TEST(Clients, ManyPostWhileViewersWatchAndOneReadsNothing) {
  constexpr int clients = 8;
  const int each = count_from("LOFT_SOAK_SLICES", 200) / clients;
  const Folder folder;
  Running running(folder, {"stream", "--no-input", "--port", "0"});
  const int port = running.port();
  std::atomic<bool> is_over = false;
  std::vector<std::thread> viewers;
  std::atomic<int> events = 0;
  for (int i = 0; i < 4; ++i)
    viewers.emplace_back([&, i] {
      httplib::Client viewer("127.0.0.1", port);
      viewer.set_read_timeout(1);
      viewer.Get("/events", [&](const char* bytes, std::size_t size) {
        while (i == 0 && !is_over) std::this_thread::sleep_for(std::chrono::milliseconds(20));
        events += static_cast<int>(std::count(bytes, bytes + size, '\n'));
        return !is_over;
      });
    });
  std::vector<std::thread> senders;
  std::atomic<int> acknowledged = 0;
  for (int i = 0; i < clients; ++i)
    senders.emplace_back([&, i] {
      httplib::Client client("127.0.0.1", port);
      client.set_keep_alive(true);
      for (int k = 0; k < each; ++k) {
        const auto answer = client.Post("/slices", leaning(k * clients + i, 200), "text/plain");
        if (answer && answer->status == 200) ++acknowledged;
      }
    });
  for (std::thread& sender : senders) sender.join();
  const auto client = running.client();
  const json status = json::parse(client->Get("/status")->body);
  is_over = true;
  for (std::thread& viewer : viewers) viewer.join();
  EXPECT_EQ(acknowledged, clients * each);
  EXPECT_EQ(status["slices"], clients * each);
  EXPECT_GT(events, 3 * clients * each);
  std::cout << "latency " << status["latency_ms"].dump() << " ms, memory "
            << status["memory_bytes"].get<double>() / 1e6 << " MB\n";
  std::ofstream(folder / "live.ply", std::ios::binary) << client->Get("/surface.ply")->body;
  expect_surface_of(folder, stack(clients * each, 200), "live.ply");
}

}  // namespace
}  // namespace loft::app
