// Decides how a verb reads what was written behind it. Does not parse the command line (command_line.cpp).
#pragma once

#include <map>
#include <string>
#include <vector>

namespace hysteron {

/// What the user wrote behind a verb.
class Arguments {
 public:
  bool has(const std::string& name) const { return given_.contains(name); }
  /// The value of an option, or `otherwise`.
  std::string text(const std::string& name, const std::string& otherwise = "") const;
  std::vector<std::string> list(const std::string& name) const;
  /// The value of an option as a plain number. Throws Error "bad_command_line".
  double number(const std::string& name, double otherwise) const;
  /// A whole number from 1 to `most`.
  int whole_number(const std::string& name, int otherwise, int most = 100'000) const;
  /// The value of an option as a time in s ("2 s", "5 ms", "3"). Throws Error "bad_command_line".
  double seconds(const std::string& name, double otherwise) const;
  int threads() const;  ///< of --threads; one per core if it is not given
  bool quiet() const { return has("--quiet"); }
  bool json() const { return has("--json"); }
  void set(const std::string& name, std::vector<std::string> values) { given_[name] = std::move(values); }

 private:
  std::map<std::string, std::vector<std::string>> given_;
};

}  // namespace hysteron
