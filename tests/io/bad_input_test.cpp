// Every kind of broken file: the code, the place and the line of what is wrong, and a cure, always.
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "engine/diagram/error.h"
#include "io/data/csv.h"
#include "io/data/dataset.h"
#include "io/diagram/diagram_file.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

struct Case {
  const char* name;
  const char* content;
  const char* code;
  const char* path;  ///< "" = the file itself, or its outermost value
  int line;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

std::string name_of(const ::testing::TestParamInfo<Case>& info) { return info.param.name; }

/// The action must fail with the case's code at its place and line; every problem has a file and a cure.
void expect_problem(const Case& c, const std::string& file, const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault, Fault::input);
    bool found = false;
    std::string all;
    for (const auto& p : error.problems) {
      all += p.code + " at " + p.path + ", line " + std::to_string(p.line) + " of " + p.file + "\n";
      EXPECT_FALSE(p.cure.empty()) << p.code;
      EXPECT_FALSE(p.what.empty()) << p.code;
      const std::string place = *c.path != '\0' ? c.path : file;
      const bool here = p.path == place || (*c.path == '\0' && p.path.empty()) || p.path.ends_with("/" + place);
      found = found || (p.code == c.code && here && p.line == c.line);
    }
    EXPECT_TRUE(found) << "expected " << c.code << " at " << c.path << ", line " << c.line << "; found\n" << all;
    return;
  }
  FAIL() << "was taken without a word";
}

// ---------------------------------------------------------------------------------------------------------- CSV

class BadCsv : public ::testing::TestWithParam<Case> {};
TEST_P(BadCsv, IsToldWithCodeColumnLineAndCure) {
  const TemporaryFolder folder;
  const std::string file = folder.write("x.csv", GetParam().content);
  expect_problem(GetParam(), file, [&] { read_csv(file); });
}
INSTANTIATE_TEST_SUITE_P(
    Files, BadCsv,
    ::testing::Values(Case{"Empty", "", "empty_file", "", 1}, Case{"OnlyComments", "# a\n\n# b\n", "empty_file", "", 1},
                      Case{"NoRows", "# a\nt [s],u\n", "empty_file", "", 2},
                      Case{"NoHeader", "0,1\n1,2\n", "no_header", "", 1},
                      Case{"UnnamedColumn", "t [s],\n0,1\n", "no_header", "", 1},
                      Case{"Utf16", "\xFF\xFEt [s],u\n0,1\n", "not_utf8", "", 1},
                      Case{"Semicolons", "t [s];u [V]\n0;1\n", "no_header", "", 1},
                      Case{"Text", "t [s],u\n0,1\n1,abc\n", "bad_number", "u", 3},
                      Case{"NaN", "t [s],u\n0,1\n1,2\n2,nan\n", "bad_number", "u", 4},
                      Case{"Infinity", "t [s],u\n0,-inf\n", "bad_number", "u", 2},
                      Case{"TooLarge", "t [s],u\n0,1e999\n", "bad_number", "u", 2},
                      Case{"EmptyCell", "t [s],u\n0,1\n1,\n", "bad_number", "u", 3},
                      Case{"Hexadecimal", "t [s],u\n0,0x10\n", "bad_number", "u", 2},
                      Case{"BehindQuotes", "t [s],u\n0,\"1\"2\n", "bad_number", "u", 2},
                      Case{"OpenQuote", "t [s],u\n0,\"1\n", "bad_number", "u", 2},
                      Case{"ShortRow", "t [s],u\n0,1\n1\n", "row_length", "", 3},
                      Case{"DecimalComma", "t [s],u\n0,1,5\n", "row_length", "", 2},
                      Case{"TwoColumnsOfOneName", "t [s],u,u\n0,1,2\n", "duplicate_column", "u", 1},
                      Case{"ElementOfAnUnknownUnit", "t [s],u[1] [Volt-ish]\n0,1\n", "bad_unit", "u[1]", 1},
                      Case{"UnknownUnit", "t [s],u [Volt-ish]\n0,1\n", "bad_unit", "u", 1}),
    name_of);

