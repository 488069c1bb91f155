// Files of instruments and laboratories: every number, name, unit and time as their layouts say.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <cmath>

#include "engine/diagram/error.h"
#include "io/data/column_file.h"
#include "io/data/measured_file.h"
#include "io/formats/file_format.h"
#include "tests/io/formats/instrument_files.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

using instruments::InstrumentFile;

std::string all_of(const std::vector<std::string>& list) {
  std::string text;
  for (const auto& item : list) text += item + "\n";
  return text;
}

MeasuredFile read_text(const std::string& bytes, const ReadingChoices& choices = {}) {
  const TemporaryFolder folder;
  return read_measured_file(folder.write("x.csv", bytes), choices);
}

Problem refused(const std::string& bytes, const ReadingChoices& choices = {}) {
  try {
    read_text(bytes, choices);
  } catch (const Error& error) {
    for (const auto& p : error.problems) {
      EXPECT_FALSE(p.what.empty());
      EXPECT_FALSE(p.cure.empty());
    }
    return error.problems.front();
  }
  ADD_FAILURE() << "was read";
  return {};
}

TEST(InstrumentText, OfAHundredColumnsAFewAreNamed) {
  std::string names, numbers;
  for (int i = 1; i <= 100; ++i) {
    names += fmt::format("{}c{} [V]", i == 1 ? "" : ",", i);
    numbers += fmt::format("{}{}", i == 1 ? "" : ",", i % 7);
  }
  const Problem problem = refused(names + "\n" + numbers + "\n" + numbers + "\n" + numbers + "\n");
  EXPECT_EQ(problem.code, "missing_column");
  EXPECT_NE(problem.cure.find("(columns here: c1, c2, c3, c4, c5, c6, c7 and 93 more)"), std::string::npos)
      << problem.cure;
}

class Instruments : public ::testing::TestWithParam<InstrumentFile> {};
TEST_P(Instruments, FilesAreReadToTheLastDigitThatTheyHave) {
  const InstrumentFile& file = GetParam();
  const TemporaryFolder folder;
  const MeasuredFile read = read_measured_file(folder.write(file.name, file.bytes));
  const CsvTable& table = read.table;
  ASSERT_EQ(table.rows(), static_cast<std::size_t>(instruments::rows)) << all_of(read.assumed);
  EXPECT_EQ(table.columns.size(), file.response.empty() ? 2U : 3U);
  const CsvColumn *t = table.find("t"), *u = table.find(file.drive);
  ASSERT_NE(t, nullptr);
  ASSERT_NE(u, nullptr) << table.columns[1].name;
  const CsvColumn* y = file.response.empty() ? nullptr : table.find(file.response);
  ASSERT_EQ(y == nullptr, file.response.empty()) << table.columns.back().name;
  const Unit unit = parse_unit(file.unit);
  EXPECT_EQ(u->unit.dimension, unit.dimension) << u->unit.text;
  for (int k = 0; k < instruments::rows; ++k) {
    const auto row = static_cast<std::size_t>(k);
    // Times are written with 1 ns and finer, or computed from the settings.
    EXPECT_NEAR(t->unit.to_si(t->values[row]), file.start + k * instruments::interval, file.time_digit) << k;
    EXPECT_NEAR(u->unit.to_si(u->values[row]), instruments::drive(k), file.half_digit) << k;
    if (y == nullptr) continue;
    EXPECT_NEAR(y->unit.to_si(y->values[row]), instruments::response(k), file.half_digit) << k;
  }
  for (const auto& fact : file.assumed)
    EXPECT_NE(all_of(read.assumed).find(fact), std::string::npos) << fact << " is not said of it:\n"
                                                                  << all_of(read.assumed);
}
std::string name_of_file(const ::testing::TestParamInfo<InstrumentFile>& test) {
  std::string name = test.param.name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Files, Instruments, ::testing::ValuesIn(instruments::all_files()), name_of_file);

