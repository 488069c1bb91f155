// Decides who may ask: pages of this server alone, with the token that was handed over when it was started. Another
// page in the same browser, a name that was bound to 127.0.0.1, and another user of the machine are refused.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "studio/http_message.h"

namespace hysteron::studio {

struct Guard {
  int port = 0;
  std::string token;
};

/// 128 random bits of the system, in 32 hexadecimal digits. Throws Error "no_random_numbers".
std::string new_token();

/// Equal, in a time that does not tell where they differ.
bool same_secret(std::string_view a, std::string_view b);

/// What is answered to a request that may not be made; nothing where it may. `needs_token`: everything but the page
/// itself, in which nothing of the user's stands.
std::optional<HttpReply> refused(const HttpRequest& request, const Guard& guard, bool needs_token);

/// The headers that every answer has: what the page may load, and that nobody may frame it.
void add_safety_headers(HttpReply& reply);

}  // namespace hysteron::studio
