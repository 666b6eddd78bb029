#include "server/guard.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

namespace hersey::workbench {
namespace {

/// True for "127.0.0.1:8437" and "localhost:8437" with any port, because a tunnel may change it. A page of another name
/// that resolves to this machine (DNS rebinding) sends its own name.
bool is_own_host(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  if (colon == std::string_view::npos) return false;
  const std::string_view name = host.substr(0, colon), port = host.substr(colon + 1);
  const bool is_number = !port.empty() && port.size() <= 5 &&
                         std::all_of(port.begin(), port.end(), [](char c) { return c >= '0' && c <= '9'; });
  return is_number && (name == "127.0.0.1" || name == "localhost");
}

/// Length that the head declares; none if it is no number.
std::optional<std::size_t> declared_length(const Request& head) {
  const std::string text = head.header("content-length");
  std::size_t length = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return length;
}

std::optional<Refusal> refused_body(const Request& head) {
  if (head.headers.count("transfer-encoding") > 0)
    return Refusal{411, "the request does not say how long it is", "send it with Content-Length"};
  if (head.headers.count("content-encoding") > 0) return Refusal{415, "the request is compressed", "send it as it is"};
  const bool has_body = head.method == "PUT" || head.method == "POST";
  if (!has_body && head.headers.count("content-length") == 0) return std::nullopt;
  const std::optional<std::size_t> length = declared_length(head);
  if (!length) return Refusal{411, "the request does not say how long it is", "send it with Content-Length"};
  if (!has_body && *length > 0) return Refusal{400, "a request of this method has no body", "send none"};
  if (*length > kMostBody)
    return Refusal{413, fmt::format("{} bytes are more than the workbench takes, {} MB", *length, kMostBody >> 20),
                   "edit large files by another program"};
  return std::nullopt;
}

std::optional<Refusal> refused_origin(const Request& head, bool is_report) {
  const std::string advice = "open the address that `hersey open` printed";
  const std::string host = head.header("host");
  if (!is_own_host(host)) return Refusal{403, "the workbench answers as 127.0.0.1 and localhost only", advice};
  // A report is shown in a sandbox of no origin, which asks for the files beside it as a stranger would: its address is
  // its secret.
  if (is_report) return std::nullopt;
  const bool has_origin = head.headers.count("origin") > 0;
  if (has_origin && head.header("origin") != "http://" + host)
    return Refusal{403, "the request comes from a page of another origin", advice};
  const std::string site = head.header("sec-fetch-site");
  if (site == "cross-site" || site == "same-site")
    return Refusal{403, "the request comes from a page of another site", advice};
  return std::nullopt;
}

}  // namespace

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = ::getrandom(bytes.data() + done, bytes.size() - done, 0);
    if (got < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category(), "random numbers");
    if (got > 0) done += static_cast<std::size_t>(got);
  }
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

bool is_same_secret(const std::string& given, const std::string& secret) {
  unsigned difference = given.size() == secret.size() ? 0U : 1U;
  for (std::size_t i = 0; i < secret.size(); ++i) {
    const char other = i < given.size() ? given[i] : '\0';
    difference |= static_cast<unsigned char>(secret[i]) ^ static_cast<unsigned char>(other);
  }
  return difference == 0;
}

std::optional<Refusal> refusal(const Request& head, const std::string& token) {
  const bool is_report = head.path.starts_with("/report/");
  if (std::optional<Refusal> refused = refused_origin(head, is_report)) return refused;
  if (head.method != "GET" && head.method != "PUT" && head.method != "POST")
    return Refusal{405, "the workbench knows GET, PUT and POST", "use one of these"};
  if (head.path.starts_with("/api/") && !is_same_secret(head.header("authorization"), "Bearer " + token))
    return Refusal{401, "the request lacks this workbench's token",
                   "open the address that `hersey open` printed: each start has a token of its own"};
  return refused_body(head);
}

std::string error_json(const std::string& error, const std::string& advice) {
  const nlohmann::json document{{"error", error}, {"advice", advice}};
  return document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace hersey::workbench
