#include "discover/models/free_numbers.h"

#include <algorithm>
#include <cmath>

#include "discover/models/parts.h"

namespace hysteron {

bool has_line(const Law& law) {
  return std::any_of(law.free.begin(), law.free.end(), [](const LawParameter& p) { return !p.line_bands.empty(); });
}

bool reads_off_column(const PlacedEffect& s) {
  return std::any_of(s.law.free.begin(), s.law.free.end(), [](const LawParameter& p) { return p.read_off_column; });
}

bool is_known_line(const FitContext& context, const CandidateModel& c, const PlacedEffect& s, const LawParameter& p) {
  if (p.line_bands.empty() || context.evidence == nullptr) return false;
  const ParameterInfo* info = c.program->find_parameter(parameter_path(s.name, s.law, p));
  if (info == nullptr) return false;
  const auto& judged = context.evidence->model().outputs();
  const auto outputs = outputs_behind(*c.program, info->block);
  return std::any_of(outputs.begin(), outputs.end(), [&](int o) {
    const auto here = std::find(judged.begin(), judged.end(), c.program->output_names[static_cast<std::size_t>(o)]);
    return here != judged.end() &&
           context.evidence->noise().outputs[static_cast<std::size_t>(here - judged.begin())].left_out.any();
  });
}

namespace {

/// Two poles that a fit left at one time are at a saddle where something else is found beside them: they begin apart.
void part_those_alike(const Law& law, std::vector<FreeParameter>& free) {
  constexpr double alike = 0.02, apart = 1.5;  // of the one, to each side
  if (law.free.size() != free.size()) return;
  for (std::size_t i = 0; i < free.size(); ++i)
    for (std::size_t k = i + 1; k < free.size(); ++k) {
      if (!law.free[i].interchangeable || !law.free[k].interchangeable) continue;
      if (std::abs(free[i].start - free[k].start) > alike * std::abs(free[i].start)) continue;
      free[i].start = std::min(free[i].start * apart, free[i].upper);
      free[k].start = std::max(free[k].start / apart, free[k].lower);
    }
}

/// What single recordings have found begins there: beside another term it is no longer found by linear least squares.
void begin_where_found(const CandidateModel& c, FreeParameter& f) {
  const auto& path = c.program->parameters[static_cast<std::size_t>(f.parameter)].path;
  for (const auto& v : c.of_recordings)
    if (v.recording == f.recording && v.path == path) f.start = std::clamp(v.value, f.lower, f.upper);
}

/// A number that the model held is near what is written.
void know_roughly(const FitContext& context, const Program& program, FreeParameter& f) {
  const auto n = context.roughly.find(program.parameters[static_cast<std::size_t>(f.parameter)].path);
  if (n == context.roughly.end()) return;
  const auto otherwise = context.known_to.times.find(n->first);
  const double times = otherwise == context.known_to.times.end() ? 1 : otherwise->second;
  const double written = n->second, width = times * context.known_to.width * std::abs(written);
  const auto [low, high] = std::minmax(
      {std::pow(context.known_to.least, times) * written, std::pow(context.known_to.most, times) * written});
  f.prior = {written - width, written + width};
  f.lower = std::max(f.lower, low);
  f.upper = std::min(f.upper, high);
  f.start = std::clamp(f.start, f.lower, f.upper);
}

}  // namespace

std::vector<FreeParameter> free_of(const FitContext& context, const CandidateModel& c, const std::vector<bool>& chosen,
                                   int fresh, const std::vector<int>& recordings, KnownLines lines, Own own) {
  auto free = own == Own::free ? free_parameters(*c.program, context.free_paths) : std::vector<FreeParameter>{};
  for (auto& f : free) know_roughly(context, *c.program, f);
  for (std::size_t i = 0; i < c.placed.size(); ++i) {
    if (!chosen[i]) continue;
    const bool is_new = static_cast<int>(i) == fresh;
    PlacedEffect standing = c.placed[i];
    if (!is_new && lines == KnownLines::held)
      std::erase_if(standing.law.free, [&](const LawParameter& p) { return is_known_line(context, c, standing, p); });
    for (auto& f : free_of_law(*c.program, standing, is_new, recordings)) {
      if (!is_new && f.recording >= 0) begin_where_found(c, f);
      std::erase_if(free, [&](const FreeParameter& have) {
        return have.parameter == f.parameter && have.recording == f.recording;
      });
      free.push_back(std::move(f));
    }
    for (const auto* anew : {&c.placed[i].zeros, &c.placed[i].weights})
      for (const auto& path : *anew) {
        FreeParameter f = free_parameter(*c.program, path);
        const bool have =
            std::any_of(free.begin(), free.end(), [&](const FreeParameter& h) { return h.parameter == f.parameter; });
        if (!have) free.push_back(std::move(f));
      }
  }
  return free;
}

std::vector<FreeParameter> free_of_law(const Program& program, const PlacedEffect& standing, bool is_new,
                                       const std::vector<int>& recordings) {
  std::vector<FreeParameter> list;
  for (const auto& p : standing.law.free) {
    FreeParameter f = free_parameter(program, parameter_path(standing.name, standing.law, p));
    f.lower = std::max(f.lower, p.lower);
    f.upper = std::min(f.upper, p.upper);
    if (is_new) f.start = std::isnan(p.start) ? p.share * f.start : p.start;
    f.start = std::clamp(f.start, f.lower, f.upper);
    f.log_scale = p.log_scale && f.lower > 0;
    f.scan.clear();
    if (is_new)
      for (const double v : p.scan)
        if (v >= f.lower && v <= f.upper) f.scan.push_back(v);
    if (p.per_recording)
      for (const int r : recordings) list.emplace_back(f).recording = r;
    else
      list.push_back(std::move(f));
  }
  if (!is_new) part_those_alike(standing.law, list);
  return list;
}

Trial silent_levels(const CandidateModel& c, const Program& program) {
  Trial trial;
  for (const auto& s : c.placed)
    for (const auto& p : s.law.free)
      if (p.read_off_column) trial.push_back({parameter_index(program, parameter_path(s.name, s.law, p)), 0, -1});
  return trial;
}

}  // namespace hysteron
