#include "io/formats/named_vectors.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/diagram/error.h"
#include "engine/diagram/name_list.h"
#include "io/files/shell_word.h"
#include "io/formats/heading.h"

namespace hysteron {
namespace {

std::string group_of(const std::string& name) {
  const auto slash = name.rfind('/');
  return slash == name.npos ? "" : name.substr(0, slash);
}
std::string own_name(const std::string& name) { return name.substr(name.rfind('/') + 1); }

bool is_time(const MeasuredColumn& column, const ReadingChoices& choices) {
  const std::string name = own_name(column.name);
  return choices.time.empty() ? is_time_name(name) : name == choices.time || column.name == choices.time;
}

[[noreturn]] void refuse(const MeasuredTable& table, std::string code, std::string what, std::string cure) {
  throw Error(Fault::input, {{std::move(code), table.file, std::move(what), std::move(cure), table.file, 0}});
}

std::vector<std::string> groups_of(const std::vector<MeasuredColumn>& vectors) {
  std::vector<std::string> groups;
  for (const auto& v : vectors)
    if (std::find(groups.begin(), groups.end(), group_of(v.name)) == groups.end()) groups.push_back(group_of(v.name));
  return groups;
}

void keep_group(const MeasuredTable& table, std::vector<MeasuredColumn>& vectors, const std::string& group) {
  const auto known = groups_of(vectors);
  std::erase_if(vectors, [&](const MeasuredColumn& v) {
    return group_of(v.name) != group && !group_of(v.name).starts_with(group + "/");
  });
  if (vectors.empty())
    refuse(table, "missing_column", fmt::format("--group names a group \"{}\" that is not there", group),
           did_you_mean(group, known));
}

/// Groups that are recordings of their own: each with a time, or with vectors of another length.
void check_groups(const MeasuredTable& table, const std::vector<MeasuredColumn>& vectors,
                  const ReadingChoices& choices) {
  std::map<std::string, const MeasuredColumn*> times;
  for (const auto& v : vectors)
    if (is_time(v, choices)) times.emplace(group_of(v.name), &v);
  const bool differ = std::any_of(times.begin(), times.end(),
                                  [&](const auto& t) { return t.second->values != times.begin()->second->values; });
  if (times.size() < 2 || !differ) return;
  std::vector<std::string> names;
  for (const auto& [group, time] : times) names.push_back(group.empty() ? "(none)" : group);
  refuse(table, "ambiguous_group", fmt::format("{} groups have times of their own: {}", names.size(), name_list(names)),
         "say which is meant: --group " + shell_word(names.back()));
}

std::size_t length_of_table(const MeasuredTable& table, const std::vector<MeasuredColumn>& vectors,
                            const ReadingChoices& choices) {
  std::map<std::size_t, std::size_t> lengths;
  for (const auto& v : vectors) {
    if (is_time(v, choices)) return v.values.size();
    ++lengths[v.values.size()];
  }
  std::size_t most = 0, of_length = 0;
  for (const auto& [length, count] : lengths) {
    if (count == most)
      refuse(table, "ambiguous_group",
             fmt::format("vectors of {} and of {} samples stand side by side, and none is the time", of_length, length),
             "say which vector holds the times: --time NAME; or leave vectors out: --without NAME");
    if (count > most) most = count, of_length = length;
  }
  return of_length;
}

}  // namespace

MeasuredTable table_of_vectors(MeasuredTable table, std::vector<MeasuredColumn> vectors,
                               const ReadingChoices& choices) {
  std::erase_if(vectors, [](const MeasuredColumn& v) { return v.values.size() < 2; });
  if (vectors.empty())
    refuse(table, "no_table", "this file holds no vector of numbers", "save the columns of a recording: t, u, y");
  if (!choices.group.empty()) keep_group(table, vectors, choices.group);
  check_groups(table, vectors, choices);
  const std::size_t length = length_of_table(table, vectors, choices);
  std::vector<std::string> left_out;
  for (auto& v : vectors) {
    if (v.values.size() == length)
      table.columns.push_back(std::move(v));
    else
      left_out.push_back(fmt::format("{} ({} samples)", v.name, v.values.size()));
  }
  if (!left_out.empty())
    table.assumed.push_back(
        fmt::format("left out, not of the same length ({} samples): {}", length, name_list(left_out)));
  const auto groups = groups_of(table.columns);
  for (auto& column : table.columns)  // a name says its group only where it has to
    if (groups.size() == 1) column.name = own_name(column.name);
  return table;
}

}  // namespace hysteron
