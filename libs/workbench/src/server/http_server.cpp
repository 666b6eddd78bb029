#include "server/http_server.h"

// The names of cpp-httplib and what it includes come first: no other file includes them.
#include <fmt/format.h>
#include <httplib.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "server/guard.h"

namespace hersey::workbench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kHeadTime = std::chrono::seconds(10);   // for the head of a request, from its first byte
constexpr auto kBodyTime = std::chrono::seconds(10);   // for its body, from the end of the head
constexpr auto kIdleTime = std::chrono::seconds(60);   // between requests of one connection
constexpr auto kWriteTime = std::chrono::seconds(10);  // until the client takes some more of a reply
constexpr auto kDrainTime = std::chrono::seconds(2);   // in which a refused body is read and discarded
// cpp-httplib splits the first line by regular expressions, whose depth grows with it.
constexpr std::size_t kMostHead = 16384;
constexpr std::size_t kMostConnections = 96;
// Connections above the limit for a moment, while the idle ones that they replace close.
constexpr std::size_t kMostThreads = 2 * kMostConnections;

constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "connect-src 'self'; frame-src 'self'; worker-src 'self' blob:; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'";

/// One client's socket as cpp-httplib reads and writes it, with deadlines for whole requests where that library has one
/// for each byte.
class Connection : public httplib::Stream {
 public:
  explicit Connection(int socket) : socket_(socket) {}

  /// Waits for the first byte of the next request. @returns false if none comes
  bool await_request() {
    at_rest_since_ = Clock::now();
    head_bytes_ = 0;
    in_head_ = true;
    deadline_ = Clock::now() + kIdleTime;
    if (begin_ == end_ && !fill()) return false;
    deadline_ = Clock::now() + kHeadTime;
    return true;
  }
  /// The head of the request has been read. @param is_public  who sends it need not have the token
  void begin_body(bool is_public) {
    is_public_ = is_public;
    in_head_ = false;
    deadline_ = Clock::now() + kBodyTime;
  }
  /// Reads and discards what the client still sends, so that it reads the reply before it sees the connection closed.
  void drain() {
    ::shutdown(socket_, SHUT_WR);
    in_head_ = false;
    deadline_ = Clock::now() + kDrainTime;
    begin_ = end_;
    while (fill()) begin_ = end_;
  }

  /// True while no complete request of someone with the token has been received: who takes the page or a report slowly
  /// must not keep others out.
  [[nodiscard]] bool can_make_room() const { return in_head_ || is_public_; }
  [[nodiscard]] bool is_closing() const { return is_closing_; }
  [[nodiscard]] Clock::time_point at_rest_since() const { return at_rest_since_; }
  void close_early() {
    is_closing_ = true;
    ::shutdown(socket_, SHUT_RDWR);
  }
  /// No further request of this connection is read.
  void close_after_reply() { closes_ = true; }
  [[nodiscard]] bool closes() const { return closes_; }

  bool is_readable() const override { return begin_ < end_ || is_ready(POLLIN, {}); }
  bool is_writable() const override { return !is_hung_up(); }
  [[nodiscard]] bool is_hung_up() const {
    pollfd entry{socket_, POLLRDHUP, 0};
    return ::poll(&entry, 1, 0) > 0 && (entry.revents & (POLLRDHUP | POLLHUP | POLLERR)) != 0;
  }

  ssize_t read(char* data, size_t size) override {
    if (begin_ == end_ && !fill()) return give_up();
    std::size_t most = std::min(size, end_ - begin_);
    if (in_head_) {
      if (head_bytes_ >= kMostHead) return give_up();
      most = std::min(most, kMostHead - head_bytes_);
      head_bytes_ += most;
    }
    std::memcpy(data, buffer_.data() + begin_, most);
    begin_ += most;
    return static_cast<ssize_t>(most);
  }

  ssize_t write(const char* data, size_t size) override {
    if (!is_ready(POLLOUT, kWriteTime)) return -1;
    return ::send(socket_, data, size, MSG_NOSIGNAL | MSG_DONTWAIT);
  }

