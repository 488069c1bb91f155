// The verb diagnose: which physical effect is missing, with evidence; one, the first.
// Does not search itself (look.h, discover/).
#include "app/verbs/look.h"

namespace hysteron {
namespace {

constexpr char diagnose_help[] =
    "Answers: WHICH physical effect is missing, with evidence, or an honest \"cannot tell\".\n"
    "This is the first step of \"hysteron discover\": everything is tried, one effect is named, none is piled on "
    "it.\n\n"
    "Examples:\n"
    "  hysteron diagnose stage.json --data dataset.json\n"
    "  hysteron diagnose stage.json --data lab.csv --free gain --only creep\n"
    "  hysteron diagnose stage.json --data lab.csv --experiment drive.csv\n\n"
    "Writes into the folder: result.json, traces/*.csv, report.html, and the diagram with the effect named.\n"
    "Exit codes: 0 done, whatever was found; 2 wrong input, 3 numerics failed, 130 interrupted.";

Answer diagnose(const Arguments& arguments, const Watch& watch) { return look("diagnose", arguments, watch); }

}  // namespace

Verb diagnose_verb() {
  return {"diagnose", "which physical effect is missing, with evidence", diagnose_help, look_options(), diagnose,
          look_shape};
}

}  // namespace hysteron
