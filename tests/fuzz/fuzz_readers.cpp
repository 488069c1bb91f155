// Decides how readers are tried with files that no instrument wrote: good files are damaged, and what reaches code that
// was not reached before is damaged further. A reader may read, or throw Error with cause and cure; all else is a
// finding.
//
//   fuzz_readers [FORMAT ...] [--executions N] [--seconds S] [--seed K] [--folder F]
//
// The same formats, seed and number of executions try the same files. What ends the program is in F/FORMAT.input.
#include <fmt/format.h>
#include <sanitizer/common_interface_defs.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <new>

#include "engine/diagram/error.h"
#include "io/data/binary_table.h"
#include "io/data/dataset.h"
#include "io/data/recording_file.h"
#include "io/diagram/diagram_file.h"
#include "io/files/zip_archive.h"
#include "io/jobs/runs_job.h"
#include "io/jobs/study_job.h"
#include "tests/fuzz/mutate.h"
#include "tests/io/formats/instrument_files.h"
#include "tests/io/temporary_folder.h"

namespace {

// What files of HDF5 and MATLAB reach and break is in a child process (io/files/child_read.h), which shares this.
struct Shared {
  std::array<unsigned char, 1U << 16U> reached;  // one flag for each place in the code of io, by its address
  std::size_t newly_reached;
  bool found;  // by a sanitizer
};
Shared of_one_process;
Shared* shared = &of_one_process;

void share_with_children() {
  void* const memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  shared = new (memory) Shared{};
  __sanitizer_set_death_callback([] { shared->found = true; });
  // The child has no standard error, since libraries write there when they break.
  __sanitizer_set_report_fd(reinterpret_cast<void*>(static_cast<std::intptr_t>(dup(STDERR_FILENO))));
}

constexpr int longest_seconds = 20;  // of the processor, for one file; sanitizers take ten times as long as the program

char message_of_hang[512];

}  // namespace

extern "C" {
void __sanitizer_cov_trace_pc() {
  extern const char __executable_start;
  const auto place = static_cast<const char*>(__builtin_return_address(0)) - &__executable_start;
  unsigned char& flag = shared->reached[static_cast<std::size_t>(place * 0x9E3779B97F4A7C15ULL >> 48U)];
  shared->newly_reached += flag == 0;
  flag = 1;
}
// More memory than this for files of some 10 kB is a finding: what is new'ed ends the process. HDF5, which believes
// what a damaged file says of its sizes, is told that there is none, as the limit of its process tells it, and leaves
// its own tables to the end.
const char* __asan_default_options() {
  return "max_allocation_size_mb=1000:hard_rss_limit_mb=4000:allocator_may_return_null=1:detect_leaks=0";
}
// Known of HDF5 1.10: a chunk that unpacks to fewer bytes than the layout of its dataset says is read beyond its end
// (H5VM_memcpyvv in H5Dread). It cannot be seen from outside before it happens.
const char* __asan_default_suppressions() { return "interceptor_via_lib:libhdf5\n"; }
}

