#include "report/document.hpp"

namespace lantern::report {
namespace {

// Terminal cells of a text: characters, not bytes.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::vector<std::size_t> widths_of(const Table& table) {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    std::size_t& widest = widths.emplace_back(width_of(table.columns[c].name));
    for (const Table::Line& line : table.lines)
      if (c < line.cells.size()) widest = std::max(widest, width_of(line.cells[c].text));
  }
  return widths;
}

}  // namespace

std::vector<Table::Column> columns_of(std::initializer_list<std::string> names) {
  std::vector<Table::Column> columns;
  for (const std::string& name : names) {
    const bool is_words = name.ends_with('|');
    columns.push_back({name.substr(0, name.size() - is_words), !is_words});
  }
  return columns;
}

char machine_letter(std::size_t machine) { return static_cast<char>('A' + machine % 26); }

std::vector<Choice> choices_of(const std::vector<Contestant>& contestants) {
  std::vector<Choice> choices;
  for (const bool peers : {false, true}) {
    int look = peers ? kFirstPeerLook : 0;
    for (const Contestant& one : contestants)
      if (one.is_peer() == peers) choices.push_back({one.name, {look++, peers, 0}, one.name});
  }
  return choices;
}

PlotSeries series_of(const Choice& choice) {
  return {choice.name, {}, choice.ink.look, choice.ink.is_peer};
}

std::string folded(const std::string& text) {
  constexpr std::size_t kLineWidth = 100;
  std::string out, row;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find(' ', from), text.size());
    const std::string word = text.substr(from, to - from);
    if (!row.empty() && width_of(row) + 1 + width_of(word) > kLineWidth) {
      out += row + "\n";
      row.clear();
    }
    row += (row.empty() ? "" : " ") + word;
    from = to + 1;
  }
  return out + row + "\n";
}

std::string to_text(const Table& table) {
  const std::vector<std::size_t> widths = widths_of(table);
  std::string text = table.title.empty() ? "" : table.title + "\n";
  const auto add = [&](const auto& cell_of) {
    std::string line = " ";
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const std::string cell = cell_of(c);
      const std::string gap(widths[c] - width_of(cell), ' ');
      line += table.columns[c].is_number ? "  " + gap + cell : (c > 0 ? "  " : " ") + cell + gap;
    }
    text += line.erase(line.find_last_not_of(' ') + 1) + "\n";
  };
  add([&](std::size_t c) { return table.columns[c].name; });
  for (const Table::Line& line : table.lines)
    add([&](std::size_t c) { return c < line.cells.size() ? line.cells[c].text : ""; });
  return text;
}

std::string to_text(const Document& document) {
  std::string text = document.about.empty() ? "" : folded(document.about);
  for (const Circumstances& c : document.machines)
    text += folded(fmt::format("{}: {}; {}", c.date, c.processor, c.compiler));
  for (const std::string& note : document.notes) text += folded(note);
  for (const Chapter& chapter : document.chapters) {
    if (!chapter.title.empty()) text += (text.empty() ? "" : "\n") + chapter.title + "\n";
    for (const std::string& words : chapter.words) text += folded(words);
    for (const Table& table : chapter.tables)
      if (!table.folded && !table.lines.empty()) text += to_text(table);
    for (const std::string& note : chapter.notes) text += folded(note);
  }
  return text;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

std::string seconds_text(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  const double size = std::abs(seconds);
  if (size >= 1 || size == 0) return fmt::format("{:.3g} s", seconds);
  if (size >= 0.9995e-4) return fmt::format("{:.3g} ms", seconds * 1e3);
  if (size >= 0.9995e-7) return fmt::format("{:.3g} µs", seconds * 1e6);
  return fmt::format("{:.3g} ns", seconds * 1e9);
}

std::string figure(double number) {
  if (!std::isfinite(number)) return "?";
  const double size = std::abs(number);
  if (size == 0) return "0";
  if (size >= 0.9995e-3 && size < 1e9) {
    if (size >= 999.5) return grouped(std::llround(number));
    return fmt::format("{:.3g}", number);
  }
  std::string text = fmt::format("{:.2e}", number);
  const std::size_t e = text.find('e');
  std::string lead = text.substr(0, e);
  while (lead.back() == '0') lead.pop_back();
  if (lead.back() == '.') lead.pop_back();
  return fmt::format("{}e{}", lead, std::stoi(text.substr(e + 1)));
}

}  // namespace lantern::report
