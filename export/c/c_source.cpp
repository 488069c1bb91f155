#include "export/c/c_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "engine/diagram/error.h"
#include "engine/diagram/index.h"
#include "engine/diagram/time_text.h"

namespace hysteron {
namespace {

/// What a reader calls the SI unit of a dimension: "V", not the product of metres and kilograms that it is.
std::string si_name(const Dimension& dimension) {
  for (const char* name : {"V", "N", "Pa", "W", "ohm", "F", "H", "T", "Wb"})
    if (parse_unit(name).dimension == dimension) return name;
  return to_text(dimension);
}

using c_text::in_comment;
using c_text::indented;
using c_text::Names;

std::string bracketed(const std::string& unit) { return unit == "1" || unit.empty() ? "[-]" : "[" + unit + "]"; }

class Writing {
 public:
  Writing(const CPlan& plan, const CWish& wish) : plan_(plan), program_(*plan.program), wish_(wish) {}

  CSource operator()() {
    for (const auto& planned : plan_.blocks)
      for (const auto& f : planned.code.functions) reserve_function(f);
    for (const auto& planned : plan_.blocks)
      for (const std::string* text : {&planned.code.output, &planned.code.update}) reserve_locals(*text);
    if (plan_.before_jumps) members_.reserve("begun");
    ports();
    for (const auto& planned : plan_.blocks) name_outputs(planned);
    for (const auto& planned : plan_.blocks) write_block(planned);
    made_.header = header();
    made_.source = source();
    return std::move(made_);
  }

 private:
  // ---- names ----
  /// What a function's text defines is taken.
  void reserve_function(const std::string& text) {
    for (std::size_t at = text.find('('); at != std::string::npos; at = text.find('(', at + 1)) {
      std::size_t begin = at;
      while (begin > 0 && (std::isalnum(static_cast<unsigned char>(text[begin - 1])) != 0 || text[begin - 1] == '_'))
        --begin;
      if (begin < at) names_.reserve(text.substr(begin, at - begin));
    }
  }
  /// What statements declare for themselves, in lines such as "const double from = ..., to = ...;", is taken: an input
  /// of that name would be hidden.
  void reserve_locals(const std::string& text) {
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      std::string line = text.substr(begin, end - begin);
      begin = end + 1;
      if (line.starts_with("const ")) line.erase(0, 6);
      if (!line.starts_with("double ") && !line.starts_with("struct ")) continue;
      line.erase(0, line.starts_with("struct ") ? line.find(' ', 7) + 1 : 7);
      int depth = 0;
      bool name_follows = true;
      for (std::size_t at = 0; at < line.size(); ++at) {
        const char c = line[at];
        if (std::string("([{").find(c) != std::string::npos) ++depth;
        if (std::string(")]}").find(c) != std::string::npos) --depth;
        if (c == ',' && depth == 0) name_follows = true;
        if (!name_follows || std::isalpha(static_cast<unsigned char>(c)) == 0) continue;
        std::size_t last = at;
        while (last < line.size() && (std::isalnum(static_cast<unsigned char>(line[last])) != 0 || line[last] == '_'))
          ++last;
        names_.reserve(line.substr(at, last - at));
        at = last - 1;
        name_follows = false;
      }
    }
  }
  CPort port(int signal, const std::string& name, Names& own) {
    const SignalInfo& info = program_.signals[at(signal)];
    return {own.take(name), info.path, info.unit, si_name(info.dimension)};
  }
  void ports() {
    Names in, out;
    for (std::size_t i = 0; i < plan_.inputs.size(); ++i)
      made_.inputs.push_back(port(plan_.inputs[i], program_.input_names[i], in));
    for (std::size_t i = 0; i < plan_.outputs.size(); ++i)
      made_.outputs.push_back(port(plan_.outputs[i], program_.output_names[i], out));
    for (std::size_t i = 0; i < plan_.inputs.size(); ++i)
      variable_[plan_.inputs[i]] = names_.take(made_.inputs[i].name);
  }
  void name_outputs(const PlannedBlock& planned) {
    const BlockInstance& b = program_.blocks[at(planned.block)];
    block_name_[planned.block] = members_.take(b.path);
    for (int k = 0; k < b.sizes.outputs; ++k)
      variable_[b.y_begin + k] = names_.take(program_.signals[at(b.y_begin + k)].path);
  }

