#include "fit/signals/features.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace hysteron::features {

double smallest(std::span<const double> y) { return y.empty() ? 0 : *std::min_element(y.begin(), y.end()); }
double largest(std::span<const double> y) { return y.empty() ? 0 : *std::max_element(y.begin(), y.end()); }
double stroke(std::span<const double> y) { return largest(y) - smallest(y); }
double sum_of_squares(std::span<const double> y) {
  double sum = 0;
  for (const double v : y) sum += v * v;
  return sum;
}
double mean(std::span<const double> y) {
  double sum = 0;
  for (const double v : y) sum += v;
  return y.empty() ? 0 : sum / static_cast<double>(y.size());
}
double rms(std::span<const double> y) {
  return y.empty() ? 0 : std::sqrt(sum_of_squares(y) / static_cast<double>(y.size()));
}
double deviation(std::span<const double> y) {
  const double middle = mean(y);
  double sum = 0;
  for (const double v : y) sum += (v - middle) * (v - middle);
  return y.empty() ? 0 : std::sqrt(sum / static_cast<double>(y.size()));
}
double largest_size(std::span<const double> y) { return std::max(std::abs(smallest(y)), std::abs(largest(y))); }

double loop_area(std::span<const double> x, std::span<const double> y) {
  const std::size_t n = std::min(x.size(), y.size());
  double twice = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = i + 1 == n ? 0 : i + 1;
    // Seen from the first row, so that an offset costs no digits.
    twice += (x[i] - x[0]) * (y[next] - y[0]) - (x[next] - x[0]) * (y[i] - y[0]);
  }
  return twice / 2;
}

double remanence(std::span<const double> y) {
  const double top = largest(y);
  return y.empty() || top == 0 ? 0 : (y.back() - y.front()) / top;
}

double overshoot(std::span<const double> y) {
  const double step = y.back() - y.front();
  if (step == 0) return 0;
  double most = 0;
  for (const double v : y) most = std::max(most, (v - y.back()) / step);
  return most;
}

double settling(std::span<const double> t, std::span<const double> y, double share) {
  const double band = share * std::abs(y.back() - y.front());
  const auto away = [&](std::size_t i) { return std::abs(y[i] - y.back()); };
  std::size_t last = y.size();  // row behind the last one outside
  while (last > 0 && away(last - 1) <= band) --last;
  if (last == 0) return 0;
  const double before = away(last - 1), after = away(last);
  return t[last - 1] - t[0] + (t[last] - t[last - 1]) * (before - band) / (before - after);
}

double value_at(std::span<const double> t, std::span<const double> y, double at) {
  if (t.empty()) return 0;
  const auto after = std::lower_bound(t.begin(), t.end(), at);
  if (after == t.begin()) return y.front();
  if (after == t.end()) return y.back();
  const auto k = static_cast<std::size_t>(after - t.begin());
  const double step = t[k] - t[k - 1];
  return step > 0 ? y[k - 1] + (y[k] - y[k - 1]) * (at - t[k - 1]) / step : y[k];
}

Spectrum spectrum(std::span<const double> y, double dt) {
  Spectrum s;
  const std::size_t n = y.size();
  if (n < 2 || !(dt > 0)) return s;
  std::vector<double> cosine(n), sine(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    cosine[i] = std::cos(angle);
    sine[i] = std::sin(angle);
  }
  const double offset = mean(y);
  for (std::size_t k = 1; k <= n / 2; ++k) {
    double a = 0, b = 0;
    std::size_t place = 0;  // k i modulo n, so that the angles stay exact
    for (std::size_t i = 0; i < n; ++i) {
      a += (y[i] - offset) * cosine[place];
      b += (y[i] - offset) * sine[place];
      place += k;
      if (place >= n) place -= n;
    }
    s.frequency.push_back(static_cast<double>(k) / (static_cast<double>(n) * dt));
    s.amplitude.push_back(2 * std::hypot(a, b) / static_cast<double>(n));
  }
  return s;
}

double size_above(const Spectrum& s, double frequency) {
  double sum = 0;
  for (std::size_t k = 0; k < s.frequency.size(); ++k)
    if (s.frequency[k] > frequency) sum += s.amplitude[k] * s.amplitude[k];
  return std::sqrt(sum);
}

double line_above(const Spectrum& s, double frequency) {
  double most = 0;
  for (std::size_t k = 0; k < s.frequency.size(); ++k)
    if (s.frequency[k] > frequency) most = std::max(most, s.amplitude[k]);
  return most;
}

double quantile(std::span<const double> y, double share) {
  if (y.empty()) return 0;
  std::vector<double> sorted(y.begin(), y.end());
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(sorted.begin(), at, sorted.end());
  if (at + 1 == sorted.end()) return *at;
  const double next = *std::min_element(at + 1, sorted.end());
  return *at + (place - static_cast<double>(below)) * (next - *at);
}

double ks_distance(std::span<const double> a, std::span<const double> b) {
  if (a.empty() || b.empty()) return 0;
  std::vector<double> x(a.begin(), a.end()), y(b.begin(), b.end());
  std::sort(x.begin(), x.end());
  std::sort(y.begin(), y.end());
  double most = 0;
  for (std::size_t i = 0, k = 0; i < x.size() && k < y.size();) {
    const double at = std::min(x[i], y[k]);  // equal values of both sets are passed together
    while (i < x.size() && x[i] == at) ++i;
    while (k < y.size() && y[k] == at) ++k;
    const double difference =
        static_cast<double>(i) / static_cast<double>(x.size()) - static_cast<double>(k) / static_cast<double>(y.size());
    most = std::max(most, std::abs(difference));
  }
  return most;
}

Medians medians(std::span<const double> x, std::span<const double> y) {
  std::map<double, std::vector<double>> groups;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) groups[x[i]].push_back(y[i]);
  Medians m;
  for (const auto& [at, group] : groups) {
    m.x.push_back(at);
    m.y.push_back(quantile(group, 0.5));
  }
  return m;
}

Histogram histogram(std::span<const double> y, int bins) {
  Histogram h;
  if (y.empty() || bins < 1) return h;
  const double low = smallest(y), width = std::max(stroke(y), 1e-300) / bins;
  h.count.assign(static_cast<std::size_t>(bins), 0);
  for (int i = 0; i < bins; ++i) h.middle.push_back(low + width * (i + 0.5));
  for (const double v : y) {
    const auto bin = static_cast<std::size_t>(std::clamp(std::floor((v - low) / width), 0.0, bins - 1.0));
    h.count[bin] += 1;
  }
  return h;
}

}  // namespace hysteron::features
