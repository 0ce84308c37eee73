"""Chromium without a window, for tests of pages: Debian's packages chromium and python3-websocket."""
import base64
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import debian

websocket, = debian.need("python3-websocket", "websocket")
PROGRAM = shutil.which("chromium")
if not PROGRAM:
    print("SKIPPED: no chromium; apt-get install chromium")
    sys.exit(1 if os.environ.get("BRC_NO_SKIPS") else 77)
# WebGL is drawn by the processor (SwiftShader); in containers there is no sandbox.
ARGUMENTS = ["--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--remote-debugging-port=0", "--remote-allow-origins=*",
             "--window-size=1240,1400", "--disable-dev-shm-usage"]
EVENTS = ("Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Log.entryAdded", "Network.requestWillBeSent")


class Browser:
    """`with Browser() as browser`: one page after the other by the DevTools protocol."""

    def __enter__(self):
        self.folder = tempfile.mkdtemp()
        self.process = subprocess.Popen([PROGRAM, *ARGUMENTS, "--user-data-dir=" + self.folder, "about:blank"],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        port = None
        for line in self.process.stderr:
            if "DevTools listening on ws://" in line:
                port = line.split("ws://127.0.0.1:")[1].split("/")[0]
                break
        assert port, "chromium does not start"
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/json") as answer:
            pages = [page for page in json.load(answer) if page["type"] == "page"]
        self.socket = websocket.create_connection(pages[0]["webSocketDebuggerUrl"], timeout=120)
        self.calls = 0
        self.events = []
        for domain in ("Runtime", "Page", "Log", "Network"):
            self.call(domain + ".enable")
        return self

    def __exit__(self, *_):
        self.socket.close()
        self.process.kill()
        self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def call(self, method, **parameters):
        self.calls += 1
        self.socket.send(json.dumps({"id": self.calls, "method": method, "params": parameters}))
        while True:
            answer = json.loads(self.socket.recv())
            if answer.get("method") in EVENTS:
                self.events.append(answer)
            if answer.get("id") == self.calls:
                assert "error" not in answer, answer
                return answer["result"]

    def evaluate(self, script):
        answer = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        assert "exceptionDetails" not in answer, answer
        return answer["result"].get("value")

    def wait(self, script, seconds=60):
        """The value of the script, as soon as there is one."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            value = self.evaluate(script)
            if value:
                return value
            time.sleep(0.05)
        raise AssertionError(f"not within {seconds} s: {script}")

    def open(self, path):
        self.events.clear()
        self.call("Page.navigate", url="file://" + os.path.abspath(path))
        self.wait("document.readyState === 'complete'")

    def wheel(self, x, y, turns):
        self.call("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=turns)

    def picture(self, path, **clip):
        more = {"clip": clip} if clip else {}
        answer = self.call("Page.captureScreenshot", captureBeyondViewport=True, **more)
        with open(path, "wb") as file:
            file.write(base64.b64decode(answer["data"]))

    def complaints(self):
        """What the console says, and what went out to a network."""
        found = []
        for event in self.events:
            what, data = event["method"], event["params"]
            if what != "Network.requestWillBeSent":
                found.append(json.dumps(data)[:400])
            elif not data["request"]["url"].startswith(("file:", "data:", "blob:", "about:")):
                found.append("asks for " + data["request"]["url"])
        return found
