#include "publish/paper.hpp"

#include <new>
#include <variant>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/error.hpp"
#include "base/number.hpp"
#include "draw/font.hpp"
#include "draw/labels.hpp"
#include "draw/page.hpp"
#include "render/cairo_painter.hpp"
#include "render/canvas.hpp"

namespace lantern::publish {
namespace {

// As <cairo-pdf.h> numbers them.
constexpr int kTitle = 0, kSubject = 2, kCreator = 4, kCreated = 5;

// In millimetres of an A4 page.
constexpr double kMargin = 12, kTop = 21, kBottom = 14, kGapAcross = 7, kGapDown = 6;
constexpr double kTitleLine = 14.5, kTitleRule = 17, kTitleSize = 4.6, kFootSize = 3.0;
constexpr double kMostType = 3.3, kLeastType = 2.2;         // 9.4 and 6.2 points
constexpr double kTypeOfWidth = 0.038;                      // of a picture
constexpr double kMostTypeOfWidth = 0.06;                   // or its words have no room
constexpr double kLineHeight = 1.32, kAboveCaption = 1.45;  // ems
constexpr double kLeastWidth = 10, kLeastHeight = 10;       // of picture and caption
constexpr double kUsualCaption = 190;                       // letters that have room
constexpr double kMostWords = 0.55;                         // of the height of picture and caption
constexpr double kLetter = 0.52;                            // ems, on average
constexpr double kWidest = 16.0 / 9, kSquarest = 1.25;      // aspects of a picture
constexpr double kPoint = 25.4 / 72;
const Vec<2> kRoomy(880, 540);  // page units that the panels of most scenarios need

void move(RectShape& s, const Vec<2>& by) { s.box = {s.box.lo + by, s.box.hi + by}; }
void move(LineShape& s, const Vec<2>& by) { s.from += by, s.to += by; }
void move(PolygonShape& s, const Vec<2>& by) {
  for (Vec<2>& p : s.points) p += by;
}
void move(TextShape& s, const Vec<2>& by) { s.at += by; }

// As many lines as there may be; the last one ends with an ellipsis if the text goes on.
std::vector<std::string> lines_of(const std::string& text, double width, std::size_t most,
                                  double least, TextStyle& style) {
  std::vector<std::string> lines = wrapped(text, width, style);
  while (lines.size() > most && style.size > least) {
    style.size = std::max(least, 0.97 * style.size);
    lines = wrapped(text, width, style);
  }
  if (lines.size() <= most) return lines;
  std::string rest = lines[most - 1];
  for (std::size_t i = most; i < lines.size(); ++i) rest += " " + lines[i];
  lines.resize(most);
  lines.back() = shortened(rest, width, style);
  return lines;
}

}  // namespace

PdfDocument::PdfDocument(const PdfWords& words) {
  cairo_face(Weight::regular);  // before anything is made: what is missing is told at once
  surface_ = cairo().pdf_surface_create_for_stream(append, &bytes_, 1, 1);
  context_ = cairo().create(surface_);
  say(words);
  cairo().pdf_surface_set_metadata(surface_, kCreated, "");  // or it would be now
}

void PdfDocument::say(const PdfWords& words) {
  cairo().pdf_surface_set_metadata(surface_, kTitle, words.title.c_str());
  cairo().pdf_surface_set_metadata(surface_, kSubject, words.subject.c_str());
  cairo().pdf_surface_set_metadata(surface_, kCreator, words.creator.c_str());
}

PdfDocument::~PdfDocument() {
  cairo().destroy(context_);
  cairo().surface_destroy(surface_);
}

// Cairo calls it, and is no place for exceptions.
int PdfDocument::append(void* to, const unsigned char* bytes, unsigned int length) noexcept try {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), length);
  return 0;
} catch (const std::bad_alloc&) {
  constexpr int kNoMemory = 1;
  return kNoMemory;
}

void PdfDocument::require_good() const {
  cairo().require(cairo().status(context_));
  cairo().require(cairo().surface_status(surface_));
}

void PdfDocument::add_page(const DrawList& list, const Theme& theme, bool paper, const Vec<2>& size,
                           const std::string& label) {
  cairo().pdf_surface_set_size(surface_, size.x, size.y);
  Canvas canvas;
  canvas.scale = std::min(size.x / list.page.x, size.y / list.page.y);
  canvas.origin = (size - list.page * canvas.scale) * 0.5;
  CairoPainter(context_, CairoPainter::For::vectors).draw(list, theme, paper, canvas);
  if (!label.empty()) cairo().pdf_surface_set_page_label(surface_, label.c_str());
  cairo().show_page(context_);
  require_good();
  ++pages_;
}

int PdfDocument::add_entry(const std::string& words, int below) {
  LANTERN_CHECK(pages_, >, 0);
  const std::string link = fmt::format("page={} pos=[0 0]", pages_);
  const int entry =
      cairo().pdf_surface_add_outline(surface_, below, words.c_str(), link.c_str(), 0);
  require_good();
  return entry;
}

std::string PdfDocument::finish() {
  cairo().surface_finish(surface_);
  cairo().require(cairo().surface_status(surface_));
  return std::move(bytes_);
}

DrawList part_of(DrawList list, const Box<2>& part) {
  for (DrawShape& shape : list.shapes) std::visit([&](auto& s) { move(s, -part.lo); }, shape);
  list.page = part.size();
  return list;
}

