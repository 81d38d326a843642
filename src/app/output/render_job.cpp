#include "app/output/render_job.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <thread>
#include <tuple>

#include <fmt/format.h>

#include "app/run_scenario.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/number.hpp"
#include "base/stop.hpp"
#include "base/suggest.hpp"
#include "draw/page.hpp"
#include "embedded/version.hpp"
#include "publish/paper.hpp"
#include "render/svg.hpp"
#include "run/event_text.hpp"
#include "spatial/structure_kind.hpp"

namespace lantern::app {

namespace {

// Between the picture at a time's begin and the one at its end.
std::uint64_t within(double seconds, double fps) {
  return static_cast<std::uint64_t>(std::max(0.0, std::floor(seconds * fps + 0.5) - 1));
}

constexpr const char* kUsualSize = "1600x900";
constexpr double kInch = 72;      // points
constexpr int kFigureDots = 300;  // to the inch, of what is laid out for paper
constexpr int kUsualDots = 160;   // to the inch: a frame of 1600 pixels is 10 inches wide on paper

// The ids of two files differ unless they show the same frame in the same way. A new version of
// Lantern changes none of them, so that files can be compared.
SvgWords svg_words(const RenderJob& job, const Frame& frame, const MadeFrom& from) {
  const std::uint64_t key = Hash().add(frame.scenario).add(from.picture).value();
  SvgWords words{frame.title, frame.caption, fmt::format("l{:08x}-", key >> 32),
                 job.options.text == "text"};
  if (job.options.is_figure()) {
    words.description = description_of(frame);
    words.points = job.points();
  }
  return words;
}

// What a structure that this program was given says depends on its code, which is no part of
// Lantern's sources.
std::uint64_t program_hash() {
  constexpr std::size_t kMostBytes = std::size_t{1} << 31;
  static const std::uint64_t hash =
      std::hash<std::string>()(read_file("/proc/self/exe", kMostBytes));
  return hash;
}

struct Ending {
  std::string_view name;
  OutputKind kind;
};
constexpr std::array kEndings = {
    Ending{"png", OutputKind::picture},  Ending{"svg", OutputKind::picture},
    Ending{"pdf", OutputKind::document}, Ending{"html", OutputKind::page},
    Ending{"mp4", OutputKind::film},     Ending{"webm", OutputKind::film},
    Ending{"gif", OutputKind::film},     Ending{"apng", OutputKind::film},
    Ending{"webp", OutputKind::film},
};
constexpr std::array<std::string_view, 3> kPlaceholders = {"scenario", "step", "frame"};

// "mp4" of "talk.mp4"; empty where a folder is meant: no ending, or a folder that stands there.
std::string ending_of(const std::string& words) {
  std::error_code error;
  std::string ending = fs::path(words).extension().string();
  if (ending.size() < 2 || fs::is_directory(words, error)) return {};
  ending.erase(0, 1);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return ending;
}

OutputKind kind_of(const std::string& words, const std::string& ending) {
  if (words == "-") return OutputKind::standard_output;
  if (ending.empty()) return OutputKind::folder;
  std::vector<std::string_view> names;
  for (const Ending& e : kEndings) {
    if (e.name == ending) return e.kind;
    names.push_back(e.name);
  }
  throw UsageError(with_suggestion(
      fmt::format("-o {}: there is no output '.{}', and a folder's name that has a dot ends with /",
                  words, ending),
      ending, names, names.size()));
}

// part(text, false) for what stands between placeholders, part(name, true) for each of them.
void for_each_part(std::string_view words, const auto& part) {
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t open = std::min(words.find('{', at), words.size());
    part(words.substr(at, open - at), false);
    if (open == words.size()) return;
    const std::size_t close = words.find('}', open);
    if (close == std::string_view::npos) throw UsageError("-o {}: a {{ without its }}", words);
    part(words.substr(open + 1, close - open - 1), true);
    at = close + 1;
  }
}

}  // namespace

InBetweens::InBetweens(std::optional<std::uint64_t> tween, std::optional<double> fps)
    : number_(fps ? within(kChangeSeconds, *fps) : tween.value_or(0)), fps_(fps.value_or(0)) {}

std::string InBetweens::setting() const {
  if (!wanted()) return "";
  return fps_ > 0 ? fmt::format("{} fps", fps_) : fmt::format("{}", number_);
}

std::uint64_t InBetweens::between(const Frame& a, const Frame& b) const {
  return fps_ > 0 && is_one_movement(a, b) ? within(b.time - a.time, fps_) : number_;
}

