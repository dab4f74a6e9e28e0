// SPDX-License-Identifier: MIT
#pragma once

#include <httplib.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/server/request_reader.h"

namespace loft::app {

/// What stands before the routes: cpp-httplib (0.11) reads a head without a bound, gives each
/// connection a thread for as long as it likes, and goes on behind requests that it has not read.
/// Here one thread looks after all connections; a request goes to the library when it is there as a
/// whole, and only its own bytes. Answers are sent by the same thread: nobody's slowness takes more
/// than a bounded place in a table.
///
/// Bounds: `most_connections` of them, the oldest that has asked for nothing yet makes room, then
/// the one that is idle the longest; seconds for a head, a body and an answer; bytes that come in
/// and go out in all, what has stood still the longest makes room. A refusal ends its connection.
class Gate : public httplib::Server {
 public:
  struct Limits {
    RequestLimits request = {};
    std::size_t most_connections = 512;
    std::size_t most_bytes_in = std::size_t{64} << 20U;
    std::size_t most_bytes_out = std::size_t{32} << 20U;
    std::chrono::milliseconds head_patience{10'000};
    std::chrono::milliseconds body_patience{60'000};
    std::chrono::milliseconds idle_patience{30'000};
    std::chrono::milliseconds stall_patience{5'000};  ///< of an answer that is not taken
  };

  explicit Gate(const Limits& limits) : limits_(limits) {}
  ~Gate() override { close(); }
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;

  /// The port; -1 if the address cannot be bound, see errno (0: there is none of that name).
  [[nodiscard]] int open(const std::string& host, int port);
  void serve();
  /// Answers what has been asked; then nothing is served any more.
  void close();

 private:
  using Clock = std::chrono::steady_clock;
  struct Connection;
  class Exchange;
  using Shared = std::shared_ptr<Connection>;

  void run();
  void handle(const Shared& connection, unsigned events);
  void accept_some();
  bool make_room();
  void receive(const Shared& connection);
  void look_at(const Shared& connection);
  void refuse(const Shared& connection);
  void start(const Shared& connection);
  void answer(const Shared& connection, const std::string& request);
  void finish_answered();
  void flush(const Shared& connection);
  void settle(const Shared& connection);
  void drop(const Shared& connection);
  void drop_overdue();
  void bound_memory();
  [[nodiscard]] bool is_overdue(Connection& connection, Clock::time_point now) const;
  [[nodiscard]] bool has_output();
  [[nodiscard]] static bool has_output(Connection& connection);
  void wake() const;

  Limits limits_;
  int listener_ = -1;
  int poll_ = -1;
  int wake_ = -1;
  std::map<int, Shared> connections_;
  bool is_listening_ = true;
  std::atomic<bool> is_closing_ = false;
  std::atomic<std::size_t> bytes_out_ = 0;
  std::size_t bytes_in_ = 0;
  std::mutex answered_mutex_;
  std::vector<Shared> answered_;
  // Edits may wait for a long one, viewers stay: neither takes the place of the others.
  std::unique_ptr<httplib::ThreadPool> posts_;
  std::unique_ptr<httplib::ThreadPool> reads_;
  std::unique_ptr<httplib::ThreadPool> viewers_;
  std::thread thread_;
};

}  // namespace loft::app
