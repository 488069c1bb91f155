#include "app/study/study_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "engine/lanes/lanes.h"
#include "report/pages/facts.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

double share(std::uint64_t n, std::uint64_t of) {
  return of == 0 ? 0 : static_cast<double>(n) / static_cast<double>(of);
}

/// "5.36 %", of independent draws with its standard error: "5.36 % +- 0.16 %".
std::string rate_text(std::uint64_t n, std::uint64_t draws, bool independent) {
  if (draws == 0) return "-";
  const double p = share(n, draws), error = std::sqrt(p * (1 - p) / static_cast<double>(draws));
  return independent ? fmt::format("{} +- {}", percent_text(p), percent_text(error)) : percent_text(p);
}

std::string with_unit(double value, const Unit& unit) {
  const std::string text = unit.text;
  return number_text(value) + (text.empty() ? "" : " " + text);
}

std::string condition_text(const Condition& c, const Study& study) {
  const auto& column = study.columns[static_cast<std::size_t>(c.column)];
  std::vector<std::string> parts;
  const auto add = [&](const char* word, const std::optional<double>& bound) {
    if (bound) parts.push_back(fmt::format("{} {}", word, with_unit(*bound, column.unit)));
  };
  add("above", c.above);
  add("at least", c.at_least);
  add("below", c.below);
  add("at most", c.at_most);
  return fmt::format("{} {}", column.name, fmt::join(parts, " and "));
}

class Page {
 public:
  Page(const StudyJob& job, const StudyProblem& problem, const StudyFolder& folder, const MergedStudy& merged)
      : job_(job), study_(problem.study), folder_(folder), merged_(merged), counts_(merged.counts) {}

