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
      {{"deadzone", "deadband"},
       "a dead zone is its input less a \"saturation\" with the zone's ends as limits: a \"sum\" with "
       "\"signs\": \"+-\""},
      {{"ramps", "clock", "time"}, "a straight line over time is \"ramp\"; the time itself one of slope 1"},
      {{"pulses", "pulsegenerator", "rectangle", "rectangular", "square", "squarewave", "pulsetrain"},
       "pulses and square waves are \"pulse\"; the square of a signal is a \"product\" of it with itself"},
      {{"sawtooth", "repeatingsequence", "repeatingtable", "signalbuilder", "pwl", "timetable"},
       "points over time, once or again and again, are \"time_table\"; \"triangle\" rises and falls alike"},
      {{"scurve", "trajectory", "pointtopoint", "setpointgenerator", "profile", "motion"},
       "a move within limits of velocity, acceleration and jerk is \"motion_profile\""},
      {{"lookup", "lookuptable", "table", "1dlookuptable", "lookup1d", "lut", "interpolation", "interp", "map",
        "curve"},
       "a static curve is a \"polynomial\", straight outside its \"lower\" and \"upper\"; a table over time is "
       "\"recorded\""},
      {{"derivative", "differentiator", "differentiate", "diff", "der", "dudt"},
       "a derivative has to be filtered: a \"transfer_function\" with \"num\": [1, 0] and \"den\": [T, 1], T its time "
       "constant in seconds"},
      {{"switch", "multiportswitch", "selector", "if", "conditional"},
       "what is switched by a signal is a \"product\" with a \"relay\" whose values are 0 and 1; what is chosen before "
       "a run is a choice: {\"choose\": ..., \"from\": {...}}; elements of a vector are taken by \"select\""},
      {{"abs", "absolute", "absolutevalue", "fullwave", "fullwaverectifier", "magnitude"},
       "the absolute value is a \"rectifier\" with \"mix\": 1"},
      {{"halfwave", "halfwaverectifier", "diode", "positivepart", "max0", "relu"},
       "a half wave is a \"rectifier\" with \"mix\": 0.5"},
      {{"min", "max", "minmax"},
       "the larger of a and b is (a + b + |a - b|)/2: \"sum\", \"rectifier\" with \"mix\": 1, \"gain\""},
      {{"transportdelay", "timedelay", "puredelay", "delay", "latency", "deadtime", "transportlag"},
       "a delay in time is \"dead_time\"; one by whole samples is \"delay_line\""},
      {{"unitdelay", "z1", "sampledelay", "discretedelay"}, "a delay by samples is \"delay_line\""},
      {{"pidcontroller", "pd", "pdcontroller", "controller", "pi", "picontroller", "pidcontinuous"},
       "a PID controller is \"pid\", at sampling instants \"discrete_pid\""},
      {{"discretepid", "pidcontroller2dof", "digitalpid"}, "a digital PID controller is \"discrete_pid\""},
      {{"tf", "transferfcn", "transferfunction", "zpk", "zeropole"},
       "a transfer function is \"transfer_function\" with \"num\" and \"den\", highest power first; a sampled one is "
       "\"discrete_transfer_function\""},
      {{"ss", "statespace", "lti"}, "a linear system of states is \"state_space\""},
      {{"lowpass", "lowpassfilter", "filter", "firstorder", "pt1", "rc"},
       "a low-pass is a \"lag\" with its time constants; second order with a resonance is \"resonance\""},
      {{"highpass", "highpassfilter", "notch", "bandpass", "leadlag", "lead"},
       "such a filter is a \"transfer_function\" with \"num\" and \"den\""},
      {{"pt2", "secondorder", "oscillator"}, "a system of second order is \"resonance\""},
      {{"zoh", "zeroorderhold", "hold", "sampler", "sampleandhold", "ratetransition"},
       "sampling and holding is \"sample_hold\""},
      {{"limiter", "limit", "clamp", "clip", "sat", "saturate"}, "a limit is \"saturation\""},
      {{"ratelimit", "slewrate", "slewratelimiter"},
       "a limit of the rate is \"rate_limiter\", one on the way through \"slew_limit\""},
      {{"comparator", "schmitt", "schmitttrigger", "hysteresis", "bangbang", "onoff", "thermostat", "twopoint"},
       "what switches with a distance between on and off is \"relay\"; hysteresis of a material is \"play\", "
       "\"prandtl_ishlinskii\", \"bouc_wen\" or \"jiles_atherton\""},
      {{"sign", "signum", "coulomb", "coulombfriction", "stribeck"},
       "a sign that switches is a \"relay\"; friction is \"sliding_friction\" or \"mass_with_friction\""},
      {{"friction", "lugre", "dahl", "stiction"},
       "friction is \"sliding_friction\", of a mass \"mass_with_friction\" or \"mass_with_presliding\""},
      {{"spring", "damper", "mass", "springmassdamper", "msd"},
       "a mass on spring and damper is \"mass_spring_damper\""},
      {{"gear", "deadplay", "lostmotion", "freeplay"}, "play between parts is \"backlash\", as an operator \"play\""},
      {{"endstop", "hardstop", "bumper"}, "a mass between stops is \"mass_with_stops\""},
      {{"whitenoise", "random", "randomnumber", "bandlimitedwhitenoise", "gaussian", "randomsource"},
       "a random signal is \"noise\"; \"sensor_noise\" and \"sampled_noise\" (at each sample) add it to their input"},
      {{"adc", "dac", "quantize", "quantiser"}, "a converter is \"quantizer\"; without sampling \"rounding\""},
      {{"multiply", "divide", "times", "dot", "mul", "multiplier"},
       "signals are multiplied by \"product\"; by a number by \"gain\""},
      {{"add", "subtract", "plus", "difference", "summation", "adder", "feedback", "error"},
       "signals are added by \"sum\", subtracted with \"signs\": \"+-\""},
      {{"power", "pow", "sqr", "squared", "fcn", "function", "expression", "math", "sqrt"},
       "powers are a \"product\" of a signal with itself, or a \"polynomial\""},
      {{"sin", "sinewave", "cos", "cosine", "signalgenerator"}, "an oscillation is \"sine\", with a \"phase\""},
      {{"const", "bias", "dc"}, "a value that stays is \"constant\""},
      {{"heaviside", "unitstep"}, "a jump is \"step\""},
      {{"sweep", "sinesweep"}, "a sweep is \"chirp\""},
      {{"csv", "file", "fromfile", "fromworkspace", "timeseries", "signal", "playback"},
       "rows of a file are \"recorded\""},
      {{"scope", "sink", "display", "toworkspace", "tofile", "out", "outport"},
       "nothing has to be placed to see a signal: name it in \"record\", or in \"outputs\""},
      {{"in", "inport"}, "a signal from outside stands in \"inputs\", not in \"blocks\""},
      {{"subsystem", "submodel", "include", "component"}, "a diagram in a diagram is \"diagram\" with its \"file\""},
      {{"bus", "concatenate", "vector"}, "signals are joined by \"mux\" and taken apart by \"demux\""},
      {{"matrix", "matrixmultiply"}, "a matrix is \"matrix_gain\""},
      {{"integral", "integrate", "accumulator", "1s"}, "an integral over time is \"integrator\""},
  };
  return all;
}

}  // namespace

std::string instead_of_other_name(const std::string& type) {
  std::string plain;  // "Dead Zone" and "dead-zone" are "deadzone", as "dead_zone" is
  for (const char c : type)
    if (c != '_' && c != '-' && c != ' ') plain += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
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