void InBetweens::require_few(std::optional<std::uint64_t> frames) const {
  const std::uint64_t known = std::max<std::uint64_t>(frames.value_or(2), 1);
  if (!wanted() || (number_ <= kMostPictures && known + (known - 1) * number_ <= kMostPictures))
    return;
  throw UsageError(
      "--tween {}: up to {} frames and {} in-betweens before each but the "
      "first are more than {} pictures; ask for fewer",
      number_, known, number_, lantern::grouped(kMostPictures, " "));
}

RenderJob::RenderJob(const RenderOptions& o)
    : options(o),
      backend(*backend_named(o.backend)),
      format(o.format == "svg" ? FileKind::svg : FileKind::png),
      in_betweens(o.tween, o.fps) {
  std::tie(picture.width, picture.height) =
      parse_size(o.size.empty() ? kUsualSize : o.size, render::kMostSide);
  picture.theme = *theme_named(o.theme);
  picture.transparent = o.transparent;
  letters = !o.letters.empty() ? parse_length("--letters", o.letters)
            : o.sheet.empty()  ? 0
                               : publish::SheetLayout::kLeastPoints;
  on_paper =
      o.width.empty() ? picture.width * kInch / kUsualDots : parse_length("--width", o.width);
  const std::vector<std::string_view> panels = names(language::Panel());
  if (!o.panel.empty() && std::ranges::find(panels, o.panel) == panels.end())
    throw UsageError(with_suggestion(fmt::format("--panel {}: there is no such panel", o.panel),
                                     o.panel, panels, panels.size()));
  picture.effort = o.png == "small" ? PngEffort::small : PngEffort::fast;
  dpi = o.is_figure() && !o.dpi_given ? kFigureDots : o.dpi;
  picture.pixels_per_metre = static_cast<int>(std::lround(dpi / 0.0254));
  picture.threads =
      o.threads.value_or(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
}

Display RenderJob::display_of(const Frame& frame) const {
  Display display = frame.display;
  if (options.no_title) display.title = false;
  if (options.no_caption) display.caption = false;
  if (options.no_counters) display.counters = false;
  if (options.no_counters && !options.panel.empty()) display.facts = false;
  if (options.legend) display.legend = true;
  return display;
}

Vec<2> RenderJob::points() const {
  if (figure_) return figure_->part.size() * (on_paper / figure_->part.size().x);
  return Vec<2>(picture.width, picture.height) * (kInch / dpi);
}

void RenderJob::set(const Figure& figure) {
  figure_ = figure;
  const Vec<2> pixels = points() * (dpi / kInch);
  picture.width = std::max(1, static_cast<int>(std::lround(pixels.x)));
  picture.height = std::max(1, static_cast<int>(std::lround(pixels.y)));
  if (std::max(picture.width, picture.height) > render::kMostSide)
    throw UsageError("a figure of {} x {} pixels is more than {}; ask for fewer dots (--dpi)",
                     picture.width, picture.height, render::kMostSide);
}

Frame RenderJob::shown(const Frame& frame) const {
  Frame shown = frame;
  shown.display = display_of(frame);
  if (options.panel.empty()) return shown;
  shown.display.title = shown.display.caption = shown.display.counters = false;
  std::set<std::string_view> there;
  bool any = false;
  const auto keep = [&](Frame& one) {
    for (const auto panel : one.panels) there.insert(kind_of(panel).name);
    std::erase_if(one.panels, [&](const auto panel) { return !is(panel, options.panel); });
    any |= !one.panels.empty();
    if (options.panel != "world") one.notes.clear();  // most are about what is not there
  };
  keep(shown);
  for (Frame& side : shown.sides) keep(side);
  if (!any)
    throw UsageError("--panel {}: frame {} of {} has none; it has: {}", options.panel, frame.index,
                     frame.scenario, fmt::join(there, ", "));
  return shown;
}

DrawList RenderJob::page_of(const Frame& frame, const Staging& staging, Work& work) const {
  if (figure_)
    return publish::part_of(draw_frame(shown(frame), staging, figure_->page, work), figure_->part);
  const Vec<2> page = page_for(picture.width, picture.height);
  const Display display = display_of(frame);
  if (display == frame.display) return draw_frame(frame, staging, page, work);
  Frame switched = frame;
  switched.display = display;
  return draw_frame(switched, staging, page, work);
}

Manifest RenderJob::manifest(const Scenario& scenario, Pace pace) const {
  Manifest m(name_of(scenario));
  m.title = scenario.title;
  m.seed = scenario.seed;
  m.pace = pace;
  m.size = fmt::format("{}x{}", picture.width, picture.height);
  m.theme = options.theme;
  m.format = format;
  m.png = picture.effort;
  m.transparent = options.transparent;
  m.in_betweens = in_betweens.setting();
  m.in_between_digits =
      std::max(2, static_cast<int>(fmt::formatted_size("{}", in_betweens.most())));
  m.scenario_hash = scenario.text_hash;
  if (known_structures().size() > kStructureKinds.size()) m.scenario_hash ^= program_hash();
  for (const auto& [on, name] :
       {std::pair{options.no_title, "no-title"}, std::pair{options.no_caption, "no-caption"},
        std::pair{options.no_counters, "no-counters"}, std::pair{options.legend, "legend"}})
    if (on) m.switches.emplace_back(name);
  for (const std::string* word : {&options.width, &options.letters, &options.panel})
    if (!word->empty()) m.switches.push_back("figure-" + *word);
  if (format == FileKind::svg && options.text == "text") m.switches.emplace_back("text");
  if (format == FileKind::png && options.dpi != kUsualDots)
    m.switches.push_back(fmt::format("dpi-{}", options.dpi));
  return m;
}

Renderer& RenderJob::renderer(int width, int height, Work& work) const {
  if (renderer_ && renderer_->is_for(width, height)) return *renderer_;
  renderer_.reset();
  as_asked(
      [&] { renderer_ = std::make_unique<Renderer>(Context::create(backend), width, height); });
  ++work.graphics_contexts;
  return *renderer_;
}

std::unique_ptr<Pipeline> RenderJob::make_pipeline(Work& work) const {
  Renderer& graphics = renderer(picture.width, picture.height, work);
  return as_asked([&] { return std::make_unique<Pipeline>(graphics, picture, work); });
}

std::string description_of(const Frame& frame, const Display& of) {
  std::string text;
  const std::string part = run::capitalised(frame.part);
  const bool is_sentence = part.find_last_of("?!.") + 1 == part.size();  // nothing is one, too
  if (of.caption) text = part + (part.empty() ? "" : is_sentence ? " " : ": ") + frame.caption;
  if (const auto counters = counter_texts(frame); of.counters && !counters.empty())
    text += fmt::format("{}({})", text.empty() ? "" : " ", fmt::join(counters, ", "));
  return text;
}

std::vector<PngText> texts_of(const Frame& frame, const RenderOptions& options) {
  std::vector<PngText> texts = {{"Title", frame.title},
                                {"Software", fmt::format("Lantern {}", kVersion)},
                                {"Scenario", frame.scenario},
                                {"Frame", fmt::format("{}", frame.index)},
                                {"Seed", fmt::format("{}", frame.seed)}};
  if (options.is_figure()) texts.push_back({"Description", description_of(frame)});
  return texts;
}

std::string picture_of(const RenderJob& job, const Pipeline::Config& as, const Frame& frame,
                       const DrawList& list, const MadeFrom& from, Work& work) {
  if (job.format == FileKind::svg)
    return sealed(
        FileKind::svg,
        to_svg(list, as.theme, as.transparent, as.width, as.height, svg_words(job, frame, from)),
        from);
  Image image;
  job.renderer(as.width, as.height, work).draw(list, as.theme, as.transparent, image);
  ++work.frames_drawn;
  ++work.frames_encoded;
  return sealed(FileKind::png,
                encode_png(image, as.effort, texts_of(frame, job.options), as.pixels_per_metre),
                from);
}

void FrameWalk::go_on(const Frame& frame, const Staging& staging) {
  before_ = std::exchange(here_, Stop{frame});
  way_.reset();
  staging_ = &staging;
}

const DrawList& FrameWalk::page_of(Stop& stop) {
  if (!stop.page) stop.page = job_.page_of(stop.frame, *staging_, work_);
  return *stop.page;
}

DrawList FrameWalk::in_between(double t) {
  stop_if_asked();
  ++work_.in_betweens;
  const DrawList &a = page_before(), &b = page();
  if (!way_) way_ = passages(a, b);
  return between(a, b, *way_, t, motion_between(before_->frame, here_->frame));
}

Destination::Destination(const std::string& words, bool sheet)
    : words_(words), ending_(words == "-" ? "" : ending_of(words)), kind_(kind_of(words, ending_)) {
  for_each_part(words_, [&](std::string_view name, bool is_placeholder) {
    if (!is_placeholder) return;
    if (std::ranges::find(kPlaceholders, name) == kPlaceholders.end())
      throw UsageError(with_suggestion(
          fmt::format("-o {}: there is no placeholder {{{}}}", words_, name), name, kPlaceholders));
    if (kind_ == OutputKind::folder)
      throw UsageError("-o {}: a placeholder stands in the name of a file, such as {{frame}}.png",
                       words_);
  });
  if (!sheet) return;
  if (ending_ != "pdf" && ending_ != "png")
    throw UsageError("--sheet makes a .pdf or a .png: name one after -o, such as sheet.pdf");
  kind_ = OutputKind::sheet;
}

bool Destination::is_by(std::string_view placeholder) const {
  return words_.find(fmt::format("{{{}}}", placeholder)) != std::string::npos;
}

fs::path Destination::users_folder() const { return folder_of(words_.substr(0, words_.find('{'))); }

fs::path Destination::file(const NameParts& parts) const {
  std::string name;
  for_each_part(words_, [&](std::string_view part, bool is_placeholder) {
    if (!is_placeholder)
      name += part;
    else if (part == "scenario")
      name += parts.scenario;
    else
      name += fmt::format("{:04}", part == "step" ? parts.step : parts.frame);
  });
  return name;
}

double parse_length(std::string_view option, const std::string& text) {
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"cm", 72 / 2.54}, {"mm", 72 / 25.4}, {"in", 72}, {"pt", 1}};
  for (const auto& [unit, points] : kUnits) {
    if (!text.ends_with(unit)) continue;
    const auto number = number_in<double>(text.substr(0, text.size() - unit.size()));
    if (number && *number * points >= 1 && *number * points <= 14400) return *number * points;
  }
  throw UsageError("{} {}: give a length on paper, as 8cm, 80mm, 3.2in or 227pt", option, text);
}

