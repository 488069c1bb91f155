#include "io/data/dataset.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/diagram/error.h"
#include "io/diagram/diagram_file.h"
#include "io/jobs/study_job.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

/// A program of which only the names and units of inputs and outputs are set: all that binding looks at.
Program program_with(const std::vector<std::pair<std::string, std::string>>& inputs,
                     const std::vector<std::pair<std::string, std::string>>& outputs) {
  Program program;
  const auto add = [&](const std::string& name, const std::string& unit) {
    SignalInfo signal;
    signal.path = name;
    signal.unit = parse_unit(unit);
    signal.dimension = signal.unit.dimension;
    program.signals.push_back(signal);
    return static_cast<int>(program.signals.size()) - 1;
  };
  for (const auto& [name, unit] : inputs) {
    program.input_names.push_back(name);
    program.input_units.push_back(parse_unit(unit));
    program.input_signals.push_back(add(name, unit));
  }
  for (const auto& [name, unit] : outputs) {
    program.output_names.push_back(name);
    program.output_signals.push_back(add(name, unit));
  }
  return program;
}

std::string rows(int count, double step = 0.5) {
  std::string text = "t [s],u [V],y [um],T [degC]\n";
  for (int i = 0; i < count; ++i)
    text += std::to_string(i * step) + "," + std::to_string(i) + "," + std::to_string(10 + i) + ",20\n";
  return text;
}

std::string code_of_binding(const DataSet& data, const Program& program) {
  try {
    check_binding(data, program);
  } catch (const Error& error) {
    for (const auto& p : error.problems) EXPECT_FALSE(p.cure.empty()) << p.code;
    return error.problems.front().code + " " + error.problems.front().path;
  }
  return "fits";
}

TEST(DataSet, AFileThatIsListedTwiceHasItsRowsInBoth) {
  const TemporaryFolder folder;
  folder.write("01.csv", rows(9));
  folder.write("02.csv", rows(8));
  const auto data = read_dataset(folder.write("data.json", R"({"format": 1, "columns": {"y": {"to": "y"}},
    "recordings": [{"file": "01.csv", "role": "train", "until": "2 s"}, {"file": "02.csv", "role": "validate"},
                   {"file": "./01.csv", "role": "validate", "skip": "2 s"}]})"));
  ASSERT_EQ(data.recordings.size(), 3U);
  EXPECT_EQ(data.recordings[0].t, data.recordings[2].t);
  EXPECT_EQ(data.recordings[0].columns, data.recordings[2].columns);
  EXPECT_EQ(data.recordings[0].columns.at("y").size(), 9U);
  EXPECT_EQ(data.recordings[1].columns.at("y").size(), 8U);
}

TEST(DataSet, AHeaderBehindMuchCommentIsFound) {
  const TemporaryFolder folder;
  std::string text;
  while (text.size() < (1U << 20) + 1000) text += "# a line that says nothing\n";
  const auto data = read_dataset(folder.write("long.csv", text + rows(30)));
  EXPECT_EQ(data.recordings.front().t.size(), 30U);
  // A table of ours, as it stands: nothing was assumed to read it.
  for (const auto& remark : data.remarks) EXPECT_EQ(remark.find("was read so"), std::string::npos) << remark;
}

