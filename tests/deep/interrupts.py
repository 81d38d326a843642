"""Sends signals to the program at seeded moments, and measures how long it takes to end.

Words behind the program choose: only commands whose names hold all of them.
"""
import glob
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

LANTERN = os.path.abspath(sys.argv[1])
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MOMENTS = int(os.environ.get("MOMENTS", "3"))
ALLOWED = 0.2  # seconds
LONGEST = float(os.environ.get("LONGEST", "2"))  # seconds until a signal

chance = random.Random(int(os.environ.get("SEED", "1")))


def commands():
    cases = sorted(glob.glob(os.path.join(ROOT, "tests/cases/*.toml")))
    scenarios = sorted(glob.glob(os.path.join(ROOT, "scenarios/*.toml")))
    for file in cases:
        name = os.path.basename(file)
        yield name + " check", ["check", file]
        yield name + " png", ["render", file, "-o", "OUT"]
        yield name + " svg", ["render", file, "--format", "svg", "-o", "OUT"]
        yield name + " explain", ["explain", file]
        yield name + " measure", ["measure", file, "--no-peers", "-o", "OUT"]
    for file in chance.sample(scenarios, min(8, len(scenarios))):
        name = os.path.basename(file)
        yield name + " check", ["check", file]
        yield name + " png", ["render", file, "-o", "OUT"]
        yield name + " small 4K", ["render", file, "--png", "small", "--size", "3840x2160", "-o", "OUT"]
        yield name + " svg", ["render", file, "--format", "svg", "-o", "OUT"]
    yield "measure", ["measure", "--no-peers", "-o", "OUT"]
    yield "measure with peers", ["measure", "-o", "OUT"]
    yield "measure broad_phase", ["measure", "broad_phase", "-o", "OUT"]
    yield "stress", ["stress", "--full", "-o", "OUT"]
    yield "bench frames", ["bench", "frames", os.path.join(ROOT, "scenarios/ghost_quadtree.toml")]


class Run:
    def __init__(self, words):
        self.folder = tempfile.mkdtemp(prefix="lantern-interrupts-")
        self.said = open(os.path.join(self.folder, "said"), "w+b")
        words = [self.folder if word == "OUT" else word for word in words]
        self.process = subprocess.Popen(
            [LANTERN] + words, stdout=subprocess.DEVNULL, stderr=self.said, stdin=subprocess.DEVNULL
        )
        while self.process.poll() is None and not self.hears():
            pass
        self.began = time.monotonic()

    def hears(self):
        """Whether it has come so far as to handle SIGINT and SIGTERM."""
        wanted = 1 << (signal.SIGINT - 1) | 1 << (signal.SIGTERM - 1)
        with open(f"/proc/{self.process.pid}/status") as status:
            for line in status:
                if line.startswith("SigCgt:"):
                    return int(line.split()[1], 16) & wanted == wanted
        return False

    def resident(self):
        """Megabytes: the system needs its time to take them back."""
        try:
            with open(f"/proc/{self.process.pid}/statm") as sizes:
                return int(sizes.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") >> 20
        except (OSError, IndexError):
            return 0

    def ended_within(self, seconds):
        try:
            self.process.wait(max(0, self.began + seconds - time.monotonic()))
            return True
        except subprocess.TimeoutExpired:
            return False

    def interrupt(self, number):
        then = time.monotonic()
        self.process.send_signal(number)
        # wait() with a timeout would look again and again, after longer and longer pauses.
        self.process.wait()
        return time.monotonic() - then

    def end(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self.said.seek(0)
        words = self.said.read().decode("utf-8", "replace")
        self.said.close()
        shutil.rmtree(self.folder, ignore_errors=True)
        return words


class Figures:
    def __init__(self):
        self.times = []  # seconds, command, megabytes resident
        self.at_once = {}  # ended by the timer, by command
        self.wrong = []
        self.finished = 0

    def add(self, name, words):
        whole = Run(words)
        ends = whole.ended_within(LONGEST)
        length = time.monotonic() - whole.began if ends else LONGEST
        code = whole.process.returncode if ends else None
        whole.end()
        for _ in range(MOMENTS):
            run = Run(words)
            if run.ended_within(chance.uniform(0, length)):
                self.finished += 1
                run.end()
                continue
            resident = run.resident()
            seconds = run.interrupt(chance.choice([signal.SIGINT, signal.SIGTERM]))
            got = run.process.returncode
            said = run.end()
            if got == 130:
                self.times.append((seconds, name, resident))
            elif got == code:
                self.finished += 1  # it was about to end
            else:
                self.wrong.append(f"{name}: exit code {got}: {said.strip()[-200:]}")
            if "interrupted at once" in said:
                self.at_once[name] = self.at_once.get(name, 0) + 1

    def told(self):
        times = sorted(self.times)
        share = lambda part: times[min(len(times) - 1, int(part * len(times)))][0]
        print(f"{sum(self.at_once.values())} ended by the timer, not by hearing the wish:")
        for name, count in sorted(self.at_once.items()):
            print(f"  {count} of {name}")
        print("the slowest:")
        for seconds, name, resident in times[-8:]:
            print(f"  {seconds:.3f} {name}, {resident} MB")
        for line in self.wrong:
            print("wrong:", line)
        print(f"{len(times)} interrupted, {self.finished} had finished before, {len(self.wrong)} ended wrongly; "
              f"seconds from signal to end: median {share(0.5):.3f}, 99th percentile {share(0.99):.3f}, "
              f"largest {times[-1][0]:.3f}")
        return share(0.99) <= ALLOWED and not self.wrong


figures = Figures()
wanted = sys.argv[2:]
for name, words in commands():
    if all(part in name for part in wanted):
        figures.add(name, words)
sys.exit(0 if figures.told() else 1)
