// The page in a real browser: its content security policy lets its own script run, every figure is drawn, and it
// answers.
#include "tests/report/browser.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "io/files/atomic_file.h"
#include "report/page/report.h"
#include "tests/io/results/example.h"
#include "tests/io/temporary_folder.h"
#include "tests/report/page/count.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

class Browser : public testing::Test {
 protected:
  void SetUp() override {
    if (browser::find().empty()) GTEST_SKIP() << "no Chromium on this machine (scripts/test installs one)";
  }
  std::string dom_of(const std::string& page) {
    const std::string file = (folder_ / "report.html").string();
    write_file(file, page);
    return browser::dump_dom(file);
  }
  TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

TEST_F(Browser, DrawsEveryFigureWithoutAnError) {
  const std::string dom = dom_of(report_html(example::discovery()));
  ASSERT_FALSE(dom.empty());
  EXPECT_EQ(count(dom, "data-errors=\"0\""), 1U);
  EXPECT_EQ(count(dom, "<figure "), 9U);
  EXPECT_EQ(count(dom, "data-drawn=\"true\""), 9U);
  EXPECT_EQ(count(dom, "class=\"pane\""), 6U);  // six figures of curves were drawn anew by the script
  EXPECT_EQ(count(dom, "data-owned"), 0U);      // no text of the document ran as a script
}

/// The page with a driver that acts as a reader would and notes on <body> what it found.
std::string driven(const std::string& actions, const Document& document = example::discovery()) {
  std::string page = report_html(document);
  const auto policy = page.find("<meta http-equiv=\"Content-Security-Policy\"");
  page.erase(policy, page.find('>', policy) + 1 - policy);
  const std::string driver = R"(<script>
    Element.prototype.setPointerCapture = () => {};
    const note = (key, value) => { document.body.dataset[key] = value; };
    const figures = [...document.querySelectorAll('.figure[data-kind=curves]')];
    const ticks = (i) => [...figures[i].querySelectorAll('.plot g text:not(.label)')].map((t) => t.textContent).join(' ');
    const fire = (i, type, x, y, more = {}) => {
      const r = figures[i].querySelector('svg.plot').getBoundingClientRect();
      const init = {bubbles: true, cancelable: true, clientX: r.left + x * r.width, clientY: r.top + y * r.height, button: 0, pointerType: 'mouse', ...more};
      figures[i].querySelector('.pane').dispatchEvent(type === 'wheel' ? new WheelEvent(type, init) : new PointerEvent(type, init));
    };
    const drag = (i, x0, y0, x1, y1, more) => { fire(i, 'pointerdown', x0, y0, more); fire(i, 'pointermove', x1, y1, more); fire(i, 'pointerup', x1, y1, more); };
    )" + actions + "</script></body>";
  page.replace(page.rfind("</body>"), 7, driver);
  return page;
}

/// What a driver noted under a key.
std::string noted(const std::string& dom, const std::string& key) {
  const std::string open = "data-" + key + "=\"";
  const auto begin = dom.find(open);
  if (begin == std::string::npos) return "";
  return dom.substr(begin + open.size(), dom.find('"', begin + open.size()) - begin - open.size());
}

/// The number that follows a text in a readout.
double number_behind(const std::string& readout, const std::string& text) {
  const auto at = readout.find(text);
  return at == std::string::npos ? std::nan("") : std::strtod(readout.c_str() + at + text.size(), nullptr);
}