TEST(Instruments, EveryFormatHasAFileThatIsReadHere) {
  const auto files = instruments::all_files();
  for (std::size_t i = 0; i < file_formats().size(); ++i) {
    const FileFormat& format = file_formats()[i];
    EXPECT_TRUE(std::any_of(files.begin(), files.end(), [&](const auto& file) { return format.is(file.bytes); }))
        << "place " << i
        << " of the table in io/formats/file_format.cpp: no file of tests/io/formats is of this format";
  }
}

// The first variable of level 5 begins behind the head of 128 bytes: a tag, then the tags and contents of its flags
// (16 bytes) and of its sizes, whose first number stands 32 bytes behind its begin. Where it is compressed, in a block
// that is stored, there is a tag of 8 bytes more, and 2 + 5 bytes that zlib begins a stream and a block with.
TEST(InstrumentSizes, AMatFileWhoseSizesDoNotFitIntoItIsRefusedBeforeAnybodyReadsIt) {
  const auto files = instruments::binary_files();
  const auto named = [&](const char* name) {
    return std::find_if(files.begin(), files.end(), [&](const auto& file) { return file.name == name; })->bytes;
  };
  for (const auto& [whole, begin] : {std::pair{named("vectors.mat"), 128U}, {named("compressed.mat"), 128U + 8 + 7}}) {
    for (const std::size_t at : {begin + 4, begin + 32}) {
      std::string bytes = whole;
      bytes.replace(at, 4, "\xff\xff\xff\x7f");
      EXPECT_EQ(refused(bytes).code, "damaged_file") << at;
    }
    EXPECT_EQ(refused(whole.substr(0, whole.size() - 100)).code, "damaged_file");
  }
  // A variable that is to go on behind the end of what its stream unpacks to.
  std::string longer = named("compressed.mat");
  longer[128 + 8 + 7 + 4] += 8;
  EXPECT_EQ(refused(longer).code, "damaged_file");
  // Deeper than structures are taken (8), where the library goes all the same, and than anybody is asked to go (200).
  for (const int depth : {2, 20, 1000})
    EXPECT_EQ(refused(instruments::mat_of_lost_numbers(depth)).code, "damaged_file") << depth;
}

TEST(InstrumentText, AnEmptyCellOrAMarkOfOverloadLeavesItsRowOutAndIsSaid) {
  const MeasuredFile read = read_text(
      "Time (s);u (V);y (mm)\n0,0;1,5;1\n0,1;;2\n0,2;1,25;OL\n0,3;1,5;4\n0,4;9,9E37;5\n0,5;2,5;-OVLD\n0,6;3,5;7\n0,7;NaN;8\n");
  EXPECT_EQ(read.table.find("t")->values, (std::vector<double>{0, 0.3, 0.6}));
  EXPECT_EQ(read.table.find("y")->values, (std::vector<double>{1, 4, 7}));
  EXPECT_EQ(read.table.lines, (std::vector<int>{2, 5, 8}));
  EXPECT_NE(all_of(read.assumed).find("5 rows left out"), std::string::npos) << all_of(read.assumed);
  EXPECT_NE(all_of(read.assumed).find("line 3"), std::string::npos);
}

TEST(InstrumentText, AnEmptyCellInATableOfOursIsNoFailureButNoNumberIs) {
  EXPECT_EQ(read_text("t [s],u [V]\n0,1\n1,\n2,3\n").table.rows(), 2U);
  EXPECT_EQ(refused("t [s],u [V]\n0,1\n1,nan\n2,3\n").code, "bad_number");
  EXPECT_EQ(refused("t [s],u [V]\n0,1\n1,oops\n2,3\n").code, "bad_number");
}

