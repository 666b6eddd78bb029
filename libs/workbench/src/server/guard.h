#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "server/exchange.h"

namespace hersey::workbench {

/// Why a request is refused, and what to do instead.
struct Refusal {
  int status = 400;
  std::string error, advice;
};

/// Largest body of a request [bytes].
constexpr std::size_t kMostBody = std::size_t{16} << 20;

/// 128 bits from the system's source of random numbers, as 32 hexadecimal digits.
/// @throws std::system_error if it gives none
[[nodiscard]] std::string random_token();

/// True if the texts are equal. The time does not depend on where they differ.
[[nodiscard]] bool is_same_secret(const std::string& given, const std::string& secret);

/// Decides about a request by its head alone, before any of its body is read: who asks, from which page, how much.
/// @param token  that interface requests, those below /api/, must carry
[[nodiscard]] std::optional<Refusal> refusal(const Request& head, const std::string& token);

/// {"error", "advice"} as JSON, whatever bytes the texts contain.
[[nodiscard]] std::string error_json(const std::string& error, const std::string& advice);

}  // namespace hersey::workbench
