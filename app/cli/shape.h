// Decides how a verb declares what its answer holds for programs: pieces of a JSON Schema, as plain values.
// Does not make the schema file (answer_json.h); keeps the costly JSON header out of the verbs.
#pragma once

#include <string>
#include <vector>

#include "report/pages/facts.h"

namespace hysteron::shape {

/// One member of an object; `sometimes`: it may be missing.
struct Member {
  std::string name;
  Facts value;
  bool sometimes = false;
};
inline constexpr bool sometimes = true;

Facts text(const std::string& meaning);
Facts whole(const std::string& meaning);
Facts number(const std::string& meaning);  ///< or null, where there is none
Facts flag(const std::string& meaning);
Facts choice(const std::string& meaning, const std::vector<std::string>& values);
Facts list(const std::string& meaning, Facts item);
Facts texts(const std::string& meaning);
/// Exactly these members.
Facts object(const std::string& meaning, const std::vector<Member>& members);
/// Any names, each with such a member.
Facts named(const std::string& meaning, Facts member);
/// An object of which the schema says no more: result.json of the same verb has it too.
Facts open_object(const std::string& meaning);

/// The members of an answer with a folder of results, and behind them its own.
std::vector<Member> published(std::vector<Member> own, bool may_be_missing = false);

}  // namespace hysteron::shape
