// Exported diagrams as others drive them: every diagram of the project that runs by itself goes in steps where run()
// goes, through both versions of the interface; a walk through all phases in C (walk.c); what lies in the archive.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>

#include "blocks/fmi/native_fmu.h"
#include "blocks/register_all.h"
#include "engine/simulate/simulate.h"
#include "io/diagram/diagram_file.h"
#include "io/diagram/packed_diagram.h"
#include "io/files/zip_archive.h"
#include "io/fmi/exported_description.h"
#include "tests/app/hysteron_process.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

constexpr int rows = 42;

const Registry& blocks_of_all() {
  static const Registry all = all_blocks();
  return all;
}

/// Diagrams that say how often they are recorded and need nothing from outside.
std::vector<std::string> diagrams_that_run() {
  std::vector<std::string> list;
  for (const auto& entry : fs::recursive_directory_iterator(HYSTERON_SOURCE_DIR "/diagrams"))
    if (entry.path().extension() == ".json" && is_diagram_file(entry.path().string()))
      list.push_back(entry.path().string());
  std::sort(list.begin(), list.end());
  return list;
}

/// What it puts out in a simulation, and in steps.
class Ways {
 public:
  explicit Ways(const std::string& file)
      : diagram_(read_diagram(file)),
        program_(compile(diagram_, blocks_of_all())),
        options_(simulate_options(*program_)) {}

  bool run_alone() const { return program_->input_names.empty() && options_.every > 0; }

  void compare(int version) {
    const std::string packed = exported_program(diagram_, all_blocks);
    const auto description = exported_description(*program_, version, "stage", packed_token(packed));
    std::vector<unsigned> references;
    options_.signals.clear();
    for (const auto& output : description.outputs) references.push_back(output.reference);
    options_.signals = program_->output_signals.empty() ? program_->record_signals : program_->output_signals;
    ASSERT_EQ(options_.signals.size(), references.size());
    folder_.write("resources/program.json", packed);
    SimulateOptions options = options_;
    options.until = options_.begin + rows * options_.every;
    const Traces run = simulate(*program_, start(*program_), options);
    for (const double factor : {0.1, 1.0, 7.0}) {
      NativeFmu fmu({version, HYSTERON_FMU, folder_.path("resources"), packed_token(packed), "stage"});
      fmu.enter_initialization(options_.begin, {});
      fmu.exit_initialization();
      follow(fmu, factor, references, run);
    }
  }

 private:
  /// Each way is held to 1e-6 of what signals usually are, and some are rounding beside others of their unit.
  std::map<std::string, double> sizes(const Traces& run) const {
    std::map<std::string, double> size;
    for (std::size_t s = 0; s < run.signals.size(); ++s)
      for (const double v : run.values[s]) {
        double& most = size[unit(s).text];
        most = std::max(most, std::abs(unit(s).from_si(v)));
      }
    return size;
  }
  const Unit& unit(std::size_t s) const {
    return program_->signals[static_cast<std::size_t>(options_.signals[s])].unit;
  }

  void follow(NativeFmu& fmu, double factor, const std::vector<unsigned>& references, const Traces& run) const {
    auto size = sizes(run);
    std::vector<double> seen(references.size());
    const auto last = static_cast<int>(std::round(rows / factor));
    double t = run.t.front();
    for (int k = 1; k <= last; ++k) {
      const double row = k * factor;
      const bool whole = std::abs(row - std::round(row)) < 1e-9;
      const auto place = static_cast<std::size_t>(std::round(row));
      const double until = whole ? run.t[place] : run.t.front() + row * options_.every;
      fmu.step(t, until - t);
      t = until;
      if (!whole) continue;
      fmu.get(references, seen);
      for (std::size_t s = 0; s < seen.size(); ++s)
        ASSERT_NEAR(seen[s], unit(s).from_si(run.values[s][place]), 1e-4 * size[unit(s).text])
            << program_->signals[static_cast<std::size_t>(options_.signals[s])].path << " at " << t << " s, steps "
            << factor;
    }
  }

  Diagram diagram_;
  ProgramPointer program_;
  SimulateOptions options_;
  TemporaryFolder folder_;
};

TEST(Fmu, EveryDiagramOfTheProjectGoesInStepsWhereARunGoes) {
  int seen = 0;
  for (const auto& file : diagrams_that_run()) {
    SCOPED_TRACE(file);
    Ways ways(file);
    if (!ways.run_alone()) continue;
    ways.compare(2);
    ways.compare(3);
    ++seen;
  }
  EXPECT_GT(seen, 40);
}

