// Decides how an expression is evaluated: a flat list of operations on slots (inputs, parameters, numbers,
// intermediate results), compiled once from its tree; for a scalar that carries derivatives, or for many rows at a
// time. Does not read text (expression_tree.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <type_traits>
#include <vector>

#include "models/math/expression_tree.h"
#include "models/number.h"

namespace hysteron::expression {

/// The compiled form, as numbers: these counts, the numbers of the text, the operations.
struct Code {
  enum Head { inputs, parameters, numbers, operations, kinks, slots, head_size };
  static constexpr int most_slots = 160;

  std::vector<double> code{};

  static int count(const double* code, Head which) { return static_cast<int>(code[which]); }
};

/// One operation: `to` = op(a, b, c), all of them slots; packed into the whole number that a double holds exactly.
struct Operation {
  Op op;
  int to, a, b, c;
  static constexpr std::uint64_t slot_range = 256, op_range = 64;
  double packed() const {
    auto all = static_cast<std::uint64_t>(c);
    for (const int next : {b, a, to}) all = all * slot_range + static_cast<std::uint64_t>(next);
    return static_cast<double>(all * op_range + static_cast<std::uint64_t>(op));
  }
};

/// One operation as it is packed: a part of it is taken out where it is needed.
struct PackedOperation {
  std::uint64_t all;
  explicit PackedOperation(double packed) : all(static_cast<std::uint64_t>(static_cast<std::int64_t>(packed))) {}
  Op op() const { return static_cast<Op>(all % Operation::op_range); }
  std::size_t to() const { return slot(0); }
  std::size_t a() const { return slot(1); }
  std::size_t b() const { return slot(2); }
  std::size_t c() const { return slot(3); }

 private:
  std::size_t slot(int i) const { return (all >> (6 + 8 * i)) % Operation::slot_range; }
};

/// Numbers that change their sign where the operation bends or jumps.
constexpr int kinks_of(Op op) {
  switch (op) {
    case Op::less:
    case Op::less_equal:
    case Op::equal:
    case Op::not_equal:
    case Op::truth:
    case Op::abs:
    case Op::sign:
    case Op::min:
    case Op::max:
    case Op::floor:
    case Op::ceil:
    case Op::round:
    case Op::mod:
    case Op::atan2:
      return 1;
    default:
      return 0;
  }
}

inline double kink(Op op, double a, double b) {
  switch (op) {
    case Op::truth:
      return a - 0.5;
    case Op::abs:
    case Op::sign:
      return a;
    case Op::floor:
    case Op::ceil:
      return std::sin(std::numbers::pi * a);
    case Op::round:
      return std::cos(std::numbers::pi * a);
    case Op::mod:
      return std::sin(std::numbers::pi * a / b);
    case Op::atan2:  // jumps from pi to -pi
      return b < 0 ? a : 1;
    default:
      return a - b;
  }
}

/// Which symbols are parameters; the others are inputs. Each counts in the order of Tree::symbols.
/// Throws Wrong if there are too many symbols and intermediate results.
class Compiler {
 public:
  Compiler(const Tree& tree, const std::vector<bool>& is_parameter) : tree_(tree) {
    int inputs = 0, parameters = 0;
    for (const bool p : is_parameter) ++(p ? parameters : inputs);
    int next_input = 0, next_parameter = inputs;
    for (const bool p : is_parameter) symbol_.push_back(p ? next_parameter++ : next_input++);
    count_uses();
    collect_numbers(inputs + parameters);
    first_temporary_ = next_ = inputs + parameters + static_cast<int>(numbers_.size());
    for (std::size_t i = 0; i < tree.parts.size(); ++i)
      if (uses_[i] > 0) emit(i);
    made_.code = {static_cast<double>(inputs),          static_cast<double>(parameters),
                  static_cast<double>(numbers_.size()), static_cast<double>(operations_.size()),
                  static_cast<double>(kinks_),          static_cast<double>(next_)};
    made_.code.insert(made_.code.end(), numbers_.begin(), numbers_.end());
    for (const auto& o : operations_) made_.code.push_back(o.packed());
  }

  Code code() && { return std::move(made_); }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  /// How many others read each part; none of those that a number has replaced.
  void count_uses() {
    uses_.assign(tree_.parts.size(), 0);
    uses_.back() = 1;
    for (std::size_t i = tree_.parts.size(); i-- > 0;)
      if (uses_[i] > 0)
        for (const int a : tree_.parts[i].of)
          if (a >= 0) ++uses_[at(a)];
  }

  void collect_numbers(int first) {
    slot_.assign(tree_.parts.size(), -1);
    for (std::size_t i = 0; i < tree_.parts.size(); ++i) {
      const Part& part = tree_.parts[i];
      if (uses_[i] == 0 || !part.is(Op::number)) continue;
      auto found = std::find(numbers_.begin(), numbers_.end(), part.number);
      if (found == numbers_.end()) found = numbers_.insert(numbers_.end(), part.number);
      slot_[i] = first + static_cast<int>(found - numbers_.begin());
    }
  }

