#include "hersey/workbench/server.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "events/event_log.h"
#include "folder/folder.h"
#include "folder/watch.h"
#include "server/api.h"
#include "server/guard.h"
#include "server/http_server.h"

namespace hersey::workbench {

class Server::Impl {
 public:
  explicit Impl(ServerOptions options)
      : options_(std::move(options)),
        folder_(options_.folder),
        token_(random_token()),
        runs_(folder_, events_, options_.program),
        api_(folder_, runs_, events_, options_.open, ends_),
        http_(
            token_, [this](const Request& request) { return api_.handle(request); }, options_.log) {
    bind();
  }

  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] std::string address() const { return fmt::format("http://127.0.0.1:{}/#token={}", port_, token_); }

  void serve(const std::atomic<bool>& stop) {
    std::atomic<bool> has_ended = false;
    std::thread listening([&] {
      try {
        http_.listen();
      } catch (const std::exception& error) {
        log(error.what());
      }
      has_ended = true;
    });
    Watch watch(folder_);
    constexpr std::chrono::milliseconds kTick{50};  // so long an event of a run waits at most
    constexpr std::chrono::milliseconds kLeastPause{500};
    constexpr int kPausePerLook = 20;  // a large folder is looked at in a twentieth of the time
    using Steady = std::chrono::steady_clock;
    Steady::time_point next_look = Steady::now() + kLeastPause;
    std::string last_fault;
    while (!stop && !has_ended) {
      std::this_thread::sleep_for(kTick);
      // Nothing that lies in the folder is a reason to end.
      try {
        runs_.follow();
        const Steady::time_point look = Steady::now();
        if (look < next_look) continue;
        if (const std::vector<std::string> paths = watch.changes(); !paths.empty())
          events_.add("files", nlohmann::json{{"paths", paths}}.dump(-1, ' ', false, kReplace));
        const Steady::time_point end = Steady::now();
        next_look = end + std::max<Steady::duration>(kLeastPause, kPausePerLook * (end - look));
      } catch (const std::exception& fault) {
        if (fault.what() != last_fault) log(fmt::format("changes in the folder cannot be followed: {}", fault.what()));
        last_fault = fault.what();
      }
    }
    const bool ends_by_itself = has_ended && !stop;
    ends_ = true;
    // A stop before it has begun to listen has no effect.
    while (!has_ended) {
      http_.stop();
      std::this_thread::sleep_for(kTick);
    }
    listening.join();
    if (ends_by_itself) throw std::runtime_error("the port is no longer open to connections; start `hersey open` anew");
  }

 private:
  static constexpr auto kReplace = nlohmann::json::error_handler_t::replace;

  void log(const std::string& line) const {
    if (options_.log) options_.log(line);
  }

  void bind() {
    constexpr int kFirst = 8437, kMost = 100;
    if (options_.port != 0) {
      if (!http_.bind(options_.port))
        throw std::runtime_error(
            fmt::format("port {} cannot be used: another program has it, or it is reserved; "
                        "leave out --port to take the next free one",
                        options_.port));
      port_ = options_.port;
      return;
    }
    for (int port = kFirst; port < kFirst + kMost; ++port)
      if (http_.bind(port)) {
        port_ = port;
        return;
      }
    throw std::runtime_error(
        fmt::format("no port from {} to {} is free; choose one by --port", kFirst, kFirst + kMost - 1));
  }

  ServerOptions options_;
  Folder folder_;
  EventLog events_;
  std::string token_;
  std::atomic<bool> ends_ = false;
  Runs runs_;
  Api api_;
  HttpServer http_;
  int port_ = 0;
};

Server::Server(ServerOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}

Server::~Server() = default;

int Server::port() const { return impl_->port(); }

std::string Server::address() const { return impl_->address(); }

void Server::serve(const std::atomic<bool>& stop) { impl_->serve(stop); }

}  // namespace hersey::workbench
