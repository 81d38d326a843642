// A part is told whole by its list of fields, whoever defines it.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "frame/part_fields.hpp"
#include "frame/parts/motion.hpp"

namespace lantern::run {
namespace {

// A part that nobody else knows.
struct Stars {
  static constexpr std::string_view kName = "stars";
  struct Star {
    Vec<3> at{0.0};
    std::optional<double> radius;
    bool bright = false;
    int color = 1;

    static decltype(auto) fields(const auto& r, auto&& v) {
      return v("at", r.at)("radius", r.radius)
          .words("kind", r.bright, "dim", "bright")
          .drawn(r.color);
    }
  };
  std::vector<Star> stars;
  std::string sky;

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("stars", r.stars).when(!r.sky.empty(), "sky", r.sky);
  }
  void add_state(Hash& hash) const { hash.add(std::uint64_t{stars.size()}); }
};

// One member of each is in no list.
struct Forgetful {
  int told = 0;
  std::vector<int> forgotten;
  static decltype(auto) fields(const auto& r, auto&& v) { return v("told", r.told); }
};
struct ForgetfulAtHeart {
  std::optional<double> forgotten;
  static decltype(auto) fields(const auto&, auto&& v) { return v.drawn(); }
};

TEST(Parts, AListOfFieldsHasAllMembers) {
  EXPECT_TRUE(tells_all_members<Stars>() && tells_all_members<Stars::Star>());
  EXPECT_FALSE(tells_all_members<Forgetful>()) << "so that it could not be a part";
  EXPECT_FALSE(tells_all_members<ForgetfulAtHeart>());
}

TEST(Parts, AreToldByTheirFieldsBehindThoseOfLantern) {
  Frame frame;
  const std::string without = to_json(frame);
  const std::size_t bytes = estimated_bytes(frame);
  const std::uint64_t hash = state_hash(frame);
  EXPECT_EQ(frame.find<Stars>(), nullptr);
  EXPECT_TRUE(frame.get<Stars>().stars.empty());

  frame.add<Stars>().stars = {{{1, 2, 3}, 0.5, true, 4}, {{4, 5, 6}, {}, false, 1}};
  frame.add<FrameLinks>();
  const auto facts = nlohmann::ordered_json::parse(to_json(frame));
  EXPECT_EQ(facts["stars"].dump(),
            R"([{"at":[1,2],"radius":0.5,"kind":"bright"},{"at":[4,5],"kind":"dim"}])");
  EXPECT_FALSE(facts.contains("sky"));
  std::vector<std::string> names;
  for (const auto& member : facts.items()) names.push_back(member.key());
  const auto at = [&](const char* name) { return std::ranges::find(names, name) - names.begin(); };
  EXPECT_LT(at("contacts"), at("links"));
  EXPECT_LT(at("links"), at("stars"));
  EXPECT_LT(at("stars"), at("counts"));
  EXPECT_GE(estimated_bytes(frame), bytes + sizeof(Stars) + 2 * sizeof(Stars::Star));
  EXPECT_NE(state_hash(frame), hash);

  Frame copy = frame;
  copy.add<Stars>().sky = "clear";
  EXPECT_TRUE(frame.get<Stars>().sky.empty()) << "copies have parts of their own";
  EXPECT_EQ(copy.get<Stars>().stars.size(), 2u);
  frame.drop<Stars>();
  frame.put<FrameLinks>(std::nullopt);
  EXPECT_EQ(to_json(frame), without);
  EXPECT_EQ(estimated_bytes(frame), bytes);
}

TEST(Parts, OfLanternHaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const PartType* type : part_order()) EXPECT_TRUE(names.insert(type->name).second);
  EXPECT_GT(names.size(), 10u);
}

}  // namespace
}  // namespace lantern::run