  void get_remote_ip_and_port(std::string& ip, int& port) const override { ip = "127.0.0.1", port = 0; }
  void get_local_ip_and_port(std::string& ip, int& port) const override { ip = "127.0.0.1", port = 0; }
  socket_t socket() const override { return socket_; }

 private:
  /// What follows a request that has not been read to its end is no request.
  ssize_t give_up() {
    closes_ = true;
    return -1;
  }

  [[nodiscard]] bool is_ready(short event, Clock::duration patience) const {
    pollfd entry{socket_, event, 0};
    const auto wait = std::chrono::duration_cast<std::chrono::milliseconds>(patience).count();
    int ready = 0;
    do ready = ::poll(&entry, 1, static_cast<int>(std::max<long>(wait, 0)));
    while (ready < 0 && errno == EINTR);
    return ready > 0;
  }

  bool fill() {
    if (!is_ready(POLLIN, deadline_ - Clock::now())) return false;
    const ssize_t got = ::recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    if (got <= 0) return false;
    begin_ = 0;
    end_ = static_cast<std::size_t>(got);
    return true;
  }

  int socket_;
  Clock::time_point deadline_;
  std::atomic<Clock::time_point> at_rest_since_ = Clock::now();
  std::atomic<bool> in_head_ = true;
  std::atomic<bool> is_public_ = true;
  std::atomic<bool> is_closing_ = false;
  bool closes_ = false;
  std::size_t head_bytes_ = 0;
  std::array<char, 16384> buffer_{};
  std::size_t begin_ = 0, end_ = 0;
};

/// The connections being served.
class Connections {
 public:
  void add(Connection& connection) {
    const std::lock_guard lock(mutex_);
    open_.insert(&connection);
  }
  void remove(Connection& connection) {
    const std::lock_guard lock(mutex_);
    open_.erase(&connection);
  }
  /// Closes the connection that has been without a request to the interface for longest, where there are as many as may
  /// be.
  void make_room() {
    const std::lock_guard lock(mutex_);
    const auto staying =
        std::count_if(open_.begin(), open_.end(), [](const Connection* c) { return !c->is_closing(); });
    if (static_cast<std::size_t>(staying) < kMostConnections) return;
    Connection* oldest = nullptr;
    for (Connection* connection : open_)
      if (!connection->is_closing() && connection->can_make_room() &&
          (oldest == nullptr || connection->at_rest_since() < oldest->at_rest_since()))
        oldest = connection;
    if (oldest != nullptr) oldest->close_early();
  }
  void close_all() {
    const std::lock_guard lock(mutex_);
    for (Connection* connection : open_) connection->close_early();
  }

 private:
  std::mutex mutex_;
  std::set<Connection*> open_;
};

thread_local bool is_over_limit = false;
thread_local Connection* current = nullptr;
thread_local Request head_of_request;
thread_local std::optional<Refusal> refused;

/// One thread for each connection, up to a limit; above it the connection is refused in the accepting thread.
class Threads : public httplib::TaskQueue {
 public:
  explicit Threads(Connections& connections) : connections_(connections) {}

  /// Nothing in cpp-httplib 0.11; in later versions, whether the task was taken.
  using Taken = decltype(std::declval<httplib::TaskQueue&>().enqueue(nullptr));
  Taken enqueue(std::function<void()> task) override {
    take(task);
    return Taken(true);
  }

  void shutdown() override {
    connections_.close_all();
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [&] { return count_ == 0; });
  }

 private:
  void take(const std::function<void()>& task) {
    connections_.make_room();
    {
      std::unique_lock lock(mutex_);
      // Those that make room take a moment to end.
      constexpr auto kPatience = std::chrono::milliseconds(500);
      if (ended_.wait_for(lock, kPatience, [&] { return count_ < kMostThreads; })) {
        ++count_;
        try {
          std::thread([this, task] {
            task();
            const std::lock_guard ending(mutex_);
            --count_;
            ended_.notify_all();
          }).detach();
          return;
        } catch (const std::system_error&) {
          --count_;  // the system has no more threads
        }
      }
    }
    is_over_limit = true;
    task();
    is_over_limit = false;
  }

  Connections& connections_;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::size_t count_ = 0;
};

