// Plain text is read by precedence: relations and commas, sums, products (also those without a sign between the
// factors), quotients, powers and subscripts. A quotient is a fraction of the two factors beside its stroke.
#include "studio/mathml.h"

#include <array>
#include <cctype>
#include <map>
#include <vector>

namespace hysteron::studio {
namespace {

struct Token {
  enum Kind { number, name, word, sign, end } kind = end;
  std::string text{};
  bool is_apart = false;  ///< a blank stands before it
};

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || static_cast<unsigned char>(c) >= 0x80;
}
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return safe;
}

std::string tagged(const char* tag, const std::string& content) {
  return std::string("<") + tag + ">" + content + "</" + tag + ">";
}

const std::set<std::string> functions{"sin",   "cos",  "tan", "asin", "acos", "atan", "atan2", "exp",   "log", "ln",
                                      "log10", "sqrt", "max", "min",  "abs",  "sign", "round", "floor", "mod"};
const std::map<std::string, std::string> greek{{"pi", "π"},       {"alpha", "α"}, {"beta", "β"},  {"gamma", "γ"},
                                               {"delta", "δ"},    {"omega", "ω"}, {"theta", "θ"}, {"tau", "τ"},
                                               {"lambda", "λ"},   {"mu", "μ"},    {"sigma", "σ"}, {"phi", "φ"},
                                               {"infinity", "∞"}, {"rho", "ρ"},   {"zeta", "ζ"},  {"eta", "η"}};
const std::array<std::pair<const char*, const char*>, 8> signs{
    {{"...", "…"}, {"+-", "±"}, {"<=", "≤"}, {">=", "≥"}, {"!=", "≠"}, {"->", "→"}, {"-", "−"}, {"*", "·"}}};

/// One letter with or without what follows an underscore, "dx", "dT": a symbol; longer ones are words of the language.
bool is_symbol(const std::string& name) {
  const std::string base = name.substr(0, name.find('_'));
  return base.size() == 1 || (base.size() == 2 && (base[0] == 'd' || is_digit(base[1])));
}

std::vector<Token> tokens_of(const std::string& text, const std::set<std::string>& names) {
  std::vector<Token> tokens;
  for (std::size_t at = 0; at < text.size();) {
    const bool is_apart = at > 0 && text[at - 1] == ' ';
    std::size_t end = at;
    const auto add = [&](Token::Kind kind, std::string shown) {
      tokens.push_back({kind, std::move(shown), is_apart});
      at = end;
    };
    if (text[at] == ' ') {
      ++at;
    } else if (is_digit(text[at])) {
      while (end < text.size() &&
             (is_digit(text[end]) || (text[end] == '.' && end + 1 < text.size() && is_digit(text[end + 1]))))
        ++end;
      add(Token::number, text.substr(at, end - at));
    } else if (is_letter(text[at])) {
      while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]) || text[end] == '\'' ||
                                   (text[end] == '_' && end + 1 < text.size() && text[end + 1] != '(')))
        ++end;
      const std::string name = text.substr(at, end - at);
      const bool known = names.contains(name) || functions.contains(name) || greek.contains(name) || is_symbol(name) ||
                         name.starts_with("sum") || (end < text.size() && (text[end] == '_' || text[end] == '['));
      add(known ? Token::name : Token::word, name);
    } else {
      end = at + 1;
      std::string shown(1, text[at]);
      for (const auto& [written, sign] : signs)
        if (text.compare(at, std::string(written).size(), written) == 0) {
          shown = sign;
          end = at + std::string(written).size();
          break;
        }
      add(Token::sign, shown);
    }
  }
  tokens.push_back({});
  return tokens;
}

class Setter {
 public:
  Setter(std::vector<Token> tokens, const std::set<std::string>& names) : tokens_(std::move(tokens)), names_(names) {}

  std::string all() {
    std::string set;
    while (now().kind != Token::end) set += now().kind == Token::sign ? sign_or_product() : product();
    return set;
  }

 private:
  const Token& now() const { return tokens_[at_]; }
  bool is(const char* text) const { return now().kind == Token::sign && now().text == text; }

  static std::string op(const std::string& text) { return tagged("mo", escaped(text)); }

  bool begins_factor() const { return now().kind == Token::number || now().kind == Token::name || is("("); }

  /// Signs of all kinds as they come; brackets and bars begin a factor.
  std::string sign_or_product() {
    if (is("(") || is("|")) return product();
    const std::string text = now().text;
    ++at_;
    if (text == "," || text == ";" || text == ":")
      return "<mo separator=\"true\">" + text + "</mo><mspace width=\"0.6em\"/>";
    return op(text);
  }

  /// Factors beside each other, fractions among them.
  std::string product() {
    if (now().kind == Token::word) return words();
    std::string row = quotient();
    while (begins_factor()) row += "<mspace width=\"0.2em\"/>" + quotient();
    return row;
  }

