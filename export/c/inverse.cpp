#include "export/c/inverse.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>

#include "blocks/c_laws.h"
#include "engine/diagram/error.h"
#include "engine/diagram/index.h"
#include "engine/program/names.h"
#include "export/c/linear_block.h"

namespace hysteron {
namespace {

std::string source_block(const std::string& wire) { return wire.substr(0, wire.find_first_of(".[")); }

class Inverting {
 public:
  Inverting(const Diagram& model, const Program& program, const Registry& registry)
      : model_(model), program_(program), run_(start(program)), registry_(registry) {}

  InverseDiagram operator()(const std::string& input) {
    input_ = the_input(input);
    if (model_.outputs.size() != 1)
      fail("no_inverse", "/outputs", fmt::format("the model has {} outputs", model_.outputs.size()),
           "name the one that is to follow: --to SIGNAL");
    find_dependent();
    const auto& [output, signal] = *model_.outputs.begin();
    wanted_ = output;
    while (model_.blocks.find(wanted_) != nullptr || (wanted_ != input_ && model_.inputs.find(wanted_) != nullptr))
      wanted_ += "_wanted";
    made_.diagram.title = model_.title.empty() ? "inverse" : "Inverse: " + model_.title;
    made_.diagram.file = model_.file;
    made_.diagram.parameters = model_.parameters;
    DiagramInput as{};
    as.unit = program_.signals[at(program_.output_signals.front())].unit.text;
    made_.diagram.inputs[wanted_] = as;
    made_.inputs.push_back(output);
    walk(signal);
    problems_.throw_if_any();
    return std::move(made_);
  }

 private:
  std::string the_input(const std::string& input) const {
    if (!input.empty()) return input;
    if (model_.inputs.size() == 1) return model_.inputs.begin()->first;
    fail("no_inverse", "/inputs", fmt::format("the model has {} inputs", model_.inputs.size()),
         "name the one that is to be worked out: --from u");
  }
  static const Node& body(const Node& node) {
    const Node* used = node.from.empty() ? &node : node.from.find(node.choose);
    return used == nullptr ? node : *used;
  }
  /// Blocks that the input moves.
  void find_dependent() {
    dependent_.insert(input_);
    for (bool grew = true; grew;) {
      grew = false;
      for (const auto& [name, node] : model_.blocks)
        for (const auto& wire : node.in)
          if (dependent_.contains(source_block(wire.from))) grew = dependent_.insert(name).second || grew;
    }
  }
  void refuse(const std::string& block, const std::string& what, const std::string& cure) {
    problems_.add("no_inverse", block, fmt::format("{} ({}) {}", block, type_of(block), what), cure);
  }
  std::string type_of(const std::string& block) const {
    const Node* node = model_.blocks.find(block);
    return node == nullptr ? "input" : body(*node).type;
  }

  /// From the output back: what is wanted of each block is `now`.
  void walk(std::string signal) {
    std::string now = wanted_;
    std::set<std::string> seen;
    while (signal != input_) {
      const std::string name = source_block(signal);
      const Node* node = model_.blocks.find(name);
      if (node == nullptr || !dependent_.contains(name)) {
        problems_.add("no_inverse", name, fmt::format("the input \"{}\" does not move \"{}\"", input_, signal),
                      "name the input that does: --from SIGNAL");
        return;
      }
      if (!seen.insert(name).second) {
        refuse(name, "stands in a loop", "name a signal before the loop as what is to follow: --to SIGNAL");
        return;
      }
      const int main = main_wire(name, *node);
      if (main < 0) return;
      undo(name, body(*node), node->in, at(main), now);
      now = name;
      signal = node->in[at(main)].from;
    }
    made_.diagram.outputs[input_] = now;
  }

  int main_wire(const std::string& name, const Node& node) {
    int main = -1;
    for (std::size_t i = 0; i < node.in.size(); ++i) {
      if (!dependent_.contains(source_block(node.in[i].from))) continue;
      if (main >= 0) {
        refuse(
            name, fmt::format("sees the input \"{}\" on more than one way", input_),
            "fit a model in which one law stands behind the other, such as a prandtl_ishlinskii with more operators");
        return -1;
      }
      main = static_cast<int>(i);
    }
    return main;
  }