const std::string driven = HYSTERON_SOURCE_DIR "/tests/interop/driven.json";

/// An exported diagram, unpacked.
class Exported {
 public:
  explicit Exported(const std::string& diagram, const std::vector<std::string>& options = {}) {
    std::vector<std::string> words{"export", "fmu", diagram, "-o", "exported.fmu"};
    words.insert(words.end(), options.begin(), options.end());
    outcome = process::hysteron(folder.path(), words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const ZipArchive archive(folder.path("exported.fmu"), {"FMU", "export it again"});
    names = archive.names();
    text = archive.part("modelDescription.xml");
    description = read_fmi_description(text, "exported.fmu");
    archive.unpack(folder.path());
  }

  TemporaryFolder folder;
  process::Outcome outcome;
  std::vector<std::string> names;
  std::string text;
  FmiDescription description;
};

TEST(Fmu, AProgramInCWalksThroughAllPhases) {
  const Exported fmu(driven);
  const auto reference = [&](const std::string& name) {
    const FmiScalar* v = fmu.description.find(name);
    EXPECT_NE(v, nullptr) << name;
    return std::to_string(v == nullptr ? 0 : v->reference);
  };
  const auto walked = process::shell(
      fmu.folder.path(), std::string(HYSTERON_FMU_WALK) + " " + fmu.folder.path(fmi_binary_name(fmu.description)) +
                             " file://" + fmu.folder.path("resources") + " " + fmu.description.token + " " +
                             reference("u") + " " + reference("y") + " " + reference("gain.gain"));
  EXPECT_EQ(walked.code, 0) << walked.err;
}

TEST(Fmu, ItsDescriptionSaysUnitsRangesAndDependencies) {
  const Exported fmu(driven);
  EXPECT_EQ(fmu.names, (std::vector<std::string>{"modelDescription.xml", "resources/program.json",
                                                 "binaries/linux64/exported.so"}));
  EXPECT_EQ(fmu.outcome.out, "wrote exported.fmu: FMI 2.0 for co-simulation, 1 input, 1 output, 2 parameters\n");
  const FmiDescription& d = fmu.description;
  EXPECT_EQ(fmi_description_faults(d), std::vector<std::string>());
  EXPECT_EQ(d.name, "A lag of what is set from outside");
  EXPECT_EQ(d.stop, 1);
  EXPECT_EQ(d.tolerance, 1e-9);
  EXPECT_TRUE(d.copies_state && d.variable_step);
  const FmiScalar& gain = *d.find("gain.gain");
  EXPECT_EQ(gain.causality + " " + gain.variability + " " + gain.unit, "parameter fixed um/V");
  EXPECT_EQ(gain.start, 1);
  const FmiScalar& times = *d.find("y.times[0]");
  EXPECT_EQ(times.start, 20);
  EXPECT_EQ(times.unit, "ms");
  EXPECT_EQ(times.lower, 0);
  const auto unit = std::find_if(d.units.begin(), d.units.end(), [](const auto& u) { return u.name == "um/V"; });
  ASSERT_NE(unit, d.units.end());
  EXPECT_EQ(unit->unit->scale, 1e-6);
  EXPECT_EQ(unit->unit->dimension, parse_unit("um/V").dimension);
  ASSERT_EQ(d.outputs.size(), 1U);
  EXPECT_EQ(d.outputs[0].dependencies, std::vector<unsigned>());  // behind a lag
}

TEST(Fmu, VersionThreeSaysTheSame) {
  const Exported fmu(driven, {"--fmi", "3", "--set", "gain.gain=2 um/V"});
  EXPECT_EQ(fmu.names.back(), "binaries/x86_64-linux/exported.so");
  EXPECT_EQ(fmu.description.version, 3);
  EXPECT_EQ(fmi_description_faults(fmu.description), std::vector<std::string>());
  EXPECT_EQ(fmu.description.find("gain.gain")->start, 2);
  EXPECT_EQ(fmu.description.find("u")->causality, "input");
}

TEST(Fmu, CheckLooksThroughItAndRunsItWhereItIsTrusted) {
  const Exported fmu(driven);
  const auto check = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"check", "exported.fmu"};
    words.insert(words.end(), more.begin(), more.end());
    return process::hysteron(fmu.folder.path(), words);
  };
  EXPECT_EQ(check({}).out,
            "exported.fmu: ok: FMI 2.0, co-simulation, 1 input, 1 output, 2 parameters\n"
            "  it was not run; if you trust it: --allow exported.fmu\n");
  EXPECT_NE(check({"--allow", "exported.fmu"}).out.find("ok: 10 steps, a reset and the same steps again"),
            std::string::npos);
  std::string text = fmu.text;
  text.replace(text.find("<Unknown index=\"3\""), 18, "<Unknown index=\"2\"");
  fmu.folder.write("exported.fmu", zipped({{"modelDescription.xml", text}}));
  const auto wrong = check({});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("lists 1 as an output, which is none"), std::string::npos) << wrong.err;
  EXPECT_NE(wrong.err.find("there is no binary in it"), std::string::npos) << wrong.err;
}

