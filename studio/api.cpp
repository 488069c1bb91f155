#include "studio/api.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "engine/diagram/error.h"
#include "io/diagram/layout_file.h"
#include "io/files/atomic_file.h"
#include "io/json/json_edit.h"
#include "io/json/problems_json.h"
#include "studio/guard.h"
#include "studio/palette.h"
#include "studio/units_near.h"
#include "studio/view.h"

namespace hysteron::studio {
namespace {

using nlohmann::json;
using Json = nlohmann::ordered_json;

using Clock = std::chrono::steady_clock;

constexpr int conflict = 409, not_found = 404, bad_request = 400;
constexpr auto events_every = std::chrono::milliseconds(60);  // for what is told as an event
constexpr auto heartbeat = std::chrono::seconds(10);

HttpReply reply_of(const Json& body, int status = 200) {
  return {status, "application/json", body.dump(-1, ' ', false, Json::error_handler_t::replace), {}, {}};
}

HttpReply failed(const std::vector<Problem>& problems, int status = bad_request) {
  return {status, "application/json", problems_json(problems, 2), {}, {}};
}

json asked_of(const HttpRequest& request) {
  json asked = json::parse(request.body, nullptr, false);
  if (!asked.is_object()) fail("bad_request", request.path, "the body is no JSON object", "reload the page");
  return asked;
}

std::string type_of(const std::string& file) {
  static const std::map<std::string, std::string> types{
      {".html", "text/html; charset=utf-8"}, {".json", "application/json"}, {".svg", "image/svg+xml"}};
  const auto found = types.find(std::filesystem::path(file).extension().string());
  return found == types.end() ? "text/plain; charset=utf-8" : found->second;
}

JsonEdit edit_of(const json& asked) {
  static const std::map<std::string, JsonEdit::Kind> kinds{{"replace", JsonEdit::Kind::replace},
                                                           {"insert", JsonEdit::Kind::insert},
                                                           {"remove", JsonEdit::Kind::remove},
                                                           {"rename", JsonEdit::Kind::rename}};
  const auto kind = kinds.find(asked.value("kind", ""));
  if (kind == kinds.end()) fail("bad_request", "kind", "there is no such edit", "reload the page");
  return {kind->second, asked.value("pointer", ""), asked.value("key", ""), asked.value("value", ""),
          asked.value("after", "")};
}

void write_places(const std::string& diagram_file, const BlockPlaces& places) {
  std::error_code error;
  if (places.empty())
    std::filesystem::remove(layout_file_of(diagram_file), error);
  else
    write_file(layout_file_of(diagram_file), layout_text(places));
}

/// A block that gets another name stays where it was put; the old place stays as well, for an undo.
void follow_names(const std::string& diagram_file, const std::vector<JsonEdit>& edits) {
  const std::string blocks = "/blocks/";
  BlockPlaces places;
  for (const auto& edit : edits) {
    if (edit.kind != JsonEdit::Kind::rename || !edit.pointer.starts_with(blocks)) continue;
    if (places.empty()) places = read_layout(diagram_file);
    const auto before = places.find(edit.pointer.substr(blocks.size()));
    if (before == places.end()) continue;
    places[edit.key] = before->second;
    write_places(diagram_file, places);
  }
}

double number_of(const HttpRequest& request, const char* name) {
  return std::strtod(request.asked(name).c_str(), nullptr);
}

}  // namespace

Api::Api(const OpenFolder& folder, ApiSettings settings)
    : folder_(folder),
      settings_(std::move(settings)),
      jobs_(folder, settings_.jobs),
      import_(folder, settings_.verb_new, settings_.own),
      live_(folder, settings_.jobs.verbs, settings_.jobs.allowed, settings_.own) {
  const auto add = [this](const char* what, HttpReply (Api::*member)(const HttpRequest&)) {
    handlers_[what] = [this, member](const HttpRequest& request) { return (this->*member)(request); };
  };
  add("GET /api/hello", &Api::hello);
  add("GET /api/files", &Api::files);
  add("GET /api/blocks", &Api::blocks);
  add("GET /api/state", &Api::state);
  add("POST /api/view", &Api::view);
  add("POST /api/fits", &Api::fits);
  add("GET /api/file", &Api::read);
  add("PUT /api/file", &Api::write);
  add("POST /api/edit", &Api::edit);
  add("POST /api/jobs", &Api::begin_job);
  add("POST /api/cancel", &Api::cancel_job);
  add("DELETE /api/jobs", &Api::remove_job);
  add("GET /api/head", &Api::head);
  add("GET /api/trace", &Api::trace);
  add("POST /api/ticket", &Api::ticket);
  add("POST /api/layout", &Api::layout);
  add("GET /api/events", &Api::events);
  add("POST /api/upload", &Api::upload);
  add("POST /api/import/preview", &Api::import_preview);
  add("POST /api/import", &Api::import_start);
  add("POST /api/import/join", &Api::import_join);
  add("POST /api/live", &Api::live);
  handlers_["GET /api/units"] = [](const HttpRequest& request) {
    return reply_of(same_in_other_units(request.asked("of")));
  };
}

HttpReply Api::answer(const HttpRequest& request) {
  try {
    const auto handler = handlers_.find(request.method + " " + request.path);
    if (handler == handlers_.end())
      return failed({{"no_such_request", request.path, "the studio knows no such request", "reload the page", "", 0}},
                    not_found);
    return handler->second(request);
  } catch (const Error& error) {
    return failed(error.problems);
  } catch (const std::exception& error) {
    return failed(
        {{"unexpected", request.path, error.what(), "reload the page; if it comes again, please report it", "", 0}},
        500);
  }
}

HttpReply Api::hello(const HttpRequest&) {
  return reply_of({{"version", settings_.version},
                   {"folder", folder_.path()},
                   {"name", std::filesystem::path(folder_.path()).filename().string()},
                   {"threads", settings_.jobs.threads}});
}

HttpReply Api::files(const HttpRequest&) {
  Json list = Json::array();
  for (const auto& file : folder_.list())
    list.push_back({{"path", file.path}, {"kind", file.kind}, {"title", file.title}});
  return reply_of({{"files", list}});
}

HttpReply Api::blocks(const HttpRequest&) {
  return reply_of({{"blocks", Json::parse(settings_.blocks)["blocks"]},
                   {"symbols", palette_symbols(*settings_.registry)},
                   {"laws", palette_laws(*settings_.registry)},
                   {"pictures", pictograms()}});
}

HttpReply Api::state(const HttpRequest& request) {
  Json files = Json::object();
  const auto [first, last] = request.query.equal_range("path");
  for (auto i = first; i != last; ++i) files[i->second] = digest_of(folder_.file(i->second));
  return reply_of({{"files", files}, {"jobs", jobs_.list()}});
}

HttpReply Api::events(const HttpRequest& request) {
  HttpReply reply{200, "application/x-ndjson", "", {}, {}};
  state(request);  // what is wrong with the request is told at once
  reply.stream = [this, request](const HttpSend& send) {
    std::string told;
    for (auto last = Clock::now(); send("");) {
      std::string now = answer({"GET", "/api/state", request.query}).body;
      const bool is_new = now != told, is_quiet = Clock::now() - last > heartbeat;
      if (is_new) told = std::move(now);
      if (is_new || is_quiet) last = Clock::now();
      if (is_new && !send(told + "\n")) return;
      if (!is_new && is_quiet && !send("\n")) return;
      std::this_thread::sleep_for(events_every);
    }
  };
  return reply;
}

HttpReply Api::upload(const HttpRequest& request) {
  return reply_of({{"file", import_.keep(request.asked("name"), request.body)}});
}

HttpReply Api::import_preview(const HttpRequest& request) { return reply_of(import_.preview(asked_of(request))); }

HttpReply Api::import_start(const HttpRequest& request) {
  const std::lock_guard lock(writing_);
  return reply_of(import_.start(asked_of(request)));
}

HttpReply Api::import_join(const HttpRequest& request) {
  const std::lock_guard lock(writing_);
  return reply_of(import_.join(asked_of(request)));
}

HttpReply Api::live(const HttpRequest& request) {
  return {200, "application/octet-stream", live_.answer(asked_of(request)), {}, {}};
}

HttpReply Api::viewed(const json& asked) {
  Json view = view_of(folder_.file(asked.value("path", "")), *settings_.registry,
                      {settings_.jobs.allowed, asked.value("depth", 0)});
  return {200, "application/json", told_.tell(std::move(view), asked.value("had", "")), {}, {}};
}

HttpReply Api::view(const HttpRequest& request) { return viewed(asked_of(request)); }

HttpReply Api::fits(const HttpRequest& request) {
  const json asked = asked_of(request);
  return reply_of(fits_of(folder_.file(asked.value("path", "")), asked.value("signal", ""), *settings_.registry,
                          {settings_.jobs.allowed, 0}));
}

HttpReply Api::read(const HttpRequest& request) {
  const std::string file = folder_.file(request.asked("path"));
  return {200, file.ends_with(".json") ? "application/json" : "text/plain; charset=utf-8", read_file(file), {}, {}};
}

HttpReply Api::write(const HttpRequest& request) {
  const json asked = asked_of(request);
  const std::string file = folder_.file(asked.value("path", ""));
  const std::lock_guard lock(writing_);
  if (const std::string now = digest_of(file); now != asked.value("hash", ""))
    return reply_of({{"hash", now}, {"text", now.empty() ? "" : read_file(file)}}, conflict);
  write_file(file, asked.at("text").get<std::string>());
  return viewed(asked);
}

HttpReply Api::edit(const HttpRequest& request) {
  const json asked = asked_of(request);
  const std::string file = folder_.file(asked.value("path", ""));
  const std::lock_guard lock(writing_);
  const std::string text = read_file(file);
  if (const std::string now = digest_of(file); now != asked.value("hash", ""))
    return reply_of({{"hash", now}, {"text", text}}, conflict);
  std::vector<JsonEdit> edits;
  for (const auto& one : asked.at("edits")) edits.push_back(edit_of(one));
  write_file(file, edited_json(text, edits));
  follow_names(file, edits);
  return viewed(asked);
}

HttpReply Api::layout(const HttpRequest& request) {
  const json asked = asked_of(request);
  const std::string file = folder_.file(asked.value("path", ""));
  const std::lock_guard lock(writing_);
  BlockPlaces places = read_layout(file);
  for (const auto& [block, place] : asked.at("moves").items()) {
    if (place.is_null())
      places.erase(block);
    else
      places[block] = place.get<std::array<int, 2>>();
  }
  write_places(file, places);
  return viewed(asked);
}

HttpReply Api::begin_job(const HttpRequest& request) { return reply_of({{"id", jobs_.begin(asked_of(request))}}); }

HttpReply Api::cancel_job(const HttpRequest& request) {
  jobs_.cancel(asked_of(request).value("id", ""));
  return reply_of(Json::object());
}

HttpReply Api::remove_job(const HttpRequest& request) {
  jobs_.remove(request.asked("id"));
  return reply_of(Json::object());
}

HttpReply Api::head(const HttpRequest& request) { return reply_of(traces_.head(folder_.file(request.asked("path")))); }

HttpReply Api::trace(const HttpRequest& request) {
  std::vector<std::string> columns;
  const auto [first, last] = request.query.equal_range("column");
  for (auto i = first; i != last; ++i) columns.push_back(i->second);
  const TraceStretch wanted{number_of(request, "from"), number_of(request, "to"),
                            static_cast<std::size_t>(std::max(1.0, number_of(request, "pixels")))};
  return {
      200, "application/octet-stream", traces_.stretch(folder_.file(request.asked("path")), columns, wanted), {}, {}};
}

HttpReply Api::ticket(const HttpRequest& request) {
  const std::string file = folder_.file(asked_of(request).value("path", ""));
  check_readable(file);
  const std::string ticket = new_token();
  const std::lock_guard lock(tickets_mutex_);
  tickets_[ticket] = file;
  return reply_of({{"url", "/open/" + ticket + "/" + std::filesystem::path(file).filename().string()}});
}

HttpReply Api::opened(const HttpRequest& request) {
  constexpr std::size_t begin = 6;  // of the ticket, behind "/open/"
  const std::string ticket = request.path.substr(begin, request.path.find('/', begin) - begin);
  std::string file;
  {
    const std::lock_guard lock(tickets_mutex_);
    const auto found = tickets_.find(ticket);
    if (found == tickets_.end())
      return failed({{"ticket_used", request.path, "this address opens once", "open it from the studio again", "", 0}},
                    not_found);
    file = found->second;
    tickets_.erase(found);
  }
  try {
    // What a file of the user's says must not act in the name of the studio.
    return {200,
            type_of(file),
            read_file(file),
            {{"Content-Security-Policy", "sandbox allow-scripts allow-downloads"}},
            {}};
  } catch (const Error& error) {
    return failed(error.problems, not_found);
  }
}

}  // namespace hysteron::studio