TEST(DataSet, EveryPartOfTheFormatIsRead) {
  const TemporaryFolder folder;
  folder.write("01.csv", rows(9));
  folder.write("02.csv", "t [ms],y [nm],u [V]\n0,1000,1\n250,2000,2\n500,3000,3\n750,4000,4\n");
  const auto data = read_dataset(folder.write("data.json", R"({"$schema": "x", "format": 1, "title": "stage 3, May",
    "columns": {"u": {"to": "drive", "between_samples": "hold"},
                "y": {"noise": {"white": "2 nm", "resolution": 0.1, "one_over_f": 0.3}, "zero": "per_recording", "delay": "1 sample"},
                "T": {"to": "temperature", "noise": "0.01 degC", "optional": true}},
    "recordings": [
      {"file": "01.csv", "role": "train", "start": "0.69 h", "cycles_before": 0, "initial": "rest", "until": "2 s"},
      {"file": "01.csv", "role": "test", "start": 1.5, "skip": "2 s", "initial": {"stage.x": "1 um"}},
      {"file": "02.csv", "role": "validate", "cycles_before": 48580, "initial": "per_recording", "weight": 2, "remark": "after lunch"}]})"));
  EXPECT_EQ(data.title, "stage 3, May");
  EXPECT_FALSE(data.single);
  ASSERT_EQ(data.recordings.size(), 3U);

  const auto& y = data.notes.at("y");
  EXPECT_NEAR(*y.noise.white, 2e-9, 1e-24);
  EXPECT_NEAR(*y.noise.resolution, 0.1e-6, 1e-22);  // a plain number is in the column's unit
  EXPECT_EQ(y.noise.one_over_f, 0.3);
  EXPECT_TRUE(y.zero_per_recording);
  EXPECT_EQ(y.delay_samples, 1);
  EXPECT_EQ(data.notes.at("drive").between, Between::hold);
  EXPECT_NEAR(*data.notes.at("temperature").noise.white, 0.01, 1e-15);  // a difference: 0.01 K, not 273.16 K
  EXPECT_FALSE(data.notes.contains("u"));

  const auto& a = data.recordings[0];
  EXPECT_EQ(a.name, "01.csv");
  EXPECT_EQ(a.role, Role::train);
  EXPECT_NEAR(*a.start_hours, 0.69, 1e-15);
  EXPECT_EQ(a.cycles_before, 0);
  EXPECT_TRUE(a.at_rest);
  EXPECT_EQ(a.columns.at("temperature").front(), 293.15);
  EXPECT_NEAR(a.columns.at("y")[3], 13e-6, 1e-20);
  EXPECT_EQ(a.units.at("y").text, "um");

  const auto& b = data.recordings[1];
  EXPECT_EQ(b.name, "01.csv (2)");
  EXPECT_EQ(b.role, Role::test);
  EXPECT_EQ(b.start_hours, 1.5);
  EXPECT_FALSE(b.at_rest);
  EXPECT_NEAR(b.initial_values.at("stage.x"), 1e-6, 1e-21);

  const auto& c = data.recordings[2];
  EXPECT_EQ(c.t, (std::vector<double>{0, 0.25, 0.5, 0.75}));
  EXPECT_NEAR(c.columns.at("y")[1], 2e-6, 1e-20);
  EXPECT_TRUE(c.initial_per_recording);
  EXPECT_EQ(c.weight, 2);
  EXPECT_EQ(c.remark, "after lunch");
}

TEST(DataSet, TwoPartsOfOneFileShareItsRowsAndJudgeEachOnce) {
  const TemporaryFolder folder;
  folder.write("a.csv", rows(21, 0.1));
  const auto data = read_dataset(folder.write("data.json", R"({"format": 1, "recordings": [
    {"file": "a.csv", "role": "train", "skip": "0.3 s", "until": "1.2 s"}, {"file": "a.csv", "role": "validate", "skip": "1200 ms"}]})"));
  EXPECT_EQ(data.recordings[0].first, 3U);
  EXPECT_EQ(data.recordings[0].last, 12U);
  EXPECT_EQ(data.recordings[1].first, 12U);
  EXPECT_EQ(data.recordings[1].last, 21U);
  EXPECT_EQ(data.recordings[1].t.size(), 21U);  // the simulation begins where the file begins
}

TEST(DataSet, SkipAndUntilCountFromTheFirstRowWhateverTheClockSays) {
  const TemporaryFolder folder;
  folder.write("a.csv", "t [s],y\n100.1,1\n100.2,1\n100.3,1\n100.4,1\n100.5,1\n100.6,1\n");
  const auto data = read_dataset(folder.write("data.json", R"({"format": 1, "recordings": [
    {"file": "a.csv", "role": "validate", "skip": "0.1 s", "until": "0.4 s"}]})"));
  EXPECT_EQ(data.recordings[0].first, 1U);
  EXPECT_EQ(data.recordings[0].last, 4U);
}