// The schemas of the standard are in no package of Debian. Who has them says where, in a folder with schema/fmi2 and
// schema/fmi3 as in an archive of the standard, or flat.
TEST(Fmu, DescriptionsAreValidUnderTheSchemasOfTheStandard) {
  const char* const schemas = std::getenv("HYSTERON_FMI_SCHEMAS");
  if (schemas == nullptr) GTEST_SKIP() << "HYSTERON_FMI_SCHEMAS=FOLDER says where fmi2ModelDescription.xsd lies";
  const TemporaryFolder folder;
  std::map<int, std::string> files;
  int count = 0;
  for (const auto& file : diagrams_that_run()) {
    const auto program = compile(read_diagram(file), blocks_of_all());
    for (const int version : {2, 3}) {
      const std::string name = std::to_string(++count) + ".xml";
      files[version] +=
          " " + folder.write(name, fmi_description_text(exported_description(*program, version, "d", "{t}")));
    }
  }
  for (const auto& [version, names] : files) {
    const std::string schema = "fmi" + std::to_string(version) + "ModelDescription.xsd";
    std::string path;
    for (const auto& entry : fs::recursive_directory_iterator(schemas))
      if (entry.path().filename() == schema) path = entry.path().string();
    if (path.empty()) continue;
    const auto checked = process::shell(folder.path(), "xmllint --noout --schema " + path + names);
    EXPECT_EQ(checked.code, 0) << checked.err.substr(0, 4000);
  }
}

TEST(Fmu, ItStandsOnTheLibraryOfCAlone) {
  if (std::string(HYSTERON_SANITIZER_FLAGS) != "") GTEST_SKIP() << "a sanitizer brings libraries of its own";
  const auto needs = process::shell(".", "objdump -p " HYSTERON_FMU " | grep NEEDED");
  EXPECT_NE(needs.out.find("libc.so"), std::string::npos) << "objdump is not there? " << needs.err;
  std::istringstream lines(needs.out);
  for (std::string line; std::getline(lines, line);) {
    const bool own = line.find("libc.so") == std::string::npos && line.find("libm.so") == std::string::npos &&
                     line.find("ld-linux") == std::string::npos;
    EXPECT_FALSE(own) << line;
  }
}

TEST(Fmu, UnitsThatStandInTheWholeTableAloneAreTakenAlong) {
  TemporaryFolder folder;
  Diagram diagram = read_diagram(folder.write("d.json", R"({"format": 1, "title": "t", "simulate": {"until": "1 s"},
    "blocks": {"a": {"type": "constant", "value": "2 fathom"}}, "record": ["a"]})"));
  const PackedDiagram packed = unpacked_diagram(exported_program(diagram, all_blocks));
  ASSERT_EQ(packed.units.size(), 1U);
  EXPECT_EQ(packed.units[0].text, "fathom");
  EXPECT_EQ(packed.units[0].scale, parse_unit("fathom").scale);
}

// A jump of an input is followed as a fast ramp, so the law takes steps of held inputs.
TEST(Fmu, AnInputMayLeadStraightIntoALawDrivenByItsRate) {
  TemporaryFolder folder;
  folder.write("d.json", R"({"format": 1, "title": "t", "inputs": {"u": {"unit": "V"}}, "simulate": {"until": "1 s"},
    "blocks": {"core": {"type": "jiles_atherton", "p_s": "5 um", "a": "20 V", "alpha": "1 V/um", "k": "15 V", "c": 0.1,
                        "in": "u"}}, "outputs": {"y": "core"}})");
  const auto outcome = process::hysteron(folder.path(), {"export", "fmu", "d.json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const auto check = process::hysteron(folder.path(), {"check", "d.fmu", "--allow", "d.fmu"});
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_NE(check.out.find("10 steps"), std::string::npos) << check.out;
}

}  // namespace
}  // namespace hysteron
