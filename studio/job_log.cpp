#include "studio/job_log.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace hysteron::studio {
namespace {

constexpr std::uintmax_t looked_at = 64 * 1024;  // [bytes]; a failure with twenty problems takes 10 kB

double number_or_unknown(const nlohmann::json& line, const char* name) {
  return line.contains(name) && line[name].is_number() ? line[name].get<double>() : -1;
}

}  // namespace

void LogTail::read(const std::string& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error || size == size_) return;
  size_ = size;
  std::ifstream stream(file, std::ios::binary);
  if (size > looked_at) stream.seekg(static_cast<std::streamoff>(size - looked_at));
  tail_.assign(std::istreambuf_iterator<char>(stream), {});
  constexpr char progress[] = "{\"fraction\"";
  for (auto at = tail_.rfind(progress); at != std::string::npos;
       at = at == 0 ? std::string::npos : tail_.rfind(progress, at - 1)) {
    const auto line = nlohmann::json::parse(tail_.substr(at, tail_.find('\n', at) - at), nullptr, false);
    if (!line.is_object()) continue;  // cut off in the middle of being written
    fraction_ = number_or_unknown(line, "fraction");
    seconds_left_ = number_or_unknown(line, "seconds_left");
    what_ = line.value("what", "");
    return;
  }
}

nlohmann::json LogTail::failure() const {
  const auto at = tail_.rfind("{\n \"exit_code\"");
  if (at == std::string::npos) return nullptr;
  const auto failure = nlohmann::json::parse(tail_.substr(at), nullptr, false);
  return failure.is_object() && failure.contains("problems") ? failure : nlohmann::json();
}

}  // namespace hysteron::studio
