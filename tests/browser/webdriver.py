"""Chromium without a window, driven through chromedriver by the WebDriver protocol; needs the standard library alone."""

import atexit
import base64
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # the key of an element's name, from the standard
LONGEST = 150  # seconds until a browser that hangs is ended


class Browser:
    """A browser and its driver, with files of their own. Both end with close(), with the program, and after LONGEST."""

    def __init__(self):
        programs = [shutil.which(name) for name in ("chromedriver", "chromium")]
        if not all(programs):
            raise FileNotFoundError("the tests of the pages need Debian's packages chromium and chromium-driver")
        self.folder = tempfile.mkdtemp(prefix="liecheck_browser_")
        self.session = self.driver = None
        atexit.register(self.close)
        for name in (signal.SIGALRM, signal.SIGTERM, signal.SIGHUP):
            signal.signal(name, self._stopped)
        signal.alarm(LONGEST)
        log = pathlib.Path(self.folder, "driver.txt")
        with log.open("w") as out:
            self.driver = subprocess.Popen([programs[0], "--port=0"], stdout=out, stderr=out,
                                           env={**os.environ, "HOME": self.folder})
        self.address = f"http://127.0.0.1:{self._port(log)}"
        arguments = ["--headless", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu",
                     "--allow-file-access-from-files", f"--user-data-dir={self.folder}/profile"]
        answer = self._send("POST", "/session", {"capabilities": {"alwaysMatch": {
            "goog:chromeOptions": {"binary": programs[1], "args": arguments},
            "goog:loggingPrefs": {"browser": "ALL"}}}})
        self.session = f"/session/{answer['sessionId']}"

    def _stopped(self, number, _):
        raise SystemExit(f"stopped by {signal.Signals(number).name}")

    def _port(self, log):
        for _ in range(300):
            if found := re.search(r"successfully on port (\d+)", log.read_text()):
                return found[1]
            if self.driver.poll() is not None:
                break
            time.sleep(.05)
        raise RuntimeError("chromedriver did not start: " + log.read_text())

    def _send(self, method, path, body=None):
        request = urllib.request.Request(self.address + path, method=method, headers={"Content-Type": "application/json"},
                                         data=None if body is None else json.dumps(body).encode())
        try:
            with urllib.request.build_opener(urllib.request.ProxyHandler({})).open(request, timeout=LONGEST) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"]) from None

    def post(self, command, **body):
        return self._send("POST", f"{self.session}/{command}", body)

    def close(self):
        """Ends the browser, the driver, and whatever else was started with this folder."""
        signal.alarm(0)
        if self.session:
            try:
                self._send("DELETE", self.session)
            except (OSError, RuntimeError):
                pass
            self.session = None
        if self.driver:
            self.driver.kill()
            self.driver.wait()
            self.driver = None
        own = f"--user-data-dir={self.folder}/".encode()
        for process in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
            try:
                if own in process.read_bytes():
                    os.kill(int(process.parent.name), signal.SIGKILL)
            except OSError:  # it has ended
                pass
        shutil.rmtree(self.folder, ignore_errors=True)

    def open(self, file, fragment=""):
        self.post("url", url="about:blank")  # so that a new fragment loads the page anew
        self.post("url", url=pathlib.Path(file).absolute().as_uri() + fragment)

    def run(self, script, *arguments):
        """What the body of a function returns. A promise is awaited, and an element is returned by its name."""
        return self.post("execute/sync", script=script, args=list(arguments))

    def press(self, selector, keys):
        found = self.post("element", using="css selector", value=selector)
        self.post(f"element/{found[ELEMENT]}/value", text=keys)

    def devtools(self, command, **parameters):
        return self.post("goog/cdp/execute", cmd=command, params=parameters)

    def size(self, width, height=900):
        self.devtools("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                      mobile=width < 700)

    def media(self, media="", scheme="light"):
        self.devtools("Emulation.setEmulatedMedia", media=media,
                      features=[{"name": "prefers-color-scheme", "value": scheme}])

    def errors(self):
        """What the console has said since the last call."""
        return [f"{entry['level']}: {entry['message']}" for entry in self.post("se/log", type="browser")]

    def printed(self):
        """The PDF of the page on A4."""
        return base64.b64decode(self.post("print", background=True, page={"width": 21, "height": 29.7}))
