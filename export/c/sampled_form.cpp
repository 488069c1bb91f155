#include "export/c/sampled_form.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <memory>
#include <unsupported/Eigen/MatrixFunctions>

#include "blocks/c_laws.h"
#include "export/c/linear_block.h"

namespace hysteron {
namespace {

using Matrix = Eigen::MatrixXd;

/// x becomes A x + B u, y = C x + D u.
struct Stepped {
  Matrix a, b, c, d;
};

/// From instant to instant; see the header.
Stepped sampled(const LinearBlock& l, double period, BetweenSteps between) {
  const Eigen::Index n = l.a.rows(), m = l.b.cols();
  // e^(M T) of [A B 0; 0 0 1/T; 0 0 0] holds F, the whole integral, and G1 (Van Loan, IEEE Trans. Autom. Control 23
  // (1978) 395-404).
  Matrix all = Matrix::Zero(n + 2 * m, n + 2 * m);
  all.topLeftCorner(n, n) = l.a * period;
  all.block(0, n, n, m) = l.b * period;
  all.block(n, n + m, m, m) = Matrix::Identity(m, m);
  const Matrix e = all.exp();
  const Matrix f = e.topLeftCorner(n, n), whole = e.block(0, n, n, m), g1 = e.block(0, n + m, n, m);
  if (between == BetweenSteps::held) return {f, whole, l.c, l.d};
  return {f, whole - g1 + f * g1, l.c, l.d + l.c * g1};
}

/// Both, neither of which sees anything of the other.
Stepped side_by_side(const Stepped& one, const Stepped& other) {
  const auto joined = [](const Matrix& p, const Matrix& q) {
    Matrix all = Matrix::Zero(p.rows() + q.rows(), p.cols() + q.cols());
    all.topLeftCorner(p.rows(), p.cols()) = p;
    all.bottomRightCorner(q.rows(), q.cols()) = q;
    return all;
  };
  return {joined(one.a, other.a), joined(one.b, other.b), joined(one.c, other.c), joined(one.d, other.d)};
}

class Replacing {
 public:
  Replacing(const Program& program, const Registry& registry, double period, BetweenSteps between)
      : program_(program), run_(start(program)), registry_(registry), period_(period), between_(between) {}

  void in(Diagram& diagram, const std::string& path) {
    for (auto& [name, node] : diagram.blocks) in(node, path + name);
  }
  std::vector<std::string> replaced;

 private:
  void in(Node& node, const std::string& path) {
    if (!node.from.empty()) {
      if (Node* used = node.from.find(node.choose)) in_leaf(*used, node.in, path);
      return;
    }
    in_leaf(node, node.in, path);
  }
  void in_leaf(Node& node, std::vector<Wire>& wires, const std::string& path) {
    if (node.nested) {
      auto own = std::make_shared<Diagram>(*node.nested);
      in(*own, path + "/");
      node.nested = std::move(own);
      return;
    }
    const Kernel* kernel = registry_.find(node.type);
    const std::vector<int> elements = elements_of(path);
    if (kernel == nullptr || elements.empty()) return;
    const BlockInstance& b = program_.blocks[static_cast<std::size_t>(elements.front())];
    if (b.sizes.states == 0) return;
    const CLaw* law = find_c_law(node.type);
    if (law != nullptr && !law->sampled_type.empty())
      to_type(node, law->sampled_type, path);
    else if (is_linear_block(b) && wires.size() == 1 && has_one_output(b))
      to_matrices(node, wires, elements, path);
  }
  /// The blocks of the program that a node is: one, or one per element of the vector on which it works.
  std::vector<int> elements_of(const std::string& path) const {
    if (const int block = program_.block_index(path); block >= 0) return {block};
    std::vector<int> blocks;
    for (int block = 0; block >= 0;) {
      block = program_.block_index(fmt::format("{}[{}]", path, blocks.size()));
      if (block >= 0) blocks.push_back(block);
    }
    return blocks;
  }
  void to_type(Node& node, const std::string& type, const std::string& path) {
    replaced.push_back(fmt::format("{}: {} as {}", path, node.type, type));
    node.type = type;
    node.parameters["period"] = Number{period_, "s"};
  }

  static bool has_one_output(const BlockInstance& b) {
    const auto& outputs = b.kernel->declaration.outputs;
    return outputs.size() == 1 && outputs.front().name == "y";
  }
  std::string units(const std::vector<int>& signals) const {
    std::string text;
    for (const int s : signals) {
      if (!text.empty()) text += ", ";
      text += si_unit(program_.signals[static_cast<std::size_t>(s)].dimension).text;
    }
    return text;
  }
  /// Elements stand side by side in the matrices: what is outside of their squares is zero.
  void to_matrices(Node& node, std::vector<Wire>& wires, const std::vector<int>& elements, const std::string& path) {
    Stepped l;
    std::vector<int> inputs, outputs;
    NumberList initial;
    for (const int block : elements) {
      const LinearBlock linear = linear_block(program_, run_, block);
      if (!linear.rests || !linear.y0.isZero(0)) return;  // something besides its input moves it
      l = side_by_side(l, sampled(linear, period_, between_));
      const BlockInstance& b = program_.blocks[static_cast<std::size_t>(block)];
      inputs.insert(inputs.end(), b.source.begin(), b.source.end());
      for (int k = 0; k < b.sizes.outputs; ++k) outputs.push_back(b.y_begin + k);
      for (int k = 0; k < b.sizes.states; ++k) initial.push_back({run_.x[static_cast<std::size_t>(b.x_begin + k)], {}});
    }
    replaced.push_back(fmt::format("{}: {} as matrices from step to step, its input {} between them", path, node.type,
                                   between_ == BetweenSteps::straight ? "straight" : "held"));
    node.type = "discrete_state_space";
    node.parameters = {};
    node.parameters_from_file = {};
    node.parameter_file.clear();
    node.parameters["a"] = written_matrix(l.a);
    node.parameters["b"] = written_matrix(l.b);
    node.parameters["c"] = written_matrix(l.c);
    if (!l.d.isZero(0)) node.parameters["d"] = written_matrix(l.d);
    node.parameters["initial"] = initial;
    node.parameters["input_unit"] = units(inputs);
    node.parameters["output_unit"] = units(outputs);
    node.parameters["period"] = Number{period_, "s"};
    wires.front().port.clear();
  }

  const Program& program_;
  const Run run_;
  const Registry& registry_;
  double period_;
  BetweenSteps between_;
};

}  // namespace

SampledForm sampled_form(const Diagram& diagram, const Program& program, const Registry& registry, double period,
                         BetweenSteps between) {
  SampledForm form{diagram, {}};
  Replacing replacing(program, registry, period, between);
  replacing.in(form.diagram, "");
  form.replaced = std::move(replacing.replaced);
  return form;
}

}  // namespace hysteron