namespace hysteron::fuzz {
namespace {

constexpr std::size_t longest_file = 1U << 16U;  // [byte]

struct Format {
  std::string name, file;  ///< how a file of it is called
  std::vector<std::string> seeds;
  std::vector<std::string> words;
  std::function<void(const std::string&)> read;
  /// Where a checksum or a length would tell every damage: damages what stands behind it. Takes a file, and the name of
  /// one that it may write.
  std::function<std::string(const std::string&, Mutator&, const std::string&)> damaged_inside = nullptr;
};

const std::vector<std::string> words_of_text{",",        ";",
                                             "\t",       "\n",
                                             "\r\n",     "\"",
                                             "1e308",    "-1e-320",
                                             "nan",      "OL",
                                             "1,5",      "0x10",
                                             "[V]",      "(mm)",
                                             "t [s]",    "Zeit",
                                             "\xff\xfe", "#",
                                             "12:00",    "2024-05-02T09:10:11",
                                             "/ V",      "\xef\xbb\xbf",
                                             "-0",       "+",
                                             "1e"};
const std::vector<std::string> words_of_json{
    "{",       "}",          "[",       "]",       "\"", ":",  ",",        "null",   "true", "1e999",   "-1",
    "\"1 V\"", "\"1e30 s\"", "\\u0000", "\\ud800", "//", "$x", "\"from\"", "\"in\"", "[[[[", "\"file\""};

/// Workbooks are archives with checksums: their parts are damaged, and packed anew.
std::string repacked(const std::string& archive, Mutator& mutator, const std::string& file) {
  std::ofstream(file, std::ios::binary) << archive;
  std::vector<std::pair<std::string, std::string>> parts;
  try {
    const ZipArchive zip(file, {"workbook", "none", longest_file, 4 * longest_file});
    for (const auto& name : zip.names()) parts.emplace_back(name, zip.part(name));
  } catch (const Error&) {
  }
  if (parts.empty()) return archive;
  auto& [name, content] = parts[mutator.pick(parts.size())];
  content = mutator.mutated(content, parts[mutator.pick(parts.size())].second, longest_file);
  return zipped(parts);
}

/// A table of numbers says in its first line how long it is and where its columns begin: that line is damaged, and
/// padded with blanks to its length where it can be.
std::string damaged_head(const std::string& table, Mutator& mutator, const std::string& /*file*/) {
  const auto size = std::min(table.find('\n'), table.size());
  std::string head = mutator.mutated(table.substr(0, size), table.substr(0, size), longest_file);
  while (head.size() > size && head.back() == ' ') head.pop_back();
  head.resize(std::max(head.size(), size), ' ');
  return head + table.substr(size);
}

void read_as_recording(const std::string& file) { read_measured_recording(file, 2, {}); }

void add_formats_of_instruments(std::vector<Format>& formats) {
  const auto is = [](const std::string& name, const char* end) { return name.ends_with(end); };
  Format csv{"csv", "x.csv", {}, words_of_text, read_as_recording},
      lvm{"lvm", "x.lvm", {}, words_of_text, read_as_recording};
  Format xlsx{"xlsx",
              "x.xlsx",
              {},
              {"<c r=\"A1\">", "<v>", "</v>", "<row>", "t=\"s\"", "&#0;", "1e308", "XFD1048576", "<!--", "r=\"A1\""},
              read_as_recording,
              repacked};
  Format mat5{"mat5", "x.mat", {}, {}, read_as_recording}, mat73{"mat73", "x.mat", {}, {}, read_as_recording};
  Format hdf5{"hdf5", "x.h5", {}, {}, read_as_recording},
      tdms{"tdms", "x.tdms", {}, {"TDSm", "NI_Scale[0]_Scale_Type", "wf_increment"}, read_as_recording};
  for (const auto& file : instruments::all_files()) {
    const bool head73 = file.bytes.starts_with("MATLAB 7.3");
    Format& of = is(file.name, ".lvm")    ? lvm
                 : is(file.name, ".xlsx") ? xlsx
                 : is(file.name, ".h5")   ? hdf5
                 : is(file.name, ".tdms") ? tdms
                 : is(file.name, ".mat")  ? (head73 ? mat73 : mat5)
                                          : csv;
    of.seeds.push_back(file.bytes);
  }
  mat5.seeds.push_back(instruments::mat_of_two_groups());
  for (const auto* kind : {"Linear", "Polynomial", "Table", "Add", "RTD"})
    tdms.seeds.push_back(instruments::tdms_of_scaling(kind));
  for (auto* format : {&csv, &lvm, &xlsx, &mat5, &mat73, &hdf5, &tdms}) formats.push_back(std::move(*format));
}

/// Files of the project itself, the small ones.
std::vector<std::string> files_below(const std::string& folder, const std::function<bool(const std::string&)>& wanted) {
  std::vector<std::string> files, texts;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(HYSTERON_SOURCE_DIR + ("/" + folder)))
    if (entry.path().extension() == ".json" && entry.file_size() < 12'000) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files)
    if (std::string text = TemporaryFolder::read(file); wanted(text)) texts.push_back(std::move(text));
  return texts;
}

/// One of three rows, and one whose pyramid has a level.
std::vector<std::string> tables_of_numbers() {
  const TemporaryFolder folder;
  std::vector<std::string> tables;
  for (const int rows : {3, 200}) {
    std::string text = "t [s],u [V]\n";
    for (int row = 0; row < rows; ++row) text += fmt::format("{},{}\n", row, row % 7);
    write_binary_table(folder.path("x.f64"), read_csv(folder.write("a.csv", text)));
    tables.push_back(TemporaryFolder::read(folder.path("x.f64")));
  }
  return tables;
}

/// As a reader that zooms, then as a recording, of which digests are asked for.
void read_as_table_of_numbers(const std::string& file) {
  BinaryTable table(file);
  for (std::size_t column = 0; column < table.columns().size(); ++column)
    for (const std::size_t most : {1, 3, 1000}) table.envelope(column, 1, table.rows(), most);
  read_recording_file(file, 2);
}

// A recording that stands beside what is tried, and a data set that is read to its end.
constexpr char beside[] = "beside.csv";
constexpr char recording_beside[] = "t [s],u [V],y [um]\n0,0,0\n1,1,2\n2,2,4\n3,1,2\n4,0,0\n5,1,2\n6,2,4\n7,1,2\n";
constexpr char data_set_of_beside[] = R"({"format": 1, "title": "t",
 "columns": {"u": {"between_samples": "hold"}, "y": {"to": "z", "noise": {"white": "2 nm"}, "zero": "per_recording"}},
 "recordings": [{"file": "beside.csv", "role": "train", "until": "4 s", "skip": "1 s"},
  {"file": "beside.csv", "role": "validate", "start": "1 s", "weight": 2}]})";

