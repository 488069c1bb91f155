// Decides what the text of a flat state machine says: names of states, and which condition leads from one to another.
// Does not decide when conditions are looked at, nor what a state gives.
//   states        "search, leave, home"                             the first is the one that it begins in
//   transitions   "search -> leave: at_stop; leave -> home: x > 2*d and time > t0"; "*" stands for every state
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "models/math/expression_tree.h"

namespace hysteron::state_machine {

using expression::Wrong;

struct Transition {
  int from = -1, to = 0;  ///< places in the list of states; from -1: every other state
  expression::Tree condition;
};

/// Where a name stands, its first character counted from 0.
struct Word {
  std::string text;
  std::size_t at = 0;
};

/// The piece [begin, end) without blanks around it.
inline Word trimmed(const std::string& text, std::size_t begin, std::size_t end) {
  const auto blank = [&](std::size_t i) { return text[i] == ' ' || text[i] == '\n' || text[i] == '\t'; };
  while (begin < end && blank(begin)) ++begin;
  while (end > begin && blank(end - 1)) --end;
  return {text.substr(begin, end - begin), begin};
}

inline bool is_name(const std::string& word) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !word.empty() && letter(word.front()) &&
         std::all_of(word.begin(), word.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

/// "a, b, c"; none of an empty text. Throws Wrong for what is no name, or stands twice.
inline std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names;
  if (trimmed(text, 0, text.size()).text.empty()) return names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const Word word = trimmed(text, begin, end);
    const int place = static_cast<int>(word.at) + 1;
    if (!is_name(word.text)) throw Wrong("\"" + word.text + "\" is no name", place, "write names with commas between");
    if (std::find(names.begin(), names.end(), word.text) != names.end())
      throw Wrong("\"" + word.text + "\" stands twice", place, "give each a name of its own");
    names.push_back(word.text);
    begin = end + 1;
  }
  return names;
}

inline int state_at(const std::vector<std::string>& states, const Word& word, bool any) {
  if (any && word.text == "*") return -1;
  const auto found = std::find(states.begin(), states.end(), word.text);
  if (found == states.end()) {
    std::string known;
    for (const auto& s : states) known += (known.empty() ? "" : ", ") + s;
    throw Wrong("there is no state \"" + word.text + "\"", static_cast<int>(word.at) + 1, "states are " + known);
  }
  return static_cast<int>(found - states.begin());
}

/// One transition, which stands at [begin, end) of the text; characters are counted in the whole text.
inline Transition transition_in(const std::string& text, std::size_t begin, std::size_t end,
                                const std::vector<std::string>& states) {
  const std::string form = "write \"from -> to: condition\"";
  const std::size_t arrow = text.find("->", begin), colon = text.find(':', begin);
  const int place = static_cast<int>(trimmed(text, begin, end).at) + 1;
  if (arrow >= end) throw Wrong("a transition has no arrow", place, form);
  if (colon >= end || colon < arrow) throw Wrong("a transition has no condition", place, form);
  Transition t;
  t.from = state_at(states, trimmed(text, begin, arrow), true);
  t.to = state_at(states, trimmed(text, arrow + 2, colon), false);
  if (t.from == t.to) throw Wrong("a transition leads nowhere", place, "leave it out, or name another state");
  t.condition = expression::parse_condition(std::string(colon + 1, ' ') + text.substr(colon + 1, end - colon - 1));
  return t;
}

/// Throws Wrong.
inline std::vector<Transition> transitions_in(const std::string& text, const std::vector<std::string>& states) {
  std::vector<Transition> all;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    if (!trimmed(text, begin, end).text.empty()) all.push_back(transition_in(text, begin, end, states));
    begin = end + 1;
  }
  return all;
}

}  // namespace hysteron::state_machine
