// The verb explain: what the compiler made of a diagram, and how a simulation would go about it.
// Nothing is simulated.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>

#include "app/cli/answer.h"
#include "app/cli/load.h"
#include "app/cli/shape.h"
#include "app/cli/terminal.h"
#include "app/facts/program_facts.h"
#include "app/verbs/explain_solver.h"
#include "engine/diagram/index.h"
#include "engine/program/feedthrough.h"
#include "engine/program/nominal.h"
#include "engine/simulate/simulate.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr char explain_help[] =
    "Answers: what does the program make of this diagram - in which order are blocks evaluated, where are\n"
    "loops, whose rates are computed and for whom, what makes events, which clocks tick, which solver is\n"
    "chosen and why, and where does the value of each parameter come from.\n\n"
    "Examples:\n"
    "  hysteron explain stage.json\n"
    "  hysteron explain loop.json --set controller.kp=\"0.5 V/um\" --choose compensator=none\n\n"
    "Prints to the terminal; nothing is simulated. With -o it writes result.json and report.html as well, else\n"
    "nothing is written.\n"
    "Exit codes: 0 done, 2 the diagram is wrong.";

using TableRows = std::vector<std::vector<std::string>>;

std::string joined(const std::vector<std::string>& list) { return fmt::format("{}", fmt::join(list, ", ")); }

class Explanation {
 public:
  /// `text` grows by what people read.
  Explanation(const Program& program, const Diagram& diagram, std::string file, std::string& text)
      : program_(program), diagram_(diagram), file_(std::move(file)), run_(start(program)), text_(text) {}

  /// Says everything and returns it.
  Document operator()() {
    const auto nonempty = [](const std::string& text) { return text.empty() ? "" : ": " + text; };
    text_ += wrapped(fmt::format("{}{}", file_, nonempty(program_.title)));
    text_ += wrapped(fmt::format("{}, {}, {}, {}", count_text(static_cast<long>(program_.blocks.size()), "block"),
                                 count_text(static_cast<long>(program_.signals.size()), "signal"),
                                 count_text(program_.n_x, "continuous state"),
                                 count_text(static_cast<long>(program_.parameters.size()), "number")),
                     2);
    choices();
    order();
    loops();
    rates();
    events();
    clocks();
    solver();
    states();
    parameters();
    document_.verb = "explain";
    document_.title = program_.title.empty() ? stem_of(file_) : program_.title;
    document_.headline = fmt::format("{}: what the compiler made of it", document_.title);
    document_.facts = to_json(facts());
    return std::move(document_);
  }
  /// In numbers, once all is said.
  Facts facts() const {
    return Facts::object({{"diagram", file_},
                          {"blocks", program_.blocks.size()},
                          {"signals", program_.signals.size()},
                          {"continuous_states", program_.n_x},
                          {"parameters", program_.parameters.size()},
                          {"loops", std::count_if(program_.loops.begin(), program_.loops.end(),
                                                  [&](const Loop& l) { return is_algebraic(program_, l); })},
                          {"method", method_},
                          {"why", why_}});
  }

 private:
  const BlockInstance& block(int b) const { return program_.blocks[at(b)]; }
  const std::string& path(int b) const { return block(b).path; }
  std::vector<std::string> paths(const std::vector<int>& blocks) const {
    std::vector<std::string> list;
    for (const int b : blocks) list.push_back(path(b));
    return list;
  }
  const std::string& type(int b) const { return block(b).kernel->declaration.type; }

  // What people read on the terminal is kept for result.json, too.
  void head(const std::string& title) {
    text_ += fmt::format("\n{}\n", title);
    document_.sections.emplace_back().title = title;
  }
  void say(const std::string& text) {
    text_ += wrapped(text, 2);
    document_.sections.back().text.push_back(text);
  }
  void show(const std::vector<std::string>& heads, const TableRows& rows) {
    text_ += table_text(heads, rows);
    Table table;
    table.columns = heads.empty() ? std::vector<std::string>(rows.empty() ? 0 : rows.front().size()) : heads;
    table.rows = rows;
    for (auto& row : table.rows) row.resize(table.columns.size());
    document_.sections.back().tables.push_back(std::move(table));
  }

