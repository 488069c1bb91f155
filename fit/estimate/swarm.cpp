// Particle swarms of the thesis, chapter 4, as corrected: all random numbers per particle and component, velocities
// turned round where a particle bounces off a bound.
#include "fit/estimate/swarm.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "fit/estimate/global_search.h"
#include "fit/numerics/draws.h"

namespace hysteron {
namespace {

/// What a random number is for: one stream each, so that a swarm with an attractor draws the same numbers as one
/// without for everything else.
enum class Purpose : std::uint64_t { inertia, own, swarm, attraction, attractor, place };

struct Particle {
  Point x, v, best;
  double best_cost = infinity;
};

class Swarm {
 public:
  Swarm(const GlobalProblem& problem, const GlobalSettings& settings) : problem_(problem), settings_(settings) {
    const auto n = static_cast<std::size_t>(settings.particles);
    for (std::size_t i = 0; i < n; ++i) {
      Particle p;
      // X_i(0) = lb + (i - 1/2)/n (ub - lb), V_i(0) = 0
      const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
      for (std::size_t j = 0; j < size(); ++j)
        p.x.push_back(problem.lower[j] + share * (problem.upper[j] - problem.lower[j]));
      p.v.assign(size(), 0.0);
      p.best = p.x;
      particles_.push_back(std::move(p));
    }
  }

  std::vector<Point> points() const {
    std::vector<Point> all;
    for (const auto& p : particles_) all.push_back(p.x);
    return all;
  }

  void learn(const std::vector<double>& costs) {
    for (std::size_t i = 0; i < costs.size(); ++i) {
      Particle& p = particles_[i];
      if (!(costs[i] < p.best_cost)) continue;
      p.best = p.x;
      p.best_cost = costs[i];
      if (costs[i] < best_cost_) {
        best_cost_ = costs[i];
        best_ = p.x;
      }
    }
  }

  void move(int iteration, bool attracted) {
    for (std::size_t i = 0; i < particles_.size(); ++i)
      if (best_.empty())
        throw_again(i, iteration);
      else
        move(i, iteration, attracted);
  }

 private:
  std::size_t size() const { return problem_.lower.size(); }

  /// Number of the draw for component j of particle i in this iteration.
  double draw(Purpose purpose, int iteration, std::size_t i, std::size_t j) const {
    const auto index = (static_cast<std::uint64_t>(iteration) * particles_.size() + i) * size() + j;
    return draws::uniform(settings_.seed, static_cast<std::uint64_t>(purpose), index);
  }

  /// While nothing could be evaluated there is nothing to fly to.
  void throw_again(std::size_t i, int iteration) {
    Particle& p = particles_[i];
    for (std::size_t j = 0; j < size(); ++j)
      p.x[j] = problem_.lower[j] + draw(Purpose::place, iteration, i, j) * (problem_.upper[j] - problem_.lower[j]);
    p.best = p.x;
  }

  /// V <- w V + c_1 r_1 (p_B - X) + c_2 r_2 (g_B - X) [+ (c_3 r_3/it) (p_D - X)], X <- X + V: thesis
  /// Eqs. 4.1, 4.2, 4.13.
  void move(std::size_t i, int iteration, bool attracted) {
    Particle& p = particles_[i];
    const Point towards = attracted ? attractor(i, iteration) : p.x;
    const double w = 0.5 + 0.5 * draw(Purpose::inertia, iteration, i, 0);
    for (std::size_t j = 0; j < size(); ++j) {
      double& v = p.v[j];
      v = w * v + settings_.own_pull * draw(Purpose::own, iteration, i, j) * (p.best[j] - p.x[j]) +
          settings_.swarm_pull * draw(Purpose::swarm, iteration, i, j) * (best_[j] - p.x[j]);
      if (attracted)
        v += settings_.attractor_pull * draw(Purpose::attraction, iteration, i, j) / iteration * (towards[j] - p.x[j]);
      p.x[j] += v;
      reflect(problem_.lower[j], problem_.upper[j], p.x[j], v);
    }
  }

  /// p_D: the particle's own place but for the components that the data speak of.
  Point attractor(std::size_t i, int iteration) const {
    Point p = particles_[i].x;
    for (const auto& c : problem_.attractor->components) {
      const auto j = static_cast<std::size_t>(c.component);
      if (c.of < 0) {
        p[j] = c.low + draw(Purpose::attractor, iteration, i, j) * (c.high - c.low);
      } else {
        const double x = p[static_cast<std::size_t>(c.of)];
        p[j] =
            std::clamp(c.scale * (sum_of(c.upper, x) + sum_of(c.lower, x)) / 2, problem_.lower[j], problem_.upper[j]);
      }
    }
    return p;
  }

  const GlobalProblem& problem_;
  const GlobalSettings& settings_;
  std::vector<Particle> particles_;
  Point best_;
  double best_cost_ = infinity;
};

}  // namespace

void reflect(double lower, double upper, double& x, double& v) {
  if (!std::isfinite(x)) {
    x = (lower + upper) / 2;
    v = 0;
    return;
  }
  for (int bounces = 0; x < lower || x > upper; ++bounces) {
    x = x < lower ? lower + (lower - x) : upper - (x - upper);
    v = -v;
    if (bounces == 100) x = std::clamp(x, lower, upper);  // a flight of a hundred boxes ends at the wall
  }
}

double sum_of(const std::vector<Attractor::Exponential>& terms, double x) {
  double sum = 0;
  for (const auto& t : terms) sum += t.factor * std::exp(t.rate * x);
  return sum;
}

void search_by_swarm(const GlobalProblem& problem, bool attracted, const GlobalSettings& settings, CostCounter& cost) {
  Swarm swarm(problem, settings);
  for (int iteration = 1;; ++iteration) {
    swarm.learn(cost.of_each(swarm.points()));
    if (cost.ended()) return;
    swarm.move(iteration, attracted);
  }
}

}  // namespace hysteron
