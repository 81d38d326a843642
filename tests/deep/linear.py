"""Counts the instructions of `check` for n, 2n and 4n bodies at the same density, under valgrind:
what comes with the second doubling may cost no more than 2.3 times what came with the first. Start-up
falls out of the differences.
All verbs that act on many bodies, in every kind of structure but brute force."""

import math
import os
import re
import subprocess
import sys
import tempfile

MOST = 2.3
FEWEST = 500
KINDS = "quadtree octree lecture_quadtree kd_tree grid auto aabb_tree sort_and_sweep".split()
TREES = ("quadtree", "lecture_quadtree")
ONCE = ("aabb_tree",)  # each body is in one leaf
VARIANTS = {
    "free": ("", ""),
    "contacts": ('contacts = "soft"\nsub_steps = 2', ""),
    "springs": ('contacts = "soft"\nsub_steps = 2', '[[spring]]\nalong = "b"\nstiffness = 5\n'),
    "joints": ("", '[[joint]]\nkind = "distance"\nalong = "b"\n'),
}
SCRIPT = """
[[step]]
do = "insert"
bodies = ["b"]
{events}
[[step]]
do = "run"
seconds = 0.02
[[step]]
do = "sleep"
bodies = ["b"]
expect = {{ asleep = ["b1..b{n}"] }}
[[step]]
do = "wake"
bodies = ["b"]
{leaves}
[[step]]
do = "query"
min = {low}
max = {high}
pace = "event"
events = ["skip"]
[[step]]
do = "ray"
hits = "all"
from = {low}
to = {near}
[[step]]
do = "test_shapes"
[[step]]
do = "remove"
bodies = ["b"]
"""


def point(*numbers):
    return "[" + ", ".join(f"{x:.6f}" for x in numbers) + "]"


def text(kind, n, variant, events):
    """A scenario of n balls, each with as many neighbours however many there are."""
    solid = kind == "octree"
    if solid:
        size = (1.5 * n ** (1 / 3),) * 3
    elif kind in TREES:
        size = (1.5 * math.sqrt(n),) * 2
    else:
        size = (1.5**2 * n / 6, 6)
    world, links = VARIANTS[variant]
    near = [4.0] * len(size)
    return (
        f'title = "Linear"\n[world]\nsize = {point(*size)}\ntime_step = 0.01\nmay_sleep = true\n'
        f'quiet = ["contacts", "energy", "outside", "joints", "crush"]\n{world}\n'
        f'[structure]\nkind = "{kind}"\n{"max_depth = 12" if kind == "kd_tree" else ""}\n'
        f'{"capacity = 8" if kind in TREES or solid else ""}\n'
        f'[[pattern]]\nname = "b"\ncount = {n}\nradius = 0.4\nspeed = 1\nspin = 1\n{links}'
        + SCRIPT.format(
            n=n,
            low=point(*[0.0] * len(size)),
            high=point(*size),
            near=point(*near),
            leaves=f"expect = {{ in_leaves = {{ {', '.join(f'b{i + 1} = 1' for i in range(n))} }} }}"
            if kind in ONCE else "",
            events='pace = "event"\nevents = ["rotate"]' if events and kind != "aabb_tree" else "",
        )
    )


def instructions(lantern, scenario):
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(scenario)
        file.flush()
        run = subprocess.run(
            ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", lantern, "check",
             file.name],
            capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"})
    found = re.search(r"Collected : (\d+)", run.stderr)
    if run.returncode != 0 or not found:
        sys.exit(f"{scenario}\n{run.stdout}{run.stderr}")
    return int(found[1])


def main():
    lantern, failed, found = sys.argv[1], False, []
    for kind in KINDS:
        for variant in VARIANTS if kind == "grid" else ("free", "contacts"):
            for events in (False, True) if variant == "free" else (False,):
                # A tree of space is a level deeper at eight times as many balls, all leaves at
                # once; it is looked at over a level, and told by doubling.
                doublings = 3 if kind == "octree" else 1
                fewest = FEWEST // 2 if kind == "octree" else FEWEST
                one, two, four = (
                    instructions(lantern, text(kind, fewest * 2 ** (doublings * k), variant, events))
                    for k in (0, 1, 2))
                growth = ((four - two) / (two - one)) ** (1 / doublings)
                bad = growth > MOST
                failed = failed or bad
                setting = f"{kind} {variant}{' watched' if events else ''}"
                found.append((growth, setting))
                print(f"{setting}: {growth:.2f} times"
                      f" ({(two - one) / (fewest * (2 ** doublings - 1)):,.0f} instructions a body)"
                      f"{', the bound is ' + str(MOST) if bad else ''}", flush=True)
    growth, setting = max(found)
    print(f"{len(found)} settings, twice as many bodies are at most {growth:.2f} times the"
          f" instructions ({setting}); the bound is {MOST}")
    sys.exit(1 if failed else 0)


main()