  void choices() {
    TableRows rows;
    for (const auto& [name, node] : diagram_.blocks)
      if (!node.from.empty()) rows.push_back({name, node.choose, "of " + joined(node.from.names())});
    if (rows.empty()) return;
    head("choices");
    show({}, rows);
  }

  // --- order ---------------------------------------------------------------------------------------------------------

  void order() {
    head("order of evaluation");
    TableRows rows;
    // Values that dx/dt does not need (what is only recorded) come behind.
    std::vector<bool> seen(program_.blocks.size(), false);
    const std::function<void(const Step&, const std::string&)> add = [&](const Step& step, const std::string& when) {
      if (step.order == Order::loop) {
        const Loop& loop = program_.loops[at(step.block)];
        const std::string name = fmt::format("loop {}", step.block + 1);
        rows.push_back({fmt::format("{}", rows.size() + 1), "solve", name, "", when, "for " + joined(tears_of(loop))});
        for (const auto& inner : loop.steps) add(inner, "in " + name);
        return;
      }
      const auto& b = block(step.block);
      std::vector<std::string> reads;
      for (const int s : b.source) reads.push_back(program_.signals[at(s)].path);
      // A source whose rate is needed makes its value in the same step, the first time that it is called.
      const bool both = step.order == Order::rate && is_source_of_time(b) && !seen[at(step.block)];
      rows.push_back({fmt::format("{}", rows.size() + 1), both ? "value+rate" : name_of(step.order), b.path,
                      type(step.block), when, reads.empty() ? "" : "reads " + joined(reads)});
    };
    const auto values_in = [&](const Step& step) {
      if (step.order == Order::loop) return program_.loops[at(step.block)].blocks;
      const bool makes_values =
          step.order == Order::value || (step.order == Order::rate && is_source_of_time(block(step.block)));
      return makes_values ? std::vector<int>{step.block} : std::vector<int>{};
    };
    for (const auto& step : program_.derivative_steps) {
      add(step, "");
      for (const int b : values_in(step)) seen[at(b)] = true;
    }
    for (const auto& step : program_.all_values) {
      const auto blocks = values_in(step);
      if (std::any_of(blocks.begin(), blocks.end(), [&](int b) { return !seen[at(b)]; })) add(step, "outputs only");
    }
    for (const auto& step : program_.rate_steps) add(step, "events only");
    show({"", "what", "of block", "type", "needed for", ""}, rows);
  }

  static std::string name_of(Order order) {
    return order == Order::value ? "value" : order == Order::rate ? "rate" : "dx/dt";
  }

  /// "drive", "d/dt drive", "dx/dt of stage.x": what a loop is solved for.
  std::vector<std::string> tears_of(const Loop& loop) const {
    std::vector<std::string> names;
    for (const auto& tear : loop.tears)
      names.push_back(tear.order == Order::derivative
                          ? "dx/dt of " + program_.state_names[at(tear.index)]
                          : (tear.order == Order::rate ? "d/dt " : "") + program_.signals[at(tear.index)].path);
    return names;
  }

  void loops() {
    head("loops");
    const auto around = [](std::vector<std::string> names) {
      names.push_back(names.front());
      return fmt::format("{}", fmt::join(names, " -> "));
    };
    int algebraic = 0;
    for (std::size_t i = 0; i < program_.loops.size(); ++i) {
      const Loop& loop = program_.loops[i];
      std::vector<int> way;
      for (const auto& step : loop.path)
        if (way.empty() || way.back() != step.block) way.push_back(step.block);
      if (way.size() > 1 && way.front() == way.back()) way.pop_back();
      if (!is_algebraic(program_, loop)) {
        say(fmt::format("loop {} of blocks: {}; no output depends on itself", i + 1, around(paths(way))));
        continue;
      }
      ++algebraic;
      say(fmt::format("algebraic loop {} of {}: {}; solved at every evaluation for {}", i + 1,
                      loop.of_values() ? "values" : "rates", around(paths(way)), joined(tears_of(loop))));
    }
    if (algebraic == 0) say("algebraic: none; no output depends on itself at the same instant");
    const auto feedback = feedback_loops(program_);
    for (const auto& loop : feedback)
      if (!loop.opened_by.empty())
        say(fmt::format("feedback: {} ({} with a delay or through a state)", around(paths(loop.blocks)),
                        joined(paths(loop.opened_by)) +
                            (loop.opened_by.size() == 1 ? " follows its input" : " follow their inputs")));
    if (feedback.empty()) say("feedback: none");
  }

