// What a bench is made of. Contestants take turns at stages, and each gives rows; of these one list
// of members (each_field) makes CSV and JSON, one list of columns the tables of terminal and page.
#pragma once

#include "base/option.hpp"
#include "measure/records.hpp"
#include "report/document.hpp"

namespace lantern::measure {

void each_field(const Contestant& one, auto&& visit) {
  visit_fields(visit, "name", one.name, "version", one.version, "how", one.how);
}

}  // namespace lantern::measure

namespace lantern::report {

// What an experiment has found, as each of its readers takes it. What is empty is not there.
struct Texts {
  std::string table;                                           // of a terminal
  std::string csv, json, html;                                 // of a file each
  std::vector<std::pair<std::string, std::string>> more = {};  // other files: a name, and a text
};

// How rows are told of. What is empty is not there.
template <class Row>
struct Sheet {
  struct Column {
    std::string name;
    std::function<std::string(const Row&)> text;
  };
  // A plot of a chapter: each row that has a point gives it to its contestant's line.
  struct Curve {
    Plot plot;  // without series
    std::function<std::optional<PlotPoint>(const Row&)> point;
  };
  std::string format;  // "lantern.bench.atlas/1"
  std::string title, about;
  std::function<void(JsonWriter&)> head, lists;  // members before and after those that all have
  std::function<std::string(const Row&)> who, chapter;
  std::function<std::string(const Row&)> stage;  // names its table; empty: a chapter has one
  std::function<std::vector<std::string>(const Row&)> words;  // of the chapter that it begins
  std::vector<Column> columns;                                // behind the contestant's name
  std::function<bool(const Row&)> has_numbers;                // or the last cell alone tells
  std::function<Cell(const Row&)> remark;                     // the last cell
  std::vector<Curve> curves;
  std::function<std::vector<Table>(const Row&)> beside;  // the table of the stage that it begins
};

template <class Row>
Table table_of(const Sheet<Row>& sheet, const std::vector<const Row*>& rows) {
  Table table;
  table.columns.push_back({"", false});
  for (const auto& column : sheet.columns) table.columns.push_back({column.name});
  table.columns.push_back({"", false});
  for (const Row* row : rows) {
    Table::Line& line = table.lines.emplace_back();
    line.who.name = sheet.who(*row);
    line.cells.emplace_back(line.who.name);
    const bool has_numbers = !sheet.has_numbers || sheet.has_numbers(*row);
    for (const auto& column : sheet.columns)
      line.cells.emplace_back(has_numbers ? column.text(*row) : "");
    line.cells.push_back(sheet.remark ? sheet.remark(*row) : Cell());
  }
  return table;
}

// A line for each contestant that has a point, in the order of the document's choices.
template <class Row>
Figure figure_of(const typename Sheet<Row>::Curve& curve, const Sheet<Row>& sheet,
                 const std::vector<const Row*>& rows, const Document& document) {
  Figure figure{curve.plot};
  for (const Choice& choice : document.choices) {
    PlotSeries series = series_of(choice);
    for (const Row* row : rows)
      if (sheet.who(*row) == choice.name)
        if (const auto point = curve.point(*row)) series.points.push_back(*point);
    if (!series.points.empty()) figure.plot.series.push_back(std::move(series));
  }
  return figure;
}

// Rows of one chapter, and of one stage, stand together.
template <class Row>
void add_chapters(const Sheet<Row>& sheet, const std::vector<Row>& rows, Document& document) {
  for (std::size_t i = 0; i < rows.size();) {
    const Row& first = rows[i];
    Chapter& chapter = document.chapters.emplace_back();
    chapter.title = sheet.chapter(first);
    if (sheet.words) chapter.words = sheet.words(first);
    std::vector<const Row*> all;
    while (i < rows.size() && sheet.chapter(rows[i]) == chapter.title) {
      const Row& begins = rows[i];
      const auto stage = [&](const Row& row) { return sheet.stage ? sheet.stage(row) : ""; };
      const std::string title = stage(begins);
      std::vector<const Row*> some;
      for (; i < rows.size() && sheet.chapter(rows[i]) == chapter.title && stage(rows[i]) == title;
           ++i)
        some.push_back(&rows[i]);
      chapter.tables.push_back(table_of(sheet, some));
      chapter.tables.back().title = title;
      if (sheet.beside)
        for (Table& table : sheet.beside(begins)) chapter.tables.push_back(std::move(table));
      all.insert(all.end(), some.begin(), some.end());
    }
    for (const auto& curve : sheet.curves) {
      Figure figure = figure_of(curve, sheet, all, document);
      if (!figure.plot.series.empty()) chapter.figures.push_back(std::move(figure));
    }
  }
}

// `Result` has circumstances, command, contestants and rows.
template <class Result, class Row>
Document document_of(const Result& result, const Sheet<Row>& sheet) {
  Document document{sheet.title, sheet.about, result.command, {result.circumstances}};
  document.choices = choices_of(result.contestants);
  document.notes = result.missing;
  Table how{"", {{"", false}, {"version", false}, {"run so", false}}};
  for (const Contestant& one : result.contestants)
    if (!one.how.empty()) how.lines.push_back({{one.name}, {one.name, one.version, one.how}});
  if (!how.lines.empty()) document.head.push_back(std::move(how));
  add_chapters(sheet, result.rows, document);
  return document;
}

template <class Result, class Row>
std::string json_of(const Result& result, const Sheet<Row>& sheet) {
  const Circumstances& c = result.circumstances;
  JsonWriter json;
  json.begin_object().line().member("format", sheet.format);
  if (sheet.head) sheet.head(json.line());
  json.line().member("command", result.command);
  json.line().member("version", c.version).member("sources", c.sources);
  json.line().member("compiler", c.compiler).member("flags", c.flags);
  json.line().member("processor", c.processor).member("date", c.date);
  write_rows("rows", result.rows, json);
  if (sheet.lists) sheet.lists(json);
  json.line().end_object();
  return json.text() + "\n";
}

template <class Result, class Row>
Texts texts_of(const Result& result, const Sheet<Row>& sheet, const Document& document) {
  const Circumstances& c = result.circumstances;
  const std::string csv = csv_of(result.rows, 0, {{"processor", c.processor}, {"date", c.date}});
  return {to_text(document), csv, json_of(result, sheet), to_html(document)};
}

std::string count_text(std::uint64_t n);  // "12 345"

// "0.95 - 1.1": from the lower to the upper quartile, in parts of which `unit` make a second.
std::string range_text(const Timing& timing, double unit);
// With a whisker along x from quartile to quartile.
PlotPoint level_point(const Timing& timing, double unit, double y);

// --- as a command runs it ---

inline Option option(const char* names, OptionTarget to, OptionTraits is, const char* help) {
  return {names, to, help, is};
}
// What several benches have.
Option only_option(const char* help, std::vector<std::string>& only);
Option peers_option(const char* help, bool& peers);
Option rounds_option(const char* help, int& rounds, double most = 10000);
Option longest_option(const char* help, std::optional<double>& longest);

// The options as they would be typed: numbers always, of the others those that were given.
std::string as_typed(const Options& options);

// A bench, a measurement, stress. What it is told is set through its options before it is prepared.
class Experiment {
 public:
  virtual ~Experiment() = default;
  virtual Options options() = 0;
  // What there is to run, table and JSON, if that alone was asked for.
  virtual Texts listing() const { return {}; }
  // Reads what the options name, so that mistakes are told before anything runs. Throws Refused and
  // what reading a file throws.
  virtual void prepare() {}
  // One that goes on where an earlier run was cut takes the JSON of its folder, if there is one,
  // and gives what it has so far; `resume` says why it does not use what it was given.
  virtual bool resumes() const { return false; }
  virtual std::string so_far() const { return ""; }
  virtual std::string resume(const std::optional<std::string>& /*earlier*/) { return ""; }
  virtual std::vector<std::string> announcement() const { return {}; }
  virtual std::string unit() const = 0;  // of stages: "sets"
  virtual std::size_t stages() const = 0;
  // `tell` is called as often as there is something to say. After Stopped what is done is kept.
  // Throws Refused for names that are none.
  virtual void run(const std::function<void(const std::string&)>& tell) = 0;
  virtual Texts texts() const = 0;
  struct Picture {
    std::string name;  // of its files, without an ending
    DrawList list;
  };
  virtual std::vector<Picture> pages() const { return {}; }
  // Which of them to project, of one that is about one thing; else empty.
  virtual std::string picture_to_show() const { return ""; }
  virtual bool is_good() const { return true; }
  virtual std::string complaint() const { return ""; }  // at the end
  virtual void set_circumstances(Circumstances circumstances, std::string command) = 0;
  // Peers that are not there: a line each.
  virtual std::vector<std::string> missing() const { return {}; }
};

}  // namespace lantern::report
