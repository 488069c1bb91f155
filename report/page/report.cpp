#include "report/page/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/diagram/percent_text.h"
#include "report/page/assets.h"
#include "report/page/decimate.h"
#include "report/page/figure_html.h"
#include "report/page/html.h"
#include "report/page/prepare.h"

namespace hysteron {
namespace {

/// Points that a browser gets: of one figure (a screen is 2000 pixels wide, the rest is for zooming), and of a page.
constexpr std::size_t points_per_figure = 20000, points_per_page = 240000;
constexpr int lines_shown = 60;  ///< longer texts are folded

// ---- small parts ----------------------------------------------------------------------------------------------------

std::string base64(std::string_view bytes) {
  static const char* const letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  unsigned bits = 0;
  int count = 0;
  for (const char c : bytes) {
    bits = ((bits << 8) | static_cast<unsigned char>(c)) & 0xffff;
    for (count += 8; count >= 6; count -= 6) out += letters[(bits >> (count - 6)) & 63];
  }
  if (count > 0) out += letters[(bits << (6 - count)) & 63];
  while (out.size() % 4 != 0) out += '=';
  return out;
}

/// A hash given in hexadecimal digits, as a content security policy wants it.
std::string hash_text(std::string_view hex) {
  const auto nibble = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes += static_cast<char>(16 * nibble(hex[i]) + nibble(hex[i + 1]));
  return base64(bytes);
}

std::string list_html(const char* element, const char* css, const std::vector<std::string>& items) {
  if (items.empty()) return "";
  std::string out = fmt::format("<{}{}>", element, css);
  for (const auto& item : items) out += "<li>" + escape_prose(item) + "</li>";
  return out + fmt::format("</{}>\n", element);
}

// ---- head -----------------------------------------------------------------------------------------------------------

/// A verdict in a word and in a sentence; both empty where there is none.
struct VerdictWords {
  std::string badge, sentence;
};

VerdictWords verdict_html(const std::string& verdict) {
  static const std::map<std::string, std::pair<const char*, const char*>> words{
      {"adequate",
       {"adequate",
        "The residual is noise: no structure remains, and no effect reduces the error of other recordings by more than chance."}},
      {"missing_effect", {"missing effect", "The model lacks a physical effect; it is named here, with its evidence."}},
      {"not_distinguishable",
       {"not distinguishable", "Something is missing, and several effects explain these data equally well."}},
      {"unexplained", {"unexplained", "Structure remains in the residual that no known effect explains."}}};
  if (verdict.empty()) return {};
  const auto found = words.find(verdict);
  const bool known = found != words.end();
  return {fmt::format("<span class=\"badge {}\">{}</span>", known ? verdict : "",
                      known ? found->second.first : escape(verdict)),
          known ? fmt::format("<p class=\"verdict\">{}</p>\n", found->second.second) : ""};
}

std::string head_html(const Document& d) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'sha256-{}'; script-src "
      "'sha256-{}'; img-src data:; "
      "base-uri 'none'; form-action 'none'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta name=\"color-scheme\" "
      "content=\"light dark\">\n"
      "<title>{}</title>\n<style>{}</style>\n</head>\n",
      hash_text(report_css_sha256), hash_text(report_js_sha256),
      escape(d.title.empty() ? d.headline : d.title + " – " + d.verb), report_css);
}

