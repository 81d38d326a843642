"""A live lesson page in a real browser. Usage: live_page.py LANTERN ROOT FOLDER [ENGINE]"""

import json
import pathlib
import subprocess
import sys
import time

from browser import Browser

SIZE = (1280, 720)
STEP = 3  # the frame at which ghost_quadtree has red, pink and blue in one leaf

failures = []


def expect(what, found, expected=True):
    if found != expected:
        failures.append(f"{what}: {found!r}, expected {expected!r}")


def at_rest(page):
    page.wait_for("window.lantern.live.working === null || window.lantern.live.working === undefined")


def open_live(page, address):
    page.open("about:blank")
    page.open(address)
    page.wait_for("['ready', 'off'].includes(document.documentElement.dataset.live)")
    expect("the engine answers", page.run("return document.documentElement.dataset.live"), "ready")
    at_rest(page)


def middle_of(page, name):
    return page.run(
        "const p = window.lantern.picture; for (const e of p.layer.children)"
        " if (p.lesson.keys[e.thing][0] === `world/body/${arguments[0]}`) { const r = e.getBoundingClientRect();"
        " return [r.x + r.width / 2, r.y + r.height / 2] }", name)


def drag(page, name, dx, dy, moves=10):
    x, y = middle_of(page, name)
    page.move_to(x, y)
    expect(f"{name} can be held", page.run("return document.getElementById('stage').dataset.hand"), "grab")
    mouse = lambda kind, x, y, buttons: page.cdp("Input.dispatchMouseEvent", type=kind, x=x, y=y, buttons=buttons,
                                                 button="left", clickCount=1)
    mouse("mousePressed", x, y, 1)
    for i in range(1, moves + 1):
        mouse("mouseMoved", x + dx * i / moves, y + dy * i / moves, 1)
    time.sleep(0.15)  # who rests does not throw
    mouse("mouseReleased", x + dx, y + dy, 0)
    at_rest(page)


STATE = """const { live } = window.lantern;
return { index: window.lantern.index, own: live.text === live.own.text, past: live.past.length, shown: live.text ===
document.getElementById('source').value, marked: !document.getElementById('own').firstElementChild.hidden }"""


SHAPES = "return [...window.lantern.picture.layer.children].map((e) => e.outerHTML.replace(/ thing| link/g, '')).join('')"


def check_hand(page):
    page.run("window.lantern.go(arguments[0])", STEP)
    lesson = page.run(SHAPES)
    x, y = middle_of(page, "red")
    drag(page, "red", 90, 20)
    moved = middle_of(page, "red")
    expect("the body is where the hand has put it", abs(moved[0] - x - 90) < 3 and abs(moved[1] - y - 20) < 3)
    expect("so is the text", page.run(STATE), {"index": STEP, "own": False, "past": 1, "shown": True, "marked": True})
    expect("what was done is said", page.run("return document.getElementById('said').textContent").startswith("red at "))
    expect("what its facts are", page.run("return document.getElementById('caption').textContent"),
           "Red lies across leaves 1 and 2 and is stored in both. It is in 2 of 3 candidate pairs, with pink and blue.")
    expect("and where it is stored is lit", page.run(
        "return [...new Set([...document.querySelectorAll('#picture .lit')].map((e) => window.lantern.lesson.keys[e.thing][0]))]"
        ".filter((key) => key.startsWith('tree/node/'))"), ["tree/node/root.0", "tree/node/root.1"])
    page.run("window.lantern.live.undo()")
    at_rest(page)
    expect("undone", page.run(STATE), {"index": STEP, "own": True, "past": 0, "shown": True, "marked": False})
    expect("to the last shape", page.run(SHAPES) == lesson)
    page.run("window.lantern.live.redo()")
    at_rest(page)
    page.run("document.getElementById('again').click()")
    at_rest(page)
    expect("back to the lesson", page.run(STATE)["own"])
    x, y = middle_of(page, "red")
    page.move_to(x, y, click=True)
    expect("a click is next", page.run("return window.lantern.index > arguments[0]", STEP))
    page.run("window.lantern.go(arguments[0])", STEP)


def check_keys(page):
    page.run("document.querySelector('#things button').focus()")
    for _ in range(40):
        page.press("tab")
        if page.run("return document.activeElement.dataset.entity") == "body/red":
            break
    past = page.run(STATE)["past"]
    page.press("right", "right")
    page.wait_for(f"window.lantern.live.past.length > {past}")
    at_rest(page)
    expect("arrow keys move a body, not the lesson", page.run(STATE)["index"], STEP)
    page.run("document.activeElement.blur(); document.getElementById('again').click()")
    at_rest(page)


