#include "report/pages/motion_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/pages/numbers.h"

namespace hysteron {
namespace {

using std::numbers::pi;

constexpr std::size_t poles_in_a_sentence = 8;

double degrees(double radians) { return radians * 180 / pi; }

std::string delay_text(double seconds) {
  return seconds < 1e-3 ? number_text(seconds * 1e6) + " us"
         : seconds < 1  ? number_text(seconds * 1e3) + " ms"
                        : number_text(seconds) + " s";
}

std::string complex_text(std::complex<double> p) {
  return p.imag() == 0 ? number_text(p.real(), 5)
                       : fmt::format("{} +- {}j", number_text(p.real(), 5), number_text(std::abs(p.imag()), 5));
}

std::string pole_text(std::complex<double> p) {
  if (p == 0.0) return "0 (an integrator)";
  if (p.imag() == 0) return complex_text(p) + " rad/s";
  const double size = std::abs(p);
  return fmt::format("{} rad/s ({}, damping {})", complex_text(p), frequency_text(size),
                     number_text(-p.real() / size, 3));
}

/// z over the period, with what it means in time.
std::string sampled_pole_text(std::complex<double> z, double period) {
  if (z == 1.0) return "1 (an integrator)";
  if (z.imag() == 0) return complex_text(z);
  const auto s = std::log(z) / period;
  return fmt::format("{} ({}, damping {})", complex_text(z), frequency_text(std::abs(s)),
                     number_text(-s.real() / std::abs(s), 3));
}

std::string text_of(std::complex<double> p, const SmallMotions& m) {
  return m.sampled ? sampled_pole_text(p, m.sampled->period) : pole_text(p);
}

/// One text for each pair.
std::vector<std::string> texts(const std::vector<std::complex<double>>& list, const SmallMotions& m) {
  std::vector<std::string> all;
  for (const auto& p : list)
    if (p.imag() >= 0) all.push_back(text_of(p, m));
  return all;
}

std::string sentence(const char* what, std::vector<std::string> all) {
  if (all.empty()) return "";
  const std::size_t more = all.size() - std::min(all.size(), poles_in_a_sentence);
  all.resize(all.size() - more);
  return fmt::format("{}: {}{}.", what, fmt::join(all, "; "), more > 0 ? fmt::format("; and {} more", more) : "");
}

void add(Document& document, std::string text) {
  if (!text.empty()) document.sentences.push_back(std::move(text));
}

Facts::List list_of(const std::vector<std::complex<double>>& numbers) {
  Facts::List list;
  for (const auto& p : numbers) list.emplace_back(std::vector<double>{p.real(), p.imag()});
  return list;
}

std::string at_text(double w) {
  if (std::isnan(w)) return "";
  if (std::isinf(w)) return " at high frequencies";
  return w == 0 ? " at standstill" : " at " + frequency_text(w);
}

std::string factor_text(double factor) {
  return fmt::format("{} ({} dB)", number_text(factor), number_text(20 * std::log10(factor)));
}

void tell_phase(Document& document, Facts& given, const SmallMotions& m) {
  const Margins& margins = *m.margins;
  std::string text;
  if (margins.phase_margin) {
    text = fmt::format("Phase margin {} deg at {}", number_text(degrees(*margins.phase_margin)),
                       frequency_text(margins.phase_margin_at));
    given.set("phase_margin_deg", degrees(*margins.phase_margin));
    given.set("phase_margin_at_hz", margins.phase_margin_at / (2 * pi));
    if (!margins.stable) text += ": so much lead is missing there";
  } else {
    text = margins.stable ? "The loop's gain never is 1: no phase margin" : "";
  }
  if (margins.delay_margin) {
    const double delay = *margins.delay_margin;
    given.set("delay_margin_s", delay);
    std::string amount = delay_text(delay);
    if (m.sampled) {
      amount +=
          fmt::format(" ({} samples of {})", number_text(delay / m.sampled->sample), delay_text(m.sampled->sample));
      given.set("delay_margin_samples", delay / m.sampled->sample);
    }
    if (delay == 0)
      text += "; delay margin 0: its gain is 1 or more at all high frequencies";
    else if (margins.delay_margin_at == margins.phase_margin_at)
      text += fmt::format("; delay margin {}", amount);
    else
      text += fmt::format("; delay margin {}{}", amount, at_text(margins.delay_margin_at));
  }
  if (!text.empty()) add(document, text + ".");
  if (m.sampled && m.sampled->looks > 1 && margins.phase_margin)
    add(document,
        "With several instants in the common period the phase margin is that of the part with the input's frequency; "
        "stability and the limits of the gain are exact.");
}

void tell_gain(Document& document, Facts& given, const Margins& margins) {
  const auto& from = margins.gain_from;
  const auto& to = margins.gain_to;
  if (from) given.set("gain_from", from->factor);
  if (to) given.set("gain_to", to->factor);
  const auto nearest = margins.gain_margin();
  if (nearest) {
    given.set("gain_margin", nearest->factor);
    if (std::isfinite(nearest->at)) given.set("gain_margin_at_hz", nearest->at / (2 * pi));
  }
  if (!margins.stable && !nearest) {
    add(document, "No change of the gain alone makes it stable.");
    return;
  }
  if (!nearest) {
    add(document, "Gain margin infinite: the phase never passes -180 deg.");
    return;
  }
  const std::string margin = fmt::format("Gain margin {}{}", factor_text(nearest->factor), at_text(nearest->at));
  if (margins.stable && from && to)
    add(document, fmt::format("{}: the gain may rise to {} and fall to {} of what it is.", margin,
                              number_text(to->factor), number_text(from->factor)));
  else if (margins.stable)
    add(document, from ? margin + ": below this share of its gain the loop is unstable." : margin + ".");
  else if (from && to)
    add(document, fmt::format("{}: it is stable with {} to {} times its gain.", margin, number_text(from->factor),
                              number_text(to->factor)));
  else
    add(document, fmt::format("{}: it is stable with {} than that share of its gain.", margin, from ? "more" : "less"));
}

void tell_closed(Document& document, Facts& facts, const ClosedLoop& c) {
  Facts given;
  const auto frequency = [&](const char* name, const std::optional<double>& w) {
    if (w) given.set(name, *w / (2 * pi));
    return w ? frequency_text(*w) : std::string("nowhere");
  };
  add(document, fmt::format("The loop's gain is -3 dB at {}.", frequency("open_3db_hz", c.open_half)));
  add(document,
      fmt::format("Closed: T = L/(1 + L) is -3 dB at {}, at most {} at {}; S = 1/(1 + L) is -3 dB at {}, at "
                  "most {} at {}.",
                  frequency("closed_3db_hz", c.closed_half), number_text(c.closed.magnitude),
                  frequency("closed_peak_at_hz", c.closed.at), frequency("sensitivity_3db_hz", c.sensitivity_half),
                  number_text(c.sensitivity.magnitude), frequency("sensitivity_peak_at_hz", c.sensitivity.at)));
  given.set("closed_peak", c.closed.magnitude);
  given.set("sensitivity_peak", c.sensitivity.magnitude);
  facts.set("closed_loop", given);
}

Facts count_facts(const PoleCount& count) {
  return Facts::object(
      {{"stable", count.stable()},
       {"unstable_poles", count.endless ? std::optional<double>{} : std::optional<double>{count.outside}},
       {"poles_on_the_limit", count.on_the_limit}});
}

}  // namespace

std::string frequency_text(double w) { return number_text(w / (2 * pi), 4) + " Hz"; }

std::string instability_text(const PoleCount& count, bool sampled) {
  const char* where = sampled ? "outside the unit circle" : "in the right half plane";
  if (count.endless)
    return "unstable (infinitely many poles in the right half plane: around a dead time the gain stays 1 or more at "
           "all "
           "high frequencies)";
  if (count.outside > 0) return fmt::format("unstable ({} {})", count_text(count.outside, "pole"), where);
  return "";
}

std::string stability_head(const SmallMotions& m) {
  const bool sampled = m.sampled.has_value();
  const auto own = instability_text(m.count, sampled);
  if (!m.closed) return own.empty() ? "" : own + "; ";
  const auto closed = instability_text(*m.closed, sampled);
  if (!closed.empty()) return "the closed loop is " + closed + "; ";
  if (m.closed->on_the_limit > 0)
    return fmt::format("the closed loop is on the limit of stability ({} on the {}); ",
                       count_text(m.closed->on_the_limit, "pole"), sampled ? "unit circle" : "imaginary axis");
  return "";
}

void tell_poles(Document& document, Facts& facts, const SmallMotions& m) {
  if (m.sampled) {
    const std::string held =
        m.sampled->acts_between ? "; the input acts between the instants too, and is taken as held there" : "";
    add(document, fmt::format("Sampled: every {} the same, {} in it at which the input counts; exact at these{}.",
                              delay_text(m.sampled->period), count_text(m.sampled->looks, "instant"), held));
    facts.set("common_period_s", m.sampled->period);
    facts.set("sample_s", m.sampled->sample);
  }
  const auto poles = texts(m.poles, m);
  add(document, sentence(m.sampled ? "Poles in z over that period" : "Poles", poles));
  add(document, sentence("Zeros", texts(m.zeros, m)));
  facts.set(m.sampled ? "poles_z" : "poles_rad_per_s", list_of(m.poles));
  if (!m.sampled) facts.set("zeros_rad_per_s", list_of(m.zeros));
  facts.set("stability", count_facts(m.count));
  if (m.closed && (m.count.outside > 0 || m.count.endless))
    add(document, fmt::format("The loop as opened is {}.", instability_text(m.count, m.sampled.has_value())));
  if (poles.empty()) return;
  Table table;
  table.title = "Poles";
  table.columns = {"pole"};
  for (const auto& text : poles) table.rows.push_back({text});
  document.sections.front().tables.push_back(std::move(table));
}

void tell_margins(Document& document, Facts& facts, const SmallMotions& m) {
  Facts given;
  tell_phase(document, given, m);
  tell_gain(document, given, *m.margins);
  facts.set("margins", given);
  facts.set("stability_closed", count_facts(*m.closed));
  if (m.closed_loop) tell_closed(document, facts, *m.closed_loop);
}

void tell_cuts(Document& document, Facts& facts, const Program& program, const SmallMotions& m) {
  Facts::List names;
  for (const int b : m.cuts) {
    const auto& block = program.blocks[static_cast<std::size_t>(b)];
    const auto& declaration = block.kernel->declaration;
    names.emplace_back(block.path);
    const bool history = block.sizes.memory > 0 || block.kernel->has_modes() || declaration.is_rate_independent;
    const std::string about =
        has_describing_function(program, b)
            ? fmt::format("--amplitude {}=VALUE takes it for a motion of that amplitude at its input, ", block.path)
            : "";
    document.warnings.push_back(fmt::format(
        "{} \"{}\" passes no small motion on: its slope at this operating point is zero{}, and the way is cut there; {}"
        "--at takes another operating point",
        declaration.type, block.path, history ? ", by its history" : "", about));
  }
  if (!names.empty()) facts.set("cut_by", names);
}

}  // namespace hysteron
