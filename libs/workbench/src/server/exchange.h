#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hersey::workbench {

/// A request as the routes read it; names of headers in small letters.
struct Request {
  std::string method, path;  ///< path decoded, without the query
  std::map<std::string, std::string> query;
  std::multimap<std::string, std::string> headers;
  std::string body;

  /// Value of a header that occurs once; empty if it is missing or occurs several times.
  [[nodiscard]] std::string header(const std::string& name) const {
    return headers.count(name) == 1 ? headers.find(name)->second : "";
  }
  [[nodiscard]] std::string value(const std::string& name) const {
    const auto found = query.find(name);
    return found == query.end() ? "" : found->second;
  }
};

/// Writes a part of a stream; an empty one only asks. @returns false if nobody reads it any more
using StreamWriter = std::function<bool(std::string_view)>;

struct Reply {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers = {};  ///< replace those that every reply has
  /// Called in place of a body until it returns false; blocks for at most some tenths of a second.
  std::function<bool(const StreamWriter&)> stream = {};
};

using Handler = std::function<Reply(const Request&)>;

}  // namespace hersey::workbench
