// The page: complete without JavaScript, harmless whatever the texts are, nothing from a network.
#include "report/page/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "report/page/assets.h"
#include "report/page/figure_file.h"
#include "tests/io/results/example.h"
#include "tests/report/page/count.h"

namespace hysteron {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The page without its style and script: what documents put into it.
std::string content() {
  const std::string page = report_html(example::discovery());
  const auto begin = page.find("<body>"), end = page.rfind("<script>");
  return page.substr(begin, end - begin);
}

/// The JSON blocks that the script draws from.
std::vector<nlohmann::json> data_of(const std::string& page) {
  std::vector<nlohmann::json> list;
  const std::string open = "<script type=\"application/json\">";
  for (auto at = page.find(open); at != std::string::npos; at = page.find(open, at + 1)) {
    const auto begin = at + open.size();
    list.push_back(nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin)));
  }
  return list;
}

TEST(Report, GivesTheAnswerFirst) {
  const std::string page = content();
  const auto headline = page.find("is missing before the stage"), verdict = page.find("missing effect"),
             warning = page.find("one sample late"), section = page.find("How the error falls</h2>");
  ASSERT_NE(section, std::string::npos);
  EXPECT_LT(headline, verdict);
  EXPECT_LT(verdict, warning);
  EXPECT_LT(warning, section);
}

/// A document whose answer is a curve over time, and a loop coloured by time.
Document with_answer() {
  Document d;
  d.verb = "compare";
  d.headline = "The model is off by 1 um.";
  d.sentences = {"Most of it at the end."};
  Curve over_time{"measured", "line", "measured", "", "", "", {}, {}}, loop = over_time;
  for (int i = 0; i < 1000; ++i) {
    over_time.x.push_back(i);
    over_time.y.push_back(std::sin(0.01 * i));
    loop.x.push_back(std::cos(0.01 * i));
    loop.y.push_back(std::sin(0.01 * i));
  }
  loop.colour = "time";
  d.answer = {{"y over time", "t [s]", "y [um]", "curves", {over_time}, {}, ""},
              {"y over u", "u [V]", "y [um]", "curves", {loop}, {}, ""}};
  return d;
}

TEST(Report, ShowsTheAnswerBetweenItsSentenceAndAllOthers) {
  const std::string page = report_html(with_answer());
  const auto headline = page.find("The model is off"), figure = page.find("<h3>y over time</h3>"),
             loop = page.find("<h3>y over u</h3>"), sentence = page.find("Most of it at the end.");
  ASSERT_NE(loop, std::string::npos);
  EXPECT_LT(headline, figure);
  EXPECT_LT(figure, loop);
  EXPECT_LT(loop, sentence);
}

TEST(Report, FitsItsAnswerOnAScreen) {
  // Two figures beside each other, each no higher than what a screen of 800 pixels leaves below the headline.
  for (const auto& figure : data_of(report_html(with_answer()))) EXPECT_LE(figure["height"].get<double>(), 600);
}

TEST(Report, LeadsFromTheFirstScreenToItsWarnings) {
  Document d = with_answer();
  d.warnings = {"Little time.", "Little data."};
  const std::string page = report_html(d);
  EXPECT_LT(page.find("href=\"#warnings\">2 warnings"), page.find("<h3>y over time</h3>"));
  EXPECT_TRUE(has(page, "id=\"warnings\""));
}

TEST(Report, ColoursALoopByTimeFromTheFirstShadeToTheLast) {
  const std::string page = report_html(with_answer());
  std::size_t last = 0;
  for (int i = 0; i < 12; ++i) {
    const auto at = page.find("<path class=\"curve line c-t" + std::to_string(i) + "\"");
    ASSERT_NE(at, std::string::npos) << i;
    if (i != 4) {  // the legend shows shade 4 before the picture
      EXPECT_GT(at, last);
      last = at;
    }
    EXPECT_EQ(count(page, "--t" + std::to_string(i) + ": #"), 3U) << "on a screen, in the dark, on paper";
  }
  const auto data = data_of(page);
  EXPECT_EQ(data.at(1)["curves"][0]["shade"].front(), 0);
  EXPECT_EQ(data.at(1)["curves"][0]["shade"].back(), 1);
  EXPECT_FALSE(data.at(0)["curves"][0].contains("shade"));
}

struct Colour {
  double red = 0, green = 0, blue = 0;  ///< 0 .. 1
};

