#include "app/jobs/published_jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "engine/diagram/error.h"
#include "engine/diagram/number_text.h"
#include "io/jobs/job_file.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

/// "fig2_15" before "fig2_100": digits count as numbers.
bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0, k = 0;
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  while (i < a.size() && k < b.size()) {
    if (digit(a[i]) && digit(b[k])) {
      std::size_t i_end = i, k_end = k;
      while (i_end < a.size() && digit(a[i_end])) ++i_end;
      while (k_end < b.size() && digit(b[k_end])) ++k_end;
      const int x = leading_whole_number(a.substr(i, std::min<std::size_t>(i_end - i, 9)), 0);
      const int y = leading_whole_number(b.substr(k, std::min<std::size_t>(k_end - k, 9)), 0);
      if (x != y) return x < y;
      i = i_end;
      k = k_end;
    } else {
      if (a[i] != b[k]) return a[i] < b[k];
      ++i;
      ++k;
    }
  }
  return a.size() - i < b.size() - k;
}

/// "chapter2" -> "C2-".
std::string prefix_of(const std::string& chapter) {
  return chapter.starts_with("chapter") ? "C" + chapter.substr(7) + "-" : "";
}

}  // namespace

std::string folder_of_jobs() {
  std::error_code code;
  for (fs::path here = fs::current_path(code); !here.empty(); here = here.parent_path()) {
    if (fs::exists(here / "diagrams" / "claims.json", code))
      return (here / "diagrams").lexically_relative(fs::current_path()).string();
    if (here == here.parent_path()) break;
  }
  const fs::path program = fs::read_symlink("/proc/self/exe", code);
  const fs::path installed = program.parent_path().parent_path() / "share" / "hysteron" / "diagrams";
  if (!code && fs::exists(installed / "claims.json", code)) return installed.string();
  fail("no_folder", "--from", "there is no folder \"diagrams\" with a claims.json here or above",
       "name the folder of the jobs with --from FOLDER");
}

std::vector<PublishedJob> jobs_in(const std::string& folder) {
  if (!fs::is_directory(folder))
    fail("no_folder", folder, "there is no such folder", "name the folder of the jobs with --from FOLDER");
  std::vector<PublishedJob> jobs;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path& path = entry.path();
    if (!entry.is_regular_file() || path.extension() != ".json" || path.filename() == "claims.json") continue;
    if (what_a_job_does(path.string()) != "runs") continue;
    jobs.push_back({path.string(), path.stem().string(), path.parent_path().filename().string()});
  }
  if (jobs.empty())
    fail("no_jobs", folder, "no file in this folder is a job with \"do\": \"runs\"",
         "name the folder of the jobs with --from FOLDER");
  std::sort(jobs.begin(), jobs.end(), [](const PublishedJob& a, const PublishedJob& b) {
    return a.chapter != b.chapter ? natural_less(a.chapter, b.chapter) : natural_less(a.name, b.name);
  });
  return jobs;
}

WantedJobs wanted_jobs(const std::vector<std::string>& words, const std::vector<PublishedJob>& all,
                       const std::vector<PublishedClaim>& claims, JobPool& pool) {
  WantedJobs wanted;
  std::vector<bool> take(all.size(), false);
  for (const auto& word : words) {
    bool known = word == "all";
    if (known) {
      take.assign(all.size(), true);
      wanted.prefixes.emplace_back("");
      wanted.claims_alone = false;
      continue;
    }
    const bool place =
        std::any_of(all.begin(), all.end(), [&](const PublishedJob& j) { return j.name == word || j.chapter == word; });
    bool claim = std::any_of(claims.begin(), claims.end(), [&](const auto& c) { return c.id == word; });
    std::vector<std::string> names{"all"};
    for (std::size_t i = 0; i < all.size(); ++i) {
      bool is = all[i].name == word || all[i].chapter == word;
      if (all[i].chapter == word && !prefix_of(word).empty()) wanted.prefixes.push_back(prefix_of(word));
      if (!place)
        for (const auto& part : pool.job(all[i].file).job().claims)
          if (part.id == word) is = claim = true;
      if (is) take[i] = known = true;
      names.push_back(all[i].name);
      if (std::find(names.begin(), names.end(), all[i].chapter) == names.end()) names.push_back(all[i].chapter);
    }
    if (claim) wanted.prefixes.push_back(word);
    wanted.claims_alone = wanted.claims_alone && claim;
    for (const auto& c : claims) names.push_back(c.id);
    if (!known && !claim)
      fail("unknown_figure", word, fmt::format("there is no chapter, figure or claim \"{}\"", word),
           nearest_name(word, names).empty()
               ? "name \"all\", a chapter (chapter2), a figure (fig2_15) or a claim (C2-07)"
               : fmt::format("did you mean \"{}\"?", nearest_name(word, names)));
  }
  for (std::size_t i = 0; i < all.size(); ++i) (take[i] ? wanted.jobs : wanted.others).push_back(all[i]);
  return wanted;
}

}  // namespace hysteron
