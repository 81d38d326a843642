// A document as a web page.
#include <charconv>
#include <iterator>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/printable.hpp"
#include "draw/theme.hpp"
#include "report/document.hpp"

namespace lantern::report {
namespace {

std::string color_of(Role role) { return fmt::format("var(--r{})", static_cast<int>(role)); }

std::string paint(Role fill, const Stroke& stroke) {
  std::string text =
      fmt::format(" fill=\"{}\"", fill == Role::none ? std::string("none") : color_of(fill));
  if (stroke.role == Role::none || !(stroke.width > 0)) return text;
  text +=
      fmt::format(" stroke=\"{}\" stroke-width=\"{:.1f}\"", color_of(stroke.role), stroke.width);
  if (stroke.dash > 0) text += fmt::format(" stroke-dasharray=\"{:.1f}\"", stroke.dash);
  return text;
}

std::string to_tag(const RectShape& s) {
  const Vec<2> size = s.box.size();
  return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"{}{}/>",
                     s.box.lo.x, s.box.lo.y, size.x, size.y,
                     s.radius > 0 ? fmt::format(" rx=\"{:.1f}\"", s.radius) : "",
                     paint(s.fill, s.stroke));
}
std::string to_tag(const LineShape& s) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"{}/>", s.from.x,
                     s.from.y, s.to.x, s.to.y, paint(Role::none, s.stroke));
}
std::string to_tag(const PolygonShape& s) {
  std::string points;
  for (const Vec<2>& p : s.points)
    points += fmt::format("{}{:.1f},{:.1f}", points.empty() ? "" : " ", p.x, p.y);
  return fmt::format("<polygon points=\"{}\"{}/>", points, paint(s.fill, s.stroke));
}
std::string to_tag(const TextShape& s) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.1f}\" text-anchor=\"{}\" "
      "fill=\"{}\">{}</text>",
      s.at.x, s.at.y, s.size,
      s.align == 0   ? "start"
      : s.align == 1 ? "end"
                     : "middle",
      color_of(s.role), escaped(s.text));
}
std::string to_tag(const DrawShape& shape) {
  return std::visit([](const auto& s) { return to_tag(s); }, shape);
}

// What of a plot a shape is of, by its key.
struct Part {
  std::optional<std::size_t> series, point;
  bool is_whisker = false;
  bool operator==(const Part&) const = default;
};

Part part_of(const std::string& key) {
  constexpr std::string_view kSeries = "series/";
  Part part;
  if (!key.starts_with(kSeries)) return part;
  const char* const end = key.data() + key.size();
  std::size_t number = 0;
  const char* at = std::from_chars(key.data() + kSeries.size(), end, number).ptr;
  part.series = number;
  if (at == end) return part;
  part.is_whisker = std::from_chars(at + 1, end, number).ec != std::errc();
  if (!part.is_whisker) part.point = number;
  return part;
}

class HtmlText {
 protected:
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }

  std::string out_;
};

class PlotWriter : HtmlText {
 public:
  PlotWriter(const Plot& plot, const std::vector<std::string>& classes)
      : plot_(plot), classes_(classes) {}

  std::string text() {
    DrawList list = drawn();
    put("<svg class=\"plot\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">",
        list.page.x, list.page.y, escaped(plot_.title));
    Part open;
    std::size_t run = 0;
    for (std::size_t i = 0; i < list.shapes.size(); ++i) {
      while (run < list.runs.size() && list.runs[run].first <= i) ++run;
      const Part part = run > 0 ? part_of(list.runs[run - 1].key) : Part();
      if (part != open) {
        close(open);
        begin(part);
        open = part;
      }
      out_ += to_tag(list.shapes[i]);
    }
    close(open);
    return out_ + "</svg>\n";
  }

 private:
  DrawList drawn() const {
    Plot plot = plot_;
    plot.title.clear();
    plot.y_name.clear();
    plot.slopes.clear();
    plot.names = PlotNames::none;
    plot.size = 15;
    DrawList list;
    list.page = {620, 400};
    Labels labels(list);
    draw_plot(plot, shrunk({Vec<2>(0.0), list.page}, 2), list, labels);
    return list;
  }

