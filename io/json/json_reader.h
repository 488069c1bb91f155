// Decides how our files are walked: a cursor that knows its JSON pointer and notes what is wrong instead of stopping
// there. Does not know what the files mean. Every problem leaves with file and line.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/diagram/error.h"
#include "io/json/json_position.h"
#include "io/json/json_tree.h"

namespace hysteron {

class JsonPlace;

/// One JSON file while it is read, with the problems found in it so far. Must outlive its places.
class JsonFile {
 public:
  /// Throws Error "no_file", "is_directory", "not_a_file", "empty_file", "bad_json" (with line and column),
  /// "duplicate_key".
  explicit JsonFile(const std::string& file);
  JsonFile(const JsonFile&) = delete;
  JsonFile& operator=(const JsonFile&) = delete;

  JsonPlace root();
  const std::string& file() const { return file_; }
  int line(const std::string& pointer) const { return tree_.line(pointer); }
  bool has(const std::string& pointer) const { return tree_.at(pointer) != JsonTree::none; }
  const JsonTree& tree() const { return tree_; }

  /// Notes a problem at a pointer of this file.
  void add(std::string code, const std::string& pointer, std::string what, std::string cure);
  /// Takes over the problems of another file that this one names.
  void add(const Error& error);
  void throw_if_any() const;

 private:
  std::string file_;
  JsonTree tree_;
  std::vector<Problem> problems_;
};

/// A value in a file. What is wrong with it is noted in the file; the reads then return nothing.
class JsonPlace {
 public:
  /// `at`: in the file's tree.
  JsonPlace(JsonFile& file, JsonTree::Index at, std::string pointer)
      : file_(&file), at_(at), pointer_(std::move(pointer)) {}

  JsonFile& file() const { return *file_; }
  const std::string& pointer() const { return pointer_; }
  void add(std::string code, std::string what, std::string cure) const;

  bool is_object() const;
  bool is_array() const;
  bool is_text() const;
  bool is_number() const;
  bool is_null() const;

  /// These note "wrong_type" (and number() "bad_number") where the value is something else.
  std::optional<std::string> text() const;
  std::optional<double> number() const;
  std::optional<bool> truth() const;
  bool expect_object(const char* example) const;
  bool expect_array(const char* example) const;

  std::optional<JsonPlace> find(const std::string& key) const;  ///< nothing if there is no such key
  std::optional<JsonPlace> need(const std::string& key, const std::string& cure) const;  ///< notes "missing_key"
  /// Notes "unknown_key" for every key of this object that is not among the known ones.
  void only(const std::vector<std::string>& known) const;

  std::vector<std::pair<std::string, JsonPlace>> members() const;  ///< of an object, in the order of the file
  std::vector<JsonPlace> elements() const;                         ///< of a list
  std::size_t size() const { return file_->tree().size(at_); }     ///< how many of either

  std::string found() const;  ///< what stands here, for messages: "text \"abc\"", "the number 5", "a list"
  void add_wrong_type(const std::string& expected) const;

 private:
  JsonTree::Kind kind() const { return file_->tree().kind(at_); }

  JsonFile* file_;
  JsonTree::Index at_;
  std::string pointer_;
};

/// Optional members that are plain text or numbers; wrong types are noted.
std::string text_member(const JsonPlace& object, const std::string& key);
std::optional<double> number_member(const JsonPlace& object, const std::string& key);

/// Checks "format": 1. Throws at once for a newer one, since nothing else in such a file can be judged.
void check_format(const JsonPlace& root, const std::string& kind);

/// Names of inputs and outputs may hold capital letters: they are those of measured columns (T, F1).
enum class Capitals { none, allowed };
/// Names of blocks, parameters, runs ... match [a-z][a-z0-9_]*; notes "bad_name".
bool check_name(const JsonPlace& place, const std::string& name, const std::string& kind,
                Capitals capitals = Capitals::none);

}  // namespace hysteron