TEST(InstrumentText, WhatIsOpenIsAskedWithTheOptionThatChooses) {
  const Problem decimal = refused("Zeit;Weg\n1,000;1,234\n2,000;5,678\n3,000;9,012\n");
  EXPECT_EQ(decimal.code, "ambiguous_decimal");
  EXPECT_NE(decimal.cure.find("--decimal comma"), std::string::npos);
  ReadingChoices choices;
  choices.decimal = "comma";
  EXPECT_EQ(read_text("Zeit;Weg\n1,000;1,234\n2,000;5,678\n", choices).table.find("Weg")->values[1], 5.678);
  choices.decimal = "point";
  EXPECT_EQ(read_text("Zeit;Weg\n1,000;1,234\n2,000;5,678\n", choices).table.find("Weg")->values[1], 5678);

  const Problem commas = refused("Zeit,Weg\n0,0,1,5\n0,1,2,5\n0,2,3,5\n");
  EXPECT_EQ(commas.code, "ambiguous_decimal");

  const std::string two = "Time [s],Zeit [s],y [mm]\n0,1,2\n1,3,3\n2,5,4\n";
  const Problem time = refused(two);
  EXPECT_EQ(time.code, "ambiguous_time");
  EXPECT_NE(time.cure.find("--time Time"), std::string::npos) << time.cure;
  ReadingChoices zeit;
  zeit.time = "Zeit";
  EXPECT_EQ(read_text(two, zeit).table.find("t")->values, (std::vector<double>{1, 3, 5}));

  const Problem none = refused("u [V],y [mm]\n0,1\n1,3\n2,5\n");
  EXPECT_EQ(none.code, "missing_column");
  EXPECT_NE(none.cure.find("--interval"), std::string::npos);
  ReadingChoices spaced;
  spaced.interval = 0.5;
  EXPECT_EQ(read_text("u [V],y [mm]\n0,1\n1,3\n2,5\n", spaced).table.find("t")->values,
            (std::vector<double>{0, 0.5, 1}));

  const Problem names = refused("0.1 0.5\n0.2 0.6\n");
  EXPECT_EQ(names.code, "no_header");
  EXPECT_NE(names.cure.find("--names"), std::string::npos);
  ReadingChoices named;
  named.names = {"t [ms]", "y [V]"};
  EXPECT_EQ(read_text("0.1 0.5\n0.2 0.6\n", named).table.find("y")->values, (std::vector<double>{0.5, 0.6}));

  const Problem g = refused("Time [s],x [g]\n0,1\n1,2\n2,3\n");
  EXPECT_EQ(g.code, "ambiguous_unit");
  EXPECT_NE(g.cure.find("--unit x=gravity"), std::string::npos) << g.cure;
  ReadingChoices gravity;
  gravity.units["x"] = "gravity";
  EXPECT_DOUBLE_EQ(read_text("Time [s],x [g]\n0,1\n1,2\n2,3\n", gravity).table.find("x")->unit.scale, 9.80665);

  const Problem slow = refused("Time [s],y [mm],T [degC]\n0,1,20\n1,2,\n2,3,\n3,3,\n4,3,21\n");
  EXPECT_EQ(slow.code, "sparse_column");
  EXPECT_NE(slow.cure.find("--without T"), std::string::npos);
  ReadingChoices without;
  without.without = {"T"};
  EXPECT_EQ(read_text("Time [s],y [mm],T [degC]\n0,1,20\n1,2,\n2,3,\n3,3,\n4,3,21\n", without).table.rows(), 5U);
}

TEST(InstrumentText, WhatIsWrongIsToldWithItsLine) {
  EXPECT_EQ(refused("Time [s];y [mm]\n0;1\n1;x y\n2;3\n").line, 3);
  EXPECT_EQ(refused("Time [s];y [mm]\n0;1\n1;2;5\n2;3\n").code, "row_length");
  EXPECT_EQ(refused("Time [s];y [mm]\n0;1\n1;2\n\nTime [s];y [mm]\n0;3\n1;3\n").code, "second_table");
  EXPECT_EQ(refused("Time [s],y [dB]\n0,1\n1,2\n").code, "bad_unit");
  EXPECT_NE(refused("Time [s],y [dB]\n0,1\n1,2\n").what.find("logarithm"), std::string::npos);
  EXPECT_EQ(refused("a page of words\nand another line\n").code, "no_table");
  EXPECT_EQ(refused("").code, "empty_file");
  EXPECT_EQ(refused("Time [kg],y [mm]\n0,1\n1,2\n").code, "wrong_unit");
  EXPECT_EQ(refused("Date,y [mm]\n05/04/2026 10:00:00,1\n06/04/2026 10:00:00,2\n").code, "ambiguous_date");
}

