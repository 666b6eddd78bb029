#include "server/api.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>

#include "hersey/core/version.h"
#include "runs/latest_film.h"
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

json json_of(const RunEntry& run) {
  return {{"id", run.id},
          {"model", run.model},
          {"set", run.overrides},
          {"folder", run.folder},
          {"state", run.state},
          {"share", run.share},
          {"started", run.started == 0 ? json(nullptr) : json(run.started)},
          {"ended", run.ended == 0 ? json(nullptr) : json(run.ended)},
          {"message", run.message},
          {"at", run.at_path.empty() && run.at_line == 0
                     ? json(nullptr)
                     : json{{"path", run.at_path}, {"file", run.at_file}, {"line", run.at_line}}},
          {"results", run.results},
          {"report", run.report.empty() ? json(nullptr) : json(run.report)},
          {"can_resume", run.can_resume},
          {"study", run.is_study}};
}

std::optional<std::string> content_of(const std::filesystem::path& file) {
  constexpr std::uintmax_t kMost = std::uintmax_t{512} << 20;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || size > kMost || !stream) return std::nullopt;
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

std::string event_text(const Event& event) {
  return fmt::format("id: {}\nevent: {}\ndata: {}\n\n", event.number, event.name, event.data);
}

/// A whole number of a request. @throws Refused 422 for any other value
int whole_number(const json& request, const char* key, int otherwise) {
  const auto found = request.find(key);
  if (found == request.end()) return otherwise;
  constexpr double kMost = 1e9;  // fits an int
  const double value = found->is_number() ? found->get<double>() : kMost;
  if (std::abs(value) >= kMost || value != std::floor(value))
    throw Refused(422, fmt::format("{} is no whole number", key), "give one such as 2");
  return static_cast<int>(value);
}

}  // namespace

Reply Api::handle(const Request& request) {
  try {
    return route(request);
  } catch (const Refused& error) {
    return {.status = error.status, .body = error_json(error.error, error.advice)};
  } catch (const ChangedFile& file) {
    return changed(file);
  } catch (const json::exception&) {
    return {.status = 400, .body = error_json("the request is not the JSON that is expected here", "reload the page")};
  }
}

Reply Api::route(const Request& request) {
  const std::string& path = request.path;
  if (path.starts_with("/report/")) return report_file(request);
  if (!path.starts_with("/api/")) {
    const Asset found = asset(path);
    if (request.method != "GET" || found.content.empty()) return unknown(path);
    return {.type = std::string(found.type), .body = std::string(found.content)};
  }
  const std::string call = request.method + " " + path.substr(5);
  if (call == "GET hello") return hello();
  if (call == "GET files") return files();
  if (call == "GET file" || call == "PUT file") return file(request);
  if (call == "GET events") return event_stream(request);
  if (call == "GET schema") {
    std::call_once(schema_made_, [this] { schema_ = answers_.schema(); });
    return {.body = schema_};
  }
  if (call == "GET templates") return {.body = answers_.templates()};
  if (call == "GET examples") return {.body = answers_.examples()};
  const auto ask = [&](std::string (Answers::*question)(std::string_view) const) -> Reply {
    return {.body = (answers_.*question)(request.body)};
  };
  if (call == "POST check") return ask(&Answers::check);
  if (call == "POST move") return ask(&Answers::move);
  if (call == "POST bearing") return ask(&Answers::bearing);
  if (call == "POST mesh") return ask(&Answers::mesh_info);
  if (call == "POST name_surfaces") return ask(&Answers::name_surfaces);
  if (call == "POST explain") return ask(&Answers::explain);
  if (call == "POST convert") return ask(&Answers::convert);
  if (call == "POST set") return ask(&Answers::set_value);
  if (call == "POST template") return ask(&Answers::template_scene);
  if (call == "POST new") return ask(&Answers::new_model);
  if (call == "POST cad") return start_cad(request);
  if (path.starts_with("/api/cad/")) return of_cad(request);
  if (call == "POST plan") return {.body = studies_.plan(json::parse(request.body))};
  if (call == "GET runs") return run_list();
  if (call == "POST runs") return json_reply({{"id", runs_.start(json::parse(request.body))}});
  if (call == "POST bearing_report") return ticket_for(runs_.bearing_report(json::parse(request.body)));
  if (call == "POST file_report")
    return ticket_for(folder_.page(json::parse(request.body).at("path").get<std::string>()));
  if (call == "POST compare") {
    const json given = json::parse(request.body);
    using Texts = std::vector<std::string>;
    return report(given.at("ids").get<Texts>(), given.value("names", Texts{}));
  }
  if (path.starts_with("/api/runs/")) return of_run(request);
  return unknown(path);
}