std::vector<Format> all_formats() {
  std::vector<Format> formats;
  add_formats_of_instruments(formats);
  const auto has = [](const char* word) {
    return [word](const std::string& text) { return text.find(word) != text.npos; };
  };
  formats.push_back({"diagram", "x.json", files_below("diagrams", has("\"blocks\"")), words_of_json,
                     [](const std::string& file) { diagram_text(read_diagram(file)); }});
  std::vector<std::string> data_sets = files_below("diagrams", has("\"recordings\""));
  data_sets.push_back(data_set_of_beside);
  formats.push_back(
      {"dataset", "x.json", data_sets, words_of_json, [](const std::string& file) { read_dataset(file); }});
  formats.push_back({"runs", "x.json", files_below("diagrams", has("\"do\": \"runs\"")), words_of_json,
                     [](const std::string& file) { read_runs_job(file); }});
  formats.push_back({"study", "x.json", files_below("diagrams", has("\"do\": \"study\"")), words_of_json,
                     [](const std::string& file) { read_study_job(file); }});
  formats.push_back({"f64", "x.f64", tables_of_numbers(), words_of_json, read_as_table_of_numbers, damaged_head});
  return formats;
}

[[noreturn]] void found(const std::string& what, const std::string& file) {
  std::fprintf(stderr, "%s\n  by %s\n", what.c_str(), file.c_str());
  std::abort();
}

/// Returns whether the file was read.
bool execute(const Format& format, const std::string& file) {
  const itimerval most{{0, 0}, {longest_seconds, 0}}, none{};
  setitimer(ITIMER_PROF, &most, nullptr);
  bool read = true;
  try {
    format.read(file);
  } catch (const Error& error) {
    read = false;
    if (error.problems.empty()) found("an Error without a problem", file);
    for (const auto& p : error.problems)
      if (p.code.empty() || p.what.empty() || p.cure.empty())
        found("a problem without code, cause or cure: " + p.what, file);
  } catch (const std::exception& error) {
    found(std::string("an exception that is no Error: ") + error.what(), file);
  }
  setitimer(ITIMER_PROF, &none, nullptr);
  if (shared->found) found("a sanitizer ended the child that read", file);
  return read;
}

