// The speed of a film.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "app/output/render_job.hpp"
#include "app/output/sinks.hpp"
#include "rooms.hpp"

namespace lantern::app {
namespace {

Frame at(double time, std::uint32_t step = 0, const std::string& caption = "") {
  Frame frame;
  frame.time = time;
  frame.step = step;
  frame.caption = caption;
  return frame;
}

// Goes through a movement of `count` frames that lie `apart` seconds from each other, and gives the
// world's time that each picture shows, beside the time of the film.
std::vector<std::pair<double, double>> movement(FilmClock& clock, double rate, double apart,
                                                int count) {
  std::vector<std::pair<double, double>> seen;
  clock.hold(at(0));
  const double start = static_cast<double>(clock.now() - 1) / rate;
  for (int i = 0; i < count; ++i) {
    const Frame a = at(i * apart), b = at((i + 1) * apart);
    for (const auto& shot : clock.way(a, b, true))
      seen.emplace_back(static_cast<double>(shot.moment) / rate - start, a.time + shot.t * apart);
  }
  return seen;
}

TEST(FilmClock, ShowsTheWorldAtItsOwnSpeed) {
  for (const double rate : {24.0, 25.0, 30.0, 60.0})
    for (const double apart : {0.1, 0.05, 1 / 60.0, 0.007}) {
      FilmClock clock({rate});
      const auto seen = movement(clock, rate, apart, 40);
      EXPECT_NEAR(static_cast<double>(seen.size()), 40 * apart * rate, 1.001);
      for (const auto& [film, world] : seen) EXPECT_NEAR(film, world, 1e-9) << rate << " " << apart;
    }
}

TEST(FilmClock, WithoutInBetweensAFrameStandsUntilTheNextIsDue) {
  FilmClock::Settings settings;
  settings.in_betweens = 0;
  FilmClock clock(settings);
  const auto seen = movement(clock, 30, 0.1, 10);
  ASSERT_EQ(seen.size(), 10u);
  for (std::size_t i = 1; i < seen.size(); ++i) {
    EXPECT_NEAR(seen[i].second, 0.1 * static_cast<double>(i), 1e-9);
    EXPECT_NEAR(seen[i].first, seen[i].second, 1e-9);
  }
  const std::uint64_t before = clock.now();
  EXPECT_TRUE(clock.way(at(1), at(1, 1), true).empty());
  EXPECT_EQ(clock.now(), before) << "a cut takes no time";
}

TEST(FilmClock, AChangeTakesHalfASecond) {
  FilmClock clock({30});
  clock.hold(at(0));
  const std::uint64_t before = clock.now();
  const auto shots = clock.way(at(0), at(0, 1), true);
  EXPECT_EQ(shots.size(), 14u);
  EXPECT_EQ(clock.now(), before + 14);
  EXPECT_NEAR(shots.front().t, 1 / 15.0, 1e-12);
  EXPECT_TRUE(clock.way(at(0), at(0, 1), false).empty()) << "frames lie between: a cut";

  FilmClock::Settings settings;
  settings.in_betweens = 4;
  const auto few = FilmClock(settings).way(at(0), at(0, 1), true);
  ASSERT_EQ(few.size(), 4u);
  for (std::size_t i = 0; i < few.size(); ++i)
    EXPECT_NEAR(few[i].t, static_cast<double>(i + 1) / 5, 1e-12);
}

TEST(FilmClock, AStillStandsUntilItsCaptionIsRead) {
  const std::string caption(90, 'x');  // six seconds
  FilmClock clock({30});
  clock.hold(at(0, 0, caption + "1"));
  EXPECT_EQ(clock.now(), 182u);
  clock.hold(at(1, 0, caption + "22"));
  EXPECT_EQ(clock.now(), 182u + 30u) << "only a number is new";
  const Frame next = at(1, 1, std::string(45, 'y'));
  clock.way(at(1), next, true);
  const std::uint64_t before = clock.now();
  clock.hold(next);
  EXPECT_EQ(clock.now(), before + 90 - 14) << "it was read while the change went on";
}

TEST(FilmClock, HoldIsForEveryStill) {
  FilmClock::Settings settings;
  settings.hold = 0.5;
  FilmClock clock(settings);
  clock.hold(at(0, 0, std::string(200, 'x')));
  EXPECT_EQ(clock.now(), 15u);
  settings.hold = 0;
  FilmClock shortest(settings);
  shortest.hold(at(0));
  EXPECT_EQ(shortest.now(), 1u);
}

TEST(FilmClock, EachStepEndsWithAStill) {
  EXPECT_FALSE(FilmClock::is_still(at(0), at(0.1), true));
  EXPECT_TRUE(FilmClock::is_still(at(0), at(0.1, 1), true));
  EXPECT_TRUE(FilmClock::is_still(at(0), at(0), true));
  EXPECT_TRUE(FilmClock::is_still(at(0), at(0.1), false));
}

TEST(FilmPlan, LastsAsLongAsIsAskedFor) {
  std::vector<Frame> frames;
  for (int i = 0; i < 6; ++i) {
    frames.push_back(at(0.5 * i, static_cast<std::uint32_t>(i), std::string(30 * i, 'a')));
    frames.back().index = static_cast<std::uint32_t>(i);
  }
  const FilmClock::Settings clock{30};
  const FilmPlan usual = film_plan(frames, clock, false);
  EXPECT_GT(usual.moments, 0u);
  for (const std::uint64_t moments : {150u, 600u, 3000u}) {
    const FilmPlan plan = film_plan_for(moments, frames, clock, false);
    EXPECT_EQ(plan.moments, moments);
    EXPECT_NEAR(static_cast<double>(film_plan(frames, plan.clock, false).moments),
                static_cast<double>(moments), 6.0);
    EXPECT_EQ(plan.clock.slower > 1, moments > usual.moments);
  }
  try {
    film_plan_for(10, frames, clock, false);
    FAIL() << "what moves takes longer";
  } catch (const UsageError& e) {
    const std::string told = e.what();
    const double least = std::stod(told.substr(told.find("takes ") + 6));
    EXPECT_NO_THROW(film_plan_for(std::llround(30 * least), frames, clock, false)) << told;
  }
}

}  // namespace
}  // namespace lantern::app
