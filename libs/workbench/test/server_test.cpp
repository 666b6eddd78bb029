#include "hersey/workbench/server.h"

#include <doctest/doctest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "server/api.h"

namespace hersey::workbench {
namespace {

/// A folder of models for a server, removed at its end.
class ServedFolder {
 public:
  ServedFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "hersey-server-test-XXXXXX").string();
    REQUIRE(::mkdtemp(pattern.data()) != nullptr);
    path = pattern;
  }
  ServedFolder(const ServedFolder&) = delete;
  ServedFolder& operator=(const ServedFolder&) = delete;
  ~ServedFolder() { std::filesystem::remove_all(path); }

  std::filesystem::path path;
};

/// Descriptor of this process's socket that accepts connections at the port; -1 if there is none.
int accepting_socket(int port) {
  constexpr int kMostDescriptors = 1024;
  for (int fd = 0; fd < kMostDescriptors; ++fd) {
    int accepts = 0;
    socklen_t size = sizeof accepts;
    if (::getsockopt(fd, SOL_SOCKET, SO_ACCEPTCONN, &accepts, &size) != 0 || accepts == 0) continue;
    sockaddr_in address{};
    size = sizeof address;
    if (::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) == 0 && ntohs(address.sin_port) == port)
      return fd;
  }
  return -1;
}

TEST_CASE("Server_EndsWithAnErrorWhereThePortIsClosed") {
  const ServedFolder folder;
  Server server({.folder = folder.path, .open = "", .port = 0, .program = "/bin/true", .log = {}});
  const int fd = accepting_socket(server.port());
  REQUIRE(fd >= 0);
  REQUIRE(::shutdown(fd, SHUT_RDWR) == 0);
  std::atomic<bool> stop = false, has_returned = false;
  std::thread patience([&] {
    using namespace std::chrono_literals;
    for (int i = 0; i < 200 && !has_returned; ++i) std::this_thread::sleep_for(50ms);
    stop = true;
  });
  CHECK_THROWS_AS(server.serve(stop), std::runtime_error);
  has_returned = true;
  patience.join();
}

TEST_CASE("Reports_AreRemovedWithTheirTickets") {
  const ServedFolder served;
  const std::filesystem::path program = served.path / "program", made = served.path / "made";
  std::ofstream(program) << "#!/bin/sh\nfor page; do :; done\nmkdir \"${page%.html}_fields\"\n"
                         << "echo report | tee \"$page\"\necho \"$page\" >> " << made.string() << "\n";
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  std::filesystem::create_directories(served.path / "runs" / "a-001");
  for (const char* name : {"run.json", "results.h5"}) std::ofstream(served.path / "runs" / "a-001" / name) << "{}";
  const std::atomic<bool> stop = false;
  Folder folder(served.path);
  EventLog events;
  Runs runs(folder, events, program);
  Api api(folder, runs, events, "", stop);
  Request request;
  request.method = "POST";
  request.path = "/api/runs/a-001/report";
  constexpr int kTickets = 200;
  for (int i = 0; i <= kTickets; ++i) REQUIRE(api.handle(request).status == 200);
  std::vector<std::filesystem::path> pages;
  std::ifstream list(made);
  for (std::string line; std::getline(list, line);) pages.emplace_back(line);
  REQUIRE(pages.size() == kTickets + 1);
  CHECK_FALSE(std::filesystem::exists(pages.front()));
  CHECK_FALSE(std::filesystem::exists(pages.front().parent_path() / "1_fields"));
  for (std::size_t i = 1; i < pages.size(); ++i) CHECK(std::filesystem::exists(pages[i]));
}

}  // namespace
}  // namespace hersey::workbench
