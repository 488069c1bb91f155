// Decides how zip archives are read from strangers and written for them: whole parts in memory, never a path outside of
// the folder, a link, or more than an archive of its kind can need. Does not know what the parts mean.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

struct zip;

namespace hysteron {

class ZipArchive {
 public:
  /// What a user calls such a file, and what to do where it is damaged: {"workbook", "save it again"}.
  struct Kind {
    std::string name, cure;
    std::uint64_t largest_part = 1ULL << 30;   ///< [byte] unpacked: more is an archive made to fill the memory
    std::uint64_t largest_whole = 4ULL << 30;  ///< [byte] of all parts, where all are unpacked
  };

  /// Throws Error "damaged_file".
  ZipArchive(std::string file, Kind kind);
  ~ZipArchive();
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  const std::string& file() const { return file_; }
  bool has(const std::string& name) const;
  std::vector<std::string> names() const;  ///< of all parts, folders among them ("resources/")
  /// Throws Error "damaged_file" where it is not there, too large or damaged.
  std::string part(const std::string& name) const;
  /// Throws what unpack() would throw because of names and sizes.
  void check_names() const;
  /// Writes all parts below a folder that is there. Throws Error "damaged_file" and writes nothing where a name leads
  /// out of it, is there twice, is a link, or all of them are too large.
  void unpack(const std::string& folder) const;
  [[noreturn]] void damaged(const std::string& why) const;

 private:
  std::string file_;
  Kind kind_;
  zip* zip_ = nullptr;
};

/// An archive of these parts (name, content), the same bytes whenever it is made. Throws std::runtime_error.
std::string zipped(const std::vector<std::pair<std::string, std::string>>& parts);

}  // namespace hysteron