struct Options {
  std::vector<std::string> formats;
  std::size_t executions = 2000;
  double seconds = 0;  ///< above 0: as long as this instead
  std::uint64_t seed = 1;
  std::string folder;
};

void fuzz(const Format& format, const Options& options) {
  const std::string file = options.folder + "/" + format.name + ".input." + format.file;
  const std::string message = "longer than " + std::to_string(longest_seconds) + " s: " + file + "\n";
  message.copy(message_of_hang, sizeof message_of_hang - 1);
  message_of_hang[std::min(message.size(), sizeof message_of_hang - 1)] = '\0';
  Mutator mutator(options.seed, format.words);
  std::vector<std::string> corpus = format.seeds;
  std::size_t executions = 0, were_read = 0;
  const auto begin = std::chrono::steady_clock::now();
  const auto try_one = [&](const std::string& bytes) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
    shared->newly_reached = 0;
    were_read += execute(format, file);
    ++executions;
  };
  shared->reached.fill(0);
  for (const auto& seed : format.seeds) try_one(seed);
  if (were_read == 0) found("no good file of " + format.name + " was read", file);
  const auto ended = [&] {
    if (options.seconds <= 0) return executions >= options.executions;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() > options.seconds;
  };
  while (!ended()) {
    const std::string &one = corpus[mutator.pick(corpus.size())], &other = corpus[mutator.pick(corpus.size())];
    const bool inside = format.damaged_inside && mutator.pick(4) != 0;
    std::string bytes = inside ? format.damaged_inside(one, mutator, file) : mutator.mutated(one, other, longest_file);
    try_one(bytes);
    if (shared->newly_reached > 0) corpus.push_back(std::move(bytes));
  }
  std::filesystem::remove(file);
  fmt::print("{:8} {:8} executions, {:7} read, {:3} seeds, {:5} kept for new code, {:5} places reached\n", format.name,
             executions, were_read, format.seeds.size(), corpus.size() - format.seeds.size(),
             std::count(shared->reached.begin(), shared->reached.end(), 1));
  std::fflush(stdout);
}

Options options_of(int count, char** words) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (!word.starts_with("--")) {
      options.formats.push_back(word);
      continue;
    }
    const std::string value = ++i < count ? words[i] : "";
    if (word == "--executions")
      options.executions = std::stoul(value);
    else if (word == "--seconds")
      options.seconds = std::stod(value);
    else if (word == "--seed")
      options.seed = std::stoull(value);
    else if (word == "--folder")
      options.folder = value;
    else
      throw std::invalid_argument(word + " is no option: --executions, --seconds, --seed, --folder");
  }
  return options;
}

int run(int count, char** words) {
  Options options = options_of(count, words);
  share_with_children();
  const TemporaryFolder own;
  if (options.folder.empty()) options.folder = own.path();
  std::filesystem::create_directories(options.folder);
  std::ofstream(options.folder + "/" + beside) << recording_beside;
  signal(SIGPROF, [](int) {
    [[maybe_unused]] const auto ignored = write(2, message_of_hang, std::char_traits<char>::length(message_of_hang));
    abort();
  });
  std::size_t tried = 0;
  for (const auto& format : all_formats()) {
    const auto& asked = options.formats;
    if (!asked.empty() && std::find(asked.begin(), asked.end(), format.name) == asked.end()) continue;
    if (format.seeds.empty()) found("no good file of " + format.name, "all_formats()");
    fuzz(format, options);
    ++tried;
  }
  if (tried == 0 || tried < options.formats.size()) throw std::invalid_argument("no such format");
  return 0;
}

}  // namespace
}  // namespace hysteron::fuzz

int main(int count, char** words) {
  try {
    return hysteron::fuzz::run(count, words);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