std::pair<int, int> parse_size(const std::string& text, int most) {
  constexpr int kLeast = 16;
  const auto size = two_numbers_in<int>(text, 'x');
  if (!size || std::min(size->first, size->second) < kLeast ||
      std::max(size->first, size->second) > most)
    throw UsageError("--size {}: give width x height in pixels, {} to {} each, as 1280x720", text,
                     kLeast, most);
  return *size;
}

Selection::Selection(const std::string& frames, const std::string& at,
                     std::optional<std::uint64_t> most_frames, bool whole_steps)
    : frames_(frames), at_(at), whole_steps_(whole_steps), time_(number_in<double>(at)) {
  if (time_ && !std::isfinite(*time_)) time_.reset();
  if (frames.empty()) return;
  const std::size_t dash = frames.find('-');
  const std::string_view from = std::string_view(frames).substr(0, dash);
  const std::string_view to =
      dash == std::string::npos ? from : std::string_view(frames).substr(dash + 1);
  const auto read = [&](std::string_view word) {
    const auto index = number_in<std::uint32_t>(word);
    if (!index)
      throw UsageError("--frames {}: give a frame or a range, as 7, 3-9, 3- or -9", frames);
    return *index;
  };
  if (!from.empty() || to.empty()) first_ = read(from);
  if (!to.empty()) last_ = read(to);
  if (last_ && first_ > *last_)
    throw UsageError("--frames {}: the range ends before it begins", frames);
  if (most_frames && std::max(first_, last_.value_or(0)) >= *most_frames)
    refuse_range(*most_frames);
}

