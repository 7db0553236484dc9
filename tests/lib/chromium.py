"""A headless Chromium (Debian: apt-get install chromium) that opens a page and says what it sees, over the DevTools protocol: https://chromedevtools.github.io/devtools-protocol

WebGL is in software, so that no graphics card is needed: pictures are the same, only slower.
"""

import base64
import contextlib
import fcntl
import json
import os
import pathlib
import select
import shutil
import subprocess
import tempfile
import time

WEBGL = ("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
NO_WEBGL = ("--disable-3d-apis",)
PATIENCE = 300  # s for an answer on a busy machine; a hang has none


def found():
    """path of the browser, None if there is none"""
    return next((path for name in ("chromium", "chromium-browser", "google-chrome") if (path := shutil.which(name))), None)


class Chromium:
    """One page; with it a context. said: messages of its console, asked: addresses that it asked a network for."""

    def __init__(self, webgl=True):
        self.said, self.asked, self.number, self.rest, self.events = [], [], 0, b"", []
        self.home = tempfile.TemporaryDirectory()
        ends = [*os.pipe(), *os.pipe()]
        high = [fcntl.fcntl(end, fcntl.F_DUPFD, 10) for end in ends]  # not 3 and 4, which the browser reads and writes
        for end in ends:
            os.close(end)
        theirs_in, self.out, self.inside, theirs_out = high

        def place():
            os.dup2(theirs_in, 3)
            os.dup2(theirs_out, 4)

        words = [found(), "--headless=new", "--no-sandbox", *(WEBGL if webgl else NO_WEBGL), "--disable-dev-shm-usage", "--hide-scrollbars", "--no-first-run", "--remote-debugging-pipe",
                 f"--user-data-dir={self.home.name}", "about:blank"]
        self.process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL, preexec_fn=place, pass_fds=(3, 4), env={**os.environ, "HOME": self.home.name})
        os.close(theirs_in)
        os.close(theirs_out)
        self.session = None
        target = next(one for one in self.ask("Target.getTargets")["targetInfos"] if one["type"] == "page")
        self.session = self.ask("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.ask(f"{domain}.enable")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with contextlib.suppress(OSError, RuntimeError):
            self.session = None
            self.ask("Browser.close")
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        os.close(self.out)
        os.close(self.inside)
        with contextlib.suppress(OSError):  # a child may still write there
            self.home.cleanup()

    # ------------------------------------------------------------------ messages
    def _next(self, deadline):
        while b"\0" not in self.rest:
            if not select.select([self.inside], [], [], max(0.0, deadline - time.monotonic()))[0]:
                raise RuntimeError(f"chromium does not answer in {PATIENCE} s")
            data = os.read(self.inside, 1 << 20)
            if not data:
                raise RuntimeError(f"chromium has ended, status {self.process.poll()}")
            self.rest += data
        text, _, self.rest = self.rest.partition(b"\0")
        return json.loads(text)

    def _take(self, message):
        what, words = message.get("method", ""), message.get("params", {})
        self.events.append(what)
        if what == "Runtime.consoleAPICalled":
            self.said.append(" ".join(str(one.get("value", one.get("description"))) for one in words["args"]))
        elif what == "Runtime.exceptionThrown":
            details = words["exceptionDetails"]
            self.said.append(details.get("exception", {}).get("description", details["text"]))
        elif what == "Log.entryAdded" and "GL Driver Message" not in words["entry"]["text"]:  # that reading pixels takes time
            self.said.append(words["entry"]["text"])
        elif what == "Network.requestWillBeSent" and not words["request"]["url"].startswith(("data:", "file:", "about:")):
            self.asked.append(words["request"]["url"])

    def ask(self, method, **words):
        """What the browser answers"""
        self.number += 1
        text = {"id": self.number, "method": method, "params": words, **({"sessionId": self.session} if self.session else {})}
        os.write(self.out, json.dumps(text).encode() + b"\0")
        deadline = time.monotonic() + PATIENCE
        while (message := self._next(deadline)).get("id") != self.number:
            self._take(message)
        if "error" in message:
            raise RuntimeError(f"{method}: {message['error']['message']}")
        return message["result"]

    # ------------------------------------------------------------------ a page
    def open(self, path, width=1400, height=1000):
        """Shows a file as wide as that"""
        self.size(width, height)
        self.said.clear()
        self.events.clear()
        self.ask("Page.navigate", url=pathlib.Path(path).resolve().as_uri())
        deadline = time.monotonic() + PATIENCE
        while "Page.loadEventFired" not in self.events:
            self._take(self._next(deadline))

    def size(self, width, height):
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def run(self, expression):
        """The value of a JavaScript expression, or of its promise"""
        answer = self.ask("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(answer["exceptionDetails"].get("exception", {}).get("description", answer["exceptionDetails"]["text"]))
        return answer["result"].get("value")

    def wait_for_scene(self):
        """until all frames of view.js are there"""
        self.run("""(async () => {
          for (let k = 0; k < 5000 && !document.querySelector(".scene").dataset.ready; k++) await new Promise(done => setTimeout(done, 20));
        })()""")

    def shot(self, path, of=None):
        """A picture of the window, or of one element of the page, by its selector"""
        clip = {}
        if of:
            place = self.run(f"(() => {{ const r = document.querySelector({json.dumps(of)}).getBoundingClientRect(); return {{ x: r.x, y: r.y, width: r.width, height: r.height }}; }})()")
            clip = {"clip": {**place, "scale": 1}}
        pathlib.Path(path).write_bytes(base64.b64decode(self.ask("Page.captureScreenshot", format="png", **clip)["data"]))

    def print(self, path):
        pathlib.Path(path).write_bytes(base64.b64decode(self.ask("Page.printToPDF", printBackground=True, preferCSSPageSize=True)["data"]))
