#include "report/page/figure_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/diagram/percent_text.h"
#include "io/data/csv.h"
#include "report/page/figure_data.h"
#include "report/page/figure_svg.h"
#include "report/page/html.h"

namespace hysteron {
namespace {

// ---- bars -----------------------------------------------------------------------------------------------------------

/// Ends of the axis of horizontal bars: zero is always on it.
struct BarAxis {
  double low = 0, high = 0;
  double span() const { return high > low ? high - low : 1; }
  double percent(double value) const { return 100 * (value - low) / span(); }
};

BarAxis axis_of(const PreparedFigure& figure) {
  BarAxis axis;
  for (const auto& bar : figure.bars) {
    if (!std::isfinite(bar.value)) continue;
    axis.low = std::min(axis.low, bar.value);
    axis.high = std::max(axis.high, bar.value);
  }
  return axis;
}

/// The axis below the bars: where zero and the ends are, and of what.
std::string axis_row(const PreparedFigure& figure, const BarAxis& axis) {
  const std::string ends = fmt::format("<span>{:.3g}</span><span>{:.3g}</span>", axis.low, axis.high);
  return fmt::format(
      "<tfoot><tr><td></td><td class=\"track\"><div class=\"ends\">{}</div><div>{}</div></td>"
      "<td></td></tr></tfoot>",
      ends, escape_prose(figure.x_label));
}

std::string bars_html(const PreparedFigure& figure) {
  const BarAxis axis = axis_of(figure);
  const bool long_texts =
      std::any_of(figure.bars.begin(), figure.bars.end(), [](const Bar& bar) { return bar.text.size() > 18; });
  std::string out = fmt::format("<table class=\"bars{}\">", long_texts ? " long" : "");
  for (const auto& bar : figure.bars) {
    const double value = std::isfinite(bar.value) ? bar.value : 0;
    const double begin = axis.percent(std::min(0.0, value)), width = 100 * std::abs(value) / axis.span();
    const std::string css = bar.role == "after" ? "simulated" : bar.role.empty() ? "p0" : bar.role;
    out += fmt::format(
        "<tr><th scope=\"row\"{}>{}</th><td class=\"track\"><svg><rect class=\"bar c-{}\" x=\"{:.2f}%\" "
        "width=\"{:.2f}%\" "
        "y=\"0\" height=\"100%\"/></svg></td><td>{}</td></tr>",
        bar.label.size() > 26 ? " class=\"prose\"" : "", escape(bar.label), escape(css), begin, width,
        escape_prose(bar.text.empty() ? fmt::format("{:.3g}", bar.value) : bar.text));
  }
  return out + axis_row(figure, axis) + "</table>";
}

// ---- curves ---------------------------------------------------------------------------------------------------------

/// The scale of time between its ends, where a curve is coloured by it.
std::string time_scale_html(const PreparedFigure& figure) {
  if (figure.begins.empty()) return "";
  std::string out =
      fmt::format("<span class=\"scale\">{}<svg viewBox=\"0 0 {} 10\">", escape(figure.begins), 6 * shades);
  for (int i = 0; i < shades; ++i)
    out += fmt::format("<rect class=\"bar c-t{}\" x=\"{}\" y=\"2\" width=\"6\" height=\"6\"/>", i, 6 * i);
  return out + fmt::format("</svg>{}</span>", escape(figure.ends));
}

std::string legend_html(const PreparedFigure& figure) {
  if (figure.curves.empty() || (figure.curves.size() == 1 && figure.curves.front().name.empty())) return "";
  std::string out = "<ul class=\"legend\">";
  for (const auto& curve : figure.curves) {
    const std::string colour = curve.shade.empty() ? curve.colour : fmt::format("t{}", shades / 3);
    out += fmt::format("<li><svg viewBox=\"0 0 22 10\"><path class=\"{}\" d=\"{}\"/></svg>{}</li>",
                       curve_css(curve, colour), curve.style == "points" ? "M4 5h0M11 5h0M18 5h0" : "M1 5h20",
                       escape(curve.name));
  }
  return out + "</ul>" + time_scale_html(figure);
}

/// 100000 -> "100 000", with thin spaces.
std::string grouped(std::size_t n) {
  std::string text = std::to_string(n);
  for (int i = static_cast<int>(text.size()) - 3; i > 0; i -= 3) text.insert(static_cast<std::size_t>(i), "\u2009");
  return text;
}

/// What stands below a figure: its caption, how much of the data is drawn, and where all of it is.
std::string caption_html(const PreparedFigure& f) {
  std::set<std::string> sources;
  for (const auto& c : f.curves)
    if (!c.source.empty()) sources.insert(c.source);
  std::string out = escape_prose(f.caption);
  if (f.kept < f.points)
    out += fmt::format("{}Drawn from {} of {} points, every peak among them.", out.empty() ? "" : " ", grouped(f.kept),
                       grouped(f.points));
  if (!sources.empty() && sources.size() <= 4) {
    out += out.empty() ? "Data: " : " Data: ";
    for (const auto& s : sources)
      out += fmt::format("{}<a href=\"{}\">{}</a>", s == *sources.begin() ? "" : ", ", percent_encoded(s), escape(s));
  } else if (!sources.empty()) {
    out += fmt::format("{}Data: {} files in traces/.", out.empty() ? "" : " ", sources.size());
  }
  return out.empty() ? "" : "<p class=\"caption\">" + out + "</p>\n";
}

/// "Residual of y, 01.csv" -> "residual-of-y-01-csv.csv".
std::string csv_name(const std::string& title) {
  std::string name;
  for (const char c : title) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (plain)
      name += c;
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  while (name.ends_with('-')) name.pop_back();
  return (name.empty() ? "figure" : name) + ".csv";
}

/// The numbers of bars as a CSV that a click saves. That of curves is made by report.js: their numbers are on the page
/// already.
std::string bars_csv_html(const PreparedFigure& f) {
  const std::string& label = f.kind == "bars" ? f.x_label : f.y_label;
  std::string csv = fmt::format("\"\",{}\n", csv_cell(label.empty() ? "value" : label));
  for (const auto& bar : f.bars)
    csv += csv_cell(bar.label) + "," + (std::isfinite(bar.value) ? fmt::format("{}", bar.value) : "") + "\n";
  return fmt::format("<a class=\"csv\" download=\"{}\" href=\"data:text/csv;charset=utf-8,{}\">CSV</a>",
                     escape(csv_name(f.title)), percent_encoded(csv));
}

std::string figure_html(const PreparedFigure& f, const std::string& link, bool with_caption = true) {
  const std::string kind = f.kind == "bars" || f.kind == "waterfall" ? f.kind : "curves";
  std::string out = fmt::format("<figure class=\"figure{}\" data-kind=\"{}\">\n<header><h3>{}</h3>{}</header>\n",
                                f.wide ? " wide" : "", kind, escape_prose(f.title),
                                kind == "curves" ? legend_html(f) : bars_csv_html(f));
  out += fmt::format("<div class=\"picture {}\">{}</div>\n", kind, kind == "bars" ? bars_html(f) : figure_svg(f));
  if (with_caption) out += caption_html(f);
  if (kind == "curves" && !f.x.empty() && !f.y.empty())
    out += "<script type=\"application/json\">" + figure_data(f, link) + "</script>\n";
  return out + "</figure>\n";
}

/// Figures of a section over the same quantity move together, but those that show a chosen part of it.
std::string link_of(const PreparedFigure& f, std::size_t section) {
  return f.x_label.empty() || f.part ? "" : fmt::format("s{} {}{}", section, f.x_label, f.log_x ? " log" : "");
}

}  // namespace

void widen_lonely(std::vector<PreparedFigure>& figures) {
  for (std::size_t i = 0; i < figures.size(); ++i) {
    if (figures[i].wide) continue;
    if (i + 1 < figures.size() && !figures[i + 1].wide)
      ++i;
    else if (figures[i].kind == "curves")
      figures[i].wide = true;
  }
}

std::string figures_html(const std::vector<PreparedFigure>& figures, std::size_t section) {
  if (figures.empty()) return "";
  std::string out = "<div class=\"figures\">\n";
  for (const auto& f : figures) out += figure_html(f, link_of(f, section));
  return out + "</div>\n";
}

std::string answer_html(std::vector<PreparedFigure> figures) {
  if (figures.empty()) return "";
  constexpr double height = 580, header = 34;  // [px] of a screen of 1280 x 800 below the headline; of a title
  constexpr double tallest = 500;              // of one figure
  constexpr double left = 664, right = 452, all = 1144;  // [px] across
  const auto side =
      std::stable_partition(figures.begin(), figures.end(), [](const auto& f) { return f.wide && f.kind == "curves"; });
  const bool two = side != figures.begin() && side != figures.end();
  std::string out = fmt::format("<div class=\"answer{}\">\n", two ? " two" : "");
  const auto column = [&](auto begin, auto end, double width) {
    if (begin == end) return;
    out += "<div>\n";
    for (auto f = begin; f != end; ++f) {
      f->width = width;
      f->height = std::min(tallest, height / static_cast<double>(end - begin) - header);
      f->wide = false;
      out += figure_html(*f, link_of(*f, 0), false);
    }
    out += "</div>\n";
  };
  column(figures.begin(), side, two ? left : all);
  column(side, figures.end(), two ? right : all);
  return out + "</div>\n";
}

}  // namespace hysteron
