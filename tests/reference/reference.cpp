#include "tests/reference/reference.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/reference/order.h"

namespace reference {
namespace {

constexpr int smooth = 9;          ///< as roughness: nothing is felt any more
constexpr double located = 2e-14;  ///< how near a change within a step is bracketed, over the larger of 1 s and t

class Simulation {
 public:
  Simulation(const FlatDiagram& diagram_, const Settings& settings_) : diagram(diagram_), settings(settings_) {
    build();
  }

  Result run() {
    begin();
    const auto rows = static_cast<long>(std::floor(diagram.until / diagram.every * (1 + 1e-12)));
    row(0);
    for (long i = 1; i <= rows; ++i) {
      const double end = static_cast<double>(i) * diagram.every;
      advance_to(end);
      row(end);
    }
    return std::move(result);
  }

 private:
  // --- building ---------------------------------------------------------------------------------------------------
  void build() {
    laws.clear();
    writer.clear();
    recorded.clear();
    std::map<std::string, int> places;
    int signals = 0, states = 0;
    for (Block block : diagram.blocks) {
      disturb(block);
      LawPointer law = make_law(block);
      law->out = signals;
      law->x = states;
      const auto ports = law->outputs();
      for (std::size_t i = 0; i < ports.size(); ++i) {
        places[block.name + "." + ports[i]] = signals + static_cast<int>(i);
        if (ports.size() == 1) places[block.name] = signals;
      }
      writer.insert(writer.end(), ports.size(), static_cast<int>(laws.size()));
      signals += static_cast<int>(ports.size());
      states += law->states();
      laws.push_back(std::move(law));
    }
    for (std::size_t b = 0; b < laws.size(); ++b) wire(*laws[b], diagram.blocks[b], places);
    for (const auto& name : diagram.record) recorded.push_back(place_of(places, name));
    s.assign(signals, 0);
    sizes.assign(signals, 0);
    x.assign(states, 0);
    step = settings.step;
    for (const auto& law : laws) step = std::min({step, law->fastest() / 20, law->largest_step()});
    if (step < 1e-6) throw Unknown("too fast for fixed steps");
    order = evaluation_order(laws);
  }

  void disturb(Block& block) const {
    const double e = settings.disturbed;
    if (e == 0) return;
    for (const char* key : {"amplitude", "levels", "after"})
      if (auto at = block.numbers.find(key); at != block.numbers.end())
        for (auto& v : at->second) v *= 1 + e;
    for (auto& v : block.samples) v *= 1 + e;
    if (block.type == "sine" || block.type == "triangle" || block.type == "chirp")
      block.numbers["phase"] = {block.number("phase", 0) + e};
  }

  static int place_of(const std::map<std::string, int>& places, const std::string& name) {
    const auto at = places.find(name);
    if (at == places.end()) throw Unknown("no signal " + name);
    return at->second;
  }

  static void wire(Law& law, const Block& block, const std::map<std::string, int>& places) {
    const auto names = law.inputs();
    law.in.assign(names.size(), -1);
    for (std::size_t i = 0; i < block.in.size(); ++i) {
      const auto& [port, from] = block.in[i];
      const std::size_t at = port.empty() ? i : std::find(names.begin(), names.end(), port) - names.begin();
      if (at >= names.size()) throw Unknown(block.name + " has no input " + port);
      law.in[at] = place_of(places, from);
    }
    if (std::find(law.in.begin(), law.in.end(), -1) != law.in.end()) throw Unknown(block.name + " lacks an input");
  }

  // --- evaluation -------------------------------------------------------------------------------------------------
  void one(int b, const Point& p, double* signals) const { laws[b]->output(p, signals + laws[b]->out); }

  void evaluate(double t, const double* states, double* signals, bool free) const {
    const Point p{t, signals, states, free};
    for (const auto& group : order) {
      if (group.tear < 0)
        one(group.laws[0], p, signals);
      else
        solve(group, p, signals);
    }
  }

  /// What the torn signal comes to when it is taken to be v, less v.
  double residual(const Group& group, const Point& p, double* signals, double v) const {
    const int torn = laws[group.tear]->out;
    signals[torn] = v;
    for (const int b : group.laws) one(b, p, signals);
    const double found = signals[torn];
    signals[torn] = v;
    return found - v;
  }

