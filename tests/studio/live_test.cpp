// What a diagram answers while a number is dragged: the curves of the moment, and nothing that is kept.
#include "studio/live.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <thread>

#include "engine/diagram/error.h"
#include "tests/io/temporary_folder.h"

namespace hysteron::studio {
namespace {

using nlohmann::json;

const std::vector<JobVerb> live_verbs{{"run", {{"--set", false, true}, {"--data", false, false}}}};

/// The JSON and the numbers of an answer.
std::pair<json, std::vector<double>> read(const std::string& bytes) {
  std::vector<double> all(bytes.size() / sizeof(double));
  std::memcpy(all.data(), bytes.data(), all.size() * sizeof(double));
  const auto length = static_cast<std::size_t>(all[0]);
  const std::size_t skipped = 1 + length / sizeof(double);
  return {json::parse(bytes.substr(sizeof(double), length)), {all.begin() + static_cast<long>(skipped), all.end()}};
}

VerbAnswer two_rows() {
  VerbAnswer answer{R"({"facts": {"diagram": "d"}})", "it was run", {}};
  answer.traces.push_back({"signals.f64", {{"t", parse_unit("s"), {0, 1}}, {"y", parse_unit("um"), {2, 3}}}, {}, {}});
  return answer;
}

class StudioLive : public testing::Test {
 protected:
  TemporaryFolder folder_;
  OpenFolder open_{folder_.path()};
};

TEST_F(StudioLive, GivesTheColumnsThatAreLookedAt) {
  std::vector<std::string> words;
  Live live(open_, live_verbs, {"/elsewhere"},
            {[&](const std::vector<std::string>& w, const OwnVerbs::Stop&) {
               words = w;
               return two_rows();
             },
             {}});
  const auto [head, numbers] = read(live.answer({{"verb", "run"},
                                                 {"diagram", "d.json"},
                                                 {"options", {{"--set", {"stage.gain=3 um/V"}}, {"--data", "lab.csv"}}},
                                                 {"trace", "signals.f64"},
                                                 {"columns", {"y", "gone"}}}));
  EXPECT_EQ(words, (std::vector<std::string>{"run", open_.path() + "/d.json", "--data=" + open_.path() + "/lab.csv",
                                             "--set=stage.gain=3 um/V", "--allow=/elsewhere"}));
  EXPECT_EQ(head["headline"], "it was run");
  EXPECT_EQ(head["facts"]["diagram"], "d");
  EXPECT_EQ(head["columns"], json::parse(R"([{"name": "y", "unit": "um"}])"));
  EXPECT_EQ(numbers, (std::vector<double>{2, 0, 1, 2, 3, 2, 3}));
}

TEST_F(StudioLive, EndsWhatTakesTooLong) {
  Live live(open_, live_verbs, {},
            {[](const std::vector<std::string>&, const OwnVerbs::Stop& stop) -> VerbAnswer {
               while (!stop()) std::this_thread::yield();
               fail("took_too_long", "run", "it took long", "let go");
             },
             {}});
  EXPECT_THROW((void)live.answer({{"verb", "run"}, {"diagram", "d.json"}, {"patience", 5}}), Error);
}

TEST_F(StudioLive, ALaterRequestEndsTheOneBefore) {
  std::atomic<bool> is_computing{false};
  Live live(open_, live_verbs, {},
            {[&](const std::vector<std::string>& words, const OwnVerbs::Stop& stop) -> VerbAnswer {
               if (words[1].ends_with("quick.json")) return two_rows();
               is_computing = true;
               while (!stop()) std::this_thread::yield();
               fail("took_too_long", "run", "it took long", "let go");
             },
             {}});
  std::string code;
  std::thread first([&] {
    try {
      (void)live.answer({{"verb", "run"}, {"diagram", "slow.json"}, {"patience", 30000}});
    } catch (const Error& error) {
      code = error.problems.front().code;
    }
  });
  while (!is_computing) std::this_thread::yield();
  EXPECT_EQ(read(live.answer({{"verb", "run"}, {"diagram", "quick.json"}})).first["trace"], "signals.f64");
  first.join();
  EXPECT_EQ(code, "took_too_long");
}

TEST_F(StudioLive, CarriesOutNoOtherWords) {
  Live live(open_, live_verbs, {},
            {[](const std::vector<std::string>&, const OwnVerbs::Stop&) { return two_rows(); }, {}});
  EXPECT_THROW((void)live.answer({{"verb", "new"}, {"diagram", "d.json"}}), Error);
  EXPECT_THROW((void)live.answer({{"verb", "run"}, {"diagram", "../d.json"}}), Error);
  EXPECT_THROW((void)live.answer({{"verb", "run"}, {"diagram", "d.json"}, {"options", {{"-o", "x"}}}}), Error);
}

}  // namespace
}  // namespace hysteron::studio
