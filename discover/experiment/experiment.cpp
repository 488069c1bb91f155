// Decides which experiment would separate fitted models of one device. See experiment.h.
#include "discover/experiment/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "discover/placement/rows.h"
#include "engine/diagram/error.h"

namespace hysteron {
namespace {

constexpr double clearly = 2;  ///< a word that was asked for goes first if it separates by so much

double rms_difference(std::vector<double> a, const std::vector<double>& b, bool free_zero) {
  double mean = 0;
  for (std::size_t k = 0; k < a.size(); ++k) a[k] -= b[k];
  if (free_zero) {
    for (const double d : a) mean += d;
    mean /= static_cast<double>(std::max<std::size_t>(a.size(), 1));
  }
  double sum = 0;
  for (const double d : a) sum += (d - mean) * (d - mean);
  return a.empty() ? 0 : std::sqrt(sum / static_cast<double>(a.size()));
}

using Outputs = std::vector<std::vector<double>>;

/// What an input does in an experiment; what it does not move stays where recordings start.
Series moved(const Protocol& protocol, const Device& device, const std::string& input) {
  const auto moves = protocol.moves.find(input);
  if (moves != protocol.moves.end()) return moves->second;
  const auto level = device.levels.find(input);
  return {{0.0}, {level == device.levels.end() ? 0.0 : level->second}, Between::hold};
}

/// What the outputs of a program do in an experiment. Empty where the model cannot follow: then it says nothing about
/// it.
Outputs answer(const ProgramPointer& program, const Protocol& protocol, const Device& device,
               const std::vector<std::string>& outputs) {
  std::vector<int> signals;
  for (const auto& name : outputs)
    for (std::size_t o = 0; o < program->output_names.size(); ++o)
      if (program->output_names[o] == name) signals.push_back(program->output_signals[o]);
  std::vector<SeriesPointer> inputs;
  for (const auto& name : program->input_names)
    inputs.push_back(std::make_shared<const Series>(moved(protocol, device, name)));
  try {
    return simulate_rows(program, inputs, protocol.t, signals, true);
  } catch (const Error&) {
    return {};
  }
}

double fastest_in(const Series& s) {
  double fastest = 0;
  for (std::size_t k = 1; k < s.v.size(); ++k)
    fastest = std::max(fastest, std::abs(s.v[k] - s.v[k - 1]) / (s.t[k] - s.t[k - 1]));
  return fastest;
}

/// What all inputs of the user's diagram do in it, row by row.
DriveRows rows_of(const Protocol& protocol, const Device& device, const Program& program) {
  DriveRows rows;
  rows.t = protocol.t;
  rows.shortest_step = device.shortest_step;
  for (const auto& name : device.inputs) {
    const auto at = std::find(program.input_names.begin(), program.input_names.end(), name);
    if (at == program.input_names.end()) continue;
    DrivenInput input{name, program.input_units[static_cast<std::size_t>(at - program.input_names.begin())]};
    const Series series = moved(protocol, device, name);
    for (const double t : rows.t) input.values.push_back(series.value(t, t));
    const auto [low, high] = std::minmax_element(input.values.begin(), input.values.end());
    input.moves = low != input.values.end() && *low < *high;
    input.fastest = fastest_in({rows.t, input.values});
    input.recorded = fastest_of(device, name);
    rows.inputs.push_back(std::move(input));
  }
  return rows;
}

/// Two of the models.
struct Pair {
  const Rival& a;
  const Rival& b;
  bool with_first;
  std::vector<std::string> words{};  ///< of the experiments that are to tell them apart

