// What a command of the lab tells of its measurements: tables, plots and words as values. The
// terminal and the web page are written from the same ones.
#pragma once

#include "draw/plot.hpp"
#include "measure/row.hpp"

namespace lantern::report {

struct Cell {
  Cell(std::string words = "", bool is_bad = false) : text(std::move(words)), bad(is_bad) {}
  Cell(const char* words) : text(words) {}

  std::string text;
  bool bad = false;  // stressed
};

// One contestant, if several machines measured it on one of them.
struct Who {
  std::string name;         // of nobody: empty
  std::size_t machine = 0;  // of Document::machines
};

struct Table {
  struct Column {
    std::string name;
    bool is_number = true;  // at the right
    Who who = {};           // whose numbers alone stand in it
  };
  struct Line {
    Who who;
    std::vector<Cell> cells;
  };
  std::string title;
  std::vector<Column> columns;
  std::vector<Line> lines = {};
  bool folded = false;  // on a page until somebody asks; on a terminal it is left out
};

struct Figure {
  draw::Plot plot;
  std::vector<Who> of = {};  // of each series; empty: their names are those of contestants
  std::string note = {};     // behind the title
};

struct Chapter {
  std::string title;
  std::vector<std::string> words;  // a paragraph each
  std::vector<Figure> figures;     // a page alone has them
  std::vector<Table> tables;
  std::vector<std::string> notes = {};  // small, before the figures
};

// Whose rows and series a reader of the page may hide.
struct Choice {
  std::string name;
  draw::PlotInk ink;
  std::string words;  // that name it on the page
};

struct Document {
  std::string title, about, command;
  std::vector<Circumstances> machines;
  std::vector<Choice> choices = {};
  std::pair<std::string, std::string> legends = {"Lantern", "Others"};  // of ours, and of peers
  std::vector<std::string> notes = {};                                  // of how it was run
  std::vector<Table> head = {};
  std::vector<Chapter> chapters = {};
};

// Columns of numbers, but for those whose names end in a "|": these are of words.
std::vector<Table::Column> columns_of(std::initializer_list<std::string> names);

// 'A', 'B', ...
char machine_letter(std::size_t machine);

// Contestants as choices: ours have looks from 0 on, peers those of crosses and stars.
std::vector<Choice> choices_of(const std::vector<Contestant>& contestants);

// A line of a contestant in a plot, without points: its look is the same in every plot.
draw::PlotSeries series_of(const Choice& choice);

// Lines of at most 100 cells of a terminal, broken at spaces.
std::string folded(const std::string& text);

// For a terminal: columns as wide as they need, the first and those of words at the left.
std::string to_text(const Table& table);
std::string to_text(const Document& document);

// A page that stands alone: how all was run, contestants and machines to be shown or hidden, and
// the chapters with their plots and tables. Without network, fonts or libraries; without scripts
// all is shown and everything but the three buttons works. The same document gives the same bytes.
std::string to_html(const Document& document);

// Numbers and names as reports write them.

// "12 s", "0.8 ms", "41 µs".
std::string seconds_text(double seconds);
// "1e-6", "3.2e-9", "0.012": three figures, as one types them.
std::string figure(double number);

// "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& names);

// Plots in a web page: what draw_plot draws, with colours by style sheet, and each series in a
// group of its own class, so that a reader can choose what to see.

// The plot without its title and the name of y, which the page writes. `classes` has one class list
// for each of its series. Runs that failed are open marks at the upper edge, errors of 0 on a strip
// below a logarithmic scale, spreads whiskers. Slopes, which the series' names tell, are left out.
// Every mark has a title with its numbers.
std::string web_plot(const Plot& plot, const std::vector<std::string>& classes);

}  // namespace lantern::report