TEST(BadCsvFile, AMissingFileAFolderAndADeviceAreTold) {
  const TemporaryFolder folder;
  for (const auto& [file, code] : {std::pair{folder.path("no.csv"), "no_file"},
                                   {folder.path(), "is_directory"},
                                   {std::string("/dev/null"), "not_a_file"}})
    expect_problem({"", "", code, "", 0}, file, [&, name = file] { read_csv(name); });
}

// ------------------------------------------------------------------------------------------------------ diagrams

class BadDiagram : public ::testing::TestWithParam<Case> {};
TEST_P(BadDiagram, IsToldWithCodePointerLineAndCure) {
  const TemporaryFolder folder;
  folder.write("outside.json", "{\"format\": 1, \"blocks\": {}}");
  folder.write("p/good.json", "{\"format\": 1, \"blocks\": {}}");
  folder.write("p/broken.csv", "t [s],u [V]\n0,1\n0,2\n");
  folder.write("p/good.csv", "t [s],u [V]\n0,1\n1,2\n");
  folder.write("p/words.csv", "at,values\n0,1\n1,two\n");
  folder.write("p/volts.csv", "t [V],u [V]\n0,1\n1,2\n");
  const std::string file = folder.write("p/d.json", GetParam().content);
  expect_problem(GetParam(), file, [&] { read_diagram(file); });
}
INSTANTIATE_TEST_SUITE_P(
    Files, BadDiagram,
    ::testing::Values(
        Case{"Empty", " \n", "empty_file", "", 1},
        Case{"BrokenJson", "{\"format\": 1,\n \"blocks\": {\"a\" {}}}", "bad_json", "column 17", 2},
        Case{"Utf16", "\xFE\xFF{\"format\": 1}", "not_utf8", "", 1},
        Case{"NestedDiagramWithoutAName",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"diagram\",\n\"file\": \"\"}}}", "bad_value",
             "/blocks/a/file", 2},
        Case{"OpenBrace", "{\"format\": 1,\n \"blocks\": {", "bad_json", "column 13", 2},
        Case{"TrailingComma", "{\"format\": 1,\n\"blocks\": {},\n}", "bad_json", "column 1", 3},
        Case{"HugeNumber", "{\"format\": 1,\n\"blocks\": {\"a\": {\"type\": \"gain\", \"gain\": 1e999}}}", "bad_json",
             "column 42", 2},
        Case{"NoObject", "[1]", "wrong_type", "", 1},
        Case{"DuplicateKey",
             "{\"format\": 1,\n\"blocks\": {\"a\": {\"type\": \"pass\"},\n\"a\": {\"type\": \"gain\"}}}",
             "duplicate_key", "/blocks/a", 3},
        Case{"UnknownKey", "{\"format\": 1, \"blocks\": {},\n\"recrod\": []}", "unknown_key", "/recrod", 2},
        Case{"NoFormat", "{\"blocks\": {}}", "missing_key", "", 1},
        Case{"NewerFormat", "{\"blocks\": {},\n\"format\": 2, \"novelty\": 1}", "newer_format", "/format", 2},
        Case{"FormatZero", "{\"blocks\": {},\n\"format\": 0}", "bad_format", "/format", 2},
        Case{"FormatAsText", "{\"blocks\": {},\n\"format\": \"1\"}", "wrong_type", "/format", 2},
        Case{"LengthZero", "{\"format\": 1, \"blocks\": {}, \"inputs\": {\"u\": {\"unit\": \"V\",\n\"length\": 0}}}",
             "bad_value", "/inputs/u/length", 2},
        Case{"HalfALength", "{\"format\": 1, \"blocks\": {}, \"inputs\": {\"u\": {\"unit\": \"V\",\n\"length\": 1.5}}}",
             "bad_value", "/inputs/u/length", 2},
        Case{"LengthAsText",
             "{\"format\": 1, \"blocks\": {}, \"inputs\": {\"u\": {\"unit\": \"V\",\n\"length\": \"3\"}}}",
             "wrong_type", "/inputs/u/length", 2},
        Case{"RowThatIsNoList",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"matrix_gain\", \"matrix\": [[1, 2],\n3]}}}",
             "wrong_type", "/blocks/a/matrix/1", 2},
        Case{"TextInAMatrix",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"matrix_gain\", \"matrix\": [[1,\n\"many\"]]}}}",
             "bad_value", "/blocks/a/matrix/0/1", 2},
        Case{"NoBlocks", "{\"format\": 1}", "missing_key", "", 1},
        Case{"BadBlockName", "{\"format\": 1, \"blocks\": {\n\"My Block\": {\"type\": \"pass\"}}}", "bad_name",
             "/blocks/My Block", 2},
        Case{"BadInputName", "{\"format\": 1, \"blocks\": {}, \"inputs\": {\n\"1T\": {\"unit\": \"V\"}}}", "bad_name",
             "/inputs/1T", 2},
        Case{"BadOutputName", "{\"format\": 1, \"blocks\": {}, \"outputs\": {\n\"T 1\": \"a\"}}", "bad_name",
             "/outputs/T 1", 2},
        Case{"BadParameterName", "{\"format\": 1, \"blocks\": {}, \"parameters\": {\n\"1a\": 5}}", "bad_name",
             "/parameters/1a", 2},
        Case{"BadCandidateName",
             "{\"format\": 1, \"blocks\": {\"a\": {\"choose\": \"x\", \"from\": {\n\"a.b\": {\"type\": \"pass\"}}}}}",
             "bad_name", "/blocks/a/from/a.b", 2},
        Case{"BlockIsNoObject", "{\"format\": 1, \"blocks\": {\n\"a\": \"sine\"}}", "wrong_type", "/blocks/a", 2},
        Case{"NoType", "{\"format\": 1, \"blocks\": {\n\"a\": {\"gain\": 1}}}", "missing_key", "/blocks/a", 2},
        Case{"TypeIsANumber", "{\"format\": 1, \"blocks\": {\"a\": {\n\"type\": 1}}}", "wrong_type", "/blocks/a/type",
             2},
        Case{"TypeBesideChoice",
             "{\"format\": 1, \"blocks\": {\"a\": {\"choose\": \"x\", \"from\": {\"x\": {\"type\": "
             "\"pass\"}},\n\"type\": \"gain\"}}}",
             "unknown_key", "/blocks/a/type", 2},
        Case{"ChoiceWithoutCandidates", "{\"format\": 1, \"blocks\": {\"a\": {\"choose\": \"x\",\n\"from\": {}}}}",
             "missing_key", "/blocks/a/from", 2},
        Case{"ChoiceWithoutChoose", "{\"format\": 1, \"blocks\": {\n\"a\": {\"from\": {\"x\": {\"type\": \"pass\"}}}}}",
             "missing_key", "/blocks/a", 2},
        Case{"CandidateWithInputs",
             "{\"format\": 1, \"blocks\": {\"a\": {\"choose\": \"x\", \"from\": {\"x\": {\"type\": \"pass\",\n\"in\": "
             "\"b\"}}}}}",
             "unknown_key", "/blocks/a/from/x/in", 2},
        Case{"EffectUponNothing",
             "{\"format\": 1, \"blocks\": {\n\"a\": {\"choose\": \"x\", \"from\": {\"x\": {\"type\": \"pass\", "
             "\"effect\": "
             "\"friction\"}}}}}",
             "missing_key", "/blocks/a/from/x", 2},
        Case{"EffectUponALaterOne",
             "{\"format\": 1, \"blocks\": {\n\"a\": {\"choose\": \"x\", \"from\": {\"x\": {\"type\": \"pass\", "
             "\"effect\": "
             "\"friction\", \"upon\": \"off\"},\"off\": {\"type\": \"pass\"}}}}}",
             "bad_choice", "/blocks/a/from/x/upon", 2},
        Case{"ParameterIsNull", "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"gain\",\n\"gain\": null}}}",
             "wrong_type", "/blocks/a/gain", 2},
        Case{"ParameterIsTrue", "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"gain\",\n\"gain\": true}}}",
             "wrong_type", "/blocks/a/gain", 2},
        Case{"ParameterObjectWithAnUnknownKey",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"gain\",\n\"gain\": {\"value\": 1, \"units\": \"V\"}}}}",
             "unknown_key", "/blocks/a/gain/units", 2},
        Case{"ListElementIsText",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"gain\", \"gain\": [1,\n\"many\"]}}}", "bad_value",
             "/blocks/a/gain/1", 2},
        Case{"ListElementIsAReference",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"gain\", \"gain\": [1,\n\"$b\"]}}}", "bad_value",
             "/blocks/a/gain/1", 2},
        Case{"InputsAreANumber", "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"pass\",\n\"in\": 5}}}", "wrong_type",
             "/blocks/a/in", 2},
        Case{"AnInputIsANumber", "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"pass\", \"in\": [\"b\",\n5]}}}",
             "wrong_type", "/blocks/a/in/1", 2},
        Case{"BoundsAreOneNumber",
             "{\"format\": 1, \"blocks\": {}, \"parameters\": {\"k\": {\"value\": 1,\n\"bounds\": [0]}}}", "wrong_type",
             "/parameters/k/bounds", 2},
        Case{"BoundsInTheWrongOrder",
             "{\"format\": 1, \"blocks\": {}, \"parameters\": {\"k\": {\"value\": 1,\n\"bounds\": [2, 0]}}}",
             "bad_value", "/parameters/k/bounds", 2},
        Case{"KnownToALength",
             "{\"format\": 1, \"blocks\": {}, \"parameters\": {\"k\": {\"value\": 1,\n\"known_to\": \"2 mm\"}}}",
             "bad_value", "/parameters/k/known_to", 2},
        Case{"KnownToMoreThanItself",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"gain\", \"gain\": {\"value\": 1,\n\"known_to\": 2}}}}",
             "bad_value", "/blocks/a/gain/known_to", 2},
        Case{
            "AReferenceThatIsKnown",
            "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"gain\", \"gain\": {\"value\": \"$k\",\n\"known_to\": 0}}}}",
            "bad_value", "/blocks/a/gain/known_to", 2},
        Case{"FreeIsANumber", "{\"format\": 1, \"blocks\": {}, \"parameters\": {\"k\": {\"value\": 1,\n\"free\": 1}}}",
             "wrong_type", "/parameters/k/free", 2},
        Case{"InputWithoutObject", "{\"format\": 1, \"blocks\": {}, \"inputs\": {\n\"u\": \"V\"}}", "wrong_type",
             "/inputs/u", 2},
        Case{"UnknownPlace", "{\"format\": 1, \"blocks\": {}, \"places\": {\n\"comand\": \"a\"}}", "unknown_key",
             "/places/comand", 2},
        Case{"UnknownMethod", "{\"format\": 1, \"blocks\": {}, \"simulate\": {\"solver\": {\n\"method\": \"heun\"}}}",
             "bad_value", "/simulate/solver/method", 2},
        Case{"ToleranceOfZero",
             "{\"format\": 1, \"blocks\": {}, \"simulate\": {\"solver\": {\n\"relative_tolerance\": 0}}}", "bad_value",
             "/simulate/solver/relative_tolerance", 2},
        Case{"UntilIsAWord", "{\"format\": 1, \"blocks\": {}, \"simulate\": {\n\"until\": \"soon\"}}", "bad_value",
             "/simulate/until", 2},
        Case{"NestedWithoutFile", "{\"format\": 1, \"blocks\": {\n\"a\": {\"type\": \"diagram\"}}}", "missing_key",
             "/blocks/a", 2},
        Case{"NestedFileMissing",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"diagram\",\n\"file\": \"no.json\"}}}", "no_file",
             "/blocks/a/file", 2},
        Case{"NestedFileIsAFolder", "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"diagram\",\n\"file\": \".\"}}}",
             "is_directory", "/blocks/a/file", 2},
        Case{"NestedInItself",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"diagram\",\n\"file\": \"../p/d.json\"}}}",
             "nested_in_itself", "/blocks/a/file", 2},
        Case{"OutsideTheProject",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"diagram\",\n\"file\": \"../outside.json\"}}}",
             "outside_project", "/blocks/a/file", 2},
        Case{"AbsolutePathOutside",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"gain\",\n\"parameters\": \"/etc/passwd\"}}}",
             "outside_project", "/blocks/a/parameters", 2},
        Case{"HiddenWayOutside",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"gain\",\n\"parameters\": "
             "\"not_there/../../outside.json\"}}}",
             "outside_project", "/blocks/a/parameters", 2},
        Case{"ParameterTableHoldsWords",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"lookup\",\n\"parameters\": \"words.csv\"}}}",
             "bad_number", "values", 3},
        Case{"RecordedWithoutColumn",
             "{\"format\": 1, \"blocks\": {\n\"a\": {\"type\": \"recorded\", \"file\": \"good.csv\"}}}", "missing_key",
             "/blocks/a", 2},
        Case{"RecordedWithAUnitOfItsOwn",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"recorded\", \"file\": \"good.csv\", \"column\": "
             "\"u\",\n\"unit\": \"V\"}}}",
             "unknown_key", "/blocks/a/unit", 2},
        Case{"RecordedColumnMissing",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"recorded\", \"file\": \"good.csv\",\n\"column\": "
             "\"x\"}}}",
             "missing_column", "/blocks/a/column", 2},
        Case{"RecordedFileMissing",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"recorded\", \"column\": \"u\",\n\"file\": \"no.csv\"}}}",
             "no_file", "/blocks/a/file", 2},
        Case{"RecordedOverSomethingElseThanTime",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"recorded\", \"column\": \"u\",\n\"file\": "
             "\"volts.csv\"}}}",
             "wrong_unit", "t", 1},
        Case{"RecordedTimeStandsStill",
             "{\"format\": 1, \"blocks\": {\"a\": {\"type\": \"recorded\", \"column\": \"u\",\n\"file\": "
             "\"broken.csv\"}}}",
             "decreasing_time", "t", 3}),
    name_of);

