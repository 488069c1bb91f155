#include "tests/reference/judge.h"

#include <algorithm>
#include <cmath>

#include "blocks/register_all.h"
#include "engine/diagram/error.h"
#include "engine/program/program.h"
#include "engine/simulate/simulate.h"
#include "io/diagram/diagram_file.h"
#include "tests/reference/reference.h"

namespace reference {
namespace {

constexpr double allowed = 10;            ///< tolerances
constexpr double sooner_or_later = 2e-5;  ///< by which a jump that is located may be off [s]

struct Worst {
  std::size_t signal = 0;
  double error = 0, t = 0;
};

/// How far v is outside of what the signal is near t: its value, and both sides of jumps that are that near.
double outside(const Result& r, std::size_t signal, std::size_t row, double v) {
  double low = r.values[signal][row], high = low;
  const double t = r.t[row];
  for (auto jump = std::lower_bound(r.jumps.begin(), r.jumps.end(), t - sooner_or_later,
                                    [](const Jump&j, double at) { return j.t < at; });
       jump != r.jumps.end() && jump->t < t + sooner_or_later; ++jump) {
    if (jump->known) continue;
    low = std::min({low, jump->before[signal], jump->after[signal]});
    high = std::max({high, jump->before[signal], jump->after[signal]});
  }
  return std::max({0.0, low - v, v - high});
}

Worst compare(const Result& r, const std::vector<std::vector<double>>& values, double tolerance) {
  Worst worst;
  for (std::size_t i = 0; i < r.values.size(); ++i)
    for (std::size_t k = 0; k < r.t.size() && k < values[i].size(); ++k) {
      const double size = std::max(r.scale[i], 1e-9);
      const double error = outside(r, i, k, values[i][k]) / (tolerance * size);
      if (!(error <= worst.error)) worst = {i, error, r.t[k]};
    }
  return worst;
}

/// Is the reference the same with twice the step, and with sources that are a millionth different?
bool is_sure(const FlatDiagram& diagram, const Result& fine, const Settings& settings, double tolerance) {
  Settings coarse = settings;
  coarse.step *= 2;
  if (compare(fine, simulate(diagram, coarse).values, tolerance).error > allowed / 3) return false;
  for (const double e : {tolerance, -tolerance}) {
    coarse.disturbed = e;
    if (compare(fine, simulate(diagram, coarse).values, tolerance).error > allowed) return false;
  }
  return true;
}

const hysteron::Registry& registry() {
  static const hysteron::Registry all = hysteron::all_blocks();
  return all;
}

}  // namespace

const char* verdict_name(Verdict verdict) {
  static const char* const names[] = {"agrees", "refused", "wrong", "undecided", "unknown"};
  return names[static_cast<int>(verdict)];
}

Judgement judge(const std::string& file, double tolerance) {
  Judgement found;
  std::vector<std::vector<double>> values;
  try {
    const auto program = hysteron::compile(hysteron::read_diagram(file), registry());
    hysteron::SimulateOptions options = hysteron::simulate_options(*program);
    options.signals = program->record_signals;
    values = hysteron::simulate(*program, hysteron::start(*program), options).values;
  } catch (const hysteron::Error& error) {
    found.verdict = Verdict::refused;
    found.words = error.what();
    return found;
  }
  try {
    const FlatDiagram diagram = read_flat(file);
    Settings settings;
    settings.step = 5e-5;
    const Result fine = simulate(diagram, settings);
    const Worst worst = compare(fine, values, tolerance);
    found.signal = diagram.record[worst.signal];
    found.error = worst.error;
    found.t = worst.t;
    if (worst.error > allowed || std::isnan(worst.error))
      found.verdict = is_sure(diagram, fine, settings, tolerance) ? Verdict::wrong : Verdict::undecided;
  } catch (const GaveUp& gave_up) {
    found.verdict = Verdict::undecided;
    found.words = gave_up.what();
  } catch (const Unknown& unknown) {
    found.verdict = Verdict::unknown;
    found.words = unknown.what();
  }
  return found;
}

}  // namespace reference
