#include "io/fmi/imported_fmu.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>

#include "engine/diagram/error.h"
#include "io/files/zip_archive.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

constexpr char description_name[] = "modelDescription.xml";

ZipArchive::Kind fmu_kind() { return {"FMU", "export it again"}; }

[[noreturn]] void refuse(const std::string& file, const std::string& what, const std::string& cure) {
  throw Error(Fault::input, {{"bad_fmu", file, what, cure, file, 0}});
}

/// FMUs unpacked by this process, each once; they go away at its end.
class Unpacked {
 public:
  ~Unpacked() {
    std::error_code ignored;
    for (const auto& [file, folder] : folders_) fs::remove_all(folder, ignored);
  }

  std::string folder_of(const std::string& file, const ZipArchive& archive) {
    const std::lock_guard lock(mutex_);
    const std::string identity =
        fmt::format("{} {}", fs::canonical(file).string(), fs::last_write_time(file).time_since_epoch().count());
    if (const auto known = folders_.find(identity); known != folders_.end()) return known->second;
    std::string name = (fs::temp_directory_path() / "hysteron-fmu-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      fail("cannot_write", name, "no folder can be made to unpack an FMU", "set TMPDIR to a folder with room");
    try {
      archive.unpack(name);
    } catch (...) {  // half of it is no FMU: the next one who asks begins anew
      std::error_code ignored;
      fs::remove_all(name, ignored);
      throw;
    }
    folders_.emplace(identity, name);
    return name;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::string> folders_;
};

Unpacked& unpacked() {
  static Unpacked all;
  return all;
}

/// A name that diagrams can write: "stage_displacement" of "stage.displacement".
std::string port_name(const std::string& name, std::set<std::string>& taken) {
  std::string port;
  for (const char c : name) {
    const bool fits = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (fits)
      port += c;
    else if (!port.ends_with('_') && !port.empty())
      port += '_';
  }
  while (port.ends_with('_')) port.pop_back();
  if (port.empty() || (port[0] >= '0' && port[0] <= '9')) port = "v" + port;
  std::string unique = port;
  for (int k = 2; !taken.insert(unique).second; ++k) unique = fmt::format("{}_{}", port, k);
  return unique;
}

class Importer {
 public:
  Importer(const FmiDescription& d, ForeignInterface& into) : into_(into) {
    for (const auto& unit : d.units) units_[unit.name] = &unit;
  }

  void take(const FmiScalar& v) {
    const bool number = v.type == "Real" && !v.is_array;
    if (v.causality == "input") {
      if (!number)
        refuse(into_.file,
               fmt::format("its input \"{}\" is {}, and signals of a diagram are real numbers", v.name,
                           v.is_array ? "an array" : "of type " + v.type),
               "have it exported with real inputs");
      into_.inputs.push_back(variable(v, ports_));
    } else if (v.causality == "output" && number) {
      into_.outputs.push_back(variable(v, ports_));
    } else if (v.causality == "parameter" && number) {
      into_.parameters.push_back(variable(v, parameters_));
    }
  }

 private:
  ForeignVariable variable(const FmiScalar& v, std::set<std::string>& taken) const {
    ForeignVariable f{port_name(v.name, taken), v.reference};
    const Unit unit = unit_of(v.unit);
    f.unit = si_unit(unit.dimension).text;
    f.scale = unit.scale;
    f.offset = v.relative ? 0 : unit.offset;
    return f;
  }

  /// As it defines it; else what the name means here; else a plain number.
  Unit unit_of(const std::string& name) const {
    const auto known = units_.find(name);
    if (known != units_.end() && known->second->unit) return *known->second->unit;
    try {
      return name.empty() ? Unit{} : parse_unit(name);
    } catch (const Error&) {
      return {};
    }
  }

  ForeignInterface& into_;
  std::map<std::string, const FmiUnit*> units_;
  std::set<std::string> ports_, parameters_{"file", "interface", "period", "offset", "type", "in"};
};

}  // namespace

LookedThrough look_through_fmu(const std::string& file) {
  const ZipArchive archive(file, fmu_kind());
  archive.check_names();
  LookedThrough looked{read_fmi_description(archive.part(description_name), file), {}};
  looked.faults = fmi_description_faults(looked.description);
  const auto names = archive.names();
  const bool has_binary = std::any_of(names.begin(), names.end(), [](const std::string& name) {
    return name.starts_with("binaries/") && !name.ends_with('/');
  });
  if (!has_binary) looked.faults.emplace_back("there is no binary in it");
  if (has_binary && !looked.description.identifier.empty() && !archive.has(fmi_binary_name(looked.description)))
    looked.faults.push_back(fmi_binary_name(looked.description) + ", the binary for this machine, is missing");
  return looked;
}

ForeignInterface interface_of(const FmiDescription& d, const std::string& written) {
  ForeignInterface interface;
  interface.file = written;
  interface.version = d.version;
  interface.token = d.token;
  Importer importer(d, interface);
  for (const auto& v : d.variables) importer.take(v);
  return interface;
}

ForeignInterface imported_fmu(const std::string& file, const std::string& written, bool trusted) {
  const ZipArchive archive(file, fmu_kind());
  const FmiDescription d = read_fmi_description(archive.part(description_name), file);
  if (d.identifier.empty())
    refuse(file, "it offers no co-simulation, and a block of a diagram is one", "have it exported for co-simulation");
  if (d.needs_tool) refuse(file, "it needs the tool that made it", "have it exported so that it runs by itself");
  if (!archive.has(fmi_binary_name(d)))
    refuse(file, fmt::format("it has no {}, the binary for this machine", fmi_binary_name(d)),
           "have it exported for x86-64 Linux");
  ForeignInterface interface = interface_of(d, written);
  if (trusted) {
    const fs::path folder = unpacked().folder_of(file, archive);
    interface.binary = (folder / fmi_binary_name(d)).string();
    interface.resources = (folder / "resources").string();
  }
  return interface;
}

}  // namespace hysteron
