#include "io/diagram/parameter_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "engine/diagram/error.h"
#include "io/data/table_file.h"

namespace hysteron {
namespace {

Value list_of(const CsvTable& table, const CsvColumn& column, const std::vector<double>& numbers) {
  NumberList list;
  for (const double number : numbers)
    list.push_back(column.unit.text.empty() ? Number{number, {}} : Number{number, column.unit.text});
  Value value(std::move(list));
  value.origin = table.file + "#" + column.name;
  return value;
}

std::vector<const CsvColumn*> axes_of(const CsvTable& table) {
  std::vector<const CsvColumn*> axes;
  for (const char* name : {"at", "at_2", "at_3", "at_4"})
    if (const CsvColumn* axis = table.find(name)) axes.push_back(axis);
  return axes;
}

/// The rows as points of a grid.
class Grid {
 public:
  Grid(const CsvTable& table, std::vector<const CsvColumn*> axes) : table_(table), axes_(std::move(axes)) {
    for (const CsvColumn* axis : axes_) {
      auto knots = axis->values;
      std::sort(knots.begin(), knots.end());
      knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
      points_ *= knots.size();
      knots_.push_back(std::move(knots));
    }
  }

  Ordered<Value> lists(const CsvColumn& values) const {
    if (table_.rows() != points_)
      fail("bad_value", table_.file,
           fmt::format("the table has {} rows, its axes make a grid of {} points", table_.rows(), points_),
           "give one row for every combination of the knots, or the values as rows in the diagram");
    std::vector<double> ordered(points_);
    std::vector<int> line(points_, 0);
    for (std::size_t row = 0; row < points_; ++row) {
      const std::size_t point = point_of(row);
      if (line[point] > 0)
        fail("bad_value", table_.file,
             fmt::format("lines {} and {} are the same point of the grid", line[point], table_.lines[row]),
             "take one of them out, and give the point that is missing for it");
      line[point] = table_.lines[row];
      ordered[point] = values.values[row];
    }
    Ordered<Value> all;
    for (std::size_t i = 0; i < axes_.size(); ++i) all[axes_[i]->name] = list_of(table_, *axes_[i], knots_[i]);
    all[values.name] = list_of(table_, values, ordered);
    return all;
  }

 private:
  std::size_t point_of(std::size_t row) const {
    std::size_t point = 0;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const auto knot = std::lower_bound(knots_[i].begin(), knots_[i].end(), axes_[i]->values[row]);
      point = point * knots_[i].size() + static_cast<std::size_t>(knot - knots_[i].begin());
    }
    return point;
  }

  const CsvTable& table_;
  std::vector<const CsvColumn*> axes_;
  std::vector<std::vector<double>> knots_{};
  std::size_t points_ = 1;
};

}  // namespace

Ordered<Value> read_parameter_table(const std::string& file) {
  const CsvTable table = read_table(file);
  const CsvColumn* values = table.find("values");
  if (auto axes = axes_of(table); axes.size() > 1 && values != nullptr)
    return Grid(table, std::move(axes)).lists(*values);
  Ordered<Value> all;
  for (const auto& column : table.columns) all[column.name] = list_of(table, column, column.values);
  return all;
}

}  // namespace hysteron
