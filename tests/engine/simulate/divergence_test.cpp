// A run that grows without bound names the state that grows, and since when, whichever method met it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "engine/diagram/error.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

Problem failure(const Diagram& d, const SimulateOptions& options) {
  const auto program = compiled(d);
  try {
    simulate(*program, start(*program), options);
  } catch (const Error& e) {
    EXPECT_EQ(e.fault, Fault::numerics);
    return e.problems.front();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

double number_behind(const std::string& text, const std::string& words) {
  const auto at = text.find(words);
  return at == std::string::npos ? std::nan("") : std::atof(text.c_str() + at + words.size());
}

const std::vector<SimulateOptions> every_way{{.until = 100, .every = 0.01},
                                             {.until = 100, .every = 0.01, .method = Method::bdf},
                                             {.until = 100, .every = 0.01, .method = Method::adams},
                                             {.until = 100, .every = 0.01, .method = Method::runge_kutta},
                                             {.until = 100, .every = 0.01, .method = Method::rk4, .step = 1e-3},
                                             {.until = 100, .every = 0.01, .method = Method::euler, .step = 1e-3}};

/// x' = u + 50 x from zero with u = 1: x = (e^(50 t) - 1)/50, which passes 1.8e308 at t = 14.27 s.
std::vector<std::pair<std::string, Node>> unstable() {
  return {{"src", block("constant", {{"value", 1.0}})},
          {"e", block("sum", {{"signs", "++"}}, {"src", "fb"})},
          {"plant", block("integrator", {}, {"e"})},
          {"fb", block("gain", {{"gain", "50 1/s"}}, {"plant"})}};
}

TEST(Divergence, TheStateOfAnUnstableLoopIsNamedNotTheSourceThatDrivesIt) {
  for (const auto& options : every_way) {
    const auto p = failure(diagram(unstable(), {"src", "fb", "plant"}), options);
    SCOPED_TRACE(method_name(options.method) + ": " + p.what);
    EXPECT_EQ(p.code, "diverged");
    EXPECT_EQ(p.path, "plant");
    EXPECT_NE(p.what.find("plant"), std::string::npos);
    EXPECT_NE(p.cure.find("plant -> fb -> e -> plant"), std::string::npos) << p.cure;
    // Usual is what its nominal size says, 1 s at most and 1 ms at least here: ten times that are passed between
    // ln(1 + 0.01 * 50)/50 = 8 ms and ln(1 + 10 * 50)/50 = 0.124 s; rows are 10 ms apart.
    const double since = number_behind(p.what, "at t = ");
    EXPECT_GE(since, 0);
    EXPECT_LE(since, 0.135);
  }
}

TEST(Divergence, WhatFollowsTheLoopIsNotBlamedThoughItGrowsFaster) {
  auto blocks = unstable();
  // Behind the loop: the integral grows as it does, a thousand times as large, and its square overflows first.
  blocks.emplace_back("louder", block("gain", {{"gain", 1e6}}, {"plant"}));
  blocks.emplace_back("total", block("integrator", {}, {"louder"}));
  blocks.emplace_back("square", block("product", {}, {"total", "total"}));
  blocks.emplace_back("late", block("lag", {{"times", list({1e-3}, "s")}}, {"square"}));
  for (const auto& options : every_way) {
    const auto p = failure(diagram(blocks, {"src", "square", "late"}), options);
    EXPECT_EQ(p.path, "plant") << method_name(options.method) << ": " << p.what;
  }
}

TEST(Divergence, AStateThatIsUnstableByItselfIsToldSo) {
  const auto d = diagram({{"u", block("constant", {{"value", 1.0}})},
                          {"y", block("transfer_function", {{"num", list({1})}, {"den", list({1, -50})}}, {"u"})}},
                         {"u", "y"});
  for (const auto& options : every_way) {
    const auto p = failure(d, options);
    EXPECT_EQ(p.path, "y") << p.what;
    EXPECT_NE(p.cure.find("no loop"), std::string::npos) << p.cure;
  }
}

TEST(Divergence, SinceWhenIsWhereTheUsualSizeWasLeftForGood) {
  // At rest until 3 s: the step of 1 drives the loop from there, and 1 is left within 0.14 s more.
  auto blocks = unstable();
  blocks[0].second = block("step", {{"after", 1.0}, {"time", "3 s"}});
  for (const auto& options : every_way) {
    const auto p = failure(diagram(blocks, {"plant"}), options);
    const double since = number_behind(p.what, "at t = ");
    EXPECT_GE(since, 2.99) << p.what;
    EXPECT_LE(since, 3.135) << p.what;
  }
}

TEST(Divergence, AControllerThatRunsAtInstantsIsNamedToo) {
  // i_k+1 = i_k + 2 e_k with e = -(-3 i): the sampled integral grows sevenfold each 10 ms.
  const auto d = diagram(
      {{"r", block("constant", {{"value", 1.0}})},
       {"e", block("sum", {{"signs", "++"}}, {"r", "back"})},
       {"c", block("discrete_transfer_function",
                   {{"num", list({0, 2})}, {"den", list({1, -1})}, {"direct", "no"}, {"period", "10 ms"}}, {"e"})},
       {"back", block("gain", {{"gain", 3.0}}, {"c"})}},
      {"r", "back"});
  const auto p = failure(d, {.until = 100, .every = 0.01});
  EXPECT_EQ(p.path, "c") << p.what;
}

}  // namespace
}  // namespace hysteron