TEST(BadDiagramFile, ProblemsOfOneFileAreToldTogether) {
  const TemporaryFolder folder;
  const std::string file = folder.write(
      "d.json",
      "{\"format\": 1, \"a\": 1, \"blocks\": {\"B\": 1, \"c\": {\"type\": 1}}, \"simulate\": {\"until\": []}}");
  try {
    read_diagram(file);
    FAIL() << "was taken without a word";
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.size(), 4U) << error.what();
  }
}

TEST(BadDiagramFile, ProblemsInsideANestedDiagramNameThatFile) {
  const TemporaryFolder folder;
  folder.write("stages/inner.json", "{\"format\": 1,\n\"blocks\": {\"a\": {\"typ\": \"gain\"}}}");
  const std::string file = folder.write(
      "d.json", "{\"format\": 1, \"blocks\": {\"s\": {\"type\": \"diagram\", \"file\": \"stages/inner.json\"}}}");
  try {
    read_diagram(file);
    FAIL() << "was taken without a word";
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.front().file, folder.path("stages/inner.json"));
    EXPECT_EQ(error.problems.front().path, "/blocks/a");
    EXPECT_EQ(error.problems.front().line, 2);
  }
}

TEST(BadDiagramFile, ALongWayAroundBackToItselfIsFound) {
  const TemporaryFolder folder;
  const auto naming = [](const char* file) {
    return std::string("{\"format\": 1, \"blocks\": {\"s\": {\"type\": \"diagram\", \"file\": \"") + file + "\"}}}";
  };
  folder.write("a.json", naming("b.json"));
  folder.write("b.json", naming("c.json"));
  folder.write("c.json", naming("a.json"));
  try {
    read_diagram(folder.path("a.json"));
    FAIL() << "was taken without a word";
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.front().code, "nested_in_itself");
    EXPECT_NE(error.problems.front().what.find("a.json -> b.json -> c.json -> a.json"), std::string::npos)
        << error.what();
  }
}

