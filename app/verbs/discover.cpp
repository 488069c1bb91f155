// The verb discover: the whole loop - compare, name the missing effect, add it, fit it - until only noise is left.
// Does not search itself (look.h, discover/).
#include "app/verbs/look.h"

namespace hysteron {
namespace {

constexpr char discover_help[] =
    "Answers: what does my model lack, and how much better is it with that. Tries every effect that the data can\n"
    "show at every place where it may enter, fits it on the train recordings, judges it on the others, adds what is\n"
    "certain, and goes on until only noise is left or nothing known helps.\n\n"
    "The verdict is one of\n"
    "  adequate             no effect improves other recordings by more than chance, and no structure remains\n"
    "  missing_effect       named, with evidence\n"
    "  not_distinguishable  something is missing; several effects explain it equally well; an experiment would tell\n"
    "  unexplained          structure remains that no known effect explains\n\n"
    "Examples:\n"
    "  hysteron discover stage.json --data dataset.json\n"
    "  hysteron discover stage.json --data lab.csv -o out --steps 1\n"
    "  hysteron discover stage.json --data dataset.json --only creep --only hysteresis\n"
    "  hysteron discover stage.json --data dataset.json --effects own/    with effects of your own\n"
    "  hysteron discover stage.json --data lab.csv --experiment drive.csv    what to record next, as a file to play\n"
    "  hysteron discover model.json --data new.csv --check      a test for machines: is it still explained?\n\n"
    "Numbers of the diagram that are off are told as that: each is known to 10 %, or as well as the diagram says\n"
    "(\"known_to\": \"2 %\"); with --exact what is not free is exact.\n\n"
    "--check holds every parameter of the model (only a sensor's zero per recording, where the data set says so, and\n"
    "the phase of the mains are found anew) and judges as above. Where the recordings are not explained it says what\n"
    "is new: \"parameters\" where other values of the free ones would do, else the effects; \"facts\", \"check\" in\n"
    "result.json has explained, named.\n"
    "Recordings that all have one role are cut in time: 60 % for fitting what is new, the rest to judge it.\n\n"
    "Writes into the folder: result.json (every decision with its numbers), traces/*.csv, report.html, and the\n"
    "diagram of each step (step1_creep.json ... final.json), and pictures of it: base.svg and, where something was\n"
    "found, final.svg. An earlier result of discover in that folder is replaced; what else lies there stays.\n"
    "Ctrl-C, SIGTERM, or the time given by --within, ends at once with the steps found so far; before the model\n"
    "itself was simulated Ctrl-C writes nothing.\n"
    "Exit codes: 0 done, 1 with --check: no longer explained, 2 wrong input, 3 numerics failed,\n"
    "            130 interrupted.";

Answer discover(const Arguments& arguments, const Watch& watch) { return look("discover", arguments, watch); }

}  // namespace

Verb discover_verb() {
  auto list = look_options();
  list.push_back({"--steps", "N", "add at most so many effects, 1 .. 20 (default 3)", false, false});
  list.push_back({"--check", "",
                  "do the recordings still follow the model as it stands? Exit code 1 if not, and the name", false,
                  false});
  return {"discover", "the whole loop, step by step, until only noise is left", discover_help, list, discover,
          look_shape};
}

}  // namespace hysteron
