// [atlas], [[texture]] and [[texture_pattern]].
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "base/random.hpp"
#include "language/keys/key.hpp"
#include "language/tables/draft.hpp"

namespace lantern::language {

// Not in the namespace below, where it would hide every other `names`.
enum class PatternOrder { as_made, tallest_first };
inline EnumNames names(PatternOrder) { return {"as_made", "tallest_first"}; }

namespace {

struct TexturePatternSpec {
  std::string name;
  std::size_t count = 1;
  int multiple = 1;
  PatternOrder order = PatternOrder::as_made;
  int color = 0;  // 0: each the next
};

// How many of them there are to be: those that go over the limit are cut, but for one that bears
// the name, so that it is known to those who use it.
std::size_t count_textures(std::size_t count, Place where, Draft& draft) {
  const std::size_t before = draft.scenario.textures.size();
  if (draft.has_room_for(before + count, kMostTextures, "textures", where)) return count;
  return before < kMostTextures ? kMostTextures - before : 1;
}

void read_texture(const TableReader& table, TextureSpec& texture, Draft& draft) {
  const auto size = table.get<Vec<2>>("size").value_or(Vec<2>(1.0));
  texture.width = static_cast<int>(size.x);
  texture.height = static_cast<int>(size.y);
  count_textures(1, table.where(), draft);
  if (!texture.name.empty())
    draft.textures.add(texture.name, {draft.scenario.textures.size(), 1, table.place("name")}, true,
                       draft.problems);
  draft.scenario.textures.push_back(texture);
}

// Multiples of `multiple` between two lengths, counted in that unit.
struct Lengths {
  std::int64_t least = 1;
  std::int64_t most = 1;
};

Lengths read_lengths(const TableReader& table, int axis, std::int64_t multiple) {
  const auto least = std::int64_t(table.get<Vec<2>>("min").value_or(Vec<2>(1.0))[axis]);
  const auto most = std::int64_t(table.get<Vec<2>>("max").value_or(Vec<2>(1e9))[axis]);
  const Lengths lengths{(least + multiple - 1) / multiple, most / multiple};
  if (lengths.least <= lengths.most) return lengths;
  table.bad_value(table.has("max") ? "max" : "min",
                  fmt::format("no {} from {} to {} is a multiple of {}",
                              axis == 0 ? "width" : "height", least, most, multiple));
  return {};
}

void read_texture_pattern(const TableReader& table, TexturePatternSpec& pattern, Draft& draft) {
  const Lengths widths = read_lengths(table, 0, pattern.multiple);
  const Lengths heights = read_lengths(table, 1, pattern.multiple);
  pattern.count = count_textures(pattern.count, table.place("count"), draft);
  if (pattern.name.empty()) return;

  Random random(derived_seed(table, pattern.name, draft));
  std::vector<TextureSpec> made(pattern.count);
  for (TextureSpec& texture : made) {
    texture.width = static_cast<int>(random.whole(widths.least, widths.most)) * pattern.multiple;
    texture.height = static_cast<int>(random.whole(heights.least, heights.most)) * pattern.multiple;
    texture.where = draft.position(table.where());
  }
  if (pattern.order == PatternOrder::tallest_first)
    std::ranges::stable_sort(made, [](const TextureSpec& a, const TextureSpec& b) {
      return a.height != b.height ? a.height > b.height : a.width > b.width;
    });

  auto& textures = draft.scenario.textures;
  const NamedRange all{textures.size(), pattern.count, table.place("name")};
  if (!draft.textures.add(pattern.name, all, true, draft.problems)) return;
  for (std::size_t i = 0; i < pattern.count; ++i) {
    made[i].name = fmt::format("{}{}", pattern.name, i + 1);
    made[i].color = cycled_color(pattern.color, i);
    const NamedRange one{textures.size(), 1, table.place("name")};
    draft.textures.add(made[i].name, one, false, draft.problems);
    textures.push_back(std::move(made[i]));
  }
}

// One texture of that name, not all of a pattern.
std::optional<std::size_t> one_texture(const Named& name, Draft& draft) {
  const NamedRange* found = draft.textures.find(name.name);
  if (found && found->count == 1) return found->first;
  if (found)
    draft.problems.add(name.where, fmt::format("'{}' is a pattern of textures", name.name),
                       fmt::format("name one of its textures, as '{}1'", name.name));
  else
    draft.problems.add_unknown(name.where, "texture", name.name,
                               [&known = draft.textures] { return known.declared(); });
  return std::nullopt;
}

void read_element(const TableReader& table, ElementSpec& element, Draft& draft) {
  const AtlasSpec* atlas = draft.scenario.atlas ? &*draft.scenario.atlas : nullptr;
  if (!atlas || atlas->screen_width == 0)
    return draft.problems.add(table.where(), "an [[element]] needs a screen",
                              "give [atlas] screen = [256, 144]");
  const auto name = table.named("texture");
  const auto at = table.get<Vec<2>>("at");
  if (!name || !at) return;
  const auto texture = one_texture(*name, draft);
  if (!texture) return;
  element = {*texture, static_cast<int>(at->x), static_cast<int>(at->y)};
  const TextureSpec& t = draft.scenario.textures[*texture];
  const int right = atlas->screen_width - t.width, bottom = atlas->screen_height - t.height;
  if (element.x > right || element.y > bottom)
    return table.bad_value(
        "at",
        fmt::format("'{}' ({} × {}) reaches beyond the screen ({} × {})", t.name, t.width, t.height,
                    atlas->screen_width, atlas->screen_height),
        right < 0 || bottom < 0 ? std::string("enlarge the screen")
                                : fmt::format("at most [{}, {}]", right, bottom));
  draft.scenario.elements.push_back(element);
}

}  // namespace

TableDoc atlas_table() {
  using A = AtlasSpec;
  TableDoc table = {"atlas", "[atlas]",
                    "One large image that textures are packed into, by a kD-tree. Its origin is "
                    "the upper left corner."};
  table.keys = {
      key(KeyType::size, "size", "Its width and height; it is also written as an image.", must(),
          range(1, kMostAtlas), in("px")),
      key(&A::rule, "rule",
          "`first_fit`: each texture takes the first leaf that it fits, in order of descent, so "
          "that n textures may look at n²/2 leaves. `best_texture`: the free leaves choose, of all "
          "textures that a `pack` brings, the one that leaves least of them.",
          by_hand()),
      key(&A::turn, "turn",
          "May textures be turned by 90°? By `first_fit` they are if they fit nowhere as they are.",
          by_hand()),
      key(&A::trials, "trials",
          "Of `best_texture`: packings that are tried at most; there are 6, with `turn` 18. The "
          "first that packs all is taken, or the one that packs most.",
          range(1, kMostTrials), by_hand(1, 18)),
      key(KeyType::size, "screen",
          "The width and height of a screen that is drawn from the textures, element by element.",
          range(1, kMostPixels), in("px"), or_else("none")),
      key(&A::quiet, "quiet", "What is intended and needs no warning, as in [world].",
          one_of({"expect", "needs"}), or_else("nothing"))};
  return table;
}

TableDoc texture_table() {
  using T = TextureSpec;
  TableDoc table = {"texture", "[[texture]]",
                    "A texture. It enters the atlas when a step packs it."};
  table.keys = {
      key(&T::name, "name", "Unique over textures and their patterns.", must(), like(kNamePattern)),
      key(KeyType::size, "size", "Its width and height.", must(), range(1, kMostPixels), in("px")),
      key(&T::color, "color", "As a body's.", range(1, 8)),
      key(&T::picture, "picture", "What is seen on it; a `pattern` is like no other near it."),
      key(&T::later, "later",
          "It is not among those that wait, but comes with the step that packs it."),
  };
  return table;
}

TableDoc texture_pattern_table() {
  using P = TexturePatternSpec;
  TableDoc table = {
      "texture_pattern", "[[texture_pattern]]",
      "Many textures at once, of random sizes. Those of pattern `t` are called `t1`, `t2`, …"};
  table.keys = {
      key(&P::name, "name", "Unique over textures and their patterns.", must(), like(kNamePattern)),
      key(&P::count, "count", "How many; 20000 textures in all are allowed.", must(),
          range(1, kMostTextures), in("textures"), by_hand(1, 100)),
      key(KeyType::size, "min", "The least width and height.", must(), range(1, kMostPixels),
          in("px")),
      key(KeyType::size, "max", "The largest width and height.", must(), range(1, kMostPixels),
          in("px")),
      key(&P::multiple, "multiple", "Widths and heights are multiples of it.",
          range(1, kMostPixels), in("px")),
      key(&P::order, "order", "In which they are named and packed.", by_hand()),
      key(&P::color, "color", "As a body's; 0 cycles through 1 to 8.", range(0, 8)),
      key(KeyType::whole, "seed", "Of this pattern alone.", range(0, kMostWhole),
          or_else("from the scenario's seed and the name")),
  };
  return table;
}

TableDoc element_table() {
  TableDoc table = {"element", "[[element]]",
                    "A texture's place on the [atlas]'s `screen`, as large as the texture. Later "
                    "elements lie over earlier ones."};
  table.keys = {
      key(KeyType::text, "texture", "Its texture, by name.", must()),
      key(KeyType::size, "at", "Its upper left corner, from that of the screen.", must(),
          range(0, kMostPixels), in("px")),
  };
  return table;
}

void read_atlas(const TableReader& file, Draft& draft) {
  if (file.has("atlas")) draft.scenario.atlas.emplace();  // a bad one is told once
  for (const TomlValue* value : file.tables("atlas")) {
    const TableReader table = open(*value, language_table("atlas"), draft);
    const auto size = table.get<Vec<2>>("size").value_or(Vec<2>(1.0));
    AtlasSpec& atlas = *draft.scenario.atlas;
    table.fill(atlas);
    atlas.width = static_cast<int>(size.x);
    atlas.height = static_cast<int>(size.y);
    const auto screen = table.get<Vec<2>>("screen").value_or(Vec<2>(0.0));
    atlas.screen_width = static_cast<int>(screen.x);
    atlas.screen_height = static_cast<int>(screen.y);
    atlas.where = draft.position(value->where);
    if (file.has("world"))
      draft.problems.add(value->where, "a scenario has either a [world] or an [atlas], not both",
                         "write two scenarios");
  }
  const auto textures = file.tables("texture");
  const auto patterns = file.tables("texture_pattern");
  if (!file.has("atlas") && (!textures.empty() || !patterns.empty()))
    draft.problems.add((textures.empty() ? patterns : textures)[0]->where,
                       "textures need an [atlas]", "add [atlas] with size = [512, 512]");
  const auto read_with = [&](auto& read) {
    return [&](const TableReader& table, auto& spec) { read(table, spec, draft); };
  };
  for_each<TextureSpec>(file, "texture", draft, read_with(read_texture));
  for_each<TexturePatternSpec>(file, "texture_pattern", draft, read_with(read_texture_pattern));
  for_each<ElementSpec>(file, "element", draft, read_with(read_element));
}

}  // namespace lantern::language
