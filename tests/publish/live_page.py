"""A live lesson page in a real browser. Usage: live_page.py LANTERN ROOT FOLDER [ENGINE] [--firefox]"""

import json
import pathlib
import statistics
import subprocess
import sys
import time

import firefox
from browser import Browser

SIZE = (1280, 720)
STEP = 3  # the frame at which ghost_quadtree has red, pink and blue in one leaf

failures = []


def expect(what, found, expected=True):
    if found != expected:
        failures.append(f"{what}: {found!r}, expected {expected!r}")


def at_rest(page):
    page.wait_for("!window.lantern.live.working && !window.lantern.picture.easing")


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


def drag(page, name, dx, dy, moves=10, hand="grab"):
    x, y = middle_of(page, name)
    page.move_to(x, y + 1)
    page.move_to(x, y)
    expect(f"{name} can be held", page.run("return document.getElementById('stage').dataset.hand"), hand)
    page.mouse("pointerDown", x, y)
    for i in range(1, moves + 1):
        page.mouse("pointerMove", x + dx * i / moves, y + dy * i / moves)
    time.sleep(0.15)  # who rests does not throw
    page.mouse("pointerUp", x + dx, y + dy)
    at_rest(page)


def text_of(page, name):
    return page.run("return document.getElementById(arguments[0]).textContent", name)


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
    expect("what was done is said", text_of(page, "said").startswith("red at "))
    expect("what its facts are", text_of(page, "caption"),
           "Red lies across leaves 1 and 2 and is stored in both. It is in 2 of 3 candidate pairs, with pink and blue.")
    expect("and where it is stored is lit", page.run(
        "return [...new Set([...document.querySelectorAll('#picture .lit')].map((e) => window.lantern.lesson.keys[e.thing][0]))]"
        ".filter((key) => key.startsWith('tree/node/'))"), ["tree/node/root.0", "tree/node/root.1"])
    expect("a leaf is named where its name is drawn", page.run(
        "const leaf = { label: '1.2', outline: [0, 0, 9, 0, 9, 9, 0, 9] };"
        " return [['1.2'], ['1']].map((written) => window.lantern.live.hand.words.stored([leaf], [1, 1, 2, 2], new Set(written), ['leaf', 'leaves']))"),
        ["is stored in leaf 1.2", "is stored in one leaf"])
    page.promise("return (async () => { const p = window.lantern;"
                 " const drawn = await p.live.engine.ask({ do: 'frame', index: 0 });"
                 " p.show(p.index); p.live.hand.look(drawn); await new Promise((then) => setTimeout(then, 500)); p.show(p.index) })()")
    expect("what comes next is not made of a frame that is looked at", page.errors(), [])
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


BODIES = "return window.lantern.facts[window.lantern.index][0].bodies.map(([, name]) => name)"
WORDS = """const { caption, undo } = Object.fromEntries(['caption', 'undo'].map((id) => [id, document.getElementById(id)]));
return [caption.textContent, caption.dataset.beside, undo.getBoundingClientRect().x]"""
KEYS = "return [...window.lantern.picture.layer.children].map((e) => window.lantern.lesson.keys[e.thing][0])"


# What the lesson says word for word steps back in another world; what somebody else has written stays.
def check_words(page):
    change = "return window.lantern.live.change(window.lantern.live.text.replace(arguments[0], arguments[1]), 'text')"
    page.run("window.lantern.go(0)")
    caption, _, place = page.run(WORDS)
    page.promise(change, "A leaf holds", "Now a leaf holds")
    at_rest(page)
    expect("an author's own caption is shown, and undo where it always is", page.run(WORDS),
           [f"Now a{caption[1:]}", "", place])
    page.run("window.lantern.go(6)")
    expect("in the same world the other captions stay", page.run(WORDS)[:2],
           ["The tree is rebuilt, and node 1 no longer needs to split. Red is now in node 4 with the player: they are a candidate pair.", ""])
    page.run("window.lantern.go(5)")
    expect("so do the notes", any(key.startswith("note/") for key in page.run(KEYS)))
    page.run("window.lantern.go(0)")
    drag(page, "red", 20, 20)
    expect("in another world it stays, with what is said of a body", page.run(WORDS)[:2],
           [f"Now a{caption[1:]}", "Red is stored in the root. It is in the only candidate pair, with pink."])
    page.run("window.lantern.go(5)")
    expect("and what is the lesson's is told as such", page.run(WORDS)[1],
           "in the lesson: Red catches the player in cell 4. The tree still has red in 1.2, so it misses their collision.")
    expect("but for its notes", any(key.startswith("note/") for key in page.run(KEYS)), False)
    expect("each frame is left to be read", page.run(
        "const { lesson } = window.lantern; return lesson.frames.every((_, i) => i === lesson.last || lesson.secondsToRead(i) > 1)"))
    page.run("window.lantern.live.again()")
    at_rest(page)
    expect("undo stays where it is", page.run(WORDS)[2], place)
    page.run("window.lantern.go(0); document.getElementById('add').click()")
    at_rest(page)
    page.run("window.lantern.go(window.lantern.lesson.last)")
    expect("behind a step that was added the lesson's words are there", page.run(WORDS)[1],
           "in the lesson: Rebuilt every step, the tree misses no collision, and names only pairs that share a leaf: 2 of 6.")
    page.run("document.getElementById('again').click()")
    at_rest(page)
    page.run("window.lantern.setPace(true); window.lantern.go(arguments[0])", STEP)
    expect("frames are counted as such", text_of(page, "number"), "frame 4 / 9")
    page.run("window.lantern.setPace(false)")


