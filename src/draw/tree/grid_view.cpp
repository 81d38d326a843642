// A grid as an array: of its cells, or of the buckets that a spatial hash puts them into.
//
//    1 [ @   ][     ][ @ @ ][     ]
//    5 [     ][ @|@ ][     ][     ]     slot 6: a bucket that two cells share
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/body_shapes.hpp"
#include "draw/marks.hpp"
#include "draw/number_text.hpp"
#include "draw/panel.hpp"
#include "spatial/structure.hpp"

namespace lantern::draw {
namespace {

constexpr double kGridHeading = 38, kGridBetween = 18;
constexpr double kMostSlot = 260, kLeastShownSlot = 5;  // widths
constexpr double kLeastChip = 15, kMostChip = 40;       // of a body in a slot
constexpr double kLeastCounted = 30;                    // width of a slot that has a number in it

// The cells in a slot of the array.
using CellsOfSlot = std::map<std::uint32_t, std::vector<const FrameNode*>>;

class GridView : PanelPicture {
 public:
  explicit GridView(const PanelPicture& on) : PanelPicture(on) {
    levels_.resize(structure_.grid_levels.size());
    std::vector<std::size_t> level(frame_.nodes.size());
    for (std::size_t i = 1; i < frame_.nodes.size(); ++i) {
      const FrameNode& node = frame_.nodes[i];
      level[i] = node.depth == 1 && levels_.size() > 1 ? node.slot : level[node.parent];
      if (!node.leaf) continue;
      if (node.slot == kGridLarge)
        large_ = &node;
      else
        levels_[level[i]][structure_.hashed ? frame_.nodes[node.parent].slot : node.slot].push_back(
            &node);
    }
  }

  void draw() {
    if (panel_.size().x < 120 || panel_.size().y < 120) return;
    if (large_) draw_large();
    const auto rows = sum_of<double>(
        structure_.grid_levels, [](const GridExtent& e) { return static_cast<double>(e.rows); });
    const auto levels = static_cast<double>(levels_.size());
    const double room = panel_.size().y - levels * (kGridHeading + kGridBetween);
    double y = panel_.lo.y;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      const double share = static_cast<double>(structure_.grid_levels[i].rows) / rows;
      const Box<2> place{{panel_.lo.x, y}, {panel_.hi.x, y + kGridHeading + share * room}};
      y = draw_level(i, place) + kGridBetween;
    }
  }

 private:
  std::string heading_of(const GridExtent& extent) const {
    const auto all = number_text(static_cast<double>(extent.columns * extent.rows));
    const std::string size = levels_.size() > 1 ? say("cells of {:g}: ", extent.side) : "";
    return size + (structure_.hashed ? say("a table of {} buckets", all)
                                     : say("one array of {} cells", all));
  }

  // Where it ends.
  double draw_level(std::size_t level, const Box<2>& place) {
    const GridExtent& extent = structure_.grid_levels[level];
    write(shortened(heading_of(extent), place.size().x, kStrong),
          {{place.lo.x, place.lo.y + 0.8 * kLabel}, 0}, kStrong);
    const double gutter = Labels::width_of(extent.columns * extent.rows, kQuiet) + 12;
    const Vec<2> origin{place.lo.x + gutter, place.lo.y + kGridHeading};
    double width =
        std::min(kMostSlot, (place.hi.x - origin.x) / static_cast<double>(extent.columns));
    const double height =
        std::min(0.8 * width, (place.hi.y - origin.y - (structure_.hashed ? 34 : 0)) /
                                  static_cast<double>(extent.rows));
    width = std::min(width, 3 * height);
    if (width < kLeastShownSlot || height < kLeastShownSlot) return origin.y;
    slot_ = {width, height};
    const Vec<2> whole{width * static_cast<double>(extent.columns),
                       height * static_cast<double>(extent.rows)};
    draw_empty({origin, origin + whole}, extent);
    number_rows(origin, extent);
    for (const auto& [number, cells] : levels_[level]) {
      const Vec<2> lo =
          origin + Vec<2>(static_cast<double>(number % extent.columns) * width,
                          static_cast<double>(line_of(number / extent.columns, extent)) * height);
      const DrawList::Scope scope(
          list_, fmt::format("grid/{}x{}/{}", extent.columns, extent.rows, number));
      draw_slot(cells, {lo, lo + slot_});
    }
    return origin.y + whole.y;
  }

  void draw_empty(const Box<2>& whole, const GridExtent& extent) {
    list_.crisp_rect(whole, Role::free_space, {Role::cell_line_3, 1.2, 4});
    if (slot_.y < 10) return;
    for (std::uint64_t i = 1; i < extent.columns; ++i) {
      const double x = whole.lo.x + static_cast<double>(i) * slot_.x;
      list_.crisp_line({x, whole.lo.y}, {x, whole.hi.y}, {Role::cell_line_3, 1.2, 4});
    }
    for (std::uint64_t i = 1; i < extent.rows; ++i) {
      const double y = whole.lo.y + static_cast<double>(i) * slot_.y;
      list_.crisp_line({whole.lo.x, y}, {whole.hi.x, y}, {Role::cell_line_3, 1.2, 4});
    }
  }

