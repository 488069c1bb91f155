// What `hysteron new` makes of recordings as laboratories have them: one command each, and what it says of them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/app/hysteron_process.h"

namespace hysteron {
namespace {

using process::Folder;
using process::hysteron;
using process::Outcome;

/// y = 3 u + 0.5, u a slow sine.
std::string rows(const char* separator, bool comma, const std::function<std::string(int)>& time) {
  std::string text;
  for (int k = 0; k < 40; ++k) {
    const double u = std::sin(0.3 * k);
    std::string numbers = fmt::format("{0}{1:.6f}{0}{2:.6f}\n", separator, u, 3 * u + 0.5);
    if (comma) std::replace(numbers.begin(), numbers.end(), '.', ',');
    text += time(k) + numbers;
  }
  return text;
}
std::string milliseconds(int k) { return fmt::format("{}", k); }
std::string plain_rows() {
  return rows(",", false, [](int k) { return fmt::format("{:.3f}", 1e-3 * k); });
}

class NewVerb : public ::testing::Test {
 protected:
  Outcome make(const std::string& name, const std::string& bytes, std::vector<std::string> more = {}) {
    folder_.write(name, bytes);
    std::vector<std::string> words{"new", "--from", name, "-o", "out"};
    words.insert(words.end(), more.begin(), more.end());
    return hysteron(folder_.path(), words);
  }
  /// The starter describes what is a straight line, to the five digits that it writes.
  void expect_straight(const std::string& tolerance) {
    const Outcome compared = hysteron(folder_.path(), {"compare", "out/diagram.json", "--data", "out/dataset.json",
                                                       "--tolerance", tolerance, "-o", "compared"});
    EXPECT_EQ(compared.code, 0) << compared.out << compared.err;
  }
  Folder folder_;
};

#define EXPECT_SAYS(outcome, words) \
  EXPECT_NE((outcome).out.find(words), std::string::npos) << (outcome).out << (outcome).err

TEST_F(NewVerb, AGermanSpreadsheetBecomesAProjectWithOneCommand) {
  const Outcome made = make("motor.csv", "Zeit [ms];Spannung [V];Drehzahl [rpm]\n" + rows(";", true, milliseconds));
  ASSERT_EQ(made.code, 0) << made.err;
  for (const char* said :
       {"decimal comma", "separated by \";\"", "Zeit is the time, in ms", "inputs, by what they measure: Spannung",
        "measured outputs, by what they measure: Drehzahl"})
    EXPECT_SAYS(made, said);
  EXPECT_TRUE(folder_.read("out/motor.csv").starts_with("# from motor.csv\n# separated by \";\"\n"));
  EXPECT_NE(folder_.read("out/motor.csv").find("t [ms],Spannung [V],Drehzahl [rpm]\n0,0,0.5\n"), std::string::npos);
  expect_straight("0.001 rpm");
}

TEST_F(NewVerb, ColumnsOfTabsWithoutUnitsAndIsoTimesBecomeProjectsToo) {
  const Outcome coil = make("coil.txt", "time\tcurrent\tposition\n" + rows("\t", false, milliseconds));
  ASSERT_EQ(coil.code, 0) << coil.err;
  EXPECT_SAYS(coil, "taken as s");
  EXPECT_SAYS(coil, "current, position have no unit");
  expect_straight("0.001");
  const Outcome screw = hysteron(
      folder_.path(),
      {"new", "--from",
       folder_.write("screw.csv",
                     "timestamp,motor angle (rad),carriage (mm)\n" +
                         rows(",", false, [](int k) { return fmt::format("2026-05-04T13:37:00.{:03}", 5 * k); })),
       "-o", "screw"});
  ASSERT_EQ(screw.code, 0) << screw.err;
  EXPECT_SAYS(screw, "inputs, by what they measure: motor angle");
  EXPECT_NE(folder_.read("screw/screw.csv").find("\n0.005,"), std::string::npos);
}

TEST_F(NewVerb, ColumnsGetTheNamesThatTheUserGives) {
  const Outcome made = make("a.csv", "Time (ms),CH1 (V),CH2 (V)\n" + rows(",", false, milliseconds),
                            {"--input", "u=CH1", "--output", "y=CH2", "--unit", "CH2=um"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(folder_.read("out/dataset.json").find("\"CH1\": {\"to\": \"u\""), std::string::npos);
  EXPECT_NE(folder_.read("out/a.csv").find("t [ms],CH1 [V],CH2 [um]"), std::string::npos);
  expect_straight("0.001 um");
  const Outcome bad =
      hysteron(folder_.path(), {"new", "--from", "a.csv", "--input", "1u=CH1", "--output", "CH2", "-o", "b"});
  EXPECT_EQ(bad.code, 2);
  EXPECT_NE(bad.err.find("--input u=CH1"), std::string::npos) << bad.err;
}

TEST_F(NewVerb, ChannelsThatNothingTellsApartAreAskedFor) {
  const Outcome made = make("a.csv", "Time (ms),CH1 (V),CH2 (V)\n" + rows(",", false, milliseconds));
  EXPECT_EQ(made.code, 2);
  EXPECT_NE(made.err.find("--input NAME and --output NAME; the columns are t [ms], CH1 [V], CH2 [V]"),
            std::string::npos)
      << made.err;
}

TEST_F(NewVerb, OfSeveralRecordingsTheLastValidates) {
  folder_.write("b.csv", "t [s],u [V],y [um]\n" + plain_rows());
  folder_.write("c.csv", "t [s];u [V];y [um]\n" + rows(";", true, milliseconds));
  const Outcome made = hysteron(folder_.path(), {"new", "--from", "b.csv", "c.csv", "-o", "out"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_SAYS(made, "c.csv validates, the other recording trains");
  EXPECT_SAYS(made, "c.csv: decimal comma");
  const std::string dataset = folder_.read("out/dataset.json");
  EXPECT_NE(dataset.find("{\"file\": \"b.csv\", \"role\": \"train\"}"), std::string::npos) << dataset;
  EXPECT_NE(dataset.find("{\"file\": \"c.csv\", \"role\": \"validate\"}"), std::string::npos) << dataset;
  EXPECT_EQ(folder_.read("out/b.csv"), folder_.read("b.csv"));  // which is as ours are: copied byte by byte
  expect_straight("0.001 um");

  folder_.write("d.csv", "t [s],u [V],z [um]\n" + plain_rows());
  const Outcome other = hysteron(folder_.path(), {"new", "--from", "b.csv", "d.csv", "-o", "other"});
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("no column \"y\", which b.csv has"), std::string::npos) << other.err;
  folder_.write("e.csv", "t [s],u [V],y [V]\n" + plain_rows());
  EXPECT_EQ(hysteron(folder_.path(), {"new", "--from", "b.csv", "e.csv", "-o", "other"}).code, 2);
}

TEST_F(NewVerb, TimesThatRepeatOrGoBackAreJudgedAtOnce) {
  std::string text = "t [s],u [V],y [um]\n";
  for (int k = 0; k < 40; ++k) text += fmt::format("{:.4f},{},{}\n", 0.0104 + 1e-5 * k, k, 2 * k);
  const Outcome rounded = make("a.csv", text);
  EXPECT_EQ(rounded.code, 2);
  EXPECT_NE(rounded.err.find("too few digits"), std::string::npos) << rounded.err;
  EXPECT_NE(rounded.err.find("--interval"), std::string::npos) << rounded.err;
  const Outcome spaced = make("a.csv", text, {"--interval", "10 us"});
  EXPECT_EQ(spaced.code, 0) << spaced.err;
  const Outcome back = make("b.csv", "t [s],u [V],y [um]\n0,0,0\n1,1,1\n0.5,2,2\n2,3,3\n");
  EXPECT_EQ(back.code, 2);
  EXPECT_NE(back.err.find("b.csv:4"), std::string::npos) << back.err;
}

TEST_F(NewVerb, ACleanRecordingNeverLiesOverTheOneThatItCameFrom) {
  folder_.write("a.csv", "Zeit [s];u [V];y [um]\n" + rows(";", true, milliseconds));
  const Outcome made = hysteron(folder_.path(), {"new", "--from", "a.csv", "-o", "."});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(folder_.read("a.csv").starts_with("Zeit"));
  EXPECT_TRUE(folder_.has("a.clean.csv"));
}

TEST_F(NewVerb, DataSetsReadTheFilesOfInstrumentsThemselvesAndSayHow) {
  ASSERT_EQ(make("a.csv", "Time (ms),u (V),y (um)\n" + rows(",", false, milliseconds)).code, 0);
  folder_.write("raw.json", R"({"format": 1, "columns": {"y": {"unit": "mm"}},
    "recordings": [{"file": "a.csv"}]})");
  const Outcome compared = hysteron(
      folder_.path(), {"compare", "out/diagram.json", "--data", "raw.json", "-o", "cmp", "--tolerance", "1 mm"});
  EXPECT_EQ(compared.code, 1) << compared.err;  // three thousand times as much as the diagram says
  EXPECT_SAYS(compared, "a.csv was read so: Time is the time, in ms");
  const Outcome seen = hysteron(folder_.path(), {"inspect", "a.csv", "-o", "seen"});
  EXPECT_EQ(seen.code, 0) << seen.err;
  EXPECT_SAYS(seen, "1 recording with 40 rows, 1 ms between rows");
}

TEST_F(NewVerb, RowsAtTheEndOfARangeAreLeftOutOfEveryVerdict) {
  // y = 3 u + 0.5 behind a converter that ends at 2: the model is right, the rows at 2 are not.
  std::string text = "t [s],u [V],y [um]\n";
  for (int k = 0; k < 40; ++k) {
    const double u = std::sin(0.3 * k);
    text += fmt::format("{},{:.6f},{:.6f}\n", k, u, std::min(2.0, 3 * u + 0.5));
  }
  ASSERT_EQ(make("a.csv", "t [s],u [V],y [um]\n" + plain_rows()).code, 0);  // the model, from what is not clipped
  folder_.write("clipped.csv", text);
  const auto compared = [&](const std::string& columns) {
    folder_.write("d.json", R"({"format": 1, "columns": {)" + columns + R"(},
      "recordings": [{"file": "clipped.csv", "role": "train"}, {"file": "clipped.csv", "role": "validate"}]})");
    return hysteron(folder_.path(),
                    {"compare", "out/diagram.json", "--data", "d.json", "--tolerance", "0.001 um", "-o", "cmp"});
  };
  EXPECT_EQ(compared("").code, 1);
  const Outcome declared = compared(R"("y": {"limits": [-10, 2]})");
  EXPECT_EQ(declared.code, 0) << declared.out << declared.err;
  EXPECT_SAYS(declared, "in which y is at the end of its range (-10 um, 2 um)");
  EXPECT_EQ(compared(R"("y": {"limits": "find"})").code, 0);
}

}  // namespace
}  // namespace hysteron
