// SPDX-License-Identifier: MIT
// Hostile clients of five kinds during a capture that viewers watch: nothing is lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "tests/app/server/raw.h"
#include "tests/app/streaming.h"

namespace loft::app {
namespace {

using namespace testing;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// Does harm of one of five kinds until it is over.
void harm(int kind, int port, const std::atomic<bool>& is_over) {
  const std::string host = "Host: 127.0.0.1:" + std::to_string(port) + "\r\n";
  const std::string post = "POST /slices HTTP/1.1\r\n" + host;
  while (!is_over) {
    const Raw raw(port);
    raw.set_patience(milliseconds(300));
    const auto end = Clock::now() + milliseconds(2000);
    const auto goes_on = [&] { return !is_over && Clock::now() < end; };
    const auto pause = [] { std::this_thread::sleep_for(milliseconds(100)); };
    switch (kind) {
      case 0:  // a head without end, slowly
        raw.send("GET / HTTP/1.1\r\n" + host);
        while (goes_on() && raw.send("X: y\r\n")) pause();
        break;
      case 1:  // a body that stops
        raw.send(post + "Content-Length: 1000000\r\n\r\n" + std::string(100'000, ' '));
        while (goes_on() && raw.send(" ")) pause();
        break;
      case 2:  // asks for much and reads nothing
        for (int i = 0; i < 20; ++i) raw.send("GET /surface.ply HTTP/1.1\r\n" + host + "\r\n");
        while (goes_on()) pause();
        break;
      case 3:  // requests hidden in bodies that are refused
        raw.send("POST /" + std::string(9000, 'a') + " HTTP/1.1\r\n" + host +
                 "Content-Length: 200\r\n\r\n" + post + "Content-Length: 2\r\n\r\n{}");
        pause();
        break;
      default:  // nothing at all
        while (goes_on()) pause();
    }
  }
}

TEST(Flood, OfHostileClientsLosesNothing) {
  const int hostile = count_from("LOFT_SOAK_HOSTILE", 40);
  const int slices = count_from("LOFT_SOAK_SLICES", 100);
  const auto time = std::chrono::seconds(count_from("LOFT_SOAK_SECONDS", 4));
  const Folder folder;
  Running running(folder, {"stream", "--no-input", "--port", "0"});
  const int port = running.port();
  std::atomic<bool> is_over = false;
  std::vector<std::atomic<int>> seen(2);
  std::vector<std::thread> threads;
  for (auto& count : seen)
    threads.emplace_back([&] {
      httplib::Client viewer("127.0.0.1", port);
      viewer.Get("/events", [&](const char* bytes, std::size_t size) {
        // Lines that begin so: pieces may end anywhere, a test of many edits bears that.
        const std::string text(bytes, size);
        for (auto at = text.find("event: change"); at != std::string::npos;
             at = text.find("event: change", at + 1))
          ++count;
        return !is_over;
      });
    });
  std::this_thread::sleep_for(milliseconds(300));
  for (int i = 0; i < hostile; ++i) threads.emplace_back([&, i] { harm(i % 5, port, is_over); });
  const auto client = running.client();
  const auto begin = Clock::now();
  std::vector<double> latencies;
  double most_memory = 0;
  for (int i = 0; i < slices; ++i) {
    std::this_thread::sleep_until(begin + time * i / slices);
    const auto start = Clock::now();
    const auto answer = client->Post("/slices", leaning(i), "text/plain");
    latencies.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    ASSERT_TRUE(answer);
    ASSERT_EQ(answer->status, 200) << answer->body;
    if (i % 20 != 0) continue;
    const auto memory = json::parse(client->Get("/status")->body)["memory_bytes"].get<double>();
    most_memory = std::max(most_memory, memory);
  }
  const json heights = json::parse(client->Get("/slices")->body)["slices"];
  std::this_thread::sleep_for(milliseconds(500));
  is_over = true;
  client->Post("/slices", leaning(slices), "text/plain");  // wakes the viewers
  for (std::thread& thread : threads) thread.join();
  std::ranges::sort(latencies);
  const double p99 = latencies[latencies.size() * 99 / 100];
  std::cout << "posts: median " << latencies[latencies.size() / 2] << " ms, p99 " << p99
            << " ms; memory " << most_memory / 1e6 << " MB\n";
  EXPECT_EQ(heights.size(), static_cast<std::size_t>(slices));
  for (const auto& count : seen) EXPECT_GE(count, slices);
  EXPECT_LT(most_memory, 200e6 * memory_factor);
  EXPECT_LT(p99, 500);  // 50 where the machine does nothing else
}

}  // namespace
}  // namespace loft::app
