#include "engine/simulate/linear_row_kernel.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "engine/diagram/index.h"
#include "engine/program/steps.h"

namespace hysteron {
namespace {

/// A number as a weighted sum of others, by their places in the list of all numbers: values, rates, derivatives,
/// states.
struct Form {
  std::vector<std::pair<int, double>> terms;
  double constant = 0;

  void add(int number, double weight) { terms.emplace_back(number, weight); }
  void add(const Form& other, double weight) {
    for (const auto& [number, own] : other.terms) terms.emplace_back(number, weight * own);
    constant += weight * other.constant;
  }
  /// Each number once.
  void gather() {
    std::sort(terms.begin(), terms.end());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      if (kept > 0 && terms[kept - 1].first == terms[i].first)
        terms[kept - 1].second += terms[i].second;
      else
        terms[kept++] = terms[i];
    }
    terms.resize(kept);
  }
};

bool is_row(const BlockInstance& b) {
  return b.kernel->declaration.is_linear && b.n_u > 0 && b.hit_index < 0 && b.mode_index < 0 && b.history_index < 0 &&
         b.series_index < 0 && b.sizes.memory == 0 && b.enabling < 0 && !b.kernel->uses_time;
}

/// Slopes of the outputs or derivatives of one block with respect to its states and inputs, eight at a time.
class BlockReader {
 public:
  BlockReader(const Program& program, const Run& run) : program_(program), run_(run) {}

  struct Matrix {
    int rows = 0, columns = 0;  // columns: states, then inputs
    std::vector<double> slopes{}, constants{};
    double operator()(int row, int column) const { return slopes[at(row * columns + column)]; }
  };

  const Matrix& outputs(int block) { return read(block, false); }
  const Matrix& derivatives(int block) { return read(block, true); }

 private:
  const Matrix& read(int block, bool derivative) {
    const BlockInstance& b = program_.blocks[at(block)];
    const auto& call = derivative ? b.kernel->jet.derivative : b.kernel->jet.output;
    const int n_x = b.sizes.states, n_p = b.p_at.back();
    Matrix& m = matrix_;
    m.rows = derivative ? n_x : b.sizes.outputs;
    m.columns = n_x + b.n_u;
    m.slopes.resize(at(m.rows * m.columns));
    m.constants.resize(at(m.rows));
    numbers_.assign(at(n_p + m.columns + m.rows), Jet());
    Jet* x = numbers_.data() + n_p;
    Jet* out = x + m.columns;
    for (int i = 0; i < n_p; ++i) numbers_[at(i)] = Jet(run_.p[at(b.p_begin + i)]);
    View<Jet> v;
    v.p = numbers_.data();
    v.p_at = b.p_at.data();
    v.c = run_.c.data() + b.c_begin;
    v.n_c = b.sizes.constants;
    v.x = x;
    v.n_x = n_x;
    v.u = x + n_x;
    v.n_u = b.n_u;
    v.n_y = b.sizes.outputs;
    v.out = out;
    for (int first = 0; first < std::max(1, m.columns); first += Jet::directions) {
      const int last = std::min(m.columns, first + Jet::directions);
      for (int j = first; j < last; ++j) x[j].slope[j - first] = 1;
      call(v);
      for (int j = first; j < last; ++j) x[j].slope[j - first] = 0;
      for (int i = 0; i < m.rows; ++i) {
        for (int j = first; j < last; ++j) m.slopes[at(i * m.columns + j)] = out[i].slope[j - first];
        m.constants[at(i)] = out[i].value;
      }
    }
    return m;
  }

  const Program& program_;
  const Run& run_;
  std::vector<Jet> numbers_;
  Matrix matrix_;
};

/// A step as it was, or the rows that take its place.
struct FoldedStep {
  Step step;
  bool opaque = true;
  int first_number = 0, count = 0;  // of its rows
};

class Folding {
 public:
  Folding(const Program& program, const Run& run) : program_(program), reader_(program, run) {
    forms_.resize(at(2 * program.n_y + 2 * program.n_x));
    readers_.assign(forms_.size(), 0);
    read_outside_.assign(forms_.size(), false);
    inlined_.assign(forms_.size(), false);
    for (const Step& step : program.derivative_steps) add(step);
    for (const FoldedStep& step : steps_)
      for (int n = step.first_number; !step.opaque && n < step.first_number + step.count; ++n) finish(n);
  }

