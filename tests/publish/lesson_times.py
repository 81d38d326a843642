"""How large lesson pages are, and how long a browser takes to open and to step them.
Usage: lesson_times.py FOLDER"""

import pathlib
import sys

from browser import Browser

MOST_BYTES, MOST_OPEN, MOST_STEP = 5_000_000, 1000, 50  # bytes, ms, ms

# Every step of the lesson, each until the browser has painted it; the times in ms.
STEPS = """
const done = arguments[0];
const page = window.lantern;
const times = [];
const painted = () => new Promise((resolve) => requestAnimationFrame(() => {
  const channel = new MessageChannel();
  channel.port1.onmessage = () => resolve();
  channel.port2.postMessage(0);
}));
(async () => {
  page.setPace(true);
  await painted();
  const every = Math.max(1, Math.floor(page.lesson.last / 60));
  for (let i = 0; i <= page.lesson.last; i += every) {
    await painted();
    await new Promise((resolve) => requestIdleCallback(resolve)); // while the lecturer speaks
    const from = performance.now();
    page.go(i);
    document.body.getBoundingClientRect();
    const made = performance.now();
    await painted();
    times.push([made - from, performance.now() - from]);
  }
  done(times);
})();
"""


def main():
    slow = []
    print(f"{'lesson':28} {'kB':>6} {'frames':>6} {'open ms':>8} {'step ms':>8} {'most ms':>8} {'painted':>8}")
    with Browser((1600, 900)) as page:
        for file in sorted(pathlib.Path(sys.argv[1]).glob("*.html")):
            if file.name == "index.html":
                continue
            page.open("about:blank")
            page.open(file.resolve().as_uri())
            page.wait_for("window.lantern && window.lantern.facts")
            opened = int(page.run("return document.documentElement.dataset.ready"))
            times = page.ask("POST", "/execute/async", {"script": STEPS, "args": []})
            made = sorted(time for time, _ in times)
            painted = sorted(time for _, time in times)
            size = file.stat().st_size
            frames = page.run("return window.lantern.lesson.frames.length")
            print(f"{file.stem:28} {size / 1000:6.0f} {frames:6} {opened:8} {made[len(made) // 2]:8.1f}"
                  f" {made[-1]:8.1f} {painted[-1]:8.1f}")
            if size > MOST_BYTES or opened > MOST_OPEN or made[-1] > MOST_STEP:
                slow.append(file.stem)
        errors = page.errors()
    print("too large or too slow:", ", ".join(slow) or "none", "; script errors:", errors or "none")
    return 1 if slow or errors else 0


if __name__ == "__main__":
    sys.exit(main())
