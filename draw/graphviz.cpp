#include "draw/graphviz.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <sstream>
#include <utility>

#include "engine/diagram/error.h"

extern char** environ;

namespace hysteron::draw {
namespace {

constexpr double per_inch = 72;  // dot speaks inches

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// A file without a name: dot reads from it and writes to it, so that no pipe can fill up and nothing stays behind.
File scratch() {
  File file(std::tmpfile(), std::fclose);
  if (!file)
    fail("cannot_write", "temporary file", std::string("a temporary file cannot be made: ") + std::strerror(errno),
         "make room in the folder for temporary files");
  return file;
}

std::string content(std::FILE* file) {
  std::string text;
  std::rewind(file);
  char buffer[65536];
  for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, file)) > 0;) text.append(buffer, n);
  return text;
}

[[noreturn]] void no_dot(const std::string& reason) {
  fail("no_graphviz", "dot",
       "the program dot of Graphviz, which orders the blocks of a picture, cannot be run: " + reason,
       "install Graphviz (Debian: apt install graphviz) so that \"dot -V\" works in this terminal");
}

std::string ask_dot(const std::string& graph) {
  const File in = scratch(), out = scratch(), complaints = scratch();
  std::fwrite(graph.data(), 1, graph.size(), in.get());
  std::fflush(in.get());
  std::rewind(in.get());
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(in.get()), 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(out.get()), 1);
  posix_spawn_file_actions_adddup2(&actions, fileno(complaints.get()), 2);
  char name[] = "dot", form[] = "-Tplain";
  char* const words[] = {name, form, nullptr};
  pid_t child = 0;
  const int code = posix_spawnp(&child, name, &actions, nullptr, words, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (code != 0) no_dot(std::strerror(code));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) no_dot("not found");
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    fail("graphviz_failed", "dot", "dot of Graphviz refused to order the blocks: " + content(complaints.get()),
         "check it with \"dot -V\"; any version from 2.30 will do");
  return content(out.get());
}

/// What dot answered, by what it was asked: most edits of a diagram ask the same as the one before, and so do nested
/// diagrams of one file. The answer follows from the question alone.
class Answers {
 public:
  std::optional<std::vector<double>> find(const std::string& graph) {
    const std::lock_guard lock(mutex_);
    for (auto i = list_.begin(); i != list_.end(); ++i)
      if (i->graph == graph) {
        list_.splice(list_.begin(), list_, i);
        return i->heights;
      }
    return {};
  }
  void add(const std::string& graph, const std::vector<double>& heights) {
    const std::lock_guard lock(mutex_);
    list_.push_front({graph, heights});
    if (list_.size() > most_) list_.pop_back();
  }

 private:
  struct Answer {
    std::string graph;
    std::vector<double> heights;
  };
  static constexpr std::size_t most_ = 32;  // a graph of 1000 blocks is 0.1 MB
  std::mutex mutex_;
  std::list<Answer> list_;  // the last one asked for first
};

Answers& answers() {
  static Answers all;
  return all;
}

}  // namespace

std::vector<double> heights_by_dot(const std::vector<double>& cell_heights, const std::vector<DotEdge>& edges) {
  std::string graph =
      "digraph { rankdir=LR; splines=false; nodesep=0.25; ranksep=0.5; node [shape=box, fixedsize=true, width=0.4, "
      "label=\"\"];\n";
  for (std::size_t i = 0; i < cell_heights.size(); ++i)
    graph += fmt::format("c{} [height={:.4f}];\n", i, cell_heights[i] / per_inch);
  for (const auto& edge : edges) graph += fmt::format("c{} -> c{} [weight={}];\n", edge.from, edge.to, edge.weight);
  graph += "}\n";

  if (auto known = answers().find(graph)) return std::move(*known);

  // "node c3 x y width height ...", y upwards in inches.
  std::vector<double> heights(cell_heights.size(), 0);
  std::istringstream lines(ask_dot(graph));
  std::size_t found = 0;
  for (std::string line; std::getline(lines, line);) {
    std::size_t cell = 0;
    double x = 0, y = 0;
    if (std::sscanf(line.c_str(), "node c%zu %lf %lf", &cell, &x, &y) != 3 || cell >= heights.size()) continue;
    heights[cell] = -y * per_inch;
    ++found;
  }
  if (found != heights.size())
    fail("graphviz_failed", "dot", fmt::format("dot of Graphviz placed {} of {} blocks", found, heights.size()),
         "check it with \"dot -V\"; any version from 2.30 will do");
  answers().add(graph, heights);
  return heights;
}

}  // namespace hysteron::draw
