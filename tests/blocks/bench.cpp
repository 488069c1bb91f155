#include "tests/blocks/bench.h"

#include <stdexcept>

#include "blocks/register_all.h"
#include "engine/diagram/units.h"

namespace hysteron::bench {

const Registry& registry() {
  static const Registry all = all_blocks();
  return all;
}

const Kernel& kernel_of(const std::string& type) {
  const Kernel* k = registry().find(type);
  if (k == nullptr) throw std::logic_error("no block " + type);
  return *k;
}

Duals dual(const Numbers& value, const Numbers& rate) {
  Duals d;
  for (std::size_t i = 0; i < value.size(); ++i) d.push_back({value[i], rate.empty() ? 0 : rate[i]});
  return d;
}

Numbers rates(const Duals& d) {
  Numbers r;
  for (const Dual& x : d) r.push_back(x.rate);
  return r;
}

Numbers moved(const Numbers& a, const Numbers& direction, double h) {
  Numbers b = a;
  for (std::size_t i = 0; i < b.size(); ++i) b[i] += h * direction[i];
  return b;
}

template <class T>
View<T> Bench::view(const std::vector<T>& parameters, const std::vector<T>& u, const std::vector<T>& x,
                    const std::vector<T>& m, T t, double branch) const {
  View<T> v;
  v.p = parameters.data();
  v.p_at = p_at.data();
  v.c = c.data();
  v.n_c = sizes.constants;
  v.x = x.data();
  v.n_x = states();
  v.mode = mode;
  v.hit = hit;
  v.key = key;
  v.m = m.data();
  v.n_m = sizes.memory;
  v.u = u.data();
  v.n_u = n_u;
  v.n_y = sizes.outputs;
  v.t = t;
  v.branch = branch;
  v.series = series;
  v.history = history;
  return v;
}

template <class T>
std::vector<T> Bench::call(void (*function)(const View<T>&), View<T> v, int count) {
  if (function == nullptr) throw std::logic_error("the block has no such function");
  std::vector<T> out(static_cast<std::size_t>(count));
  v.out = out.data();
  function(v);
  return out;
}

Bench::Bench(const std::string& type, const Values& values, int inputs) : kernel(kernel_of(type)) {
  const Declaration& d = kernel.declaration;
  p_at.push_back(0);
  shape.declaration = &d;
  for (const auto& q : d.parameters) {
    Numbers own;
    if (const auto given = values.find(q.name); given != values.end())
      own = given->second;
    else if (q.kind == ParameterKind::text)
      own = q.choices.empty() ? Numbers{} : Numbers{0};
    else if (q.default_text && q.default_text->empty())
      own = {};
    else if (q.default_text)
      own = {default_of(*q.default_text)};
    else
      throw std::logic_error(type + " needs " + q.name);
    p.insert(p.end(), own.begin(), own.end());
    p_at.push_back(static_cast<int>(p.size()));
    shape.list_lengths.push_back(static_cast<int>(own.size()));
    shape.text_choices.push_back(q.kind == ParameterKind::text && !own.empty() ? static_cast<int>(own[0]) : 0);
    const auto columns = values.find(q.name + " columns");
    shape.columns.push_back(columns == values.end() ? 0 : static_cast<int>(columns->second[0]));
    shape.structure.push_back(own);
  }
  for (const auto& [name, numbers] : values)
    if (d.parameter_index(name.substr(0, name.find(' '))) < 0)
      throw std::logic_error(type + " has no parameter " + name);
  shape.inputs = inputs < 0 ? static_cast<int>(d.inputs.size()) : inputs;
  n_u = shape.inputs;
  if (d.has_vector_ports()) {
    shape.input_lengths = {n_u};
    shape.inputs = 1;
  }
  sizes = kernel.sizes(shape);
  if (sizes.error.empty()) prepare();
}

double Bench::default_of(const std::string& text) {
  double number = 0;
  std::string unit;
  if (!split_quantity(text, number, unit)) throw std::logic_error("no quantity: " + text);
  return unit.empty() ? number : number * parse_unit(unit).scale;
}

void Bench::prepare() {
  c = sizes.code;
  c.resize(static_cast<std::size_t>(sizes.constants));
  if (kernel.prepare == nullptr) return;
  View<double> v = view<double>(p, {}, {}, {}, 0, 0);
  v.out = c.data();
  kernel.prepare(v);
}

std::string Bench::check() const {
  return kernel.check == nullptr ? "" : kernel.check(view<double>(p, {}, {}, {}, 0, 0));
}

bool Bench::is_linear() const {
  return kernel.declaration.is_linear ||
         (kernel.is_linear_at != nullptr && kernel.is_linear_at(view<double>(p, {}, {}, {}, 0, 0)));
}

bool Bench::is_affine_in_modes() const {
  return kernel.is_affine_in_modes != nullptr && kernel.is_affine_in_modes(view<double>(p, {}, {}, {}, 0, 0));
}

Numbers Bench::output(double t, const Numbers& u, const Numbers& x, const Numbers& m) const {
  return output(t, t, u, x, m);
}

Numbers Bench::output(double t, double branch, const Numbers& u, const Numbers& x, const Numbers& m) const {
  return call(kernel.output, view<double>(p, u, x, m, t, branch), sizes.outputs);
}

Duals Bench::output_rate(double t, double branch, const Duals& u, const Duals& x, const Duals& m) const {
  const Duals dp = dual(p);
  return call(kernel.output_rate, view<Dual>(dp, u, x, m, Dual{t, 1}, branch), sizes.outputs);
}

Numbers Bench::derivative(const Numbers& u, const Numbers& x, const Numbers& du) const {
  View<double> v = view<double>(p, u, x, {}, 0, 0);
  v.du = du.data();
  return call(kernel.derivative, v, sizes.states);
}

Numbers Bench::advance(const Numbers& m, const Numbers& u) const {
  return call(kernel.advance, view<double>(p, u, {}, m, 0, 0), sizes.memory);
}

Duals Bench::advance_rate(const Duals& m, const Duals& u) const {
  const Duals dp = dual(p);
  return call(kernel.advance_rate, view<Dual>(dp, u, {}, m, Dual{0}, 0), sizes.memory);
}

Numbers Bench::update(const Numbers& u, const Numbers& x) const {
  return call(kernel.update, view<double>(p, u, x, {}, 0, 0), sizes.sampled_states);
}

double Bench::guard(const Numbers& u, const Numbers& x) const {
  return call(kernel.guard, view<double>(p, u, x, {}, 0, 0), 1)[0];
}

int Bench::settle(const Numbers& u, Numbers& x) {
  int changes = 0;
  for (; guard(u, x) <= 0; ++changes) {
    if (changes > 10) throw std::logic_error(kernel.declaration.type + ": the modes do not settle");
    View<double> v = view<double>(p, u, x, {}, 0, 0);
    const int next = kernel.next_mode(v);
    if (next == mode) throw std::logic_error(kernel.declaration.type + ": a mode follows itself");
    v.mode_before = mode;
    v.mode = mode = next;
    if (kernel.reset != nullptr) x = call(kernel.reset, v, sizes.states);
  }
  return changes;
}

int Bench::initial_mode() const {
  return kernel.initial_mode == nullptr ? 0 : kernel.initial_mode(view<double>(p, {}, initial_states(), {}, 0, 0));
}

Numbers Bench::rest(const Numbers& u) const {
  return call(kernel.rest, view<double>(p, u, {}, {}, 0, 0), sizes.states);
}

Numbers Bench::initial_states() const {
  if (kernel.initial_states == nullptr) return Numbers(static_cast<std::size_t>(states()), 0);
  return call(kernel.initial_states, view<double>(p, {}, {}, {}, 0, 0), states());
}

Numbers Bench::initial_memory() const {
  if (kernel.initial_memory == nullptr) return Numbers(static_cast<std::size_t>(sizes.memory), 0);
  return call(kernel.initial_memory, view<double>(p, {}, {}, {}, 0, 0), sizes.memory);
}

double Bench::next_breakpoint(double t) const { return kernel.next_breakpoint(view<double>(p, {}, {}, {}, t, t)); }

double Bench::shortest_period() const { return kernel.shortest_period(view<double>(p, {}, {}, {}, 0, 0)); }

Numbers Bench::response(const std::vector<Numbers>& u, double step) const {
  Bench run = *this;
  return run.walk(u, step);
}

Numbers Bench::walk(const std::vector<Numbers>& u, double step) {
  Numbers x = initial_states(), m = initial_memory(), y;
  mode = initial_mode();
  for (std::size_t k = 0; k < u.size(); ++k) {
    hit = static_cast<long>(k);
    if (kernel.has_modes()) settle(u[k], x);
    if (sizes.memory > 0) m = advance(m, u[k]);
    y.push_back(output(static_cast<double>(k) * step, u[k], x, m)[0]);
    if (sizes.sampled_states > 0) x = update(u[k], x);
    if (sizes.states == 0) continue;
    Numbers du(u[k].size(), 0);
    for (std::size_t i = 0; i < du.size() && k > 0; ++i) du[i] = (u[k][i] - u[k - 1][i]) / step;
    const Numbers dx = derivative(u[k], x, du);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += step * dx[i];
  }
  return y;
}

}  // namespace hysteron::bench