std::string small_letters(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

Request head_of(const httplib::Request& received) {
  Request head;
  head.method = received.method;
  head.path = received.path;
  for (const auto& [name, value] : received.params) head.query[name] = value;
  for (const auto& [name, value] : received.headers) head.headers.emplace(small_letters(name), value);
  return head;
}

/// Printable and short, whatever a client sends.
std::string in_log(const std::string& path) {
  constexpr std::size_t kMost = 120;
  std::string text;
  for (const char c : path.substr(0, kMost)) text += c > ' ' && c < '\x7f' ? c : '?';
  return path.size() > kMost ? text + "..." : text;
}

void fill_in(httplib::Response& response, Reply reply) {
  response.status = reply.status;
  for (const auto& [name, value] : reply.headers) {
    response.headers.erase(name);
    response.set_header(name, value);
  }
  if (!reply.stream) return response.set_content(reply.body, reply.type);
  // An empty part would end the stream.
  const auto provide = [stream = std::move(reply.stream)](std::size_t, httplib::DataSink& sink) {
    const StreamWriter write = [&](std::string_view text) {
      return text.empty() ? !current->is_hung_up() : sink.write(text.data(), text.size());
    };
    return stream(write);
  };
  response.set_chunked_content_provider(reply.type, provide);
}

}  // namespace

