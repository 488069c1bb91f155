// Decides what an expression says: from "a*sin(b*u) + max(u, 0)" to a tree of operations on numbers and symbols.
// Does not decide which symbols are inputs, nor how the tree is evaluated (expression_code.h).
//
//   or          a or b, a || b             comparison  a < b  a <= b  a > b  a >= b  a == b  a != b
//   and         a and b, a && b            sum         a + b  a - b
//   not         not a, !a                  product     a * b  a / b
//   sign        -a  +a                     power       a ^ b, right to left, before the sign: -a^2 = -(a^2)
// True is 1, false 0; whatever is above 1/2 counts as true. Recursive descent, one function per line above.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace hysteron::expression {

enum class Op : int {
  number,
  symbol,
  negative,
  add,
  subtract,
  multiply,
  divide,
  power,     // by what another part of the expression says
  power_by,  // by a number
  less,
  less_equal,
  equal,
  not_equal,
  both,
  either,
  negate,
  truth,
  choose,
  abs,
  sign,
  min,
  max,
  floor,
  ceil,
  round,
  mod,
  sqrt,
  cbrt,
  exp,
  log,
  log10,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  atan2,
  sinh,
  cosh,
  tanh,
  hypot
};

struct Function {
  const char* name;
  Op op;
  int arguments;  ///< of min and max: at least
};
inline constexpr std::array functions{
    Function{"abs", Op::abs, 1},     Function{"sign", Op::sign, 1},   Function{"min", Op::min, 2},
    Function{"max", Op::max, 2},     Function{"floor", Op::floor, 1}, Function{"ceil", Op::ceil, 1},
    Function{"round", Op::round, 1}, Function{"mod", Op::mod, 2},     Function{"sqrt", Op::sqrt, 1},
    Function{"cbrt", Op::cbrt, 1},   Function{"exp", Op::exp, 1},     Function{"log", Op::log, 1},
    Function{"log10", Op::log10, 1}, Function{"sin", Op::sin, 1},     Function{"cos", Op::cos, 1},
    Function{"tan", Op::tan, 1},     Function{"asin", Op::asin, 1},   Function{"acos", Op::acos, 1},
    Function{"atan", Op::atan, 1},   Function{"atan2", Op::atan2, 2}, Function{"sinh", Op::sinh, 1},
    Function{"cosh", Op::cosh, 1},   Function{"tanh", Op::tanh, 1},   Function{"hypot", Op::hypot, 2},
    Function{"pow", Op::power, 2},   Function{"if", Op::choose, 3}};

/// What an operation is called in messages: "+", "sin".
inline std::string name_of(Op op) {
  for (const auto& f : functions)
    if (f.op == op && op != Op::power) return f.name;
  switch (op) {
    case Op::add:
      return "+";
    case Op::subtract:
    case Op::negative:
      return "-";
    case Op::multiply:
      return "*";
    case Op::divide:
      return "/";
    case Op::power:
    case Op::power_by:
      return "^";
    default:
      return "a comparison";
  }
}

/// A part of an expression; its arguments stand before it in the tree.
struct Part {
  Op op = Op::number;
  double number = 0;                  ///< of a number
  int symbol = -1;                    ///< of a symbol: place in Tree::symbols
  std::array<int, 3> of{-1, -1, -1};  ///< arguments
  int character = 0;                  ///< where it stands in the text, from 1
  bool is(Op other) const { return op == other; }
  /// Its value is 0 or 1.
  bool is_logical() const { return op >= Op::less && op <= Op::truth; }
};

struct Tree {
  std::vector<Part> parts;           ///< the last one is the whole
  std::vector<std::string> symbols;  ///< in the order in which they first appear
  std::vector<int> symbol_at;        ///< the character where each does
};