def check_controls(page):
    page.press("c")
    page.wait_for("document.querySelector('[data-path=\"structure.capacity\"] input') !== null")
    expect("a choice has its own words", page.run("return document.querySelector('[data-path=\"structure.kind\"] small').textContent"),
           "A quadtree cuts a 3D world along x and z, an octree along all three.")
    expect("nothing was moved", page.run("return document.getElementById('remove').disabled"))
    page.run("const i = document.querySelector('[data-path=\"structure.capacity\"] input'); i.focus(); i.value = 4;"
             " i.dispatchEvent(new Event('input', {bubbles: true}))")
    at_rest(page)
    expect("a slider changes the text", page.run("return /capacity = 4/.test(window.lantern.live.text)"))
    expect("and the words", text_of(page, "caption"), "1 leaf (7 in the lesson), 4 entries (5 in the lesson), 6 candidate pairs (0 in the lesson).")
    page.run("document.activeElement.dispatchEvent(new KeyboardEvent('keydown', {key: 'z', ctrlKey: true, bubbles: true}))")
    at_rest(page)
    expect("Ctrl+Z undoes it", page.run("return [window.lantern.live.text === window.lantern.live.own.text, document.activeElement.value]"), [True, "2"])
    for button, names in (("add", ["blue", "new1"]), ("remove", ["blue"])):
        page.run("document.getElementById(arguments[0]).click()", button)
        at_rest(page)
        expect(f"{button} a body", page.run(BODIES)[3:], names)
    page.press("c")
    page.run("document.getElementById('again').click()")
    at_rest(page)


def check_prediction(page):
    page.press("q")
    for number, said in (("", "Say a number first."), (5, "Wrong: you said 5; it is 0.")):
        page.run("const form = document.querySelector('#question-dialog details form');"
                 " form.querySelector('input').value = arguments[0]; form.requestSubmit()", number)
        expect("an answer is judged", page.run("return document.querySelector('#question-dialog [role=status]').textContent"), said)
    answers = "const [one] = document.querySelectorAll('#question-dialog details'); return [one.open, one.lastElementChild.hidden]"
    expect("an answer that was asked for is there", page.run(answers), [True, False])
    page.run("[...document.querySelectorAll('#question-dialog button')].find((one) => one.textContent === 'more').click()")
    drag(page, "red", -60, 60)
    expect("a prediction is judged by the engine's count", text_of(page, "hint"),
           "Yes, more: 0 candidate pairs before, 2 now.")
    expect("it stays there", page.run(answers), [True, False])
    page.run("document.getElementById('again').click(); window.lantern.go(arguments[0])", STEP)
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


PLACE = """const of = (id) => document.getElementById(id);
return [of('place').textContent, of('number').textContent, of('play').getAttribute('aria-pressed')]"""


def throw(page, name, dx, dy, past=3):
    x, y = middle_of(page, name)
    page.move_to(x, y)
    page.mouse("pointerDown", x, y)
    for i in range(1, 7):
        page.mouse("pointerMove", x + dx * i / 6, y + dy * i / 6)
    page.mouse("pointerUp", x + dx, y + dy)
    page.wait_for(f"window.lantern.playing && window.lantern.index > {past}")