TEST(InstrumentText, ARowThatEndsEarlyAtTheEndIsLeftOut) {
  const MeasuredFile read = read_text("Time [s];u [V];y [mm]\n0;1;1\n1;2;2\n2;3;3\n3;4\n");
  EXPECT_EQ(read.table.rows(), 3U);
  EXPECT_NE(all_of(read.assumed).find("line 5"), std::string::npos) << all_of(read.assumed);
}

struct UnitCase {
  const char* written;
  const char* column;
  double one;  ///< of it in SI
  const char* like;
};
TEST(InstrumentUnits, AreThoseThatInstrumentsWrite) {
  constexpr double pi = 3.14159265358979323846;
  for (const UnitCase& c : {UnitCase{"rpm", "n", 2 * pi / 60, "rad/s"},
                            {"rev/min", "n", 2 * pi / 60, "rad/s"},
                            {"U/min", "n", 2 * pi / 60, "rad/s"},
                            {"Nm", "M", 1, "N m"},
                            {"mNm", "M", 1e-3, "N m"},
                            {"Ncm", "M", 1e-2, "N m"},
                            {"tick/s", "v", 1, "1/s"},
                            {"counts", "pos", 1, ""},
                            {"%", "duty", 0.01, ""},
                            {"g", "acc_x", 9.80665, "m/s2"},
                            {"g", "mass", 1e-3, "kg"},
                            {"Grad", "phi", pi / 180, "rad"},
                            {"VDC", "u", 1, "V"},
                            {"\xC2\xB5m", "x", 1e-6, "m"},
                            {"m/s\xC2\xB2", "a", 1, "m/s2"},
                            {"Volts", "u", 1, "V"},
                            {"-", "k", 1, ""},
                            {"\xC2\xB5\xCE\xB5", "eps", 1e-6, ""}}) {
    const MeasuredFile read = read_text(fmt::format("Time [s];{} [{}]\n0;1\n1;2\n", c.column, c.written));
    const Unit& unit = read.table.find(c.column)->unit;
    EXPECT_EQ(unit.dimension, parse_unit(c.like).dimension) << c.written;
    EXPECT_NEAR(unit.to_si(1), c.one, 1e-12 * c.one) << c.written;  // a product of two doubles
  }
  const MeasuredFile warm = read_text(
      "Time [s];T [\xC2\xB0"
      "C]\n0;20\n1;21\n");
  EXPECT_DOUBLE_EQ(warm.table.find("T")->unit.to_si(20), 293.15);
}

TEST(KnownFiles, AreNamedAsWhatTheyAreWithWhatToDo) {
  const TemporaryFolder folder;
  const auto told = [&](const std::string& name, const std::string& bytes) {
    try {
      read_measured_file(folder.write(name, bytes));
    } catch (const Error& error) {
      EXPECT_EQ(error.problems.front().code, "unknown_file_type");
      EXPECT_FALSE(error.problems.front().cure.empty());
      return error.problems.front().what;
    }
    return std::string("was read");
  };
  const std::string zip("PK\x03\x04\x14\0\0\0\0\0", 10);
  EXPECT_NE(told("a.slx", zip).find("a Simulink model"), std::string::npos);
  EXPECT_NE(told("a.mdl", "Model {\n  Name \"x\"\n}").find("a Simulink model"), std::string::npos);
  EXPECT_NE(told("a.csv", "%PDF-1.7\n1 0 obj\n").find("a PDF"), std::string::npos);
  EXPECT_NE(told("a.csv", "<!DOCTYPE html><html>login</html>").find("HTML"), std::string::npos);
  EXPECT_NE(told("a.zip", zip).find("a zip archive"), std::string::npos);
  EXPECT_NE(told("a.xls", std::string("\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1\0\0", 10)).find("old Excel"),
            std::string::npos);
  EXPECT_NE(told("a.bin", std::string("\1\2\0\3abc", 7)).find("neither text nor"), std::string::npos);
}

