#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace hersey::workbench {

struct ServerOptions {
  std::filesystem::path folder;   ///< what is shown and edited: nothing outside of it is read or written
  std::string open;               ///< the model that the page opens, relative to the folder; empty: the page asks
  int port = 0;                   ///< on the loopback address; 0: the first free one from 8437 on
  std::filesystem::path program;  ///< the program `hersey`, which runs and reports as child processes
  std::function<void(const std::string& line)> log;  ///< receives a line for each refused request; may be empty
};

/// The workbench's server: a page, the files of one folder, checks of models as they are typed, runs as processes of
/// their own. It is bound to the loopback address, and answers its interface only to those who know its token.
///
/// Requests are refused if they lack the token, come from a page of another origin or under another host's name, name
/// files outside the folder or are larger than 16 MB; slow and idle clients are cut off (docs/workbench.md).
/// @verified_by tests/workbench
class Server {
 public:
  /// Binds the port. @throws std::runtime_error if the port is taken or the folder cannot be read
  explicit Server(ServerOptions options);
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  ~Server();

  /// Port on the loopback address.
  [[nodiscard]] int port() const;
  /// Address with the token in its fragment, which browsers do not send.
  [[nodiscard]] std::string address() const;

  /// Serves until `stop` becomes true. Runs that were started go on.
  /// @throws std::runtime_error if the system closes the port before
  void serve(const std::atomic<bool>& stop);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hersey::workbench
