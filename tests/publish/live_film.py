"""The README's film of a hand on a live page. Usage: live_film.py LANTERN ROOT GIF"""

import base64
import pathlib
import subprocess
import sys
import tempfile
import time

from browser import Browser

SIZE = (960, 540)
FRAME = 8  # of ghost_quadtree: pink lies across two cells, and is stored twice
RATE = 10  # pictures a second
# Where the hand takes pink, page pixels from where it is, and how many pictures it takes and waits.
WAYS = [((-32, 0), 10, 10), ((30, 0), 12, 10), ((0, 0), 8, 10), ((0, 95), 14, 10), ((90, 60), 14, 12)]

# A pointer is no part of a picture that a browser takes of its page.
HAND = """const hand = document.createElement('div'); hand.id = 'hand'; hand.innerHTML =
'<svg width=26 height=34 viewBox="0 0 13 17"><path d="M1 1v12l3-3 2 5 2-1-2-5h4z" fill="#000" stroke="#fff"/></svg>';
hand.style.cssText = 'position:fixed;pointer-events:none;z-index:9'; document.body.append(hand);"""


def main():
    lantern, root, gif = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
    with tempfile.TemporaryDirectory() as name, Browser(SIZE) as page:
        folder = pathlib.Path(name)
        subprocess.run([lantern, "render", root / "scenarios/ghost_quadtree.toml", "--live", "-o", folder / "a.html"],
                       check=True, capture_output=True)
        page.open((folder / "a.html").as_uri())
        page.wait_for("document.documentElement.dataset.live === 'ready'")
        page.run("window.lantern.go(arguments[0])", FRAME)
        page.run(HAND)
        x, y = page.run(
            "const p = window.lantern.picture; for (const e of p.layer.children)"
            " if (p.lesson.keys[e.thing][0] === 'world/body/pink') { const r = e.getBoundingClientRect();"
            " return [r.x + r.width / 2, r.y + r.height / 2] }")
        taken = 0

        def take(dx, dy, kind="mouseMoved", buttons=1):
            nonlocal taken
            page.cdp("Input.dispatchMouseEvent", type=kind, x=x + dx, y=y + dy, buttons=buttons, button="left",
                     clickCount=1)
            page.run("const h = document.getElementById('hand').style; h.left = arguments[0] + 'px';"
                     " h.top = arguments[1] + 'px'", x + dx - 2, y + dy - 2)
            time.sleep(0.25)
            shot = page.cdp("Page.captureScreenshot", format="png")["data"]
            (folder / f"{taken:04}.png").write_bytes(base64.b64decode(shot))
            taken += 1

        for i in range(8):
            take(60 - 60 * i / 7, 60 - 60 * i / 7, buttons=0)
        take(0, 0, "mousePressed")
        at = (0, 0)
        for to, moves, waits in WAYS:
            for i in range(1, moves + 1):
                take(*(a + (b - a) * i / moves for a, b in zip(at, to)))
            for _ in range(waits):
                take(*to)
            at = to
        take(*at, "mouseReleased", 0)
        for _ in range(10):
            take(*at, buttons=0)
        subprocess.run(["ffmpeg", "-y", "-loglevel", "error", "-framerate", str(RATE), "-i", folder / "%04d.png", "-vf",
                        "split[a][b];[a]palettegen=max_colors=64:stats_mode=diff[p];[b][p]paletteuse=dither=none",
                        gif], check=True)


if __name__ == "__main__":
    main()
