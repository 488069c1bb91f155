// Decides which studies are the same: a text of everything that decides their numbers, and nothing else.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fit/study/study_problem.h"
#include "io/files/digest.h"

namespace hysteron {
namespace {

/// Blocks, what they are made of, their wires and every number at the start.
std::string program_text(const Program& program, const Run& base) {
  Digest numbers;
  for (const auto* list : {&base.x, &base.p, &base.c, &base.m, &base.warm, &base.loop_absolute}) numbers.add(*list);
  numbers.add(base.mode);
  numbers.add(base.direction);
  for (const auto& series : base.series) {
    if (!series) continue;
    numbers.add(series->t);
    numbers.add(series->v);
    numbers.add(&series->between, sizeof series->between);
  }
  for (const auto& past : program.pasts) {
    numbers.add(past.inputs);
    numbers.add(past.memory);
  }
  numbers.add(program.guess);
  std::string text;
  for (const auto& block : program.blocks) {
    for (const auto& list : block.shape.structure) numbers.add(list);
    text += fmt::format("{} {} {} {} {};", block.path, block.kernel->declaration.type, fmt::join(block.source, ","),
                        fmt::join(block.shape.list_lengths, ","), fmt::join(block.shape.text_choices, ","));
  }
  return text + numbers.text();
}

std::string conditions_text(const std::vector<Condition>& conditions) {
  std::string text;
  const auto bound = [](const std::optional<double>& b) { return b ? fmt::format("{:a}", *b) : std::string("-"); };
  for (const auto& c : conditions)
    text +=
        fmt::format("{} {} {} {} {};", c.column, bound(c.above), bound(c.at_least), bound(c.below), bound(c.at_most));
  return text;
}

std::string options_text(const SimulateOptions& o) {
  return fmt::format("{:a} {:a} {:a} {} {:a} {:a} {:a} {:a} {}", o.begin, o.until, o.every, method_name(o.method),
                     o.relative_tolerance, o.absolute_tolerance, o.max_step, o.step, o.at_rest);
}

std::string trace_text(const Study& study, const TraceFeature& f) {
  Digest less;
  less.add(f.less);
  const auto signal = [&](int s) { return s < 0 ? -1 : study.options.signals[static_cast<std::size_t>(s)]; };
  return fmt::format("{} {} {} {} {} {} {} {} {:a};", trace_takes()[static_cast<std::size_t>(f.take)], signal(f.signal),
                     signal(f.minus), signal(f.over), less.text(), f.first, f.last, f.rezero, f.at);
}

}  // namespace

std::string text_digest(const std::string& text) {
  Digest digest;
  digest.add(text.data(), text.size());
  return digest.text();
}

std::string description_of(const Study& study) {
  std::string text = "program " + program_text(*study.program, study.base) + "\n";
  text += "options " + options_text(study.options) + "\n";
  text += fmt::format("varied {}\n", fmt::join(study.parameters, ","));
  text += "sample " + study.sampler->description() + "\n";
  text += fmt::format("simulate_refused {}\n", study.simulate_refused);
  text += fmt::format("draws {} accepted {} give_up_after {} keep_all {}\n", study.draws, study.accepted,
                      study.give_up_after, study.keep_all);
  text += "traces ";
  for (const auto& f : study.traces) text += trace_text(study, f);
  text += "\nfeatures ";
  for (const auto& f : study.features) {
    text += fmt::format("{} {}", f.trace, f.combination.how);
    for (const auto& o : f.combination.of) text += fmt::format(" {} {:a}", o.column, o.constant);
    text += ";";
  }
  text += "\ncolumns ";
  for (const auto& c : study.columns)
    text += fmt::format("{} [{}] {} {};", c.name, c.unit.text, c.difference, c.meaning);
  text += "\nfilters " + conditions_text(study.filters) + "\nhistograms ";
  for (const auto& h : study.histograms)
    text += fmt::format("{} {:a} {:a} {} {} {}", h.column, h.bins.from, h.bins.to, h.bins.count, h.bins.log,
                        conditions_text(h.where));
  return text + "\n";
}

}  // namespace hysteron
