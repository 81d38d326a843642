// Marks of a world, each written once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "draw/labels.hpp"
#include "draw/projection.hpp"
#include "frame/pair_state.hpp"

namespace lantern::draw {

// In a 2D world they are drawn as they come, cut to `place`; in a 3D one (Marks3D) they are sorted
// with what hides them.
class Marks {
 public:
  Marks(const Projection& projection, const Box<2>& place, DrawList& list)
      : projection_(projection), place_(place), list_(list), over_(&list) {}
  virtual ~Marks() = default;

  // With a `casing` of the panel's tone on both sides of it, a line can be told from what it
  // crosses.
  virtual void line(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, double casing = 0);
  // A line with a head at its end, `head` page units long.
  virtual void arrow(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, double head,
                     double casing);
  virtual void spring(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke);
  virtual void box(const Box<3>& box, const Stroke& stroke);
  virtual void ball(const Vec<3>& center, double radius, const Stroke& stroke);

  // What is drawn with it lies over all that bodies may hide, in the marks' place.
  Pen over() const { return {*over_, place_}; }
  void dot(const Vec<3>& at, double radius, Role fill, const Stroke& stroke = {}) const;
  // The mark of two boxes that overlap, over all else.
  void overlap_mark(const Vec<3>& at) const;

  const Projection& projection() const { return projection_; }
  const Box<2>& place() const { return place_; }
  // What is drawn is such a mark, for the legend; and shows a number, for the caption.
  void tell(MarkKind kind) const { list_.marks.add(kind); }
  void depict(std::string_view number) const { list_.referents.emplace(number); }

  // What is marked until it ends shows this, as DrawList::Scope says.
  class Scope {
   public:
    Scope(const Marks& marks, const std::string& key, const std::string& from = {})
        : scope_(marks.list_, key, from) {
      if (marks.over_ != &marks.list_) over_.emplace(*marks.over_, key, from);
    }

   private:
    DrawList::Scope scope_;
    std::optional<DrawList::Scope> over_;
  };

 protected:
  // Of a 2D world, where all is seen.
  Vec<2> to_page(const Vec<3>& p) const { return *projection_.seen(p); }