std::optional<SheetGrid> sheet_grid(std::string_view words) {
  const auto grid = two_numbers_in<int>(words, 'x');
  if (!grid || std::min(grid->first, grid->second) < 1 ||
      std::max(grid->first, grid->second) > SheetGrid::kMost)
    return std::nullopt;
  return SheetGrid{grid->first, grid->second};
}

SheetLayout::SheetLayout(const Vec<2>& paper, const SheetGrid& grid, double least_points)
    : paper_(paper), grid_(grid) {
  const double share = std::sqrt(paper.x * paper.y / (297.0 * 210.0));
  const Vec<2> size = paper / share;  // as large as A4
  const auto parts = [](double room, int number, double gap) {
    return (room - gap * (number - 1)) / number;
  };
  const double width = parts(size.x - 2 * kMargin, grid.columns, kGapAcross);
  const double height = parts(size.y - kTop - kBottom, grid.rows, kGapDown);
  if (!(width >= kLeastWidth && height >= kLeastHeight))
    throw Refused("pages {:.3g} times as wide as high have no room for {} x {} pictures",
                  paper.x / paper.y, grid.columns, grid.rows);
  const double wanted = least_points * kPoint / share;
  const double least = std::min(wanted, std::max(kLeastType, kMostTypeOfWidth * width));
  const double type = std::max(std::clamp(kTypeOfWidth * width, kLeastType, kMostType), least);
  lines_ = static_cast<std::size_t>(
      std::clamp(std::ceil(kUsualCaption * kLetter * type / width), 2.0, 5.0));
  const auto words = [&] {
    return type * (kAboveCaption + kLineHeight * (static_cast<double>(lines_) - 0.7));
  };
  while (lines_ > 1 && words() > kMostWords * height) --lines_;
  const double room = height - words();
  Vec<2> picture(width, std::min(room, width / kSquarest));
  picture.x = std::min(picture.x, picture.y * kWidest);
  // A picture's own page says how many units it has, at most.
  const double most = page_for(static_cast<int>(std::lround(16 * picture.x)),
                               static_cast<int>(std::lround(16 * picture.y)))
                          .x;
  unit_ = std::min(most / picture.x, kLeastLabel / least);
  units_ = unit_ / share;
  picture_ = picture * unit_;
  least_ = least * unit_;
  page_ = size * unit_;
  is_roomy_ = least == wanted && picture_.x >= kRoomy.x && picture_.y >= kRoomy.y;
  cell_ = Vec<2>(width, height) * unit_;
  type_ = type * unit_;
}

DrawList SheetLayout::page(const std::vector<SheetPicture>& pictures,
                           const SheetWords& words) const {
  DrawList list;
  list.page = page_;
  add_words(words, list);
  for (std::size_t i = 0; i < std::min(pictures.size(), grid_.pictures()); ++i) {
    const auto columns = static_cast<std::size_t>(grid_.columns);
    const Vec<2> place(static_cast<double>(i % columns), static_cast<double>(i / columns));
    add_picture(
        pictures[i],
        Vec<2>(kMargin, kTop) * unit_ + place * (cell_ + Vec<2>(kGapAcross, kGapDown) * unit_),
        list);
  }
  return list;
}

void SheetLayout::add_words(const SheetWords& words, DrawList& list) const {
  const double left = kMargin * unit_, right = page_.x - left;
  if (!words.title.empty()) {
    const TextStyle style{std::max(kTitleSize * unit_, least_), Weight::semibold, Role::ink};
    list.shapes.emplace_back(TextShape{shortened(words.title, right - left, style),
                                       {left, kTitleLine * unit_},
                                       style.size,
                                       style.weight});
    list.crisp_line({left, kTitleRule * unit_}, {right, kTitleRule * unit_},
                    {Role::rule, 0.25 * unit_});
  }
  if (!words.page.empty())
    list.shapes.emplace_back(TextShape{words.page,
                                       {right, page_.y - 0.55 * kBottom * unit_},
                                       std::max(kFootSize * unit_, least_),
                                       Weight::regular,
                                       1,
                                       Role::quiet_ink});
}

// The picture on top of its cell, framed, its number and caption under it.
void SheetLayout::add_picture(const SheetPicture& picture, const Vec<2>& corner,
                              DrawList& list) const {
  const Vec<2> at = corner + Vec<2>(0.5 * (cell_.x - picture_.x), 0);
  for (DrawShape shape : picture.list.shapes) {
    std::visit([&](auto& s) { move(s, at); }, shape);
    list.shapes.push_back(std::move(shape));
  }
  list.crisp_rect({at, at + picture_}, Role::none, {Role::rule, 0.2 * unit_});
  const TextStyle bold{type_, Weight::semibold, Role::ink};
  Vec<2> baseline(corner.x, at.y + picture_.y + kAboveCaption * type_);
  list.shapes.emplace_back(TextShape{picture.number, baseline, bold.size, bold.weight});
  const double indent = text_width(picture.number, bold) + 0.7 * type_;
  TextStyle style{type_, Weight::regular, Role::ink};
  for (std::string& line :
       lines_of(picture.caption, cell_.x - indent, lines_, std::max(0.82 * type_, least_), style)) {
    list.shapes.emplace_back(
        TextShape{std::move(line), {baseline.x + indent, baseline.y}, style.size, style.weight});
    baseline.y += kLineHeight * style.size;
  }
}

}  // namespace lantern::publish