  void begin(const Part& part) {
    if (!part.series) return;
    const PlotSeries& series = plot_.series[*part.series];
    put("<g class=\"{}{}\" style=\"--c:{}\">", classes_[*part.series],
        series.is_peer ? " peer" : "", color_of(series.ink().role()));
    if (part.is_whisker) put("<g class=\"whisker\">");
    if (!part.point) return;
    const PlotPoint& p = series.points[*part.point];
    put("<g class=\"{}\"><title>{}: {}; {}</title>", p.beyond || p.open ? "open" : "mark",
        escaped(series.name), figure(p.at.x), p.beyond ? escaped(plot_.beyond) : figure(p.at.y));
  }
  void close(const Part& part) {
    if (part.series) out_ += part.point || part.is_whisker ? "</g></g>" : "</g>";
  }

  const Plot& plot_;
  const std::vector<std::string>& classes_;
};

constexpr std::string_view kPageStyle = R"css(
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,sans-serif}
.page{display:grid;grid-template-columns:19rem minmax(0,1fr);gap:2.5rem;max-width:110rem;margin:0 auto;padding:1.5rem 2rem}
.side{position:sticky;top:0;align-self:start;max-height:100vh;overflow:auto;padding:1rem 0;font-size:.9rem}
h1{margin:0;font-size:1.7rem}h2{margin:0 0 .4rem;font-size:1.3rem}h3{margin:1rem 0 .3rem;font-size:1rem}
section{border-top:1px solid var(--rule);padding:1.6rem 0;scroll-margin-top:.5rem}
p{margin:.3rem 0;max-width:80ch}.quiet,figcaption,caption{color:var(--quiet)}
a{color:inherit}fieldset{border:0;margin:0 0 .8rem;padding:0}legend{font-weight:600;padding:0}
label{display:flex;gap:.4rem;align-items:center;padding:.08rem 0;cursor:pointer}
label .sample{flex:none}button{font:inherit;margin:0 .3rem .3rem 0}
:focus-visible{outline:2px solid var(--b4);outline-offset:2px}
.index{columns:3 14rem;padding:0;list-style:none;margin:.5rem 0 0}.index li{break-inside:avoid}
.plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(27rem,100%),1fr));gap:1rem 2rem;margin:1rem 0 .5rem}
figure{margin:0}figcaption{font-size:.85rem}figcaption b{color:var(--ink);font-size:1rem}
.plot{display:block;width:100%;height:auto;font-family:system-ui,sans-serif}
.whisker{opacity:.45}.k1 .mark *{fill:var(--panel);stroke:var(--c);stroke-width:1.8}.k1 line{stroke-width:1}
.sample{width:34px;height:14px}
.wide{overflow-x:auto}table{border-collapse:collapse;font-size:.88rem;margin:.4rem 0}caption{text-align:left}
th,td{padding:.15rem .7rem .15rem 0;text-align:left;vertical-align:top}td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
thead th{border-bottom:1px solid var(--ink);font-weight:600}tbody tr{border-bottom:1px solid var(--rule)}
.bad{color:var(--warning);font-weight:600}summary{cursor:pointer;margin:.4rem 0}
@media(max-width:60rem){.page{grid-template-columns:minmax(0,1fr);padding:1rem}.side{position:static;max-height:none}}
@media print{.side,summary,button{display:none}.page{display:block;padding:0}section{break-inside:avoid-page}body{font-size:10pt}}
)css";

// Buttons that choose for all boxes at once; made here, since without a script they would be dead.
constexpr std::string_view kPageScript = R"js(
const place=document.getElementById('buttons');
const boxes=[...document.querySelectorAll('input[name=method]')];
for(const [words,wanted] of [['All',()=>true],['None',()=>false],['Lantern only',b=>!b.dataset.peer]]){
const button=document.createElement('button');button.type='button';button.textContent=words;
button.onclick=()=>boxes.forEach(b=>{b.checked=wanted(b)});place.append(button);}
)js";

// The variables of a theme's colours, which the plots below are painted with: "--r3:#a0b1c2;...".
std::string web_colors(std::string_view name) {
  const Theme theme = *theme_named(name);
  std::string text;
  for (std::size_t role = 1; role < theme.colors.size(); ++role) {
    const Color& c = theme.colors[role];
    text += fmt::format("--r{}:#{:02x}{:02x}{:02x};", role, c.r, c.g, c.b);
  }
  return text;
}

// A sample of the series' line and mark, for a legend.
std::string web_sample(const PlotInk& ink) {
  DrawList list;
  draw_plot_line(ink, {1, 7}, {33, 7}, 2, list);
  draw_plot_mark(ink, {17, 7}, 4.6, false, list);
  std::string text = "<svg class=\"sample\" viewBox=\"0 0 34 14\" aria-hidden=\"true\">";
  for (const DrawShape& shape : list.shapes) text += to_tag(shape);
  return text + "</svg>";
}

