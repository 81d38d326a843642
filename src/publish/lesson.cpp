#include "publish/lesson.hpp"

#include <map>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/check.hpp"
#include "base/json_writer.hpp"
#include "base/number.hpp"
#include "base/printable.hpp"
#include "base/words.hpp"
#include "draw/theme.hpp"
#include "embedded/lesson_files.hpp"
#include "language/words.hpp"
#include "publish/packed.hpp"
#include "render/canvas.hpp"
#include "render/png.hpp"
#include "render/svg.hpp"

namespace lantern::publish {
namespace {

constexpr int kSmallest = 12;      // level of packing: a page is made once and opened often
constexpr int kStillWidth = 1600;  // of the picture for those without scripts
constexpr std::size_t kMostCover = 300'000;  // bytes of a picture for the index

constexpr std::string_view kQuestionButton =
    "<button id=\"question\" title=\"Questions for the students (Q)\">question</button>\n";

constexpr std::string_view kEngineMark = "window.lanternEngine = \"";

std::string data_script(const char* type, const char* id, std::string_view text) {
  return fmt::format("<script type=\"{}\" id=\"{}\">{}</script>\n", type, id, text);
}

std::string scenario_list(const std::vector<LiveScenario>& scenarios) {
  JsonWriter json;
  json.begin_array();
  for (const LiveScenario& s : scenarios)
    json.line().object("name", s.name, "title", s.title, "idea", s.idea, "lecture", s.lecture,
                       "text", s.text);
  return json.end_array().text();
}

constexpr std::string_view kIndexMark =
    "<meta name=\"generator\" content=\"Lantern lesson index\">";
constexpr std::string_view kAskedMark = "<!-- in the order asked for -->\n";
constexpr std::string_view kPictureLink = "<a class=\"picture\" href=\"";
constexpr const char* kIndex = "index.html";
constexpr std::size_t kMostPage = std::size_t{256} << 20;

struct Listed {
  std::string file;
  LessonCard card;
  std::string picture;  // a data URL
  std::string theme;    // as an attribute of its root; may be empty
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

// A page's template with its fixed words said: what stands between two tags, and in titles and
// labels.
std::string said(std::string_view html) {
  if (!spoken()) return std::string(html);
  constexpr std::string_view kSpace = " \n";
  std::string text;
  for (std::size_t at = 0; at < html.size();) {
    bool is_title = false;
    for (const std::string_view mark : {" title=\"", " aria-label=\"", " alt=\""})
      is_title |= html.substr(0, at).ends_with(mark);
    const bool is_between = at > 0 && html[at - 1] == '>';
    const std::size_t end = std::min(html.find(is_title ? '"' : '<', at), html.size());
    if (!is_title && !is_between) {
      text += html[at++];
      continue;
    }
    const std::string_view words = html.substr(at, end - at);
    const std::size_t from = std::min(words.find_first_not_of(kSpace), words.size());
    const std::size_t to = std::max(words.find_last_not_of(kSpace) + 1, from);
    text += words.substr(0, from);
    text += word(words.substr(from, to - from));
    text += words.substr(to);
    at = end;
    if (at < html.size()) text += html[at++];
  }
  return text;
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
  const auto root = between_marks(page, "<html", ">").value_or("");
  return Listed{file, std::move(*card), std::string(*picture),
                std::string(root.substr(std::min(root.find(" data-theme"), root.size())))};
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

std::vector<Listed> lessons_in(const Folder& folder, const std::vector<std::string>& order) {
  std::vector<Listed> lessons;
  for (const std::string& name : folder.names()) {
    if (!name.ends_with(".html") || name == kIndex || !folder.has_file(name)) continue;
    if (auto lesson = listed(folder, name)) lessons.push_back(std::move(*lesson));
  }
  const auto place = [&](const Listed& one) {
    return std::ranges::find_if(
        order, [&](const auto& file) { return file == one.file || file == url_of(one.file); });
  };
  std::ranges::sort(lessons, [&](const Listed& a, const Listed& b) {
    if (place(a) != place(b)) return place(a) < place(b);
    if (a.card.lecture.has_value() != b.card.lecture.has_value()) return a.card.lecture.has_value();
    return std::tie(a.card.lecture, a.card.scenario, a.file) <
           std::tie(b.card.lecture, b.card.scenario, b.file);
  });
  return lessons;
}

std::string link_to(const std::string& file, std::string_view words) {
  return fmt::format("<a href=\"{}\">{}</a>", url_of(file), escaped(words));
}

// The pages that an index lists, as it links them.
std::vector<std::string> linked_in(std::string_view index) {
  std::vector<std::string> links;
  while (const auto link = between_marks(index, kPictureLink, "\"")) {
    links.emplace_back(*link);
    index.remove_prefix(static_cast<std::size_t>(link->data() - index.data()));
  }
  return links;
}

// What `escaped` was made of.
std::string unescaped(std::optional<std::string_view> html) {
  std::string text(html.value_or(""));
  for (const auto& [name, letter] : {std::pair{"&lt;", "<"}, std::pair{"&gt;", ">"},
                                     std::pair{"&quot;", "\""}, std::pair{"&amp;", "&"}})
    for (std::size_t at = 0; (at = text.find(name, at)) != text.npos; ++at)
      text.replace(at, std::string_view(name).size(), letter);
  return text;
}

// The lessons to be seen before, of those that stand in the folder.
std::string needs_of(const Listed& lesson, const std::map<std::string, const Listed*>& by_name) {
  std::string text;
  for (const std::string& name : lesson.card.needs) {
    const auto found = by_name.find(name);
    if (found == by_name.end()) continue;  // what it is called is not known here
    text += text.empty() ? fmt::format("<p class=\"needs\">{} ", word("after")) : ", ";
    text += link_to(found->second->file, found->second->card.title);
  }
  return text.empty() ? "" : text + "</p>\n";
}

std::string entry_of(const Listed& lesson, const std::map<std::string, const Listed*>& by_name) {
  const LessonCard& card = lesson.card;
  const std::string number = card.lecture ? fmt::format("<b>{}</b> ", *card.lecture) : "";
  return fmt::format(
      "<li>\n{}{}\" tabindex=\"-1\" aria-hidden=\"true\">"
      "<img src=\"{}\" alt=\"\" loading=\"lazy\"></a>\n<h2>{}{}</h2>\n<p class=\"idea\">{}</p>\n{}"
      "{}<p class=\"length\">{}</p>\n</li>\n",
      kPictureLink, url_of(lesson.file), lesson.picture, number, link_to(lesson.file, card.title),
      escaped(card.idea), needs_of(lesson, by_name), question_list(card, url_of(lesson.file)),
      say_count(card.steps, "step/steps"));
}

}  // namespace

std::string to_json(const LessonCard& card) {
  JsonWriter json;
  json.begin_object().members("format", "lantern.lesson/1", "scenario", card.scenario, "title",
                              card.title, "idea", card.idea, "lecture", card.lecture, "needs",
                              card.needs, "steps", card.steps, "frames", card.frames);
  if (!card.language.empty()) json.member("language", card.language);
  json.key("questions").begin_array();
  for (const LessonQuestion& q : card.questions)
    json.object("asked", q.asked, "answer", q.answer, "frame", q.frame, "predict", q.predict);
  json.end_array();
  if (!card.next_file.empty())
    json.key("next").object("file", url_of(card.next_file), "title", card.next_title);
  return json.end_object().text();
}

std::optional<LessonCard> lesson_card(std::string_view json) try {
  const auto value = nlohmann::json::parse(json);
  if (value.at("format") != "lantern.lesson/1") return std::nullopt;
  LessonCard card{value.at("scenario"), value.at("title"), value.at("idea"),   std::nullopt,
                  value.at("needs"),    value.at("steps"), value.at("frames"), {}};
  if (!value.at("lecture").is_null()) card.lecture = value.at("lecture").get<std::uint32_t>();
  card.language = value.value("language", "");
  for (const auto& q :
       value.value("questions", nlohmann::json::array()))  // pages of before have none
    card.questions.push_back(
        {q.at("asked"), q.at("answer"), q.at("frame"), q.value("predict", "")});
  return card;
} catch (const nlohmann::json::exception&) {
  return std::nullopt;
}

std::string question_list(const LessonCard& card, std::string_view page) {
  std::string text;
  for (const LessonQuestion& q : card.questions)
    text += fmt::format(
        "<details>\n<summary>{}</summary>\n<p>{} <a href=\"{}#{}\">{}</a></p>\n</details>\n",
        escaped(q.asked), escaped(q.answer), page, q.frame, word("Look at it."));
  return text;
}

void Lesson::add(const Frame& frame, const DrawList& list, const FrameWords& words) {
  check_draw_list(list);
  if (frames_.count() == 0) first_ = list;
  last_ = list;
  if (const auto* q = frame.find<FrameQuestion>())
    card_.questions.push_back({q->asked, q->answer, frames_.count(), q->predict});
  frames_.add(frame, list, words);
  facts_ += (facts_.empty() ? "" : ",\n") + facts_for_page(frame, list);
  const std::string caption = whole_caption(frame);
  if (caption.empty() || caption == last_caption_) return;
  captions_ += fmt::format("<li value=\"{}\">{}</li>\n", frame.step + 1, escaped(caption));
  last_caption_ = caption;
}

std::string Lesson::picture_of(const DrawList& list) const {
  const int height = std::max(1, static_cast<int>(kStillWidth * list.page.y / list.page.x));
  return to_svg(list, *theme_named("light"), false, kStillWidth, height);
}

std::string Lesson::html() const {
  LANTERN_CHECK(frames_.count() + (live_ ? live_->scenarios.size() : 0), >, 0u);
  return html_page(
      card_.title,
      filled(said(page::lesson_html), [&](std::string_view name) { return part(name); }),
      theme_ == "light" ? "" : fmt::format(" data-theme=\"{}\"", theme_));
}

std::string Lesson::part(std::string_view name) const {
  if (name == "title") return escaped(card_.title);
  if (name == "idea") return escaped(card_.idea);
  if (name == "card") {
    LessonCard card = card_;
    card.frames = frames_.count();
    if (spoken()) card.language = spoken()->language;
    return script_text(to_json(card));
  }
  if (name == "colours") return lesson_colours(first_.paints);
  if (name == "style")
    return fmt::format("{}{}", page::lesson_css, live_ ? page::live_css : std::string_view());
  if (name == "live") return live_ ? live_part() : "";
  if (name == "captions") return captions_;
  if (name == "questions") return question_list(card_, "");
  if (name == "question-button") return card_.questions.empty() ? "" : said(kQuestionButton);
  if (name == "words") return words_part();
  if (name == "still") return base64(picture_of(first_));
  if (name == "cover") {
    const std::string end = picture_of(last_);
    return base64(end.size() <= kMostCover ? end : picture_of(first_));
  }
  if ((name == "frames" || name == "facts") && frames_.count() == 0) return "";
  if (name == "frames") return base64(deflated(frames_.json(), kSmallest));
  if (name == "facts") return base64(deflated("[" + facts_ + "]\n", kSmallest));
  LANTERN_CHECK(name, ==, std::string_view("script"));
  return script();
}

std::string Lesson::script() const {
  std::string script;
  for (const std::string_view file :
       {page::lesson_data_js, page::lesson_picture_js, page::lesson_pointing_js,
        page::lesson_tables_js, page::lesson_js})
    script += file;
  if (live_)
    for (const std::string_view file : {page::live_editor_js, page::live_controls_js,
                                        page::live_words_js, page::live_hand_js, page::live_js})
      script += file;
  return script;
}

// What its scripts say in another language than English; all that frames say, too, if it makes
// them.
std::string Lesson::words_part() const {
  if (!spoken()) return "";
  WordTable words = *spoken();
  const std::string scripts = script();
  if (!live_) {
    words.texts.clear();
    std::erase_if(words.said, [&](const auto& said) {
      return scripts.find("\"" + said.first + "\"") == scripts.npos;
    });
  }
  return data_script("application/json", "word-table", script_text(language::to_json(words)));
}

std::string Lesson::live_part() const {
  const LiveScenario& first = live_->scenarios.front();
  const std::string shown = JsonWriter().object("name", first.name, "text", first.text).text();
  std::string text = said(page::live_html);
  text += data_script("application/json", "scenario", script_text(shown));
  if (live_->scenarios.size() > 1)
    text +=
        data_script("application/json", "scenarios", script_text(scenario_list(live_->scenarios)));
  text += live_->engine.empty() ? fmt::format("<script src=\"{}\"></script>\n", kEngineFile)
                                : data_script("text/plain", "engine-packed", live_->engine);
  text += data_script("text/plain", "worker-script", page::live_worker_js);
  return text + fmt::format("<script>\n{}</script>\n", page::live_engine_js);
}

std::string packed_engine(std::string_view wasm) { return base64(deflated(wasm, kSmallest)); }

bool write_engine(const Folder& folder, std::string_view packed) {
  const std::string script = fmt::format("{}{}\";\n", kEngineMark, packed);
  if (folder.has(kEngineFile) && !folder.has_file(kEngineFile)) return false;
  const auto before = folder.read(kEngineFile, kMostPage);
  if (before && !before->starts_with(kEngineMark)) return false;
  if (before != script) write_file({folder, kEngineFile}, script);
  return true;
}

std::string lesson_index(const Folder& folder, const std::vector<std::string>& order,
                         const std::string& title) {
  const std::vector<Listed> lessons = lessons_in(folder, order);
  const auto words = language::words_in(lessons.empty() ? "" : lessons.front().card.language);
  const Speaking speaking(words.get());
  const std::string heading = title.empty() ? word("Lessons") : title;
  std::map<std::string, const Listed*> by_name;
  for (const Listed& lesson : lessons) by_name.emplace(lesson.card.scenario, &lesson);
  const std::string page = filled(said(page::index_html), [&](std::string_view name) {
    if (name == "title") return escaped(heading);
    if (name == "mark") return std::string(kIndexMark);
    if (name == "colours") return lesson_colours();
    if (name == "style") return std::string(page::index_css);
    if (name == "count") return say_count(lessons.size(), "lesson/lessons");
    std::string entries(order.empty() ? "" : kAskedMark);
    for (const Listed& lesson : lessons) entries += entry_of(lesson, by_name);
    return entries;
  });
  return html_page(heading, page, lessons.empty() ? "" : lessons.front().theme);
}

bool write_lesson_index(const Folder& folder, std::vector<std::string> order, std::string title) {
  if (folder.has(kIndex) && !folder.has_file(kIndex)) return false;
  const auto before = folder.read(kIndex, kMostPage);
  if (before && before->find(kIndexMark) == std::string::npos) return false;
  if (before && order.empty() && before->find(kAskedMark) != before->npos)
    order = linked_in(*before);
  if (before && title.empty()) title = unescaped(between_marks(*before, "<h1>", "</h1>"));
  write_file({folder, kIndex}, lesson_index(folder, order, title));
  return true;
}

}  // namespace lantern::publish
