#include "io/data/table_file.h"

#include "io/data/binary_table.h"

namespace hysteron {

CsvTable read_table(const std::string& file) {
  return is_binary_table(file) ? read_binary_table(file) : read_csv(file);
}

void write_table(const std::string& file, const CsvTable& table) {
  if (file.ends_with(binary_table_type))
    write_binary_table(file, table);
  else
    write_csv(file, table);
}

}  // namespace hysteron
