// Who may ask, and what the page may see of the machine.
#include "studio/guard.h"

#include <gtest/gtest.h>

#include <set>

namespace hysteron::studio {
namespace {

const Guard guard{8123, "0123456789abcdef0123456789abcdef"};

HttpRequest request() {
  HttpRequest r{"GET", "/api/files"};
  r.host = "127.0.0.1:8123";
  r.authorization = "Bearer " + guard.token;
  return r;
}

int status_of(const HttpRequest& r, bool needs_token = true) {
  const auto reply = refused(r, guard, needs_token);
  return reply ? reply->status : 200;
}

TEST(StudioGuard, LetsItsOwnPageAsk) {
  HttpRequest r = request();
  EXPECT_EQ(status_of(r), 200);
  r.origin = "http://127.0.0.1:8123";
  EXPECT_EQ(status_of(r), 200);
  r.host = "localhost:8123";
  EXPECT_EQ(status_of(r), 200);
}

TEST(StudioGuard, RefusesEverybodyElse) {
  for (const char* host : {"", "127.0.0.1", "127.0.0.1:81", "evil.example:8123", "127.0.0.1:8123.evil.example"}) {
    HttpRequest r = request();
    r.host = host;
    EXPECT_EQ(status_of(r), 403) << host;
    EXPECT_EQ(status_of(r, false), 403) << "the page itself, too: " << host;
  }
  for (const char* origin : {"null", "http://evil.example", "https://127.0.0.1:8123", "http://127.0.0.1:8124"}) {
    HttpRequest r = request();
    r.origin = origin;
    EXPECT_EQ(status_of(r), 403) << origin;
  }
  for (const char* word : {"", "Bearer", "Bearer ", "Bearer 0123456789abcdef0123456789abcdeF",
                           "0123456789abcdef0123456789abcdef", "Bearer 0123456789abcdef0123456789abcdef0"}) {
    HttpRequest r = request();
    r.authorization = word;
    EXPECT_EQ(status_of(r), 401) << word;
  }
}

TEST(StudioGuard, TokensAreLongAndNeverTheSame) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(new_token());
  EXPECT_EQ(tokens.size(), 100U);
  for (const auto& token : tokens) EXPECT_EQ(token.size(), 32U);
}

TEST(StudioGuard, AnswersCarryThePolicyOfThePage) {
  HttpReply reply;
  add_safety_headers(reply);
  std::string policy;
  for (const auto& [name, value] : reply.headers)
    if (name == "Content-Security-Policy") policy = value;
  EXPECT_NE(policy.find("default-src 'self'"), std::string::npos);
  EXPECT_NE(policy.find("frame-ancestors 'none'"), std::string::npos);
}

}  // namespace
}  // namespace hysteron::studio