  void rates() {
    head("rates that are computed (exactly, by the chain rule)");
    TableRows rows;
    for (const auto& rate : needed_rates(program_))
      rows.push_back({"d/dt " + program_.signals[at(rate.signal)].path, "for " + joined(rate.asked_by)});
    if (rows.empty())
      say("none is needed");
    else
      show({}, rows);
  }

  // --- events --------------------------------------------------------------------------------------------------------

  void events() {
    head("events");
    TableRows rows;
    const auto add = [&](const char* what, const std::vector<std::string>& who, const char* how) {
      if (!who.empty()) rows.push_back({what, joined(who), how});
    };
    std::vector<std::string> breakpoints, late, jumping, noisy, following, modal, turning, silent;
    for (std::size_t b = 0; b < program_.blocks.size(); ++b) {
      const auto& one = program_.blocks[b];
      if (one.n_u == 0 && (one.kernel->next_breakpoint != nullptr || one.kernel->declaration.is_series))
        breakpoints.push_back(one.path);
      if (one.sizes.history) late.push_back(one.path);
      if (one.kernel->has_modes()) modal.push_back(one.path);
      bool jump = false;
      for (const int s : one.source) jump |= program_.signals[at(s)].smoothness == Smoothness::jumps;
      if (jump && (one.kernel->declaration.is_rate_independent || one.sizes.memory > 0)) following.push_back(one.path);
      if (one.sizes.memory > 0)
        for (const int s : one.source)
          (program_.has_rate[at(s)] ? turning : silent).push_back(one.path + " (" + program_.signals[at(s)].path + ")");
    }
    for (const auto& signal : program_.signals) {
      if (signal.smoothness == Smoothness::jumps) jumping.push_back(signal.path);
      if (signal.smoothness == Smoothness::no_rate) noisy.push_back(signal.path);
    }
    add("corners of sources", breakpoints, "known times: the solver stops there");
    add("dead times", late, "corners come again, later");
    add("signals that jump", jumping, "");
    add("followed as paths", following, "a jump is walked as the path of a fast ramp");
    add("signals without a rate", noisy, "");
    add("reversals located", turning, "where the input's rate changes its sign (a root)");
    add("reversals not located", silent, "the input has no rate; exact where it is held");
    add("modes", modal, "change where the guard falls through zero (a root)");
    if (rows.empty())
      say("none; every signal is smooth and no block remembers");
    else
      show({}, rows);
  }

  void clocks() {
    head("clocks");
    const auto clocks = clock_facts(program_);
    if (clocks.empty()) return say("none; no block is sampled");
    TableRows rows;
    for (const auto& clock : clocks)
      rows.push_back(
          {"every " + time_words(clock.period), "from " + time_words(clock.offset), joined(paths(clock.blocks))});
    show({}, rows);
    std::vector<std::string> taken, held;
    std::set<std::string> told;
    for (std::size_t b = 0; b < program_.blocks.size(); ++b)
      for (const int s : program_.blocks[b].source) {
        const auto& from = program_.blocks[at(program_.signals[at(s)].block)];
        const bool sampled = program_.blocks[b].kernel->is_sampled();
        if (sampled == from.kernel->is_sampled()) continue;
        auto text = program_.signals[at(s)].path + " for " + program_.blocks[b].path;
        if (told.insert(text).second) (sampled ? taken : held).push_back(std::move(text));
      }
    if (!taken.empty()) say("continuous signals read at instants: " + joined(taken));
    if (!held.empty()) say("held between instants: " + joined(held));
  }

  // --- solver --------------------------------------------------------------------------------------------------------

  void solver() {
    head("solver");
    const SolverWords words = solver_words(program_, run_);
    method_ = words.method;
    why_ = words.why;
    show({}, words.rows);
  }

  bool inputs_unbound() const { return !program_.input_names.empty(); }

