"""The lesson page in a real browser. Usage: lesson_page.py LANTERN ROOT FOLDER"""

import base64
import pathlib
import subprocess
import sys

from browser import ELEMENT, Browser

LANTERN, ROOT, FOLDER = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
SCENARIO = ROOT / "tests/publish/lesson.toml"
SIZE = (960, 540)
PICTURE_HEIGHT = 427  # between the words
PHONE = (390, 844)

# The mean difference of two pictures' channels, 0 ... 255, asked of the browser.
DIFFERENCE = """
const [height, done] = [arguments[2], arguments[3]];
const pixels = async (base64) => {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const image = await createImageBitmap(new Blob([bytes], {type: 'image/png'}));
  const canvas = new OffscreenCanvas(image.width, image.height);
  const context = canvas.getContext('2d');
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, image.width, height).data;
};
Promise.all([pixels(arguments[0]), pixels(arguments[1])]).then(([a, b]) => {
  let sum = 0;
  for (let i = 0; i < a.length; i++) sum += Math.abs(a[i] - b[i]);
  done(a.length === b.length ? sum / (a.length * 3 / 4) : 255);
}, (error) => done(String(error)));
"""

failures = []

# Of 255, over a picture: hatches are nearly all edges, which each renderer smooths its own way.
MOST_DIFFERENCE = 1.6


def expect(what, found, expected=True):
    if found != expected:
        failures.append(f"{what}: {found!r}, expected {expected!r}")


def lantern(*words):
    subprocess.run([LANTERN, *map(str, words)], check=True, capture_output=True)


def state(page):
    return page.run("const p = window.lantern; return [p.index, document.getElementById('caption').textContent,"
                    " location.hash, document.getElementById('place').textContent]")


def difference(page, expected):
    """Of the picture alone, as large as the window."""
    shot = base64.b64encode(page.screenshot()).decode()
    return page.ask("POST", "/execute/async", {"script": DIFFERENCE, "args": [
        shot, base64.b64encode(expected.read_bytes()).decode(), PICTURE_HEIGHT]})


def check_pictures(page, last, theme):
    page.run("const s = document.createElement('style'); s.id = 'alone'; document.head.append(s);"
             f"s.textContent = '#stage {{ position: fixed !important; inset: 0 0 auto; height: {PICTURE_HEIGHT}px; z-index: 9 }}"
             "body > * > :not(#stage) { visibility: hidden }'")
    for index in range(last + 1):
        page.run("window.lantern.go(arguments[0])", index)
        mean = difference(page, FOLDER / f"{theme}/lesson/lesson_{index:04}.png")
        expect(f"frame {index}, {theme}: mean difference {mean} is small", isinstance(mean, float) and mean < MOST_DIFFERENCE)
        if index == 0 or theme == "dark":
            continue
        page.run("const p = window.lantern.picture; p.show(arguments[0] - 1); p.showBetween(arguments[0], 0.5)", index)
        mean = difference(page, FOLDER / f"{theme}/lesson/lesson_{index - 1:04}_01.png")
        expect(f"half way to frame {index}: mean difference {mean} is small", isinstance(mean, float) and mean < MOST_DIFFERENCE)
    page.run("document.getElementById('alone').remove(); window.lantern.go(0)")


def check_keys(page, last):
    expect("opens at the first step's end", state(page)[0], 0)
    page.press("right")
    expect("right is next", state(page), [1, "The third overflows it.", "#1", "step 2 of 3"])
    page.press("page down")
    expect("a presenter's remote is next", state(page)[0], last)
    page.press("left")
    expect("left is back", state(page)[0], 1)
    page.press("e", "space")
    expect("by event each frame is one", state(page)[0], 2)
    page.press("end")
    expect("the end", state(page)[0], last)
    expect("no next there", page.run("return document.getElementById('next').disabled"))
    page.press("home", "e")
    expect("the caption is text", state(page)[1], "Two bodies fit into the root: <b>1 pair</b> to test.")
    page.move_to(SIZE[0] / 2, SIZE[1] / 2, click=True)
    expect("a click is next", state(page)[0], 1)
    page.run("location.hash = '#3'")
    page.wait_for("window.lantern.index === 3")
    page.run("const s = document.getElementById('slider'); s.value = 0; s.dispatchEvent(new Event('input'))")
    expect("the slider goes there", state(page)[0], 0)
    # What it says may be read for as long as it takes to be told to stop.
    page.run("window.lantern.lesson.secondsToRead = () => 1e6")
    page.press("p")
    page.wait_for("window.lantern.index > 0")
    page.press("p")
    expect("it plays until it is told to stop", page.run("return [window.lantern.playing, window.lantern.index]"), [0, 1])
    page.run("delete window.lantern.lesson.secondsToRead")
    page.run("window.postMessage({lantern: 'go', frame: 1}, '*')")
    page.wait_for("window.lantern.index === 1")


