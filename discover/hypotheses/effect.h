// Decides what an effect is: a physical hypothesis as data - law, places, parameters, what it needs, what looks like
// it. Does not decide whether it is missing (discover.h) nor how it enters a diagram (add.h).
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "discover/wiring/commutes.h"
#include "engine/block/declaration.h"
#include "engine/diagram/diagram.h"
#include "engine/diagram/units.h"

namespace hysteron {

/// How an effect enters.
enum class Way {
  insert,  ///< a block with one signal in and the same signal out, put on a wire
  vary,    ///< a block of the diagram gets a parameter that it did not have
  data     ///< a value of the recording
};
std::string to_text(Way way);

/// A second signal that an effect reads besides the wire that it stands on.
enum class Side {
  none,
  temperature,  ///< an input of the diagram or a column of the recordings that is a temperature and no output
  force,        ///< an input of the diagram or a column of the recordings that is a force
  use,          ///< what the device had behind it when a recording began: cycles_before or start of the data set
  other_axis    ///< drive or motion of another axis: an input, a column or an output's signal that this wire neither
                ///< moves nor follows
};

/// How differently a signal swings between its turning points; as it stands here, as differently as any effect asks.
struct Swings {
  int sizes = 3;             ///< that differ by a tenth of the range or more
  double size_ratio = 10;    ///< largest over smallest
  int middles = 3;           ///< of the swings, that differ so
  double speed_ratio = 100;  ///< of the fastest change on each, largest over smallest
};

/// A pair of complex poles.
struct Resonance {
  double frequency = 0;  ///< [Hz], undamped
  double damping = 0;    ///< ratio
};

/// What is known of a place before an effect is tried there: the signal of the wire as the present model makes it, over
/// the recordings (but those kept for the end), and how finely and how long it was recorded. Numbers in SI.
struct Excitation {
  bool from_data = false;  ///< false: nobody looked at data, the numbers below are placeholders
  Unit unit;               ///< of the wire, as it is written
  double lowest = 0, highest = 1;
  std::string by;  ///< the type that would replace the block there; "" = an effect on a wire
  double travel_lowest = 0, travel_highest = 0;  ///< of the first output of that block
  std::map<std::string, double> own{};           ///< numbers [SI] of that block by their names
  bool springless = false;                       ///< that block is a mass whose stiffness is 0, and not free
  /// The gain [SI] of the damping that makes a force or a torque of the speed on the wire; none = it stands before
  /// none.
  std::optional<double> damping{};
  /// Before an integrator: the force [N] or torque [N m] over the acceleration on the wire, where the wire says it.
  std::optional<double> inertia{};
  double largest_jump = 0;             ///< largest change between two rows
  double shortest_step = 1e-3;         ///< [s] between rows, smallest over the recordings
  double longest_step = 1e-3;          ///< [s]
  double longest_recording = 100;      ///< [s] of any recording
  double longest_hold = 0;             ///< [s] at one level after a move of at least 5 % of the range
  double step_at_longest_hold = 1e-3;  ///< [s] between rows in that hold
  int reversals = 0;                   ///< turning points that come back by at least 2 % of the range
  Swings swings;
  int recordings = 0;                  ///< how many
  double quickest = 0;                 ///< [1/s] largest change per second over the range
  bool starts_away_from_zero = false;  ///< the wire is not at zero at the start of some recording
  bool gain_is_free = false;           ///< a free gain in series behind the place makes a gain here undetermined
  bool offset_is_free = false;         ///< a free offset behind the place (or a free zero of each recording)
  bool zero_of_recording = false;      ///< each recording has a zero of its own: nobody knows where a scale begins
  /// Program paths of the constants that add to the signal behind the place ("sensor.offset"), free or not.
  std::vector<std::string> zeros;
  std::vector<std::string> weights;        ///< program paths of the weights of operators behind the place
  std::vector<std::string> memory_blocks;  ///< blocks with memory on the way from the inputs to the outputs
  double roughness = 0;                    ///< noise of the measured output that this wire is; 0 = none, or no output
  double resolution = 0;  ///< step between the levels of the measured output that this wire is; 0 = none, or no output
  double level = 0;       ///< one of these levels
  Unit side_unit;         ///< of the side signal, where the effect reads one
  double side_lowest = 0, side_highest = 1;
  double side_at_start = 0;  ///< median over the recordings of the side signal's first value
  /// How often the drive of each recording comes again [Hz]; empty unless each is a sine or the like.
  std::vector<double> drive_cycles;
  /// Of the user's model, where effects stand in it already: what their laws leave rings there.
  std::vector<Resonance> own_resonances;
  /// Correlation of the side signal with this wire, -1..1.
  double side_correlation = 0;
  double range() const { return highest - lowest; }
};

/// One free number of a law. `path` is relative to the block: "delay", "weights[2]". All numbers in SI.
struct LawParameter {
  std::string path;
  double start = 0;  ///< not a number: as the block has it already (vary), times `share`
  double share = 1;  ///< of the value that the block has: where the same flow takes another number
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool log_scale = false;
  std::vector<double> scan{};  ///< values at which a fit begins
  /// A frequency of a line: the bands [Hz] in which the strongest lines of the residual take the place of `scan`, where
  /// there is a residual to look at.
  std::vector<std::pair<double, double>> line_bands{};
  /// A period in the signal of the wire, which is measured: those of the strongest ripples of the residual over that
  /// signal take the place of `scan`, where there is a residual to look at.
  bool period_of_wire = false;
  /// Its value is another one in each recording and found on that recording alone, validation included; linear.
  bool per_recording = false;
  /// The column itself says it, and 0 silences the law: all else is fitted so, for between two levels an output has no
  /// derivative.
  bool read_off_column = false;
  /// 0 is no effect, and what the effect does grows with this number, in proportion while it is small (and with others
  /// of the law that are marked so). Of first laws: see EffectLimit.
  bool is_size = false;
  /// It makes up for what the size does besides: the wire's own gain beside plays, which add to it.
  bool beside_size = false;
  /// It changes places with others of the law that are: where two have one value, no slope leads a search apart again.
  bool interchangeable = false;
  double plausible_lower = -std::numeric_limits<double>::infinity();  ///< outside: possible, but said to be unusual
  double plausible_upper = std::numeric_limits<double>::infinity();
};

/// One form of an effect, ready to be inserted: a block type with its parameters, and which of them are free.
struct Law {
  std::string name;  ///< "one pole", "two poles": shown to people, unique within the effect
  Node block;        ///< type and parameters as they are written into the file (start values)
  std::vector<LawParameter> free;
  bool apart = false;                ///< no refinement of the first law: tried whatever that one brought
  bool reweighs = false;             ///< the weights of the operators behind the place are found anew with it
  std::vector<std::string> holds{};  ///< effects that it could describe besides its own
};

/// Path of a law's parameter in the program of a diagram in which the law stands as `choice`: "drive_lag.times[0]"; of
/// a law that is a diagram itself "drive_own/tau".
std::string parameter_path(const std::string& choice, const Law& law, const LawParameter& parameter);

/// One parameter as people read about it.
struct EffectParameter {
  std::string name, unit, meaning;
  std::string range;  ///< plausibility limits with their source
};

/// An effect that can be taken for this one, and what separates them.
struct LookAlike {
  std::string effect;
  std::string experiment;  ///< a word of the menu of experiments
  std::string deciding;    ///< the feature that decides
};

/// An effect of the library. Built from plain data and two functions of the circumstances.
struct Effect {
  std::string id, title, cause, equation, source;
  std::string residual;  ///< what it leaves in the residual, for people
  std::string needs;     ///< the data it needs, for people
  Way way = Way::insert;
  std::string block_type;  ///< the block that it inserts (insert); the registry knows it
  std::string parameter;   ///< the parameter that it sets (vary, data)
  std::string file{};      ///< where a user's own effect was read from (effect_file.h); "" = of the library
  /// A block that offers this variation may be replaced by its richer type besides: the law is then that type.
  std::string variation;
  /// The same where a block offers this one only, and its output may be so: an integrator that makes a speed.
  std::string or_variation{};
  std::function<bool(const Unit&)> or_where{};
  std::vector<std::string> places;  ///< kinds of place (place_kinds; with "core": see `behind_core`)
  Side side = Side::none;           ///< the signal that its block reads behind the wire
  bool behind_core = false;         ///< at the core only behind it (its parallel effects), else before and behind
  bool else_a_block = false;        ///< own block: at the core if no block offers the variation, else where measured
  int least_outputs = 1;       ///< measured ones behind its place: where there are fewer, another effect is the same
  bool straight = false;       ///< a line, nothing else: what another law takes beyond it is that law's own
  bool before_sensor = false;  ///< not on a wire that is measured itself: there its law is the sensor's own
  Commutes commutes = Commutes::nothing;
  /// The law shifts the middle of the signal: a zero that was found for the model without it no longer holds and is
  /// found anew.
  bool moves_zero = false;
  bool of_the_sensor() const { return places == std::vector<std::string>{"measured"}; }  ///< it enters nowhere else
  bool is_memory = false;  ///< the law remembers turning points
  std::vector<EffectParameter> parameters;
  std::vector<LookAlike> look_alikes;
  /// The effect whose richer law says the same: that one is tried, this one where the user names it. "" = none.
  std::string law_of{};
  std::string family;  ///< effects of one family differ by place only ("lag": in the amplifier or in the sensor)
  std::vector<std::string> contains;  ///< effects that its law can imitate with spare parameters: no rival of theirs
  /// Effects that ask for less to be believed: where they explain as much, they go first.
  std::vector<std::string> plainer;
  /// Laws, simplest first; those behind the first are tried where the first is among the best, or where they stand
  /// apart.
  std::function<std::vector<Law>(const Excitation&)> laws;
  /// Why this effect cannot be seen in this data at this place, and which data would show it; "" = it can.
  std::function<std::string(const Excitation&)> unseen;
  /// Why it can be seen in this data but not well told from others, or not in full: which of its needs are not met; ""
  /// = they are. May be empty.
  std::function<std::string(const Excitation&)> unsure{};
  /// What `unseen` tells is how little is seen, not that nothing can be: a score that compares whole models asks what
  /// the recordings say all the same.
  bool seen_by_degrees = false;
  /// Where it cannot be seen: true if it may have acted all the same, alike in all recordings, so that a look-alike
  /// would be taken for it. May be empty: then it has not.
  std::function<bool(const Excitation&)> may_hide;
  /// Why fitted values, though they may fit, are not this effect ("all of it lies beyond the longest hold"); "" = they
  /// are.
  std::function<std::string(const Law&, const std::vector<double>&, const Excitation&)> implausible;
  /// What the fitted law says, in one phrase ("1.5 % of the move per decade"); values [SI] as Law::free, but
  /// for numbers that begin where the user has them and are free in the diagram: these come last, and lack. May be
  /// empty.
  std::function<std::string(const Law&, const std::vector<double>&, const Excitation&)> summary;
};

/// The variation by which an effect may enter a block of this kind; nullptr = none.
const VariationDeclaration* varied_by(const Effect& effect, const Declaration& block);

/// The effects that hysteron knows, in the order in which they are tried.
class Effects {
 public:
  explicit Effects(std::vector<Effect> list);
  const std::vector<Effect>& list() const { return list_; }
  const Effect* find(const std::string& id) const;
  /// Throws Error "unknown_effect" with the nearest name.
  const Effect& get(const std::string& id) const;
  std::vector<std::string> ids() const;

 private:
  std::vector<Effect> list_;
};

/// A list of numbers with one unit, as a block parameter.
NumberList with_unit(const std::vector<double>& si, const Unit& unit);
Number with_unit(double si, const Unit& unit);
/// The same of a value that is no difference, to ten digits: 273.15 K as "0 degC".
Number value_in_unit(double si, const Unit& unit);
/// "weights[3]"
std::string element(const std::string& list, int index);

}  // namespace hysteron