TEST(DataSet, ASingleCsvIsCutAtSixtyPercentOfItsTimeAndSaysSo) {
  const TemporaryFolder folder;
  // Times are not uniform: 60 % of the time 0..10 s is at 6 s, behind the 7th of 11 rows.
  const auto data =
      read_dataset(folder.write("lab.csv", "t [s],y [um]\n0,0\n1,0\n2,0\n3,0\n4,0\n5,0\n6,0\n8,0\n9,0\n9.5,0\n10,0\n"));
  EXPECT_TRUE(data.single);
  ASSERT_EQ(data.recordings.size(), 2U);
  const auto& train = data.recordings[0];
  const auto& validate = data.recordings[1];
  EXPECT_EQ(train.role, Role::train);
  EXPECT_EQ(validate.role, Role::validate);
  EXPECT_EQ(train.first, 0U);
  EXPECT_EQ(train.last, 7U);
  EXPECT_EQ(validate.first, 7U);
  EXPECT_EQ(validate.last, 11U);
  EXPECT_EQ(validate.t.front(), 0.0);
  EXPECT_NE(train.name, validate.name);
  ASSERT_EQ(data.remarks.size(), 1U);
  EXPECT_NE(data.remarks[0].find("60 %"), std::string::npos);
  EXPECT_NE(data.remarks[0].find("lab.csv"), std::string::npos);
}

TEST(DataSet, ADataSetThatListsOneRecordingIsCutLikeASingleCsvUnlessItIsForJudging) {
  const TemporaryFolder folder;
  folder.write("a.csv", rows(101, 0.1));
  const auto cut = read_dataset(folder.write(
      "d.json",
      R"({"format": 1, "columns": {"u": {"between_samples": "hold"}}, "recordings": [{"file": "a.csv", "skip": "5 s"}]})"));
  EXPECT_TRUE(cut.single);
  ASSERT_EQ(cut.recordings.size(), 2U);
  EXPECT_EQ(cut.recordings[0].first, 50U);
  EXPECT_EQ(cut.recordings[0].last, 81U);  // 5 s + 60 % of the 5 s that are left = 8 s
  EXPECT_EQ(cut.recordings[1].first, 81U);
  EXPECT_EQ(cut.notes.at("u").between, Between::hold);
  const auto whole =
      read_dataset(folder.write("e.json", R"({"format": 1, "recordings": [{"file": "a.csv", "role": "validate"}]})"));
  EXPECT_FALSE(whole.single);
  EXPECT_EQ(whole.recordings.size(), 1U);
}

TEST(DataSet, ADelayOfSamplesShiftsByRowsAndOneOfSecondsByTime) {
  const TemporaryFolder folder;
  folder.write("a.csv", "t [s],u [V],y [um],z [um]\n0,1,1,1\n1,2,2,2\n3,3,3,3\n4,4,4,4\n6,5,5,5\n7,6,6,6\n");
  const auto data = read_dataset(
      folder.write("d.json", R"({"format": 1, "columns": {"y": {"delay": "2 samples"}, "z": {"delay": "1500 ms"}},
    "recordings": [{"file": "a.csv", "role": "validate"}]})"));
  const auto& r = data.recordings[0];
  EXPECT_EQ(output_instants(data, r, "y"), (std::vector<double>{0, 0, 0, 1, 3, 4}));
  EXPECT_EQ(output_instants(data, r, "z"), (std::vector<double>{0, 0, 1.5, 2.5, 4.5, 5.5}));
  EXPECT_EQ(output_instants(data, r, "u"), r.t);
  EXPECT_EQ(r.first, 2U);  // before, a column shows a time before the recording
}

