// Jobs: command lines out of the verbs' own options, processes that outlive the studio, and what is told of them.
// The program is a script of the test, which does what the words ask for.
#include "studio/jobs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "engine/diagram/error.h"
#include "tests/io/temporary_folder.h"

namespace hysteron::studio {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::vector<JobVerb> verbs{{"run",
                                  {{"--until", false, false},
                                   {"--set", false, true},
                                   {"--data", false, false},
                                   {"--deep", true, false},
                                   {"-o", false, false},
                                   {"--json", true, false}}},
                                 {"fit", {{"--threads", false, false}}}};

/// Ends well, fails with a problem, or goes on until it is interrupted, as the name of the diagram says.
constexpr char program[] = R"(#!/bin/bash
echo '{"fraction":0.25,"what":"half way","seconds_left":3.5}' >&2
case $2 in
  */good.json) echo '{"verb": "run", "exit_code": 0, "headline": "it is done"}' ;;
  */bad.json) printf '{\n "exit_code": 2,\n "problems": [{"code": "bad_unit", "what": "no unit", "cure": "write one"}]\n}\n' >&2; exit 2 ;;
  */long.json) trap 'exit 130' INT; echo $$ > started; while :; do sleep 0.02; done ;;
  */deaf.json) trap '' INT; echo $$ > started; while :; do sleep 0.02; done ;;
  */dies.json) kill -KILL $$ ;;
esac
)";

class StudioJobs : public testing::Test {
 protected:
  StudioJobs() {
    write("program", program);
    fs::permissions(folder_.path("program"), fs::perms::owner_all);
    for (const char* name : {"good", "bad", "long", "deaf", "dies"}) write(std::string(name) + ".json", "{}");
    open_ = std::make_unique<OpenFolder>(folder_.path());
  }
  void write(const std::string& name, const std::string& content) const { (void)folder_.write(name, content); }
  JobSettings settings() const { return {folder_.path("program"), verbs, {}, 2}; }
  static json order(const std::string& diagram) { return {{"verb", "run"}, {"diagram", diagram}}; }