def check_controls(page):
    page.press("c")
    page.wait_for("document.querySelector('[data-path=\"structure.capacity\"] input')")
    page.run("const i = document.querySelector('[data-path=\"structure.capacity\"] input'); i.value = 4;"
             " i.dispatchEvent(new Event('input', {bubbles: true}))")
    at_rest(page)
    expect("a slider changes the text", page.run("return /capacity = 4/.test(window.lantern.live.text)"))
    page.press("c")
    page.run("document.getElementById('again').click()")
    at_rest(page)


def check_text(page):
    page.press("t")
    place = "const s = document.getElementById('source'); s.focus(); const i = s.value.indexOf(arguments[0]) + arguments[1]; s.setSelectionRange(i, i)"
    shown = page.run(SHAPES)
    page.run(place, 'do = "insert"', 10)
    page.press("\ue003")
    page.wait_for("document.getElementById('source').getAttribute('aria-invalid') === 'true'")
    expect("what is wrong stands under its line", page.run("return document.querySelectorAll('#lines .diagnostic').length > 0"))
    expect("the last good picture stays", page.run(SHAPES) == shown)
    page.press("e")
    page.wait_for("document.getElementById('source').getAttribute('aria-invalid') === 'false'")
    at_rest(page)
    page.run(place, "[[body]]", -1)
    page.press("[")
    page.wait_for("!document.getElementById('completions').hidden")
    page.press("escape")
    page.press("\ue003")
    page.wait_for("window.lantern.live.editor.timer === 0")
    at_rest(page)
    page.press("escape")


def check_link(page):
    drag(page, "red", -30, 40)
    text, index = page.run("return [window.lantern.live.text, window.lantern.index]")
    page.run("document.getElementById('link').click()")
    page.wait_for("location.hash.includes('&t=')")
    open_live(page, page.run("return location.href"))
    page.wait_for("window.lantern.live.past.length === 1")
    at_rest(page)
    expect("a link holds the whole change", page.run("return window.lantern.live.text") == text)
    expect("and the frame", page.run("return window.lantern.index"), index)


# What the program says of the text as the page would save it.
def check_hashes(page, lantern, folder):
    page.run("window.lantern.go(arguments[0])", STEP)
    drag(page, "blue", -60, 30)
    file = folder / "ghost_quadtree.toml"
    file.write_text(page.run("return window.lantern.live.text"))
    said = subprocess.run([lantern, "check", "--json", "--hashes", file], capture_output=True, text=True)
    told = json.loads(said.stdout)["scenarios"][0]["hashes"]
    mine = page.ask("POST", "/execute/async", {"script": "window.lantern.run(window.lantern.live.text)"
                    ".then((all) => arguments[0](all.map(({ hash }) => hash)))", "args": []})
    expect("the program has the same hashes of what was dragged", mine, told)


def check(address, lantern, folder):
    with Browser(SIZE) as page:
        open_live(page, address)
        check_hand(page)
        check_keys(page)
        check_controls(page)
        check_text(page)
        check_link(page)
        check_hashes(page, lantern, folder)
        frames = page.ask("POST", "/execute/async", {"script": "window.lantern.run(window.lantern.live.own.text)"
                          ".then((all) => arguments[0](all.length), (error) => arguments[0](String(error)))", "args": []})
        expect("run() gives the facts of all frames", frames, page.run("return window.lantern.lesson.frames.length"))
        expect("no script fails", page.errors(), [])
        page.cdp("Page.addScriptToEvaluateOnNewDocument", source="delete window.Worker")
        page.open("about:blank")
        page.open(address)
        page.wait_for("document.documentElement.dataset.live === 'off'")
        page.press("right")
        expect("without a Worker the recorded lesson is there", page.run("return window.lantern.index > 0"))


def main():
    lantern, root, folder = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
    if len(sys.argv) < 5 and not (lantern.parent / "lantern.wasm").exists():
        return 77  # ./run web has not been
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / "live.html"
    engine = ["--engine", sys.argv[4]] if len(sys.argv) > 4 else []
    subprocess.run([lantern, "render", root / "scenarios/ghost_quadtree.toml", "-o", file, "--live", *engine],
                   check=True, capture_output=True)
    check(file.as_uri(), lantern, folder)
    for failure in failures:
        print(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