/// "--name: #rrggbb" of a part of the style sheet.
Colour colour_in(const std::string& css, const std::string& name) {
  const auto at = css.find("--" + name + ": #");
  EXPECT_NE(at, std::string::npos) << name;
  if (at == std::string::npos) return {};
  const auto channel = [&](std::size_t i) {
    return std::stoi(css.substr(at + name.size() + 5 + 2 * i, 2), nullptr, 16) / 255.0;
  };
  return {channel(0), channel(1), channel(2)};
}

/// Relative luminance, 0 (black) to 1 (white). Source: WCAG 2.1, "relative luminance".
double luminance(const Colour& colour) {
  const auto linear = [](double c) { return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
}

/// WCAG 2.1, 1.4.11: what must be seen in a picture has a contrast of at least three to what is behind it.
constexpr double least_contrast = 3;

/// Of a colour that lets `1 - opacity` of the paper through.
double contrast(const Colour& colour, const Colour& paper, double opacity = 1) {
  const auto mixed = [&](double c, double p) { return opacity * c + (1 - opacity) * p; };
  const double a = luminance(
                   {mixed(colour.red, paper.red), mixed(colour.green, paper.green), mixed(colour.blue, paper.blue)}),
               b = luminance(paper);
  return (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05);
}

/// On a screen, in the dark, on paper.
std::vector<std::string> themes() {
  const std::string css(report_css);
  const auto dark = css.find("@media (prefers-color-scheme: dark)"), print = css.find("@media print");
  EXPECT_LT(dark, print);
  return {css.substr(0, dark), css.substr(dark, print - dark), css.substr(print)};
}

TEST(Report, ShowsEveryCurveAndBarInTheLightInTheDarkAndOnPaper) {
  std::vector<std::string> names = {"measured", "simulated", "before", "residual", "floor", "step"};
  for (int i = 0; i < 12; ++i) names.push_back("t" + std::to_string(i));
  for (int i = 0; i < 8; ++i) names.push_back("p" + std::to_string(i));
  for (const auto& theme : themes())
    for (const auto& name : names)
      EXPECT_GE(contrast(colour_in(theme, name), colour_in(theme, "paper")), least_contrast)
          << name << " in " << theme.substr(0, 40);
}

TEST(Report, ShowsWhatWasMeasuredUnderWhatIsSimulated) {
  const std::string css(report_css);
  const auto number_behind = [&](const std::string& text, const std::string& word, std::size_t from) {
    const auto at = text.find(word, from);
    EXPECT_NE(at, std::string::npos) << word;
    return at == std::string::npos ? 0 : std::stod(text.substr(at + word.size()));
  };
  ASSERT_NE(css.find(".curve.under { stroke-width: 5; stroke-opacity: var(--under); }"), std::string::npos);
  for (const auto& theme : themes()) {
    std::vector<double> opacities{number_behind(theme, "--under: ", 0)};
    for (const char* rule : {".curve.c-measured {", ".curve.points.c-measured {"})
      opacities.push_back(number_behind(css, "stroke-opacity: ", css.find(rule)));
    for (const double opacity : opacities)
      EXPECT_GE(contrast(colour_in(theme, "measured"), colour_in(theme, "paper"), opacity), least_contrast) << opacity;
  }
}

TEST(Report, DrawsAPartOfALongCurveFromAllItsPoints) {
  Document d;
  d.sections.resize(1);
  Curve curve{"y", "line", "", "", "", "", {}, {}};
  for (int i = 0; i < 500000; ++i) {
    curve.x.push_back(i);
    curve.y.push_back(i % 7);
  }
  Figure figure{"y", "t [s]", "y", "curves", {curve}, {}, ""};
  figure.x_range = {1000, 1200};
  d.sections[0].figures = {figure};
  EXPECT_EQ(data_of(report_html(d)).at(0)["curves"][0]["x"].size(), 203U);  // 201 and a neighbour on each side
}

TEST(Report, SaysWhatTheLengthOfABarMeansAndGivesItsNumbers) {
  Document d;
  d.sections.resize(1);
  d.sections[0].figures = {{"By branch",
                            "share of the squared error [%]",
                            "",
                            "bars",
                            {},
                            {{"falling", 78, "", ""}, {"slow, or held", 22, "", ""}},
                            ""}};
  const std::string page = report_html(d);
  EXPECT_TRUE(has(page, "<span>0</span><span>78</span></div><div>share of the squared error [%]</div>"));
  EXPECT_TRUE(has(page, "download=\"By-branch.csv\" href=\"data:text/csv;charset=utf-8,"));
  EXPECT_TRUE(has(page, "falling%2c78%0a%22slow%2c%20or%20held%22%2c22%0a") ||
              has(page, "falling%2C78%0A%22slow%2C%20or%20held%22%2C22%0A"));
}

TEST(Report, NamesEveryStepOfANarrowWaterfallInFull) {
  Document d;
  Figure fall{"y: error", "", "RMS [um]", "waterfall", {}, {}, ""};
  for (const char* step : {"as given", "own parameters fitted", "+ friction", "+ saturation", "+ sensor_nonlinearity"})
    fall.bars.push_back({step, 10.0 / static_cast<double>(fall.bars.size() + 1), "0.0005432 um (3.2 %)", ""});
  fall.bars.push_back({"repeatability", 0.5, "0.5 um", "floor"});
  Curve curve{"measured", "line", "measured", "", "", "", {0, 1}, {0, 1}};
  d.answer = {{"y", "t [s]", "y [um]", "curves", {curve}, {}, ""}, fall};
  const std::string page = report_html(d);
  for (const auto& bar : fall.bars) EXPECT_TRUE(has(page, ">" + bar.label)) << bar.label;
  EXPECT_EQ(count(page, ">0.0005432 um (3.2 %)</text>"), 5U);
  EXPECT_TRUE(has(page, ">repeatability 0.5 um</text>"));
}

TEST(Report, DoesNotSayTheTitleTwice) {
  Document d;
  d.title = "Stage";
  d.headline = "Stage: simulated 1 s";
  EXPECT_TRUE(has(report_html(d), "<h1>Simulated 1\u00a0s</h1>"));
}

TEST(Report, ShowsEveryFigureWithoutJavaScript) {
  const std::string page = content();
  EXPECT_EQ(count(page, "<figure "), 9U);
  EXPECT_EQ(count(page, "<svg class=\"plot\""), 8U);  // one of the nine is a table of bars
  EXPECT_EQ(count(page, "<table class=\"bars\""), 1U);
  EXPECT_TRUE(has(page, "no values to show"));
  EXPECT_TRUE(has(page, "displacement [um]") && has(page, "time [s]"));
}

TEST(Report, LabelsAnAxisByItsColumnWhereTheFigureDoesNot) {
  EXPECT_TRUE(has(content(), ">u [V]</text>"));
  EXPECT_TRUE(has(content(), ">residual [um]</text>"));
}

TEST(Report, KeepsHostileTextHarmless) {
  const std::string page = content();
  EXPECT_FALSE(has(page, "<img"));
  EXPECT_FALSE(has(page, "<i>markup"));
  EXPECT_FALSE(has(page, "<script>document"));
  EXPECT_TRUE(has(page, "&lt;i&gt;markup&lt;/i&gt; &amp; more"));
  EXPECT_EQ(count(page, "<script"), count(page, "</script>"));
}

TEST(Report, RefersToNothingOutsideItsFolder) {
  std::string page = report_html(example::discovery());
  // The one address in it is the name of SVG, which nobody fetches.
  const std::string svg = "http://www.w3.org/2000/svg";
  ASSERT_EQ(count(page, svg), 1U);
  page.erase(page.find(svg), svg.size());
  EXPECT_FALSE(has(page, "://"));
  EXPECT_FALSE(has(page, "@import") || has(page, "url(//"));
  EXPECT_TRUE(has(page, "default-src 'none'"));
}

TEST(Report, ColoursTheLinesOfADiff) {
  const std::string page = content();
  EXPECT_TRUE(has(page, "<span class=\"removed\">-  &quot;stage&quot;"));
  EXPECT_TRUE(has(page, "<span class=\"added\">+  &quot;stage&quot;"));
}

TEST(Report, DoesNotTakeADiagramForADiff) {
  Document d;
  d.sections.resize(1);
  d.sections[0].preformatted = "{\n- \"a\": 1\n}\n";
  EXPECT_FALSE(has(report_html(d), "class=\"removed\""));
}

TEST(Report, EmbedsThinnedDataThatStillHoldsTheSpikeAndSaysSo) {
  const auto data = data_of(report_html(example::discovery()));
  ASSERT_EQ(data.size(), 6U);  // the figures of curves that have values
  const auto& measured = data[0]["curves"][0];
  const std::size_t kept = measured["x"].size() + data[0]["curves"][1]["x"].size();
  EXPECT_LE(kept, 20000U);
  EXPECT_GE(kept, 10000U);
  double high = 0, at = 0;
  for (std::size_t i = 0; i < measured["y"].size(); ++i)
    if (measured["y"][i] > high) {
      high = measured["y"][i];
      at = measured["x"][i];
    }
  EXPECT_DOUBLE_EQ(at, 12.345);  // row 12 345 at 1 ms
  EXPECT_TRUE(has(content(), "every peak among them"));
}

TEST(Report, KeepsAPageWithManyRecordingsLight) {
  Document d = example::discovery();
  const auto figure = d.sections[1].figures[0];
  for (int i = 0; i < 40; ++i) d.sections[1].figures.push_back(figure);
  std::size_t kept = 0;
  for (const auto& f : data_of(report_html(d)))
    for (const auto& c : f["curves"]) kept += c["x"].size();
  EXPECT_LE(kept, 240000U);
  EXPECT_GE(kept, 200000U);
}

TEST(Report, EmbedsNamesOfAnyKindAsValidJson) {
  Document d;
  d.sections.resize(1);
  d.sections[0].figures.resize(1);
  d.sections[0].figures[0].curves = {{"a\"b\\c\n\x01µ</script>", "line", "", "", "", "", {0, 1}, {0, 1}}};
  EXPECT_EQ(data_of(report_html(d)).at(0)["curves"][0]["name"], d.sections[0].figures[0].curves[0].name);
}

TEST(Report, LinksTheFiguresOfASectionOverTheSameQuantity) {
  const auto data = data_of(report_html(example::discovery()));
  EXPECT_EQ(data[0]["link"], data[1]["link"]);  // measured and simulated, residual: both over time
  EXPECT_NE(data[0]["link"], data[2]["link"]);  // against level
  EXPECT_NE(data[0]["link"], data[5]["link"]);  // over time, in another section
}

TEST(Report, GivesRolesTheirColoursAndOthersThePalette) {
  const auto data = data_of(report_html(example::discovery()));
  EXPECT_EQ(data[0]["curves"][0]["colour"], "measured");
  EXPECT_EQ(data[0]["curves"][1]["colour"], "simulated");
  EXPECT_EQ(data[5]["curves"][0]["colour"], "p0");
  EXPECT_EQ(data[5]["curves"][1]["colour"], "p1");
}

TEST(Report, DashesCurvesWhoseColourComesASecondTime) {
  Document d = example::discovery();
  std::vector<Curve>* curves = nullptr;
  for (auto& section : d.sections)
    for (auto& figure : section.figures)
      if (!figure.curves.empty() && curves == nullptr) curves = &figure.curves;
  const Curve one = curves->front();
  curves->assign(10, one);
  for (auto& curve : *curves) curve.role = "";
  const auto drawn = data_of(report_html(d))[0]["curves"];
  ASSERT_EQ(drawn.size(), 10U);
  EXPECT_EQ(drawn[7]["colour"], "p7");
  EXPECT_EQ(drawn[8]["colour"], "p8");
  EXPECT_EQ(drawn[9]["colour"], "p9");
}

TEST(Report, TellsCurvesOfOneRoleApart) {
  Document d;
  d.sections.resize(1);
  d.sections[0].figures.resize(1);
  for (int i = 0; i < 6; ++i)
    d.sections[0].figures[0].curves.push_back({"residual", "line", "residual", "", "", "", {0, 1}, {0, 1}});
  std::set<std::string> colours;
  const auto data = data_of(report_html(d));
  for (const auto& c : data.at(0)["curves"]) colours.insert(c["colour"].get<std::string>());
  EXPECT_EQ(colours.size(), 6U);
}

TEST(Report, DrawsTheFloorOfAWaterfallAsALine) {
  const std::string page = content();
  EXPECT_EQ(count(page, "<line class=\"floor\""), 1U);
  EXPECT_EQ(count(page, "class=\"bar c-before\""), 1U);     // where we start
  EXPECT_EQ(count(page, "class=\"bar c-simulated\""), 1U);  // where we end
  EXPECT_TRUE(has(page, "−83.1 %"));                        // 1 - 0.061 / 0.36
}

/// A document with the picture "final.svg" of this text.
Document with_picture(const std::string& svg) {
  Document d;
  d.files = {{"final.svg", svg}};
  d.sections.resize(1);
  d.sections[0].figures.resize(1);
  d.sections[0].figures[0].title = "The diagram <after>";
  d.sections[0].figures[0].kind = "picture";
  d.sections[0].figures[0].picture = "final.svg";
  return d;
}

TEST(Report, HoldsAPictureInsideThePageAndLeadsToItsFile) {
  const std::string page = report_html(with_picture("Man"));
  // RFC 4648, section 10, and the well-known "Man" -> "TWFu": no, one or two bytes over.
  EXPECT_TRUE(has(page, "src=\"data:image/svg+xml;base64,TWFu\""));
  EXPECT_TRUE(has(report_html(with_picture("fooba")), "base64,Zm9vYmE=\""));
  EXPECT_TRUE(has(report_html(with_picture("foob")), "base64,Zm9vYg==\""));
  EXPECT_TRUE(has(page, "<a href=\"final.svg\"><img alt=\"The diagram &lt;after&gt;\""));
  EXPECT_TRUE(has(page, "img-src data:"));
}

TEST(Report, LeavesOutAPictureThatIsNotThere) {
  Document d = with_picture("<svg/>");
  d.files.clear();
  EXPECT_FALSE(has(report_html(d), "<img"));
}

/// Height at which the text of a page's SVG stands.
double height_of(const std::string& page, const std::string& text) {
  const auto at = page.find(">" + text + "<");
  const auto y = page.rfind(" y=\"", at);
  return at == std::string::npos ? -1 : std::stod(page.substr(y + 4));
}

TEST(Report, WritesTheWordsOfTwoFloorsThatAreNearlyEqualOneBelowTheOther) {
  Document d = example::discovery();
  d.sections[0].figures[0].bars.push_back({"repeatability", 0.0211, "0.0211 um", "floor"});
  const std::string page = report_html(d);
  EXPECT_EQ(count(page, "<line class=\"floor\""), 2U);
  // Two lines of 15 px each belong to the upper one.
  EXPECT_GE(height_of(page, "noise floor"), height_of(page, "repeatability") + 30);
  EXPECT_GT(height_of(page, "repeatability"), 0);
}

TEST(FigureFile, IsASvgWithItsOwnStyle) {
  const Document d = example::discovery();
  const std::string svg = figure_file(d, d.sections[0].figures[0]);
  EXPECT_EQ(svg.rfind("<svg xmlns=\"http://www.w3.org/2000/svg\"", 0), 0U);
  EXPECT_EQ(count(svg, "<svg"), 1U);
  EXPECT_LT(svg.find("<style>"), svg.find("<line"));
  EXPECT_TRUE(has(svg, "noise floor"));
}

TEST(FigureFile, OfCurvesNamesThemAboveThePicture) {
  Figure figure;
  figure.title = "two lines";
  for (const char* name : {"without", "with"}) {
    Curve curve;
    curve.name = name;
    curve.style = "line";
    curve.x = {0, 1};
    curve.y = {0, name[4] == 'o' ? 1.0 : 2.0};
    figure.curves.push_back(curve);
  }
  const std::string two = figure_file(Document{}, figure);
  EXPECT_TRUE(has(two, ">without</text>") && has(two, ">with</text>"));
  EXPECT_TRUE(has(two, "viewBox=\"0 -24 ")) << "names stand above the frame, where no curve is";
  figure.curves.pop_back();
  EXPECT_FALSE(has(figure_file(Document{}, figure), ">without</text>")) << "one curve needs no name";
}

TEST(FigureFile, WhatLiesOutsideTheWishedRangeIsCutOffAtTheAxes) {
  Figure figure;
  auto& curve = figure.curves.emplace_back();
  curve.name = "k";
  curve.style = "points";
  curve.x = {0, 1, 2};
  curve.y = {1, 9, 2};
  EXPECT_FALSE(has(figure_file(Document{}, figure), "<svg x="));
  figure.y_range = {0, 3};
  const std::string svg = figure_file(Document{}, figure);
  EXPECT_TRUE(has(svg, "<svg x=")) << svg;
  EXPECT_LT(svg.find("<svg x="), svg.find("curve points"));
}

TEST(FigureFile, TakesAsManyLinesForItsNamesAsItsWidthAsksFor) {
  Figure figure;
  for (int i = 0; i < 8; ++i) {  // 8 names of 40 letters, of 6 px and more each, on less than 1000 px
    Curve curve;
    curve.name = std::string(40, static_cast<char>('a' + i));
    curve.style = "line";
    curve.x = {0, 1};
    curve.y = {0, 1.0 + i};
    figure.curves.push_back(curve);
  }
  const std::string svg = figure_file(Document{}, figure);
  EXPECT_FALSE(has(svg, "viewBox=\"0 -24 "));
  for (const auto& curve : figure.curves) EXPECT_TRUE(has(svg, ">" + curve.name + "</text>")) << curve.name;
}

TEST(Report, IsTheSameForTheSameDocument) {
  EXPECT_EQ(report_html(example::discovery()), report_html(example::discovery()));
}

TEST(Report, OfAnEmptyDocumentIsStillAPage) {
  const std::string page = report_html(Document{});
  EXPECT_TRUE(has(page, "<!doctype html>") && has(page, "</html>"));
}

}  // namespace
}  // namespace hysteron