void Selection::refuse_range(std::uint64_t count) const {
  throw UsageError("--frames {}: give a frame or a range within 0-{}, as 7, 3-9, 3- or -9", frames_,
                   count - 1);
}

bool Selection::takes(const Frame& frame) {
  ++asked_;
  end_ = frame.time;
  if (!at_.empty()) events_.insert({frame.event, frame.step_name});
  if (frame.index < first_ || (last_ && frame.index > *last_)) return false;
  // World time is a sum of steps, so a time as written may miss it by a rounding error.
  if (time_ && (taken_ > 0 || frame.time < *time_ - 1e-9)) return false;
  const bool named = frame.event == at_ || (whole_steps_ && frame.step_name == at_);
  if (!at_.empty() && !time_ && !named) return false;
  ++taken_;
  return true;
}

void Selection::require_some() const {
  if (std::max(first_, last_.value_or(0)) >= asked_ && !frames_.empty()) refuse_range(asked_);
  if (taken_ > 0) return;
  if (!at_.empty() && !time_ && !events_.contains(at_)) {
    std::vector<std::string_view> known(events_.begin(), events_.end());
    std::erase(known, "");  // of steps without a name
    throw UsageError(
        with_suggestion(fmt::format("--at {}: no frame has this event", at_), at_, known, 40));
  }
  throw UsageError("--at {}: no frame is chosen; the last one is at {:.6g} s", at_, end_);
}

}  // namespace lantern::app
