#include "app/facts/fact_shapes.h"

#include <utility>

namespace hysteron::shape {
namespace {

Facts numbers(const std::string& meaning) { return list(meaning, number("one of them")); }

/// An object, or null where there is nothing to say.
Facts or_null(Facts shape) {
  shape.set("type", std::vector<std::string>{"object", "null"});
  return shape;
}

/// An object whose members may all be missing.
Facts loose(const std::string& meaning, std::vector<Member> members) {
  for (auto& member : members) member.sometimes = true;
  return object(meaning, members);
}

Facts estimate() {
  return object("a parameter", {{"parameter", text("its path")},
                                {"recording", text("whose value it is; empty: of all")},
                                {"unit", text("of the values")},
                                {"determined", flag("by the data; else it has no value")},
                                {"value", number("")},
                                {"standard_deviation", number("")},
                                {"low95", number("lower end of the 95 % interval")},
                                {"high95", number("upper end of the 95 % interval")},
                                {"start", number("where the fit began")},
                                {"at_bound", flag("the value lies at a bound")}});
}

Facts noise() {
  return object("noise of an output", {{"output", text("its name")},
                                       {"unit", text("of white")},
                                       {"white", number("rms")},
                                       {"one_over_f", number("rms of the 1/f part over the white rms")},
                                       {"one_over_f_estimated", flag("from the recordings")},
                                       {"source", text("where the figure comes from")}});
}

Facts profile() {
  return object("a parameter followed away from the result", {{"parameter", text("its path")},
                                                              {"recording", text("whose value it is; empty: of all")},
                                                              {"unit", text("of the values")},
                                                              {"low95", number("lower end of the interval")},
                                                              {"high95", number("upper end of the interval")},
                                                              {"values", numbers("at which the others were fitted")},
                                                              {"rise_of_chi2", numbers("there")}});
}

/// Poles and zeros.
Facts points(const std::string& meaning) { return list(meaning, numbers("real and imaginary part")); }

Facts stability(const std::string& meaning) {
  return object(meaning, {{"stable", flag("")},
                          {"unstable_poles", number("null: infinitely many")},
                          {"poles_on_the_limit", whole("on the imaginary axis or the unit circle")}});
}

Facts margins() {
  return or_null(loose("of the loop, closed with the sign -1", {{"phase_margin_deg", number("")},
                                                                {"phase_margin_at_hz", number("")},
                                                                {"delay_margin_s", number("dead time that it bears")},
                                                                {"delay_margin_samples", number("the same in samples")},
                                                                {"gain_from", number("it is stable above this factor")},
                                                                {"gain_to", number("it is stable below this factor")},
                                                                {"gain_margin", number("the nearer of both")},
                                                                {"gain_margin_at_hz", number("")}}));
}

Facts closed_loop() {
  return loose("T = L/(1 + L), S = 1/(1 + L)", {{"open_3db_hz", number("gain of L is -3 dB")},
                                                {"closed_3db_hz", number("gain of T is -3 dB")},
                                                {"closed_peak", number("largest gain of T")},
                                                {"closed_peak_at_hz", number("")},
                                                {"sensitivity_3db_hz", number("gain of S is -3 dB")},
                                                {"sensitivity_peak", number("largest gain of S")},
                                                {"sensitivity_peak_at_hz", number("")}});
}

Facts inspected_column() {
  return object("a column", {{"column", text("its name")},
                             {"is", text("input, output or other")},
                             {"unit", text("of the values")},
                             {"lowest", number("")},
                             {"highest", number("")},
                             {"roughness_rms", number("from row to row")},
                             {"finest_step", number("between two values"), sometimes}});
}

Facts inspected_recording() {
  const Facts gap = object("lost rows", {{"time_s", number("")}, {"rows", whole("how many")}});
  const Facts drive = object("what an input does", {{"input", text("its name")},
                                                    {"unit", text("of the values")},
                                                    {"lowest", number("")},
                                                    {"highest", number("")},
                                                    {"fastest_per_s", number("")},
                                                    {"reversals", whole("how many")},
                                                    {"swing_sizes", whole("different ones")},
                                                    {"longest_hold_s", number("")},
                                                    {"band_hz", numbers("lowest and highest frequency"), sometimes},
                                                    {"period_s", number(""), sometimes},
                                                    {"periods", number("how many"), sometimes}});
  return object("a recording", {{"recording", text("its name")},
                                {"role", text("train, validate or test")},
                                {"rows", whole("how many")},
                                {"duration_s", number("")},
                                {"step_s", number("of the clock")},
                                {"uniform", flag("all steps the same")},
                                {"jitter", number("share of the step")},
                                {"missing_rows", whole("how many")},
                                {"gaps", list("in it", gap)},
                                {"drives", list("of the inputs", drive)}});
}

}  // namespace

Facts metrics() {
  return list("of each output, by recording and role",
              object("how far the model is", {{"recording", text("its name, or all")},
                                              {"role", text("train, validate or all")},
                                              {"output", text("its name")},
                                              {"unit", text("of rms and peak")},
                                              {"rows", whole("judged")},
                                              {"rms", number("of the residual")},
                                              {"peak", number("of the residual")},
                                              {"nrmse", number("rms over the standard deviation of the measurement")},
                                              {"fit_percent", number("100 (1 - nrmse)")}}));
}

Facts splits() {
  const Facts spans = object("in one recording", {{"recording", text("its name")},
                                                  {"seconds", list("spans of time", numbers("from, to [s]"))}});
  const Facts part = object("a part", {{"label", text("which")},
                                       {"share_of_squared_error", number("that lies in it")},
                                       {"share_of_rows", number("that lie in it")},
                                       {"spans", list("when; of a frequency none", spans)}});
  return list("of the squared error", object("by one variable", {{"output", text("its name")},
                                                                 {"by", text("level, branch, rate, time ...")},
                                                                 {"sentence", text("the same in words; may be empty")},
                                                                 {"parts", list("of the rows", part)}}));
}

Facts of_fit() {
  const Facts correlation =
      object("of the estimates", {{"parameters", texts("their paths")}, {"matrix_row_by_row", numbers("")}});
  return object("of the fit", {{"diagram", text("its file")},
                               {"data", text("its recordings")},
                               {"method", text("that gave the values")},
                               {"seed", whole("of everything random")},
                               {"parameters", list("those that were free", estimate())},
                               {"noise", list("of the outputs", noise())},
                               {"chi2", number("over the train rows")},
                               {"prior_chi2", number("from prior ranges")},
                               {"rows", number("that chi2 counts")},
                               {"profiles", list("where they were asked for", profile())},
                               {"correlation", correlation},
                               {"before", metrics()},
                               {"after", metrics()},
                               {"simulations", whole("how many")},
                               {"converged", flag("the search ended by itself")},
                               {"interrupted", flag("ended early, with the best until then")}});
}

Facts of_small_motions() {
  const Facts matrix = list("rows", numbers("one row"));
  return object("state space in SI, x' = a x + b u, y = c x + d u",
                {{"diagram", text("its file")},
                 {"from", text("signal")},
                 {"to", text("signal")},
                 {"unit", text("of the gain")},
                 {"gain_at_low_frequencies", number("null: without bound")},
                 {"operating_point_s", number("time of it")},
                 {"states", texts("their names")},
                 {"a", matrix},
                 {"b", matrix},
                 {"c", matrix},
                 {"d", matrix},
                 {"dead_times_s", numbers("on the way")},
                 {"bandwidth_hz", number("-3 dB"), sometimes},
                 {"common_period_s", number("of sampled blocks"), sometimes},
                 {"sample_s", number("of sampled blocks"), sometimes},
                 {"poles_rad_per_s", points("where nothing is sampled"), sometimes},
                 {"poles_z", points("over the common period"), sometimes},
                 {"zeros_rad_per_s", points("where nothing is sampled"), sometimes},
                 {"stability", stability("as it stands, or as opened")},
                 {"stability_closed", stability("of the loop that was opened, closed"), sometimes},
                 {"margins", margins(), sometimes},
                 {"closed_loop", closed_loop(), sometimes},
                 {"cut_by", texts("blocks that pass nothing on here"), sometimes}});
}

Facts of_inspection() {
  const Facts repeat = object("how well an output repeats", {{"output", text("its name")},
                                                             {"what", text("was recorded twice")},
                                                             {"unit", text("of the values")},
                                                             {"rows", whole("compared")},
                                                             {"rms", number("of the difference")},
                                                             {"rms_without_offset", number("of the difference")}});
  const Facts line = object("a line that no input makes", {{"output", text("its name")},
                                                           {"frequency_hz", number("")},
                                                           {"amplitude", number("")},
                                                           {"unit", text("of the amplitude")},
                                                           {"recordings", texts("in which it is")}});
  const Facts cut = object("an input that is cut off", {{"input", text("its name")},
                                                        {"end", choice("of its range", {"highest", "lowest"})},
                                                        {"level", number("at which")},
                                                        {"would_be", number("what it would have reached")},
                                                        {"unit", text("of both")},
                                                        {"tops", whole("how many")},
                                                        {"recordings", texts("in which it is")}});
  const Facts between = object("an input between its samples", {{"input", text("its name")},
                                                                {"given", text("as the data set says")},
                                                                {"better", text("as the output says")},
                                                                {"error_share_removed", number("by that")}});
  const Facts can = object("an effect", {{"effect", text("its id")},
                                         {"places", texts("where it may enter")},
                                         {"leaves_open", text("what cannot be told for sure"), sometimes}});
  const Facts cannot = object("an effect", {{"effect", text("its id")}, {"reason", text("what the data lack")}});
  return object("of the recordings", {{"columns", list("of the recordings", inspected_column())},
                                      {"recordings", list("those that are looked at", inspected_recording())},
                                      {"repeats", list("what was recorded twice", repeat)},
                                      {"lines", list("interference", line)},
                                      {"cut_inputs", list("clipping", cut)},
                                      {"between_samples", list("ways of inputs", between)},
                                      {"faults", texts("what is wrong")},
                                      {"notes", texts("what a reader should know")},
                                      {"can_show", list("effects", can)},
                                      {"cannot_show", list("effects", cannot)}});
}

}  // namespace hysteron::shape
