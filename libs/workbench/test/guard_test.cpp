#include "server/guard.h"

#include <doctest/doctest.h>

#include <set>
#include <string>

namespace hersey::workbench {
namespace {

const std::string& secret() {
  static const std::string token = random_token();
  return token;
}

Request good_request() {
  Request request;
  request.method = "GET";
  request.path = "/api/hello";
  request.headers = {{"host", "127.0.0.1:8437"}, {"authorization", "Bearer " + secret()}};
  return request;
}

int status_of_head(const Request& request) {
  const std::optional<Refusal> refused = refusal(request, secret());
  return refused ? refused->status : 200;
}

TEST_CASE("Token_IsNewEachTime") {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(random_token());
  CHECK(tokens.size() == 100);
  for (const std::string& token : tokens) {
    CHECK(token.size() == 32);
    CHECK(token.find_first_not_of("0123456789abcdef") == std::string::npos);
  }
}

TEST_CASE("Secret_IsKnownWholeOrNotAtAll") {
  CHECK(is_same_secret(secret(), secret()));
  CHECK_FALSE(is_same_secret("", secret()));
  CHECK_FALSE(is_same_secret(secret() + "0", secret()));
  CHECK_FALSE(is_same_secret(secret() + std::string(1, '\0'), secret()));
  for (std::size_t i = 0; i < secret().size(); ++i) {
    std::string other = secret();
    other[i] = other[i] == '0' ? '1' : '0';
    CHECK_FALSE(is_same_secret(other, secret()));
    CHECK_FALSE(is_same_secret(secret().substr(0, i), secret()));
  }
}

TEST_CASE("Request_IsGoodUntilOneThingIsWrong") {
  CHECK(status_of_head(good_request()) == 200);
  const auto with = [](const std::string& name, const std::string& value) {
    Request request = good_request();
    request.headers.erase(name);
    request.headers.emplace(name, value);
    return status_of_head(request);
  };
  CHECK(with("host", "localhost:1") == 200);
  CHECK(with("host", "127.0.0.1") == 403);
  CHECK(with("host", "a.example:8437") == 403);
  CHECK(with("origin", "http://127.0.0.1:8437") == 200);
  CHECK(with("origin", "http://localhost:8437") == 403);
  CHECK(with("sec-fetch-site", "same-origin") == 200);
  CHECK(with("sec-fetch-site", "none") == 200);
  CHECK(with("sec-fetch-site", "cross-site") == 403);
  CHECK(with("authorization", "Bearer") == 401);
  CHECK(with("content-length", "1") == 400);
  CHECK(with("transfer-encoding", "chunked") == 411);
  Request twice = good_request();
  twice.headers.emplace("authorization", "Bearer " + secret());
  CHECK(status_of_head(twice) == 401);
}

TEST_CASE("Page_NeedsNoTokenAndReportsNoOrigin") {
  Request page = good_request();
  page.headers.erase("authorization");
  CHECK(status_of_head(page) == 401);
  page.path = "/";
  CHECK(status_of_head(page) == 200);
  page.headers.emplace("sec-fetch-site", "cross-site");
  CHECK(status_of_head(page) == 403);
  page.path = "/report/x/";
  CHECK(status_of_head(page) == 200);
}

TEST_CASE("Body_HasALengthWithinTheLimit") {
  Request put = good_request();
  put.method = "PUT";
  CHECK(status_of_head(put) == 411);
  const auto with_length = [&](const std::string& length) {
    put.headers.erase("content-length");
    put.headers.emplace("content-length", length);
    return status_of_head(put);
  };
  CHECK(with_length("0") == 200);
  CHECK(with_length(std::to_string(kMostBody)) == 200);
  CHECK(with_length(std::to_string(kMostBody + 1)) == 413);
  for (const char* wrong : {"-1", "1 ", "", "0x1", "1e3", "99999999999999999999"})
    CHECK_MESSAGE(with_length(wrong) == 411, wrong);
}

TEST_CASE("Errors_AreJsonWhateverTheyQuote") {
  CHECK(error_json("<\"\xff>", "") == "{\"advice\":\"\",\"error\":\"<\\\"\xef\xbf\xbd>\"}");
}

}  // namespace
}  // namespace hersey::workbench
