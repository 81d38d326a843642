#include "fuzz/document.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace lantern::fuzz {
namespace {

std::string_view trimmed(std::string_view s) {
  const std::size_t first = s.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r") - first + 1);
}

// How many brackets a line leaves open; those in strings do not count.
int brackets_opened(std::string_view line) {
  int open = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (in_text && c == '\\') ++i;
    if (c == '"') in_text = !in_text;
    if (in_text) continue;
    if (c == '#') break;
    open += (c == '[' || c == '{') - (c == ']' || c == '}');
  }
  return open;
}

int lines_of(const Entry& entry) {
  return 1 + static_cast<int>(std::count(entry.value.begin(), entry.value.end(), '\n'));
}

}  // namespace

std::string Block::name() const {
  const std::size_t first = header.find_first_not_of('[');
  if (first == std::string::npos) return {};
  return header.substr(first, header.find(']') - first);
}

const Entry* Block::find(std::string_view key) const {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

std::string_view Block::value(std::string_view key) const {
  const Entry* entry = find(key);
  return entry ? std::string_view(entry->value) : std::string_view();
}

std::string Document::text() const {
  std::string text;
  for (const Block& block : blocks) {
    if (!block.header.empty()) text += block.header + "\n";
    for (const Entry& entry : block.entries) text += entry.key + " = " + entry.value + "\n";
  }
  return text;
}

Document::Spot Document::at_line(int line) const {
  int next = 1;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (!blocks[b].header.empty() && next++ == line) return {static_cast<int>(b), -1};
    for (std::size_t e = 0; e < blocks[b].entries.size(); ++e) {
      next += lines_of(blocks[b].entries[e]);
      if (next > line) return {static_cast<int>(b), static_cast<int>(e)};
    }
  }
  return {};
}

Document document_of(std::string_view text) {
  Document document;
  document.blocks.emplace_back();
  int open = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    std::vector<Entry>& entries = document.blocks.back().entries;
    if (open > 0 && !entries.empty()) {
      entries.back().value += "\n" + std::string(line);
      open += brackets_opened(line);
      continue;
    }
    open = 0;
    if (line.empty() || line.front() == '#') continue;
    const std::size_t equals = line.find('=');
    if (line.front() == '[') {
      document.blocks.push_back({std::string(line.substr(0, line.rfind(']') + 1)), {}});
    } else if (equals != std::string_view::npos) {
      const std::string_view value = trimmed(line.substr(equals + 1));
      entries.push_back({std::string(trimmed(line.substr(0, equals))), std::string(value)});
      open = brackets_opened(value);
    }
  }
  return document;
}

const TableDoc* table_of(const Block& block) {
  const std::string name = block.name();
  if (name == "step") {
    const std::vector<std::string> verb = texts_in(block.value("do"));
    for (const TableDoc& table : language_verbs())
      if (!verb.empty() && table.name == verb[0]) return &table;
  }
  for (const TableDoc& table : language_tables())
    if (table.name == name) return &table;
  return nullptr;
}

std::string in_toml(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

std::vector<std::string> texts_in(std::string_view value) {
  std::vector<std::string> texts;
  while (true) {
    const std::size_t first = value.find('"');
    const std::size_t last = first == value.npos ? value.npos : value.find('"', first + 1);
    if (last == value.npos) return texts;
    texts.emplace_back(value.substr(first + 1, last - first - 1));
    value.remove_prefix(last + 1);
  }
}

}  // namespace lantern::fuzz
