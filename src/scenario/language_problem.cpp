// The table of a problem: a scenario whose answer is known.
#include "scenario/language_key.hpp"
#include "scenario/language_parts.hpp"

namespace lantern {

using enum KeyType;

TableDoc problem_table() {
  return {
      "problem",
      "[problem]",
      "A question whose answer is known, so that `lantern measure` can tell each method's error. "
      "All bodies of the file are there from the start. Without this table a scenario is measured "
      "against its own run at a much finer step.",
      {
          Key(choice, "solution",
              "What the answer is computed by. It takes masses, places, speeds and springs from "
              "the "
              "scenario.")
              .must()
              .one_of({"projectile", "oscillator", "chain", "kepler", "pendulum", "free_top",
                       "bouncing_ball", "blocks_and_wall", "collisions", "billiards", "slide",
                       "slip_then_roll", "incline", "topple", "stack", "hanging_chain"}),
          Key(choice, "variant", "Which of its family it is.")
              .one_of({"plain", "stiff", "extreme"})
              .by_default("\"plain\""),
          Key(number, "seconds", "How long it is run.").must().above(0, 1e9).in("s"),
          Key(whole, "samples", "Moments at which it is looked at, equally far apart.")
              .range(1, 100'000)
              .by_default("20"),
          Key(number, "step", "The largest time step. It is cut so that each sample is met.")
              .must()
              .above(0, 1e9)
              .in("s"),
          Key(whole, "halvings", "Of the step: one more run each.").range(0, 24).by_default("7"),
          Key(texts, "methods",
              "Ways to move it: an integrator, `splitting_2`, `splitting_4`, "
              "`explicit_gyroscopic`, `soft:16` (sub-steps) or `impulse:100` (sweeps).")
              .or_else("all that make a difference"),
      }};
}

}  // namespace lantern