  const Projection& projection_;
  Box<2> place_;
  DrawList& list_;
  DrawList* over_;
};

// The link of a pair, from outline to outline, by how far the pair has come; nothing for a contact,
// which has a mark of its own. `full`: else thin and pale, one among many.
struct LinkLook {
  frame::PairState state = frame::PairState::candidate;
  bool full = true;
  bool lit = false;
};
MarkKind kind_of(const LinkLook& look);
Stroke stroke_of(const LinkLook& look);
void draw_link(const Vec<2>& from, const Vec<2>& to, const LinkLook& look, Pen& pen);
// What is ruled out by shapes has a cross in the middle of its link.
void draw_cross(const Vec<2>& at, Role role, Pen& pen);

// An opening between two sectors of a level, and a line of sight through such.
void draw_portal(const Vec<2>& from, const Vec<2>& to, Pen& pen);
void draw_sight(const Vec<2>& from, const Vec<2>& to, Pen& pen);

// What says in a cell of the ledger how far a pair came. States differ in shape, so that they can
// be told apart in grey and in any size; one that is new is lit.
void draw_pair_mark(frame::PairState state, bool is_new, const Box<2>& cell, DrawList& list);
// Where two boxes share some area of the page.
void draw_overlap(const Box<2>& common, DrawList& list);
// The same of a pair that the structure misses.
void draw_missed(const Box<2>& common, Pen& pen);
// A node left out, with all below it; and a plate with the place of a cell on a ray's way, from 1.
// False, and nothing is drawn, where there is no room.
inline constexpr double kSkipRadius = 10;
void draw_skipped(const Vec<2>& at, DrawList& list);
bool draw_met(std::uint32_t place, const Vec<2>& at, const Box<2>& room, DrawList& list,
              Labels& labels);
void draw_tick(const Vec<2>& at, DrawList& list);
// A thin line inside the border of what the step has passed.
inline constexpr Stroke kPassedStroke{Role::lit, 1.6};
inline constexpr double kPassedInset = 5;
void mark_passed(frame::Mark mark, const Box<2>& box, DrawList& list, double radius = 0);
// The middle of a ball that is asked for, and two points held together.
void draw_centre(const Vec<2>& at, Pen& pen);
void draw_pin(const Vec<2>& at, Pen& pen);

// A contact: a bar along the normal, which points along `normal` of the page; `k` makes it smaller
// among many.
void draw_contact(const Vec<2>& at, const Vec<2>& normal, double k, Pen& pen);
void draw_beginning(const Vec<2>& at, double k, Pen& pen);
void draw_impulse(const Vec<2>& from, const Vec<2>& to, double k, Pen& pen);
inline constexpr Stroke kVelocityStroke{Role::ink, 1.9};
inline constexpr double kVelocityHead = 10;
inline constexpr Stroke kSpinStroke{Role::contact, 3};
inline constexpr double kSpinHead = 15;
// Of a box's own axes: 0 the longest, 1 the middle one, 2 the shortest.
constexpr Stroke own_axis_stroke(int rank) {
  return {Role::ink, 2.4, rank == 0 ? 0.0 : rank == 1 ? 9.0 : 3.0};
}
inline constexpr Stroke kForceStroke{Role::warning, 4.6};
inline constexpr double kForceHead = 18;
// The way of a body, its outlines where it was, where it would be, and where it is looked at.
void draw_way(const std::vector<Vec<2>>& points, Pen& pen);
inline constexpr Stroke kTrailStroke{Role::quiet_ink, 2.2};
inline constexpr Stroke kAheadStroke{Role::quiet_ink, 2.2, 5};
inline constexpr Stroke kLookStroke{Role::ray, 2.4};
// A line between two ticks.
void draw_ruler(const Vec<2>& from, const Vec<2>& to, const Stroke& stroke, Pen& pen);

// Of many pairs, those whose links are drawn in full: of bodies that the step is about, then those
// that are new; all where there are few. One for each pair of the frame.
inline constexpr std::size_t kMostFullLinks = 12;
std::vector<bool> full_links(const Frame& frame);

// The corners of a spring's line, which turns to and fro across its way; none for a short one.
std::vector<Vec<2>> spring_bends(const Vec<2>& from, const Vec<2>& to);

// Springs, joints and pins with their ends; velocities, the faster the longer by one rule for all
// frames, from the bodies' outlines on, none of what hardly moves; forces with their sizes, the
// largest of the frame the longest.
void mark_links(const Frame& frame, Marks& marks);
void mark_velocities(const Frame& frame, Marks& marks);
void mark_forces(const Frame& frame, Marks& marks);
// In space, the axis of each body's spin, and the three of a box whose sides differ.
void mark_spins(const Frame& frame, Marks& marks);
void write_forces(const Frame& frame, const Projection& view, Labels& labels);
// Lengths, with a ghost of what they were.
void mark_rulers(const Frame& frame, Marks& marks, Labels& labels);
// Points, normals and impulses. False if there are too many, and not all are drawn.
bool mark_contacts(const Frame& frame, const Marks& marks);

// "12 mm", "0.34 mm", "1.5 m": two figures, and a unit that keeps them readable. "0" below a
// nanometre. A unit of the world is taken for a metre.
std::string depth_text(double depth);

// The deepest point of each contact, beside all of the contact's points: free of labels and, as far
// as there is room, of `bodies`, their boxes on the page. The deepest contacts come first; what has
// no room is left out.
void write_depths(const Frame& frame, const Projection& view, const std::vector<Box<2>>& bodies,
                  Labels& labels);

// Pairs that a stale structure misses, with the word.
void mark_missed(const Frame& frame, const Marks& marks, Labels& labels);

// What is asked for: the outlines of views, regions and rays; the eyes of views, cut to `place`;
// the rays' starts and hits, numbered when there are several.
void mark_views(const Frame& frame, Marks& marks);
void mark_queries(const Frame& frame, Marks& marks);
void mark_rays(const Frame& frame, Marks& marks);
void mark_eyes(const Frame& frame, const Projection& projection, const Box<2>& place,
               DrawList& list);
void mark_hits(const Frame& frame, const Marks& marks, Labels& labels);
// A tick at each body that a view or region has found.
void mark_found(const Frame& frame, const Marks& marks, DrawList& list);

// An eye at a place of the page that looks along `gaze`.
void draw_eye(const Vec<2>& at, const Vec<2>& gaze, Role role, const Box<2>& place, DrawList& list);

// Bodies whose boxes coincide, of those given: each list two or more, the last of which is on top.
using Stack = std::vector<const FrameBody*>;
std::vector<Stack> stacks_of(std::span<const FrameBody* const> bodies);
// How many lie over each other in each of these boxes, "×3", and while they are few their faces: at
// its upper right, or where others have taken that as near as there is room, beside it free of
// `covered` places if it can be.
void draw_stacks(const std::vector<std::pair<Stack, Box<2>>>& stacks,
                 const std::vector<Box<2>>& covered, const Box<2>& panel, DrawList& list,
                 Labels& labels);

// What a body's own picture says of it.
void tell_marks(const FrameBody& body, DrawList& list);

// The first `most` of them: more are not drawn on one frame.
template <class T>
std::span<const T> first_of(const std::vector<T>& all, std::size_t most) {
  return {all.data(), std::min(all.size(), most)};
}

inline constexpr std::size_t kMostViews = 8;
inline constexpr std::size_t kCrowd = 700;  // more bodies than this are not drawn one by one

}  // namespace lantern::draw