TEST(DataSet, ADelayedInputIsSetBackToWhenItHappened) {
  const TemporaryFolder folder;
  folder.write("a.csv", "t [s],u [V],v [V],y\n0,1,1,1\n1,2,2,2\n3,3,3,3\n4,4,4,4\n");
  const auto data = read_dataset(folder.write(
      "d.json",
      R"({"format": 1, "columns": {"u": {"delay": "1 sample"}, "v": {"delay": "0.5 s", "between_samples": "hold"}},
    "recordings": [{"file": "a.csv", "role": "validate"}]})"));
  const auto u = input_series(data, data.recordings[0], "u");
  EXPECT_EQ(u->t, (std::vector<double>{0, 1, 3}));
  EXPECT_EQ(u->v, (std::vector<double>{2, 3, 4}));
  const auto v = input_series(data, data.recordings[0], "v");
  EXPECT_EQ(v->t, (std::vector<double>{-0.5, 0.5, 2.5, 3.5}));
  EXPECT_EQ(v->between, Between::hold);
}

TEST(DataSet, AnInputThatMovesSmoothlyBecomesStraightPiecesOfASpline) {
  const TemporaryFolder folder;
  folder.write("a.csv", "t [s],u [V],y\n0,0,1\n1,1,2\n2,8,3\n3,27,4\n4,64,5\n");
  const auto data =
      read_dataset(folder.write("d.json", R"({"format": 1, "columns": {"u": {"between_samples": "smooth"}},
    "recordings": [{"file": "a.csv", "role": "validate"}]})"));
  EXPECT_EQ(data.notes.at("u").between, Between::smooth);
  const auto u = input_series(data, data.recordings[0], "u");
  EXPECT_EQ(u->between, Between::linear);
  EXPECT_NEAR(u->value(3.5, 3.5), 3.5 * 3.5 * 3.5, 6 * 3.5 / 144 + 1e-12)
      << "t^3, and a hair beside it between samples";
  EXPECT_EQ(u->value(3, 3), 27);
}

TEST(DataSet, ColumnsThatAreBoundToNothingStayAvailable) {
  const TemporaryFolder folder;
  const auto data = read_dataset(folder.write("a.csv", rows(10)));
  EXPECT_EQ(data.recordings[0].columns.at("T").front(), 293.15);
  EXPECT_EQ(data.notes.at("T").to, "T");
}

TEST(DataSet, AFileOfAnotherKindIsNamedAsWhatItIs) {
  const TemporaryFolder folder;
  const auto diagram = folder.write("my stage.json", "{\"format\": 1, \"blocks\": {}, \"outputs\": {}}");
  const auto data = folder.write("d.json", "{\"format\": 1, \"columns\": {}, \"recordings\": []}");
  const auto told = [](const std::function<void()>& read) {
    try {
      read();
    } catch (const Error& error) {
      EXPECT_EQ(error.problems.size(), 1U) << error.what();  // not every key that the other kind does not have
      return error.problems.front().what + "; " + error.problems.front().cure;
    }
    return std::string("was read");
  };
  EXPECT_EQ(
      told([&] { read_dataset(diagram); }),
      "this file is a diagram, not a data set; name a recording or a data set here; a diagram comes first: hysteron "
      "compare '" +
          diagram + "' --data lab.csv");
  EXPECT_EQ(
      told([&] { read_diagram(data); }),
      "this file is a data set, not a diagram; name a diagram here; a data set goes behind --data: hysteron compare "
      "stage.json --data " +
          data);
  EXPECT_TRUE(told([&] { read_study_job(data); }).starts_with("this file is a data set, not a job"));
}

