// Files damaged at random: read or refused with a cure, never a crash, never another exception.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <random>

#include "engine/diagram/error.h"
#include "io/data/binary_table.h"
#include "io/data/csv.h"
#include "io/data/dataset.h"
#include "io/data/recording_file.h"
#include "io/diagram/diagram_file.h"
#include "io/jobs/claims_file.h"
#include "io/jobs/runs_job.h"
#include "tests/io/formats/instrument_files.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

const char* diagram = R"json({"$schema": "s", "format": 1, "title": "t",
 "parameters": {"kp": {"value": 1.2, "unit": "V/um", "bounds": [0, null], "free": true}},
 "inputs": {"u": {"unit": "V"}},
 "blocks": {"a": {"type": "sine", "amplitude": "$kp", "frequency": "5 Hz"},
  "b": {"choose": "on", "in": ["a", "u"], "from": {"off": {"type": "pass"}, "on": {"type": "creep", "times": ["1 s", 2]}}},
  "c": {"type": "recorded", "file": "a.csv", "column": "u"}, "d": {"type": "gain", "gain": {"value": [1, 2], "unit": "\u006d"}, "in": {"u": "b"}}},
 "outputs": {"y": "d"}, "record": ["a"], "places": {"core": "b"},
 "simulate": {"until": "1 s", "solver": {"method": "bdf", "relative_tolerance": 1e-6}}}
)json";
const char* dataset = R"json({"format": 1, "title": "t",
 "columns": {"u": {"between_samples": "hold"}, "y": {"to": "z", "noise": {"white": "2 nm"}, "delay": "1 sample", "zero": "per_recording"}},
 "recordings": [{"file": "a.csv", "role": "train", "start": "1 h", "initial": {"s.x": "1 um"}, "skip": "1 s"},
  {"file": "a.csv", "role": "validate", "until": "4 s", "weight": 2}]}
)json";
const char* job =
    R"json({"format": 1, "do": "runs", "title": "t", "diagram": "d.json", "set": {"a.b": "1 V"}, "until": "1 s",
 "runs": {"a": {"choose": {"c": "d"}}, "b": {"fit": "f.json", "data": {"run": "a", "columns": {"u": "v"}, "between": [0, "1 s"]}},
  "c": {"linearize": {"from": "e", "to": "y", "open": "e"}}, "e": {"from": "x.json", "run": "y"}, "g": {"set": {"a.b": {"of": "v", "times": 2}}, "use": {"b": "m"}},
  "f": {"find": {"parameter": "p", "range": [1, "2 V"], "value": {"take": "last", "of": "y"}, "equals": "0 V"}}},
 "plots": [{"kind": "curve", "x": {"signal": "u", "from": 0, "to": 6}, "y": {"signals": ["y"], "minus": {"run": "a", "signal": "z"}}, "runs": ["a"]}],
 "values": {"v": {"take": "area", "of": "y", "over": "u", "run": "a"}, "w": {"ratio": ["v", "v"]}},
 "claims": [{"id": "C1", "value": "v", "expected": "1 um V", "tolerance": "1 %"}, {"id": "C2", "order": ["v", "w"]}]})json";
const char* claims =
    R"json({"format": 1, "claims": {"C1": {"says": "a", "calibrated": "b"}, "C2": {"says": "c", "cannot": "d"}}})json";
const char* csv = "# comment\r\nt [s],\"u [V]\",y [um]\r\n0,1,2\r\n1,+1.5,-2e-3\n2,1,2\n3,1,2\n4,1,2\n5,1,2\n";

/// A few bytes of `text` lost, doubled or replaced; the replacements are those that formats are made of.
std::string damaged(std::string text, std::mt19937& random) {
  static const std::string bytes = "{}[]\",:\\\n\r \t#0159.-+eE$nulltruefalse/~\xff\xc3\x01";
  const auto pick = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  for (std::size_t k = 1 + pick(3); k > 0 && !text.empty(); --k) {
    const std::size_t at = pick(text.size());
    switch (pick(4)) {
      case 0:
        text.erase(at, 1 + pick(8));
        break;
      case 1:
        text.insert(at, 1, bytes[pick(bytes.size())]);
        break;
      case 2:
        text[at] = bytes[pick(bytes.size())];
        break;
      default:
        text.insert(at, text.substr(pick(text.size()), pick(20)));
    }
  }
  return text;
}

/// Returns how many of the damaged texts were refused.
int refusals(const std::string& good, const std::string& name, const std::function<void(const std::string&)>& read) {
  const TemporaryFolder folder;
  folder.write("a.csv", csv);
  std::mt19937 random(20240501);
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    const std::string text = damaged(good, random);
    const std::string file = folder.write(name, text);
    try {
      read(file);
    } catch (const Error& error) {
      ++refused;
      EXPECT_FALSE(error.problems.empty());
      for (const auto& p : error.problems) EXPECT_FALSE(p.code.empty() || p.what.empty() || p.cure.empty()) << text;
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what() << " from\n" << text;
    }
  }
  return refused;
}

// Most damage must be noticed; some cannot be (a digit of a number, a letter of a title).
TEST(DamagedFiles, DiagramsAreReadOrRefused) {
  EXPECT_GT(refusals(diagram, "d.json",
                     [](const std::string& file) {
                       const Diagram d = read_diagram(file);
                       diagram_text(d);
                     }),
            250);
}
TEST(DamagedFiles, DataSetsAreReadOrRefused) {
  EXPECT_GT(refusals(dataset, "d.json", [](const std::string& file) { read_dataset(file); }), 250);
}
TEST(DamagedFiles, RecordingsAreReadOrRefused) {
  EXPECT_GT(refusals(csv, "x.csv", [](const std::string& file) { read_dataset(file); }), 100);
}
/// Files of instruments: nearly any damage leaves a table that can be read, and none may end the program.
void damage_instruments(int times, unsigned seed) {
  const TemporaryFolder folder;
  std::mt19937 random(seed);
  for (int i = 0; i < times; ++i)
    for (const auto& file : instruments::all_files()) {
      const std::string bytes = damaged(file.bytes, random);
      try {
        read_measured_recording(folder.write(file.name, bytes), 1, {});
      } catch (const Error& error) {
        EXPECT_FALSE(error.problems.empty());
        for (const auto& p : error.problems) EXPECT_FALSE(p.code.empty() || p.what.empty() || p.cure.empty()) << bytes;
      } catch (const std::exception& error) {
        ADD_FAILURE() << file.name << ": " << error.what();
      }
    }
}
TEST(DamagedFiles, FilesOfInstrumentsAreReadOrRefused) { damage_instruments(30, 20260504); }
// Ten minutes of it under sanitizers: scripts/test --all.
TEST(LongDamagedFiles, FilesOfInstrumentsAreReadOrRefused) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(10);
  for (unsigned seed = 1; std::chrono::steady_clock::now() < end; ++seed) damage_instruments(1, seed);
}
TEST(DamagedFiles, BinaryTablesAreReadOrRefused) {
  const TemporaryFolder folder;
  write_binary_table(folder.path("x.f64"), read_csv(folder.write("a.csv", csv)));
  EXPECT_GT(refusals(TemporaryFolder::read(folder.path("x.f64")), "x.f64",
                     [](const std::string& file) { read_dataset(file); }),
            400);
}
TEST(DamagedFiles, JobsAndClaimsAreReadOrRefused) {
  EXPECT_GT(refusals(job, "j.json", [](const std::string& file) { read_runs_job(file); }), 250);
  EXPECT_GT(refusals(claims, "c.json", [](const std::string& file) { read_claims(file); }), 250);
}

}  // namespace
}  // namespace hysteron