  // A hash's rows go upwards, as those of the world do that they are the remainders of.
  std::uint64_t line_of(std::uint64_t row, const GridExtent& extent) const {
    return structure_.hashed ? extent.rows - 1 - row : row;
  }

  // The number of its first slot before each row, as far as there is room; of a hash the remainders
  // that rows and columns stand for.
  void number_rows(const Vec<2>& origin, const GridExtent& extent) {
    double last = -1e9;
    for (std::uint64_t row = 0; row < extent.rows; ++row) {
      const double y = origin.y + (static_cast<double>(row) + 0.5) * slot_.y;
      if (y < last + 30) continue;
      last = y;
      const std::uint64_t number =
          structure_.hashed ? line_of(row, extent) : row * extent.columns + 1;
      write(number_text(static_cast<double>(number)), centred({origin.x - 8, y}, kQuiet, 1),
            kQuiet);
    }
    const double under = origin.y + static_cast<double>(extent.rows) * slot_.y + 18;
    for (std::uint64_t i = 0; structure_.hashed && slot_.x >= 30 && i < extent.columns; ++i)
      write(number_text(static_cast<double>(i)),
            centred({origin.x + (static_cast<double>(i) + 0.5) * slot_.x, under}, kQuiet), kQuiet);
  }

  void draw_slot(const std::vector<const FrameNode*>& cells, const Box<2>& box) {
    Mark mark = Mark::quiet;
    std::size_t count = 0;
    for (const FrameNode* cell : cells) {
      mark = std::max(mark, cell->mark);
      count += cell->bodies.size();
    }
    const bool shared = cells.size() > 1, lit = mark == Mark::lit;
    const Stroke outline = lit      ? Stroke{Role::lit, 2.8}
                           : shared ? Stroke{Role::ink, 3.2}
                                    : Stroke{Role::cell_line_1, 1.8};
    const double chip = chip_for(count + cells.size() - 1, box.size() - 6.0, !shared);
    const bool crowded = chip < kLeastChip;
    const Role ground = crowded && box.size().x < kLeastCounted
                            ? (count > 1 ? Role::quiet_ink : Role::static_body)
                            : ground_of(mark);
    list_.crisp_rect(box, ground, outline);
    mark_passed(mark, box, list_);
    if (!crowded)
      draw_bodies(cells, chip, box);
    else if (box.size().x >= kLeastCounted && box.size().y >= kLabel)
      write(number_text(static_cast<double>(count)), centred(box.center(), kStrong), kStrong);
  }

  // The largest at which so many have room, in rows or in one.
  static double chip_for(std::size_t places, const Vec<2>& room, bool in_rows) {
    const auto count = static_cast<double>(places);
    if (!in_rows) return std::min({kMostChip, room.y, room.x / count});
    double chip = kMostChip;
    while (chip > 1 && std::floor(room.x / chip) * std::floor(room.y / chip) < count) --chip;
    return chip;
  }

  // In rows, with a line between one cell's and the next one's.
  void draw_bodies(const std::vector<const FrameNode*>& cells, double chip, const Box<2>& box) {
    std::size_t places = cells.size() - 1;
    for (const FrameNode* cell : cells) places += cell->bodies.size();
    const auto most = static_cast<std::size_t>((box.size().x - 6) / chip + 1e-9);
    const std::size_t rows = (places + most - 1) / most, columns = (places + rows - 1) / rows;
    const Vec<2> first =
        box.center() -
        0.5 * chip * Vec<2>(static_cast<double>(columns) - 1, static_cast<double>(rows) - 1);
    std::size_t place = 0;
    const auto next = [&] {
      const Vec<2> at = first + chip * Vec<2>(static_cast<double>(place % columns),
                                              static_cast<double>(place / columns));
      ++place;
      return at;
    };
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i > 0) {
        const Vec<2> at = next(), up{0, 0.5 * chip};
        list_.crisp_line(at - up, at + up, {Role::ink, 2});
      }
      for (const BodyId id : cells[i]->bodies) {
        const Box<2> icon = Box<2>::around(next(), Vec<2>(0.44 * chip));
        if (const FrameBody* body = body_of(bodies_, id)) draw_character(*body, icon, false, list_);
      }
    }
  }

  // What reaches too many cells, under all tables.
  void draw_large() {
    const std::string words = word("in too many cells, held apart:");
    const double y = panel_.hi.y - 0.5 * kGridHeading;
    write(words, centred({panel_.lo.x, y}, kQuiet, 0), kQuiet);
    double x = panel_.lo.x + text_width(words, kQuiet) + 24;
    for (const BodyId id : large_->bodies) {
      if (x > panel_.hi.x - 16) break;
      if (const FrameBody* body = body_of(bodies_, id))
        draw_character(*body, Box<2>::around({x, y}, Vec<2>(14)), false, list_);
      x += 34;
    }
    panel_.hi.y -= kGridHeading;
  }

  const FrameStructure& structure_ = frame_.get<FrameStructure>();
  BodiesById bodies_ = by_id(frame_.bodies);
  std::vector<CellsOfSlot> levels_;
  const FrameNode* large_ = nullptr;
  Vec<2> slot_{0.0};  // its size
};

}  // namespace

void draw_grid(const PanelPicture& on) { GridView(on).draw(); }

}  // namespace lantern::draw
