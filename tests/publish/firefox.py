"""Firefox driven by WebDriver BiDi (https://www.w3.org/TR/webdriver-bidi/), with nothing but Python's own."""

import base64
import json
import os
import re
import shutil
import socket
import struct
import subprocess
import tempfile

from browser import KEYS, PATIENCE, Browser

BINARY = shutil.which("firefox-esr") or shutil.which("firefox")


class Socket:
    """The client's side of a WebSocket (RFC 6455): texts are sent, and whole ones received."""

    def __init__(self, port, path):
        self.stream = socket.create_connection(("127.0.0.1", port), PATIENCE)
        key = base64.b64encode(os.urandom(16)).decode()
        self.stream.sendall(f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode())
        self.bytes = self.stream.makefile("rb")
        if b" 101 " not in self.bytes.readline():
            raise RuntimeError("Firefox takes no WebSocket")
        while self.bytes.readline().strip():
            pass

    def send(self, data, kind=1):
        mask = os.urandom(4)
        size = len(data)
        head = (struct.pack("!BB", 0x80 | kind, 0x80 | size) if size < 126 else
                struct.pack("!BBH", 0x80 | kind, 0xfe, size) if size < 1 << 16 else
                struct.pack("!BBQ", 0x80 | kind, 0xff, size))
        self.stream.sendall(head + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(data)))

    def receive(self):
        text = b""
        while True:
            first, size = self.bytes.read(2)
            if size > 125:
                size = int.from_bytes(self.bytes.read(2 if size == 126 else 8), "big")
            data = self.bytes.read(size)
            if first & 15 == 9:
                self.send(data, 10)  # a ping
            elif first & 15 < 3:
                text += data
                if first & 0x80:
                    return text


class Firefox(Browser):
    def __init__(self, size=(1600, 900)):
        self.profile = tempfile.TemporaryDirectory()
        self.driver = subprocess.Popen([BINARY, "--headless", "--no-remote", "--remote-debugging-port=0",
                                        "--profile", self.profile.name], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.PIPE, text=True)
        port = next((int(found[1]) for line in self.driver.stderr
                     if (found := re.search(r"BiDi listening on ws://127.0.0.1:(\d+)", line))), None)
        if port is None:
            raise RuntimeError("Firefox ended")
        self.socket = Socket(port, "/session")
        self.count, self.said = 0, []
        self.ask("session.new", capabilities={})
        self.context = self.ask("browsingContext.getTree")["contexts"][0]["context"]
        self.ask("session.subscribe", events=["log.entryAdded"])
        self.ask("browsingContext.setViewport", context=self.context,
                 viewport={"width": size[0], "height": size[1]})

    def __exit__(self, *_):
        self.driver.terminate()
        self.driver.wait(PATIENCE)
        self.profile.cleanup()

    def ask(self, method, **parameters):
        self.count += 1
        self.socket.send(json.dumps({"id": self.count, "method": method, "params": parameters}).encode())
        while True:
            answer = json.loads(self.socket.receive())
            if answer.get("method") == "log.entryAdded":
                self.said.append(answer["params"])
            if answer.get("id") == self.count:
                break
        if answer["type"] == "error":
            raise RuntimeError(f"{method}: {answer['message']}")
        return answer["result"]

    def open(self, address):
        self.ask("browsingContext.navigate", context=self.context, url=address, wait="complete")

    def run(self, script, *arguments):
        return self.promise(f"return (function () {{ {script} }}).apply(null, arguments)", *arguments)

    def promise(self, script, *arguments):
        code = f"async (all) => JSON.stringify(await (function () {{ {script} }}).apply(null, JSON.parse(all)) ?? null)"
        said = self.ask("script.callFunction", functionDeclaration=code, awaitPromise=True,
                        arguments=[{"type": "string", "value": json.dumps(arguments)}],
                        target={"context": self.context})
        if said["type"] == "exception":
            raise RuntimeError(said["exceptionDetails"]["text"])
        return json.loads(said["result"]["value"])

    def act(self, kind, source, *actions):
        self.ask("input.performActions", context=self.context,
                 actions=[{"type": kind, "id": source, "actions": list(actions)}])

    def press(self, *keys):
        self.act("key", "keys", *({"type": kind, "value": KEYS.get(key, key)}
                                  for key in keys for kind in ("keyDown", "keyUp")))

    def mouse(self, kind, x, y):
        move = {"type": "pointerMove", "duration": 0, "x": round(x), "y": round(y)}
        self.act("pointer", "mouse", move, *({"type": one, "button": 0} for one in [kind] if one != "pointerMove"))

    def move_to(self, x, y, click=False):
        for kind in ("pointerMove", "pointerDown", "pointerUp")[:3 if click else 1]:
            self.mouse(kind, x, y)

    def before_load(self, script):
        self.ask("script.addPreloadScript", functionDeclaration=f"() => {{ {script} }}")

    def save_to(self, folder):
        self.ask("browser.setDownloadBehavior",
                 downloadBehavior={"type": "allowed", "destinationFolder": str(folder)})

    def screenshot(self):
        return base64.b64decode(self.ask("browsingContext.captureScreenshot", context=self.context)["data"])

    def errors(self):
        said = [one for one in self.said if one["level"] == "error"]
        self.said = []
        return [one["text"] for one in said]