  std::string names() const { return a.effect + " and " + b.effect; }
  bool hidden() const { return a.hidden || b.hidden; }
  bool one_is_of_the_sensor() const { return (a.motion == nullptr) != (b.motion == nullptr); }
  /// What an effect reads must be in the experiment's hands.
  bool can_be_told_by(const Protocol& p) const {
    if (p.controls_sides) return true;
    const bool of_axes = a.side.kind == Side::other_axis || b.side.kind == Side::other_axis;
    return (p.word == "axes_independent" && of_axes) || !(needs_control(a.side) || needs_control(b.side));
  }
};

/// An experiment, and how much it tells.
struct Outcome {
  Experiment experiment;
  MenuItem item;
  std::size_t at = 0;  ///< of the menu
  std::shared_ptr<const Protocol> protocol{};
};

bool better(const Outcome& a, const Outcome& b) {
  const auto key = [](const MenuItem& i) { return std::tuple(i.rivals_told, i.pairs_told, i.asked, i.separation); };
  return key(a.item) > key(b.item);
}

class Search {
 public:
  Search(const Rivals& rivals, const Device& device, const Sight& sight)
      : rivals_(rivals), device_(device), sight_(sight) {
    for (std::size_t i = 0; i < rivals.models.size(); ++i)
      for (std::size_t j = i + 1; j < rivals.models.size(); ++j) add_pair(rivals.models[i], rivals.models[j], i == 0);
    for (const auto& drive : device.drives)
      if (leads_to_them(drive.name)) drives_.push_back(&drive);
    if (drives_.empty())
      for (const auto& drive : device.drives) drives_.push_back(&drive);
  }

  Separation best() {
    for (const Drive* drive : drives_)
      for (const auto& protocol : side_protocols(device_, *drive, sides())) take(tried(protocol, *drive));
    for (const bool asked : {true, false}) {
      // What is asked for and tells all apart need not fear another word.
      const bool enough =
          !asked && best_ && best_->item.asked && best_->item.pairs_told == static_cast<int>(pairs_.size());
      for (const auto& word : words()) {
        if (is_asked_for(word) != asked) continue;
        if (enough)
          menu_.items.push_back(not_simulated(word, "one that these effects name for each other tells all apart"));
        else
          take(best_of(word));
      }
    }
    keep_to_recorded_speed();
    Separation found;
    if (best_) {
      found.best = best_->experiment;
      found.best->rivals = std::make_shared<const Rivals>(rivals_);
      found.best->drive = std::make_shared<const DriveRows>(drive_of(*best_->protocol));
    }
    found.menu = told_menu();
    return found;
  }

 private:
  DriveRows drive_of(const Protocol& protocol) const {
    DriveRows rows = rows_of(protocol, device_, *rivals_.models.front().program);
    rows.outputs = sight_.outputs;
    for (const auto& side : sides())
      if (std::find(device_.inputs.begin(), device_.inputs.end(), side.name) == device_.inputs.end())
        rows.besides.push_back(side.name);
    return rows;
  }

  bool is_faster_than_recorded(const Protocol& protocol) const {
    return std::any_of(protocol.moves.begin(), protocol.moves.end(),
                       [&](const auto& m) { return fastest_in(m.second) > (1 + 1e-6) * fastest_of(device_, m.first); });
  }

  /// What tells as much and moves nothing faster than it was recorded takes the place of the best.
  void keep_to_recorded_speed() {
    if (!best_ || !is_faster_than_recorded(*best_->protocol)) return;
    auto slower = best_of(best_->item.word, true);
    if (!slower || slower->item.rivals_told < best_->item.rivals_told ||
        slower->item.pairs_told < best_->item.pairs_told || slower->item.separation < clearly)
      return;
    best_ = std::move(slower);
  }

  static MenuItem not_simulated(const std::string& word, const std::string& why) {
    MenuItem item;
    item.word = word;
    item.reason = why;
    return item;
  }

  Menu told_menu() const {
    Menu menu = menu_;
    for (const auto& p : pairs_) menu.pairs.push_back(p.names());
    if (words().empty())
      for (const auto& word : drive_words())
        menu.items.push_back(not_simulated(word, "does not excite the signal that they need"));
    if (best_) menu.items[best_->at].chosen = true;
    give_reasons(menu);
    return menu;
  }

