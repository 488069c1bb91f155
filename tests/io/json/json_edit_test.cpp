// Edits of JSON texts: what is meant changes, everything else stays byte for byte.
#include "io/json/json_edit.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "engine/diagram/error.h"

namespace hysteron {
namespace {

using Kind = JsonEdit::Kind;
using nlohmann::ordered_json;

constexpr char diagram[] = R"({
  "format": 1,
  "blocks": {
    "drive":  {"type": "sine",   "amplitude": 1.50},
    "stage":  {"type": "lag", "in": "drive"}
  },
  "record": ["drive", "stage"]
}
)";

std::string one(const JsonEdit& edit, const std::string& text = diagram) { return edited_json(text, {edit}); }

/// `text` with the first `from` replaced: what an editor by hand would do.
std::string by_hand(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string code_of(const JsonEdit& edit, const std::string& text = diagram) {
  try {
    edited_json(text, {edit});
  } catch (const Error& error) {
    return error.problems.front().code;
  }
  return "";
}

TEST(JsonEdit, ReplacesAValueAndNothingElse) {
  EXPECT_EQ(one({Kind::replace, "/blocks/drive/amplitude", "", "\"2 V\""}), by_hand(diagram, "1.50", "\"2 V\""));
  EXPECT_EQ(one({Kind::replace, "/record/1", "", "\"x\""}),
            by_hand(diagram, "\"drive\", \"stage\"]", "\"drive\", \"x\"]"));
}

TEST(JsonEdit, InsertsAMemberAsItsNeighboursStand) {
  // On a line of its own, in the column of the others.
  EXPECT_EQ(one({Kind::insert, "/blocks", "k", "{\"type\": \"gain\"}"}),
            by_hand(diagram, "\"in\": \"drive\"}", "\"in\": \"drive\"},\n    \"k\":      {\"type\": \"gain\"}"));
  // In the line, behind a blank.
  EXPECT_EQ(one({Kind::insert, "/blocks/drive", "phase", "0"}), by_hand(diagram, "1.50}", "1.50, \"phase\": 0}"));
  EXPECT_EQ(one({Kind::insert, "/record", "", "\"x\""}), by_hand(diagram, "\"stage\"]", "\"stage\", \"x\"]"));
  EXPECT_EQ(one({Kind::insert, "", "title", "\"t\"", "format"}), by_hand(diagram, "1,\n", "1,\n  \"title\": \"t\",\n"));
}

TEST(JsonEdit, InsertsIntoWhatIsEmpty) {
  EXPECT_EQ(one({Kind::insert, "/blocks", "a", "1"}, R"({"blocks": {}})"), R"({"blocks": {"a": 1}})");
  EXPECT_EQ(one({Kind::insert, "/blocks", "a", "1"}, "{\n  \"blocks\": {\n  }\n}"),
            "{\n  \"blocks\": {\n    \"a\": 1\n  }\n}");
}

TEST(JsonEdit, RemovesAMemberWithItsComma) {
  EXPECT_EQ(one({Kind::remove, "/blocks/stage"}),
            by_hand(diagram, ",\n    \"stage\":  {\"type\": \"lag\", \"in\": \"drive\"}", ""));
  EXPECT_EQ(one({Kind::remove, "/blocks/drive"}),
            by_hand(diagram, "\"drive\":  {\"type\": \"sine\",   \"amplitude\": 1.50},\n    ", ""));
  EXPECT_EQ(one({Kind::remove, "/record/0"}), by_hand(diagram, "\"drive\", \"stage\"]", "\"stage\"]"));
  EXPECT_EQ(one({Kind::remove, "/a"}, R"({"a": 1})"), "{}");
}

TEST(JsonEdit, RenamesAMember) {
  EXPECT_EQ(one({Kind::rename, "/blocks/drive", "motor"}), by_hand(diagram, "\"drive\":", "\"motor\":"));
}

TEST(JsonEdit, FollowsEscapesOfPointersAndKeys) {
  EXPECT_EQ(one({Kind::replace, "/a~1b/c~0", "", "2"}, R"({"a/b": {"c~": 1}})"), R"({"a/b": {"c~": 2}})");
  EXPECT_EQ(one({Kind::replace, "/}\"", "", "2"}, R"({"x": "}]\\", "}\"": 1})"), R"({"x": "}]\\", "}\"": 2})");
}

TEST(JsonEdit, RefusesWhatItCannotDo) {
  EXPECT_EQ(code_of({Kind::replace, "/blocks/other", "", "1"}), "no_place");
  EXPECT_EQ(code_of({Kind::insert, "/format", "a", "1"}), "no_place");
  EXPECT_EQ(code_of({Kind::remove, ""}), "no_place");
  EXPECT_EQ(code_of({Kind::insert, "/blocks", "drive", "1"}), "key_there");
  EXPECT_EQ(code_of({Kind::rename, "/blocks/drive", "stage"}), "key_there");
  EXPECT_EQ(code_of({Kind::replace, "/format", "", "1 V"}), "bad_json");
  EXPECT_EQ(code_of({Kind::replace, "/format", "", "1"}, "{\"format\": }"), "bad_json");
}

/// Every place of a document, as pointers.
void collect(const ordered_json& json, const std::string& at, std::vector<std::string>& places) {
  places.push_back(at);
  if (json.is_object())
    for (const auto& [key, value] : json.items()) collect(value, at + "/" + key, places);
  if (json.is_array())
    for (std::size_t i = 0; i < json.size(); ++i) collect(json[i], at + "/" + std::to_string(i), places);
}

TEST(JsonEdit, DoesWhatTheDocumentAsAValueDoes) {
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) { return random() % n; };
  std::string text = diagram;
  ordered_json value = ordered_json::parse(text);
  for (int round = 0; round < 400; ++round) {
    std::vector<std::string> places;
    collect(value, "", places);
    const std::string place = places[below(places.size())];
    ordered_json& here = value[ordered_json::json_pointer(place)];
    const std::string fresh = "n" + std::to_string(round);
    const std::string written = below(2) == 0 ? "{ \"x\" : [1, \"a,}\"] }" : "-1.5e3";
    JsonEdit edit{Kind::replace, place, fresh, written};
    const std::size_t choice = below(3);
    if (choice == 0 && (here.is_object() || here.is_array())) {
      edit.kind = Kind::insert;
      if (here.is_object())
        here[fresh] = ordered_json::parse(written);
      else
        here.push_back(ordered_json::parse(written));
    } else if (choice == 1 && !place.empty()) {
      edit.kind = Kind::remove;
      const auto slash = place.rfind('/');
      ordered_json& parent = value[ordered_json::json_pointer(place.substr(0, slash))];
      const std::string key = place.substr(slash + 1);
      if (parent.is_object())
        parent.erase(key);
      else
        parent.erase(std::stoul(key));
    } else if (!place.empty()) {
      here = ordered_json::parse(written);
    } else {
      continue;
    }
    text = edited_json(text, {edit});
    ASSERT_EQ(ordered_json::parse(text), value) << place << "\n" << text;
  }
}

}  // namespace
}  // namespace hysteron