  void undo(const std::string& name, const Node& used, const std::vector<Wire>& wires, std::size_t main,
            const std::string& now) {
    const int block = program_.block_index(name);
    if (used.nested || block < 0) {
      refuse(name, "is a diagram of its own or a vector", "write what stands in it into the outermost diagram");
      return;
    }
    const CLaw* law = find_c_law(used.type);
    const BlockInstance& b = program_.blocks[at(block)];
    if (law != nullptr && !law->inverse_type.empty())
      undo_by_type(name, used, wires, main, now, law->inverse_type);
    else if (used.type == "sum")
      undo_sum(name, wires, main, now, b);
    else if (is_linear_block(b) && wires.size() == 1)
      undo_linear(name, now, b, block);
    else
      refuse(name, "has no inverse here",
             "name a signal behind it as the input or before it as the output: --from, --to");
  }

  /// Wires in the order of the ports, with `now` in place of the one that the input moves; the others are taken along.
  std::vector<Wire> wires_with(const std::vector<Wire>& wires, std::size_t main, const std::string& now,
                               const Kernel* kernel) {
    std::vector<Wire> made(wires.size());
    for (std::size_t i = 0; i < wires.size(); ++i) {
      std::size_t place = i;
      if (!wires[i].port.empty() && kernel != nullptr) {
        const auto names = kernel->declaration.input_names();
        const auto found = std::find(names.begin(), names.end(), wires[i].port) - names.begin();
        if (static_cast<std::size_t>(found) < made.size()) place = static_cast<std::size_t>(found);
      }
      made[place].from = i == main ? now : wires[i].from;
      if (i != main) take_along(wires[i].from);
    }
    return made;
  }
  /// A signal that the input does not move, and all that it is made of.
  void take_along(const std::string& wire) {
    const std::string name = source_block(wire);
    if (const DiagramInput* input = model_.inputs.find(name)) {
      if (made_.diagram.inputs.find(name) == nullptr) made_.inputs.push_back(name);
      made_.diagram.inputs[name] = *input;
      return;
    }
    const Node* node = model_.blocks.find(name);
    if (node == nullptr || made_.diagram.blocks.find(name) != nullptr) return;
    made_.diagram.blocks[name] = *node;
    for (const auto& further : node->in) take_along(further.from);
  }

  void undo_by_type(const std::string& name, const Node& used, const std::vector<Wire>& wires, std::size_t main,
                    const std::string& now, const std::string& type) {
    const Kernel* kernel = registry_.find(type);
    const auto names = kernel->declaration.parameter_names();
    const auto& settings = model_.simulate;
    if (settings.past.find(name) != nullptr) {
      refuse(name, "is given a past, of which the inverse cannot know what was wanted then",
             "give its \"memory\", or the parameter \"before\", in place of \"past\"");
      return;
    }
    Node made;
    made.type = type;
    made.origin = used.origin;
    const auto copy = [&](const Ordered<Value>& values) {
      for (const auto& [key, value] : values)
        if (std::find(names.begin(), names.end(), key) != names.end() && made.parameters.find(key) == nullptr)
          made.parameters[key] = value;
    };
    copy(used.parameters);
    copy(used.parameters_from_file);
    if (made.parameters.find("initial") != nullptr && used.type != "bouc_wen") made.parameters.erase("initial");
    made.in = wires_with(wires, main, now, registry_.find(used.type));
    if (const NumberList* memory = settings.memory.find(name)) made_.diagram.simulate.memory[name] = *memory;
    if (kernel->is_sampled()) sampled_.push_back(name);
    made_.diagram.blocks[name] = std::move(made);
  }

  /// y = s main + others: main = s y - s others.
  void undo_sum(const std::string& name, const std::vector<Wire>& wires, std::size_t main, const std::string& now,
                const BlockInstance& b) {
    const View<double> v = view_of(program_, run_, program_.block_index(name));
    const auto written = v.list(b.shape.declaration->parameter_index("signs"));
    const auto minus = [&](std::size_t i) { return !written.empty() && written[i] == '-'; };
    Node made;
    made.type = "sum";
    std::string signs = minus(main) ? "-" : "+";
    made.in.push_back({"", now});
    for (std::size_t i = 0; i < wires.size(); ++i) {
      if (i == main) continue;
      signs += minus(main) == minus(i) ? "-" : "+";
      made.in.push_back({"", wires[i].from});
      take_along(wires[i].from);
    }
    made.parameters["signs"] = signs;
    made_.diagram.blocks[name] = std::move(made);
  }

