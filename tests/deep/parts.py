"""Runs parts of `./run deep`, the scripts beside this file: those named, or all.

What waits for no clock goes two at a time, what is timed alone and afterwards. What a part prints
goes to BUILD/deep/PART.log; the last line of it, which says what the part has counted, becomes its
row of LAST.md. Rows of parts that were not run stay as they are.
Usage: parts.py BUILD [PART...]; parts.py --check [PART...]
"""

import datetime
import difflib
import os
import pathlib
import platform
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PAGE = HERE / "LAST.md"
# Begun in this order: what takes longest first, so that nothing else waits for it.
TOGETHER = ["mutants", "stress_mutants", "fuzz", "sanitized", "package", "faults", "kills", "address_space", "memory", "hostile",
            "coverage", "compilers", "wild", "live", "readme", "paper", "users", "rooms", "linear", "slurm", "shards", "threads"]
ALONE = ["pairs", "interrupts", "lessons", "progress", "film"]  # their verdict is of seconds
AT_ONCE = 2
TELL = 60  # seconds
HEAD = """# The last `./run deep`

Each part has a row; `./run deep PART...` renews the rows of its parts alone. Seconds are of the clock and,
in brackets, of the processors. A commit with a + had changes that were not committed.

| part | verdict | figures | seconds | date | commit | machine |
|---|---|---|---|---|---|---|
"""


def chosen(names):
    """The parts of these names in the order in which they are run; without names all."""
    parts = TOGETHER + ALONE
    scripts = {path.stem for path in HERE.glob("*.sh")}
    if scripts != set(parts):
        sys.exit(f"deep: parts.py and the scripts beside it differ: {scripts ^ set(parts)}")
    for name in names:
        if name not in parts:
            near = difflib.get_close_matches(name, parts, 1)
            hint = f"; did you mean '{near[0]}'?" if near else ""
            print(f"deep: there is no part '{name}'{hint}\nThe parts are: {' '.join(sorted(parts))}",
                  file=sys.stderr)
            sys.exit(2)
    return [part for part in parts if not names or part in names]


def git(*words):
    done = subprocess.run(["git", "-c", "safe.directory=*", *words], cwd=ROOT, text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    return done.stdout.strip() if done.returncode == 0 else ""


def commit():
    name = git("rev-parse", "--short", "HEAD") or "none"
    return name + ("+" if git("status", "--porcelain", "--", ".", f":!{PAGE.relative_to(ROOT)}") else "")


def machine():
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return f"{len(os.sched_getaffinity(0))} × {names[0] if names else platform.machine()}"


class Part:
    """A script on its way; its processes end with it."""

    def __init__(self, name, build):
        self.name, self.log = name, build / "deep" / f"{name}.log"
        self.began = time.monotonic()
        environment = dict(os.environ, BUILD=str(build), LANTERN=str(build / "lantern"))
        with open(self.log, "wb") as log:
            self.process = subprocess.Popen(["sh", str(HERE / f"{name}.sh")], stdin=subprocess.DEVNULL,
                                            stdout=log, stderr=subprocess.STDOUT, cwd=ROOT, env=environment)
        self.good = None

    def last_line(self):
        lines = self.log.read_text(errors="replace").replace("\r", "\n").split("\n")
        return next((line.strip() for line in reversed(lines) if line.strip()), "it said nothing")

    def has_ended(self):
        pid, status, usage = os.wait4(self.process.pid, os.WNOHANG)
        if pid == 0:
            return False
        self.process.returncode = os.waitstatus_to_exitcode(status)
        self.seconds = time.monotonic() - self.began
        self.busy = usage.ru_utime + usage.ru_stime
        self.good = self.process.returncode == 0
        return True

    def row(self):
        figures = self.last_line().replace("|", "\\|")
        return (f"| {self.name} | {'good' if self.good else 'FAILED'} | {figures} | {self.seconds:.0f} "
                f"({self.busy:.0f}) | {datetime.date.today()} | {commit()} | {machine()} |")


def write(part):
    """Puts the row of a part into the page, whose rows are in alphabetical order."""
    rows = {}
    for line in PAGE.read_text().splitlines() if PAGE.exists() else []:
        if line.startswith("| ") and not line.startswith("| part "):
            rows[line.split("|")[1].strip()] = line
    rows[part.name] = part.row()
    text = HEAD + "".join(rows[name] + "\n" for name in sorted(rows) if (HERE / f"{name}.sh").exists())
    PAGE.with_suffix(".new").write_text(text)
    PAGE.with_suffix(".new").replace(PAGE)


def main():
    if sys.argv[1] == "--check":
        chosen(sys.argv[2:])
        return 0
    build, parts = pathlib.Path(sys.argv[1]).resolve(), chosen(sys.argv[2:])
    (build / "deep").mkdir(parents=True, exist_ok=True)
    waiting, running, failed, told = list(parts), [], [], time.monotonic()
    while waiting or running:
        while waiting and len(running) < AT_ONCE and not any(part.name in ALONE for part in running) and (
                waiting[0] in TOGETHER or not running):
            running.append(Part(waiting.pop(0), build))
            print(f"== {running[-1].name}: begun; its words go to {running[-1].log}", flush=True)
        time.sleep(0.2)
        for part in [part for part in running if part.has_ended()]:
            running.remove(part)
            write(part)
            print(f"== {part.name}: {'good' if part.good else 'FAILED'} after {part.seconds:.0f} s: "
                  f"{part.last_line()}", flush=True)
            if not part.good:
                failed.append(part.name)
        if time.monotonic() - told > TELL:
            told = time.monotonic()
            for part in running:
                print(f"   {part.name}, {told - part.began:.0f} s: {part.last_line()[:120]}", flush=True)
    print(f"{len(parts)} parts, {len(failed)} failed" + "".join(f" {name}" for name in failed) +
          f"; see {PAGE.relative_to(ROOT)}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