/// What a file that cannot be read is told, and what to do.
template <class Read>
std::string told_of(const std::string& name, const std::string& content, const Read& read) {
  const TemporaryFolder folder;
  try {
    read(folder.write(name, content));
  } catch (const Error& error) {
    return error.problems.front().what + "; " + error.problems.front().cure;
  }
  return "";
}

TEST(WordsOfBadFiles, NameTheCureOfCommonMistakes) {
  const auto diagram = [](const std::string& file) { read_diagram(file); };
  const auto data = [](const std::string& file) { read_dataset(file); };
  const auto says = [](const std::string& told, const char* words) {
    EXPECT_NE(told.find(words), std::string::npos) << told;
  };
  says(told_of("d.json", "{\"format\": 1, // why\n\"blocks\": {}}", diagram), "JSON knows no comments");
  says(told_of("d.json", "{\"format\": 1,\n# why\n\"blocks\": {}}", diagram), "JSON knows no comments");
  says(told_of("d.json", R"({"format": 1, "blocks": {"a": {"type": "lag", "times": ["$tau"]}}})", diagram),
       "in place of the whole list");
  says(told_of("d.json", R"({"format": 1, "blocks": {"a": {"type": "recorded", "file": "x.csv", "column": "u"}}})",
               [&](const std::string& file) {
                 std::ofstream(std::filesystem::path(file).parent_path() / "x.csv") << "t (ms),u\n0,1\n1,2\n2,3\n";
                 diagram(file);
               }),
       "square brackets: t [ms]");
  says(told_of("x.csv", "t [s],u\n0,1\n", data), "there is 1 row,");
  says(told_of("x.csv", "t [s],u\n0,1\n1,2\n", data), "there are 2 rows,");
}

