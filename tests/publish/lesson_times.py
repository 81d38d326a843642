"""How large lesson pages are, and how long a browser takes to open and to step them.
Usage: lesson_times.py FOLDER

A step is told twice: as the time of the page's thread, which other work on the machine does not
lengthen and which is bounded here, and as it passed until the browser had painted. A step beyond the
bound is taken again: what a page costs it costs each time, a hitch of the machine comes once."""

import pathlib
import sys

from browser import Browser

MOST_BYTES, MOST_OPEN, MOST_STEP = 5_000_000, 1000, 50  # bytes, ms, ms
MOST_STEPS = 40  # that are measured of a lesson
TRIES = 3  # of a step beyond the bound; the quickest counts

READY = """
const done = arguments[arguments.length - 1];
const painted = () => new Promise((resolve) => requestAnimationFrame(() => {
  const channel = new MessageChannel();
  channel.port1.onmessage = () => resolve();
  channel.port2.postMessage(0);
}));
"""
IDLE = READY + "painted().then(() => requestIdleCallback(() => requestIdleCallback(() => done(0))));"
STEP = READY + """
const from = performance.now();
window.lantern.go(arguments[0]);
painted().then(() => done(performance.now() - from));
"""


def wait(page, script, *arguments):
    return page.ask("POST", "/execute/async", {"script": script, "args": list(arguments)})


def thread_ms(page):
    metrics = page.cdp("Performance.getMetrics")["metrics"]
    return 1000 * next(metric["value"] for metric in metrics if metric["name"] == "TaskDuration")


def step(page, index):
    """Milliseconds of the step to `index`: of the thread, and until it was painted."""
    page.run("window.lantern.go(arguments[0])", index - 1)
    wait(page, IDLE)  # the lecturer speaks
    before = thread_ms(page)
    passed = wait(page, STEP, index)
    return thread_ms(page) - before, passed


def steps(page, last):
    page.run("window.lantern.setPace(true)")
    times = []
    for index in range(1, last + 1, max(1, last // MOST_STEPS)):
        taken = step(page, index)
        for _ in range(1, TRIES):
            if taken[0] > MOST_STEP:
                taken = min(taken, step(page, index))
        times.append(taken)
    return times or [(0, 0)]


def main():
    slow, lessons, slowest = [], 0, 0
    print(f"{'lesson':24} {'kB':>5} {'frames':>6} {'shapes':>6} {'open ms':>8} {'step ms':>8} {'most ms':>8} {'painted':>8}")
    with Browser((1600, 900)) as page:
        page.cdp("Performance.enable", timeDomain="threadTicks")
        for file in sorted(pathlib.Path(sys.argv[1]).glob("*.html")):
            if file.name == "index.html":
                continue
            page.open("about:blank")
            page.open(file.resolve().as_uri())
            page.wait_for("window.lantern && window.lantern.facts")
            opened = int(page.run("return document.documentElement.dataset.ready"))
            last, shapes = page.run("const l = window.lantern.lesson;"
                                    "return [l.last, Math.max(...l.lists.map((list) => list.length))]")
            times = steps(page, last)
            thread = sorted(time for time, _ in times)
            size = file.stat().st_size
            lessons, slowest = lessons + 1, max(slowest, thread[-1])
            print(f"{file.stem:24} {size / 1000:5.0f} {last + 1:6} {shapes:6} {opened:8} {thread[len(thread) // 2]:8.1f}"
                  f" {thread[-1]:8.1f} {max(time for _, time in times):8.1f}", flush=True)
            if size > MOST_BYTES or opened > MOST_OPEN or thread[-1] > MOST_STEP:
                slow.append(file.stem)
        errors = page.errors()
    print(f"{lessons} lessons, the slowest step {slowest:.0f} ms; too large or too slow:",
          f"{', '.join(slow) or 'none'}; script errors: {errors or 'none'}")
    return 1 if slow or errors else 0


if __name__ == "__main__":
    sys.exit(main())
