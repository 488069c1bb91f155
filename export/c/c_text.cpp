#include "export/c/c_text.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <regex>

namespace hysteron::c_text {
namespace {

const std::set<std::string>& words_of_c() {
  static const std::set<std::string> words{
      "auto", "break", "case", "char", "const", "continue", "default", "do", "double", "else", "enum", "extern",
      "float", "for", "goto", "if", "inline", "int", "long", "register", "restrict", "return", "short", "signed",
      "sizeof", "static", "struct", "switch", "typedef", "union", "unsigned", "void", "volatile", "while", "_Bool",
      "main", "NAN", "INFINITY", "asm", "bool", "class", "new", "this", "template", "private", "public", "true",
      "false",
      // of math.h
      "acos", "asin", "atan", "atan2", "cos", "sin", "tan", "cosh", "sinh", "tanh", "exp", "log", "log10", "pow",
      "sqrt", "ceil", "fabs", "floor", "fmod", "round", "gamma", "signbit", "isfinite", "isnan", "hypot", "cbrt", "erf",
      "j0", "j1", "jn", "y0", "y1", "yn", "fmax", "fmin", "fma", "trunc", "rint", "remainder", "scalb",
      // of the code itself
      "s", "in", "out", "i", "j", "k"};
  return words;
}

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

}  // namespace

std::string literal(Real real, double value) {
  const std::string sign = std::signbit(value) ? "-" : "";
  if (std::isnan(value)) return "NAN";
  if (std::isinf(value)) return sign + "INFINITY";
  std::string text = real == Real::float64 ? fmt::format("{}", value) : fmt::format("{}", static_cast<float>(value));
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return real == Real::float64 ? text : text + "f";
}

std::string identifier(const std::string& text) {
  std::string name;
  for (const char c : text) name += is_word(c) ? c : '_';
  while (name.ends_with('_')) name.pop_back();
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) name = "n" + name;
  return name;
}

std::string Names::take(const std::string& wish) {
  std::string name = identifier(wish);
  if (words_of_c().contains(name)) name += "_signal";
  for (int number = 2; !taken_.insert(name).second; ++number) name = fmt::format("{}_{}", identifier(wish), number);
  return name;
}

std::string filled(const std::string& text,
                   const std::function<std::string(const std::string&, const std::string&)>& meaning) {
  std::string made;
  for (std::size_t at = 0; at < text.size();) {
    const bool begins =
        text[at] == '$' && at + 1 < text.size() && std::isalpha(static_cast<unsigned char>(text[at + 1]));
    if (!begins) {
      made += text[at++];
      continue;
    }
    std::size_t end = at + 1;
    while (end < text.size() && is_word(text[end])) ++end;
    const std::string kind = text.substr(at + 1, end - at - 1);
    std::string name;
    if (end + 1 < text.size() && text[end] == '.' && is_word(text[end + 1])) {
      const std::size_t from = ++end;
      while (end < text.size() && is_word(text[end])) ++end;
      name = text.substr(from, end - from);
    }
    made += meaning(kind, name);
    at = end;
  }
  return made;
}

std::string in_numbers(Real real, const std::string& text) {
  static const std::regex either(R"(\$\{([^|}]*)\|([^}]*)\})");
  std::string chosen = std::regex_replace(text, either, real == Real::float64 ? "$1" : "$2");
  if (real == Real::float64) return chosen;
  static const std::regex functions(
      R"(\b(acos|asin|atan|atan2|cos|sin|tan|cosh|sinh|tanh|exp|log|log10|pow|sqrt|ceil|fabs|floor|fmod|round|hypot|cbrt)\()");
  static const std::regex literals(R"((^|[^\w.])(\d+\.\d*(?:[eE][+-]?\d+)?)(?![\w.]))");
  static const std::regex type(R"(\bdouble\b)");
  std::string made;
  for (std::size_t at = 0; at < chosen.size();) {  // comments stay as they are
    const std::size_t comment = std::min(chosen.find("/*", at), chosen.size());
    std::string code = chosen.substr(at, comment - at);
    code = std::regex_replace(code, functions, "$1f(");
    code = std::regex_replace(code, literals, "$1$2f");
    made += std::regex_replace(code, type, "float");
    const std::size_t end = std::min(chosen.find("*/", comment), chosen.size());
    made += chosen.substr(comment, end - comment);
    at = end;
  }
  return made;
}

std::string indented(const std::string& text, int spaces) {
  std::string made;
  bool begins = true;
  for (const char c : text) {
    if (begins && c != '\n') made.append(static_cast<std::size_t>(spaces), ' ');
    made += c;
    begins = c == '\n';
  }
  return made;
}

std::string in_comment(std::string text) {
  for (std::size_t at = 0; (at = text.find("*/", at)) != std::string::npos;) text.replace(at, 2, "* /");
  for (std::size_t at = 0; (at = text.find("/*", at)) != std::string::npos;) text.replace(at, 2, "/ *");
  return text;
}

std::string wrapped(const std::string& text, const std::string& begin) {
  constexpr std::size_t longest = 100;
  std::string made, line;
  for (std::size_t at = 0; at < text.size();) {
    const auto end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    if (!line.empty() && line.size() + 1 + word.size() > longest) {
      made += line + "\n";
      line = begin + word;
    } else {
      line += (line.empty() ? "" : " ") + word;
    }
    at = end + 1;
  }
  return made + line;
}

}  // namespace hysteron::c_text