# Slider and number follow a flight, which can be paused; back to the lesson is where it began.
def check_throw(page):
    page.run("window.lantern.go(1)")
    expect("that one can throw is said", text_of(page, "invitation"), "Drag a body, or throw it: the engine answers.")
    x, y = middle_of(page, "b5")
    page.mouse("pointerDown", x, y)
    page.mouse("pointerMove", x + 20, y - 20)
    page.mouse("pointerMove", x + 90, y - 40)
    page.wait_for("window.lantern.live.hand.held?.last && !window.lantern.live.working")
    expect("a step that the hand adds is counted", page.run(PLACE)[:2], ["step 3 of 11", "3 / 11"])
    expect("what has no name has a colour", text_of(page, "caption"), "The green box is in none of the 4 candidate pairs.")
    page.press("escape")
    page.mouse("pointerUp", x, y)
    at_rest(page)
    for end in ("play", "next"):
        throw(page, "b5", 240, -120)
        place, number, plays = page.run(PLACE)
        expect("the number follows", [f"step {number.replace(' / ', ' of ')}", plays], [place, "true"])
        page.run("document.getElementById(arguments[0]).click()", end)
        at_rest(page)
        place, number, plays = page.run(PLACE)
        expect("and stays where it ends", [f"step {number.replace(' / ', ' of ')}", plays], [place, "false"])
        words = text_of(page, "caption")
        expect("what is gone is said, and what is there counted", (words[:39], " awake" in words), ("The body you threw has left the world. ", True))
        page.run("document.getElementById('again').click()")
        at_rest(page)
        expect("back to where it was thrown", page.run("return window.lantern.index"), 1)
    throw(page, "b5", 240, -120)
    page.press("right")
    at_rest(page)
    expect("no script fails in a flight", page.errors(), [])