/// What is wrong with a text, where (character, from 1), and the cure.
struct Wrong : std::runtime_error {
  Wrong(const std::string& what, int where, std::string what_to_do)
      : std::runtime_error(what + " at character " + std::to_string(where)),
        character(where),
        cure(std::move(what_to_do)) {}
  int character;
  std::string cure;
};

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  /// `condition`: what it says is taken for true or false.
  Tree parse(bool condition) {
    skip();
    if (at_ == text_.size()) throw Wrong("there is no expression", 1, "write one, such as \"2*u + max(u, 0)\"");
    const int all = whole();
    if (at_ < text_.size()) fail_here();
    if (condition) logical(all);
    return std::move(tree_);
  }

 private:
  static constexpr int deepest = 100, longest = 1000;  // nested; parts

  int add(Part part) {
    if (tree_.parts.size() >= longest)
      throw Wrong("the expression is too long", part.character, "divide it among several blocks");
    fold(part);
    tree_.parts.push_back(part);
    return static_cast<int>(tree_.parts.size()) - 1;
  }

  /// The sign of a number, and 1/2, are numbers: exponents are told by it.
  void fold(Part& part) const {
    const auto number = [&](int i) {
      return part.of[static_cast<std::size_t>(i)] >= 0
                 ? &tree_.parts[static_cast<std::size_t>(part.of[static_cast<std::size_t>(i)])]
                 : nullptr;
    };
    const Part *a = number(0), *b = number(1);
    if (a == nullptr || !a->is(Op::number)) return;
    double value = 0;
    if (part.is(Op::negative))
      value = -a->number;
    else if (b == nullptr || !b->is(Op::number))
      return;
    else if (part.is(Op::add))
      value = a->number + b->number;
    else if (part.is(Op::subtract))
      value = a->number - b->number;
    else if (part.is(Op::multiply))
      value = a->number * b->number;
    else if (part.is(Op::divide))
      value = a->number / b->number;
    else
      return;
    part = {Op::number, value, -1, {-1, -1, -1}, part.character};
  }

  int make(Op op, std::size_t begin, int a, int b = -1, int c = -1) {
    return add({op, 0, -1, {a, b, c}, static_cast<int>(begin) + 1});
  }

  /// An argument that counts as true or false.
  int logical(int part) {
    const Part& p = tree_.parts[static_cast<std::size_t>(part)];
    return p.is_logical() ? part : make(Op::truth, static_cast<std::size_t>(p.character) - 1, part);
  }

  // --- one function per level of binding
  // ------------------------------------------------------------------------------

  int whole() {
    if (++depth_ > deepest)
      throw Wrong("the expression is nested too deeply", place(), "divide it among several blocks");
    int left = conjunction();
    for (std::size_t begin = at_; word("or") || sign("||"); begin = at_) {
      left = logical(left);
      left = make(Op::either, begin, left, logical(conjunction()));
    }
    --depth_;
    return left;
  }

  int conjunction() {
    int left = negation();
    for (std::size_t begin = at_; word("and") || sign("&&"); begin = at_) {
      left = logical(left);
      left = make(Op::both, begin, left, logical(negation()));
    }
    return left;
  }

  int negation() {
    const std::size_t begin = at_;
    if (!word("not") && !(peek() == '!' && sign("!"))) return comparison();
    if (++depth_ > deepest)
      throw Wrong("the expression is nested too deeply", place(), "divide it among several blocks");
    const int of = logical(negation());
    --depth_;
    return make(Op::negate, begin, of);
  }

  int comparison() {
    const int left = sum();
    const std::size_t begin = at_;
    if (sign("<=")) return make(Op::less_equal, begin, left, sum());
    if (sign(">=")) return make(Op::less_equal, begin, sum(), left);
    if (sign("==")) return make(Op::equal, begin, left, sum());
    if (sign("!=")) return make(Op::not_equal, begin, left, sum());
    if (sign("<")) return make(Op::less, begin, left, sum());
    if (sign(">")) return make(Op::less, begin, sum(), left);
    if (peek() == '=') throw Wrong("a single = compares nothing", place(), "write == to compare, <= for at most");
    return left;
  }

  int sum() {
    int left = product();
    for (std::size_t begin = at_;; begin = at_) {
      if (sign("+"))
        left = make(Op::add, begin, left, product());
      else if (sign("-"))
        left = make(Op::subtract, begin, left, product());
      else
        return left;
    }
  }

  int product() {
    int left = signed_power();
    for (std::size_t begin = at_;; begin = at_) {
      if (peek() == '*' && at_ + 1 < text_.size() && text_[at_ + 1] == '*')
        throw Wrong("** is no operator", place(), "write ^ for a power");
      if (sign("*"))
        left = make(Op::multiply, begin, left, signed_power());
      else if (sign("/"))
        left = make(Op::divide, begin, left, signed_power());
      else
        return left;
    }
  }

  int signed_power() {
    const std::size_t begin = at_;
    if (++depth_ > deepest)
      throw Wrong("the expression is nested too deeply", place(), "divide it among several blocks");
    int made = 0;
    if (sign("-"))
      made = make(Op::negative, begin, signed_power());
    else if (sign("+"))
      made = signed_power();
    else
      made = power();
    --depth_;
    return made;
  }

  int power() {
    const int base = primary();
    const std::size_t begin = at_;
    return sign("^") ? raised(begin, base, signed_power()) : base;
  }

  int raised(std::size_t begin, int base, int exponent) {
    const Part& by = tree_.parts[static_cast<std::size_t>(exponent)];
    return make(by.is(Op::number) ? Op::power_by : Op::power, begin, base, exponent);
  }

  int primary() {
    const std::size_t begin = at_;
    if (sign("(")) {
      const int inside = whole();
      close(begin);
      return inside;
    }
    if (is_digit(peek()) || peek() == '.') return number();
    if (!is_letter(peek())) fail_here();
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string name(text_.substr(begin, at_ - begin));
    skip();
    if (peek() == '(') return call(name, begin);
    if (name == "pi") return add({Op::number, std::numbers::pi, -1, {-1, -1, -1}, static_cast<int>(begin) + 1});
    if (name == "and" || name == "or" || name == "not")
      throw Wrong("\"" + name + "\" stands where a value should", static_cast<int>(begin) + 1,
                  "write a and b, a or b, not a");
    return symbol(name, begin);
  }

  int number() {
    const std::size_t begin = at_;
    double value = 0;
    const auto read = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (read.ec != std::errc{}) throw Wrong("there is no number", place(), "write one such as 2, 0.5 or 1e-3");
    at_ = static_cast<std::size_t>(read.ptr - text_.data());
    if (is_letter(peek()))
      throw Wrong(
          "a number is followed by a name", place(),
          "write the multiplication: 2*u. Numbers in an expression have no units; a parameter has: \"a\": \"2 um\"");
    skip();
    return add({Op::number, value, -1, {-1, -1, -1}, static_cast<int>(begin) + 1});
  }

  int call(const std::string& name, std::size_t begin) {
    const std::size_t open = at_;
    sign("(");
    std::vector<int> arguments;
    if (peek() != ')') do
        arguments.push_back(whole());
      while (sign(","));
    close(open);
    for (const auto& f : functions)
      if (name == f.name) return apply(f, begin, arguments);
    std::string all;
    for (const auto& f : functions) all += std::string(all.empty() ? "" : ", ") + f.name;
    throw Wrong("there is no function \"" + name + "\"", static_cast<int>(begin) + 1,
                "functions are " + all + "; a product is written with *");
  }

  int apply(const Function& f, std::size_t begin, const std::vector<int>& a) {
    const bool any_number = f.op == Op::min || f.op == Op::max;
    const auto wanted = static_cast<std::size_t>(f.arguments);
    if (any_number ? a.size() < wanted : a.size() != wanted)
      throw Wrong(std::string(f.name) + " takes " + std::to_string(wanted) +
                      (any_number    ? " arguments or more"
                       : wanted == 1 ? " argument"
                                     : " arguments") +
                      ", found " + std::to_string(a.size()),
                  static_cast<int>(begin) + 1,
                  f.op == Op::choose ? "write if(condition, then, else)" : "arguments are parted by commas");
    if (f.op == Op::power) return raised(begin, a[0], a[1]);
    if (f.op == Op::choose) {
      const int condition = logical(a[0]);
      return make(f.op, begin, condition, a[1], a[2]);
    }
    if (wanted == 1) return make(f.op, begin, a[0]);
    int left = make(f.op, begin, a[0], a[1]);
    for (std::size_t i = 2; i < a.size(); ++i) left = make(f.op, begin, left, a[i]);
    return left;
  }

  int symbol(const std::string& name, std::size_t begin) {
    std::size_t i = 0;
    while (i < tree_.symbols.size() && tree_.symbols[i] != name) ++i;
    if (i == tree_.symbols.size()) {
      tree_.symbols.push_back(name);
      tree_.symbol_at.push_back(static_cast<int>(begin) + 1);
    }
    return add({Op::symbol, 0, static_cast<int>(i), {-1, -1, -1}, static_cast<int>(begin) + 1});
  }

  // --- characters
  // -----------------------------------------------------------------------------------------------------

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  int place() const { return static_cast<int>(at_) + 1; }
  void skip() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n')) ++at_;
  }
  /// Passes these characters if they come next.
  bool sign(std::string_view characters) {
    if (text_.substr(at_, characters.size()) != characters) return false;
    at_ += characters.size();
    skip();
    return true;
  }
  bool word(std::string_view name) {
    const char behind = at_ + name.size() < text_.size() ? text_[at_ + name.size()] : '\0';
    return !is_letter(behind) && !is_digit(behind) && sign(name);
  }
  void close(std::size_t open) {
    if (sign(")")) return;
    if (at_ < text_.size() && peek() != ',') fail_here();
    throw Wrong("the parenthesis is not closed that opens", static_cast<int>(open) + 1, "add a )");
  }
  [[noreturn]] void fail_here() const {
    if (at_ >= text_.size()) throw Wrong("the expression ends too early", place(), "a value is missing");
    const bool name = is_letter(peek()) || is_digit(peek()) || peek() == '(';
    throw Wrong(std::string("'") + peek() + "' is not expected", place(),
                name ? "an operator is missing: write the multiplication, 2*u"
                     : "operators are + - * / ^ < <= > >= == != and or not");
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  Tree tree_{};
};