TEST(DataSet, AColumnThatIsMissingEverywhereIsToldOnce) {
  const TemporaryFolder folder;
  std::string list;
  for (const char* name : {"a.csv", "b.csv", "c.csv"}) {
    folder.write(name, rows(10));
    list += std::string(list.empty() ? "" : ", ") + "{\"file\": \"" + name + "\", \"role\": \"train\"}";
  }
  const auto file =
      folder.write("d.json", "{\"format\": 1, \"columns\": {\"yy\": {\"to\": \"y\"}}, \"recordings\": [" + list + "]}");
  try {
    read_dataset(file);
    FAIL() << "no file has the column";
  } catch (const Error& error) {
    ASSERT_EQ(error.problems.size(), 1u) << error.what();
    EXPECT_EQ(error.problems.front().code, "missing_column");
    EXPECT_NE(error.problems.front().what.find("a.csv and 2 other files have no column \"yy\""), std::string::npos)
        << error.problems.front().what;
    EXPECT_NE(error.problems.front().cure.find("Did you mean \"y\"?"), std::string::npos);
  }
}

TEST(DataSet, AnOptionalColumnMayBeMissingInSomeRecordings) {
  const TemporaryFolder folder;
  folder.write("a.csv", rows(5));
  folder.write("b.csv", "t [s],u [V],y [um]\n0,1,1\n1,2,2\n2,3,3\n");
  const auto data = read_dataset(
      folder.write("d.json", R"({"format": 1, "columns": {"T": {"to": "temperature", "noise": 0.1, "optional": true}},
    "recordings": [{"file": "b.csv", "role": "train"}, {"file": "a.csv", "role": "validate"}]})"));
  EXPECT_FALSE(data.recordings[0].columns.contains("temperature"));
  EXPECT_TRUE(data.recordings[1].columns.contains("temperature"));
  EXPECT_NEAR(*data.notes.at("temperature").noise.white, 0.1, 1e-15);
}

TEST(Binding, FittingColumnsAreAcceptedInAnyUnitOfTheSameDimension) {
  const TemporaryFolder folder;
  const auto data = read_dataset(folder.write("a.csv", rows(10)));
  EXPECT_EQ(code_of_binding(data, program_with({{"u", "mV"}}, {{"y", "m"}, {"T", "K"}})), "fits");
  EXPECT_EQ(code_of_binding(data, program_with({}, {{"y", "nm"}, {"not_measured", "V"}})), "fits");
}

TEST(Binding, WhatDoesNotFitIsNamed) {
  const TemporaryFolder folder;
  const auto data = read_dataset(folder.write("a.csv", rows(10)));
  EXPECT_EQ(code_of_binding(data, program_with({{"u", "um"}}, {{"y", "um"}})), "wrong_unit u");
  EXPECT_EQ(code_of_binding(data, program_with({{"u", "V"}}, {{"y", "V"}})), "wrong_unit y");
  EXPECT_EQ(code_of_binding(data, program_with({{"drive", "V"}}, {{"y", "um"}})), "missing_column drive");
  EXPECT_EQ(code_of_binding(data, program_with({{"u", "V"}}, {{"x", "um"}})), "missing_column x");
  EXPECT_EQ(code_of_binding(data, program_with({{"u", "V"}}, {})), "missing_output outputs");
}

TEST(Binding, TheElementsOfAVectorBindToColumnsOfTheirOwn) {
  const TemporaryFolder folder;
  const auto program = program_with({{"u[0]", "V"}, {"u[1]", "V"}}, {{"y", "um"}});
  const auto data = [&](const std::string& header) {
    std::string text = header + "\n";
    for (int i = 0; i < 10; ++i) text += std::to_string(i) + ",1,2,3\n";
    return read_dataset(folder.write("a.csv", text));
  };
  EXPECT_EQ(code_of_binding(data("t [s],u[0] [V],u[1] [mV],y [um]"), program), "fits");
  EXPECT_EQ(code_of_binding(data("t [s],u[0] [V],u [V],y [um]"), program), "missing_column u[1]");
}

TEST(Binding, HertzIsNotTakenForRadiansPerSecondNorForOneOverSeconds) {
  const TemporaryFolder folder;
  const auto data = read_dataset(
      folder.write("a.csv", "t [s],f [Hz],y [um]\n0,1,1\n1,1,1\n2,1,1\n3,1,1\n4,1,1\n5,1,1\n6,1,1\n7,1,1\n"));
  EXPECT_EQ(code_of_binding(data, program_with({{"f", "Hz"}}, {{"y", "um"}})), "fits");
  EXPECT_EQ(code_of_binding(data, program_with({{"f", "rad/s"}}, {{"y", "um"}})), "wrong_unit f");
  EXPECT_EQ(code_of_binding(data, program_with({{"f", "1/s"}}, {{"y", "um"}})), "wrong_unit f");
}

