#include "app/exports/check_fmu.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "blocks/fmi/native_fmu.h"
#include "engine/diagram/error.h"
#include "io/fmi/imported_fmu.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr int steps = 10;

bool is_trusted(const Arguments& arguments, const std::string& file) {
  const auto allowed = arguments.list("--allow");
  return std::any_of(allowed.begin(), allowed.end(), [&](const std::string& path) {
    std::error_code none;
    return std::filesystem::is_regular_file(path, none) && std::filesystem::equivalent(path, file, none);
  });
}

/// Twice from its start: a reset leads back to it.
void run_it(const FmiDescription& d, const std::string& file) {
  const ForeignInterface interface = imported_fmu(file, file, true);
  NativeFmu fmu({interface.version, interface.binary, interface.resources, interface.token, file});
  std::vector<unsigned> references;
  for (const auto& v : interface.outputs) references.push_back(v.reference);
  std::vector<double> first(references.size()), second(references.size());
  const double begin = d.start.value_or(0), span = d.stop.value_or(begin + 1) - begin;
  const double size = d.step.value_or(span / 1000);
  for (auto* outputs : {&first, &second}) {
    fmu.enter_initialization(begin, {});
    fmu.exit_initialization();
    for (int k = 0; k < steps; ++k) fmu.step(begin + k * size, size);
    fmu.get(references, *outputs);
    fmu.reset();
  }
  for (std::size_t i = 0; i < first.size(); ++i) {
    const bool same = first[i] == second[i] || (std::isnan(first[i]) && std::isnan(second[i]));
    if (!same)
      fail("bad_fmu", file,
           fmt::format("after a reset its output \"{}\" is {} instead of {}", interface.outputs[i].port, second[i],
                       first[i]),
           "report to its maker that its reset does not restore the initial state");
  }
}

long count(const FmiDescription& d, const std::string& causality) {
  return std::count_if(d.variables.begin(), d.variables.end(), [&](const auto& v) { return v.causality == causality; });
}

}  // namespace

Answer check_fmu(const Arguments& arguments) {
  const std::string file = arguments.text("diagram");
  const LookedThrough looked = look_through_fmu(file);
  Problems problems;
  for (const auto& fault : looked.faults)
    problems.add("bad_fmu", file, fault, "have it exported again by a tool that keeps to the standard");
  problems.throw_if_any();
  const FmiDescription& d = looked.description;
  const bool trusted = is_trusted(arguments, file);
  if (trusted && !d.identifier.empty()) run_it(d, file);
  Answer answer;
  answer.text =
      fmt::format("{}: ok: FMI {}.0, {}, {}, {}, {}\n", file, d.version,
                  d.identifier.empty() ? "no co-simulation" : "co-simulation", count_text(count(d, "input"), "input"),
                  count_text(count(d, "output"), "output"), count_text(count(d, "parameter"), "parameter"));
  answer.text += trusted ? fmt::format("{}: ok: {} steps, a reset and the same steps again\n", file, steps)
                         : fmt::format("  it was not run; if you trust it: --allow {}\n", file);
  answer.facts = Facts::object({{"fmu", Facts::object({{"fmi", d.version},
                                                       {"inputs", count(d, "input")},
                                                       {"outputs", count(d, "output")},
                                                       {"parameters", count(d, "parameter")},
                                                       {"was_run", trusted}})}});
  return answer;
}

shape::Member fmu_shape() {
  return {"fmu",
          shape::object("what stands in an FMU", {{"fmi", shape::whole("version of the interface")},
                                                  {"inputs", shape::whole("how many")},
                                                  {"outputs", shape::whole("how many")},
                                                  {"parameters", shape::whole("how many")},
                                                  {"was_run", shape::flag("it was loaded and stepped")}}),
          shape::sometimes};
}

}  // namespace hysteron