  void solve(const Group& group, const Point& p, double* signals) const {
    const auto r = [&](double v) { return residual(group, p, signals, v); };
    double a = signals[laws[group.tear]->out], ra = r(a);
    if (ra == 0) return;
    double b = a + ra, rb = r(b);
    for (int i = 0; i < 60 && ra * rb > 0; ++i) {
      b = a + 2 * (b - a);
      rb = r(b);
      if (i % 2 == 1) b = 2 * a - b, rb = r(b);
    }
    if (ra * rb > 0) throw GaveUp("an algebraic loop without a solution");
    for (int i = 0; i < 200 && rb != 0 && std::abs(b - a) > 1e-16 * std::abs(b) + 1e-300; ++i) {
      const double share = ra / (ra - rb), between = i % 3 == 2 ? 0.5 : std::clamp(share, 0.001, 0.999);
      const double c = a + between * (b - a), rc = r(c);
      if (c == a || c == b) break;
      (rc * rb > 0 ? b : a) = c;
      (rc * rb > 0 ? rb : ra) = rc;
    }
    const double best = std::abs(ra) < std::abs(rb) ? a : b;
    if (std::min(std::abs(ra), std::abs(rb)) > 1e-9 * std::max(1.0, std::abs(best)))
      throw GaveUp("an algebraic loop without a solution");
    r(best);
  }

  void slopes(double t, const double* states, double* dx) const {
    evaluate(t, states, scratch.data(), false);
    const Point p{t, scratch.data(), states, false};
    for (const auto& law : laws) law->rates(p, dx);
  }

  /// Where x is after a step of h, by the classical rule.
  void stepped(double h, std::vector<double>& to) const {
    const std::size_t n = x.size();
    static thread_local std::vector<double> k1, k2, k3, k4, at;
    for (auto* k : {&k1, &k2, &k3, &k4, &at}) k->resize(n);
    slopes(now, x.data(), k1.data());
    for (std::size_t i = 0; i < n; ++i) at[i] = x[i] + h / 2 * k1[i];
    slopes(now + h / 2, at.data(), k2.data());
    for (std::size_t i = 0; i < n; ++i) at[i] = x[i] + h / 2 * k2[i];
    slopes(now + h / 2, at.data(), k3.data());
    for (std::size_t i = 0; i < n; ++i) at[i] = x[i] + h * k3[i];
    slopes(now + h, at.data(), k4.data());
    to.resize(n);
    for (std::size_t i = 0; i < n; ++i) to[i] = x[i] + h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }

  // --- time -------------------------------------------------------------------------------------------------------
  /// Before the start the input of a dead time had been for ever what it is there, samples that are taken at the start
  /// and modes that are settled there included.
  void begin() {
    std::vector<double> rest;
    for (int round = 0; round < 100; ++round) {
      for (std::size_t b = 0; b < rest.size(); ++b)
        if (laws[b]->is_late()) laws[b]->rest_at(rest[b]);
      for (const auto& law : laws) law->start(x.data());
      scratch = s;
      at_rest_before();
      instant(true);
      std::vector<double> now_rest;
      for (const auto& law : laws) now_rest.push_back(law->is_late() ? s[law->in[0]] : 0);
      if (now_rest == (rest.empty() ? std::vector<double>(laws.size(), 0) : rest)) return;
      rest = std::move(now_rest);
      build();
    }
    throw Unknown("dead times that need each other at the start");
  }

  /// A dead time hands on at first what its input is at first, whatever the order of evaluation.
  void at_rest_before() {
    for (int round = 0; round < 1000; ++round) {
      const std::vector<double> before = s;
      evaluate(0, x.data(), s.data(), true);
      if (s == before) return;
    }
    throw Unknown("dead times that need each other at the start");
  }

  double next_known() const {
    double t = never;
    for (const auto& law : laws) t = std::min(t, law->next());
    return t;
  }

  void advance_to(double end) {
    while (now < end - same_instant) {
      const double known = next_known();
      const double target = std::min(end, known);
      if (target > now + same_instant / 2) {
        const double pieces = std::ceil((target - now) / step * (1 - 1e-12));
        if (!try_step((target - now) / std::max(1.0, pieces), pieces <= 1 ? target : 0)) continue;
      }
      if (known <= now + same_instant) instant(true);
    }
    if (next_known() <= now + same_instant) instant(true);
  }