# A phone that is held upright has a picture of its own: all of it is seen.
def check_finger(address):
    with Browser((390, 844), device={"width": 390, "height": 844, "pixelRatio": 2, "touch": True}) as page:
        open_live(page, address)
        expect("nothing is off the screen", page.run(
            "const [stage, bar] = ['stage', 'theme'].map((id) => document.getElementById(id));"
            " return [stage.scrollWidth > stage.clientWidth, bar.getBoundingClientRect().bottom > innerHeight,"
            " [...window.lantern.picture.layer.children].some((e) => { const r = e.getBoundingClientRect();"
            " return r.left < 0 || r.right > innerWidth || r.bottom > innerHeight }), window.lantern.lesson.ratio < 1]"),
            [False, False, False, True])
        x, y = middle_of(page, "b5")
        for i, kind in enumerate(["touchStart"] + 13 * ["touchMove"]):
            page.cdp("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x + 8 * i, "y": y - i}])
        at_rest(page)
        expect("a body follows a finger sideways", middle_of(page, "b5")[0] > x + 60)
        page.cdp("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        at_rest(page)
        expect("nor is it in a world of one's own", page.run("return document.getElementById('theme').getBoundingClientRect().bottom > innerHeight"), False)
        expect("a finger has no error", page.errors(), [])


# As no scenario of ours is written: what the page does with it, it asks the engine.
UNUSUAL = """# [[step]] is none here
"title" = 'Otherwise "written" \\ [world]'
world.size = [ 64, 32 ]
world.'time_step' = 0.05
structure = { kind = 'grid', cell = 8 }
body = [ { name = 'red', radius = 3, position = [30, 12], velocity = [1, 0] } ]
[[ step ]]
'do' = 'insert'
bodies = [ 'red' ]
caption = \"\"\"\\
[[step]] \\
do = 'run' \\
\"\"\"
[[step]]  # [[step]]
do = "r\\u0075n"
seconds = 2
every = 20"""


def check_unusual(page):
    for ends in ("\n", "\r\n"):
        text = UNUSUAL.replace("\n", ends)
        page.promise("return window.lantern.run(arguments[0])", text)
        page.run("window.lantern.go(0)")
        at_rest(page)
        expect("it is there", page.run("return [window.lantern.live.good === arguments[0], window.lantern.lesson.frames.length]", text), [True, 3])
        drag(page, "red", 30, 10, hand="throw")
        beside = page.run(WORDS)[1]
        expect("a grid's leaves are cells", " cell" in beside and "lea" not in beside)
        expect("one line has changed", page.run("return window.lantern.live.text.split('\\n').length"), text.count("\n") + 1)
        page.press("c")
        for button, names in (("add", ["red", "new1"]), ("add", ["red", "new1", "new2"]), ("remove", ["red", "new1"])):
            page.run("document.getElementById(arguments[0]).click()", button)
            at_rest(page)
            expect(f"{button} a body, otherwise written", page.run(BODIES), names)
        page.press("c")
        throw(page, "red", 200, -20, past=0)
        page.wait_for("!window.lantern.playing")
        at_rest(page)
        expect("it has flown", page.run("return window.lantern.lesson.frames[window.lantern.index].time > 0"))
        expect("no script fails", page.errors(), [])
    page.run("document.getElementById('again').click()")
    at_rest(page)


# The corner of a texture can be caught from outside, too, and its size is told while it is dragged.
def check_corner(page):
    page.run("window.lantern.go(4)")
    x, y = page.run("const p = window.lantern.picture; for (const e of p.layer.children) if (p.lesson.keys[e.thing][1] === 'body/A')"
                    " { const r = e.getBoundingClientRect(); return [r.right, r.bottom] }")
    page.move_to(x + 20, y + 20)
    page.move_to(x + 9, y + 9)
    expect("a corner has room around it", page.run("return document.getElementById('stage').dataset.hand"), "size")
    page.mouse("pointerDown", x + 9, y + 9)
    for i in range(1, 7):
        page.mouse("pointerMove", x + 9 - 5 * i, y + 9 - 5 * i)
    at_rest(page)
    size = page.run("return document.getElementById('source').value.match(/name = \"A\"\\nsize = \\[(\\d+), (\\d+)\\]/).slice(1)")
    expect("its size is told", text_of(page, "caption"), f"A is {size[0]} × {size[1]}.")
    expect("and is another one", size != ["200", "300"])
    page.mouse("pointerUp", x - 21, y - 21)
    at_rest(page)


# A body that is drawn as an outline is held anywhere within it; what the narrow phase measures is told.
def check_outline(page):
    page.run("window.lantern.go(5)")
    drag(page, "plank", 60, -25)
    expect("a gap is told", text_of(page, "caption"), "Gap 2.94 (1.2 in the lesson).")
    page.run("document.getElementById('again').click()")
    at_rest(page)
    page.run("window.lantern.go(0)")
    drag(page, "ball", 20, -20)


# What the program says of the file that the page saves.
def check_download(page, lantern, folder):
    page.run("window.lantern.go(arguments[0])", STEP)
    drag(page, "blue", -60, 30)
    file = folder / "ghost_quadtree.toml"
    file.unlink(missing_ok=True)
    page.save_to(folder)
    page.press("t")
    page.run("document.getElementById('download').click()")
    for _ in range(6000):
        if file.exists() and not list(folder.glob("*.part")) and not list(folder.glob("*.crdownload")):
            break
        time.sleep(0.01)
    page.press("escape")
    expect("the file is the text", file.read_bytes().decode(), page.run("return window.lantern.live.text"))
    said = subprocess.run([lantern, "check", "--json", "--hashes", file], capture_output=True, text=True)
    told = json.loads(said.stdout)["scenarios"][0]["hashes"]
    mine = page.promise("return window.lantern.run(window.lantern.live.text).then((all) => all.map(({ hash }) => hash))")
    expect("the program has the same hashes of what was dragged", mine, told)


def check(browser, address, lantern, folder):
    with browser(SIZE) as page:
        open_live(page, address)
        started = page.run("return performance.now()")
        check_hand(page)
        check_keys(page)
        check_words(page)
        check_controls(page)
        check_prediction(page)
        check_text(page)
        check_link(page)
        check_unusual(page)
        check_download(page, lantern, folder)
        frames = page.promise("return window.lantern.run(window.lantern.live.own.text).then((all) => all.length)")
        expect("run() gives the facts of all frames", frames, page.run("return window.lantern.lesson.frames.length"))
        times = page.run("return window.lantern.live.hand.times")
        expect("no script fails", page.errors(), [])
        open_live(page, address.replace("live.html", "throw.html"))
        check_throw(page)
        open_live(page, address.replace("live.html", "atlas.html"))
        check_corner(page)
        open_live(page, address.replace("live.html", "axes.html"))
        check_outline(page)
        page.before_load("delete window.Worker")
        page.open("about:blank")
        page.open(address)
        page.wait_for("document.documentElement.dataset.live === 'off'")
        page.press("right")
        expect("without a Worker the recorded lesson is there", page.run("return window.lantern.index > 0"))
    return f"{browser.__name__}: ready after {started:.0f} ms, a drag is drawn after {statistics.median(times):.0f} ms"


def main():
    words = [word for word in sys.argv[1:] if word != "--firefox"]
    lantern, root, folder = (pathlib.Path(word).resolve() for word in words[:3])
    if len(words) < 4 and not (lantern.parent / "lantern.wasm").exists():
        return 77  # ./run web has not been
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / "live.html"
    engine = ["--engine", words[3]] if len(words) > 3 else []
    for name, page in (("ghost_quadtree", file), ("falling_boxes", folder / "throw.html"), ("kdtree_atlas", folder / "atlas.html"), ("separating_axes", folder / "axes.html")):
        subprocess.run([lantern, "render", root / f"scenarios/{name}.toml", "-o", page, "--live", *engine], check=True, capture_output=True)
    if len(words) == len(sys.argv) - 1:
        check(Browser, file.as_uri(), lantern, folder)
        check_finger((folder / "throw.html").as_uri())
    elif not firefox.BINARY:
        return 77
    else:
        print(check(firefox.Firefox, file.as_uri(), lantern, folder))
    for failure in failures:
        print(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
