"""A browser driven by WebDriver (https://www.w3.org/TR/webdriver2/), with nothing but Python's own."""

import base64
import json
import shutil
import subprocess
import time
import urllib.request

PATIENCE = 3600  # seconds: only what never comes takes as long, however busy the machine
ELEMENT = "element-6066-11e4-a52e-4f735466cecf"
KEYS = {"right": "\ue014", "left": "\ue012", "home": "\ue011", "end": "\ue010", "tab": "\ue004",
        "escape": "\ue00c", "page down": "\ue00f", "page up": "\ue00e", "space": " "}


class Browser:
    """Chromium without a window; `with` ends it in any case."""

    def __init__(self, size=(1600, 900), scripts=True, dark=False, device=None):
        self.driver = subprocess.Popen([shutil.which("chromedriver"), "--port=0"],
                                       stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.port = None
        while self.port is None:
            line = self.driver.stdout.readline()
            if not line:
                raise RuntimeError("chromedriver ended")
            if "successfully on port" in line:
                self.port = int(line.rsplit("on port", 1)[1].strip(" .\n"))
        arguments = ["--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                     "--force-device-scale-factor=1", f"--window-size={size[0]},{size[1]}"]
        if dark:
            arguments.append("--force-dark-mode")
        options = {"args": arguments, "binary": shutil.which("chromium")}
        if not scripts:
            options["prefs"] = {"profile.managed_default_content_settings.javascript": 2}
        if device:
            options["mobileEmulation"] = {"deviceMetrics": device}
        answer = self.ask("POST", "/session", {"capabilities": {"alwaysMatch": {
            "browserName": "chrome", "timeouts": {"script": 1000 * PATIENCE, "pageLoad": 1000 * PATIENCE},
            "goog:chromeOptions": options,
            "goog:loggingPrefs": {"browser": "ALL"}}}}, session=False)
        self.session = answer["sessionId"]
        if not device:
            self.cdp("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1],
                     deviceScaleFactor=1, mobile=False)
        if dark:
            self.cdp("Emulation.setEmulatedMedia",
                     features=[{"name": "prefers-color-scheme", "value": "dark"}])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self.ask("DELETE", "", {})
        finally:
            self.driver.terminate()
            self.driver.wait(PATIENCE)

    def ask(self, method, path, body=None, session=True):
        place = f"/session/{self.session}" if session else ""
        data = None if method in ("GET", "DELETE") else json.dumps(body or {}).encode()
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}{place}{path}", data, method=method,
                                         headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=PATIENCE) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"]) from None

    def cdp(self, command, **parameters):
        return self.ask("POST", "/goog/cdp/execute", {"cmd": command, "params": parameters})

    def open(self, address):
        self.ask("POST", "/url", {"url": address})

    def run(self, script, *arguments):
        return self.ask("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def promise(self, script, *arguments):
        """What a promise that the script returns comes to."""
        code = f"const done = arguments[arguments.length - 1]; (function () {{ {script} }}).apply(null, arguments).then(done, (e) => done(String(e)))"
        return self.ask("POST", "/execute/async", {"script": code, "args": list(arguments)})

    def before_load(self, script):
        self.cdp("Page.addScriptToEvaluateOnNewDocument", source=script)

    def save_to(self, folder):
        self.cdp("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(folder))

    def wait_for(self, script):
        end = time.monotonic() + PATIENCE
        while not (value := self.run(f"return {script}")):
            if time.monotonic() > end:
                raise RuntimeError(f"never came: {script}")
            time.sleep(0.02)
        return value

    def press(self, *keys):
        actions = [{"type": kind, "value": KEYS.get(key, key)} for key in keys for kind in ("keyDown", "keyUp")]
        self.ask("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": actions}]})

    def move_to(self, x, y, click=False):
        actions = [{"type": "pointerMove", "duration": 0, "x": round(x), "y": round(y)}]
        if click:
            actions += [{"type": "pointerDown", "button": 0}, {"type": "pointerUp", "button": 0}]
        self.ask("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": actions}]})

    def mouse(self, kind, x, y):
        """A move, or the left button down or up, with no rest."""
        names = {"pointerMove": "mouseMoved", "pointerDown": "mousePressed", "pointerUp": "mouseReleased"}
        self.down = kind == "pointerDown" or (kind == "pointerMove" and getattr(self, "down", False))
        self.cdp("Input.dispatchMouseEvent", type=names[kind], x=x, y=y, button="left" if self.down or kind == "pointerUp" else "none",
                 buttons=int(self.down), clickCount=int(kind != "pointerMove"))

    def screenshot(self):
        return base64.b64decode(self.ask("GET", "/screenshot"))

    def pdf(self):
        return base64.b64decode(self.cdp("Page.printToPDF", printBackground=True, landscape=True)["data"])

    def errors(self):
        entries = self.ask("POST", "/se/log", {"type": "browser"})
        return [entry["message"] for entry in entries if entry["level"] == "SEVERE"]