class HttpServer::Impl : public httplib::Server {
 public:
  Impl(std::string token, workbench::Handler handler, Log log)
      : token_(std::move(token)), handler_(std::move(handler)), log_(std::move(log)) {
    new_task_queue = [this] { return new Threads(connections_); };
    set_payload_max_length(kMostBody);
    set_tcp_nodelay(true);
    set_keep_alive_max_count(1000);
    set_keep_alive_timeout(kIdleTime.count());
    // The port of a server that has just ended can be bound again, one in use cannot.
    set_socket_options([](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    set_default_headers({{"Content-Security-Policy", kPolicy},
                         {"Referrer-Policy", "no-referrer"},
                         {"X-Content-Type-Options", "nosniff"},
                         {"Cache-Control", "no-store"}});
    set_pre_routing_handler([](const httplib::Request&, httplib::Response& response) { return guard(response); });
    const auto answer_it = [this](const httplib::Request& request, httplib::Response& response) {
      answer(request, response);
    };
    Get("/", answer_it);
    Post("/", answer_it);
    Put("/", answer_it);
    set_logger([this](const httplib::Request&, const httplib::Response& response) { note(response); });
  }

  bool bind_with_queue(int port) {
    // The library lets five connections wait to be accepted; a browser opens six at once, and who comes in vain waits a
    // second before it tries again.
    constexpr int kMostWaiting = 1024;
    return bind_to_port("127.0.0.1", port) && ::listen(svr_sock_, kMostWaiting) == 0;
  }

 private:
  bool process_and_close_socket(socket_t socket) override {
    if (is_over_limit) {
      constexpr std::string_view reply =
          "HTTP/1.1 503 Service Unavailable\r\nConnection: close\r\nContent-Length: 0\r\n\r\n";
      [[maybe_unused]] const ssize_t sent = ::send(socket, reply.data(), reply.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      ::close(socket);
      write_log("503 too many connections");
      return false;
    }
    ::fcntl(socket, F_SETFD, FD_CLOEXEC);
    Connection connection(socket);
    connections_.add(connection);
    current = &connection;
    bool closes = false;
    while (!closes && connection.await_request()) {
      refused.reset();
      head_of_request = {};
      const bool is_good = answer(*this, connection, closes, [&](httplib::Request& request) { examine(request); });
      closes = closes || connection.closes() || !is_good || !is_running();
    }
    if (connection.closes()) connection.drain();
    current = nullptr;
    connections_.remove(connection);
    ::shutdown(socket, SHUT_RDWR);
    ::close(socket);
    return true;
  }

  /// Reads a request and answers it. Later versions of cpp-httplib than 0.11 take the addresses as arguments.
  template <class Server, class Examine>
  static bool answer(Server& server, Connection& connection, bool& closes, const Examine& examine) {
    if constexpr (requires { server.process_request(connection, false, closes, examine); }) {
      return server.process_request(connection, false, closes, examine);
    } else {
      std::string remote, local;
      int remote_port = 0, local_port = 0;
      connection.get_remote_ip_and_port(remote, remote_port);
      connection.get_local_ip_and_port(local, local_port);
      return server.process_request(connection, remote, remote_port, local, local_port, false, closes, examine);
    }
  }

  /// The head has been read, the body not yet.
  void examine(httplib::Request& request) {
    head_of_request = head_of(request);
    refused = refusal(head_of_request, token_);
    current->begin_body(refused.has_value() || !head_of_request.path.starts_with("/api/"));
    // The library is to serve neither ranges nor compressed replies, and to find every route in one comparison.
    request.ranges.clear();
    request.headers.erase("Accept-Encoding");
    request.path = "/";
    if (!refused) return;
    current->close_after_reply();
    request.headers.erase("Connection");
    request.headers.emplace("Connection", "close");
  }

  static HandlerResponse guard(httplib::Response& response) {
    if (!refused) return HandlerResponse::Unhandled;
    response.status = refused->status;
    response.set_content(error_json(refused->error, refused->advice), "application/json");
    return HandlerResponse::Handled;
  }

  void answer(const httplib::Request& received, httplib::Response& response) {
    Request request = std::move(head_of_request);
    request.body = received.body;
    head_of_request.method = request.method, head_of_request.path = request.path;
    Reply reply;
    try {
      reply = handler_(request);
    } catch (const std::exception& error) {
      reply = {.status = 500, .body = error_json(error.what(), "please report it with the model")};
    }
    fill_in(response, std::move(reply));
  }

  /// Refused requests and failures; that something is not there or has changed is an everyday answer.
  void note(const httplib::Response& response) {
    const int status = response.status;
    const bool is_everyday = status < 400 || status == 404 || status == 409 || status == 412 || status == 422;
    if (is_everyday && !refused) return;
    if (head_of_request.method.empty()) return write_log(fmt::format("{} a request that cannot be read", status));
    const std::string why = refused ? ": " + refused->error : "";
    write_log(fmt::format("{} {} {}{}", status, in_log(head_of_request.method), in_log(head_of_request.path), why));
  }

  /// At most so many lines a second: a flood of requests is no flood of the log.
  void write_log(const std::string& line) {
    constexpr int kMostLines = 20;
    if (!log_) return;
    const std::lock_guard lock(log_mutex_);
    const Clock::time_point now = Clock::now();
    if (now - second_ > std::chrono::seconds(1)) {
      if (lines_ > kMostLines) log_(fmt::format("{} more requests refused", lines_ - kMostLines));
      second_ = now, lines_ = 0;
    }
    if (++lines_ <= kMostLines) log_(line);
  }

  std::string token_;
  workbench::Handler handler_;
  Log log_;
  Connections connections_;
  std::mutex log_mutex_;
  Clock::time_point second_;
  int lines_ = 0;
};

HttpServer::HttpServer(std::string token, Handler handler, Log log)
    : impl_(std::make_unique<Impl>(std::move(token), std::move(handler), std::move(log))) {}

HttpServer::~HttpServer() = default;

bool HttpServer::bind(int port) { return impl_->bind_with_queue(port); }

void HttpServer::listen() { impl_->listen_after_bind(); }

void HttpServer::stop() { impl_->stop(); }

}  // namespace hersey::workbench
