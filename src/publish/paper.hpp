// Pages on paper: draw lists as the pages of a PDF, vectors and text that can be searched and
// copied; and contact sheets of several pictures a page.
#pragma once

#include <cstddef>

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"

namespace lantern::publish {

// What a document says of itself. No clock is asked: the same pages give the same bytes, with the
// same version of cairo.
struct PdfWords {
  std::string title, subject, creator;
};

class PdfDocument {
 public:
  // Throws BackendError, naming the packages to install, if cairo or FreeType are missing.
  explicit PdfDocument(const PdfWords& words);
  ~PdfDocument();
  // Other words than before.
  void say(const PdfWords& words);
  PdfDocument& operator=(PdfDocument&&) = delete;  // nor any other copy or move

  // A page of this size, in points of 1/72 inch, with the draw list in its middle. `label` is the
  // page's number as a viewer shows it; none if it is empty. Throws Refused as check_draw_list()
  // does.
  void add_page(const DrawList& list, const Theme& theme, bool paper, const Vec<2>& size,
                const std::string& label = {});

  // An entry of the table of contents, for the page that was added last, below another one or at
  // the top. Gives its number.
  int add_entry(const std::string& words, int below = 0);

  int pages() const { return pages_; }
  // That the document has by now.
  std::size_t bytes() const { return bytes_.size(); }

  // The whole file; nothing can be added after it.
  std::string finish();

 private:
  static int append(void* to, const unsigned char* bytes, unsigned int length) noexcept;
  void require_good() const;

  std::string bytes_;
  void* surface_ = nullptr;
  void* context_ = nullptr;
  int pages_ = 0;
};

// What stands in this part of a page, as a page of its own.
DrawList part_of(DrawList list, const Box<2>& part);

// A contact sheet: several pictures a page, each with its number and caption.
struct SheetGrid {
  static constexpr int kMost = 10;  // across or down: more could not be read
  int columns = 1, rows = 1;
  std::size_t pictures() const { return static_cast<std::size_t>(columns) * rows; }
};

// "3x2" is three across and two down. Nothing for other words, and beyond kMost.
std::optional<SheetGrid> sheet_grid(std::string_view words);

struct SheetPicture {
  DrawList list;  // made for SheetLayout::picture()
  std::string number, caption;
};

// What stands above and below the pictures; nothing where it is empty.
struct SheetWords {
  std::string title, page;  // "page 2 of 5"
};

// Where everything stands on the pages of a sheet. Pictures keep their own units, so that they are
// drawn as they would be alone; type has its size from the paper.
class SheetLayout {
 public:
  // No type is smaller than this, in points, unless too little room is left then: a picture is laid
  // out on so few units that its smallest letters are as large.
  static constexpr double kLeastPoints = 6;

  // The paper, in millimetres. Throws Refused if it is so long or so high that pictures of the grid
  // have no room.
  SheetLayout(const Vec<2>& paper, const SheetGrid& grid, double least_points = kLeastPoints);

  const Vec<2>& paper() const { return paper_; }
  const SheetGrid& grid() const { return grid_; }
  // The page that a picture is to be drawn for, page units.
  const Vec<2>& picture() const { return picture_; }
  // Is that enough, with such type?
  bool is_roomy() const { return is_roomy_; }
  // Of a picture on the paper, square millimetres.
  double area() const { return picture_.x * picture_.y / (units_ * units_); }

  // At most as many pictures as the grid has places, in the order of reading.
  DrawList page(const std::vector<SheetPicture>& pictures, const SheetWords& words) const;

 private:
  void add_words(const SheetWords& words, DrawList& list) const;
  void add_picture(const SheetPicture& picture, const Vec<2>& corner, DrawList& list) const;

  Vec<2> paper_;
  SheetGrid grid_;
  double units_ = 1;  // page units a millimetre
  double unit_ = 1;   // the same of an A4 page, or its share of another one
  double least_ = 0;  // type, page units
  bool is_roomy_ = false;
  Vec<2> page_{0.0}, picture_{0.0};
  Vec<2> cell_{0.0};       // picture and caption, page units
  double type_ = 0;        // em of captions, page units
  std::size_t lines_ = 0;  // of a caption
};

}  // namespace lantern::publish
