// An expression means what C++ means by it; its slopes are those of differences; what is wrong is told with its place.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "engine/block/dual.h"
#include "models/math/expression_code.h"

namespace hysteron {
namespace {

using namespace expression;

/// All symbols are inputs, in the order in which they appear.
template <class T>
T evaluated(const std::string& text, const std::vector<T>& inputs) {
  const Tree tree = parse(text);
  const Code code = compile(tree, std::vector<bool>(tree.symbols.size(), false));
  std::vector<T> slots(Code::most_slots);
  std::copy(inputs.begin(), inputs.end(), slots.begin());
  return evaluate(code.code.data(), slots.data());
}

struct ExpressionCase {
  std::string text;
  std::function<double(double, double)> meant;  ///< of a and b, which every text names in this order
};

std::vector<ExpressionCase> expression_cases() {
  using std::numbers::pi;
  return {
      {"a + b", [](double a, double b) { return a + b; }},
      {"a - b - 1", [](double a, double b) { return a - b - 1; }},
      {"a / b / 2", [](double a, double b) { return a / b / 2; }},
      {"a - -b", [](double a, double b) { return a + b; }},
      {"-a^2 + b", [](double a, double b) { return -(a * a) + b; }},
      {"a^b^0.5", [](double a, double b) { return std::pow(a, std::pow(b, 0.5)); }},
      {"a^-1*b", [](double a, double b) { return b / a; }},
      {"a^3 + b^(1/3)", [](double a, double b) { return a * a * a + std::cbrt(b); }},
      {"pow(a, 2.5) + pow(b, a)", [](double a, double b) { return std::pow(a, 2.5) + std::pow(b, a); }},
      {"2*pi*a*b", [](double a, double b) { return 2 * pi * a * b; }},
      {"a*sin(1.3*b) + max(b, 0)", [](double a, double b) { return a * std::sin(1.3 * b) + std::max(b, 0.0); }},
      {"cos(a)*tan(b)", [](double a, double b) { return std::cos(a) * std::tan(b); }},
      {"asin(a/9) + acos(b/9) + atan(a)",
       [](double a, double b) { return std::asin(a / 9) + std::acos(b / 9) + std::atan(a); }},
      {"atan2(a, b)", [](double a, double b) { return std::atan2(a, b); }},
      {"sinh(a) - cosh(b) + tanh(a)", [](double a, double b) { return std::sinh(a) - std::cosh(b) + std::tanh(a); }},
      {"exp(-a)*log(b) + log10(a)", [](double a, double b) { return std::exp(-a) * std::log(b) + std::log10(a); }},
      {"sqrt(a) + cbrt(b)", [](double a, double b) { return std::sqrt(a) + std::cbrt(b); }},
      {"hypot(a, b)", [](double a, double b) { return std::hypot(a, b); }},
      {"abs(a - 3*b) + sign(a - b)",
       [](double a, double b) {
         return std::abs(a - 3 * b) + (a > b ? 1 : a < b ? -1 : 0);
       }},
      {"min(a, b, 1) - max(a, 2, b)",
       [](double a, double b) {
         return std::min({a, b, 1.0}) - std::max({a, 2.0, b});
       }},
      {"floor(3*a) + ceil(b) + round(a)",
       [](double a, double b) { return std::floor(3 * a) + std::ceil(b) + std::round(a); }},
      {"mod(-a, b)", [](double a, double b) { return -a - b * std::floor(-a / b); }},
      {"if(a > b, a, 2*b)", [](double a, double b) { return a > b ? a : 2 * b; }},
      {"if(a <= b and not (b < 1), a*b, if(a == b, 1, -1))",
       [](double a, double b) { return a <= b && !(b < 1) ? a * b
                                       : a == b           ? 1
                                                          : -1; }},
      {"a*(a >= b) + (b != a) - (a < b || b > 2 && a > 1)",
       [](double a, double b) { return a * (a >= b) + (b != a) - (a < b || (b > 2 && a > 1)); }},
      {"if(!(a > 1), a, b)", [](double a, double b) { return a > 1 ? b : a; }},
      {"  ( a+((b)) )*1e-3 - .5", [](double a, double b) { return (a + b) * 1e-3 - 0.5; }},
  };
}
const std::vector<std::pair<double, double>> expression_points{
    {0.7, 1.9}, {1.9, 0.7}, {2.3, 2.6}, {0.31, 0.22}, {4.1, 1.3}};

TEST(Expression, MeansWhatTheLanguageCMeansByIt) {
  for (const auto& c : expression_cases())
    for (const auto& [a, b] : expression_points) {
      const double right = c.meant(a, b);
      EXPECT_NEAR(evaluated<double>(c.text, {a, b}), right, 1e-14 * (1 + std::abs(right)))
          << c.text;  // a few roundings
    }
}

TEST(Expression, RoundsHalvesAwayFromZeroAndCountsModuloFromBelow) {
  EXPECT_EQ(evaluated<double>("round(a)", {-2.5}), -3);
  EXPECT_EQ(evaluated<double>("round(a)", {2.5}), 3);
  EXPECT_EQ(evaluated<double>("mod(a, b)", {-1, 3}), 2);
  EXPECT_EQ(evaluated<double>("sign(a)", {0}), 0);
}

/// The slopes of the kinds that the engine asks for, against central differences.
TEST(Expression, HasTheSlopesThatDifferencesShow) {
  constexpr double h = 1e-6;
  for (const auto& c : expression_cases())
    for (const auto& [a, b] : expression_points) {
      const double along = 0.6, across = -0.8;  // the direction in which a and b move
      const double right = (c.meant(a + along * h, b + across * h) - c.meant(a - along * h, b - across * h)) / (2 * h);
      const double tolerance = 1e-8 * (1 + std::abs(right));  // rounding 1e-16/h, curvature h^2
      EXPECT_NEAR(evaluated<Dual>(c.text, {{a, along}, {b, across}}).rate, right, tolerance) << c.text;
      Jet ja(a), jb(b);
      ja.slope[2] = along;
      jb.slope[2] = across;
      EXPECT_NEAR(evaluated<Jet>(c.text, {ja, jb}).slope[2], right, tolerance) << c.text;
      // the slope of a rate: of the rate along (1, 0) in the direction of the step, by differences of exact rates
      const auto rate = [&](double x, double y) { return evaluated<Dual>(c.text, {{x, 1}, {y, 0}}).rate; };
      const double curved = (rate(a + along * h, b + across * h) - rate(a - along * h, b - across * h)) / (2 * h);
      EXPECT_NEAR(evaluated<JetDual>(c.text, {{ja, Jet(1)}, {jb, Jet(0)}}).rate.slope[2], curved,
                  1e-8 * (1 + std::abs(curved)))
          << c.text;
    }
}

TEST(Expression, OfManyRowsIsThatOfEach) {
  constexpr int rows = 8;
  for (const auto& c : expression_cases()) {
    const Tree tree = parse(c.text);
    const Code code = compile(tree, {false, false});
    std::vector<double> a, b, work(Code::most_slots * rows), numbers;
    for (int k = 0; k < rows - 1; ++k) a.push_back(0.3 + 0.4 * k), b.push_back(2.7 - 0.35 * k);
    std::vector<const double*> slots(Code::most_slots, a.data());
    slots[1] = b.data();
    const int n = Code::count(code.code.data(), Code::numbers);
    numbers.resize(static_cast<std::size_t>(n * rows));
    for (int i = 0; i < n; ++i) {
      std::fill_n(numbers.begin() + i * rows, rows, code.code[static_cast<std::size_t>(Code::head_size + i)]);
      slots[static_cast<std::size_t>(2 + i)] = numbers.data() + i * rows;
    }
    const double* y = evaluate_rows<rows>(code.code.data(), slots.data(), work.data(), rows - 1);
    for (std::size_t k = 0; k < a.size(); ++k)
      EXPECT_EQ(y[k], evaluated<double>(c.text, {a[k], b[k]})) << c.text << " row " << k;
  }
}

TEST(Expression, NamesWhereItBendsOrJumps) {
  const auto kinks = [](const std::string& text, double a, double b) {
    const Tree tree = parse(text);
    const Code code = compile(tree, {false, false});
    std::vector<double> slots(Code::most_slots),
        found(static_cast<std::size_t>(Code::count(code.code.data(), Code::kinks)));
    slots[0] = a, slots[1] = b;
    evaluate(code.code.data(), slots.data(), found.data());
    return found;
  };
  EXPECT_EQ(kinks("abs(a - b) + max(b, 2)", 5, 1), (std::vector<double>{4, -1}));
  EXPECT_EQ(kinks("if(a > 3 and b, a, b)", 5, 1), (std::vector<double>{-2, 0.5}));  // 3 - a, and the level of true
  EXPECT_EQ(kinks("sin(a) + b^2/a", 5, 1), (std::vector<double>{}));
  EXPECT_NEAR(kinks("mod(a, b)", 5.5, 1)[0], std::sin(5.5 * std::numbers::pi), 1e-14);
}

TEST(Expression, KnowsInWhichSymbolsItIsAffine) {
  const auto degree = [](const std::string& text, std::vector<bool> in) { return degree_in(parse(text), in); };
  EXPECT_EQ(degree("a*sin(b*u) + c", {true, false, false, true}), 1);  // a and c together
  EXPECT_EQ(degree("a*sin(b*u) + c", {false, true, false, false}), 2);
  EXPECT_EQ(degree("a*c*u", {true, true, false}), 2);
  EXPECT_EQ(degree("a*u/c - 3", {true, true, false}), 2);
  EXPECT_EQ(degree("a*u/c - 3", {true, false, false}), 1);
  EXPECT_EQ(degree("a*u/c", {false, false, true}), 2);
  EXPECT_EQ(degree("if(u > 0, a, b)*u", {false, true, true}), 1);
  EXPECT_EQ(degree("b + 1", {false}), 0);
}

TEST(Expression, TellsWhatIsWrongAndWhere) {
  const auto told = [](const std::string& text) {
    try {
      const Tree tree = parse(text);
      compile(tree, std::vector<bool>(tree.symbols.size(), false));
      return std::string("nothing");
    } catch (const Wrong& wrong) {
      EXPECT_FALSE(wrong.cure.empty());
      return std::string(wrong.what());
    }
  };
  EXPECT_EQ(told(""), "there is no expression at character 1");
  EXPECT_EQ(told("a + "), "the expression ends too early at character 5");
  EXPECT_EQ(told("2u"), "a number is followed by a name at character 2");
  EXPECT_EQ(told("a b"), "'b' is not expected at character 3");
  EXPECT_EQ(told("a*(b + 1"), "the parenthesis is not closed that opens at character 3");
  EXPECT_EQ(told("a)"), "')' is not expected at character 2");
  EXPECT_EQ(told("sine(a)"), "there is no function \"sine\" at character 1");
  EXPECT_EQ(told("1 + atan2(a)"), "atan2 takes 2 arguments, found 1 at character 5");
  EXPECT_EQ(told("max(a)"), "max takes 2 arguments or more, found 1 at character 1");
  EXPECT_EQ(told("if(a, b)"), "if takes 3 arguments, found 2 at character 1");
  EXPECT_EQ(told("a = b"), "a single = compares nothing at character 3");
  EXPECT_EQ(told("a**2"), "** is no operator at character 2");
  EXPECT_EQ(told("a $ b"), "'$' is not expected at character 3");
  EXPECT_EQ(told("a and or"), "\"or\" stands where a value should at character 7");
  EXPECT_EQ(told(std::string(2000, '(') + "a"), "the expression is nested too deeply at character 51");
  std::string sum = "a", nested = "x0";
  for (int i = 0; i < 2000; ++i) sum += "+a";
  EXPECT_NE(told(sum).find("the expression is too long"), std::string::npos);
  for (int i = 1; i < 300; ++i) nested += "+x" + std::to_string(i);
  EXPECT_NE(told(nested).find("the expression is too long"), std::string::npos);
}

}  // namespace
}  // namespace hysteron
