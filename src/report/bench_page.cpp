#include "report/bench_page.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/markup.hpp"
#include "report/html_plot.hpp"
#include "report/html_style.hpp"

namespace lantern::report {

BenchPage::BenchPage(BenchPageHead head, std::vector<BenchContestant> contestants)
    : head_(std::move(head)), contestants_(std::move(contestants)) {}

std::size_t BenchPage::number_of(const std::string& contestant) const {
  const auto at = std::ranges::find(contestants_, contestant, &BenchContestant::name);
  LANTERN_CHECK((at != contestants_.end()), ==, true);
  return static_cast<std::size_t>(at - contestants_.begin());
}

PlotSeries BenchPage::series_of(const std::string& contestant) const {
  const std::size_t number = number_of(contestant);
  PlotSeries series;
  series.name = contestant;
  series.is_peer = contestants_[number].is_peer();
  const auto of_its_kind = std::count_if(
      contestants_.begin(), contestants_.begin() + static_cast<std::ptrdiff_t>(number),
      [&](const BenchContestant& c) { return c.is_peer() == series.is_peer; });
  series.look = static_cast<int>(of_its_kind) + (series.is_peer ? kFirstPeerLook : 0);
  return series;
}

void BenchPage::end_plots() {
  if (std::exchange(in_plots_, false)) body_ += "</div>\n";
}

void BenchPage::begin_section(const std::string& title, const std::string& words) {
  end_plots();
  if (std::exchange(in_section_, true)) body_ += "</section>\n";
  body_ += fmt::format("<section><h2>{}</h2>\n<p>{}</p>\n", escaped(title), escaped(words));
}

void BenchPage::add_plot(const Plot& plot) {
  if (!std::exchange(in_plots_, true)) body_ += "<div class=\"plots\">\n";
  std::vector<std::string> classes;
  for (const PlotSeries& series : plot.series)
    classes.push_back(fmt::format("m{}", number_of(series.name)));
  body_ += fmt::format("<figure><figcaption><b>{}</b><br>{}</figcaption>\n{}</figure>\n",
                       escaped(plot.title), escaped(plot.y_name), svg_plot(plot, classes));
}

void BenchPage::add_table(const std::vector<std::string>& columns,
                          const std::vector<std::vector<BenchCell>>& rows) {
  end_plots();
  body_ += "<div class=\"wide\"><table><thead><tr>";
  for (std::size_t i = 0; i < columns.size(); ++i)
    body_ += fmt::format("<th{}>{}</th>", i > 0 ? " class=\"n\"" : "", escaped(columns[i]));
  body_ += "</tr></thead><tbody>\n";
  for (const std::vector<BenchCell>& row : rows) {
    body_ += fmt::format("<tr class=\"m{}\">", number_of(row.at(0).text));
    for (std::size_t i = 0; i < row.size(); ++i)
      body_ += fmt::format("<td class=\"{}{}\">{}</td>", i > 0 ? "n" : "", row[i].bad ? " bad" : "",
                           escaped(row[i].text));
    body_ += "</tr>\n";
  }
  body_ += "</tbody></table></div>\n";
}

std::string BenchPage::head_text() const {
  const Circumstances& c = head_.circumstances;
  std::string text = fmt::format(
      "<h1>{}</h1>\n<p>{}</p>\n<h3>How it was run</h3>\n<p><code>{}</code></p>\n<p class=\"quiet\">"
      "Lantern {}, sources {}; {}; {}; {}</p>\n",
      escaped(head_.title), escaped(head_.about), escaped(head_.command), escaped(c.version),
      escaped(c.sources), escaped(c.compiler), escaped(c.flags), escaped(c.processor));
  text += "<ul>\n";
  for (const BenchContestant& one : contestants_)
    if (!one.how.empty())
      text += fmt::format("<li><b>{}</b>{}: {}</li>\n", escaped(one.name),
                          one.is_peer() ? " " + escaped(one.version) : "", escaped(one.how));
  return text + "</ul>\n";
}

std::string BenchPage::text() const {
  std::string rules, choices;
  for (const bool peers : {false, true}) {
    if (std::ranges::none_of(contestants_,
                             [&](const BenchContestant& c) { return c.is_peer() == peers; }))
      continue;
    choices += fmt::format("<fieldset><legend>{}</legend>\n", peers ? "Others" : "Lantern");
    for (std::size_t i = 0; i < contestants_.size(); ++i) {
      if (contestants_[i].is_peer() != peers) continue;
      rules += fmt::format(":root:has(#m{0}:not(:checked)) .m{0}{{display:none}}\n", i);
      choices += fmt::format(
          "<label><input type=\"checkbox\" name=\"method\" id=\"m{}\"{} checked>{}{}</label>\n", i,
          peers ? " data-peer=\"1\"" : "", svg_sample(series_of(contestants_[i].name).ink()),
          escaped(contestants_[i].name));
    }
    choices += "</fieldset>\n";
  }
  return fmt::format(
      "{}<div class=\"page\">\n<form class=\"side\" aria-label=\"What is shown\">\n"
      "<div id=\"buttons\"></div>{}</form>\n<main>\n{}{}{}{}</main></div>\n"
      "<script>{}</script>\n</body></html>\n",
      html_begin(head_.title, rules), choices, head_text(), body_, in_plots_ ? "</div>\n" : "",
      in_section_ ? "</section>\n" : "", kPageScript);
}

}  // namespace lantern::report