TEST(BinaryFiles, WhatIsOpenOrUnknownIsSaid) {
  const TemporaryFolder folder;
  const auto told = [&](const std::string& name, const std::string& bytes, const ReadingChoices& choices = {}) {
    try {
      read_measured_file(folder.write(name, bytes), choices);
    } catch (const Error& error) {
      const Problem& p = error.problems.front();
      EXPECT_FALSE(p.cure.empty());
      return p.code + ": " + p.what + "; " + p.cure;
    }
    return std::string("was read");
  };
  const auto says = [](const std::string& text, const char* words) {
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  says(told("a.tdms", instruments::tdms_of_daqmx()), "a TDMS file with DAQmx scalings");
  says(told("a.tdms", instruments::tdms_of_scaling("Thermocouple")), "a scaling \"Thermocouple\"");
  const std::string two = instruments::mat_of_two_groups();
  says(told("a.mat", two),
       "ambiguous_group: 2 groups have times of their own: monday, tuesday; say which is meant: --group tuesday");
  ReadingChoices choices;
  choices.group = "tuesday";
  EXPECT_EQ(read_measured_file(folder.path("a.mat"), choices).table.find("t")->values, (std::vector<double>{0, 2, 4}));
  choices = {};
  choices.sheet = "note";
  for (const auto& file : instruments::binary_files())
    if (file.name == "numbers.xlsx") says(told("a.xlsx", file.bytes, choices), "Did you mean \"notes\"");
}

// The unit of a column stands as object 1 of a heap elsewhere in the file (H5T_VARIABLE); the number of the object is
// the last word before the heap. libhdf5 1.10.8 follows the object 0xff0001 out of its table.
TEST(BinaryFiles, AFileOnWhichTheLibraryCrashesIsRefused) {
  for (const auto& file : instruments::hdf5_files()) {
    if (file.name != "big_endian.h5") continue;
    std::string bytes = file.bytes;
    const auto heap = bytes.find("GCOL");
    ASSERT_NE(heap, std::string::npos);
    ASSERT_EQ(bytes.substr(heap - 4, 4), std::string("\1\0\0\0", 4));
    bytes[heap - 2] = '\xff';
    const TemporaryFolder folder;
    try {
      read_measured_file(folder.write("lab.h5", bytes));
      EXPECT_TRUE(H5_VERSION_GE(1, 10, 9)) << "was read";  // another one may say that there is no unit
    } catch (const Error& error) {
      const Problem& p = error.problems.front();
      EXPECT_EQ(p.code, "damaged_file");
      EXPECT_EQ(p.file, folder.path("lab.h5"));
      EXPECT_NE(p.what.find("it is damaged, the HDF5 library crashes on it"), std::string::npos) << p.what;
      EXPECT_NE(p.cure.find("export it again"), std::string::npos) << p.cure;
    }
  }
}

TEST(BinaryFiles, Hdf5ColumnsComeWithTheUnitsOfTheirAttributes) {
  const TemporaryFolder folder;
  ColumnWriter writer(folder.path("a.h5"), {{"t", "ms"}, {"drive", "V"}, {"sensor", "um"}});
  for (int k = 0; k < instruments::rows; ++k)
    writer.append(std::vector<double>{1.0 * k, instruments::drive(k), instruments::response(k)});
  writer.finish({});
  const MeasuredFile read = read_measured_file(folder.path("a.h5"));
  ASSERT_EQ(read.table.rows(), static_cast<std::size_t>(instruments::rows));
  EXPECT_EQ(read.table.find("t")->unit.text, "ms");
  EXPECT_EQ(read.table.find("sensor")->unit.text, "um");
  EXPECT_EQ(read.table.find("sensor")->values[7], instruments::response(7));
}

}  // namespace
}  // namespace hysteron