LIT = """
const lit = new Set();
for (const e of document.querySelectorAll('#picture .lit')) lit.add(window.lantern.lesson.keys[e.thing][0]);
return [...lit].filter((key) => /world.(body|pair)|tree.(body|node)/.test(key)).sort();
"""


def check_pointing(page):
    page.run("window.lantern.go(1)")
    box = page.run("const l = window.lantern.lesson; for (const e of document.querySelectorAll('#picture g *'))"
                   " if (l.keys[e.thing]?.[0] === 'world/body/cyd') { const r = e.getBoundingClientRect();"
                   " return [r.x + r.width / 2, r.y + r.height / 2] }")
    page.move_to(*box)
    told = "return document.getElementById('told').textContent"
    expect("a body is told with its leaf", page.run(told), "cyd, in 4")
    keys = page.run(LIT)
    expect("it lights up in world and tree", [key for key in keys if "cyd" in key],
           ["tree/body/cyd/root.3", "world/body/cyd"])
    expect("so does its leaf", "tree/node/root.3" in keys and "tree/node/root.2" not in keys)
    expect("its cell has an outline", page.run("return document.querySelectorAll('#picture .over > *').length") >= 2)
    page.run("window.lantern.pointing.light('node/root.0')")
    expect("a node lights up what it holds", [key for key in page.run(LIT) if "world/body" in key],
           ["world/body/ann", "world/body/bob"])
    page.move_to(2, SIZE[1] - 2)
    expect("and goes dark again", page.run(LIT), [])
    page.run("document.querySelector('#things button').focus()")
    page.press("tab")
    expect("Tab goes through the nodes", page.run("return document.getElementById('said').textContent"),
           "node root holds ann, bob, cyd")
    page.press("escape")
    page.run("document.activeElement.blur()")
    page.press("i")
    rows = "return [...document.querySelectorAll('#facts-panel tr')].map((r) => r.innerText.split('\\t').join('|'))"
    expect("facts on demand", any(row.startswith("pairs|") for row in page.run(rows)))
    page.press("i")


def check_beside(page):
    page.press("o")
    page.wait_for("document.querySelectorAll('#overview-dialog svg').length === 3")
    page.run("document.querySelectorAll('#overview-dialog button')[2].click()")
    expect("the overview goes to a step", page.run("return window.lantern.index === window.lantern.lesson.last"))
    page.run("window.lantern.go(0)")
    page.press("q")
    page.run("const q = document.querySelector('#question-dialog details'); q.open = true; q.querySelector('a').click()")
    page.wait_for("window.lantern.index === 1")
    expect("an answer's link goes to its frame", page.run("return document.querySelector('dialog[open]') === null"))
    page.run("window.lantern.go(0); window.lantern.openSpeaker()")
    expect("notes stand in the speaker's view",
           page.run("return window.lantern.speaker.parts.notes.textContent"), "Ask first: how many pairs?")
    expect("with the next step", page.run("return window.lantern.speaker.next.index"), 1)
    page.run("window.lantern.speaker.window.close()")
    pdf = page.pdf()
    (FOLDER / "handout.pdf").write_bytes(pdf)
    pages = pdf.count(b"/Type /Page\n") + pdf.count(b"/Type /Page/") + pdf.count(b"/Type /Page ")
    expect(f"the handout has pages: {pages}", 1 <= pages <= 4)


def check_in_a_deck(page):
    """A page that takes the lesson in steps it by messages, and is told where it is."""
    (FOLDER / "deck.html").write_text("""<!doctype html><title>deck</title>
<iframe src="lesson.html?embed" width="800" height="450"></iframe>
<script>const told = []; addEventListener('message', (e) => told.push(e.data));</script>""")
    page.open((FOLDER / "deck.html").as_uri())
    page.wait_for("told.length >= 1")
    page.run("document.querySelector('iframe').contentWindow.postMessage({lantern: 'next'}, '*')")
    page.wait_for("told.some((m) => m.lantern === 'frame' && m.frame === 1 && m.step === 1)")
    for _ in range(3):
        page.run("document.querySelector('iframe').contentWindow.postMessage({lantern: 'next'}, '*')")
    page.wait_for("told.includes('{\"method\":\"next\"}')")


