#include "studio/child.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "engine/diagram/error.h"

extern char** environ;

namespace hysteron::studio {
namespace {

/// State and start time of a process, from /proc/PID/stat: behind the name, which may hold blanks and brackets.
bool read_stat(pid_t pid, char& state, unsigned long long& started) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  if (!std::getline(file, line)) return false;
  const auto name_end = line.rfind(')');
  if (name_end == std::string::npos) return false;
  std::istringstream rest(line.substr(name_end + 1));
  rest >> state;
  std::string skipped;
  constexpr int fields_between = 18;  // from "ppid" to "itrealvalue" (proc(5))
  for (int i = 0; i < fields_between; ++i) rest >> skipped;
  return static_cast<bool>(rest >> started);
}

}  // namespace

Child start_child(const std::vector<std::string>& words, const std::string& folder, const std::string& out,
                  const std::string& err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  Child child;
  const int error = posix_spawn(&child.pid, words.front().c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    fail("cannot_start", words.front(), words.front() + " cannot be started: " + std::strerror(error),
         "look whether the machine is short of memory or processes");
  char state = 0;
  read_stat(child.pid, state, child.started);
  return child;
}

bool is_alive(const Child& child) {
  char state = 0;
  unsigned long long started = 0;
  return child.pid > 0 && read_stat(child.pid, state, started) && state != 'Z' &&
         (child.started == 0 || started == child.started);
}

void signal_child(const Child& child, int signal) {
  if (is_alive(child)) kill(child.pid, signal);
}

std::optional<int> exit_code_of(const Child& child) {
  int status = 0;
  if (waitpid(child.pid, &status, WNOHANG) != child.pid) return {};
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace hysteron::studio
