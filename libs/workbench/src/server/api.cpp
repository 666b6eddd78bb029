#include "server/api.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "hersey/core/version.h"
#include "hersey/model/schema.h"
#include "server/assets.h"
#include "server/guard.h"

namespace hersey::workbench {
namespace {

using nlohmann::json;

Reply json_reply(const json& document, int status = 200) {
  return {.status = status, .body = document.dump(-1, ' ', false, json::error_handler_t::replace)};
}

Reply unknown(const std::string& path) {
  return {.status = 404, .body = error_json(path + " is not known here", "reload the page")};
}

Reply changed(const ChangedFile& file) {
  Reply reply = json_reply({{"error", "the file has been changed by another program"},
                            {"advice", "compare both texts, then save again"},
                            {"text", file.now.text},
                            {"etag", file.now.etag}},
                           412);
  reply.headers = {{"ETag", file.now.etag}};
  return reply;
}

std::string event_text(const Event& event) {
  return fmt::format("id: {}\nevent: {}\ndata: {}\n\n", event.number, event.name, event.data);
}

}  // namespace

Reply Api::handle(const Request& request) {
  try {
    return route(request);
  } catch (const NotDone& error) {
    return {.status = error.status(), .body = error_json(error.what(), error.advice())};
  } catch (const ChangedFile& file) {
    return changed(file);
  } catch (const json::exception&) {
    return {.status = 400, .body = error_json("the request is not the JSON that is expected here", "reload the page")};
  }
}

Reply Api::route(const Request& request) {
  const std::string& path = request.path;
  if (!path.starts_with("/api/")) {
    const Asset found = asset(path);
    if (request.method != "GET" || found.content.empty()) return unknown(path);
    return {.type = std::string(found.type), .body = std::string(found.content)};
  }
  const std::string call = request.method + " " + path.substr(5);
  if (call == "GET hello") return hello();
  if (call == "GET files") return files();
  if (call == "GET file" || call == "PUT file") return file(request);
  if (call == "GET schema") return {.body = model::schema_json()};
  if (call == "GET events") return event_stream(request);
  return unknown(path);
}

Reply Api::hello() const {
  return json_reply({{"version", version()},
                     {"folder", folder_.path().string()},
                     {"open", open_.empty() ? json(nullptr) : json(open_)},
                     {"event", events_.last()}});
}

Reply Api::files() const {
  json list = json::array();
  for (const FileEntry& entry : folder_.list())
    list.push_back({{"path", entry.path}, {"kind", entry.kind}, {"size", entry.size}, {"changed", entry.changed}});
  return json_reply({{"files", std::move(list)}});
}

Reply Api::file(const Request& request) {
  const std::string path = request.value("path");
  if (request.method == "GET") {
    FileText content = folder_.read(path);
    return {.type = "text/plain; charset=utf-8", .body = std::move(content.text), .headers = {{"ETag", content.etag}}};
  }
  const std::string known = request.header("if-match");
  std::string etag;
  if (!known.empty())
    etag = folder_.replace(path, request.body, known);
  else if (request.header("if-none-match") == "*")
    etag = folder_.create(path, request.body);
  else
    throw NotDone(428, "the request does not say which text it replaces", "send If-Match, or If-None-Match: *");
  return {.status = 204, .headers = {{"ETag", etag}}};
}

Reply Api::event_stream(const Request& request) const {
  const std::string after = request.value("after");
  std::uint64_t number = events_.last();
  if (!after.empty()) {
    const auto [end, error] = std::from_chars(after.data(), after.data() + after.size(), number);
    if (error != std::errc{} || end != after.data() + after.size())
      throw NotDone(400, "after is no number", "reload the page");
  }
  struct Progress {
    std::uint64_t number;
    std::chrono::steady_clock::time_point said = {};
  };
  const auto progress = std::make_shared<Progress>(Progress{number});
  Reply reply{.type = "text/event-stream"};
  reply.stream = [this, progress](const StreamWriter& write) {
    using namespace std::chrono_literals;
    if (stop_) return false;
    constexpr double kPatience = 0.2;  // [s]: so soon the stream notices that nobody reads it or the server ends
    std::string text;
    for (const Event& event : events_.after(progress->number, kPatience)) {
      text += event_text(event);
      progress->number = event.number;
    }
    const auto now = std::chrono::steady_clock::now();
    if (text.empty() && now - progress->said > 5s) text = fmt::format(": {}\n\n", progress->number);
    if (text.empty()) return write({});
    progress->said = now;
    return write(text);
  };
  return reply;
}

}  // namespace hersey::workbench
