// SPDX-License-Identifier: MIT
#include "app/server/gate.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

#include "app/json.h"
#include "app/server/http.h"

namespace loft::app {

namespace {

using std::chrono::milliseconds;

constexpr std::size_t post_threads = 24;
constexpr std::size_t read_threads = 4;  // each may make a whole surface
constexpr std::size_t viewer_threads = 40;
constexpr std::size_t most_ahead = std::size_t{256} << 10U;  // of a stream, before its reader
constexpr std::size_t own_bytes = std::size_t{64} << 10U;    // of each connection, not shared
constexpr std::size_t most_drained = std::size_t{64} << 20U;

/// As many files as there may be, so that a flood leaves some for sessions and outputs.
std::size_t room_for(std::size_t wanted) {
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) != 0 || files.rlim_cur == RLIM_INFINITY) return wanted;
  const auto usable = static_cast<std::size_t>(files.rlim_cur);
  return std::min(wanted, std::max<std::size_t>(usable / 2, 8));
}

const char* reason(int status) {
  switch (status) {
    case 408:
      return "Request Timeout";
    case 413:
      return "Payload Too Large";
    case 414:
      return "URI Too Long";
    case 431:
      return "Request Header Fields Too Large";
    case 503:
      return "Service Unavailable";
    default:
      return "Bad Request";
  }
}

}  // namespace

struct Gate::Connection {
  enum class Phase { reading, working, closing };

  Connection(int file, const RequestLimits& limits) : socket(file), reader(limits) {}
  ~Connection() { ::close(socket); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // Of the thread that looks after all.
  const int socket;
  RequestReader reader;
  Phase phase = Phase::reading;
  unsigned events = 0;
  Clock::time_point begin = Clock::now();  // of the phase, or of what came in it first
  std::optional<Clock::time_point> body_begin;
  std::size_t bytes_in = 0;  // as counted in all
  std::size_t drained = 0;
  bool has_asked = false;
  bool is_dropped = false;
  bool is_shut = false;

  std::atomic<bool> is_gone = false;  // its client, or we have enough of it
  bool is_kept = false;               // set before it is put among the answered

  std::mutex mutex;  // of what follows
  std::condition_variable drained_out;
  std::string out;
  std::size_t sent = 0;       // of it
  Clock::time_point moved{};  // when some was sent, or it began to wait
  Clock::time_point due{};    // all must be sent by then
};

/// One request and its answer, as the library sees them.
class Gate::Exchange : public httplib::Stream {
 public:
  Exchange(Gate& gate, Connection& connection, const std::string& request)
      : gate_(gate), connection_(connection), request_(request) {}

  [[nodiscard]] bool is_read() const { return place_ == request_.size(); }

