// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <httplib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/app/program.h"

namespace loft::app::testing {

/// `loft ARGUMENTS` in a folder, while it runs. Its words go to err.txt there. Ends it at the end.
class Running {
 public:
  Running(const Folder& folder, const std::vector<std::string>& arguments) : folder_(folder) {
    std::vector<const char*> words{std::getenv("LOFT")};
    for (const std::string& argument : arguments) words.push_back(argument.c_str());
    words.push_back(nullptr);
    std::filesystem::remove(folder / "err.txt");
    process_ = ::fork();
    if (process_ != 0) return;
    const int out = ::open((folder / "out.txt").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const int err = ::open((folder / "err.txt").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const int in = ::open("/dev/null", O_RDONLY);
    ::dup2(in, 0);
    ::dup2(out, 1);
    ::dup2(err, 2);
    if (::chdir((folder / "").c_str()) == 0)
      ::execv(words[0], const_cast<char* const*>(words.data()));
    std::_Exit(127);
  }
  ~Running() {
    if (process_ > 0) kill();
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  /// Whether it says that; waits for it.
  [[nodiscard]] bool says(const std::string& words) const {
    for (int i = 0; i < 3000; ++i) {
      if (content(folder_ / "err.txt").find(words) != std::string::npos) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  /// The port that it says it listens on; waits for that. 0 if it ends before.
  [[nodiscard]] int port() const {
    const std::string mark = "listening on http://127.0.0.1:";
    for (int i = 0; i < 3000; ++i) {
      const std::string words = content(folder_ / "err.txt");
      const std::size_t place = words.find(mark);
      if (place != std::string::npos && words.find('/', place + mark.size()) != std::string::npos)
        return std::atoi(words.c_str() + place + mark.size());
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return 0;
  }
  [[nodiscard]] std::unique_ptr<httplib::Client> client() const {
    auto client = std::make_unique<httplib::Client>("127.0.0.1", port());
    client->set_keep_alive(true);
    client->set_tcp_nodelay(true);
    client->set_read_timeout(60);
    return client;
  }

  [[nodiscard]] pid_t process() const { return process_; }
  void send(int signal) const { ::kill(process_, signal); }
  /// Waits for its end; its exit code, or minus the signal that ended it.
  int wait() {
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  void kill() {
    send(SIGKILL);
    wait();
  }
  int interrupt() {
    send(SIGINT);
    return wait();
  }

 private:
  const Folder& folder_;
  pid_t process_ = 0;
};

}  // namespace loft::app::testing