  void add_pair(const Rival& a, const Rival& b, bool with_first) {
    Pair pair{a, b, with_first};
    for (const auto& [one, other] : {std::pair{&a, &b}, std::pair{&b, &a}})
      for (const auto& l : one->look_alikes)
        if (l.effect == other->effect) pair.words.push_back(l.experiment);
    pairs_.push_back(std::move(pair));
  }

  bool leads_to_them(const std::string& input) const {
    return std::any_of(rivals_.models.begin(), rivals_.models.end(), [&](const Rival& r) {
      return r.inputs.empty() || std::find(r.inputs.begin(), r.inputs.end(), input) != r.inputs.end();
    });
  }

  std::vector<SideRead> sides() const {
    std::vector<SideRead> list;
    for (const auto& r : rivals_.models) {
      const auto same = [&](const SideRead& s) { return s.name == r.side.name && s.kind == r.side.kind; };
      if (!r.side.name.empty() && std::none_of(list.begin(), list.end(), same)) list.push_back(r.side);
    }
    return list;
  }

  /// Of what moves a drive alone; with a second sensor where one of a pair says it is the sensor, and wiped out before
  /// where somebody asks for that.
  std::vector<std::string> words() const {
    const auto any = [&](auto&& is) { return std::any_of(pairs_.begin(), pairs_.end(), is); };
    if (!any([](const Pair& p) { return p.can_be_told_by({}); })) return {};
    auto words = drive_words();
    if (sight_.second_sensor && any([](const Pair& p) { return p.one_is_of_the_sensor(); }))
      words.emplace_back("reference_sensor");
    if (is_asked_for("precycle") && !device_.recorded_times.empty()) words.emplace_back("precycle");
    return words;
  }

  bool is_asked_for(const std::string& word) const {
    return std::any_of(pairs_.begin(), pairs_.end(),
                       [&](const Pair& p) { return std::find(p.words.begin(), p.words.end(), word) != p.words.end(); });
  }

  /// The drive on which the usual protocol tells most; there faster or slower, then with less amplitude while that
  /// tells more.
  std::optional<Outcome> best_of(const std::string& word, bool as_recorded = false) {
    std::optional<Outcome> best;
    const Drive* drive = nullptr;
    Variant variant;
    const auto betters = [&](const Drive* with, const Variant& c) {
      auto outcome = tried(made(word, *with, c), *with, c);
      if (!outcome || (best && !better(*outcome, *best))) return false;
      best = std::move(outcome);
      drive = with;
      variant = c;
      return true;
    };
    for (const Drive* with : drives_) betters(with, {1, 1, as_recorded});
    if (drive == nullptr) return best;
    for (const double slower : paces(word))
      if (slower != 1) betters(drive, {slower, 1, as_recorded});
    for (double part = 0.5; part > 0.2 && betters(drive, {variant.slower, part, as_recorded}); part /= 2) continue;
    return best;
  }

  Protocol made(const std::string& word, const Drive& drive, const Variant& variant) const {
    if (word != "reference_sensor") return drive_protocol(device_, drive, word, variant);
    Protocol p = drive_protocol(device_, drive, "triangle", variant);
    p.word = word;
    p.text += ", measured by a second, independent sensor besides";
    return p;
  }

  /// Largest of the outputs, over the noise; negative if it cannot be said.
  double separation(const Outputs& a, const Outputs& b) const {
    if (a.empty() || b.empty()) return -1;
    double largest = 0;
    for (std::size_t o = 0; o < a.size(); ++o)
      largest = std::max(largest, rms_difference(a[o], b[o], sight_.free_zero[o]) / sight_.noise[o]);
    return std::isfinite(largest) ? largest : -1;
  }

  std::vector<double> separations(const Protocol& protocol) const {
    const bool second_sensor = protocol.word == "reference_sensor";
    std::map<ProgramPointer, Outputs> known;
    const auto outputs = [&](const ProgramPointer& program) -> const Outputs& {
      const auto at = known.find(program);
      if (at != known.end()) return at->second;
      return known[program] = answer(program, protocol, device_, sight_.outputs);
    };
    std::vector<double> list;
    for (const auto& p : pairs_) {
      const bool motion = second_sensor && p.one_is_of_the_sensor();
      const auto seen = [&](const Rival& r) { return motion && r.motion ? r.motion : r.program; };
      list.push_back(p.can_be_told_by(protocol) ? separation(outputs(seen(p.a)), outputs(seen(p.b))) : -1);
    }
    return list;
  }