TEST(Binding, AnInitialValueOfNoStateIsTold) {
  const TemporaryFolder folder;
  folder.write("a.csv", rows(10));
  const auto data = read_dataset(folder.write(
      "d.json",
      R"({"format": 1, "recordings": [{"file": "a.csv", "role": "validate", "initial": {"stage.v": "1 um"}}]})"));
  auto program = program_with({{"u", "V"}}, {{"y", "um"}});
  program.state_names = {"stage.x"};
  EXPECT_EQ(code_of_binding(data, program), "unknown_state stage.v");
  program.state_names = {"stage.v"};
  EXPECT_EQ(code_of_binding(data, program), "fits");
}

TEST(MeasuredData, EveryRecordingOfTheSharedCollectionsIsRead) {
  const std::filesystem::path shared = HYSTERON_SHARED_DIR;
  if (!std::filesystem::exists(shared / "measured"))
    GTEST_SKIP() << "there is no " << shared / "measured"
                 << " here";
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(shared / "measured")) {
    if (entry.path().extension() != ".csv") continue;
    const auto data = read_dataset(entry.path().string());
    EXPECT_TRUE(data.single);
    EXPECT_GT(data.recordings.front().columns.size(), 1U) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 10U);
}

TEST(MeasuredData, ThePiezoStackIsReadAsItsReadmeDescribesIt) {
  const std::filesystem::path folder = std::filesystem::path(HYSTERON_SHARED_DIR) / "measured" / "piezo-stack-p885";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "there is no " << folder << " here";
  const TemporaryFolder here;
  const auto text =
      R"({"format": 1, "columns": {"y": {"zero": "per_recording", "delay": "1 sample"}, "r": {"optional": true}},
    "recordings": [{"file": ")" +
      (folder / "train_sine_1Hz.csv").string() + R"(", "role": "train", "skip": "2 s"},
                   {"file": ")" +
      (folder / "test_varying_amplitude.csv").string() + R"(", "role": "validate", "skip": "2 s", "until": "37 s"}]})";
  const auto file = here.write("piezo.json", text);
  EXPECT_THROW(read_dataset(file), Error);  // outside the project unless it is allowed
  const auto data = read_dataset(file, {folder.string()});
  const auto& train = data.recordings[0];
  EXPECT_EQ(train.first, 400U);  // 2 s at 200 Hz
  EXPECT_NEAR(train.columns.at("y")[0], -123.059139e-6, 1e-15);
  EXPECT_EQ(output_instants(data, train, "y")[401], train.t[400]);
  EXPECT_EQ(data.recordings[1].last, 7400U);
}

TEST(DataSet, ThatJudgesByWhatItFittedIsToldSo) {
  const TemporaryFolder folder;
  folder.write("01.csv", rows(40));
  folder.write("copy.csv", rows(40));
  const auto remarks = [&](const std::string& first, const std::string& second) {
    const std::string text = R"({"format": 1, "recordings": [{"role": "train", )" + first + "}, {" + second + "}]}";
    return read_dataset(folder.write("data.json", text)).remarks;
  };
  const std::string train = R"("file": "01.csv")";
  using Remarks = std::vector<std::string>;
  EXPECT_EQ(
      remarks(train, R"("role": "validate", "file": "01.csv")"),
      Remarks{"01.csv (2) (validate) has the same rows as 01.csv, which trains: it judges the model by what it was "
              "fitted to."});
  EXPECT_EQ(remarks(train, R"("role": "test", "file": "copy.csv")"),
            Remarks{"copy.csv (test) has the same rows as 01.csv, which trains: it judges the model by what it was "
                    "fitted to."});
  EXPECT_EQ(remarks(train, R"("role": "train", "file": "01.csv")"), Remarks{});
  EXPECT_EQ(remarks(train + R"(, "until": "10 s")", R"("role": "validate", "file": "01.csv", "skip": "10 s")"),
            Remarks{});
}

