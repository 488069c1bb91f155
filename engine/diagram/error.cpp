#include "engine/diagram/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace hysteron {
namespace {

constexpr std::size_t problems_in_full = 20;  // DESIGN 4.1

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
  const auto told = [&](const Problem& p) { return p.code == code && p.path == path && p.what == what; };
  if (std::any_of(problems_.begin(), problems_.end(), told)) return;  // each element of a list says the same
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

std::string did_you_mean(std::string_view name, const std::vector<std::string>& known) {
  if (known.empty()) return "there are none";
  std::string text = fmt::format("known: {}.", fmt::join(known, ", "));
  if (const auto best = nearest_name(name, known); !best.empty()) text += fmt::format(" Did you mean \"{}\"?", best);
  return text;
}

std::string to_text(const std::vector<Problem>& problems) {
  std::string text;
  for (std::size_t i = 0; i < std::min(problems.size(), problems_in_full); ++i) {
    const auto& p = problems[i];
    if (i > 0) text += '\n';
    if (!p.file.empty()) text += p.line > 0 ? fmt::format("{}:{}: ", p.file, p.line) : p.file + ": ";
    text += fmt::format("{}\n  {}\n  {}", p.path, p.what, p.cure);
  }
  if (problems.size() > problems_in_full) text += fmt::format("\n... and {} more", problems.size() - problems_in_full);
  return text;
}

}  // namespace hysteron
