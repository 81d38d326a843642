#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/printable.hpp"
#include "embedded/lesson_files.hpp"
#include "publish/lesson.hpp"
#include "publish/packed.hpp"

namespace lantern::publish {
namespace {

constexpr std::string_view kIndexMark =
    "<meta name=\"generator\" content=\"Lantern lesson index\">";
constexpr const char* kIndex = "index.html";
constexpr std::size_t kMostPage = std::size_t{256} << 20;

struct Listed {
  std::string file;
  LessonCard card;
  std::string picture;  // a data URL
};

// What stands between two texts; nothing if they are not there.
std::optional<std::string_view> between_marks(std::string_view text, std::string_view from,
                                              std::string_view to) {
  const std::size_t start = text.find(from);
  if (start == text.npos) return std::nullopt;
  const std::size_t begin = start + from.size(), end = text.find(to, begin);
  if (end == text.npos) return std::nullopt;
  return text.substr(begin, end - begin);
}

// A page of ours, or nothing.
std::optional<Listed> listed(const Folder& folder, const std::string& file) {
  const std::string page = folder.read(file, kMostPage).value_or("");
  const auto json =
      between_marks(page, "<script type=\"application/json\" id=\"card\">", "</script>");
  const auto picture = between_marks(page, "<template id=\"cover\"><img src=\"", "\"");
  if (!json || !picture) return std::nullopt;
  auto card = lesson_card(*json);
  if (!card) return std::nullopt;
  return Listed{file, std::move(*card), std::string(*picture)};
}

std::vector<Listed> lessons_in(const Folder& folder) {
  std::vector<Listed> lessons;
  for (const std::string& name : folder.names()) {
    if (!name.ends_with(".html") || name == kIndex || !folder.has_file(name)) continue;
    if (auto lesson = listed(folder, name)) lessons.push_back(std::move(*lesson));
  }
  std::ranges::sort(lessons, [](const Listed& a, const Listed& b) {
    if (a.card.lecture.has_value() != b.card.lecture.has_value()) return a.card.lecture.has_value();
    return std::tie(a.card.lecture, a.card.scenario, a.file) <
           std::tie(b.card.lecture, b.card.scenario, b.file);
  });
  return lessons;
}

// A file's name as a relative URL.
std::string url_of(std::string_view file) {
  std::string url;
  for (const char c : file) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_' || c == '.';
    url += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return url;
}

std::string link_to(const std::string& file, std::string_view words) {
  return fmt::format("<a href=\"{}\">{}</a>", url_of(file), escaped(words));
}

// The lessons to be seen before, linked where they stand in the folder.
std::string needs_of(const Listed& lesson, const std::map<std::string, const Listed*>& by_name) {
  std::string text;
  for (const std::string& name : lesson.card.needs) {
    const auto found = by_name.find(name);
    text += text.empty() ? "<p class=\"needs\">after " : ", ";
    text += found == by_name.end() ? escaped(name)
                                   : link_to(found->second->file, found->second->card.title);
  }
  return text.empty() ? "" : text + "</p>\n";
}

std::string entry_of(const Listed& lesson, const std::map<std::string, const Listed*>& by_name) {
  const LessonCard& card = lesson.card;
  const std::string number = card.lecture ? fmt::format("<b>{}</b> ", *card.lecture) : "";
  return fmt::format(
      "<li>\n<a class=\"picture\" href=\"{}\" tabindex=\"-1\" aria-hidden=\"true\">"
      "<img src=\"{}\" alt=\"\" loading=\"lazy\"></a>\n<h2>{}{}</h2>\n<p class=\"idea\">{}</p>\n{}"
      "{}<p class=\"length\">{} step{}</p>\n</li>\n",
      url_of(lesson.file), lesson.picture, number, link_to(lesson.file, card.title),
      escaped(card.idea), needs_of(lesson, by_name), question_list(card, url_of(lesson.file)),
      card.steps, card.steps == 1 ? "" : "s");
}

}  // namespace

std::string lesson_index(const Folder& folder) {
  const std::vector<Listed> lessons = lessons_in(folder);
  std::map<std::string, const Listed*> by_name;
  for (const Listed& lesson : lessons) by_name.emplace(lesson.card.scenario, &lesson);
  return html_page("Lessons", filled(page::index_html, [&](std::string_view name) {
                     if (name == "mark") return std::string(kIndexMark);
                     if (name == "colours") return lesson_colours();
                     if (name == "style") return std::string(page::index_css);
                     if (name == "count")
                       return fmt::format("{} lesson{}", lessons.size(),
                                          lessons.size() == 1 ? "" : "s");
                     std::string entries;
                     for (const Listed& lesson : lessons) entries += entry_of(lesson, by_name);
                     return entries;
                   }));
}

bool write_lesson_index(const Folder& folder) {
  if (folder.has(kIndex) && !folder.has_file(kIndex)) return false;
  const auto before = folder.read(kIndex, kMostPage);
  if (before && before->find(kIndexMark) == std::string::npos) return false;
  write_file({folder, kIndex}, lesson_index(folder));
  return true;
}

}  // namespace lantern::publish
