#include "studio/studio.h"

#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "engine/diagram/error.h"
#include "io/files/atomic_file.h"
#include "studio/child.h"
#include "studio/guard.h"
#include "studio/http_server.h"
#include "studio/page_files.h"

namespace hysteron::studio {
namespace {

namespace fs = std::filesystem;

HttpReply page_reply(const std::string& path) {
  const std::string wanted = path == "/" ? "/index.html" : path;
  for (const auto& file : page_files())
    if (file.path == wanted) return {200, std::string(file.type), std::string(file.content), {}, {}};
  return {404, "text/plain; charset=utf-8", "no such page\n", {}, {}};
}

HttpReply answered(const HttpRequest& request, Api& api, const Guard& guard) {
  const bool is_api = request.path.starts_with("/api/");
  HttpReply reply;
  if (auto refusal = refused(request, guard, is_api))
    reply = std::move(*refusal);
  else if (is_api)
    reply = api.answer(request);
  else
    reply = request.path.starts_with("/open/") ? api.opened(request) : page_reply(request.path);
  if (reply.headers.empty()) add_safety_headers(reply);
  return reply;
}

/// A file that only this user can read from its first byte on.
void write_secret(const std::string& file, const std::string& content) {
  const mode_t before = umask(0077);
  try {
    std::error_code error;
    fs::remove(file, error);  // one that is replaced would hand on its rights
    write_file(file, content);
  } catch (...) {
    umask(before);
    throw;
  }
  umask(before);
}

/// A browser is not given the address as a word: every user of the machine can read the words of a process. It is given
/// a file that leads there.
void open_browser(const std::string& file, const std::string& folder) {
  for (const char* opener : {"/usr/bin/xdg-open", "/usr/bin/open"}) {
    if (access(opener, X_OK) != 0) continue;
    start_child({opener, file}, folder, "/dev/null", "/dev/null");
    return;
  }
}

}  // namespace

std::string serve(const StudioSettings& settings, const std::function<void(const std::string& address)>& ready,
                  const std::function<bool()>& stop) {
  if (page_files().empty())
    fail("no_page", "studio", "this hysteron was built without the page of its studio",
         "install npm (Debian: apt install npm) and build again");
  const OpenFolder folder(settings.folder);
  Guard guard{0, new_token()};
  Api api(folder, settings.api);
  HttpServer server([&](const HttpRequest& request) { return answered(request, api, guard); });
  guard.port = server.bind(settings.port);
  const std::string address = "http://127.0.0.1:" + std::to_string(guard.port) + "/#token=" + guard.token;
  const std::string own = folder.path() + "/.hysteron";
  fs::create_directories(own);
  const std::string told = own + "/studio.json", leads_there = own + "/open.html";
  write_secret(told, nlohmann::json{{"address", address}, {"process", getpid()}}.dump() + "\n");
  write_secret(leads_there, "<!doctype html><meta http-equiv=\"refresh\" content=\"0; url=" + address + "\">\n");
  std::thread answering([&] { server.serve(); });
  ready(address);
  if (settings.opens_browser) open_browser(leads_there, own);
  while (!stop()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  server.stop();
  answering.join();
  std::error_code error;
  fs::remove(told, error);
  fs::remove(leads_there, error);
  return address;
}

}  // namespace hysteron::studio