TEST(DataSet, ExcludedSpansAndRowsAtTheLimitsAreNotJudged) {
  const TemporaryFolder folder;
  folder.write("01.csv", rows(40));  // u = row, every 0.5 s; y = 10 um + row
  const auto data = read_dataset(folder.write("data.json", R"({"format": 1,
    "columns": {"u": {"limits": ["-1 V", "35 V"]}, "y": {"limits": [12, 100]}},
    "recordings": [{"file": "01.csv", "role": "validate", "exclude": [["5 s", "7 s"], ["7 s", "8 s"]], "skip": "0.5 s"}]})"));
  const Recording& r = data.recordings.front();
  // Rows 0 (skip), 1 and 2 (y at 11 and 12 um), 10 to 16 (excluded), 35 to 39 (u).
  EXPECT_EQ(r.count_judged(), 40U - 1 - 2 - 7 - 5);
  std::vector<double> judged;
  for (int k = 3; k < 35; ++k)
    if (k < 10 || k > 16) judged.push_back(0.5 * k);
  EXPECT_EQ(r.judged(r.t), judged);
  using Remarks = std::vector<std::string>;
  EXPECT_EQ(data.remarks,
            (Remarks{"01.csv: 5 rows not judged, in which u is at the end of its range (-1 V, 35 V).",
                     "01.csv: 3 rows not judged, in which y is at the end of its range (12 um, 100 um)."}));
}

TEST(DataSet, LimitsAreFoundWhereRowsPileUpAndOnlyThere) {
  const TemporaryFolder folder;
  std::string text = "t [s],u [V],y [um]\n";
  for (int i = 0; i < 40; ++i)
    text += std::to_string(i) + "," + std::to_string(i % 10) + "," + std::to_string(std::min(i % 10, 6)) + "\n";
  folder.write("01.csv", text);
  const auto data = read_dataset(folder.write("data.json", R"({"format": 1,
    "columns": {"u": {"limits": "find"}, "y": {"limits": "find"}}, "recordings": [{"file": "01.csv", "role": "validate"}]})"));
  EXPECT_EQ(data.recordings.front().count_judged(), 24U);  // 6, 7, 8 and 9 of each ten are written as 6
  ASSERT_EQ(data.remarks.size(), 1U);
  EXPECT_NE(data.remarks[0].find("16 rows not judged, in which y is at the end of its range (6 um)"), std::string::npos)
      << data.remarks[0];
}

TEST(DataSet, TheUnitOfAColumnMayBeSaidInPlaceOfItsHeader) {
  const TemporaryFolder folder;
  folder.write("01.csv", "t [s],n [U/min],y\n0,60,1\n1,120,2\n2,180,3\n3,240,4\n");
  folder.write("02.csv", "t [s],n [V],y [um]\n0,60,1\n1,120,2\n2,180,3\n3,240,4\n");
  const auto data = read_dataset(folder.write("data.json", R"({"format": 1,
    "columns": {"n": {"unit": "rev/min"}, "y": {"unit": "mm", "noise": 1}, "none": {"unit": "V", "optional": true}},
    "recordings": [{"file": "01.csv", "role": "train"}, {"file": "02.csv", "role": "validate"}]})"));
  for (const auto& r : data.recordings) {
    EXPECT_NEAR(r.columns.at("n")[0], 2 * 3.14159265358979, 1e-9);  // 60 turns a minute in rad/s
    EXPECT_DOUBLE_EQ(r.columns.at("y")[1], 2e-3);
  }
  EXPECT_DOUBLE_EQ(*data.notes.at("y").noise.white, 1e-3);
}

}  // namespace
}  // namespace hysteron