TEST_F(Browser, ZoomsLinkedFiguresTogetherAndShowsAllAgain) {
  const std::string dom = dom_of(driven(R"(
    const before = [ticks(0), ticks(1), ticks(2)];
    drag(0, 0.4, 0.3, 0.5, 0.31);
    note('zoomed', ticks(0) !== before[0]);
    note('linked', ticks(1) !== before[1]);
    note('unlinked', ticks(2) === before[2]);
    const zoomed = ticks(1);
    drag(1, 0.5, 0.5, 0.2, 0.5, {shiftKey: true});
    note('moved', ticks(1) !== zoomed);
    fire(1, 'dblclick', 0.5, 0.5);
    note('reset', ticks(0) === before[0] && ticks(1) === before[1]);
    fire(0, 'wheel', 0.5, 0.5, {deltaY: -300, ctrlKey: true});
    note('wheel', ticks(0) !== before[0]);
  )"));
  for (const char* key : {"zoomed", "linked", "unlinked", "moved", "reset", "wheel"})
    EXPECT_EQ(noted(dom, key), "true") << key;
  EXPECT_EQ(count(dom, "data-errors=\"0\""), 1U);
}

TEST_F(Browser, LeavesThePageScrollableUntilAFigureIsClicked) {
  const std::string dom = dom_of(driven(R"(
    const before = ticks(0);
    fire(0, 'wheel', 0.5, 0.5, {deltaY: -300});
    note('untouched', ticks(0) === before);
    figures[0].querySelector('.picture').focus();
    fire(0, 'wheel', 0.5, 0.5, {deltaY: -300});
    note('active', ticks(0) !== before);
  )"));
  EXPECT_EQ(noted(dom, "untouched"), "true");
  EXPECT_EQ(noted(dom, "active"), "true");
}

TEST_F(Browser, ReadsValuesWithTheirUnits) {
  // The x axis of figure 0 runs over 0..29.999 s between pixel 70 and width - 16.
  const std::string dom = dom_of(driven(R"(
    const svg = figures[0].querySelector('svg.plot').viewBox.baseVal;
    fire(0, 'pointermove', (70 + (svg.width - 86) * 10 / 29.999) / svg.width, 0.5);
    note('readout', figures[0].querySelector('.readout').innerText.replace(/[●\s]+/g, ' ').trim());
    note('cursor', figures[1].querySelector('.cursor').getAttribute('visibility'));
    fire(2, 'pointermove', 0.5, 0.8);
    note('loop', figures[2].querySelector('.readout').innerText.replace(/[●\s]+/g, ' ').trim());
  )"));
  const std::string readout = noted(dom, "readout");
  // 10 s lies between two thinned points, at most ten rows (10 ms) apart.
  EXPECT_NEAR(number_behind(readout, "time "), 10, 0.01) << readout;
  EXPECT_NE(readout.find(" s "), std::string::npos) << readout;
  // The sine has made five full turns then: u = 30 V, simulated 0.13 um/V * 30 V; it moves by 0.0074 um per row.
  EXPECT_NEAR(number_behind(readout, "simulated "), 3.9, 0.074) << readout;
  EXPECT_NE(readout.find("measured 3."), std::string::npos) << readout;
  EXPECT_TRUE(readout.ends_with(" um")) << readout;
  EXPECT_EQ(noted(dom, "cursor"), "visible");
  const std::string loop = noted(dom, "loop");
  EXPECT_TRUE(loop.starts_with("u ")) << loop;
  EXPECT_NE(loop.find(" V "), std::string::npos) << loop;
  EXPECT_TRUE(loop.ends_with(" um")) << loop;
}

/// A table of ten columns, two of them of words, as the log of a discovery has it.
Table wide_table() {
  Table table;
  for (int i = 0; i < 10; ++i) table.columns.push_back("error, column " + std::to_string(i));
  std::vector<std::string> row(table.columns.size(), "0.000234 um (0.012 %)");
  row[0] = row[1] = "logarithmic creep of the stack behind its amplifier, from a hold of 60 s";
  table.rows = {row, row, row};
  return table;
}

TEST_F(Browser, PrintsATableOfManyColumnsWithinAPageOfA4) {
  Document document = example::discovery();
  document.sections.emplace_back().tables = {wide_table()};
  // A page of A4 less its margins of 14 mm is 182 mm = 688 px wide; the rules for paper are made to hold on the screen.
  const std::string dom = dom_of(driven(R"(
    for (const sheet of document.styleSheets)
      for (const rule of sheet.cssRules)
        if (rule instanceof CSSMediaRule && rule.conditionText === 'print') rule.media.mediaText = 'all';
    document.body.style.width = '688px';
    const tables = [...document.querySelectorAll('.table table')];
    note('tables', tables.some((t) => t.rows[0].cells.length === 10));
    note('widest', Math.max(...tables.map((t) => Math.ceil(t.getBoundingClientRect().right - document.body.getBoundingClientRect().left))));
  )",
                                        document));
  EXPECT_EQ(noted(dom, "tables"), "true");
  EXPECT_LE(number_behind(dom, "data-widest=\""), 688);
}

TEST_F(Browser, HidesACurveByItsLegend) {
  const std::string dom = dom_of(driven(R"(
    const paths = () => [...figures[0].querySelectorAll('svg.plot .curve')].filter((p) => p.getAttribute('d')).length;
    note('both', paths() === 2);
    figures[0].querySelector('.legend li').click();
    note('one', paths() === 1);
    figures[0].querySelector('.legend li').click();
    note('again', paths() === 2);
  )"));
  for (const char* key : {"both", "one", "again"}) EXPECT_EQ(noted(dom, key), "true") << key;
}

TEST_F(Browser, SavesTheNumbersOfAFigureByAClickAndByAKey) {
  const std::string dom = dom_of(driven(R"(
    const texts = [];
    URL.createObjectURL = (blob) => { texts.push(blob); return 'blob:none'; };
    HTMLAnchorElement.prototype.click = () => {};
    figures[5].querySelector('button.csv').click();
    figures[3].querySelector('.picture').dispatchEvent(new KeyboardEvent('keydown', {key: 'c', bubbles: true, cancelable: true}));
    Promise.all(texts.map((blob) => blob.text())).then(([steps, rate]) => {
      note('steps', steps.replaceAll('\n', '|').replaceAll('"', ''));
      note('rate', rate.replaceAll('\n', '|').replaceAll('"', ''));
    });
  )"));
  // Curves of one figure share their x; a gap is an empty cell.
  EXPECT_EQ(noted(dom, "steps"), "time [s],heater 1 [W],heater 2 [W]|0,0,0.000001|1,0.000001,0|2,,0|3,0.000002,0|");
  EXPECT_EQ(noted(dom, "rate"), "rate of u [V/s],mean [um]|-90,-0.3|-30,-0.2|30,0.2|90,0.3|");
}

}  // namespace
}  // namespace hysteron