/// Throws Wrong.
inline Tree parse(std::string_view text) { return Parser(text).parse(false); }
/// Of what is true or false: its value is 1 or 0.
inline Tree parse_condition(std::string_view text) { return Parser(text).parse(true); }

/// 0: the value does not depend on these symbols, 1: it is affine in all of them together, 2: neither.
inline int degree_in(const Tree& tree, const std::vector<bool>& symbols) {
  std::vector<int> degree;
  for (const auto& part : tree.parts) {
    const auto of = [&](std::size_t i) { return part.of[i] < 0 ? 0 : degree[static_cast<std::size_t>(part.of[i])]; };
    const int a = of(0), b = of(1), c = of(2);
    switch (part.op) {
      case Op::number:
        degree.push_back(0);
        break;
      case Op::symbol:
        degree.push_back(symbols[static_cast<std::size_t>(part.symbol)] ? 1 : 0);
        break;
      case Op::negative:
      case Op::add:
      case Op::subtract:
        degree.push_back(std::max(a, b));
        break;
      case Op::multiply:
        degree.push_back(std::min(a + b, 2));
        break;
      case Op::divide:
        degree.push_back(b == 0 ? a : 2);
        break;
      case Op::choose:
        degree.push_back(a == 0 ? std::max(b, c) : 2);
        break;
      default:
        degree.push_back(a + b + c == 0 ? 0 : 2);
    }
  }
  return degree.back();
}

}  // namespace hysteron::expression
