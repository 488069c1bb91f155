// Decides how another program is run: by its words, never through a shell.
// Files without a name take its streams, so that no pipe can fill up.
#include "app/cluster/child_process.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "engine/diagram/error.h"

extern char** environ;

namespace hysteron {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

[[noreturn]] void cannot_start(const std::string& program, int error) {
  fail("cannot_start", program, program + " cannot be started: " + std::strerror(error),
       "make room in the folder for temporary files, and look whether the machine is short of memory or processes");
}

File scratch(const std::string& program) {
  File file(std::tmpfile(), std::fclose);
  if (!file) cannot_start(program, errno);
  return file;
}

std::string content(std::FILE* file) {
  std::string text;
  std::rewind(file);
  char buffer[4096];
  for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, file)) > 0;) text.append(buffer, n);
  return text;
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

ChildOutcome run_child(const std::vector<std::string>& words, const std::string& folder) {
  const std::string& program = words.front();
  const File out = scratch(program), err = scratch(program);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", 0, 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(out.get()), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(err.get()), STDERR_FILENO);
  if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ChildOutcome outcome;
  if (error == ENOENT || error == EACCES) {
    outcome.found = false;
    return outcome;
  }
  if (error != 0) cannot_start(program, error);
  outcome.code = wait_for(child);
  outcome.out = content(out.get());
  outcome.err = content(err.get());
  return outcome;
}

}  // namespace hysteron
