#include "io/files/zip_archive.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "engine/diagram/error.h"
#include "io/files/atomic_file.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_parts = 10'000;

/// Where it would lie outside of a folder, or under another name on another system.
bool leads_out(const std::string& name) {
  if (name.empty() || name[0] == '/' || name.find('\\') != std::string::npos || name.find('\0') != std::string::npos ||
      (name.size() > 1 && name[1] == ':'))
    return true;
  const fs::path path(name);
  return std::any_of(path.begin(), path.end(), [](const fs::path& step) { return step == ".."; });
}

/// The archive says of what kind of file its part was made: only files and folders are taken.
bool is_link(zip_t* zip, zip_uint64_t index) {
  zip_uint8_t system = 0;
  zip_uint32_t attributes = 0;
  if (zip_file_get_external_attributes(zip, index, 0, &system, &attributes) != 0 || system != ZIP_OPSYS_UNIX)
    return false;
  constexpr zip_uint32_t kind_mask = 0170000, regular = 0100000, folder = 0040000;
  const zip_uint32_t kind = attributes >> 16 & kind_mask;
  return kind != 0 && kind != regular && kind != folder;
}

}  // namespace

ZipArchive::ZipArchive(std::string file, Kind kind) : file_(std::move(file)), kind_(std::move(kind)) {
  int code = 0;
  zip_ = zip_open(file_.c_str(), ZIP_RDONLY, &code);
  if (zip_ != nullptr) return;
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  const std::string why = zip_error_strerror(&error);
  zip_error_fini(&error);
  damaged("its zip archive is damaged: " + why);
}

ZipArchive::~ZipArchive() { zip_discard(zip_); }

void ZipArchive::damaged(const std::string& why) const {
  throw Error(Fault::input, {{"damaged_file", file_, fmt::format("this {} cannot be read: {}", kind_.name, why),
                              kind_.cure, file_, 0}});
}

bool ZipArchive::has(const std::string& name) const { return zip_name_locate(zip_, name.c_str(), 0) >= 0; }

std::vector<std::string> ZipArchive::names() const {
  std::vector<std::string> list;
  const zip_int64_t count = zip_get_num_entries(zip_, 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    const char* name = zip_get_name(zip_, static_cast<zip_uint64_t>(i), 0);
    if (name == nullptr) damaged("the name of a part cannot be read");
    list.emplace_back(name);
  }
  return list;
}

std::string ZipArchive::part(const std::string& name) const {
  zip_stat_t stat;
  if (zip_stat(zip_, name.c_str(), 0, &stat) != 0) damaged("it has no " + name);
  if (stat.size > kind_.largest_part)
    damaged(fmt::format("{} is larger than {} GB", name, static_cast<double>(kind_.largest_part >> 20) / 1024));
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> in(zip_fopen(zip_, name.c_str(), 0), zip_fclose);
  if (!in) damaged(name + " cannot be opened");
  std::string text(stat.size, '\0');
  if (zip_fread(in.get(), text.data(), text.size()) != static_cast<zip_int64_t>(text.size()))
    damaged(name + " is damaged");
  return text;
}

void ZipArchive::check_names() const {
  const auto all = names();
  if (all.size() > most_parts) damaged(fmt::format("it has {} parts", all.size()));
  std::set<std::string> seen;
  std::uint64_t whole = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string& name = all[i];
    if (leads_out(name)) damaged(fmt::format("its part \"{}\" would lie outside of the folder", name));
    if (is_link(zip_, i)) damaged(fmt::format("its part \"{}\" is no file but a link or a device", name));
    if (!seen.insert(fs::path(name).lexically_normal().generic_string()).second)
      damaged(fmt::format("its part \"{}\" is there twice", name));
    zip_stat_t stat;
    if (zip_stat_index(zip_, i, 0, &stat) != 0) damaged(name + " is damaged");
    if (stat.size > kind_.largest_part || (whole += stat.size) > kind_.largest_whole)
      damaged(fmt::format("unpacked it is larger than {} GB", static_cast<double>(kind_.largest_whole >> 20) / 1024));
  }
}

void ZipArchive::unpack(const std::string& folder) const {
  check_names();
  for (const auto& name : names()) {
    const fs::path place = fs::path(folder) / name;
    std::error_code code;
    fs::create_directories(name.ends_with('/') ? place : place.parent_path(), code);
    if (code) fail("cannot_write", place.string(), "the folder cannot be made: " + code.message(), "make room for it");
    if (!name.ends_with('/')) write_file(place.string(), part(name));
  }
}

std::string zipped(const std::vector<std::pair<std::string, std::string>>& parts) {
  const auto must = [](bool well) {
    if (!well) throw std::runtime_error("libzip cannot make an archive");
  };
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* buffer = zip_source_buffer_create(nullptr, 0, 0, &error);
  must(buffer != nullptr);
  zip_source_keep(buffer);
  const std::unique_ptr<zip_source_t, void (*)(zip_source_t*)> kept(buffer, zip_source_free);
  zip_t* archive = zip_open_from_source(buffer, ZIP_TRUNCATE, &error);
  must(archive != nullptr);
  for (const auto& [name, content] : parts) {
    zip_source_t* source = zip_source_buffer(archive, content.data(), content.size(), 0);
    const zip_int64_t index = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
    must(index >= 0);
    constexpr zip_uint16_t no_time = 0, first_of_1980 = 1 << 5 | 1;
    must(zip_file_set_dostime(archive, static_cast<zip_uint64_t>(index), no_time, first_of_1980, 0) == 0);
  }
  must(zip_close(archive) == 0 && zip_source_open(buffer) == 0);
  zip_stat_t stat;
  must(zip_source_stat(buffer, &stat) == 0);
  std::string bytes(stat.size, '\0');
  must(zip_source_read(buffer, bytes.data(), bytes.size()) == static_cast<zip_int64_t>(bytes.size()));
  zip_source_close(buffer);
  return bytes;
}

}  // namespace hysteron
