// Decides how tests run the built program: as a user would, in a folder of its own, with exit code and both streams
// kept.
#include "tests/app/hysteron_process.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace hysteron::process {
namespace {

namespace fs = std::filesystem;

std::string content_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void redirect(int stream, const char* file, int flags) {
  const int opened = open(file, flags, 0600);
  if (opened < 0 || dup2(opened, stream) < 0) _exit(126);
  close(opened);
}

/// Child process: streams and folder, then the program. Files instead of pipes: no reader that could block.
[[noreturn]] void become(const std::string& folder, const std::vector<std::string>& words, const std::string& out,
                         const std::string& err) {
  redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
  redirect(STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC);
  redirect(STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC);
  if (chdir(folder.c_str()) != 0) _exit(126);
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  _exit(127);
}

Outcome run(const std::string& folder, const std::vector<std::string>& words, const std::string& out_device,
            int interrupt_after_ms, int signal = SIGINT) {
  const Folder streams;
  const std::string out = out_device.empty() ? streams.path() + "/out" : out_device;
  const std::string err = streams.path() + "/err";
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) become(folder, words, out, err);
  if (interrupt_after_ms > 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(interrupt_after_ms));
    kill(child, signal);
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child) throw std::runtime_error("waitpid failed");
  Outcome outcome;
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (out_device.empty()) outcome.out = content_of(out);
  outcome.err = content_of(err);
  return outcome;
}

}  // namespace

Outcome hysteron(const std::string& folder, const std::vector<std::string>& words, const std::string& out_device,
                 int interrupt_after_ms) {
  std::vector<std::string> all{HYSTERON_PROGRAM};
  all.insert(all.end(), words.begin(), words.end());
  return run(folder, all, out_device, interrupt_after_ms);
}

Outcome hysteron_terminated(const std::string& folder, const std::vector<std::string>& words, int after_ms) {
  std::vector<std::string> all{HYSTERON_PROGRAM};
  all.insert(all.end(), words.begin(), words.end());
  return run(folder, all, "", after_ms, SIGTERM);
}

Outcome hysteron_killed(const std::string& folder, const std::vector<std::string>& words, int after_ms) {
  std::vector<std::string> all{HYSTERON_PROGRAM};
  all.insert(all.end(), words.begin(), words.end());
  return run(folder, all, "", after_ms, SIGKILL);
}

Outcome hysteron_terminated(const std::string& folder, const std::vector<std::string>& words) {
  std::vector<std::string> all{HYSTERON_PROGRAM};
  all.insert(all.end(), words.begin(), words.end());
  Outcome outcome;
  for (int milliseconds = 400; milliseconds < 20000; milliseconds *= 2) {
    outcome = run(folder, all, "", milliseconds, SIGTERM);
    if (outcome.code != 128 + SIGTERM) break;
  }
  return outcome;
}

Outcome shell(const std::string& folder, const std::string& command) {
  const std::string path = fs::path(HYSTERON_PROGRAM).parent_path().string();
  return run(folder, {"/bin/sh", "-c", "PATH=\"" + path + ":$PATH\"\n" + command}, "", 0);
}

Folder::Folder() {
  std::string name = (fs::temp_directory_path() / "hysteron-app-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
  path_ = name;
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string Folder::write(const std::string& name, const std::string& content) const {
  fs::create_directories(fs::path(path_ + "/" + name).parent_path());
  std::ofstream(path_ + "/" + name, std::ios::binary) << content;
  return name;
}

std::string Folder::read(const std::string& name) const { return content_of(path_ + "/" + name); }
bool Folder::has(const std::string& name) const { return fs::exists(path_ + "/" + name); }

std::vector<std::string> Folder::entries() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_))
    names.push_back(entry.path().filename().string() + (entry.is_directory() ? "/" : ""));
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace hysteron::process
