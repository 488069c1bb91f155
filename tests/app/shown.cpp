#include "tests/app/shown.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace hysteron::shown {

std::vector<Fence> fences_of(const std::string& file) {
  std::ifstream in(file);
  std::vector<Fence> fences;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) fences.push_back({line.substr(3), ""});
    } else if (inside) {
      fences.back().text += line + "\n";
    }
  }
  return fences;
}

std::vector<std::string> lines_of_output(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && line.find("...") == std::string::npos) lines.push_back(line);
  return lines;
}

int do_as_shown(const std::string& page, const process::Folder& folder, const std::string& name_of_first) {
  std::string output, name = name_of_first;
  int commands = 0;
  for (const auto& fence : fences_of(std::string(HYSTERON_SOURCE_DIR) + "/" + page)) {
    if (fence.language.starts_with("json ") || (fence.language == "json" && !name.empty())) {
      folder.write(fence.language == "json" ? name : fence.language.substr(5), fence.text);
      if (fence.language == "json") name.clear();
    } else if (fence.language == "sh") {
      const process::Outcome outcome = process::shell(folder.path(), "set -e\n" + fence.text);
      EXPECT_EQ(outcome.code, 0) << page << ":\n" << fence.text << outcome.err;
      output = outcome.out;
      ++commands;
    } else if (fence.language == "text") {
      for (const auto& line : lines_of_output(fence.text))
        EXPECT_NE(output.find(line), std::string::npos) << page << " shows\n"
                                                        << line << "\nwhich is not in\n"
                                                        << output;
    }
  }
  return commands;
}

std::vector<std::string> commands_of(const std::string& page) {
  std::ifstream in(std::string(HYSTERON_SOURCE_DIR) + "/" + page);
  std::vector<std::string> commands;
  bool inside = false, goes_on = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      continue;
    }
    if (!inside && !line.starts_with("    ")) continue;
    line.erase(0, std::min(line.find_first_not_of(' '), line.size()));
    if (!goes_on && !line.starts_with("hysteron ")) continue;
    const bool continued = line.ends_with("\\");
    if (continued) line.pop_back();
    if (goes_on)
      commands.back() += line;
    else
      commands.push_back(line);
    goes_on = continued;
  }
  return commands;
}

std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words;
  std::string word;
  bool has_word = false;
  char quote = 0;
  const auto end_word = [&] {
    if (has_word) words.push_back(word);
    word.clear();
    has_word = false;
  };
  for (std::size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    if (quote == 0 && command.compare(i, 3, "   ") == 0) break;  // a remark beside the command
    if (quote != 0) {
      if (c == quote)
        quote = 0;
      else
        word += c;
    } else if (c == '"' || c == '\'') {
      quote = c;
      has_word = true;
    } else if (c == ' ') {
      end_word();
    } else if (c == '|' || c == ';' || c == '>' || c == '&' || (c == '#' && !has_word)) {
      break;
    } else {
      word += c;
      has_word = true;
    }
  }
  end_word();
  if (!words.empty()) words.erase(words.begin());
  return words;
}

}  // namespace hysteron::shown