Reply Api::start_cad(const Request& request) {
  const json given = json::parse(request.body);
  CadRequest wanted;
  wanted.path = given.at("path").get<std::string>();
  wanted.size = given.at("size").get<std::string>();
  wanted.output = given.value("output", "");
  wanted.order = whole_number(given, "order", wanted.order);
  wanted.around = whole_number(given, "around", wanted.around);
  wanted.length_unit = given.value("length_unit", "");
  return json_reply({{"id", cad_.start(wanted)}});
}

/// /api/cad/ID and /api/cad/ID/stop
Reply Api::of_cad(const Request& request) {
  const std::string rest = request.path.substr(std::string_view("/api/cad/").size());
  const std::size_t slash = rest.find('/');
  const std::string id = rest.substr(0, slash);
  if (request.method == "POST" && slash != std::string::npos && rest.substr(slash) == "/stop") {
    cad_.stop(id);
    return json_reply({{"id", id}});
  }
  if (request.method != "GET" || slash != std::string::npos) return unknown(request.path);
  const CadState state = cad_.state(id);
  using At = CadState::At;
  return json_reply({{"state", state.at == At::running ? "running"
                               : state.at == At::made  ? "made"
                                                       : "failed"},
                     {"seconds", state.seconds},
                     {"output", state.output},
                     {"message", state.message}});
}

Reply Api::run_list() const {
  json list = json::array();
  for (const RunEntry& run : runs_.list()) list.push_back(json_of(run));
  return json_reply({{"runs", std::move(list)}});
}

/// /api/runs/ID/WHAT
Reply Api::of_run(const Request& request) {
  const std::string rest = request.path.substr(std::string_view("/api/runs/").size());
  const std::size_t slash = rest.rfind('/');
  if (slash == std::string::npos) return unknown(request.path);
  const std::string id = rest.substr(0, slash), call = request.method + rest.substr(slash);
  constexpr std::size_t kMostSteps = 4000;  // more than a screen has columns
  if (call == "GET/log") return {.type = "text/plain; charset=utf-8", .body = runs_.log(id)};
  if (const std::string part = request.value("run"); call == "GET/events" && !part.empty())
    return {.type = "application/x-ndjson", .body = runs_.history_in_study(id, part, kMostSteps)};
  if (call == "GET/events") return {.type = "application/x-ndjson", .body = runs_.history(id, kMostSteps)};
  if (call == "GET/study") return {.body = studies_.course(id, request.value("after"))};
  if (call == "GET/film")
    return {.body = latest_film(runs_.program(), folder_.path(), runs_.find(id), request.value("bearing"))};
  if (call == "GET/model") return {.type = "text/plain; charset=utf-8", .body = runs_.model_text(id)};
  if (call == "POST/report") return report({id});
  if (call == "POST/stop") return runs_.stop(id), json_reply({{"id", id}});
  if (call == "POST/remove") return runs_.remove(id), json_reply({{"id", id}});
  if (call == "POST/resume") return runs_.resume(id), json_reply({{"id", id}});
  return unknown(request.path);
}

Reply Api::report(const std::vector<std::string>& ids, const std::vector<std::string>& names) {
  if (ids.empty()) throw Refused(400, "no run is named", "choose one of the list");
  return ticket_for(runs_.report(ids, names));
}