  // ---- numbers ----
  std::string literal(double value, const std::string& where) const {
    if (wish_.real == c_text::Real::float32 && std::isfinite(value) &&
        (std::fabs(value) > static_cast<double>(std::numeric_limits<float>::max()) ||
         (value != 0 && std::fabs(value) < static_cast<double>(std::numeric_limits<float>::min()))))
      fail("not_in_c", where, fmt::format("{:.6g} [SI] does not fit into a float", value),
           "write the code with --number float64, or give the block numbers nearer to one");
    return c_text::literal(wish_.real, value);
  }
  /// A table or a single number, once.
  std::string constant(const BlockInstance& b, const std::string& key, std::span<const double> values, bool single,
                       const std::string& comment) {
    const std::string known = b.path + "\n" + key;
    if (const auto found = constant_.find(known); found != constant_.end()) return found->second;
    const std::string name = names_.take(b.path + "_" + key);
    constant_[known] = name;
    std::string text = "static const double " + name;
    if (single) {
      text += " = " + literal(values.front(), b.path) + ";";
    } else {
      text += fmt::format("[{}] = {{", values.size());
      std::string list;
      for (const double value : values) list += (list.empty() ? "" : ", ") + literal(value, b.path);
      text += c_text::wrapped(list, "    ") + "};";
    }
    constants_ += text + " /* " + in_comment(comment) + " */\n";
    made_.constants += static_cast<long>(values.size());
    return name;
  }
  std::string parameter(const BlockInstance& b, const View<double>& v, const std::string& name) {
    const int i = b.shape.declaration->parameter_index(name);
    const auto& declared = b.shape.declaration->parameters[at(i)];
    const bool single = declared.kind == ParameterKind::number;
    const ParameterInfo* info = program_.find_parameter(b.path + "." + name);
    if (info == nullptr)
      info = program_.find_parameter(b.path + "." + name + (declared.kind == ParameterKind::matrix ? "[0][0]" : "[0]"));
    const std::string unit = info == nullptr ? "" : bracketed(si_name(info->unit.dimension)) + " ";
    return constant(b, name, v.list(i), single, unit + declared.meaning);
  }

  // ---- states ----
  struct Members {
    std::string declared;  ///< inside of the struct
    std::string begun;     ///< statements of the start
  };
  static int states_of(const BlockInstance& b) { return b.sizes.sampled_states + b.sizes.memory; }
  void member(const BlockInstance& b, const std::string& block, const std::string& name, std::span<const double> begin,
              bool table, const std::string& comment) {
    if (!member_.insert(block + "." + name).second) return;
    Members& m = members_of_[block];
    m.declared += "        double " + name + (table ? fmt::format("[{}]", begin.size()) : "") + "; /* " +
                  in_comment(comment) + " */\n";
    const std::string place = "s->" + block + "." + name;
    const bool same = std::all_of(begin.begin(), begin.end(), [&](double x) { return x == begin.front(); });
    if (!table) {
      m.begun += "    " + place + " = " + literal(begin.front(), b.path) + ";\n";
    } else if (same) {
      m.begun += fmt::format("    for (i = 0; i < {}; ++i)\n        {}[i] = {};\n", begin.size(), place,
                             literal(begin.front(), b.path));
      loops_at_start_ = true;
    } else {
      const std::string from = constant(b, name + "_at_start", begin, false, "at the start");
      m.begun += fmt::format("    for (i = 0; i < {}; ++i)\n        {}[i] = {}[i];\n", begin.size(), place, from);
      loops_at_start_ = true;
    }
    made_.state_numbers += static_cast<long>(begin.size());
  }
  /// The numbers that a block remembers, as they are at the start.
  std::span<const double> remembered(const BlockInstance& b) const {
    return {plan_.begin.m.data() + b.m_begin, at(states_of(b))};
  }
  std::string state(const BlockInstance& b, const std::string& block, const std::string& name) {
    const auto& d = *b.shape.declaration;
    for (std::size_t i = 0; i < d.states.size(); ++i)
      if (d.states[i].name == name) {
        member(b, block, name, remembered(b).subspan(i, 1), false, d.states[i].meaning);
        return "s->" + block + "." + name;
      }
    for (std::size_t i = 0; i < d.memory_names.size(); ++i)
      if (d.memory_names[i] == name) {
        member(b, block, name, remembered(b).subspan(i, 1), false, "as the last step left it");
        return "s->" + block + "." + name;
      }
    throw std::logic_error("in C, " + b.path + " has no state " + name);
  }