// The colours that the style names, by what they are for.
std::string named_colors() {
  constexpr std::pair<std::string_view, Role> kNamed[] = {
      {"paper", Role::paper}, {"panel", Role::panel},     {"ink", Role::ink},
      {"rule", Role::rule},   {"quiet", Role::quiet_ink}, {"warning", Role::warning},
      {"b4", body_role(4)}};
  std::string text;
  for (const auto& [name, role] : kNamed)
    text += fmt::format("--{}:var(--r{});", name, static_cast<int>(role));
  return text;
}

class WebPage : HtmlText {
 public:
  explicit WebPage(const Document& document) : document_(document) {}

  std::string text() {
    add_head();
    for (std::size_t i = 0; i < document_.chapters.size(); ++i)
      add(document_.chapters[i], fmt::format("p{}", i));
    const std::string body = std::exchange(out_, "");
    put("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<meta name=\"viewport\" content=\"width=device-width\"><title>{}</title>"
        "\n<style>:root{{color-scheme:light dark;{}{}}}@media(prefers-color-scheme:dark)"
        "{{:root{{{}}}}}@media print{{:root{{{}}}}}{}",
        escaped(document_.title), web_colors("light"), named_colors(), web_colors("dark"),
        web_colors("print"), kPageStyle);
    add_hiding_rules();
    put("</style></head>\n<body>\n<div class=\"page\">\n");
    add_choices();
    put("<main>\n{}</main></div>\n<script>{}</script>\n</body></html>\n", body, kPageScript);
    return std::move(out_);
  }

 private:
  bool is_shared() const { return document_.machines.size() > 1; }
  static std::string machine_name(std::size_t machine) {
    return fmt::format("Machine {}", machine_letter(machine));
  }

  std::size_t number_of(const std::string& name) const {
    const auto at = std::ranges::find(document_.choices, name, &Choice::name);
    LANTERN_CHECK((at != document_.choices.end()), ==, true);
    return static_cast<std::size_t>(at - document_.choices.begin());
  }
  // "m3", or "m3 k1" if there are several machines: what the choices hide.
  std::string class_of(const Who& who) const {
    if (who.name.empty()) return "";
    const std::string name = fmt::format("m{}", number_of(who.name));
    return is_shared() ? fmt::format("{} k{}", name, who.machine) : name;
  }

  // As the choices have it, beside its mark.
  std::string name_of(const std::string& name) const {
    const Choice& choice = document_.choices[number_of(name)];
    return web_sample(choice.ink) + escaped(choice.words);
  }

  // What is not chosen is hidden by the style sheet alone.
  void add_hiding_rules() {
    const auto hide = [this](char kind, std::size_t count) {
      for (std::size_t i = 0; i < count; ++i)
        put(":root:has(#{0}{1}:not(:checked)) .{0}{1}{{display:none}}\n", kind, i);
    };
    hide('m', document_.choices.size());
    if (is_shared()) hide('k', document_.machines.size());
  }