  const std::vector<FoldedStep>& steps() const { return steps_; }
  struct Count {
    std::size_t rows = 0, terms = 0;
  };
  Count count() const {
    Count all;
    for (const FoldedStep& step : steps_)
      for (int n = step.first_number; !step.opaque && n < step.first_number + step.count; ++n) {
        if (is_inlined(n)) continue;
        ++all.rows;
        all.terms += form(n).terms.size();
      }
    return all;
  }
  const Form& form(int number) const { return forms_[at(number)]; }
  bool is_inlined(int number) const { return inlined_[at(number)]; }

  int value(int signal) const { return signal; }
  int rate(int signal) const { return program_.n_y + signal; }
  int derivative(int state) const { return 2 * program_.n_y + state; }
  int state(int state) const { return 2 * program_.n_y + program_.n_x + state; }

 private:
  void add(const Step& step) {
    if (step.order == Order::loop) {
      for (const Slot& slot : program_.loops[at(step.block)].outside)
        read_outside_[at(slot.order == Order::value  ? value(slot.index)
                         : slot.order == Order::rate ? rate(slot.index)
                                                     : derivative(slot.index))] = true;
      steps_.push_back({step});
      return;
    }
    const BlockInstance& b = program_.blocks[at(step.block)];
    if (is_row(b)) return add_rows(step, b);
    steps_.push_back({step});
    const bool reads_inputs = step.order == Order::derivative || b.sizes.feedthrough;
    const bool reads_rates =
        step.order == Order::rate || (step.order == Order::derivative && b.kernel->derivative_wants_rate);
    for (const int s : b.source) {
      if (reads_inputs) read_outside_[at(value(s))] = true;
      if (reads_inputs && reads_rates) read_outside_[at(rate(s))] = true;
    }
  }

  void add_rows(const Step& step, const BlockInstance& b) {
    const bool of_rate = step.order == Order::rate, of_state = step.order == Order::derivative;
    const auto& m = of_state ? reader_.derivatives(step.block) : reader_.outputs(step.block);
    const int first = of_state ? derivative(b.x_begin) : of_rate ? rate(b.y_begin) : value(b.y_begin);
    // Structural zeros are the many of a block with states; a gain of zero is a connection.
    const bool keep_zeros = b.sizes.states == 0;
    for (int i = 0; i < m.rows; ++i) {
      Form& form = forms_[at(first + i)];
      if (!of_rate) form.constant = m.constants[at(i)];
      for (int j = 0; j < b.sizes.states; ++j)
        if (m(i, j) != 0) form.add(of_rate ? derivative(b.x_begin + j) : state(b.x_begin + j), m(i, j));
      for (int j = 0; j < b.n_u && (of_state || b.sizes.feedthrough); ++j)
        if (const double weight = m(i, b.sizes.states + j); keep_zeros || weight != 0)
          form.add(of_rate ? rate(b.source[at(j)]) : value(b.source[at(j)]), weight);
      form.gather();
      for (const auto& [number, weight] : form.terms) ++readers_[at(number)];
    }
    steps_.push_back({step, false, first, m.rows});
  }

  /// Writes the numbers that have no row into the form, and decides whether this one needs a row.
  void finish(int number) {
    Form& form = forms_[at(number)];
    if (std::any_of(form.terms.begin(), form.terms.end(), [&](const auto& term) { return inlined_[at(term.first)]; })) {
      Form whole;
      whole.constant = form.constant;
      for (const auto& [read, weight] : form.terms) {
        if (inlined_[at(read)])
          whole.add(forms_[at(read)], weight);
        else
          whole.add(read, weight);
      }
      whole.gather();
      form = std::move(whole);
    }
    if (number >= derivative(0) || read_outside_[at(number)]) return;
    // A row costs its terms and a store, and each reader one term; without it each reader has all terms.
    const int terms = static_cast<int>(form.terms.size());
    inlined_[at(number)] = readers_[at(number)] * terms <= terms + 1 + readers_[at(number)];
  }