  // ---- statements ----
  std::string filled(const std::string& text, const PlannedBlock& planned) {
    const BlockInstance& b = program_.blocks[at(planned.block)];
    const std::string& block = block_name_.at(planned.block);
    const View<double> v = view_of(program_, plan_.begin, planned.block);
    return c_text::filled(text, [&](const std::string& kind, const std::string& name) -> std::string {
      if (kind == "in") return input(b, name);
      if (kind == "out") return variable_.at(b.y_begin + place(name, b.shape.declaration->output_names()));
      if (kind == "p") return parameter(b, v, name);
      if (kind == "s") return state(b, block, name);
      if (kind == "x") {
        member(b, block, b.sizes.memory > 0 ? "w" : "x", remembered(b), true,
               b.sizes.memory > 0 ? "what the last step left behind" : "states");
        return fmt::format("s->{}.{}", block, b.sizes.memory > 0 ? "w" : "x");
      }
      for (const auto& table : planned.code.tables) {
        if (table.name != name) continue;
        if (kind == "n") return std::to_string(table.values.size());
        if (kind == "t") return constant(b, name, table.values, false, table.meaning);
      }
      if (kind == "n") return std::to_string(v.list(b.shape.declaration->parameter_index(name)).size());
      throw std::logic_error("in C, " + b.path + " has no $" + kind + "." + name);
    });
  }
  static int place(const std::string& name, const std::vector<std::string>& names) {
    if (std::isdigit(static_cast<unsigned char>(name.front())) != 0) return std::stoi(name);
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? 0 : static_cast<int>(found - names.begin());
  }
  std::string input(const BlockInstance& b, const std::string& name) {
    const int signal = b.source[at(place(name, b.shape.declaration->input_names()))];
    used_.insert(signal);
    return variable_.at(signal);
  }

  struct Statements {
    int block = -1;
    std::string output, update;
    bool single = false;  ///< one statement that gives the only output
  };
  void write_block(const PlannedBlock& planned) {
    const BlockInstance& b = program_.blocks[at(planned.block)];
    Statements w;
    w.block = planned.block;
    const std::string& text = planned.code.output;
    w.single = b.sizes.outputs == 1 && text.starts_with("$out.") && text.find('\n') == std::string::npos &&
               planned.every == 1 && planned.first == 0 && !is_held(planned);
    w.output = filled(text, planned);
    w.update = filled(planned.code.update, planned);
    if (is_held(planned)) hold(b, planned, w);
    for (const auto& f : planned.code.functions)
      if (std::find(functions_.begin(), functions_.end(), f) == functions_.end()) functions_.push_back(f);
    written_.push_back(std::move(w));
  }
  bool is_sampled(const PlannedBlock& planned) const { return program_.blocks[at(planned.block)].kernel->is_sampled(); }
  static bool runs_always(const PlannedBlock& planned) { return planned.every == 1 && planned.first == 0; }
  bool is_held(const PlannedBlock& planned) const {
    return !runs_always(planned) || (planned.before_jumps && is_sampled(planned));
  }
  /// A block that does not run at every step holds its outputs between; what memory sees before a jump are the last
  /// ones.
  void hold(const BlockInstance& b, const PlannedBlock& planned, Statements& w) {
    const std::string& block = block_name_.at(planned.block);
    Members& m = members_of_[block];
    const bool waits = !runs_always(planned);
    if (waits) {
      m.declared += "        unsigned long wait; /* steps until it runs again */\n";
      m.begun += fmt::format("    s->{}.wait = {};\n", block, planned.first);
    }
    const std::span<const double> held{plan_.begin.m.data() + b.held_begin(), at(b.sizes.outputs)};
    member(b, block, "held", held, true, "outputs until it runs again");
    std::string keep, take;
    for (int k = 0; k < b.sizes.outputs; ++k) {
      const std::string& y = variable_.at(b.y_begin + k);
      keep += fmt::format("\ns->{}.held[{}] = {};", block, k, y);
      take += fmt::format("\n{} = s->{}.held[{}];", y, block, k);
    }
    if (!waits) {
      w.output += keep;
      return;
    }
    w.output = fmt::format("if (s->{}.wait == 0) {{\n{}\n}} else {{{}\n}}", block, indented(w.output + keep, 4),
                           indented(take, 4));
    const std::string run = w.update.empty() ? "" : indented(w.update, 4) + "\n";
    w.update = fmt::format("if (s->{0}.wait == 0) {{\n{1}    s->{0}.wait = {2};\n}}\n--s->{0}.wait;", block, run,
                           planned.every);
  }

