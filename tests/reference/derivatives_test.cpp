// dx/dt as simulations compute it, on random diagrams: calls that are put together once against those that gather their
// numbers each time, and sources that are asked ahead against sources that are asked when their instant comes. To the
// last bit: both ways do the same operations in the same order.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "blocks/register_all.h"
#include "engine/program/nominal.h"
#include "engine/program/steps.h"
#include "engine/simulate/bound_calls.h"
#include "engine/simulate/linear_row_kernel.h"
#include "io/diagram/diagram_file.h"
#include "tests/io/temporary_folder.h"
#include "tests/reference/random_diagram.h"

namespace reference {
namespace {

namespace fs = std::filesystem;
using namespace hysteron;

const Registry& registry() {
  static const Registry all = all_blocks();
  return all;
}

/// Null where the program refuses the diagram.
ProgramPointer drawn(std::uint64_t seed) {
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path("diagram");
  const RandomDiagram diagram = random_diagram(seed);
  fs::create_directories(folder);
  std::ofstream(folder / "diagram.json") << diagram.text;
  for (const auto& [name, text] : diagram.files) std::ofstream(folder / name) << text;
  try {
    return compile(read_diagram((folder / "diagram.json").string()), registry());
  } catch (const Error&) {
    return nullptr;
  }
}

/// The states of a run, drawn anew each time.
class States {
 public:
  States(const Program& program, const Run& run, std::uint64_t seed)
      : sizes_(nominal_states(program, run)), random_(seed) {}
  std::vector<double> operator()() {
    std::vector<double> x;
    for (const double size : sizes_) x.push_back(size * normal_(random_));
    return x;
  }

 private:
  std::vector<double> sizes_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

const std::vector<double> instants{0, 0.0125, 0.0125, 0.025, 0.31, 0.31, 0.77, 1.5};  // [s]

/// How many steps were nothing but a call.
int compare_calls(const Program& program, std::uint64_t seed) {
  const Run run = start(program);
  Work bound(program), gathered(program);
  std::vector<double> x(static_cast<std::size_t>(program.n_x));
  BoundCalls calls(program, bound, x.data());
  std::vector<BoundCalls::Call*> of_step;
  int count = 0;
  for (const Step& step : program.derivative_steps) {
    of_step.push_back(calls.add(step));
    count += of_step.back() != nullptr;
  }
  calls.bind(run);
  States states(program, run, seed);
  for (const double t : instants) {
    const auto drawn_states = states();
    std::copy(drawn_states.begin(), drawn_states.end(), x.begin());
    steps::begin(program, run, bound, t);
    calls.set_time(run, t);
    calls.set_modes(run);
    for (std::size_t i = 0; i < of_step.size(); ++i) {
      const Step& step = program.derivative_steps[i];
      if (of_step[i] == nullptr) {
        steps::run({step}, program, bound, x.data());
        continue;
      }
      if (bound.calls[static_cast<std::size_t>(step.block)].source_only) BoundCalls::set_time(*of_step[i], run, t);
      BoundCalls::carry_out(*of_step[i]);
    }
    evaluate_derivatives(program, run, gathered, t, x.data());
    if (gathered.unsolved >= 0) continue;
    EXPECT_TRUE(same_bits(bound.dx, gathered.dx)) << "seed " << seed << " at " << t << " s";
  }
  return count;
}

void compare_instants(const Program& program, std::uint64_t seed) {
  const Run run = start(program);
  Work ahead(program), then(program);
  LinearRowKernel foretold(program, run, ahead), asked(program, run, then);
  States states(program, run, seed);
  foretold.foretell(run, instants);
  // In order, with one that was not foretold, some that did not come, and back again.
  for (const double t : {0.0, 0.0125, 0.0125, 0.02, 0.025, 0.77, 0.31, 1.5, 0.0}) {
    const auto x = states();
    foretold(run, t, x.data());
    asked(run, t, x.data());
    EXPECT_TRUE(same_bits(ahead.dx, then.dx)) << "seed " << seed << " at " << t << " s";
  }
}

void try_seeds(std::uint64_t first, int count) {
  int programs = 0, calls = 0;
  for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(count); ++seed) {
    const auto program = drawn(seed);
    if (program == nullptr) continue;
    ++programs;
    calls += compare_calls(*program, seed);
    compare_instants(*program, seed);
  }
  EXPECT_GT(programs, 0.9 * count);
  EXPECT_GT(calls, 2 * programs);  // else nothing is compared
}

TEST(Derivatives, OfRandomDiagramsAreTheSameBitsHoweverTheyAreCalled) { try_seeds(1, 150); }

TEST(Derivatives, OfRandomDrivesAreTheSameBitsHoweverTheyAreCalled) { try_seeds(first_seed_with_drives, 100); }

TEST(Derivatives, OfRandomMachinesAreTheSameBitsHoweverTheyAreCalled) { try_seeds(first_seed_with_machines, 100); }

}  // namespace
}  // namespace reference
