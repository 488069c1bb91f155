// Decides what each request of the page gets. Does not decide how requests come in (http_server.h) nor who may ask
// (guard.h).
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/block/kernel.h"
#include "studio/folder.h"
#include "studio/http_message.h"
#include "studio/import.h"
#include "studio/jobs.h"
#include "studio/live.h"
#include "studio/told_views.h"
#include "studio/trace_file.h"

namespace hysteron::studio {

struct ApiSettings {
  const Registry* registry = nullptr;
  std::string blocks;  ///< {"blocks": [...]} of the verb blocks
  std::string version;
  JobSettings jobs;
  JobVerb verb_new{};  ///< how recordings are read
  OwnVerbs own{};
};

class Api {
 public:
  Api(const OpenFolder& folder, ApiSettings settings);

  /// Never throws: what is wrong is {"exit_code", "problems"} with status 4xx.
  HttpReply answer(const HttpRequest& request);
  /// A file that was handed out by a ticket, e.g. a report: "/open/TICKET/report.html". Each ticket opens once.
  HttpReply opened(const HttpRequest& request);

 private:
  using Handler = std::function<HttpReply(const HttpRequest&)>;
  HttpReply hello(const HttpRequest& request);
  HttpReply files(const HttpRequest& request);
  HttpReply blocks(const HttpRequest& request);
  HttpReply state(const HttpRequest& request);
  HttpReply view(const HttpRequest& request);
  HttpReply fits(const HttpRequest& request);
  HttpReply read(const HttpRequest& request);
  HttpReply write(const HttpRequest& request);
  HttpReply edit(const HttpRequest& request);
  HttpReply begin_job(const HttpRequest& request);
  HttpReply cancel_job(const HttpRequest& request);
  HttpReply remove_job(const HttpRequest& request);
  HttpReply head(const HttpRequest& request);
  HttpReply trace(const HttpRequest& request);
  HttpReply ticket(const HttpRequest& request);
  HttpReply layout(const HttpRequest& request);
  HttpReply events(const HttpRequest& request);
  HttpReply upload(const HttpRequest& request);
  HttpReply import_preview(const HttpRequest& request);
  HttpReply import_start(const HttpRequest& request);
  HttpReply import_join(const HttpRequest& request);
  HttpReply live(const HttpRequest& request);
  HttpReply viewed(const nlohmann::json& asked);

  const OpenFolder& folder_;
  ApiSettings settings_;
  Jobs jobs_;
  TraceFiles traces_;
  Import import_;
  Live live_;
  ToldViews told_;
  std::map<std::string, Handler> handlers_;  ///< "GET /api/hello"
  std::mutex writing_;
  std::mutex tickets_mutex_;
  std::map<std::string, std::string> tickets_;  ///< file of each
};

}  // namespace hysteron::studio
