#!/usr/bin/python3
"""Whether `lantern stress` notices a broken engine.

Small faults are drawn from all of src/physics: every operator of mutate.py, and those of physics
beside: a term, factor or step left out or halved, another constant, one of a pair for the other, a
choice always or never taken. Each fault that changes the motion of any body in random worlds should
fail a case. What is printed: for each fault the cases that fail, how many of those that matter are
caught, and which case catches which; the page of that is tests/mutate/CAUGHT.md.
"""

import argparse
import collections
import concurrent.futures
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import mutate

PROGRAM = "mutated_stress"


class Run:
    """A program's lines, and whether it came to its end."""

    def __init__(self, program, words, number, seconds):
        environment = dict(os.environ, LANTERN_MUTANT=str(number))
        self.lines, self.ended = [], False
        with subprocess.Popen([program, *words], env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                              preexec_fn=lambda: mutate.limits(int(seconds) + 1)) as process:
            for line in process.stdout:
                self.lines.append(line.split())
            self.ended = process.wait() == 0

    def reached(self):
        return {int(n) for line in self.lines if line[0] == "reached" for n in line[1:]}

    def worlds(self):
        return [line for line in self.lines if line[0] != "reached"]


def failed_cases(program, number, usual, first):
    """Names of the cases that fail, or of the `first` that was found; one that crashes or does not
    end fails, too."""
    failed, left = [], sorted(usual, key=usual.get)
    while left and not (first and failed):
        run = Run(program, ["until_one_fails" if first else "stress", *left], number, 20 + 3 * sum(usual[name] for name in left))
        begun = None
        for line in run.lines:
            if line[0] == "begins":
                begun = line[1]
            elif line[0] != "reached":
                left.remove(line[0])
                begun = None
                if line[1] == "0":
                    failed.append(line[0])
        if run.ended:
            break
        if begun is None:
            mutate.stop(f"{program} broke off between its cases, as mutant {number}")
        failed.append(begun)
        left.remove(begun)
    return failed


def percent(some, of):
    return f"{len(some)} of {len(of)} ({100 * len(some) / max(1, len(of)):.0f} %)"


def page(options, fates, mutants, different, caught):
    by_physics = [n for n in caught if set(fates[n][1]) != {"same_bits"}]
    lines = [
        "# What `lantern stress` catches", "",
        f"{len(mutants)} small faults in `src/physics`, drawn from all places by seed "
        f"{options.seed}, one at a time. {len(different)} change the motion of a body in "
        f"{options.worlds} random worlds (2D and 3D, every contact method and integrator); "
        f"of these `stress` catches {percent(caught, different)}, and "
        f"{percent(by_physics, different)} without `same_bits`, which knows no physics: its hashes of "
        f"all scenes' states are recorded. "
        f"Made by `tests/mutate/stress.py --seed {options.seed}`.", "",
        "| case | faults that it catches |", "|---|---|"]
    by_case = collections.Counter(name for _, failed in fates.values() for name in failed)
    lines += [f"| `{name}` | {count} |" for name, count in by_case.most_common()]
    for title, numbers in (
            ("Caught", caught), ("Missed", [n for n in different if n not in caught]),
            ("Change the motion of none", [n for n in fates if n not in different])):
        lines += ["", f"## {title}: {len(numbers)}", ""]
        for n in numbers:
            worlds, failed = fates[n]
            first = ", ".join(f"`{name}`" for name in failed[:6])
            more = f" and {len(failed) - 6} more" if len(failed) > 6 else ""
            lines.append(f"- `{mutate.key_of(mutants[n])}` ({worlds} worlds)"
                         f"{': ' if first else ''}{first}{more}")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    mutate.add_options(parser, "mutants_of_stress")
    parser.add_argument("--worlds", type=int, default=200)
    parser.add_argument("--first", action="store_true",
                        help="no more cases of a fault that is caught: quicker, and no page of it")
    parser.add_argument("--page", type=Path, help="write the page of it there")
    options = parser.parse_args()
    began = time.monotonic()
    everything = mutate.Finder(mutate.load_clang(), "physics", wide=True).run()
    wanted = [m for m in everything if options.only in mutate.told(m)]
    picked, rest = mutate.chosen(wanted, options.size, options.seed)
    print(f"{len(everything)} possible faults, {len(picked)} taken", flush=True)
    if options.list:
        print("\n".join(mutate.told(m) for m in picked))
        return 0
    mutants = dict(enumerate(picked))
    tree = mutate.Tree(options.folder)
    dropped = mutate.built(tree, mutants, {"physics": rest}, [PROGRAM], options.jobs)
    program = options.folder / PROGRAM
    shutil.copy(tree.build / "tests" / PROGRAM, program)
    print(f"compiled in {time.monotonic() - began:.0f} s; {dropped} were not valid, and others "
          "taken in their place", flush=True)

    worlds = Run(program, ["worlds", "0", str(options.worlds)], -1, 3600)
    stress = Run(program, ["stress"], -1, 3600)
    if not worlds.ended or not stress.ended:
        mutate.stop("it fails without any fault")
    usual = {line[0]: float(line[2]) for line in stress.lines if line[0] not in ("begins", "reached")}
    for line in stress.lines:
        if line[0] in usual and line[1] == "0":
            mutate.stop(f"{line[0]} fails without any fault")
    print(f"stress: {len(usual)} cases, {sum(usual.values()):.0f} s", flush=True)
    in_worlds, in_cases = worlds.reached(), stress.reached()

    def fate(number):
        changed = 0
        if number in in_worlds:
            run = Run(program, ["worlds", "0", str(options.worlds)], number, 120)
            same = sum(a == b for a, b in zip(run.worlds(), worlds.worlds()))
            changed = options.worlds - same
        failed = failed_cases(
            program, number, usual, options.first) if changed and number in in_cases else []
        return number, changed, failed

    fates = {}
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for number, changed, failed in pool.map(fate, sorted(mutants)):
            fates[number] = changed, failed
            verdict = "same  " if not changed else "caught" if failed else "MISSED"
            print(f"{verdict} {mutate.told(mutants[number])}\n    {changed} worlds; {len(failed)} "
                  f"cases: {' '.join(failed[:8])}", flush=True)
    different = [n for n, (changed, _) in fates.items() if changed]
    caught = [n for n in different if fates[n][1]]
    if options.page:
        options.page.write_text(page(options, fates, mutants, different, caught))
    share = 100 * len(caught) / max(1, len(different))
    print(f"{len(mutants)} faults; {len(different)} change motions, of which {len(caught)} are "
          f"caught: {share:.1f} %; seed {options.seed}, {time.monotonic() - began:.0f} s")
    return 0 if share >= options.least else 1


if __name__ == "__main__":
    sys.exit(main())
