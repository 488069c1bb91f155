#include "discover/selection/kept_table.h"

#include <utility>

namespace hysteron {
namespace {

FittedModel row_of(const SearchState& state, const TableModel& f, int step) {
  FittedModel row;
  row.step = step;
  row.numbers_let_go = f.numbers == Numbers::let_go;
  row.parameters = f.parameters;
  row.moved = f.moved;
  for (const auto& [effect, ln] : f.tried) row.ln_tried += ln;
  const DataModel& model = *state.base_model;
  for (const auto& l : f.left_at_last()) {  // as it predicts: a table tells nothing of levels
    const auto& noise = state.evidence->noise().outputs[static_cast<std::size_t>(l.output)];
    row.left.push_back({model.recording(l.recording).name, model.outputs()[static_cast<std::size_t>(l.output)], l.rows,
                        l.scatter, l.correlation, noise.white_is_stated() ? noise.white * noise.white : 0,
                        least_variance(*state.evidence, l.output), l.squares});
  }
  return row;
}

bool stands(const TableModel& best, const Addition& rival) {
  for (const auto& s : best.model.placed)
    if (s.effect == rival.tried.effect && s.place.where() == rival.tried.place.where()) return true;
  return false;
}

}  // namespace

std::vector<FittedModel> table_of(const SearchState& state, const Selection& selection) {
  std::vector<FittedModel> table;
  int step = 0;
  for (const auto& round : selection.rounds()) {
    ++step;
    if (step == 1) {
      for (const TableModel* null : {&selection.nulls().written, &selection.nulls().let_go})
        if (null->ok()) table.push_back(row_of(state, *null, step));
    } else {
      table.push_back(row_of(state, round.on, step));
    }
    for (const auto& rival : round.rivals) {
      if (!rival.fitted.ok()) continue;
      FittedModel row = row_of(state, rival.fitted, step);
      row.effect = rival.tried.effect->id;
      row.place = rival.tried.place.where();
      row.law = rival.tried.laws[rival.tried.law].name;
      row.chosen = stands(selection.best(), rival);
      table.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace hysteron