def check_next_and_slides():
    """Lessons of a folder lead on; a page takes its colours from its address, and waits with printing."""
    lantern("render", SCENARIO, ROOT / "scenarios/pong_bsp.toml", "-o", FOLDER / "course/{scenario}.html", "--size", "960x540")
    with Browser(SIZE) as page:
        page.open((FOLDER / "course/pong_bsp.html").as_uri() + "?theme=dark&ground=none")
        page.wait_for("window.lantern && window.lantern.facts")
        expect("it opens dark", page.run("return document.documentElement.dataset.theme"), "dark")
        expect("and without a ground", page.run("return getComputedStyle(document.documentElement).backgroundColor"), "rgba(0, 0, 0, 0)")
        page.press("end")
        expect("next leads on", page.run("const n = document.getElementById('next'); return [n.disabled, n.title.slice(0, 18)]"),
               [False, "Next lesson: Tiles"])
        page.press("right")
        page.wait_for("window.lantern && window.lantern.facts && location.pathname.endsWith('lesson.html')")
        expect("in the same colours", page.run("return document.documentElement.dataset.theme"), "dark")
        page.press("end")
        expect("the last one ends", page.run("return document.getElementById('next').disabled"))
        page.open((FOLDER / "lesson.html").as_uri() + "?theme=grey")
        page.wait_for("window.lantern && window.lantern.facts")
        expect("it opens grey", page.run("return document.documentElement.dataset.theme"), "print")
        page.run("delete document.documentElement.dataset.ready")
        page.cdp("Emulation.setEmulatedMedia", media="print")
        expect("on paper before it is ready the plain page", page.run("return getComputedStyle(document.getElementById('plain')).display"), "block")
        page.run("document.documentElement.dataset.ready = 1")
        expect("and no more when it is", page.run("return getComputedStyle(document.getElementById('plain')).display"), "none")


def check_phone(address):
    middle = "const r = document.querySelector(arguments[0]).getBoundingClientRect(); const at = [r.x + r.width / 2, r.y + r.height / 2];"

    def touch(kind, *points):
        page.cdp("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x, "y": y} for x, y in points])

    def is_free(one):
        return page.run(f"{middle} return document.elementFromPoint(...at).closest(arguments[0]) !== null", one)

    for width, height in (PHONE, PHONE[::-1]):
        with Browser((width, height), device={"width": width, "height": height, "pixelRatio": 2, "touch": True}) as page:
            page.open(address)
            page.wait_for("window.lantern && window.lantern.facts")
            for way, index in ((-1, 1), (1, 0)):
                x, y = page.run(f"{middle} return at", "#words")
                touch("touchStart", (x, y))
                for i in range(1, 9):
                    touch("touchMove", (x + 10 * i * way, y))
                touch("touchEnd")
                expect("a swipe over the words steps", page.run("return window.lantern.index"), index)
            for button in ("#facts", "#facts-panel .close"):
                page.run("document.querySelector(arguments[0]).click()", button)
                expect("the bar stays free", [one for one in ("#back", "#facts", "#help") if not is_free(one)], [])
            expect("facts can be closed", page.run("return document.getElementById('facts-panel').hidden"))
            page.run("document.getElementById('overview').click()")
            page.wait_for("document.querySelectorAll('#overview-dialog svg').length > 1")
            expect("no step's words are covered", page.run(
                "return [...document.querySelectorAll('#overview-dialog [data-index]')].every((one) => {"
                " one.scrollIntoView({ block: 'center' }); const r = one.lastElementChild.getBoundingClientRect();"
                " return one.contains(document.elementFromPoint(r.x + r.width / 2, r.y + r.height / 2)) })"))
            expect("the steps can be closed", is_free("#overview-dialog form button"))
            if height > width:
                expect("upright the picture is wider than the phone", page.run("return document.getElementById('stage').scrollWidth > innerWidth"))


def check_plain(address):
    with Browser(SIZE, scripts=False) as page:
        page.open(address)
        image = page.ask("POST", "/element", {"using": "css selector", "value": "#still"})[ELEMENT]
        expect("the first frame without scripts",
               page.ask("GET", f"/element/{image}/displayed"))
        text = page.ask("POST", "/element", {"using": "css selector", "value": "body"})[ELEMENT]
        words = page.ask("GET", f"/element/{text}/text")
        expect("captions without scripts", "They move; the tree is made anew" in words and "1 pair" in words)
        expect("no controls that do nothing", "all steps" not in words)


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    address = (FOLDER / "lesson.html").as_uri()
    size = f"{SIZE[0]}x{PICTURE_HEIGHT}"
    lantern("render", SCENARIO, "-o", FOLDER / "lesson.html", "--size", "x".join(map(str, SIZE)))
    for theme, tween in (("light", 1), ("dark", 0)):
        lantern("render", SCENARIO, "-o", FOLDER / theme, "--size", size, "--theme", theme, "--no-title",
                "--no-caption", "--no-counters", "--tween", tween)
    with Browser(SIZE) as page:
        page.open(address)
        page.wait_for("window.lantern && window.lantern.facts")
        last = page.run("return window.lantern.lesson.last")
        check_keys(page, last)
        check_pointing(page)
        check_beside(page)
        check_pictures(page, last, "light")
        page.cdp("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        check_pictures(page, 1, "dark")
        check_in_a_deck(page)
        expect("no script fails", page.errors(), [])
    check_next_and_slides()
    check_phone(address)
    check_plain(address)
    for failure in failures:
        print(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