  std::string words() {
    std::string text;
    for (; now().kind == Token::word; ++at_) text += " " + escaped(now().text);
    return "<mtext>" + text.substr(1) + "</mtext><mspace width=\"0.3em\"/>";
  }

  std::string quotient() {
    Part above = power();
    while (is("/")) {
      ++at_;
      const Part below = power();
      above = {"<mfrac><mrow>" + above.bare + "</mrow><mrow>" + below.bare + "</mrow></mfrac>", ""};
      above.bare = above.whole;
    }
    return above.whole;
  }

  /// A factor, and the same without the brackets that a fraction makes needless.
  struct Part {
    std::string whole, bare;
  };

  Part power() {
    Part part = atom();
    for (;;) {
      if (is("^")) {
        ++at_;
        const std::string minus = is("−") ? (++at_, op("−")) : "";
        part.whole = "<msup><mrow>" + part.whole + "</mrow><mrow>" + minus + atom().bare + "</mrow></msup>";
      } else if (is("_")) {
        ++at_;
        part.whole = "<msub><mrow>" + part.whole + "</mrow><mrow>" + atom().bare + "</mrow></msub>";
      } else if (is("[") && !now().is_apart) {
        ++at_;
        part.whole = "<msub><mrow>" + part.whole + "</mrow><mrow>" + until("]") + "</mrow></msub>";
      } else if (is("(") && !now().is_apart && is_callable_) {
        ++at_;
        part.whole += "<mo stretchy=\"false\">(</mo>" + until(")") + "<mo stretchy=\"false\">)</mo>";
      } else {
        break;
      }
      part.bare = part.whole;
    }
    is_callable_ = false;
    return part;
  }

  Part atom() {
    is_callable_ = false;
    if (is("(") || is("|")) {
      const std::string open = now().text, close = open == "(" ? ")" : "|";
      ++at_;
      const std::string inside = until(close.c_str());
      return {"<mrow>" + op(open) + inside + op(close) + "</mrow>",
              open == "(" ? inside : op(open) + inside + op(close)};
    }
    if (now().kind == Token::end || now().kind == Token::sign) return {"<mrow/>", "<mrow/>"};
    const Token token = now();
    ++at_;
    const std::string set = token.kind == Token::number ? tagged("mn", token.text) : name(token.text);
    is_callable_ = token.kind == Token::name;
    return {set, set};
  }

  /// Everything up to a closing bracket, which is taken along; a text that closes none ends it.
  std::string until(const char* close) {
    std::string set;
    while (now().kind != Token::end && !is(close)) {
      const bool is_bar = is("|") && std::string(close) == "|";
      if (is_bar) break;
      set += now().kind == Token::sign ? sign_or_product() : product();
    }
    if (is(close)) ++at_;
    return set;
  }

  std::string name(const std::string& text) const {
    if (const auto letter = greek.find(text); letter != greek.end()) return tagged("mi", letter->second);
    if (text == "sum") return op("∑");
    if (text.starts_with("sum_")) return "<msub>" + op("∑") + tagged("mi", escaped(text.substr(4))) + "</msub>";
    const auto line = text.find('_');
    if (names_.contains(text) || line == std::string::npos || line + 1 >= text.size()) {
      if (text.size() == 2 && text[0] == 'd' && !names_.contains(text))
        return "<mrow><mi mathvariant=\"normal\">d</mi>" + tagged("mi", escaped(text.substr(1))) + "</mrow>";
      return tagged("mi", escaped(text));  // several letters are set upright, as words
    }
    return "<msub>" + name(text.substr(0, line)) +
           tagged(is_digit(text[line + 1]) ? "mn" : "mi", escaped(text.substr(line + 1))) + "</msub>";
  }

  std::vector<Token> tokens_;
  const std::set<std::string>& names_;
  std::size_t at_ = 0;
  bool is_callable_ = false;
};

/// The clauses of a law: apart at semicolons, and at commas behind which another equation begins; not within brackets.
std::vector<std::string> clauses_of(const std::string& law) {
  std::vector<std::string> clauses{""};
  int depth = 0;
  for (std::size_t i = 0; i < law.size(); ++i) {
    const char c = law[i];
    if (c == '(' || c == '[') ++depth;
    if (c == ')' || c == ']') --depth;
    const std::string next = law.substr(std::min(i + 1, law.size()), law.find_first_of(",;", i + 1) - i - 1);
    const bool is_apart = c == ';' || (c == ',' && next.find(" = ") != std::string::npos);
    if (depth == 0 && is_apart)
      clauses.emplace_back();
    else if (!clauses.back().empty() || c != ' ' || clauses.size() == 1)
      clauses.back() += c;
  }
  return clauses;
}

}  // namespace

std::string mathml_of(const std::string& law, const std::set<std::string>& names) {
  std::string set;
  for (const auto& clause : clauses_of(law))
    set += (set.empty() ? "<math>" : "<br/><math>") + Setter(tokens_of(clause, names), names).all() + "</math>";
  return set;
}

}  // namespace hysteron::studio
