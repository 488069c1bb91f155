// Decides a study that is small enough for tests and has everything that matters to shards: several draws in each,
// a filter, a simulation.
#pragma once

#include <string>

#include "tests/app/hysteron_process.h"

namespace hysteron::small_study {

/// job.json (4 shards) and stage.json, into `at` ("" or "lab/"). Steps are variable, so that draws are
/// simulated one after the other: about 1 ms each.
inline void write(const process::Folder& folder, const std::string& at, int draws) {
  folder.write(at + "stage.json", R"({"format": 1, "title": "stage", "blocks": {
    "drive": {"type": "sine", "amplitude": "3 V", "frequency": "5 Hz"},
    "law": {"type": "bouc_wen", "alpha": "0.6 um/V", "beta": "0.24 1/V", "gamma": "0.02 1/V", "d_p": "1.6 um/V",
            "in": "drive"}},
    "record": ["law"]})");
  folder.write(at + "job.json", R"({"format": 1, "do": "study", "title": "stage", "diagram": "stage.json",
    "until": "0.4 s", "every": "4 ms",
    "sample": {"method": "uniform", "seed": 5, "draws": )" +
                                    std::to_string(draws) + R"(, "shards": 4,
               "parameters": {"law.alpha": {"from": "0.4 um/V", "to": "0.8 um/V"},
                              "law.beta": {"from": "0.2 1/V", "to": "0.3 1/V"}}},
    "features": {"stroke": {"take": "stroke", "of": "law"}, "area": {"take": "area", "of": "law", "over": "drive"}},
    "filters": [{"feature": "stroke", "above": "7 um"}]})");
}

}  // namespace hysteron::small_study