/// The headline without the title in front of it: that stands above it.
std::string headline_below(const Document& d) {
  if (d.headline.empty()) return d.title;
  const std::string title = d.title + ": ";
  if (d.title.empty() || !d.headline.starts_with(title)) return d.headline;
  std::string text = d.headline.substr(title.size());
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

/// Says on the first screen that there are warnings below.
std::string warnings_link(const Document& d) {
  if (d.warnings.empty()) return "";
  return fmt::format("<a class=\"attention\" href=\"#warnings\">{} warning{}</a>", d.warnings.size(),
                     d.warnings.size() == 1 ? "" : "s");
}

/// The first screen: the answer in one sentence, and what shows it; then what matters besides.
std::string summary_html(const Document& d, const std::vector<std::size_t>& budgets) {
  std::string out = fmt::format("<header>\n<p class=\"kicker\"><b>hysteron {}</b>{}{}{}</p>\n", escape(d.verb),
                                d.title.empty() ? "" : " · ", escape(d.title), warnings_link(d));
  const VerdictWords verdict = verdict_html(d.verdict);
  out += fmt::format("<div class=\"head\"><h1>{}</h1>{}</div>\n", escape_prose(headline_below(d)), verdict.badge);
  std::vector<PreparedFigure> figures;
  for (std::size_t i = 0; i < d.answer.size(); ++i) figures.push_back(prepare(d, d.answer[i], budgets[i]));
  out += answer_html(std::move(figures));
  out += verdict.sentence;
  out += list_html("ol", " class=\"sentences\"", d.sentences);
  if (!d.warnings.empty())
    out += "<aside class=\"warnings\" id=\"warnings\" role=\"note\">\n<h2>Note well</h2>\n" +
           list_html("ul", "", d.warnings) + "</aside>\n";
  return out + "</header>\n";
}

std::string contents_html(const Document& d) {
  std::string out;
  if (d.sections.size() > 2) {
    out += "<nav class=\"contents\" aria-label=\"Contents\">\n";
    for (std::size_t i = 0; i < d.sections.size(); ++i)
      out += fmt::format("<a href=\"#s{}\">{}</a>\n", i + 1, escape(d.sections[i].title));
    out += "</nav>\n";
  }
  const auto with_curves = [](const std::vector<Figure>& figures) {
    return std::any_of(figures.begin(), figures.end(), [](const Figure& f) { return f.kind == "curves"; });
  };
  if (with_curves(d.answer) ||
      std::any_of(d.sections.begin(), d.sections.end(), [&](const Section& s) { return with_curves(s.figures); }))
    out +=
        "<p class=\"hint\">In the figures: drag to zoom, <kbd>Shift</kbd>-drag to move, <kbd>Ctrl</kbd>-wheel to zoom "
        "at the pointer (the wheel alone, once a figure was clicked), double-click to see all again. By keys, once "
        "<kbd>Tab</kbd> has reached a figure: <kbd>+</kbd> <kbd>−</kbd> zoom, <kbd>←</kbd> <kbd>→</kbd> move, "
        "<kbd>0</kbd> shows all, <kbd>C</kbd> saves its numbers. A click on a legend entry hides a curve. Figures of a "
        "section over the same quantity move together.</p>\n";
  return out;
}

// ---- sections -------------------------------------------------------------------------------------------------------

/// "1.02", "-3.5 um", "12 %", "0.3 ± 0.1": set flush right, so that digits stand under digits.
bool looks_like_number(const std::string& cell) {
  static const std::string signs = "+-−±<>≤≥~≈.";
  std::size_t i = 0;
  while (i < cell.size() && (cell[i] == ' ' || signs.find(cell[i]) != std::string::npos)) ++i;
  return i < cell.size() && cell[i] >= '0' && cell[i] <= '9' && cell.find(".csv") == std::string::npos;
}

std::string table_html(const Table& t) {
  std::vector<bool> numeric(t.columns.size(), true);
  for (std::size_t k = 0; k < t.columns.size(); ++k) {
    bool any = false;
    for (const auto& row : t.rows) {
      if (k >= row.size() || row[k].empty() || row[k] == "-" || row[k] == "–") continue;
      any = true;
      numeric[k] = numeric[k] && looks_like_number(row[k]);
    }
    numeric[k] = numeric[k] && any && k > 0;
  }
  const auto css = [&](std::size_t k) { return k < numeric.size() && numeric[k] ? " class=\"number\"" : ""; };
  // A sentence in a narrow window must not become a tower of words.
  const auto cell_css = [&](std::size_t k, const std::string& cell) {
    return k < numeric.size() && !numeric[k] && cell.size() > 24 ? " class=\"prose\"" : css(k);
  };
  std::string out = "<div class=\"table\" tabindex=\"0\">\n";
  if (!t.title.empty()) out += "<h3>" + escape_prose(t.title) + "</h3>\n";
  out += "<table>\n<thead><tr>";
  for (std::size_t k = 0; k < t.columns.size(); ++k)
    out += fmt::format("<th scope=\"col\"{}>{}</th>", css(k), escape_prose(t.columns[k]));
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : t.rows) {
    out += "<tr>";
    for (std::size_t k = 0; k < row.size(); ++k)
      out += fmt::format("<td{}>{}</td>", cell_css(k, row[k]), escape_prose(row[k]));
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table>\n</div>\n";
}

/// A diff has nothing but lines that begin with +, -, space or @.
bool is_diff(const std::string& text) {
  bool change = false;
  for (std::size_t begin = 0; begin < text.size(); begin = std::min(text.find('\n', begin), text.size()) + 1) {
    if (text[begin] == '+' || text[begin] == '-')
      change = true;
    else if (text[begin] != ' ' && text[begin] != '@' && text[begin] != '\n' && text[begin] != '\\')
      return false;
  }
  return change;
}

std::string preformatted_html(const std::string& title, const std::string& text) {
  const bool diff = is_diff(text);
  std::string lines;
  int count = 0;
  for (std::size_t begin = 0; begin < text.size(); ++count) {
    const auto end = std::min(text.find('\n', begin), text.size());
    const char mark = text[begin];
    const char* css = !diff         ? ""
                      : mark == '+' ? " class=\"added\""
                      : mark == '-' ? " class=\"removed\""
                      : mark == '@' ? " class=\"place\""
                                    : "";
    lines += fmt::format("<span{}>{}</span>", css, escape(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  const std::string pre = "<pre>" + lines + "</pre>";
  const std::string heading = escape_prose(title.empty() ? (diff ? "What changes" : "Text") : title);
  if (count > lines_shown)
    return fmt::format("<details class=\"code\"><summary>{} ({} lines)</summary>{}</details>\n", heading, count, pre);
  return fmt::format("<div class=\"code\">{}{}</div>\n",
                     title.empty() ? "" : "<div class=\"title\">" + heading + "</div>", pre);
}

/// An SVG of the document, inside the page: as an image, so that its style stays its own. A click opens the file.
std::string picture_html(const Document& d, const Figure& f) {
  const auto file =
      std::find_if(d.files.begin(), d.files.end(), [&](const auto& one) { return one.first == f.picture; });
  if (file == d.files.end()) return "";
  return fmt::format(
      "<figure class=\"figure wide\" data-kind=\"picture\">\n<header><h3>{}</h3></header>\n"
      "<div class=\"drawing\"><a href=\"{}\"><img alt=\"{}\" "
      "src=\"data:image/svg+xml;base64,{}\"></a></div>\n{}</figure>\n",
      escape_prose(f.title), percent_encoded(f.picture), escape(f.title), base64(file->second),
      f.caption.empty() ? "" : "<p class=\"caption\">" + escape_prose(f.caption) + "</p>\n");
}

/// Text, tables, figures, text as it is; only waterfalls and drawings go before the tables: they are the answer, those
/// the evidence.
std::string section_html(const Document& d, const Section& s, std::size_t number,
                         const std::vector<std::size_t>& budgets) {
  std::vector<PreparedFigure> waterfalls, others;
  std::string pictures;
  for (std::size_t i = 0; i < s.figures.size(); ++i)
    if (s.figures[i].kind == "picture")
      pictures += picture_html(d, s.figures[i]);
    else
      (s.figures[i].kind == "waterfall" ? waterfalls : others).push_back(prepare(d, s.figures[i], budgets[i]));
  widen_lonely(others);
  std::string out = fmt::format("<section id=\"s{}\">\n<h2>{}</h2>\n", number, escape_prose(s.title));
  for (const auto& paragraph : s.text) out += "<p>" + escape_prose(paragraph) + "</p>\n";
  out += figures_html(waterfalls, number);
  if (!pictures.empty()) out += "<div class=\"figures\">\n" + pictures + "</div>\n";
  for (const auto& table : s.tables) out += table_html(table);
  out += figures_html(others, number);
  if (!s.preformatted.empty()) out += preformatted_html(s.preformatted_title, s.preformatted);
  return out + "</section>\n";
}

/// The points of each figure of the answer and of each section, so that the page stays light however many recordings it
/// shows.
std::vector<std::vector<std::size_t>> page_budget(const Document& d) {
  std::vector<std::size_t> wanted;
  for (const auto& f : d.answer) wanted.push_back(std::min(points_per_figure, point_count(d, f)));
  for (const auto& s : d.sections)
    for (const auto& f : s.figures) wanted.push_back(std::min(points_per_figure, point_count(d, f)));
  const auto shares = share_budget(wanted, points_per_page);
  std::vector<std::vector<std::size_t>> result;
  auto next = shares.begin();
  const auto take = [&](std::size_t figures) {
    const auto count = static_cast<std::ptrdiff_t>(figures);
    result.emplace_back(next, next + count);
    next += count;
  };
  take(d.answer.size());
  for (const auto& s : d.sections) take(s.figures.size());
  return result;
}

}  // namespace

std::string report_html(const Document& d) {
  const auto budget = page_budget(d);
  std::string out =
      head_html(d) + "<body>\n<div class=\"page\">\n" + summary_html(d, budget[0]) + contents_html(d) + "<main>\n";
  for (std::size_t i = 0; i < d.sections.size(); ++i) out += section_html(d, d.sections[i], i + 1, budget[i + 1]);
  out += fmt::format(
      "</main>\n<footer>Written by hysteron {}. The same for programs: <a "
      "href=\"result.json\">result.json</a>{}.</footer>\n</div>\n",
      HYSTERON_VERSION, d.traces.empty() ? "" : ", the curves: traces/");
  return out + fmt::format("<script>{}</script>\n</body>\n</html>\n", report_js);
}

}  // namespace hysteron