  void states() {
    if (program_.n_x == 0) return;
    head("continuous states");
    TableRows rows;
    const auto sizes = inputs_unbound() ? NominalSizes{} : nominal_sizes(program_, run_);
    const auto options = simulate_options(program_);
    for (std::size_t i = 0; i < program_.state_names.size(); ++i) {
      std::vector<std::string> row{program_.state_names[i], number_text(run_.x[i])};
      if (i < sizes.states.size()) {
        row.push_back(number_text(sizes.states[i]));
        row.push_back(number_text(sizes.states[i] * options.relative_tolerance * options.absolute_tolerance));
      } else {
        row.insert(row.end(), {"by the recording", "by the recording"});
      }
      rows.push_back(std::move(row));
    }
    show({"state", "start [SI]", "nominal size [SI]", "absolute tolerance [SI]"}, rows);
  }

  // --- parameters ----------------------------------------------------------------------------------------------------

  void parameters() {
    head("parameters");
    TableRows rows;
    std::vector<std::vector<std::string>> names(program_.parameters.size());
    for (const auto& [name, i] : program_.parameter_names) names[at(i)].push_back(name);
    for (std::size_t i = 0; i < program_.parameters.size(); ++i) {
      const ParameterInfo& info = program_.parameters[i];
      const std::string value =
          info.difference ? difference_text(info.value, info.unit, 6) : quantity_text(info.value, info.unit, 6);
      rows.push_back({info.path, value, origin_text(info.origin) + used_as(info, names[i])});
    }
    if (rows.empty()) return say("none");
    show({"parameter", "value", "from"}, rows);
  }

  /// Of a diagram parameter: the places that read it, all of its `names` but the own one.
  static std::string used_as(const ParameterInfo& info, std::vector<std::string> places) {
    std::erase(places, info.path);
    return (places.empty() ? "" : "; read as " + joined(places)) + (info.free ? "; free for a fit" : "");
  }

  const Program& program_;
  const Diagram& diagram_;
  std::string file_;
  Run run_;
  std::string& text_;
  Document document_;
  std::string method_, why_;
};

/// What was said, for programs: sections of sentences and tables.
Facts::List section_facts(const Document& document) {
  Facts::List sections;
  for (const auto& section : document.sections) {
    Facts::List tables;
    for (const auto& table : section.tables) {
      Facts::List rows;
      for (const auto& row : table.rows) rows.emplace_back(row);
      tables.push_back(Facts::object({{"columns", table.columns}, {"rows", rows}}));
    }
    sections.push_back(Facts::object({{"title", section.title}, {"text", section.text}, {"tables", tables}}));
  }
  return sections;
}

Answer explain(const Arguments& arguments, const Watch& watch) {
  const Diagram diagram = load_diagram(arguments, watch);
  const ProgramPointer program = compile_file(diagram);
  Answer answer;
  behind(answer.text, [&] {
    with_lines_of(diagram, [&] {
      Explanation explanation(*program, diagram, arguments.text("diagram"), answer.text);
      answer.document = explanation();
      answer.facts = Facts::object({{"facts", explanation.facts()}, {"sections", section_facts(answer.document)}});
    });
  });
  if (!arguments.has("-o")) return answer;
  answer.text += "\n";
  answer.folder = arguments.text("-o");
  return answer;
}

std::vector<shape::Member> explain_shape() {
  const Facts table = shape::object("one table", {{"columns", shape::texts("their heads")},
                                                  {"rows", shape::list("cells as texts", shape::texts("one row"))}});
  const Facts section = shape::object("one part of it", {{"title", shape::text("what it is about")},
                                                         {"text", shape::texts("sentences")},
                                                         {"tables", shape::list("tables", table)}});
  const Facts facts = shape::object("in numbers", {{"diagram", shape::text("its file")},
                                                   {"blocks", shape::whole("how many")},
                                                   {"signals", shape::whole("how many")},
                                                   {"continuous_states", shape::whole("how many")},
                                                   {"parameters", shape::whole("how many")},
                                                   {"loops", shape::whole("algebraic ones")},
                                                   {"method", shape::text("of integration, as it would be taken")},
                                                   {"why", shape::text("this method")}});
  return shape::published({{"facts", facts}, {"sections", shape::list("what was made of the diagram", section)}},
                          shape::sometimes);
}

}  // namespace

Verb explain_verb() {
  return {"explain",
          "what the compiler made of a diagram",
          explain_help,
          {options::diagram(),
           {"-o", "FOLDER", "also write result.json and report.html into this folder", false, false},
           options::set(),
           options::choose(),
           options::allow()},
          explain,
          explain_shape};
}

}  // namespace hysteron