TEST(BadDiagramFile, BracketsNestedWithoutEndAreRefused) {
  const TemporaryFolder folder;
  const std::string file = folder.write("d.json", std::string(100000, '[') + std::string(100000, ']'));
  expect_problem({"", "", "too_deep", "", 1}, file, [&] { read_diagram(file); });
}

TEST(ProjectFolder, AProjectFileAnAllowedFolderOrNothingDecidesWhatMayBeNamed) {
  const TemporaryFolder folder;
  folder.write("shared/stage.json", "{\"format\": 1, \"blocks\": {}}");
  const std::string file =
      folder.write("mine/d.json",
                   "{\"format\": 1, \"blocks\": {\"s\": {\"type\": \"diagram\", \"file\": \"../shared/stage.json\"}}}");
  EXPECT_THROW(read_diagram(file), Error);
  EXPECT_NO_THROW(read_diagram(file, {folder.path("shared")}));
  EXPECT_THROW(read_diagram(file, {folder.path("share")}), Error);  // a name that only begins alike
  folder.write("hysteron.project", "");
  EXPECT_NO_THROW(read_diagram(file));
}

TEST(ProjectFolder, ALinkThatLeadsOutIsFollowedBeforeItIsJudged) {
  const TemporaryFolder folder;
  folder.write("secret/stage.json", "{\"format\": 1, \"blocks\": {}}");
  const std::string file = folder.write(
      "mine/d.json", "{\"format\": 1, \"blocks\": {\"s\": {\"type\": \"diagram\", \"file\": \"link/stage.json\"}}}");
  std::filesystem::create_directory_symlink("../secret", folder.path("mine/link"));
  expect_problem({"", "", "outside_project", "/blocks/s/file", 1}, file, [&] { read_diagram(file); });
}

