// The verb studio: the page on which diagrams are drawn, run and compared.
// Does not serve (studio/), nor do what the page asks for: that are other verbs, in processes of their own.
#include "studio/studio.h"

#include <algorithm>
#include <filesystem>
#include <thread>

#include "app/cli/answer.h"
#include "app/cli/answer_json.h"
#include "app/cli/interrupt.h"
#include "app/cli/load.h"
#include "app/cli/perform.h"
#include "app/cli/shape.h"
#include "app/cli/watch.h"
#include "app/cli/words.h"
#include "app/verbs/recording_preview.h"
#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"

namespace hysteron {
namespace {

constexpr char studio_help[] =
    "Opens a page in your browser: diagrams of a folder as they are drawn, run, compared with recordings, edited,\n"
    "and what is missing in them found. All that it does, other verbs do; the page says with which words.\n\n"
    "Examples:\n"
    "  hysteron studio diagrams/discover/demo\n"
    "  hysteron studio --no-browser --port 8123      then open the address that is printed\n"
    "  ssh -L 8123:127.0.0.1:8123 lab                a studio that runs on another machine\n\n"
    "Listens on this machine alone. The address holds a token: whoever has it can read and change files below the\n"
    "folder. Writes what you edit, and jobs with their results into FOLDER/.hysteron/jobs. Ctrl-C ends the studio;\n"
    "jobs that run go on, and are there when it is started again (docs/studio.md).\n"
    "Exit codes: 0 ended by Ctrl-C, 2 there is no such folder, or the port is taken.";

/// What the page may start.
const std::vector<std::string> job_verbs{"run", "compare", "diagnose", "discover", "fit", "linearize", "inspect"};

studio::JobVerb job_verb(const Verb& verb) {
  studio::JobVerb job{verb.name, {}};
  for (const auto& option : verb.options)
    if (option.name.starts_with("-")) job.options.push_back({option.name, option.placeholder.empty(), option.repeated});
  return job;
}

std::vector<studio::JobVerb> verbs_for_jobs() {
  std::vector<studio::JobVerb> verbs;
  for (const auto make : verb_functions())
    if (const Verb verb = make(); std::find(job_verbs.begin(), job_verbs.end(), verb.name) != job_verbs.end())
      verbs.push_back(job_verb(verb));
  return verbs;
}

AskedVerb read_own_words(const std::vector<std::string>& words) {
  AskedVerb asked = read_words(words);
  if (!asked.verb) fail("bad_command_line", words.front(), "these words ask for help", "reload the page");
  return asked;
}

/// A verb in this process: what is handed to the studio for answers that are wanted at once.
studio::VerbAnswer carry_out(const std::vector<std::string>& words, const std::function<bool()>& stop) {
  const AskedVerb asked = read_own_words(words);
  Watch watch;
  watch.stop = stop;
  const auto too_long = [&words] {
    fail("took_too_long", words.front(), "this takes longer than a number is dragged",
         "let the number go: then it runs as a job");
  };
  try {
    Performed performed = perform_silently(*asked.verb, asked.arguments, watch);
    Answer& answer = performed.answer;
    return {answer_json(*asked.verb, answer, performed.notes), answer.document.headline,
            std::move(answer.document.traces)};
  } catch (const Interrupted&) {
    too_long();
  } catch (const Stopped&) {
    too_long();
  }
  return {};
}

studio::RecordingPreview preview(const std::vector<std::string>& words) {
  return preview_recording(read_own_words(words).arguments);
}

Verb verb_named(const std::string& name) {
  for (const auto make : verb_functions())
    if (Verb verb = make(); verb.name == name) return verb;
  return {};
}

/// What "hysteron blocks --json" says.
std::string all_blocks_json() {
  const Verb verb = verb_named("blocks");
  return answer_json(verb, verb.act(Arguments(), Watch()), {});
}

Answer serve_studio(const Arguments& arguments, const Watch& watch) {
  studio::StudioSettings settings;
  settings.folder = arguments.text("folder", ".");
  constexpr int largest_port = 65535;
  settings.port = arguments.has("--port") ? arguments.whole_number("--port", 0, largest_port) : 0;
  settings.opens_browser = !arguments.has("--no-browser");
  settings.api = {&registry(), all_blocks_json(),           version_of_program(),
                  {},          job_verb(verb_named("new")), {carry_out, preview}};
  settings.api.jobs = {std::filesystem::read_symlink("/proc/self/exe").string(), verbs_for_jobs(),
                       arguments.list("--allow"), arguments.threads()};
  watch.keep();  // Ctrl-C is how it ends
  const auto ready = [&](const std::string& address) {
    watch.note("the studio is open at " + address + " ; Ctrl-C ends it");
  };
  Answer answer;
  const std::string address = studio::serve(settings, ready, watch.stop);
  answer.facts = Facts::object({{"address", address}});
  return answer;
}

std::vector<shape::Member> studio_shape() { return {{"address", shape::text("where the page was, until it ended")}}; }

}  // namespace

Verb studio_verb() {
  return {"studio",
          "draw, run and compare in a browser",
          studio_help,
          {{"folder", "FOLDER", "the folder with your diagrams; default: this one", false, false},
           {"--port", "N", "listen on this port; default: any that is free", false, false},
           {"--no-browser", "", "open no browser; the address is printed", false, false},
           options::threads("so many threads for all jobs"),
           options::allow()},
          serve_studio,
          studio_shape};
}

}  // namespace hysteron
