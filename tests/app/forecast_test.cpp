// The words in which a long run is told of.
#include <gtest/gtest.h>

#include "app/progress.hpp"

namespace lantern::app {
namespace {

constexpr RunExtent kBomb{1001, 600'000};

RunState after(double seconds, std::uint64_t frames, std::uint64_t steps, double step_seconds) {
  RunState state;
  state.seconds = seconds;
  state.frames = frames;
  state.world_steps = steps;
  state.step_seconds = step_seconds;
  return state;
}

TEST(Forecast, SaysAllThatIsKnown) {
  RunState state = after(2, 3, 100, 1.8);
  state.files = 2;
  state.bytes = 2'400'000;
  state.memory = 400'000'000;
  state.budget = 12'000'000'000;
  EXPECT_EQ(forecast_text(kBomb, state),
            "up to 1001 frames of 600 000 world steps, about 3 h left; about 1.1 GB on the disk; "
            "381 MB of memory (budget 11 GB)");
}

TEST(Forecast, OfTheDiskIsForTheFramesThatAreWritten) {
  RunState state = after(2, 3, 0, 2);
  state.files = 2;
  state.bytes = 2'000'000;
  EXPECT_EQ(forecast_text({100, 0, 7}, state),
            "up to 100 frames, about 65 s left; about 6.7 MB on the disk");
}

TEST(Forecast, LeavesOutWhatIsNot) {
  EXPECT_EQ(forecast_text(kBomb, after(0.5, 0, 0, 0.5)),
            "up to 1001 frames of 600 000 world steps, how long cannot be told yet");
  EXPECT_EQ(
      forecast_text({std::nullopt, 0}, after(1, 7, 0, 1)),
      "as many frames as there are events, not known beforehand, how long cannot be told yet");
  RunExtent film{std::nullopt, 0};
  film.pictures = 121;
  EXPECT_EQ(forecast_text(film, after(1, 7, 0, 1)), "121 pictures, how long cannot be told yet");
  EXPECT_EQ(forecast_text({std::nullopt, 60}, after(1, 7, 0, 0.001)),
            "as many frames as there are events, not known beforehand; up to 60 world steps, "
            "how long cannot be told yet");
}

TEST(Forecast, OfAStepThatIsNotDoneIsALeast) {
  // Frames have been given, so a step is under way: it takes 0.4 s at least.
  const auto left = time_left(kBomb, after(0.5, 1, 0, 0.4));
  ASSERT_TRUE(left);
  EXPECT_TRUE(left->at_least);
  EXPECT_DOUBLE_EQ(left->seconds, 240'000);
  EXPECT_EQ(forecast_text(kBomb, after(0.5, 1, 0, 0.4)),
            "up to 1001 frames of 600 000 world steps, more than 67 h left");
  EXPECT_FALSE(time_left(kBomb, after(0.5, 0, 0, 0.5))) << "it may still be inserting";
}

// The run is fast and its frames wait: only a frame that is drawn shows how long drawing takes.
TEST(Forecast, OfFramesThatWaitIsALeastUntilOneIsDrawn) {
  constexpr RunExtent kLesson{5001, 5000};
  RunState state = after(0.5, 1001, 1000, 0.5);
  state.waiting = 1001;
  EXPECT_EQ(forecast_text(kLesson, state),
            "up to 5001 frames of 5000 world steps, more than 2 s left");
  EXPECT_EQ(progress_text(kLesson, state),
            "0 of 5001 frames, 1000 of 5000 world steps, more than 2 s left");
  state.waiting = 901;
  state.seconds = 1;
  state.step_seconds = 1;
  state.draw_seconds = 0.5;
  EXPECT_EQ(progress_text(kLesson, state),
            "100 of 5001 frames, 1000 of 5000 world steps, about 25 s left");
  RunState done = after(5, 70, 2120, 4);
  done.waiting = 70;
  EXPECT_FALSE(time_left({70, 2120}, done)) << "nothing is left but to draw";
  done.waiting = 35;
  done.draw_seconds = 3;
  EXPECT_DOUBLE_EQ(time_left({70, 2120}, done)->seconds, 3);
  RunState events = after(5, 70, 0, 0);
  events.waiting = 35;
  EXPECT_FALSE(time_left({std::nullopt, 0}, events));
}

TEST(Forecast, IsMeasuredFromWhatIsDone) {
  EXPECT_DOUBLE_EQ(time_left({100, 0}, after(2, 25, 0, 2))->seconds, 6);
  EXPECT_DOUBLE_EQ(time_left({10, 400}, after(50, 3, 100, 10))->seconds, 30)
      << "what came before the first step does not come again";
  EXPECT_DOUBLE_EQ(time_left({100, 0}, after(2, 100, 0, 2))->seconds, 0);
  EXPECT_FALSE(time_left({100, 0}, after(2, 0, 0, 2)));
  EXPECT_FALSE(time_left({std::nullopt, 0}, after(2, 50, 0, 2)));
}

TEST(Forecast, ProgressCounts) {
  RunState state = after(10, 7, 212, 10);
  EXPECT_EQ(progress_text({70, 2120}, state),
            "7 of 70 frames, 212 of 2120 world steps, about 90 s left");
  state.files = 7;
  state.bytes = 70'000;
  EXPECT_EQ(progress_text({70, 0}, state), "7 of 70 frames, 68 KB on the disk, about 90 s left");
  EXPECT_EQ(progress_text({std::nullopt, 0}, after(10, 7, 0, 10)), "7 frames");
  RunState drawing = after(10, 70, 0, 10);
  drawing.drawn = 212;
  EXPECT_EQ(progress_text({70, 0}, drawing), "70 of 70 frames, 212 pictures drawn");
}

TEST(Forecast, UnitsFitTheSize) {
  EXPECT_EQ(duration_text(0.2), "1 s");
  EXPECT_EQ(duration_text(99), "99 s");
  EXPECT_EQ(duration_text(120), "2 min");
  EXPECT_EQ(duration_text(3 * 3600), "3 h");
  EXPECT_EQ(duration_text(200 * 3600), "8 days");
}

// A film's frames are few and its pictures many.
TEST(Forecast, OfAFilmIsByItsPictures) {
  RunExtent film{9, 0};
  film.pictures = 600;
  RunState state = after(10, 9, 0, 10);
  state.waiting = 3;
  state.drawn = 200;
  state.draw_seconds = 10;
  EXPECT_EQ(progress_text(film, state), "200 of 600 pictures, about 20 s left");
  state.waiting = 0;
  state.drawn = 590;
  state.draw_seconds = 29.5;
  EXPECT_EQ(progress_text(film, state), "590 of 600 pictures, about 1 s left");
  state.drawn = 600;
  EXPECT_EQ(progress_text(film, state), "600 pictures drawn, the file is being finished");
}

}  // namespace
}  // namespace lantern::app
