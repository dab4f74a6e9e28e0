// SPDX-License-Identifier: MIT
// `loft stream` over HTTP: edits in, surfaces and events out, many clients at once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <fstream>
#include <iostream>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "tests/app/streaming.h"
#include "tests/cases.h"

namespace loft::app {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Posting : public ::testing::Test {
 protected:
  Folder folder_;
  Running running_{folder_, {"stream", "--no-input", "--port", "0", "--max-body", "1"}};
  std::unique_ptr<httplib::Client> client_ = running_.client();

  httplib::Result post(const std::string& body) {
    return client_->Post("/slices", body, "application/x-ndjson");
  }
};

TEST_F(Posting, ALineOnTheWholeStackIsNoEdit) {
  const auto answer = post(R"({"stack": {"unit": "um"}})"
                           "\n" +
                           stack(2));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200) << answer->body;
  EXPECT_EQ(json::parse(answer->body)["results"].size(), 2U);
}

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
  EXPECT_THAT(results[1]["error"],
              HasSubstr("there is no slice at z = 77; the nearest is at z = 3"));
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
  const std::string port = ':' + std::to_string(running_.port());
  for (const std::string host : {"127.0.0.1", "127.1.2.3", "[::1]", "LOCALHOST", "localhost."}) {
    expect(client_->Get("/status", {{"Host", host + port}}), 200, "");
    expect(client_->Get("/status", {{"Host", host}}), 403, "not this machine");
    expect(client_->Get("/status", {{"Host", host + port + "0"}}), 403, "not this machine");
    expect(client_->Get("/status", {{"Host", host + port + ".example.com"}}), 403, "");
  }
  for (const char* origin : {"null", "http://localhost:1", "https://127.0.0.1"})
    expect(client_->Post("/slices", {{"Origin", origin}}, leaning(1), "text/plain"), 403, "sites");
  expect(client_->Post("/slices", {{"Sec-Fetch-Site", "cross-site"}}, leaning(1), "text/plain"),
         403, "sites");
  expect(client_->Post("/slices", {{"Origin", "http://example.com"}}, leaning(1), "text/plain"),
         403, "other sites");
  EXPECT_EQ(json::parse(client_->Get("/status")->body)["slices"], 0);
  // Contours are numbered as they came, whatever is there already.
  ASSERT_EQ(post(leaning(1))->status, 200);
  expect(post(R"({"z": 1, "contours": [[[0, 0], [1e-60, 1], [1, 1]]]})"), 422, "contour 0 point 1");
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
  ASSERT_EQ(repairs.size(), 21U);
  EXPECT_EQ(repairs.back(), "and 980 more");
  std::string points = "[1,null]";
  for (int i = 0; i < 999; ++i) points += ",[1,null]";
  const auto refused = post("{\"z\":1,\"contours\":[[" + points + "]]}");
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->status, 400);
  EXPECT_THAT(refused->body, HasSubstr("and 980 more"));
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
  constexpr int rounds = cases(30);
  for (int round = 0; round < rounds; ++round) {
    std::thread sender([&] {
      const auto poster = running.client();
      ASSERT_TRUE(poster->Post("/slices", stack(50, 100), "application/x-ndjson"));
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(30 * round / rounds));
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