// ----------------------------------------------------------------------------------------------------- data sets

class BadDataSet : public ::testing::TestWithParam<Case> {};
TEST_P(BadDataSet, IsToldWithCodePlaceLineAndCure) {
  const TemporaryFolder folder;
  folder.write("outside.csv", "t [s],u [V],y [um]\n0,1,2\n1,2,3\n2,3,4\n");
  folder.write("p/good.csv", "t [s],u [V],y [um]\n0,1,2\n1,2,3\n2,3,4\n3,4,5\n");
  folder.write("p/dense.csv", "t [s],u [V],y [um]\n0,1,2\n5e-324,2,3\n1e-323,3,4\n");
  folder.write("p/epoch.csv", "t [s],u [V],y [um]\n1e9,1,2\n1000000001,2,3\n1000000001.0000002,3,4\n");
  folder.write("p/back.csv", "t [s],u [V],y [um]\n0,1,2\n2,2,3\n1,3,4\n");
  folder.write("p/still.csv", "t [s],u [V],y [um]\n0,1,2\n0,2,3\n1,3,4\n");
  folder.write("p/short.csv", "t [s],u [V],y [um]\n0,1,2\n1,2,3\n");
  folder.write("p/text.csv", "t [s],u [V],y [um]\n0,1,2\n1,oops,3\n2,2,2\n");
  folder.write("p/timeless.csv", "p [Pa],u [V],y [um]\n0,1,2\n1,2,3\n2,3,4\n");
  folder.write("p/x.mat", std::string("MATLAB 4.9", 10) + std::string(200, '\0'));
  folder.write("p/volts.csv", "t [V],u [V],y [um]\n0,1,2\n1,2,3\n2,3,4\n");
  const std::string file = folder.write("p/data.json", GetParam().content);
  expect_problem(GetParam(), file, [&] { read_dataset(file); });
}