  /// Goes into the menu whether or not it says anything.
  std::optional<Outcome> tried(Protocol protocol, const Drive& drive, const Variant& variant = {}) {
    Outcome outcome{{}, {protocol.word, drive.name, variant.slower, variant.part}, menu_.items.size(), {}};
    outcome.item.as_recorded = variant.as_recorded;
    outcome.item.separations = separations(protocol);
    const auto said = weighed(protocol, outcome);
    menu_.items.push_back(outcome.item);
    if (!said) menu_.items.back().reason = why_it_says_nothing(protocol);
    outcome.protocol = std::make_shared<const Protocol>(std::move(protocol));
    return said ? std::optional(std::move(outcome)) : std::nullopt;
  }

  std::string why_it_says_nothing(const Protocol& protocol) const {
    const auto told = [&](const Pair& p) { return p.can_be_told_by(protocol); };
    return std::any_of(pairs_.begin(), pairs_.end(), told) ? "the models cannot follow it"
                                                           : "does not excite the signal that they need";
  }

  /// Whom it tells from whom; false if it says nothing.
  bool weighed(const Protocol& protocol, Outcome& outcome) const {
    const auto& apart = outcome.item.separations;
    Experiment& e = outcome.experiment;
    e.word = protocol.word;
    e.text = protocol.text;
    e.rows = static_cast<double>(protocol.t.size());
    double largest = -1, least = -1;
    std::vector<bool> told;
    bool asked = false;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const Pair& p = pairs_[i];
      if (p.with_first) largest = std::max(largest, apart[i]);
      e.separation = apart[i];
      told.push_back(apart[i] >= 0 && rivals_.tells(e, p.hidden()));
      if (!told.back()) continue;
      ++outcome.item.pairs_told;
      e.rivals_told += p.with_first;
      least = least < 0 ? apart[i] : std::min(least, apart[i]);
      asked = asked || std::find(p.words.begin(), p.words.end(), e.word) != p.words.end();
    }
    e.separation = outcome.item.pairs_told > 0 ? least : largest;
    outcome.item.separation = e.separation;
    outcome.item.rivals_told = e.rivals_told;
    if (e.separation < 0) return false;
    outcome.item.asked = asked && e.separation >= clearly;
    put_names(e, told);
    return true;
  }

  /// Two are named whether or not they are told apart; of more, who is told from whom and who is not.
  void put_names(Experiment& e, const std::vector<bool>& told) const {
    std::vector<std::string> names, yes, no;
    for (const auto& r : rivals_.models) names.push_back(r.effect);
    for (std::size_t i = 0; i < pairs_.size(); ++i) (told[i] ? yes : no).push_back(pairs_[i].names());
    e.between = fmt::format("{}", fmt::join(yes, ", "));
    if (yes.empty() || no.empty()) {
      e.between = fmt::format("{}", fmt::join(names.begin(), names.end() - 1, ", ")) + " and " + names.back();
      return;
    }
    e.text += fmt::format("; it would not separate {}", fmt::join(no, ", "));
  }

  void take(std::optional<Outcome> outcome) {
    if (outcome && (!best_ || better(*outcome, *best_))) best_ = std::move(outcome);
  }

  const Rivals& rivals_;
  const Device& device_;
  const Sight& sight_;
  std::vector<Pair> pairs_;
  std::vector<const Drive*> drives_;
  std::optional<Outcome> best_;
  Menu menu_;
};

}  // namespace

Separation separate(const Rivals& rivals, const Device& device, const Sight& sight) {
  return Search(rivals, device, sight).best();
}

}  // namespace hysteron