  void emit(std::size_t i) {
    const Part& part = tree_.parts[i];
    if (part.is(Op::number)) return;
    if (part.is(Op::symbol)) {
      slot_[i] = symbol_[at(part.symbol)];
      return;
    }
    Operation o{part.op, 0, 0, 0, 0};
    int* const to[3] = {&o.a, &o.b, &o.c};
    for (std::size_t k = 0; k < 3; ++k)
      if (part.of[k] >= 0) *to[k] = slot_[at(part.of[k])];
    for (const int a : part.of)
      if (a >= 0 && --uses_[at(a)] == 0 && slot_[at(a)] >= first_temporary_) free_.push_back(slot_[at(a)]);
    o.to = slot_[i] = temporary(part);
    kinks_ += kinks_of(part.op);
    operations_.push_back(o);
  }

  int temporary(const Part& part) {
    if (!free_.empty()) {
      const int slot = free_.back();
      free_.pop_back();
      return slot;
    }
    if (next_ >= Code::most_slots)
      throw Wrong("the expression is too long", part.character, "divide it among several blocks");
    return next_++;
  }

  const Tree& tree_;
  std::vector<int> symbol_{}, uses_{}, slot_{}, free_{};
  std::vector<double> numbers_{};
  std::vector<Operation> operations_{};
  int first_temporary_ = 0, next_ = 0, kinks_ = 0;
  Code made_{};
};

inline Code compile(const Tree& tree, const std::vector<bool>& is_parameter) {
  return Compiler(tree, is_parameter).code();
}

/// One operation on numbers. Derivatives of what jumps are those of the piece that is active.
template <Op op, class T>
inline T value(const T& a, const T& b, const T& c) {
  using std::abs;
  using std::acos;
  using std::asin;
  using std::atan;
  using std::atan2;
  using std::cbrt;
  using std::cos;
  using std::cosh;
  using std::exp;
  using std::floor;
  using std::hypot;
  using std::log;
  using std::pow;
  using std::sin;
  using std::sinh;
  using std::sqrt;
  using std::tan;
  using std::tanh;
  const auto yes = [](bool is) { return T(is ? 1.0 : 0.0); };
  const T half(0.5);
  if constexpr (op == Op::negative) return -a;
  if constexpr (op == Op::add) return a + b;
  if constexpr (op == Op::subtract) return a - b;
  if constexpr (op == Op::multiply) return a * b;
  if constexpr (op == Op::divide) return a / b;
  if constexpr (op == Op::power) return pow(a, b);
  if constexpr (op == Op::less) return yes(a < b);
  if constexpr (op == Op::less_equal) return yes(a <= b);
  if constexpr (op == Op::equal) return yes(a == b);
  if constexpr (op == Op::not_equal) return yes(!(a == b));
  if constexpr (op == Op::both) return yes(a > half && b > half);
  if constexpr (op == Op::either) return yes(a > half || b > half);
  if constexpr (op == Op::negate) return yes(!(a > half));
  if constexpr (op == Op::truth) return yes(a > half);
  if constexpr (op == Op::choose) return a > half ? b : c;
  if constexpr (op == Op::abs) return abs(a);
  if constexpr (op == Op::sign) return T(a > T(0.0) ? 1.0 : a < T(0.0) ? -1.0 : 0.0);
  if constexpr (op == Op::min) return b < a ? b : a;
  if constexpr (op == Op::max) return b > a ? b : a;
  if constexpr (op == Op::floor) return floor(a);
  if constexpr (op == Op::ceil) return -floor(-a);
  if constexpr (op == Op::round) return T(std::round(hysteron::plain(a)));
  if constexpr (op == Op::mod) return a - b * floor(a / b);
  if constexpr (op == Op::sqrt) return sqrt(a);
  if constexpr (op == Op::cbrt) return cbrt(a);
  if constexpr (op == Op::exp) return exp(a);
  if constexpr (op == Op::log) return log(a);
  if constexpr (op == Op::log10) return log(a) / T(std::numbers::ln10);
  if constexpr (op == Op::sin) return sin(a);
  if constexpr (op == Op::cos) return cos(a);
  if constexpr (op == Op::tan) return tan(a);
  if constexpr (op == Op::asin) return asin(a);
  if constexpr (op == Op::acos) return acos(a);
  if constexpr (op == Op::atan) return atan(a);
  if constexpr (op == Op::atan2) return atan2(a, b);
  if constexpr (op == Op::sinh) return sinh(a);
  if constexpr (op == Op::cosh) return cosh(a);
  if constexpr (op == Op::tanh) return tanh(a);
  if constexpr (op == Op::hypot) return hypot(a, b);
  return a;
}

/// a^n for the number n; small whole ones are products.
template <class T>
inline T power_by(const T& a, double n) {
  using std::pow;
  if (n == 2) return a * a;
  if (n == 3) return a * a * a;
  if (n == -1) return T(1.0) / a;
  return pow(a, n);
}

/// Calls visit with the operation as a type. Part of its caller's loop, so that what it captures stays in registers.
template <class Visit>
[[gnu::always_inline]] inline void with_operation(Op op, const Visit& visit) {
#define HYSTERON_CASE(name) \
  case Op::name:            \
    return visit(std::integral_constant<Op, Op::name>{});
  switch (op) {
    HYSTERON_CASE(negative)
    HYSTERON_CASE(add)
    HYSTERON_CASE(subtract)
    HYSTERON_CASE(multiply)
    HYSTERON_CASE(divide)
    HYSTERON_CASE(power)
    HYSTERON_CASE(power_by)
    HYSTERON_CASE(less)
    HYSTERON_CASE(less_equal)
    HYSTERON_CASE(equal)
    HYSTERON_CASE(not_equal)
    HYSTERON_CASE(both)
    HYSTERON_CASE(either)
    HYSTERON_CASE(negate)
    HYSTERON_CASE(truth)
    HYSTERON_CASE(choose)
    HYSTERON_CASE(abs)
    HYSTERON_CASE(sign)
    HYSTERON_CASE(min)
    HYSTERON_CASE(max)
    HYSTERON_CASE(floor)
    HYSTERON_CASE(ceil)
    HYSTERON_CASE(round)
    HYSTERON_CASE(mod)
    HYSTERON_CASE(sqrt)
    HYSTERON_CASE(cbrt)
    HYSTERON_CASE(exp)
    HYSTERON_CASE(log)
    HYSTERON_CASE(log10)
    HYSTERON_CASE(sin)
    HYSTERON_CASE(cos)
    HYSTERON_CASE(tan)
    HYSTERON_CASE(asin)
    HYSTERON_CASE(acos)
    HYSTERON_CASE(atan)
    HYSTERON_CASE(atan2)
    HYSTERON_CASE(sinh)
    HYSTERON_CASE(cosh)
    HYSTERON_CASE(tanh)
    HYSTERON_CASE(hypot)
    case Op::number:
    case Op::symbol:
      break;  // values of slots
  }
  __builtin_unreachable();
#undef HYSTERON_CASE
}

/// The value. `slots`: Code::slots numbers, the first of them the inputs and parameters; the rest is overwritten.
/// `bend`(operation) is called before each of them.
template <class T, class Bend>
[[gnu::always_inline]] inline T evaluate(const double* code, T* slots, const Bend& bend) {
  const int given = Code::count(code, Code::inputs) + Code::count(code, Code::parameters);
  const int numbers = Code::count(code, Code::numbers), operations = Code::count(code, Code::operations);
  const double* next = code + Code::head_size;
  for (int i = 0; i < numbers; ++i) slots[given + i] = T(*next++);
  // Without operations: a symbol or a number.
  std::size_t last = numbers > 0 ? static_cast<std::size_t>(given) : 0;
  for (const double* const end = next + operations; next != end; ++next) {
    const PackedOperation o(*next);
    bend(o);
    last = o.to();
    with_operation(o.op(), [&](auto op) {
      if constexpr (op == Op::power_by)
        slots[last] = power_by(slots[o.a()], hysteron::plain(slots[o.b()]));
      else
        slots[last] = value<op()>(slots[o.a()], slots[o.b()], slots[o.c()]);
    });
  }
  return slots[last];
}
template <class T>
T evaluate(const double* code, T* slots) {
  return evaluate(code, slots, [](const PackedOperation&) {});
}
/// The same, and Code::kinks numbers that change their sign where the value bends or jumps.
inline double evaluate(const double* code, double* slots, double* kinks) {
  return evaluate(code, slots, [&](const PackedOperation& o) {
    if (kinks_of(o.op()) > 0) *kinks++ = kink(o.op(), slots[o.a()], slots[o.b()]);
  });
}

/// Rows at a time: slot i of row k stands at slots[i][k]; where the result stands is returned. `fixed` are the slots of
/// parameters and numbers, filled already; `work` is that of intermediate results, `rows` numbers each.
template <int rows>
const double* evaluate_rows(const double* code, const double** slots, double* work, int count) {
  const auto first = static_cast<std::size_t>(Code::count(code, Code::inputs) + Code::count(code, Code::parameters) +
                                              Code::count(code, Code::numbers));
  const double* next = code + Code::head_size + Code::count(code, Code::numbers);
  const int operations = Code::count(code, Code::operations);
  const double* last = slots[Code::count(code, Code::numbers) > 0 ? first - 1 : 0];
  for (int i = 0; i < operations; ++i) {
    const PackedOperation o(*next++);
    const double *a = slots[o.a()], *b = slots[o.b()], *c = slots[o.c()];
    double* to = work + (o.to() - first) * rows;
    with_operation(o.op(), [&](auto op) {
      if constexpr (op == Op::power_by) {
        const double n = b[0];
        for (int k = 0; k < count; ++k) to[k] = power_by(a[k], n);
      } else {
        for (int k = 0; k < count; ++k) to[k] = value<op()>(a[k], b[k], c[k]);
      }
    });
    slots[o.to()] = last = to;
  }
  return last;
}

}  // namespace hysteron::expression