  /// A step to now + h, or to where something changes within it. False if something changed.
  bool try_step(double h, double exactly) {
    trial(h);
    if (unchanged(h)) {
      accept(exactly > 0 ? exactly : now + h);
      return true;
    }
    double low = 0, high = h;
    while (high - low > located * std::max(1.0, now)) {
      const double middle = low + (high - low) / 2;
      trial(middle);
      (unchanged(middle) ? low : high) = middle;
    }
    const double end = now + high;
    trial(high);
    const Point p{end, s_trial.data(), x_trial.data(), false};
    rough.assign(laws.size(), smooth);
    for (std::size_t b = 0; b < laws.size(); ++b)
      if (laws[b]->branch(p) != branches[b]) rough[b] = laws[b]->roughness();
    if (low > 0) {
      trial(low);
      accept(now + low);
    }
    trial(end - now);
    accept(end);
    instant(false);
    return false;
  }

  void trial(double h) {
    stepped(h, x_trial);
    scratch = s;
    evaluate(now + h, x_trial.data(), scratch.data(), false);
    s_trial = scratch;
  }

  bool unchanged(double h) const {
    const Point p{now + h, s_trial.data(), x_trial.data(), false};
    for (std::size_t b = 0; b < laws.size(); ++b)
      if (laws[b]->branch(p) != branches[b]) return false;
    return true;
  }

  void take_branches(const Point& p) {
    branches.resize(laws.size());
    for (std::size_t b = 0; b < laws.size(); ++b) branches[b] = laws[b]->branch(p);
  }

  void accept(double t) {
    now = t;
    x.swap(x_trial);
    s.swap(s_trial);
    const Point p = here(false);
    for (const auto& law : laws) law->keep(p);
    take_branches(p);
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (!(std::abs(s[i]) < 1e12)) throw GaveUp("numbers without bound");
      sizes[i] = std::max(sizes[i], std::abs(s[i]));
    }
  }

  Point here(bool free) const { return {now, s.data(), x.data(), free}; }

  void arrive() {
    rough.assign(laws.size(), now > 0 ? smooth : 0);
    for (std::size_t b = 0; b < laws.size(); ++b) {
      if (laws[b]->next() > now + same_instant) continue;
      laws[b]->arrive(now);
      rough[b] = std::min(rough[b], laws[b]->roughness());
    }
  }

  /// Each dead time is told how rough its input is at this instant.
  void hand_on_roughness() {
    for (bool moved = true; moved;) {
      moved = false;
      for (std::size_t b = 0; b < laws.size(); ++b)
        for (const int i : laws[b]->in) {
          const int through = rough[writer[i]] + laws[b]->smooths();
          if (through < rough[b]) rough[b] = through, moved = true;
        }
    }
    for (const auto& law : laws) {
      int least = smooth;
      for (const int i : law->in) least = std::min(least, rough[writer[i]]);
      law->bends(least);
    }
  }

  /// Everything that happens at one instant: sources move on, samples are taken, relays switch, bodies stop or part.
  void instant(bool known) {
    if (++result.events > settings.most_events) throw GaveUp("events without end");
    const std::vector<double> before = s;
    if (known) arrive();
    hand_on_roughness();
    bool again = true;
    for (int round = 0; again; ++round) {
      if (round > 100) throw GaveUp("an instant without end");
      evaluate(now, x.data(), s.data(), true);
      for (const auto& law : laws) law->keep(here(true));
      again = false;
      for (const auto& law : laws) again = law->change(here(true), x.data()) || again;
    }
    for (const auto& law : laws) law->leave(here(true));
    Jump jump{now, {}, {}, known};
    bool any = false;
    for (const int i : recorded) {
      jump.before.push_back(before[i]);
      jump.after.push_back(s[i]);
      any = any || before[i] != s[i];
    }
    if (any && now > 0) result.jumps.push_back(std::move(jump));
    take_branches(here(true));
  }

  void row(double t) {
    result.t.push_back(t);
    result.values.resize(recorded.size());
    result.scale.resize(recorded.size());
    for (std::size_t i = 0; i < recorded.size(); ++i) {
      result.values[i].push_back(s[recorded[i]]);
      result.scale[i] = std::max(sizes[recorded[i]], std::abs(s[recorded[i]]));
    }
  }

  const FlatDiagram& diagram;
  Settings settings;
  std::vector<LawPointer> laws{};
  std::vector<Group> order{};
  std::vector<int> recorded{};
  std::vector<double> s{}, x{}, sizes{}, s_trial{}, x_trial{};
  mutable std::vector<double> scratch{};
  std::vector<long> branches{};
  std::vector<int> rough{}, writer{};  ///< roughness of each law's output at this instant; law that writes a signal
  double now = 0, step = 0;
  Result result{};
};

}  // namespace

Result simulate(const FlatDiagram& diagram, const Settings& settings) { return Simulation(diagram, settings).run(); }

}  // namespace reference
