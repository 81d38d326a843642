"""Runs each case for some seconds under a budget of memory, and looks at the peak it came to."""
import glob
import os
import shutil
import signal
import subprocess
import sys
import tempfile

LANTERN = os.path.abspath(sys.argv[1])
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SECONDS = float(os.environ.get("SECONDS_EACH", "6"))
GIGA = 1 << 30


def peak_of(words):
    """Exit code, peak resident bytes, and what it said."""
    folder = tempfile.mkdtemp(prefix="lantern-memory-")
    words = [folder if word == "OUT" else word for word in words]
    with open(os.path.join(folder, "said"), "w+b") as said:
        process = subprocess.Popen([LANTERN] + words, stdout=subprocess.DEVNULL, stderr=said)
        timer = subprocess.Popen(["sleep", str(SECONDS)])
        # Whichever ends first; the other is told to.
        pid, status, usage = os.wait4(-1, 0)
        if pid == timer.pid:
            timer.returncode = 0
            process.send_signal(signal.SIGINT)
            _, status, usage = os.wait4(process.pid, 0)
        else:
            timer.kill()
            timer.wait()
        process.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        text = said.read().decode("utf-8", "replace")
    shutil.rmtree(folder, ignore_errors=True)
    return process.returncode, usage.ru_maxrss * 1024, text


half = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2
failures, runs, fullest = 0, 0, 0
for file in sorted(glob.glob(os.path.join(ROOT, "tests/cases/*.toml"))):
    for command in (["check", file], ["render", file, "-o", "OUT"]):
        for budget, options in ((GIGA, ["--memory", "1G"]), (half, [])):
            code, peak, said = peak_of(command + options)
            # Too much for the budget, or a tree with more entries than one may have: what to change.
            refused = [line for line in said.splitlines()
                       if "--memory" in line or "entries); lower max_depth" in line]
            good = peak <= budget and code in (0, 1, 3, 130) and (code in (0, 130) or refused)
            failures += not good
            runs, fullest = runs + 1, max(fullest, peak / budget)
            print(f"{'good' if good else 'BAD '} {os.path.basename(file):34} {command[0]:7}"
                  f"budget {budget / GIGA:6.2f} GB, peak {peak / GIGA:6.2f} GB, exit {code}"
                  + (f"; {refused[0]}" if refused else ""))
            if not good:
                print(said[-500:])
print(f"{runs} runs of {SECONDS:g} s at most, {failures} failures; the fullest took {fullest:.0%} of its budget")
sys.exit(1 if failures else 0)
