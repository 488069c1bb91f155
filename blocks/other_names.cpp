#include "blocks/other_names.h"

namespace hysteron {
namespace {

/// Words without "_", "-" and blanks, all of which mean the same.
struct OtherNames {
  std::vector<const char*> words;
  const char* instead;
};

const std::vector<OtherNames>& table() {
  static const std::vector<OtherNames> all{
      {{"deadband"}, "a dead band is \"dead_zone\""},
      {{"ramps", "clock", "time"}, "a straight line over time is \"ramp\"; the time itself one of slope 1"},
      {{"pulses", "pulsegenerator", "rectangle", "rectangular", "square", "squarewave", "pulsetrain"},
       "pulses and square waves are \"pulse\"; the square of a signal is a \"product\" of it with itself"},
      {{"sawtooth", "repeatingsequence", "repeatingtable", "signalbuilder", "pwl", "timetable"},
       "points over time, once or periodic, are \"time_table\"; a symmetric sawtooth is \"triangle\""},
      {{"scurve", "trajectory", "pointtopoint", "setpointgenerator", "profile", "motion"},
       "a move within limits of velocity, acceleration and jerk is \"motion_profile\""},
      {{"lookuptable", "table", "1dlookuptable", "2dlookuptable", "ndlookuptable", "lookuptabledynamic", "prelookup",
        "lookup1d", "lookup2d", "lut", "interpolation", "interp", "map", "curve", "gainschedule"},
       "a table over one axis or several is \"lookup\", a curve with few numbers \"polynomial\"; rows over time are "
       "\"recorded\""},
      {{"derivative", "differentiator", "differentiate", "diff", "der", "dudt"},
       "a derivative has to be filtered: \"filtered_derivative\" with its time constant"},
      {{"integratorlimited", "integratorwithlimits", "saturatedintegrator"},
       "an integrator that stops at limits is \"limited_integrator\""},
      {{"resettableintegrator", "integratorwithexternalreset"},
       "an integrator with a reset is \"integrator_with_reset\""},
      {{"variabletransportdelay", "variabletimedelay", "variabledelay"}, "a variable delay is \"variable_dead_time\""},
      {{"modulo", "unwrap", "wraptozero", "wraptopi", "wrapto360"}, "an angle within one turn is \"wrap\""},
      {{"multiportswitch", "selector", "if", "conditional", "ifelse"},
       "one of two signals is taken by \"switch\", or by if() in an \"expression\"; what is chosen before a run is a "
       "choice: {\"choose\": ..., \"from\": {...}}; elements of a vector are taken by \"select\""},
      {{"absolute", "absolutevalue", "fullwave", "fullwaverectifier", "magnitude"},
       "the absolute value is \"abs\", a share of it a \"rectifier\""},
      {{"halfwave", "halfwaverectifier", "diode", "positivepart", "max0", "relu"},
       "a half wave is a \"rectifier\" with \"mix\": 0.5"},
      {{"min", "max", "minmax", "minimum", "maximum"}, "the minimum or maximum of several signals is \"min_max\""},
      {{"relational", "relationaloperator", "comparetoconstant", "comparetozero", "greater", "less", "equal"},
       "whether one signal is above another is \"compare\", above a level \"comparator\""},
      {{"logical", "logicaloperator", "boolean", "and", "or", "not", "xor", "nand", "nor"},
       "what is true or false is joined by \"logic\", longer conditions by an \"expression\""},
      {{"detectrisepositive", "detectincrease", "detectchange", "edgedetector", "risingedge", "monoflop", "trigger"},
       "a sampled edge is \"edge\"; at any instant \"sample_and_hold\", \"counter\" and \"timer\" follow edges"},
      {{"orifice", "valve", "flowresistance", "convection", "convectiveheattransfer", "radiation",
        "radiativeheattransfer", "peltier", "thermoelectric", "hydraulic", "cylinder", "hydrauliccylinder"},
       "a flow by a law of its own is an \"expression\", as q0*sign(p)*sqrt(abs(p)/p0) of an orifice, h*(a - b) of "
       "convection, c*(a^4 - b^4) of radiation; bodies that exchange heat are a \"thermal_network\", a vessel is a "
       "\"tank\""},
      {{"count", "counterfreerunning", "counterlimited", "stopwatch", "ondelay", "ton"},
       "edges are counted by \"counter\", the time since one by \"timer\""},
      {{"transportdelay", "timedelay", "puredelay", "delay", "latency", "deadtime", "transportlag"},
       "a delay in time is \"dead_time\"; one by whole samples is \"delay_line\""},
      {{"unitdelay", "memory", "z1", "sampledelay", "discretedelay", "tappeddelay"},
       "a delay by samples is \"delay_line\""},
      {{"pidcontroller", "pd", "pdcontroller", "controller", "pi", "picontroller", "pidcontinuous"},
       "a PID controller is \"pid\", at sampling instants \"discrete_pid\""},
      {{"discretepid", "pidcontroller2dof", "digitalpid"}, "a digital PID controller is \"discrete_pid\""},
      {{"tf", "transferfcn", "transferfunction"},
       "a transfer function is \"transfer_function\" with \"num\" and \"den\", highest power first; a sampled one is "
       "\"discrete_transfer_function\""},
      {{"zpk", "zeropole"}, "zeros, poles and a gain are \"zero_pole_gain\"; by frequency and damping \"biquads\""},
      {{"ss", "statespace", "lti"},
       "a linear state-space system is \"state_space\"; a sampled one \"discrete_state_space\""},
      {{"discretestatespace", "discretess"}, "a sampled linear state-space system is \"discrete_state_space\""},
      {{"discretefilter", "discretetransferfcn", "discretetransferfunction", "iir"},
       "a filter by its coefficients is \"discrete_transfer_function\", by type and corner frequency "
       "\"digital_filter\""},
      {{"discretefir", "firfilter", "discretefirfilter"}, "weights of the last samples are \"fir\""},
      {{"movingaverage", "runningmean", "movingmean", "boxcar", "mean"},
       "the mean of the last samples is \"moving_average\""},
      {{"discreteintegrator", "discretetimeintegrator"},
       "the sum of samples times the period is \"discrete_integrator\""},
      {{"butterworth", "chebyshev", "digitalfilter", "analogfilterdesign"},
       "a sampled filter by type and corner frequency is \"digital_filter\"; a continuous one of second "
       "order \"second_order\", of higher order \"biquads\""},
      {{"shaper", "zv", "zvd", "commandshaper", "posicast"},
       "a command that leaves a mode at rest comes from \"input_shaper\" (ZV; two of them are ZVD)"},
      {{"luenberger", "stateobserver", "stateestimator", "estimator"},
       "states are estimated by an \"observer\" with a given gain, or a \"kalman_filter\" from noise "
       "covariances"},
      {{"kalman", "kalmanfilter"}, "a Kalman filter is \"kalman_filter\""},
      {{"disturbanceobserver", "dob"}, "disturbances are estimated by \"disturbance_observer\""},
      {{"repetitivecontrol", "iterativelearning", "ilc"},
       "errors that repeat every cycle are corrected by \"repetitive_controller\""},
      {{"encoderquantizer", "incrementalencoder", "rotaryencoder", "resolver"},
       "counts of an angle are \"encoder\", along a scale \"linear_encoder\""},
      {{"pulsewidthmodulation", "pulsewidth", "modulator", "inverter"},
       "pulse-width modulation is \"pwm\", before an \"h_bridge\""},
      {{"hbridge", "fullbridge", "amplifierbridge", "chopper"},
       "a bridge of switches is \"h_bridge\", after a \"pwm\""},
      {{"pmsm", "bldc", "brushless", "synchronousmachine", "acmotor"},
       "a motor with permanent magnets in its rotor is \"synchronous_motor\""},
      {{"stepper", "steppermotor", "steppingmotor"}, "a stepper of two phases is \"stepper_motor\""},
      {{"voicecoilmotor", "vcm", "voicecoilactuator", "loudspeaker", "lorentz"},
       "a coil in the field of a magnet is \"voice_coil\"; if its constant depends on the position, "
       "\"winding\" and a \"product\""},
      {{"rl", "inductor", "coil", "inductance"}, "resistance and inductance of one current are a \"winding\""},
      {{"battery", "cell", "accumulator", "liion"}, "a cell with its open-circuit curve is \"battery_cell\""},
      {{"fan", "rotor", "thruster", "prop"}, "a fan or propeller is \"propeller\""},
      {{"lowpass", "lowpassfilter", "filter", "firstorder", "pt1", "rc"},
       "a low-pass is a \"lag\" with its time constants, of second order \"second_order\"; a sampled one is "
       "\"digital_filter\""},
      {{"highpass", "highpassfilter", "bandpass", "bandpassfilter"},
       "such a filter is \"second_order\" with its \"pass\"; a sampled one is \"digital_filter\""},
      {{"leadlag", "lead", "leadcompensator", "lagcompensator"}, "one zero and one pole are \"lead_lag\""},
      {{"notchfilter", "bandstop", "bandstopfilter"},
       "a filter that removes one frequency is \"notch\"; a sampled one is \"digital_filter\" with "
       "\"pass\": \"stop\""},
      {{"biquad", "sos", "secondordersections"}, "sections of second order are \"biquads\""},
      {{"pt2", "secondorder", "oscillator"}, "a system of second order is \"second_order\" or \"resonance\""},
      {{"zoh", "zeroorderhold", "hold", "sampler", "ratetransition"},
       "sampling and holding with a clock is \"sample_hold\", at the edges of a signal \"sample_and_hold\""},
      {{"limiter", "limit", "clamp", "clip", "sat", "saturate"}, "a limit is \"saturation\""},
      {{"ratelimit", "slewrate", "slewratelimiter"},
       "a rate limit is \"rate_limiter\"; one that is exact for recordings is \"slew_limit\""},
      {{"schmitt", "schmitttrigger", "hysteresis", "bangbang", "onoff", "thermostat", "twopoint"},
       "switching with hysteresis is \"relay\"; hysteresis of a material is \"play\", "
       "\"prandtl_ishlinskii\", \"bouc_wen\" or \"jiles_atherton\""},
      {{"signum"}, "the direction of a signal is \"sign\""},
      {{"coulomb", "coulombfriction", "coulomb&viscousfriction", "coulombandviscousfriction", "stribeck"},
       "friction is \"bearing_friction\" before the gain that is the damping, of a mass \"mass_with_friction\""},
      {{"friction", "lugre", "dahl", "stiction"},
       "friction is \"bearing_friction\" before the gain that is the damping, of a mass \"mass_with_friction\" or "
       "\"mass_with_presliding\""},
      {{"spring", "damper", "mass", "translationalspring", "translationaldamper", "springmassdamper", "msd"},
       "a mass on spring and damper is \"mass_spring_damper\""},
      {{"deadplay", "lostmotion", "freeplay"},
       "play between parts is \"backlash\", as an operator \"play\", of a gear its \"gap\": \"gear\""},
      {{"gearbox", "coupling", "transmission", "pulley", "timingbelt"},
       "two shafts are joined by \"gear\", a shaft and a carriage by \"belt\""},
      {{"leadscrew", "spindle", "screw", "ballscrewdrive"}, "a screw with its nut is \"ball_screw\""},
      {{"flywheel", "shaft", "rotationalinertia", "rotarymass"}, "what a torque turns is \"inertia\""},
      {{"motor", "dcmachine", "servomotor", "brushedmotor"},
       "a motor with brushes is \"dc_motor\", its winding alone \"dc_winding\""},
      {{"endstop", "hardstop", "bumper"}, "a mass between stops is \"mass_with_stops\""},
      {{"whitenoise", "random", "randomnumber", "bandlimitedwhitenoise", "gaussian", "randomsource"},
       "a random signal is \"noise\"; \"sensor_noise\" and \"sampled_noise\" (at each sample) add it to their input"},
      {{"adc", "dac", "quantize", "quantiser"}, "a converter is \"quantizer\"; without sampling \"rounding\""},
      {{"slidergain", "amplifier", "factor", "attenuator"}, "a factor with a unit is \"gain\""},
      {{"multiply", "times", "dot", "mul", "multiplier"},
       "signals are multiplied by \"product\"; by a number by \"gain\""},
      {{"division", "quotient", "ratio", "reciprocal"}, "signals are divided by \"divide\", or in an \"expression\""},
      {{"add", "subtract", "plus", "difference", "summation", "adder", "feedback", "error"},
       "signals are added by \"sum\", subtracted with \"signs\": \"+-\""},
      {{"power", "pow", "sqr", "squared", "fcn", "function", "mathfunction", "math", "matlabfunction", "formula",
        "equation", "sqrt", "exp", "log", "hypot", "mod", "script"},
       "a formula is an \"expression\": {\"type\": \"expression\", \"y\": \"sqrt(u)\", \"in\": ...}"},
      {{"sinewave", "signalgenerator", "sinusoid"}, "an oscillation is \"sine\", with a \"phase\""},
      {{"sin", "cos", "cosine", "tan", "asin", "acos", "atan", "atan2", "trigonometricfunction"},
       "functions of an angle are \"trigonometry\", an oscillation over time is \"sine\""},
      {{"const", "bias", "dc"}, "a constant value is \"constant\""},
      {{"heaviside", "unitstep"}, "a jump is \"step\""},
      {{"sweep", "sinesweep", "chirpsignal"}, "a sweep is \"chirp\""},
      {{"csv", "file", "fromfile", "fromworkspace", "timeseries", "signal", "playback"},
       "rows of a file are \"recorded\""},
      {{"scope", "sink", "display", "toworkspace", "tofile", "out", "outport"},
       "no block is needed to see a signal: name it in \"record\", or in \"outputs\""},
      {{"in", "inport"}, "a signal from outside stands in \"inputs\", not in \"blocks\""},
      {{"subsystem", "modelreference", "submodel", "include", "component"},
       "a diagram in a diagram is \"diagram\" with its \"file\""},
      {{"enabledsubsystem", "triggeredsubsystem", "enabledandtriggeredsubsystem", "resettablesubsystem"},
       "what runs while a signal is true, or at its edges, is a \"diagram\" with \"enable\" or \"trigger\""},
      {{"stateflow", "stateflowchart", "chart", "statechart", "fsm", "finitestatemachine", "automaton"},
       "states and the conditions that lead from one to another are a \"state_machine\""},
      {{"goto", "from", "label"}, "a wire is a name, which any block may read: \"in\": \"NAME\", also in \"outputs\""},
      {{"bus", "buscreator", "busselector", "concatenate", "vectorconcatenate", "vector"},
       "signals are joined by \"mux\" and taken apart by \"demux\""},
      {{"matrix", "matrixmultiply"}, "a matrix is \"matrix_gain\""},
      {{"integral", "integrate", "1s"}, "an integral over time is \"integrator\""},
  };
  return all;
}

}  // namespace

std::string plain_name(const std::string& type) {
  std::string plain;
  for (const char c : type)
    if (c != '_' && c != '-' && c != ' ') plain += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return plain;
}

std::string instead_of_other_name(const std::string& type) {
  const std::string plain = plain_name(type);
  for (const auto& [words, instead] : table())
    for (const char* word : words)
      if (plain == word) return instead;
  return "";
}

std::vector<std::string> other_names() {
  std::vector<std::string> all;
  for (const auto& [words, instead] : table()) all.insert(all.end(), words.begin(), words.end());
  return all;
}

}  // namespace hysteron
