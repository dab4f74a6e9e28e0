// SPDX-License-Identifier: MIT
// What clients send that mean harm: each answer is right, and the capture goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/app/server/raw.h"
#include "tests/app/streaming.h"

namespace loft::app {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::Not;
using Clock = std::chrono::steady_clock;

class Attacks : public ::testing::Test {
 protected:
  Folder folder_;
  Running running_{folder_, {"stream", "--no-input", "--port", "0", "--max-effort", "0.2"}};
  int port_ = running_.port();
  std::unique_ptr<httplib::Client> client_ = running_.client();
  std::string host_ = "Host: 127.0.0.1:" + std::to_string(port_) + "\r\n";

  [[nodiscard]] json status() { return json::parse(client_->Get("/status")->body); }
  [[nodiscard]] std::string inner() const {
    const std::string edit = R"({"z":666,"contours":[[[0,0],[4,0],[4,4],[0,4]]]})";
    return "POST /slices HTTP/1.1\r\n" + host_ + "Content-Length: " + std::to_string(edit.size()) +
           "\r\n\r\n" + edit;
  }
  /// The answer to bytes whose connection must be closed behind it.
  [[nodiscard]] std::string last_words(const std::string& bytes) const {
    const Raw raw(port_);
    raw.send(bytes);
    bool is_ended = false;
    std::string words = raw.read_all(&is_ended);
    EXPECT_TRUE(is_ended) << words;
    EXPECT_EQ(words.find("HTTP/1.1", 1), std::string::npos) << words;
    return words;
  }
};

TEST_F(Attacks, WhatFollowsARefusedRequestIsNotReadAsOne) {
  const std::string body = inner() + inner();
  const std::string length = "Content-Length: " + std::to_string(body.size()) + "\r\n";
  const std::string chunked = "Transfer-Encoding: chunked\r\n";
  const auto start = [&](const std::string& target) {
    return "POST " + target + " HTTP/1.1\r\n" + host_;
  };
  const std::vector<std::pair<std::string, int>> refused{
      {start('/' + std::string(9000, 'a')) + length, 414},
      {start("/slices") + length + chunked, 400},
      {start("/slices") + length + length, 400},
      {start("/slices") + "Content-Length: +3\r\n", 400},
      {start("/slices") + "Content-Length: 99999999999999999999999\r\n", 413},
      {start("/slices") + "Transfer-Encoding: gzip, chunked\r\n", 501},
      {start("/slices") + " folded: x\r\n" + length, 400},
      {start("/slices") + "Content-Length : 3\r\n", 400},
      {start("/slices") + "Content-Type: multipart/form-data; boundary=x\r\n" + length, 415},
      {start("/slices") + "Content-Encoding: gzip\r\n" + length, 415},
      {"GET /status HTTP/1.1\r\n" + host_ + length, 200},
      {"POST /slices HTTP/9\r\n" + host_ + length, 400},
      {"nonsense\r\n" + length, 400}};
  for (const auto& [head, expected] : refused)
    EXPECT_THAT(last_words(head + "\r\n" + body), HasSubstr("HTTP/1.1 " + std::to_string(expected)))
        << head;
  EXPECT_EQ(client_->Get("/slices?z=666")->status, 404);
  EXPECT_EQ(status()["slices"], 0);
}

TEST_F(Attacks, RequestsBehindAWholeOneAreAnswered) {
  const Raw raw(port_);
  raw.send(inner() + "GET /slices HTTP/1.1\r\n" + host_ + "Connection: close\r\n\r\n");
  const std::string words = raw.read_all();
  EXPECT_THAT(words, HasSubstr("\"op\": \"insert\""));
  EXPECT_THAT(words, HasSubstr("666"));
}

TEST_F(Attacks, HeadsAndChunkLinesHaveAnEnd) {
  const std::string get = "GET /status HTTP/1.1\r\n" + host_;
  EXPECT_THAT(last_words(get + "X: " + std::string(70'000, 'a')), HasSubstr(" 431 "));
  std::string many = get;
  for (int i = 0; i < 200; ++i) many += "a: b\r\n";
  EXPECT_THAT(last_words(many), HasSubstr(" 431 "));
  EXPECT_THAT(last_words("POST /slices HTTP/1.1\r\n" + host_ +
                         "Transfer-Encoding: chunked\r\n\r\n" + std::string(10'000, '0')),
              HasSubstr(" 400 "));
  EXPECT_LT(status()["memory_bytes"], 100e6 * memory_factor);
}

TEST_F(Attacks, RangesAreNotServed) {
  ASSERT_EQ(client_->Post("/slices", stack(20), "text/plain")->status, 200);
  const auto whole = client_->Get("/surface.ply");
  std::string ranges = "bytes=0-";
  for (int i = 0; i < 1500; ++i) ranges += ",0-";
  const auto answer = client_->Get("/surface.ply", {{"Range", ranges}});
  ASSERT_TRUE(answer && whole);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(answer->body, whole->body);
}

TEST_F(Attacks, ManyIdleAndSlowConnectionsLeaveRoomForOthers) {
  std::vector<std::unique_ptr<Raw>> idle;
  for (int i = 0; i < 700; ++i) {
    idle.push_back(std::make_unique<Raw>(port_));
    if (i % 2 == 0) idle.back()->send("GET / HTTP/1.1\r\nX: ");
  }
  const auto begin = Clock::now();
  const auto answer = running_.client()->Post("/slices", leaning(1), "text/plain");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(5));
}

TEST_F(Attacks, AnEditThatTakesTooMuchIsRejectedAndChangesNothing) {
  const auto comb = [](double z, bool is_turned) {
    std::string points;
    for (int i = 0; i < 150; ++i) {
      const double along = i / 2 + (i % 4 > 1 ? 0.5 : 0.0);
      const double across = i % 4 == 1 || i % 4 == 2 ? 100 : 0.25;
      const double x = is_turned ? across : along;
      const double y = is_turned ? along : across;
      points += '[' + std::to_string(x) + ',' + std::to_string(y) + "],";
    }
    return slice(z, '[' + points + (is_turned ? "[-3,75],[-3,-3]]" : "[75,-3],[-3,-3]]"));
  };
  ASSERT_EQ(client_->Post("/slices", stack(3), "text/plain")->status, 200);
  const std::string before = client_->Get("/surface.ply")->body;
  ASSERT_EQ(client_->Post("/slices", comb(50, false), "text/plain")->status, 200);
  const std::string between = client_->Get("/surface.ply")->body;
  const auto answer = client_->Post("/slices", comb(51, true), "text/plain");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 422) << answer->body;
  EXPECT_THAT(answer->body, HasSubstr("--max-effort"));
  EXPECT_EQ(client_->Get("/surface.ply")->body, between);
  ASSERT_EQ(client_->Post("/slices", R"({"op":"remove","z":50})", "text/plain")->status, 200);
  ASSERT_EQ(client_->Post("/slices", leaning(3), "text/plain")->status, 200);
  std::ofstream(folder_ / "live.ply", std::ios::binary) << client_->Get("/surface.ply")->body;
  expect_surface_of(folder_, stack(4), "live.ply");
}

TEST(Interrupts, EndWhateverIsDoneWithinTwoSeconds) {
  const Folder folder;
  // Two combs across each other: bent, that takes long.
  std::string lines;
  for (int k = 0; k < 4; ++k) {
    std::string points;
    for (int i = 0; i < 400; ++i) {
      const std::string along = std::to_string(i / 2 + 0.4 * (i % 4 / 2));
      const std::string across = i % 4 == 1 || i % 4 == 2 ? "200" : "0.25";
      points += k % 2 == 0 ? '[' + along + ',' + across + "]," : '[' + across + ',' + along + "],";
    }
    lines += slice(k, '[' + points + (k % 2 == 0 ? "[200,-3],[-3,-3]]" : "[-3,200],[-3,-3]]"));
  }
  std::ofstream(folder / "combs.ndjson") << lines;
  const std::vector<std::vector<std::string>> commands{
      {"reconstruct", "combs.ndjson", "--smooth", "-o", "out.ply"},
      {"stream", "combs.ndjson", "--smooth", "-o", "out.ply"}};
  for (const auto& command : commands) {
    Running running(folder, command);
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    const auto begin = Clock::now();
    running.send(SIGTERM);
    running.wait();
    EXPECT_LT(Clock::now() - begin, std::chrono::seconds(2)) << command[0];
    for (const auto& entry : std::filesystem::directory_iterator(folder / ""))
      EXPECT_THAT(entry.path().string(), Not(HasSubstr(".part")));
  }
}

TEST(Tokens, AreNeededForChangesFromBeyondThisMachine) {
  const Folder folder;
  Running running(folder, {"stream", "--no-input", "--port", "0", "--host", "0.0.0.0"});
  ASSERT_TRUE(running.says("/#token="));
  const std::string words = content(folder / "err.txt");
  const int port = std::atoi(words.c_str() + words.find("0.0.0.0:") + 8);
  const std::string token = words.substr(words.find("#token=") + 7, 32);
  httplib::Client client("127.0.0.1", port);
  EXPECT_EQ(client.Post("/slices", leaning(1), "text/plain")->status, 401);
  const auto with = [&](const std::string& given) {
    const httplib::Headers headers{{"Authorization", "Bearer " + given}};
    return client.Post("/slices", headers, leaning(1), "text/plain")->status;
  };
  EXPECT_EQ(with(token.substr(1)), 401);
  EXPECT_EQ(client.Post("/undo", "", "text/plain")->status, 401);
  EXPECT_EQ(client.Post("/redo", "", "text/plain")->status, 401);
  EXPECT_EQ(with(token), 200);
  EXPECT_EQ(client.Get("/status")->status, 200);
  EXPECT_EQ(client.Get("/status", {{"Host", "example.com"}})->status, 403);
}

/// Of what a page of another site could make a browser send.
TEST(OtherSites, CannotChangeAnything) {
  const Folder folder;
  Running running(folder, {"stream", "--no-input", "--port", "0"});
  const auto client = running.client();
  ASSERT_EQ(client->Post("/slices", leaning(1), "text/plain")->status, 200);
  const std::vector<httplib::Headers> foreign{{{"Origin", "http://example.com"}},
                                              {{"Origin", "null"}},
                                              {{"Sec-Fetch-Site", "cross-site"}},
                                              {{"Sec-Fetch-Site", "same-site"}},
                                              {{"Host", "example.com"}}};
  for (const httplib::Headers& headers : foreign)
    for (const char* path : {"/slices", "/undo", "/redo"})
      EXPECT_EQ(client->Post(path, headers, leaning(2), "text/plain")->status, 403) << path;
  EXPECT_EQ(json::parse(client->Get("/status")->body)["edits"], 1);
}

void expect_safe(const httplib::Headers& headers, const std::string& what) {
  const auto value = [&](const char* name) {
    EXPECT_EQ(headers.count(name), 1U) << what << ": " << name;
    return headers.count(name) == 0 ? "" : headers.find(name)->second;
  };
  EXPECT_EQ(value("X-Content-Type-Options"), "nosniff") << what;
  EXPECT_EQ(value("Referrer-Policy"), "no-referrer") << what;
  const std::string policy = value("Content-Security-Policy");
  for (const char* words : {"default-src 'none'", "script-src 'self'", "frame-ancestors 'none'",
                            "base-uri 'none'", "form-action 'none'"})
    EXPECT_THAT(policy, HasSubstr(words)) << what;
  EXPECT_THAT(policy, Not(HasSubstr("http"))) << what;
  EXPECT_THAT(policy, Not(HasSubstr("unsafe"))) << what;
  EXPECT_THAT(policy, Not(HasSubstr("*"))) << what;
}

TEST(OtherSites, GetNoAnswerThatTheyCouldUse) {
  const Folder folder;
  for (const char* command : {"stream", "live"}) {
    std::vector<std::string> words{command, "--port", "0"};
    if (words[0] == "stream") words.emplace_back("--no-input");
    Running running(folder, words);
    const auto client = running.client();
    for (const char* path : {"/", "/viewer.js", "/live.js", "/icon.svg", "/status", "/labels",
                             "/history", "/slabs/0-1.glb", "/slabs?ids=x", "/tabs", "/nothing"})
      expect_safe(client->Get(path)->headers, path);
    expect_safe(client->Post("/slices", "x", "text/plain")->headers, "POST");
    expect_safe(client->Put("/slices", "x", "text/plain")->headers, "PUT");
    expect_safe(client->Get("/", {{"Host", "example.com"}})->headers, "another host");
    expect_safe(client->Get("/" + std::string(9000, 'a'))->headers, "a long address");
    expect_safe(client->Get("/", {{"A", std::string(70'000, 'a')}})->headers, "a long head");
  }
}

}  // namespace
}  // namespace loft::app