  // ---- files ----
  std::string opening(const std::string& file) const {
    std::string text = fmt::format("{}: written by hysteron", file);
    if (!wish_.from.empty()) text += " from " + wish_.from;
    if (!program_.title.empty()) text += ", \"" + program_.title + "\"";
    text += ". All numbers are in SI: metre, second, volt, kelvin.";
    return "/* " + c_text::wrapped(in_comment(text), "   ") + " */\n";
  }
  std::string upper() const {
    std::string text = c_text::identifier(wish_.name);
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
    return text;
  }
  static std::string struct_of_ports(const std::string& type, const std::vector<CPort>& ports) {
    std::string text = "typedef struct {\n";
    for (const auto& p : ports)
      text += fmt::format("    double {}; /* {}{} */\n", p.name, bracketed(p.si_unit),
                          in_comment(p.signal == p.name ? "" : ", in the diagram: " + p.signal));
    if (ports.empty()) text += "    char none;\n";
    return text + "} " + type + ";\n\n";
  }
  std::string header() const {
    const std::string n = c_text::identifier(wish_.name), guard = upper() + "_H";
    std::string text = opening(n + ".h") + "#ifndef " + guard + "\n#define " + guard + "\n\n";
    if (plan_.period > 0)
      text += fmt::format("/* [s] from one call of {}_step to the next: {} */\n#define {}_PERIOD {}\n\n", n,
                          time_text(plan_.period), upper(), c_text::literal(wish_.real, plan_.period));
    text += struct_of_ports(n + "_input", made_.inputs) + struct_of_ports(n + "_output", made_.outputs);
    text += "/* What is remembered from step to step; it belongs to the caller. */\ntypedef struct {\n";
    for (const auto& [block, m] : members_of_) text += "    struct {\n" + m.declared + "    } " + block + ";\n";
    if (plan_.before_jumps) text += "    int begun; /* 0 before the first step */\n";
    if (members_of_.empty()) text += "    char none;\n";
    text += "} " + n + "_state;\n\n";
    text += fmt::format(
        "/* Before the first step, and whenever all is to begin anew. */\nvoid {0}_start({0}_state *s);\n\n"
        "/* One step: outputs for these inputs. Reads and writes nothing but its arguments. */\n"
        "void {0}_step({0}_state *s, const {0}_input *in, {0}_output *out);\n\n#endif\n",
        n);
    return c_text::in_numbers(wish_.real, text);
  }
  std::string body() {
    std::string text;
    for (int i = 0; i < static_cast<int>(plan_.outputs.size()); ++i) used_.insert(plan_.outputs[at(i)]);
    for (std::size_t i = 0; i < plan_.inputs.size(); ++i)
      if (used_.contains(plan_.inputs[i]))
        text += fmt::format("    const double {} = in->{}; /* {} */\n", variable_.at(plan_.inputs[i]),
                            made_.inputs[i].name, bracketed(made_.inputs[i].si_unit));
    if (plan_.before_jumps) text += before_jumps();
    for (const auto& w : written_) {
      const BlockInstance& b = program_.blocks[at(w.block)];
      text += fmt::format("\n    /* {}: {}: {} */\n", in_comment(b.path), b.kernel->declaration.type,
                          in_comment(b.kernel->declaration.summary));
      text += w.single ? "    const double " + w.output + unit_behind(b.y_begin) : declared(b) + braced(w.output);
      for (int k = 0; k < b.sizes.outputs; ++k)
        if (!used_.contains(b.y_begin + k)) text += fmt::format("    (void){};\n", variable_.at(b.y_begin + k));
    }
    text += "\n";
    for (std::size_t i = 0; i < plan_.outputs.size(); ++i)
      text += fmt::format("    out->{} = {};\n", made_.outputs[i].name, variable_.at(plan_.outputs[i]));
    bool first = true;
    for (const auto& w : written_) {
      if (w.update.empty()) continue;
      if (first) text += "\n    /* what the next step begins with */\n";
      first = false;
      text += braced(w.update);
    }
    return text;
  }
  /// What memory sees where the inputs have moved and what is sampled has not jumped yet.
  std::string before_jumps() const {
    std::set<int> read;
    for (const auto& planned : plan_.blocks)
      if (planned.before_jumps && !is_sampled(planned))
        read.insert(program_.blocks[at(planned.block)].source.begin(), program_.blocks[at(planned.block)].source.end());
    std::string inside;
    for (std::size_t i = 0; i < plan_.blocks.size(); ++i) {
      if (!plan_.blocks[i].before_jumps) continue;
      const BlockInstance& b = program_.blocks[at(plan_.blocks[i].block)];
      const Statements& w = written_[i];
      if (is_sampled(plan_.blocks[i])) {
        for (int k = 0; k < b.sizes.outputs; ++k)
          if (read.contains(b.y_begin + k))
            inside += fmt::format("    const double {} = s->{}.held[{}];\n", variable_.at(b.y_begin + k),
                                  block_name_.at(w.block), k);
        continue;
      }
      inside += w.single ? "    const double " + w.output + "\n" : declared(b) + braced(w.output);
      for (int k = 0; k < b.sizes.outputs; ++k)
        if (!read.contains(b.y_begin + k)) inside += fmt::format("    (void){};\n", variable_.at(b.y_begin + k));
    }
    return "\n    /* The inputs have moved, and what is sampled has not jumped yet: memory follows up to here. */\n"
           "    if (s->begun) {\n" +
           indented(inside, 4) + (inside.ends_with('\n') ? "" : "\n") + "    }\n    s->begun = 1;\n";
  }
  std::string unit_behind(int signal) const {
    return fmt::format(" /* {} */\n", bracketed(si_name(program_.signals[at(signal)].dimension)));
  }
  std::string declared(const BlockInstance& b) const {
    std::string text;
    for (int k = 0; k < b.sizes.outputs; ++k)
      text += "    double " + variable_.at(b.y_begin + k) + ";" + unit_behind(b.y_begin + k);
    return text;
  }
  /// Statements that declare something stand in braces of their own.
  static std::string braced(const std::string& statements) {
    const bool declares = statements.find("const ") != std::string::npos || statements.starts_with("double ");
    if (!declares) return indented(statements, 4) + (statements.ends_with('\n') ? "" : "\n");
    return "    {\n" + indented(statements, 8) + (statements.ends_with('\n') ? "" : "\n") + "    }\n";
  }
  std::string source() {
    const std::string n = c_text::identifier(wish_.name);
    const std::string step = body();
    std::string functions, starts;
    for (const auto& f : functions_) functions += f + "\n";
    for (const auto& [block, m] : members_of_) starts += m.begun;
    if (plan_.before_jumps) starts += "    s->begun = 0;\n";
    std::string text = opening(n + ".c") + "#include \"" + n + ".h\"\n\n";
    text += "#include <float.h>\n#include <math.h>\n\n";
    if (!constants_.empty()) text += "/* Numbers of the blocks [SI]. */\n" + constants_ + "\n";
    text += functions;
    text += fmt::format("void {0}_start({0}_state *s)\n{{\n", n);
    if (loops_at_start_) text += "    int i;\n";
    text += starts.empty() ? "    s->none = 0;\n" : starts;
    text += fmt::format("}}\n\nvoid {0}_step({0}_state *s, const {0}_input *in, {0}_output *out)\n{{\n", n);
    if (step.find("in->") == std::string::npos) text += "    (void)in;\n";
    if (step.find("s->") == std::string::npos) text += "    (void)s;\n";
    return c_text::in_numbers(wish_.real, text + step + "}\n");
  }

  const CPlan& plan_;
  const Program& program_;
  const CWish& wish_;
  CSource made_;
  Names names_, members_;
  std::map<int, std::string> variable_, block_name_;
  std::map<std::string, std::string> constant_;
  std::map<std::string, Members> members_of_;
  std::set<std::string> member_;
  std::set<int> used_;
  std::vector<std::string> functions_;
  std::vector<Statements> written_;
  std::string constants_;
  bool loops_at_start_ = false;
};

}  // namespace

CSource c_source(const CPlan& plan, const CWish& wish) { return Writing(plan, wish)(); }

}  // namespace hysteron