  void add_choices() {
    put("<form class=\"side\" aria-label=\"What is shown\">\n<div id=\"buttons\"></div>");
    for (const bool peers : {false, true}) {
      const auto& all = document_.choices;
      if (std::ranges::none_of(all, [&](const Choice& c) { return c.ink.is_peer == peers; }))
        continue;
      put("<fieldset><legend>{}</legend>\n",
          peers ? document_.legends.second : document_.legends.first);
      for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].ink.is_peer == peers)
          put("<label><input type=\"checkbox\" name=\"method\" id=\"m{}\"{} checked>{}{}</label>\n",
              i, peers ? " data-peer=\"1\"" : "", web_sample(all[i].ink), escaped(all[i].words));
      put("</fieldset>\n");
    }
    if (is_shared()) {
      put("<fieldset><legend>Machines</legend>\n");
      for (std::size_t i = 0; i < document_.machines.size(); ++i)
        put("<label><input type=\"checkbox\" id=\"k{}\" checked>{}: {}{}</label>\n", i,
            machine_name(i), escaped(document_.machines[i].processor),
            i > 0 ? " (hollow marks)" : "");
      put("</fieldset>\n");
    }
    put("</form>\n");
  }

  void add_head() {
    put("<h1>{}</h1>\n<p>{}</p>\n<h3>How it was run</h3>\n", escaped(document_.title),
        escaped(document_.about));
    if (!document_.command.empty()) put("<p><code>{}</code></p>\n", escaped(document_.command));
    add_machines();
    for (const std::string& note : document_.notes)
      put("<p class=\"quiet\">{}</p>\n", escaped(note));
    for (const Table& table : document_.head) add(table, false);
    if (document_.chapters.size() < 2) return;
    put("<nav aria-label=\"Chapters\"><ul class=\"index\">\n");
    for (std::size_t i = 0; i < document_.chapters.size(); ++i)
      put("<li><a href=\"#p{}\">{}</a></li>\n", i, escaped(document_.chapters[i].title));
    put("</ul></nav>\n");
  }

  void add_machines() {
    put("<div class=\"wide\"><table><thead><tr><th></th>");
    for (const char* name : {"Lantern", "sources", "compiler", "flags", "processor", "cores",
                             "load", "date", "effort"})
      put("<th>{}</th>", name);
    put("</tr></thead><tbody>\n");
    for (std::size_t i = 0; i < document_.machines.size(); ++i) {
      const Circumstances& c = document_.machines[i];
      put("<tr{}><th>{}</th>", is_shared() ? fmt::format(" class=\"k{}\"", i) : "",
          is_shared() ? machine_name(i) : "");
      const std::string cores = fmt::format("{}", c.cores),
                        load = fmt::format("{:.1f} to {:.1f}", c.load_at_start, c.load_at_end);
      for (const std::string& cell :
           {c.version, c.sources, c.compiler, c.flags, c.processor, cores, load, c.date, c.effort})
        put("<td>{}</td>", escaped(cell));
      put("</tr>\n");
    }
    put("</tbody></table></div>\n");
  }

  void add(const Chapter& chapter, const std::string& id) {
    put("<section id=\"{}\"><h2>{}</h2>\n", id, escaped(chapter.title));
    for (const std::string& words : chapter.words) put("<p>{}</p>\n", escaped(words));
    for (const std::string& note : chapter.notes) put("<p class=\"quiet\">{}</p>\n", escaped(note));
    if (!chapter.figures.empty()) {
      put("<div class=\"plots\">\n");
      for (const Figure& figure : chapter.figures) add(figure);
      put("</div>\n");
    }
    for (const Table& table : chapter.tables) add(table, is_shared());
    put("</section>\n");
  }

  void add(const Figure& figure) {
    const Plot& plot = figure.plot;
    std::vector<std::string> classes;
    for (std::size_t i = 0; i < plot.series.size(); ++i)
      classes.push_back(class_of(figure.of.empty() ? Who{plot.series[i].name} : figure.of[i]));
    put("<figure><figcaption><b>{}</b>{}<br>{}</figcaption>\n{}</figure>\n", escaped(plot.title),
        escaped(figure.note), escaped(plot.y_name), web_plot(plot, classes));
  }

  // With a first column of the machines, if there are several.
  void add(const Table& table, bool with_machines) {
    if (table.folded) put("<details><summary>{}</summary>", escaped(table.title));
    put("<div class=\"wide\"><table>{}<thead><tr>",
        table.folded || table.title.empty()
            ? ""
            : fmt::format("<caption>{}</caption>", escaped(table.title)));
    if (with_machines) put("<th>machine</th>");
    for (const Table::Column& column : table.columns)
      put("<th class=\"{}{}\">{}</th>", column.is_number ? "n " : "", class_of(column.who),
          escaped(column.name));
    put("</tr></thead><tbody>\n");
    for (const Table::Line& line : table.lines) add(line, table.columns, with_machines);
    put("</tbody></table></div>{}\n", table.folded ? "</details>" : "");
  }

  void add(const Table::Line& line, const std::vector<Table::Column>& columns, bool with_machines) {
    put("<tr class=\"{}\">", class_of(line.who));
    if (with_machines) put("<td>{}</td>", machine_letter(line.who.machine));
    for (std::size_t i = 0; i < line.cells.size(); ++i) {
      const Cell& cell = line.cells[i];
      const Table::Column& column = columns[i];
      const bool is_name = i == 0 && !line.who.name.empty();
      const std::string text = is_name ? name_of(line.who.name) : escaped(cell.text);
      put("<td class=\"{}{}\">{}</td>", column.is_number ? "n " : "", class_of(column.who),
          cell.bad ? fmt::format("<span class=\"bad\">{}</span>", text) : text);
    }
    put("</tr>\n");
  }

  const Document& document_;
};

}  // namespace

std::string web_plot(const Plot& plot, const std::vector<std::string>& classes) {
  return PlotWriter(plot, classes).text();
}

std::string to_html(const Document& document) { return WebPage(document).text(); }

}  // namespace lantern::report