  /// The job once it has such a state; as it is then, where that takes a minute.
  static json wait_for(const Jobs& jobs, const std::string& id, const std::vector<std::string>& states) {
    json found;
    for (int i = 0; i < 6000; ++i) {
      for (const auto& job : jobs.list())
        if (job["id"] == id) found = job;
      if (std::find(states.begin(), states.end(), found.value("state", "")) != states.end()) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return found;
  }
  void wait_for_start() const {
    while (!fs::exists(folder_.path("started")) || fs::file_size(folder_.path("started")) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::vector<std::string> words(const json& asked) const { return job_words(asked, verbs, *open_); }
  std::string refusal(const json& asked) const {
    try {
      words(asked);
    } catch (const Error& error) {
      return error.problems.front().code;
    }
    return "";
  }

  TemporaryFolder folder_;
  std::unique_ptr<OpenFolder> open_;
};

TEST_F(StudioJobs, WordsAreThoseThatTheVerbDeclares) {
  const json asked{
      {"verb", "run"},
      {"diagram", "good.json"},
      {"options", {{"--until", "1 s"}, {"--set", {"a=1", "-x"}}, {"--deep", true}, {"--data", "bad.json"}}}};
  EXPECT_EQ(words(asked), (std::vector<std::string>{"run", "./good.json", "--data=./bad.json", "--deep", "--set=a=1",
                                                    "--set=-x", "--until=1 s"}));
}

TEST_F(StudioJobs, RefusesWordsThatAreNotTheUsers) {
  EXPECT_EQ(refusal({{"verb", "studio"}, {"diagram", "good.json"}}), "unknown_verb");
  EXPECT_EQ(refusal({{"verb", "run"}, {"diagram", "../good.json"}}), "outside_folder");
  EXPECT_EQ(refusal({{"verb", "run"}, {"diagram", "good.json"}, {"options", {{"-o", "elsewhere"}}}}),
            "bad_command_line");
  EXPECT_EQ(refusal({{"verb", "run"}, {"diagram", "good.json"}, {"options", {{"--no-such", "1"}}}}),
            "bad_command_line");
  EXPECT_EQ(refusal({{"verb", "run"}, {"diagram", "good.json"}, {"options", {{"--data", "/etc/passwd"}}}}),
            "outside_folder");
  EXPECT_EQ(refusal({{"verb", "run"}, {"diagram", "good.json"}, {"options", {{"--until", {"1 s", "2 s"}}}}}),
            "bad_command_line");
}

TEST_F(StudioJobs, TellHowTheyEnded) {
  Jobs jobs(*open_, settings());
  const json good = wait_for(jobs, jobs.begin(order("good.json")), {"done"});
  EXPECT_EQ(good["state"], "done");
  EXPECT_EQ(good["headline"], "it is done");
  EXPECT_EQ(good["fraction"], 0.25);
  EXPECT_EQ(good["seconds_left"], 3.5);
  const json bad = wait_for(jobs, jobs.begin(order("bad.json")), {"failed"});
  EXPECT_EQ(bad["exit_code"], 2);
  EXPECT_EQ(bad["problems"][0]["code"], "bad_unit");
  const json dead = wait_for(jobs, jobs.begin(order("dies.json")), {"failed"});
  EXPECT_EQ(dead["problems"][0]["what"], "the process was killed by signal 9");
}

TEST_F(StudioJobs, AreOfAnEarlierVersionOnceTheDiagramHasChanged) {
  Jobs jobs(*open_, settings());
  const std::string id = jobs.begin(order("good.json"));
  EXPECT_EQ(wait_for(jobs, id, {"done"})["stale"], false);
  write("good.json", "{ }");
  EXPECT_EQ(wait_for(jobs, id, {"done"})["stale"], true);
}

TEST_F(StudioJobs, EndWhereTheyAreCancelled) {
  Jobs jobs(*open_, settings());
  const std::string id = jobs.begin(order("long.json"));
  wait_for_start();
  EXPECT_THROW(jobs.remove(id), Error) << "it runs";
  jobs.cancel(id);
  EXPECT_EQ(wait_for(jobs, id, {"cancelled"})["state"], "cancelled");
  jobs.remove(id);
  EXPECT_EQ(jobs.list().size(), 0U);
  EXPECT_FALSE(fs::exists(folder_.path(".hysteron/jobs/" + id)));
}

TEST_F(StudioJobs, GoOnWithoutTheStudioAndAreFoundAgain) {
  std::string finished, running;
  {
    Jobs jobs(*open_, settings());
    finished = jobs.begin(order("good.json"));
    wait_for(jobs, finished, {"done"});
    running = jobs.begin(order("long.json"));
    wait_for_start();
  }
  Jobs jobs(*open_, settings());
  EXPECT_EQ(wait_for(jobs, finished, {"done"})["headline"], "it is done");
  EXPECT_EQ(wait_for(jobs, running, {"running"})["state"], "running");
  jobs.cancel(running);
  EXPECT_EQ(wait_for(jobs, running, {"cancelled"})["state"], "cancelled");
}

TEST_F(StudioJobs, OneAfterTheOtherWhereTheThreadsDoNotSuffice) {
  JobSettings one = settings();
  one.threads = 1;
  Jobs jobs(*open_, one);
  const std::string first = jobs.begin(order("long.json"));
  wait_for_start();
  const std::string second = jobs.begin(order("good.json"));
  EXPECT_EQ(wait_for(jobs, second, {"waiting"})["state"], "waiting");
  jobs.cancel(first);
  EXPECT_EQ(wait_for(jobs, second, {"done"})["state"], "done");
}

}  // namespace
}  // namespace hysteron::studio