  const Dimension& dimension(int signal) const { return program_.signals[at(signal)].dimension; }
  static std::string unit_of(const Dimension& d) { return d.none() ? "" : si_unit(d).text; }

  void undo_linear(const std::string& name, const std::string& now, const BlockInstance& b, int block) {
    const LinearBlock l = linear_block(program_, run_, block);
    if (b.sizes.outputs != 1 || !l.rests) {
      refuse(name, "has no inverse here", "name a signal before it as what is to follow: --to SIGNAL");
      return;
    }
    const double direct = l.d(0, 0);
    if (b.sizes.states > 0 && direct != 0) return undo_dynamics(name, now, b, l);
    double gain = direct;
    if (b.sizes.states > 0) {
      gain = gain_at_rest(b, block) - l.y0(0);
      made_.told.push_back(fmt::format("{} ({}): only its gain at rest is undone", name, type_of(name)));
    }
    if (!(std::fabs(gain) > 0) || !std::isfinite(gain)) {
      refuse(name, "passes nothing on at rest, or integrates",
             "name a signal before it as what is to follow: --to SIGNAL");
      return;
    }
    const Dimension& in = dimension(b.source.front());
    const Dimension& out = dimension(b.y_begin);
    Node made;
    made.type = l.y0(0) == 0 ? "gain" : "calibration";
    made.in = {{"", now}};
    made.parameters["gain"] = Number{1 / gain, unit_of(in / out)};
    if (l.y0(0) != 0) made.parameters["offset"] = Number{-l.y0(0) / gain, unit_of(in)};
    made_.diagram.blocks[name] = std::move(made);
  }
  /// Output for the input 1 once all has settled; not a number where it does not.
  double gain_at_rest(const BlockInstance& b, int block) const {
    if (b.kernel->rest == nullptr) return std::nan("");
    View<double> v = view_of(program_, run_, block);
    const double one = 1;
    std::vector<double> x(at(b.sizes.states)), y(1);
    v.u = &one;
    v.x = x.data();
    std::vector<double> settled(x.size());
    v.out = settled.data();
    b.kernel->rest(v);
    v.x = settled.data();
    v.out = y.data();
    b.kernel->output(v);
    return y[0];
  }
  /// x' = (A - B D^-1 C) x + B D^-1 y, u = D^-1 (y - C x).
  void undo_dynamics(const std::string& name, const std::string& now, const BlockInstance& b, const LinearBlock& l) {
    const double d = l.d(0, 0);
    const Eigen::MatrixXd a = l.a - l.b * l.c / d, in = l.b / d, out = -l.c / d;
    if ((a.eigenvalues().real().array() > 0).any()) {
      refuse(name, "has an inverse that is not stable", "name a signal before it as what is to follow: --to SIGNAL");
      return;
    }
    if (l.y0(0) != 0) {
      refuse(name, "has an offset besides its dynamics", "put the offset into a calibration behind it");
      return;
    }
    Node made;
    made.type = "state_space";
    made.in = {{"", now}};
    made.parameters["a"] = written_matrix(a);
    made.parameters["b"] = written_matrix(in);
    made.parameters["c"] = written_matrix(out);
    made.parameters["d"] = NumberMatrix{{{{1 / d, {}}}}};
    made.parameters["input_unit"] = unit_of(dimension(b.y_begin));
    made.parameters["output_unit"] = unit_of(dimension(b.source.front()));
    made_.diagram.blocks[name] = std::move(made);
  }

 public:
  /// Blocks that run at instants, of which nothing says yet how often.
  const std::vector<std::string>& sampled() const { return sampled_; }

 private:
  const Diagram& model_;
  const Program& program_;
  const Run run_;
  const Registry& registry_;
  std::string input_, wanted_;
  std::set<std::string> dependent_;
  InverseDiagram made_;
  std::vector<std::string> sampled_;
  Problems problems_;
};

}  // namespace

InverseDiagram inverse_diagram(const Diagram& model, const Program& program, const Registry& registry,
                               const std::string& input, double period) {
  Inverting inverting(model, program, registry);
  InverseDiagram made = inverting(input);
  for (const auto& name : inverting.sampled()) {
    if (period <= 0)
      fail("no_rate", name, fmt::format("the inverse of {} runs at instants, and nothing says how often", name),
           "say it: --rate \"10 kHz\"");
    made.diagram.blocks.find(name)->parameters["period"] = Number{period, "s"};
  }
  return made;
}

}  // namespace hysteron