Reply Api::ticket_for(const std::filesystem::path& page) {
  const std::string ticket = random_token();
  const std::lock_guard lock(tickets_mutex_);
  constexpr std::size_t kMostTickets = 200;
  tickets_.emplace_back(ticket, page);
  if (tickets_.size() > kMostTickets) {
    runs_.forget_report(tickets_.front().second);
    tickets_.pop_front();
  }
  return json_reply({{"url", "/report/" + ticket + "/"}});
}

/// /report/TICKET/ is a report, /report/TICKET/FOLDER/NAME.js a file beside it, of the fields that it loads when asked.
Reply Api::report_file(const Request& request) {
  const std::string rest = request.path.substr(std::string_view("/report/").size());
  const std::size_t slash = rest.find('/');
  const std::string ticket = rest.substr(0, slash), name = slash == std::string::npos ? "" : rest.substr(slash + 1);
  std::filesystem::path page;
  {
    const std::lock_guard lock(tickets_mutex_);
    for (const auto& [known, file] : tickets_)
      if (is_same_secret(ticket, known)) page = file;
  }
  if (page.empty() || request.method != "GET")
    return {.status = 404, .body = error_json("this report is no longer known", "open it again from the list of runs")};
  const std::string host = request.header("host");
  const std::string policy = fmt::format(
      "sandbox allow-scripts allow-downloads; default-src 'none'; script-src 'unsafe-inline' http://{}/report/{}/; "
      "style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'self'",
      host, ticket);
  if (slash == std::string::npos) return {.status = 308, .headers = {{"Location", "/report/" + ticket + "/"}}};
  const std::filesystem::path beside = page.stem().string() + "_fields";
  const std::filesystem::path asked(name);
  if (!name.empty() && (asked.parent_path() != beside || asked.extension() != ".js" || asked.filename() == ".."))
    return unknown("this file");
  // Links may lead out of the folder, also those that have been made since the report was asked for.
  const std::filesystem::path file = name.empty() ? page : page.parent_path() / asked;
  std::error_code error;
  for (const auto& part : {file, page.parent_path() / beside})
    if (std::filesystem::is_symlink(part, error)) return unknown("this file");
  std::optional<std::string> text = content_of(file);
  if (!text) return {.status = 404, .body = error_json("the report is gone", "open it again from the list of runs")};
  return {.type = name.empty() ? "text/html; charset=utf-8" : "text/javascript; charset=utf-8",
          .body = std::move(*text),
          .headers = {{"Content-Security-Policy", policy}}};
}

Reply Api::hello() const {
  return json_reply({{"version", version()},
                     {"folder", folder_.path().string()},
                     {"open", open_.empty() ? json(nullptr) : json(open_)},
                     {"event", events_.last()},
                     {"processors", std::max(1U, std::thread::hardware_concurrency())},
                     {"cluster", Studies::has_cluster()}});
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
    throw Refused(428, "the request does not say which text it replaces", "send If-Match, or If-None-Match: *");
  return {.status = 204, .headers = {{"ETag", etag}}};
}

Reply Api::event_stream(const Request& request) {
  const std::string after = request.value("after");
  std::uint64_t number = events_.last();
  if (!after.empty()) {
    const auto [end, error] = std::from_chars(after.data(), after.data() + after.size(), number);
    if (error != std::errc{} || end != after.data() + after.size())
      throw Refused(400, "after is no number", "reload the page");
  }
  // Streams stay open: they must not take all the connections there are.
  constexpr int kMostStreams = 32;
  struct Progress {
    explicit Progress(std::uint64_t first, std::atomic<int>& open) : number(first), streams(open) { ++streams; }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress() { --streams; }
    std::uint64_t number;
    std::chrono::steady_clock::time_point said = {};
    std::atomic<int>& streams;
  };
  const auto progress = std::make_shared<Progress>(number, streams_);
  if (streams_ > kMostStreams) throw Refused(503, "too many pages follow this folder", "close some of them");
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
