#include "report/pages/model_table.h"

#include <nlohmann/json.hpp>

#include "report/pages/facts.h"

namespace hysteron {
namespace {

Facts left_of(const FittedModel& m) {
  Facts::List left;
  for (const auto& l : m.left)
    left.push_back(Facts::object({{"recording", l.recording},
                                  {"output", l.output},
                                  {"rows", l.rows},
                                  {"scatter", l.scatter},
                                  {"correlation", l.correlation},
                                  {"stated_variance", l.stated_variance},
                                  {"least_variance", l.least_variance},
                                  {"squares", l.squares}}));
  return left;
}

}  // namespace

std::string model_table_text(const Discovery& found) {
  Facts::List models;
  for (const auto& m : found.table)
    models.push_back(Facts::object({{"step", m.step},
                                    {"effect", m.effect},
                                    {"place", m.place},
                                    {"law", m.law},
                                    {"numbers_let_go", m.numbers_let_go},
                                    {"chosen", m.chosen},
                                    {"parameters", m.parameters},
                                    {"ln_tried", m.ln_tried},
                                    {"moved", m.moved},
                                    {"left", left_of(m)}}));
  return in_order(Facts::object({{"models", models}})).dump(1) + "\n";
}

}  // namespace hysteron