  const Program& program_;
  BlockReader reader_;
  std::vector<Form> forms_;  // per number; of rows only
  std::vector<int> readers_;
  std::vector<bool> read_outside_, inlined_;
  std::vector<FoldedStep> steps_;
};

}  // namespace

template <int width>
void LinearRowKernel::add_up(const Piece& piece) {
  const Row* row = piece.first;
  const Row* const last = piece.last;
  const Term* term = piece.term;
  do {
    double sum = row->constant;
    for (int i = 0; i < width; ++i) sum += term[i].weight * *term[i].number;
    *row->target = sum;
    term += width;
  } while (++row != last);
}

void LinearRowKernel::add_up_long(const Piece& piece) {
  const Term* term = piece.term;
  for (const Row* row = piece.first; row != piece.last; ++row) {
    double sum = row->constant;
    for (const Term* const end = term + piece.terms; term != end; ++term) sum += term->weight * *term->number;
    *row->target = sum;
  }
}

void LinearRowKernel::call(const Piece& piece) { BoundCalls::carry_out(*piece.bound); }
void LinearRowKernel::call_function(const Piece& piece) { piece.bound->function(piece.bound->view); }

LinearRowKernel::LinearRowKernel(const Program& program, const Run& run, Work& work)
    : program_(program),
      work_(work),
      x_(at(program.n_x)),
      calls_(program, work, x_.data()),
      kept_t_(std::numeric_limits<double>::quiet_NaN()),
      kept_branch_(kept_t_),
      foretold_branch_(kept_t_) {
  const Folding folding(program, run);
  double* y = work.y.data();
  double* rate = work.rate.data();
  double* dx = work.dx.data();
  const auto place = [&](int number) -> double* {
    if (number < program.n_y) return y + number;
    if (number < 2 * program.n_y) return rate + (number - program.n_y);
    if (number < 2 * program.n_y + program.n_x) return dx + (number - 2 * program.n_y);
    return x_.data() + (number - 2 * program.n_y - program.n_x);
  };
  const auto count = folding.count();
  rows_.reserve(count.rows);  // pieces point into these
  terms_.reserve(count.terms);
  for (const FoldedStep& step : folding.steps()) {
    if (step.opaque) {
      add_step(step.step);
      continue;
    }
    for (int number = step.first_number; number < step.first_number + step.count; ++number) {
      if (folding.is_inlined(number)) continue;
      const Form& form = folding.form(number);
      add_row({form.constant, place(number), static_cast<int>(form.terms.size())});
      for (const auto& [read, weight] : form.terms) terms_.push_back({weight, place(read)});
    }
  }
  foretold_.resize(source_places_.size());
}

/// Its terms follow.
void LinearRowKernel::add_row(const Row& row) {
  rows_.push_back(row);
  if (pieces_.empty() || pieces_.back().first == nullptr || pieces_.back().terms != row.terms) {
    Piece piece;
    static constexpr auto by_terms = std::to_array<void (*)(const Piece&)>(
        {&add_up_long, &add_up<1>, &add_up<2>, &add_up<3>, &add_up<4>, &add_up<5>, &add_up<6>});
    piece.carry_out = at(row.terms) < by_terms.size() ? by_terms[at(row.terms)] : &add_up_long;
    piece.terms = row.terms;
    piece.first = &rows_.back();
    piece.term = terms_.data() + terms_.size();
    pieces_.push_back(piece);
  }
  pieces_.back().last = &rows_.back() + 1;
}