  bool is_readable() const override { return !is_read(); }
  bool is_writable() const override { return !connection_.is_gone; }
  ssize_t read(char* bytes, size_t size) override {
    const std::size_t count = std::min(size, request_.size() - place_);
    std::memcpy(bytes, request_.data() + place_, count);
    place_ += count;
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* bytes, size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override { nobody(ip, port); }
  void get_local_ip_and_port(std::string& ip, int& port) const override { nobody(ip, port); }
  socket_t socket() const override { return connection_.socket; }

 private:
  static void nobody(std::string& ip, int& port) {
    ip.clear();
    port = 0;
  }

  Gate& gate_;
  Connection& connection_;
  const std::string& request_;
  std::size_t place_ = 0;
};

/// Waits only where much has been written already: an answer that goes on without end.
ssize_t Gate::Exchange::write(const char* bytes, size_t size) {
  std::unique_lock lock(connection_.mutex);
  const bool has_room = connection_.drained_out.wait_for(lock, gate_.limits_.stall_patience, [&] {
    return connection_.is_gone || connection_.out.size() - connection_.sent <= most_ahead;
  });
  if (!has_room || connection_.is_gone) {
    connection_.is_gone = true;
    return -1;
  }
  const auto now = Clock::now();
  if (connection_.out.empty()) {
    connection_.moved = now;
    connection_.due = now + milliseconds(30'000);
  }
  connection_.due += milliseconds(size / 256);  // 256 kB a second
  connection_.out.append(bytes, size);
  gate_.bytes_out_ += size;
  lock.unlock();
  gate_.wake();
  return static_cast<ssize_t>(size);
}

int Gate::open(const std::string& host, int port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  errno = 0;
  if (::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found) != 0) return -1;
  for (const addrinfo* one = found; one != nullptr && listener_ < 0; one = one->ai_next) {
    const int file =
        ::socket(one->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, one->ai_protocol);
    if (file < 0) continue;
    // Not SO_REUSEPORT: two programs could listen on one port, and edits would go to either.
    const int yes = 1;
    ::setsockopt(file, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if (::bind(file, one->ai_addr, one->ai_addrlen) == 0 && ::listen(file, SOMAXCONN) == 0) {
      listener_ = file;
    } else {
      const int cause = errno;
      ::close(file);
      errno = cause;
    }
  }
  ::freeaddrinfo(found);
  if (listener_ < 0) return -1;
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
  if (address.ss_family == AF_INET6)
    return ntohs(reinterpret_cast<const sockaddr_in6&>(address).sin6_port);
  return ntohs(reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

void Gate::serve() {
  limits_.most_connections = room_for(limits_.most_connections);
  posts_ = std::make_unique<httplib::ThreadPool>(post_threads);
  reads_ = std::make_unique<httplib::ThreadPool>(read_threads);
  viewers_ = std::make_unique<httplib::ThreadPool>(viewer_threads);
  svr_sock_ = listener_;  // the library takes it for a sign that it goes on
  poll_ = ::epoll_create1(EPOLL_CLOEXEC);
  wake_ = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  for (const int file : {listener_, wake_}) {
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.fd = file;
    ::epoll_ctl(poll_, EPOLL_CTL_ADD, file, &event);
  }
  thread_ = std::thread([this] { run(); });
}

void Gate::close() {
  if (thread_.joinable()) {
    svr_sock_ = INVALID_SOCKET;
    for (auto* pool : {posts_.get(), reads_.get(), viewers_.get()}) pool->shutdown();
    is_closing_ = true;
    wake();
    thread_.join();
  }
  for (int* file : {&listener_, &poll_, &wake_})
    if (const int open = std::exchange(*file, -1); open >= 0) ::close(open);
}

void Gate::wake() const {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(wake_, &one, sizeof one);
}

void Gate::run() {
  std::array<epoll_event, 64> events{};
  auto next_look = Clock::now();
  auto end = Clock::time_point::max();
  while (Clock::now() < end) {
    const int count = ::epoll_wait(poll_, events.data(), static_cast<int>(events.size()), 100);
    for (int i = 0; i < count; ++i) {
      const epoll_event& event = events[static_cast<std::size_t>(i)];
      if (event.data.fd == listener_) {
        accept_some();
      } else if (event.data.fd == wake_) {
        std::uint64_t ignored = 0;
        [[maybe_unused]] const auto read = ::read(wake_, &ignored, sizeof ignored);
      } else if (const auto found = connections_.find(event.data.fd); found != connections_.end()) {
        handle(Shared(found->second), event.events);
      }
    }
    finish_answered();
    bound_memory();
    const auto now = Clock::now();
    if (now >= next_look) {
      drop_overdue();
      next_look = now + milliseconds(100);
    }
    if (is_closing_ && end == Clock::time_point::max()) end = now + milliseconds(500);
    if (is_closing_ && !has_output()) break;
  }
  while (!connections_.empty()) drop(Shared(connections_.begin()->second));
}

void Gate::handle(const Shared& connection, unsigned events) {
  if ((events & (EPOLLERR | EPOLLHUP)) != 0) return drop(connection);
  if ((events & EPOLLRDHUP) != 0 && connection->phase == Connection::Phase::working)
    connection->is_gone = connection->is_gone || connection->reader.path() == "/events";
  if ((events & EPOLLIN) != 0) receive(connection);
  if (!connection->is_dropped) flush(connection);
}

void Gate::accept_some() {
  for (int i = 0; i < 64; ++i) {
    if (connections_.size() >= limits_.most_connections && !make_room()) return;
    const int file = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (file < 0 && (errno == EMFILE || errno == ENFILE) && make_room()) continue;
    if (file < 0) return;
    const int yes = 1;
    ::setsockopt(file, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    const auto connection = std::make_shared<Connection>(file, limits_.request);
    connections_.emplace(file, connection);
    epoll_event event{};
    event.data.fd = file;
    ::epoll_ctl(poll_, EPOLL_CTL_ADD, file, &event);
    settle(connection);
  }
}

/// Who has asked for nothing goes before those who have, who is in the middle of nothing before
/// those who are.
bool Gate::make_room() {
  const auto rank = [](const Connection& one) {
    if (one.phase == Connection::Phase::closing) return 0;
    if (!one.has_asked) return 1;
    return one.phase == Connection::Phase::reading ? 2 : 3;
  };
  Shared worst;
  for (const auto& [file, one] : connections_) {
    if (rank(*one) == 3) continue;
    if (!worst || std::pair(rank(*one), one->begin) < std::pair(rank(*worst), worst->begin))
      worst = one;
  }
  if (!worst) {
    // All are being answered: the listener would be reported without end.
    is_listening_ = false;
    epoll_event event{};
    event.data.fd = listener_;
    ::epoll_ctl(poll_, EPOLL_CTL_MOD, listener_, &event);
    return false;
  }
  drop(worst);
  return true;
}

void Gate::receive(const Shared& connection) {
  std::array<char, 1 << 16> bytes;
  for (int i = 0; i < 16; ++i) {
    if (connection->phase == Connection::Phase::working) return;
    const ssize_t count = ::recv(connection->socket, bytes.data(), bytes.size(), 0);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (count <= 0) return drop(connection);
    const auto size = static_cast<std::size_t>(count);
    if (connection->phase == Connection::Phase::closing) {
      connection->drained += size;
      if (connection->drained > most_drained) return drop(connection);
      continue;
    }
    if (!connection->reader.has_begun()) connection->begin = Clock::now();
    connection->reader.read({bytes.data(), size});
    look_at(connection);
    if (connection->is_dropped) return;
  }
}

void Gate::look_at(const Shared& connection) {
  RequestReader& reader = connection->reader;
  bytes_in_ -= connection->bytes_in;
  connection->bytes_in = reader.size() > own_bytes ? reader.size() : 0;
  bytes_in_ += connection->bytes_in;
  switch (reader.state()) {
    case RequestReader::State::head:
      return;
    case RequestReader::State::body:
      if (!connection->body_begin) connection->body_begin = Clock::now();
      if (reader.take_expectation()) {
        const std::string_view word = "HTTP/1.1 100 Continue\r\n\r\n";
        ::send(connection->socket, word.data(), word.size(), MSG_NOSIGNAL);
      }
      return;
    case RequestReader::State::whole:
      return start(connection);
    case RequestReader::State::refused:
      return refuse(connection);
  }
}

/// Says why, reads on for a while so that the words arrive, and ends the connection: what comes
/// there is no request.
void Gate::refuse(const Shared& connection) {
  const auto& [status, why] = connection->reader.refusal();
  const std::string body = Json{{"error", why}}.dump(2) + '\n';
  std::string text = "HTTP/1.1 " + std::to_string(status) + ' ' + reason(status) +
                     "\r\nConnection: close\r\nContent-Type: application/json\r\n";
  for (const auto& [name, value] : safe_headers) text += std::string(name) + ": " + value + "\r\n";
  text += "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
  connection->phase = Connection::Phase::closing;
  connection->begin = Clock::now();
  {
    const std::lock_guard lock(connection->mutex);
    connection->out += text;
    bytes_out_ += text.size();
    connection->moved = Clock::now();
    connection->due = connection->moved + limits_.stall_patience;
  }
  flush(connection);
}

void Gate::start(const Shared& connection) {
  connection->phase = Connection::Phase::working;
  connection->has_asked = true;
  settle(connection);
  const RequestReader& reader = connection->reader;
  const bool is_read = reader.method() == "GET" || reader.method() == "HEAD";
  auto& pool = !is_read ? posts_ : reader.path() == "/events" ? viewers_ : reads_;
  auto request = std::make_shared<std::string>(connection->reader.take_request());
  pool->enqueue([this, connection, request] { answer(connection, *request); });
}

/// By a thread of a pool. Nothing that is thrown ends it.
void Gate::answer(const Shared& connection, const std::string& request) {
  Exchange exchange(*this, *connection, request);
  bool is_kept = false;
  try {
    bool is_closed = false;
    const bool is_answered = process_request(exchange, false, is_closed, nullptr);
    // A body that was not read to its end: the client and we might not mean the same by it.
    is_kept = is_answered && !is_closed && exchange.is_read();
  } catch (...) {
    is_kept = false;
  }
  connection->is_kept = is_kept;
  {
    const std::lock_guard lock(answered_mutex_);
    answered_.push_back(connection);
  }
  wake();
}

void Gate::finish_answered() {
  std::vector<Shared> answered;
  {
    const std::lock_guard lock(answered_mutex_);
    answered.swap(answered_);
  }
  for (const Shared& connection : answered) {
    if (!connection->is_dropped) flush(connection);
    if (connection->is_dropped) continue;
    if (connection->is_kept && has_output(*connection)) {
      // Who does not take an answer gets no other one.
      const std::lock_guard lock(answered_mutex_);
      answered_.push_back(connection);
      continue;
    }
    connection->begin = Clock::now();
    connection->body_begin.reset();
    connection->phase =
        connection->is_kept ? Connection::Phase::reading : Connection::Phase::closing;
    if (connection->is_kept) {
      connection->reader.next();
      look_at(connection);
    } else {
      bytes_in_ -= std::exchange(connection->bytes_in, 0);
    }
  }
  // Whoever has written wakes this thread; there are not many connections.
  std::vector<Shared> writing;
  if (bytes_out_ > 0 || !answered.empty())
    for (const auto& [file, one] : connections_) writing.push_back(one);
  for (const Shared& one : writing) flush(one);
  if (is_listening_ || connections_.size() >= limits_.most_connections) return;
  is_listening_ = true;
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.fd = listener_;
  ::epoll_ctl(poll_, EPOLL_CTL_MOD, listener_, &event);
}

void Gate::flush(const Shared& connection) {
  if (connection->is_dropped) return;
  bool is_lost = connection->is_gone && connection->phase != Connection::Phase::working;
  {
    const std::lock_guard lock(connection->mutex);
    std::string& out = connection->out;
    std::size_t& sent = connection->sent;
    while (sent < out.size()) {
      const ssize_t count =
          ::send(connection->socket, out.data() + sent, out.size() - sent, MSG_NOSIGNAL);
      if (count < 0) {
        is_lost = is_lost || (errno != EAGAIN && errno != EINTR);
        break;
      }
      sent += static_cast<std::size_t>(count);
      connection->moved = Clock::now();
    }
    // A stream's reader may never be quite done: what it has is given back now and then.
    if (sent == out.size() || sent > (std::size_t{1} << 20U)) {
      bytes_out_ -= sent;
      sent == out.size() ? out = {} : out = out.substr(sent);
      sent = 0;
    }
  }
  connection->drained_out.notify_all();
  is_lost ? drop(connection) : settle(connection);
}

/// Tells the system what to wait for.
void Gate::settle(const Shared& connection) {
  const bool is_writing = has_output(*connection);
  using Phase = Connection::Phase;
  if (connection->phase == Phase::closing && !is_writing &&
      !std::exchange(connection->is_shut, true))
    ::shutdown(connection->socket, SHUT_WR);
  unsigned events = connection->phase == Phase::working ? 0U : unsigned{EPOLLIN};
  if (connection->phase == Phase::working && !connection->is_gone &&
      connection->reader.path() == "/events")
    events |= EPOLLRDHUP;
  if (is_writing) events |= EPOLLOUT;
  if (events == connection->events) return;
  connection->events = events;
  epoll_event event{};
  event.events = events;
  event.data.fd = connection->socket;
  ::epoll_ctl(poll_, EPOLL_CTL_MOD, connection->socket, &event);
}

void Gate::drop(const Shared& connection) {
  if (std::exchange(connection->is_dropped, true)) return;
  connection->is_gone = true;
  bytes_in_ -= std::exchange(connection->bytes_in, 0);
  {
    const std::lock_guard lock(connection->mutex);
    bytes_out_ -= connection->out.size();
    connection->out = {};
    connection->sent = 0;
  }
  connection->drained_out.notify_all();
  // The file is closed when nobody works for it any more; its number must not be seen till then.
  ::epoll_ctl(poll_, EPOLL_CTL_DEL, connection->socket, nullptr);
  ::shutdown(connection->socket, SHUT_RDWR);
  connections_.erase(connection->socket);
}

bool Gate::is_overdue(Connection& connection, Clock::time_point now) const {
  {
    const std::lock_guard lock(connection.mutex);
    if (!connection.out.empty())
      return now > connection.moved + limits_.stall_patience || now > connection.due;
  }
  switch (connection.phase) {
    case Connection::Phase::working:
      return false;
    case Connection::Phase::closing:
      return now > connection.begin + limits_.stall_patience;
    case Connection::Phase::reading:
      break;
  }
  if (connection.body_begin) return now > *connection.body_begin + limits_.body_patience;
  const bool is_idle = connection.has_asked && !connection.reader.has_begun();
  return now > connection.begin + (is_idle ? limits_.idle_patience : limits_.head_patience);
}

void Gate::drop_overdue() {
  const auto now = Clock::now();
  std::vector<Shared> overdue;
  for (const auto& [file, one] : connections_)
    if (is_overdue(*one, now)) overdue.push_back(one);
  for (const Shared& one : overdue) {
    const bool is_asking =
        one->phase == Connection::Phase::reading && one->reader.has_begun() && !has_output(*one);
    if (!is_asking) {
      drop(one);
      continue;
    }
    one->reader.give_up(408, "the request did not come in time, or not all of it");
    look_at(one);
  }
}

/// Bodies that are still coming, and answers that nobody takes, make room for others: what has
/// stood there the longest first. What is being worked on stays.
void Gate::bound_memory() {
  while (bytes_in_ > limits_.most_bytes_in) {
    Shared oldest;
    for (const auto& [file, one] : connections_) {
      if (one->phase != Connection::Phase::reading || one->bytes_in == 0) continue;
      if (!oldest || one->begin < oldest->begin) oldest = one;
    }
    if (!oldest) break;
    oldest->reader.give_up(503, "too much is being sent at once; send it again");
    look_at(oldest);
  }
  while (bytes_out_ > limits_.most_bytes_out) {
    Shared slowest;
    Clock::time_point moved = Clock::now() - milliseconds(200);
    for (const auto& [file, one] : connections_) {
      const std::lock_guard lock(one->mutex);
      if (one->out.empty() || one->moved >= moved) continue;
      slowest = one;
      moved = one->moved;
    }
    if (!slowest) break;
    drop(slowest);
  }
}

bool Gate::has_output() {
  return std::ranges::any_of(connections_,
                             [](const auto& entry) { return has_output(*entry.second); });
}

bool Gate::has_output(Connection& connection) {
  const std::lock_guard lock(connection.mutex);
  return !connection.out.empty();
}

}  // namespace loft::app
