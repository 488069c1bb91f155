#include "engine/diagram/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace hysteron {
namespace {

constexpr std::size_t problems_in_full = 20;  // more than anybody reads at once
constexpr std::size_t names_in_full = 12;     // more of them nobody reads
constexpr std::size_t nearest = 3;

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

bool differs_in_case_only(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

/// "gain" of "stage/core.gain".
std::string_view last_part(std::string_view path) {
  const auto cut = path.find_last_of("./");
  return cut == std::string_view::npos ? path : path.substr(cut + 1);
}

double distance_over_length(std::string_view a, std::string_view b) {
  return static_cast<double>(edit_distance(a, b)) / static_cast<double>(std::max({a.size(), b.size(), std::size_t{1}}));
}

/// 0: the same but for capital letters; 1: nothing in common.
double unlikeness(std::string_view name, std::string_view candidate) {
  if (differs_in_case_only(name, candidate)) return 0;
  const double whole = distance_over_length(name, candidate);
  const double last = distance_over_length(last_part(name), last_part(candidate));
  // A name inside the other ("lookup" of "lookup_table") is nearer than its length says; of two that end alike the one
  // that also begins alike.
  const bool inside = name.size() >= 3 && (candidate.find(name) != std::string_view::npos ||
                                           (candidate.size() >= 3 && name.find(candidate) != std::string_view::npos));
  return std::min({whole, (3 * last + whole) / 4, inside ? 0.25 + whole / 4 : 1.0});
}

}  // namespace

Error::Error(Fault f, std::vector<Problem> list)
    : std::runtime_error(to_text(list)), fault(f), problems(std::move(list)) {}

void fail(std::string code, std::string path, std::string what, std::string cure) {
  throw Error(Fault::input, {{std::move(code), std::move(path), std::move(what), std::move(cure), {}, 0}});
}

void fail_numerics(std::string code, std::string path, std::string what, std::string cure) {
  throw Error(Fault::numerics, {{std::move(code), std::move(path), std::move(what), std::move(cure), {}, 0}});
}

void Problems::add(std::string code, std::string path, std::string what, std::string cure) {
  if (!told_.insert(code + '\0' + path + '\0' + what).second) return;  // each element of a list says the same
  problems_.push_back({std::move(code), std::move(path), std::move(what), std::move(cure), {}, 0});
}

void Problems::throw_if_any() const {
  if (!problems_.empty()) throw Error(Fault::input, problems_);
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& known) {
  for (const auto& candidate : known)
    if (differs_in_case_only(name, candidate)) return candidate;
  std::string best;
  std::size_t best_distance = (name.size() < 3 ? 1 : std::max<std::size_t>(2, name.size() / 3)) + 1;
  for (const auto& candidate : known) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

namespace {

/// At most `count` known names, the most similar first: those that differ in capital letters only, then by the edit
/// distance over the length, where the last part of a path ("gain" of "stage/core.gain") may stand for the whole.
std::vector<std::string> nearest_names(std::string_view name, const std::vector<std::string>& known,
                                       std::size_t count) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < known.size(); ++i) order.emplace_back(unlikeness(name, known[i]), i);
  count = std::min(count, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.push_back(known[order[i].second]);
  return names;
}

/// "Did you mean "b", "c" or "d"? They are the nearest of 57."
std::string nearest_of_many(std::string_view name, const std::vector<std::string>& known) {
  std::string text;
  const auto names = nearest_names(name, known, nearest);
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("{}\"{}\"", i == 0 ? "" : i + 1 < names.size() ? ", " : " or ", names[i]);
  return fmt::format("Did you mean {}? They are the nearest of {}.", text, known.size());
}

/// "bad.csv:50", "stage.json:3: /blocks/x/gain": a file that is its own place is named once.
std::string place_of(const Problem& p) {
  if (p.file.empty()) return p.path;
  const std::string file = p.line > 0 ? fmt::format("{}:{}", p.file, p.line) : p.file;
  const bool is_the_file = p.path.empty() || p.path == p.file || p.file.ends_with("/" + p.path);
  return is_the_file ? file : file + ": " + p.path;
}

}  // namespace

std::string did_you_mean(std::string_view name, const std::vector<std::string>& known) {
  if (known.empty()) return "there are none.";
  if (known.size() > names_in_full) return nearest_of_many(name, known);
  std::string text = fmt::format("choose one of {}.", fmt::join(known, ", "));
  if (const auto best = nearest_name(name, known); !best.empty()) text += fmt::format(" Did you mean \"{}\"?", best);
  return text;
}

std::string to_text(const std::vector<Problem>& problems) {
  std::string text;
  for (std::size_t i = 0; i < std::min(problems.size(), problems_in_full); ++i) {
    const auto& p = problems[i];
    if (i > 0) text += '\n';
    text += fmt::format("{}\n  {}\n  {}", place_of(p), p.what, p.cure);
  }
  if (problems.size() > problems_in_full) text += fmt::format("\n... and {} more", problems.size() - problems_in_full);
  return text;
}

}  // namespace hysteron