void LinearRowKernel::add_step(const Step& step) {
  BoundCalls::Call* call = calls_.add(step);
  if (call != nullptr && work_.calls[at(step.block)].source_only && step.order != Order::derivative) {
    const BlockInstance& b = program_.blocks[at(step.block)];
    sources_.push_back(call);
    for (int i = b.y_begin; i < b.y_begin + b.sizes.outputs; ++i) {
      if (step.order == Order::rate) source_places_.push_back(&work_.rate[at(i)]);
      source_places_.push_back(&work_.y[at(i)]);
    }
    return;
  }
  Piece piece;
  piece.of = step;
  piece.bound = call;
  piece.kernel = this;
  piece.carry_out = call == nullptr                           ? &LinearRowKernel::step
                    : BoundCalls::is_function(program_, step) ? &LinearRowKernel::call_function
                                                              : &LinearRowKernel::call;
  if (call == nullptr) other_steps_ = true;
  pieces_.push_back(piece);
}

int LinearRowKernel::calls() const {
  return static_cast<int>(sources_.size()) +
         static_cast<int>(
             std::count_if(pieces_.begin(), pieces_.end(), [](const Piece& p) { return p.first == nullptr; }));
}

void LinearRowKernel::forget() {
  kept_t_ = kept_branch_ = std::numeric_limits<double>::quiet_NaN();
  next_instant_ = instants_.size();
}

/// What sources make at these instants, a row of numbers for each, from row `first` of foretold_ on.
void LinearRowKernel::ask_sources(const Run& run, std::span<const double> instants, std::size_t first) {
  const std::size_t width = source_places_.size();
  double* numbers = foretold_.data() + first * width;
  for (BoundCalls::Call* const source : sources_) numbers += BoundCalls::ask(*source, run, instants, numbers, width);
}

void LinearRowKernel::foretell(const Run& run, std::span<const double> instants) {
  if (!calls_.is_bound_to(run)) calls_.bind(run);
  forget();
  instants_.assign(instants.begin(), instants.end());
  foretold_.resize((instants.size() + 1) * source_places_.size());
  ask_sources(run, instants_, 0);
  next_instant_ = 0;
  foretold_branch_ = run.branch;
}

/// Sets kept_ to what sources make at an instant that is not the next one that was foretold.
void LinearRowKernel::look_for_sources(const Run& run, double t) {
  if (run.branch == foretold_branch_) {
    while (next_instant_ < instants_.size() && instants_[next_instant_] < t) ++next_instant_;
    if (comes_next(run, t)) {
      kept_ = foretold_.data() + next_instant_ * source_places_.size();
      return;
    }
  }
  ask_sources(run, {&t, 1}, instants_.size());
  kept_ = foretold_.data() + instants_.size() * source_places_.size();
}

void LinearRowKernel::operator()(const Run& run, double t, const double* x) {
  double* own = x_.data();
  for (int i = 0; i < program_.n_x; ++i) own[i] = x[i];
  (*this)(run, t);
}

void LinearRowKernel::operator()(const Run& run, double t) {
  if (!calls_.is_bound_to(run)) {
    calls_.bind(run);
    forget();
  }
  if (other_steps_)
    steps::begin(program_, run, work_, t);
  else
    work_.unsolved = -1;
  if (!(t == kept_t_ && run.branch == kept_branch_)) {
    if (comes_next(run, t))
      kept_ = foretold_.data() + next_instant_++ * source_places_.size();
    else
      look_for_sources(run, t);
    kept_t_ = t;
    kept_branch_ = run.branch;
    calls_.set_time(run, t);
  }
  if (calls_.have_modes()) calls_.set_modes(run);
  const double* number = kept_;
  for (double* const place : source_places_) *place = *number++;
  for (const Piece& piece : pieces_) piece.carry_out(piece);
  if (work_.unsolved >= 0) std::fill(work_.dx.begin(), work_.dx.end(), std::numeric_limits<double>::quiet_NaN());
}

void LinearRowKernel::step(const Piece& piece) {
  LinearRowKernel& own = *piece.kernel;
  const int block = piece.of.block;
  const double* x = own.x_.data();
  switch (piece.of.order) {
    case Order::value:
      return steps::value(own.program_, own.work_, block, x);
    case Order::rate:
      return steps::rate(own.program_, own.work_, block, x);
    case Order::derivative:
      return steps::derivative(own.work_, block, x);
    case Order::loop:
      solve_loop(own.program_, own.work_, block, x);
  }
}

}  // namespace hysteron