  Document document() {
    document_.verb = "study";
    document_.title = job_.title.empty() ? job_.name : job_.title;
    document_.headline =
        fmt::format("{}: {}, {} accepted ({})", document_.title, count_text(static_cast<long>(counts_.draws), "draw"),
                    counts_.accepted, percent_text(share(counts_.accepted, counts_.draws)));
    sentences();
    document_.sections = {draws(), columns()};
    const auto first =
        merged_.figures.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(merged_.figures.size(), 2));
    document_.answer = {merged_.figures.begin(), first};
    if (first != merged_.figures.end()) {
      Section figures;
      figures.title = "Further figures";
      figures.figures = {first, merged_.figures.end()};
      document_.sections.push_back(std::move(figures));
    }
    document_.facts = to_json(facts());
    return std::move(document_);
  }

 private:
  std::string rate(std::uint64_t n) const { return rate_text(n, counts_.draws, job_.method.text == "uniform"); }
  std::uint64_t failed() const {
    std::uint64_t n = 0;
    for (const auto& [code, count] : counts_.failed) n += count;
    return n;
  }

  void sentences() {
    for (std::size_t i = 0; i < study_.filters.size(); ++i)
      document_.sentences.push_back(
          fmt::format("{}: {} pass.", condition_text(study_.filters[i], study_), rate(counts_.passed[i])));
    if (failed() > 0)
      document_.sentences.push_back(fmt::format("{} could not be simulated; the first, draw {}: {}",
                                                count_text(static_cast<long>(failed()), "draw"), counts_.failure_draw,
                                                counts_.failure));
    if (counts_.gave_up)
      document_.warnings.push_back(
          fmt::format("{} accepted samples were wanted; after {} draws only {} were found, and the study gave up. "
                      "Which filter stands in "
                      "the way is said above; loosen it, or raise \"give_up_after\".",
                      study_.accepted, counts_.draws, counts_.accepted));
    if (counts_.accepted == 0 && !counts_.gave_up) document_.warnings.push_back("No draw was accepted.");
  }

  Section draws() const {
    Section s;
    s.title = "Draws";
    if (!job_.source.empty()) s.text.push_back("Source: " + job_.source);
    if (!job_.remark.empty()) s.text.push_back(job_.remark);
    std::string how = fmt::format("{} draws, method {}, seed {}.", counts_.draws, job_.method.text, study_.seed);
    if (study_.draws == 0)
      how += fmt::format(
          " Drawn until {} were accepted, in {} shards of which each takes every {}th draw: another number of shards "
          "is another study.",
          study_.accepted, folder_.shards(), folder_.shards());
    s.text.push_back(
        how + fmt::format(" Samples: study.h5, {}.", study_.keep_all ? "rejected ones, too" : "the accepted ones"));
    const std::string apart = why_not_in_lanes(*study_.program, study_.base, study_.options, study_.parameters);
    s.text.push_back(apart.empty() ? "Simulated side by side, many samples in one loop."
                                   : "Simulated one after the other: " + apart + ".");
    Table t;
    t.columns = {"what", "draws", "share of all"};
    const auto row = [&](const std::string& what, std::uint64_t n) {
      t.rows.push_back({what, fmt::format("{}", n), rate(n)});
    };
    for (std::size_t i = 0; i < study_.filters.size(); ++i)
      row("pass: " + condition_text(study_.filters[i], study_), counts_.passed[i]);
    for (const auto& [code, n] : counts_.failed) row("cannot be simulated: " + code, n);
    for (std::size_t c = 0; c < study_.columns.size(); ++c)
      if (counts_.not_finite[c] > 0)
        row(fmt::format("{} is not finite", study_.columns[c].name), counts_.not_finite[c]);
    row("accepted (all of it)", counts_.accepted);
    s.tables.push_back(std::move(t));
    return s;
  }

  Section columns() const {
    Section s;
    s.title = "Accepted samples";
    Table t;
    t.columns = {"column", "what it is", "smallest", "mean", "deviation", "largest"};
    for (std::size_t c = 0; c < study_.columns.size(); ++c) {
      const auto& column = study_.columns[c];
      const auto& found = merged_.columns[c];
      const auto text = [&](double v) { return found.count == 0 ? std::string("-") : with_unit(v, column.unit); };
      t.rows.push_back({column.name, column.told(), text(found.smallest), text(found.mean), text(found.deviation),
                        text(found.largest)});
    }
    s.tables.push_back(std::move(t));
    return s;
  }

  Facts facts() const {
    Facts filters = Facts::List{}, failures = Facts::object({}), columns = Facts::object({}),
          not_finite = Facts::object({});
    Facts::List list;
    for (std::size_t i = 0; i < study_.filters.size(); ++i)
      list.push_back(Facts::object({{"filter", condition_text(study_.filters[i], study_)},
                                    {"passed", static_cast<std::size_t>(counts_.passed[i])},
                                    {"share", share(counts_.passed[i], counts_.draws)}}));
    for (const auto& [code, n] : counts_.failed) failures.set(code, static_cast<std::size_t>(n));
    for (std::size_t c = 0; c < study_.columns.size(); ++c) {
      const auto& column = study_.columns[c];
      const auto& found = merged_.columns[c];
      const auto number = [&](double v) { return found.count == 0 ? std::optional<double>() : std::optional(v); };
      columns.set(column.name, Facts::object({{"unit", unit_text(column.unit)},
                                              {"meaning", column.told()},
                                              {"smallest", number(found.smallest)},
                                              {"mean", number(found.mean)},
                                              {"deviation", number(found.deviation)},
                                              {"largest", number(found.largest)}}));
      if (counts_.not_finite[c] > 0) not_finite.set(column.name, static_cast<std::size_t>(counts_.not_finite[c]));
    }
    return Facts::object({{"job", folder_.job()},
                          {"draws", static_cast<std::size_t>(counts_.draws)},
                          {"accepted", static_cast<std::size_t>(counts_.accepted)},
                          {"share", share(counts_.accepted, counts_.draws)},
                          {"filters", list},
                          {"failed", failures},
                          {"not_finite", not_finite},
                          {"gave_up", counts_.gave_up},
                          {"columns", columns}});
  }

  const StudyJob& job_;
  const Study& study_;
  const StudyFolder& folder_;
  const MergedStudy& merged_;
  const StudyCounts& counts_;
  Document document_;
};

}  // namespace

Document study_document(const StudyJob& job, const StudyProblem& problem, const StudyFolder& folder,
                        const MergedStudy& merged) {
  return Page(job, problem, folder, merged).document();
}

}  // namespace hysteron