#define ONE(entry) "{\"format\": 1, \"recordings\": [\n{" entry "}]}"
#define COLUMN(entry) \
  "{\"format\": 1, \"recordings\": [{\"file\": \"good.csv\", \"role\": \"train\"}], \"columns\": {\n" entry "}}"
INSTANTIATE_TEST_SUITE_P(
    Files, BadDataSet,
    ::testing::Values(
        Case{"Empty", "", "empty_file", "", 1}, Case{"BrokenJson", "{\"format\": 1,\n", "bad_json", "column 1", 2},
        Case{"NewerFormat", "{\n\"format\": 7}", "newer_format", "/format", 2},
        Case{"NoRecordings", "{\"format\": 1}", "missing_key", "", 1},
        Case{"EmptyList", "{\"format\": 1,\n\"recordings\": []}", "no_recordings", "/recordings", 2},
        Case{"UnknownKey", ONE("\"file\": \"good.csv\", \"rol\": \"train\""), "unknown_key", "/recordings/0/rol", 2},
        Case{"NoFile", ONE("\"role\": \"train\""), "missing_key", "/recordings/0", 2},
        Case{"FileWithoutAName", ONE("\"file\": \"\", \"role\": \"train\""), "bad_value", "/recordings/0/file", 2},
        Case{"UnknownRole", ONE("\"file\": \"good.csv\", \"role\": \"training\""), "unknown_role", "/recordings/0/role",
             2},
        Case{"NoRoleAmongSeveral",
             "{\"format\": 1, \"recordings\": [{\"file\": \"good.csv\", \"role\": \"train\"},\n{\"file\": "
             "\"good.csv\"}]}",
             "missing_key", "/recordings/1", 2},
        Case{"MissingFile", ONE("\"file\": \"no.csv\", \"role\": \"train\""), "no_file", "/recordings/0/file", 2},
        Case{"AFolder", ONE("\"file\": \".\", \"role\": \"train\""), "is_directory", "/recordings/0/file", 2},
        Case{"Outside", ONE("\"file\": \"../outside.csv\", \"role\": \"train\""), "outside_project",
             "/recordings/0/file", 2},
        Case{"MatFile", ONE("\"file\": \"x.mat\", \"role\": \"train\""), "unknown_file_type", "x.mat", 0},
        Case{"DecreasingTime", ONE("\"file\": \"back.csv\", \"role\": \"train\""), "decreasing_time", "t", 4},
        Case{"TimeStandsStill", ONE("\"file\": \"still.csv\", \"role\": \"train\""), "decreasing_time", "t", 3},
        Case{"RowsAnInstantApart", ONE("\"file\": \"dense.csv\", \"role\": \"train\""), "rows_too_near", "t", 3},
        Case{"RowsThatTheTimeCannotTellApart", ONE("\"file\": \"epoch.csv\", \"role\": \"train\""), "rows_too_near",
             "t", 4},
        Case{"TextInAColumn", ONE("\"file\": \"text.csv\", \"role\": \"train\""), "bad_number", "u", 3},
        Case{"TwoRows", ONE("\"file\": \"short.csv\", \"role\": \"validate\""), "too_few_rows", "short.csv", 3},
        Case{"NoTime", ONE("\"file\": \"timeless.csv\", \"role\": \"train\""), "missing_column", "t", 1},
        Case{"TimeInVolts", ONE("\"file\": \"volts.csv\", \"role\": \"train\""), "wrong_unit", "t", 1},
        Case{"WeightZero", ONE("\"file\": \"good.csv\", \"weight\": 0"), "bad_value", "/recordings/0/weight", 2},
        Case{"StartInVolts", ONE("\"file\": \"good.csv\", \"start\": \"3 V\""), "wrong_unit", "/recordings/0/start", 2},
        Case{"SkipEverything", ONE("\"file\": \"good.csv\", \"skip\": \"2.5 s\""), "too_few_rows", "/recordings/0", 2},
        Case{"NegativeSkip", ONE("\"file\": \"good.csv\", \"skip\": \"-1 s\""), "bad_value", "/recordings/0/skip", 2},
        Case{"UnknownInitial", ONE("\"file\": \"good.csv\", \"initial\": \"restt\""), "bad_value",
             "/recordings/0/initial", 2},
        Case{"InitialWithoutUnit", ONE("\"file\": \"good.csv\", \"initial\": {\"stage.x\": 5}"), "missing_unit",
             "/recordings/0/initial/stage.x", 2},
        Case{"MissingColumn", COLUMN("\"z\": {\"to\": \"y\"}"), "missing_column", "/columns/z", 2},
        Case{"TwoColumnsToOneName", COLUMN("\"u\": {\"to\": \"x\"}, \"y\": {\"to\": \"x\"}"), "duplicate_column",
             "/columns/y", 2},
        Case{"ANameThatAnotherColumnHas",
             "{\"format\": 1, \"columns\": {\"u\": {\"to\": \"y\"}}, \"recordings\": [\n{\"file\": \"good.csv\"}]}",
             "duplicate_column", "/recordings/0", 2},
        Case{"TimeBound", COLUMN("\"t\": {\"to\": \"u\"}"), "bad_value", "/columns/t", 2},
        Case{"NoiseInVolts", COLUMN("\"y\": {\"noise\": \"2 V\"}"), "wrong_unit", "/columns/y/noise", 2},
        Case{"NegativeNoise", COLUMN("\"y\": {\"noise\": {\"white\": -1}}"), "bad_value", "/columns/y/noise/white", 2},
        Case{"UnknownNoise", COLUMN("\"y\": {\"noise\": {\"pink\": 1}}"), "unknown_key", "/columns/y/noise/pink", 2},
        Case{"DelayWithoutUnit", COLUMN("\"y\": {\"delay\": 1}"), "missing_unit", "/columns/y/delay", 2},
        Case{"HalfASample", COLUMN("\"y\": {\"delay\": \"0.5 samples\"}"), "bad_value", "/columns/y/delay", 2},
        Case{"NegativeDelay", COLUMN("\"y\": {\"delay\": \"-1 sample\"}"), "bad_value", "/columns/y/delay", 2},
        Case{"DelayOfVolts", COLUMN("\"y\": {\"delay\": \"1 V\"}"), "wrong_unit", "/columns/y/delay", 2},
        Case{"UnknownZero", COLUMN("\"y\": {\"zero\": \"each\"}"), "bad_value", "/columns/y/zero", 2},
        Case{"LimitsTheWrongWayRound", COLUMN("\"y\": {\"limits\": [5, 1]}"), "bad_value", "/columns/y/limits", 2},
        Case{"LimitsInVolts", COLUMN("\"y\": {\"limits\": [0, \"1 V\"]}"), "wrong_unit", "/columns/y/limits/1", 2},
        Case{"LimitsByAWord", COLUMN("\"y\": {\"limits\": \"none\"}"), "bad_value", "/columns/y/limits", 2},
        Case{"LimitsThatLeaveNothing", COLUMN("\"y\": {\"limits\": [0, 3]}"), "too_few_rows", "/recordings", 1},
        Case{"ALogarithmAsUnit", COLUMN("\"y\": {\"unit\": \"dB\"}"), "bad_unit", "/columns/y/unit", 2},
        Case{"AnUnknownUnit", COLUMN("\"y\": {\"unit\": \"furlongs?\"}"), "bad_unit", "/columns/y/unit", 2},
        Case{"ASpanWithoutAnEnd", ONE("\"file\": \"good.csv\", \"exclude\": [[\"1 s\"]]"), "bad_value",
             "/recordings/0/exclude/0", 2},
        Case{"ASpanThatEndsBeforeItBegins", ONE("\"file\": \"good.csv\", \"exclude\": [[\"1 s\", \"0 s\"]]"),
             "bad_value", "/recordings/0/exclude/0", 2},
        Case{"UnknownBetween", COLUMN("\"u\": {\"between_samples\": \"cubic\"}"), "bad_value",
             "/columns/u/between_samples", 2}),
    name_of);
#undef ONE
#undef COLUMN

TEST(BadDataSetFile, ASingleCsvThatCannotBeCutIsTold) {
  const TemporaryFolder folder;
  const std::string file = folder.write("x.csv", "t [s],u\n0,1\n1,2\n2,3\n3,4\n4,5\n");
  expect_problem({"", "", "too_few_rows", "x.csv", 0}, file, [&] { read_dataset(file); });
}

}  // namespace
}  // namespace hysteron
