#include "app/folders/golden_list.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "app/folders/frame_folder.hpp"
#include "app/folders/kept_files.hpp"
#include "base/file.hpp"
#include "base/number.hpp"
#include "base/printable.hpp"
#include "draw/theme.hpp"

namespace lantern::app {

namespace {

constexpr std::string_view kGoldenFormat = "lantern.golden_frames/";
constexpr std::string_view kGoldenVersion = "1";

using Member = std::pair<std::string_view, std::string GoldenList::MadeWith::*>;
constexpr std::array<Member, 5> kMembers = {{{"version", &GoldenList::MadeWith::version},
                                             {"size", &GoldenList::MadeWith::size},
                                             {"theme", &GoldenList::MadeWith::theme},
                                             {"pace", &GoldenList::MadeWith::pace},
                                             {"facts", &GoldenList::MadeWith::facts}}};

bool is_hash(std::string_view word) {
  return word.size() == 16 && word.find_first_not_of("0123456789abcdef") == word.npos;
}

// The word that a line begins with, which loses it and the space behind it.
std::string_view taken_word(std::string_view& line) {
  const std::string_view word = line.substr(0, line.find(' '));
  line.remove_prefix(std::min(word.size() + 1, line.size()));
  return word;
}

// "7 1f0c6e2a... split": the frame, its pixels, and what is left of the line.
bool read_frame(std::string_view line, GoldenList& list) {
  const auto index = number_in<std::uint32_t>(taken_word(line));
  const std::string hash(taken_word(line));
  return index && is_hash(hash) &&
         list.frames.emplace(*index, GoldenList::Entry{hash, std::string(line)}).second;
}

// They are told as words to type.
bool is_right(const GoldenList::MadeWith& m) {
  const auto is_of = [](std::string_view text, std::string_view letters) {
    return text.size() <= 32 && text.find_first_not_of(letters) == text.npos;
  };
  return is_of(m.version, "0123456789.") && is_of(m.size, "0123456789x") &&
         (m.theme.empty() || theme_named(m.theme)) &&
         (m.pace.empty() || m.pace == word_for(Pace::step, kPaces) ||
          m.pace == word_for(Pace::event, kPaces)) &&
         is_of(m.facts, "lantern.frame/0123456789");
}

bool read_line(std::string_view line, GoldenList& list) {
  if (line.find(' ') == line.npos) return false;
  const std::string_view key = taken_word(line);
  if (key == "frame") return read_frame(line, list);
  for (const auto& [name, member] : kMembers)
    if (key == name && (list.made_with.*member).empty()) {
      list.made_with.*member = line;
      return is_right(list.made_with);
    }
  return false;
}

}  // namespace

std::string to_text(const GoldenList& list) {
  std::string text = fmt::format("{}{}\n", kGoldenFormat, kGoldenVersion);
  for (const auto& [name, member] : kMembers)
    text += fmt::format("{} {}\n", name, list.made_with.*member);
  for (const auto& [index, entry] : list.frames)
    text += fmt::format("frame {} {} {}\n", index, entry.pixels, printable(entry.event));
  return text;
}

std::optional<GoldenList> read_golden_list(const Folder& folder) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 28;
  const auto text = folder.read(kGoldenList, kMostBytes);
  if (!text) return std::nullopt;
  const std::string file = folder.path(kGoldenList).string();
  std::istringstream lines(*text);
  GoldenList list;
  std::string line, all;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();  // as some version control systems give it
    all += line + "\n";
    if (number == 1) {
      if (!line.starts_with(kGoldenFormat))
        throw IoError(
            fmt::format("'{}' is not Lantern's: move it, or give --dir another folder", file));
      if (line.substr(kGoldenFormat.size()) != kGoldenVersion)
        throw IoError(fmt::format("'{}' is of a later Lantern: {}", file, line));
    } else if (!read_line(line, list)) {
      throw DamagedGoldens(
          fmt::format("'{}' is damaged in line {}; --update makes it anew", file, number));
    }
  }
  for (const auto& [name, member] : kMembers)
    if ((list.made_with.*member).empty())
      throw DamagedGoldens(
          fmt::format("'{}' is damaged: no {}; --update makes it anew", file, name));
  try {
    require_as_written(all, to_text(list));
  } catch (const RefusedFile& why) {
    throw DamagedGoldens(
        fmt::format("'{}' is damaged: {}; --update makes it anew", file, why.what()));
  }
  return list;
}

}  // namespace lantern::app
