#include "discover/search/ties.h"

#include <algorithm>

#include "discover/placement/add.h"

namespace hysteron {
namespace {

/// So many times as fast as it wrote rows a recorder may sample: few write every sample that they take. To ask for more
/// is to ask for another one.
constexpr double faster_recorder = 8;

bool is_of_sensor(const Effect& e) { return e.of_the_sensor() && e.id != "calibration"; }

/// Inputs of the user's diagram that lead to what the candidate moves, and what it reads besides; empty = nobody knows.
std::vector<std::string> inputs_before(const SearchState& state, const TriedEffect& t) {
  std::vector<std::string> list;
  if (t.outputs.empty()) return list;
  for (const auto& input : state.base_model->program().input_names) {
    const auto moved = outputs_moved(state, t.candidate, input);
    const auto is_moved = [&](const std::string& o) { return std::find(moved.begin(), moved.end(), o) != moved.end(); };
    if (input == t.place.side || std::any_of(t.outputs.begin(), t.outputs.end(), is_moved)) list.push_back(input);
  }
  return list;
}

/// Compiled anew: fitted values stand in the diagram. Of an effect of the sensor also what lies before it.
Rival rival_of(const SearchState& state, const TriedEffect& t) {
  const CandidateModel& c = t.candidate;
  Rival r;
  r.effect = t.effect->id;
  r.program = compile(c.diagram, state.registry);
  if (is_of_sensor(*t.effect))
    r.motion = compile(remove_effect(c.diagram, state.registry, c.placed.back().name, t.effect->id), state.registry);
  if (!t.place.side.empty()) r.side = {t.place.side, t.effect->side};
  r.look_alikes = t.effect->look_alikes;
  r.inputs = inputs_before(state, t);
  r.hidden = t.hidden;
  return r;
}

/// A second sensor goes before every drive where it is asked for: would one of them do without it?
bool no_drive_tells(const Rivals& rivals, const Device& device, Sight sight, Menu& menu) {
  sight.second_sensor = false;
  auto [e, drives] = separate(rivals, device, sight);
  add_items(menu, without_choice(std::move(drives)));
  return !e || e->rivals_told == 0;
}

/// The same menu, sampled faster: takes its place if that tells more.
void try_faster_rows(const Rivals& rivals, Device device, const Sight& sight, Separation& so_far) {
  const auto told = [](const Experiment& x) { return std::pair(x.rivals_told, x.separation); };
  device.shortest_step /= faster_recorder;
  auto [again, menu] = separate(rivals, device, sight);
  for (auto& item : menu.items) item.faster_rows = faster_recorder;
  const bool more = again && (!so_far.best || told(*again) > told(*so_far.best));
  add_items(so_far.menu, more ? std::move(menu) : without_choice(std::move(menu)));
  if (more) so_far.best = std::move(again);
}

Separation experiment_among(SearchState& state, const Rivals& rivals) {
  Sight sight{state.base_model->outputs(), state.evidence->noise().white(), {}};
  for (int o = 0; o < static_cast<int>(sight.outputs.size()); ++o)
    sight.free_zero.push_back(state.base_model->zero_per_recording(o));
  const Device device = device_of(state.base_model->program(), *state.data);
  Separation found = separate(rivals, device, sight);
  auto& e = found.best;
  const int all = static_cast<int>(rivals.models.size()) - 1;
  // Few recordings of one kind may just have been too slow.
  const bool few = static_cast<int>(state.evidence->recordings().size()) <= rules::few_recordings;
  if (few && !(e && e->rivals_told == all && e->separation > rules::experiment_tells))
    try_faster_rows(rivals, device, sight, found);
  if (e && e->word == "reference_sensor" && !few)
    e->another_instrument = no_drive_tells(rivals, device, sight, found.menu);
  return found;
}

/// The recording that would separate two candidates best, and all that were simulated.
Separation experiment_between(SearchState& state, const TriedEffect& a, const TriedEffect& b) {
  return experiment_among(state, {{rival_of(state, a), rival_of(state, b)}, would_tell});
}

/// The experiment of a tie that another rival joins: chosen anew, to tell all of them apart.
Separation with_another_rival(SearchState& state, const Experiment& so_far, const TriedEffect& rival) {
  Rivals rivals = *so_far.rivals;
  rivals.models.push_back(rival_of(state, rival));
  return experiment_among(state, rivals);
}

}  // namespace

bool could_hold(const SearchState& state, const Law& law, const Effect& e) {
  return std::any_of(law.holds.begin(), law.holds.end(), [&](const std::string& id) {
    const Effect* held = state.effects.find(id);
    // A curve has no memory, whatever else looks like it.
    return held != nullptr && (held == &e || (look_alike(*held, e) && held->is_memory == e.is_memory));
  });
}

bool is_the_winner_and_more(const SearchState& state, const TriedEffect& t, const Effect& winner) {
  const auto& contained = t.effect->contains;
  return std::find(contained.begin(), contained.end(), winner.id) != contained.end() ||
         could_hold(state, t.laws[t.law], winner);
}

void add_tie(SearchState& state, int step, FoundStep& found, const TriedEffect& winner, const TriedEffect& rival) {
  found.ties.push_back(candidate_of(rival, step));
  if (state.stopped()) return;
  auto [e, menu] =
      found.experiment ? with_another_rival(state, *found.experiment, rival) : experiment_between(state, winner, rival);
  if (e || !found.experiment) found.menu = std::move(menu);
  if (!e) return;
  found.experiment_would_tell = e->rivals_told > 0;
  found.experiment = std::move(e);
}

bool would_tell(const Experiment& e, bool hidden) {
  return e.separation > rules::experiment_tells ||
         (hidden && e.separation * e.separation * e.rows > 2 * rules::claim_fall);
}

}  // namespace hysteron
