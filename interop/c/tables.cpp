// Decides how columns of another program become a file that verbs read.
#include <fmt/format.h>

#include "interop/c/handles.h"
#include "io/data/table_file.h"

namespace hysteron::interop {
namespace {

CsvColumn column_of(const char* name, const char* unit, const double* values, int64_t rows) {
  need(name, "names");
  need(unit, "units");
  if (rows > 0) need(values, "values");
  return {name, parse_unit(unit, name), {values, values + rows}};
}

}  // namespace
}  // namespace hysteron::interop

using namespace hysteron;

int hy_write_table(const char* path, int columns, const char* const* names, const char* const* units,
                   const double* const* values, int64_t rows, hy_error** error) {
  return interop::guarded_code(error, [&] {
    interop::need(path, "path");
    interop::need(names, "names");
    interop::need(units, "units");
    interop::need(values, "values");
    if (rows < 0) fail("bad_call", "rows", fmt::format("{} is no number of rows", rows), "give 0 or more");
    CsvTable table;
    table.file = path;
    for (int i = 0; i < columns; ++i) table.columns.push_back(interop::column_of(names[i], units[i], values[i], rows));
    write_table(path, table);
  });
}
