// Stretches of traces: nothing gets lost between two pixels, in both forms of files.
#include "studio/trace_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "engine/diagram/error.h"
#include "io/data/table_file.h"
#include "tests/io/temporary_folder.h"

namespace hysteron::studio {
namespace {

constexpr std::size_t rows = 20000;
constexpr std::size_t peak = 12345;

class StudioTraces : public testing::TestWithParam<const char*> {
 protected:
  StudioTraces() : file_(folder_.path(std::string("traces") + GetParam())) {
    CsvTable table;
    table.columns = {{"t", parse_unit("s"), {}}, {"y", parse_unit("um"), {}}};
    for (std::size_t i = 0; i < rows; ++i) {
      table.columns[0].values.push_back(0.001 * static_cast<double>(i));
      table.columns[1].values.push_back(i == peak ? 7.0 : std::sin(0.01 * static_cast<double>(i)));
    }
    write_table(file_, table);
  }
  std::vector<double> stretch(const TraceStretch& wanted) {
    const std::string bytes = files_.stretch(file_, {"y"}, wanted);
    std::vector<double> numbers(bytes.size() / sizeof(double));
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
  }
  TemporaryFolder folder_;
  std::string file_;
  TraceFiles files_;
};

TEST_P(StudioTraces, TellsWhatIsThere) {
  const auto head = files_.head(file_);
  EXPECT_EQ(head["rows"], rows);
  EXPECT_EQ(head["from"], 0.0);
  EXPECT_EQ(head["to"], 0.001 * (rows - 1));
  EXPECT_EQ(head["columns"][1]["unit"], "um");
}

TEST_P(StudioTraces, KeepsAPeakOfOneRowInAnyWidth) {
  for (const std::size_t pixels : {1U, 10U, 500U}) {
    const auto numbers = stretch({0, 0, pixels});
    const auto n = static_cast<std::size_t>(numbers[0]);
    ASSERT_EQ(numbers.size(), 1 + 3 * n);
    EXPECT_LE(n, pixels);
    EXPECT_EQ(*std::max_element(numbers.begin() + static_cast<long>(1 + 2 * n), numbers.end()), 7.0);
  }
}

TEST_P(StudioTraces, AShortStretchIsRowByRow) {
  const auto numbers = stretch({12.3405, 12.3495, 500});
  const auto n = static_cast<std::size_t>(numbers[0]);
  ASSERT_EQ(n, 11U) << "nine rows inside, and one beyond either end";
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(numbers[1 + i], 0.001 * static_cast<double>(12340 + i));
    EXPECT_EQ(numbers[1 + n + i], numbers[1 + 2 * n + i]);
  }
  EXPECT_EQ(numbers[1 + n + 5], 7.0);
}

TEST_P(StudioTraces, RefusesAColumnThatIsNotThere) { EXPECT_THROW(files_.stretch(file_, {"x"}, {}), Error); }

INSTANTIATE_TEST_SUITE_P(Of, StudioTraces, testing::Values(".csv", ".f64"),
                         [](const auto& made) { return std::string(made.param).substr(1); });

}  // namespace
}  // namespace hysteron::studio
