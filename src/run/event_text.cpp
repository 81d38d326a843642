#include "run/event_text.hpp"

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/words.hpp"

namespace lantern::run {
namespace {

std::string place_of(const std::string& node) {
  if (node.empty()) return word("an inner node");
  return node == "root" ? word("the root") : say("node {}", node_words(node));
}

// What is said of events, in the order of Event::Kind: {0} is the body and {1} the node, {2} and
// {3} the same with a capital; {4} is how many the node holds, {5} its limit, {6} the depth limit.
constexpr const char* kTexts[] = {
    "{2} reaches {1}.",
    "{2} does not reach {1}.",
    "{3} is made, because something enters it.",
    "{3} stores {0} and now holds {4}, more than its limit of {5}.",
    "{3} holds {4}, but its limit is {5}, so it must split.",
    "{3} hands {0} down to its children.",
    "{3} holds {4}, and its limit is {5}. But it lies at depth {6}, and no node may lie deeper: it "
    "stays a leaf.",
    "{3} holds {4}, and its limit is {5}. But all share one point, so a split would separate no "
    "pair.",
    "A rotation: a child of {1} and the sibling of {1} change places, and {1} shrinks.",
    "{2} has left its box: its leaf goes, the sibling takes the parent's place, and {0} is "
    "inserted again."};
// Of a tree that has a leaf for each body, and fits its boxes to them; null if it has no words of
// its own.
constexpr const char* kFittingTexts[std::size(kTexts)] = {
    "{2} comes to {1}: would all boxes together grow least beside it?",
    "{3} would grow more by {0}: it is left out.", nullptr, "{3} is the leaf of {0}.",
    "A new node takes the place of {1}: it holds what was there, and {0}."};
// Of an atlas, in the order of AtlasEvent::Kind: {0} is the node, {1} the texture.
constexpr const char* kAtlasTexts[] = {
    "The free leaf {0} is too small for {1}.", "This leaf already holds {0}.",
    "The free leaf {0} has room for {1}. It is cut to fit.",
    "This leaf has exactly the size of {1}: it is stored here.",
    "No leaf has room for {1}: it is refused, the rest is kept."};

}  // namespace

std::string capitalised(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = char(text[0] - 'a' + 'A');
  return text;
}

std::string_view event_name(Event::Kind kind) {
  static constexpr std::string_view kNames[] = {"test",   "miss",      "make_child",  "store",
                                                "split",  "hand_down", "depth_limit", "no_progress",
                                                "rotate", "leave"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view event_name(AtlasEvent::Kind kind) {
  static constexpr std::string_view kNames[] = {"too_small", "used", "cut", "store", "refuse"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string event_text(const Event& e, const StructureSpec& structure, const std::string& node,
                       const std::string& body) {
  const StructureTraits& traits = traits_of(structure.kind);
  if (!traits.is_tree)
    return say("{} lists {}: {} in all.", capitalised(word(traits.words)), body, e.count);
  const auto kind = static_cast<std::size_t>(e.kind);
  const bool has_own = traits.holds_once && kFittingTexts[kind] != nullptr;
  const char* text = has_own ? kFittingTexts[kind] : kTexts[kind];
  if (traits.is_plain && e.kind == Event::Kind::make_child)
    text = "Split makes {1}: one quarter of the node that was too full.";
  if (!has_own && e.kind == Event::Kind::store && (e.limit == 0 || e.count <= e.limit))
    text = e.limit == 0 ? "{3} stores {0} and holds {4}."
                        : "{3} stores {0} and holds {4} of at most {5}.";
  const std::string place = place_of(node);
  return say(fmt::runtime(text), body, place, capitalised(body), capitalised(place), e.count,
             e.limit, structure.max_depth);
}

std::string event_text(const AtlasEvent& e, const std::string& node, const std::string& texture,
                       int width, int height) {
  const std::string size = fmt::format("{} ({} × {})", texture, width, height);
  return say(fmt::runtime(kAtlasTexts[static_cast<std::size_t>(e.kind)]), node_words(node), size);
}

std::string bind_text(const std::string& image, const std::string& bound, std::uint64_t bindings) {
  const std::string count = say("binding {}", bindings);
  if (bound.empty()) return say("Nothing is bound yet. Bind {}: {}.", image, count);
  return say("Next comes {}, but {} is bound. Bind {}: {}.", image, bound, image, count);
}

std::string draw_text(const std::string& texture, bool from_atlas) {
  if (!from_atlas) return say("{} is bound: draw it.", capitalised(texture));
  return say("The atlas is bound: draw {} from its place in it.", texture);
}

std::string query_text(std::string_view event, const std::string& node, const std::string& body) {
  const std::string place = place_of(node);
  if (event == "visit") return say("{} is reached: look inside.", capitalised(place));
  if (event == "skip")
    return say("{} is not reached: it is skipped, with all below it.", capitalised(place));
  if (event == "hit") return say("{} is tested: a hit.", capitalised(body));
  return say("{} is tested: no hit.", capitalised(body));
}

std::string axis_text(const FrameSeparation& separation, const std::string& a,
                      const std::string& b) {
  const FrameAxis& axis = separation.axes.back();
  const std::string where =
      axis.across ? say("perpendicular to a side of {}", *axis.across == separation.a ? a : b)
                  : say("from {} to {}, where they are closest", a, b);
  const std::string name = say("Axis {}, {}", separation.axes.size(), where);
  if (axis.separation > 0)
    return say("{}: a gap of {:.4g}. One gap is enough: they are apart.", name, axis.separation);
  return say("{}: the shadows overlap by {:.4g}.", name, -axis.separation);
}

std::string search_text(const FrameSearch& search, const std::string& a, const std::string& b) {
  const GjkStep& step = search.steps.back();
  const std::size_t n = search.steps.size();
  if (step.ends)
    return say("Search {} finds nothing farther that way: no point is nearer to the origin.", n);
  if (!search.taken && n == 1)
    return say(
        "Search 1, from {} towards {}: farthest point of {}, minus farthest of {} the other way.",
        a, b, a, b);
  if (!search.taken)
    return say("Search {}, straight at the origin: point {} is the farthest that way.", n, n);
  if (step.simplex.size() == 3)
    return word("The origin lies inside the triangle: the bodies have a point in common.");
  const double distance = glm::length(step.nearest);
  if (step.simplex.size() == 1)
    return say("It is {:.4g} from the origin. Search again, straight at the origin.", distance);
  return say("The line of the two points comes nearer: {:.4g}. Again, straight at the origin.",
             distance);
}

std::string look_text(const FrameLook& look) {
  if (look.meets)
    return say("At {:.3f} of the step they touch: the time of impact, found by {} looks.",
               look.time, look.number);
  // A guess, by how fast they come nearer.
  if (look.gap < 0)
    return say("Do they meet by {:.2f} of the step? Yes, they would overlap: too late.", look.time);
  if (!(look.free_until > look.time))
    return say("Do they meet by {:.2f} of the step? Not yet: the gap is {:.2g}.", look.time,
               look.gap);
  return say("At {:.2f} of the step the gap is {:.2g}: it cannot close before {:.2f}.", look.time,
             look.gap, look.free_until);
}

std::string phase_text(std::string_view phase, const Frame& frame) {
  const auto pairs = static_cast<std::int64_t>(frame.pairs.size());
  const auto contacts = static_cast<std::int64_t>(frame.contacts.size());
  if (phase == "broad_phase")
    return say("Broad phase: {}, instead of {} by brute force. These might touch.",
               say_count(pairs, "candidate pair/candidate pairs"),
               frame.count("testable_pairs").value_or(0));
  const std::int64_t overlaps = frame.count("overlaps").value_or(0);
  if (phase == "boxes")
    return say("Broad phase, second part: of {}, {} overlap. Only their shapes need a test.",
               say_count(pairs, "candidate pair/candidate pairs"),
               overlaps == pairs ? word("all") : say("the boxes of {}", overlaps));
  if (phase == "narrow_phase") {
    const std::int64_t tested = frame.count("pairs_tested").value_or(0);
    if (overlaps == 0) return word("Narrow phase: no boxes overlap, so no shapes are tested.");
    const std::string whose = tested != overlaps
                                  ? say("the true shapes of {}", tested)
                                  : noun("its true shapes/their true shapes", overlaps);
    return say("Narrow phase: the boxes of {} overlap; {} are tested. {}.",
               say_count(overlaps, "pair/pairs"), whose,
               say_count(contacts, "really touches/really touch"));
  }
  return say(
      "Resolution: impulses at {} push the bodies apart. Each arrow shows how strong one is.",
      say_count(frame.count("contact_points").value_or(0), "contact point/contact points"));
}

}  // namespace lantern::run
