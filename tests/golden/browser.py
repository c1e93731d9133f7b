"""A page in Chromium, for checks of what it shows.

In: what a person would do by mouse and keyboard, and scripts. Out: what is seen, and what scripts say.
"""

import base64
import contextlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile


# Events that are kept from page to page.
NOTED = ["Runtime.exceptionThrown", "Network.requestWillBeSent", "Log.entryAdded"]


class Browser:
    """Chromium with one page, by the DevTools protocol over two pipes."""

    def __init__(self, folder, *options):
        commands, self._commands = os.pipe()
        answers, written_answers = os.pipe()
        self._answers = os.fdopen(answers, "rb")
        self._process = subprocess.Popen(
            ["bash", "-c", f'exec "$@" 3<&{commands} 4>&{written_answers}', "bash"]
            + ["chromium", "--headless", "--no-sandbox", "--disable-dev-shm-usage"]
            + ["--hide-scrollbars", "--force-color-profile=srgb", "--remote-debugging-pipe"]
            + [f"--user-data-dir={folder}", *options, "about:blank"],
            pass_fds=(commands, written_answers),
            stderr=subprocess.DEVNULL,
        )
        os.close(commands)
        os.close(written_answers)
        self._session = {}
        self._number = 0
        self._noted = {name: [] for name in NOTED}
        self.events = []
        self.workers = 0  # that were watched
        self._of_workers = set()  # numbers of what they were told
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        self._session = {"sessionId": session}
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")

    def watch_workers(self):
        """From now on take_exceptions() and take_requests() tell of workers, too."""
        self.call("Target.setAutoAttach", autoAttach=True, waitForDebuggerOnStart=True, flatten=True)

    def close(self):
        self._process.terminate()
        self._process.wait()

    def _next_message(self):
        message = bytearray()
        while not message.endswith(b"\0"):
            byte = self._answers.read(1)
            if not byte:
                sys.exit("browser: Chromium has ended")
            message += byte
        answer = json.loads(message[:-1])
        self._note(answer.get("method"), answer.get("params"))
        return answer

    def _note(self, method, parameters):
        """Workers wait at their start until they are watched, too."""
        if method in NOTED:
            self._noted[method].append(parameters)
        elif method == "Target.attachedToTarget" and "sessionId" in self._session:
            self.workers += 1
            session = {"sessionId": parameters["sessionId"]}
            for command in ("Network.enable", "Runtime.enable", "Runtime.runIfWaitingForDebugger"):
                self._of_workers.add(self._send(command, {}, session))

    def take_exceptions(self):
        """What escaped, promises too, in all pages since the last call, from their first script on."""
        thrown = [(one["exceptionDetails"]["text"], one["exceptionDetails"].get("exception", {}))
                  for one in self._take("Runtime.exceptionThrown")]
        return [f"{text} {value.get('description', value.get('value', ''))}" for text, value in thrown]

    def take_requests(self):
        """Addresses that all pages have asked for since the last call."""
        return [one["request"]["url"] for one in self._take("Network.requestWillBeSent")]

    def take_log(self):
        """What the browser itself has said of all pages since the last call."""
        return [one["entry"]["text"] for one in self._take("Log.entryAdded")]

    def _take(self, method):
        self.value("0")  # what comes before the answer is read
        taken, self._noted[method] = self._noted[method], []
        return taken

    def _send(self, method, parameters, session):
        self._number += 1
        command = {"id": self._number, "method": method, "params": parameters, **session}
        os.write(self._commands, json.dumps(command).encode() + b"\0")
        return self._number

    def call(self, method, **parameters):
        number = self._send(method, parameters, self._session)
        while True:
            message = self._next_message()
            if message.get("id") == number:
                if "error" in message:
                    sys.exit(f"browser: {method}: {message['error']}")
                return message["result"]
            self._keep(message)

    def _keep(self, message):
        if "method" in message:
            self.events.append(message)
        elif message["id"] in self._of_workers and "error" in message:
            # A worker may have ended before it was watched.
            if "Session with given id not found" not in message["error"]["message"]:
                sys.exit(f"browser: a worker cannot be watched: {message['error']}")

    def show(self, path):
        self.show_address(path.as_uri())

    def show_address(self, address):
        self._load("Page.navigate", url=address)

    def reload(self):
        self._load("Page.reload")

    def _load(self, method, **parameters):
        """All events are then of this page."""
        self.events.clear()
        self.call(method, **parameters)
        while not any(event["method"] == "Page.loadEventFired" for event in self.events):
            self._keep(self._next_message())

    def resize(self, width, height, zoom=1):
        """The window, in CSS pixels, each of which is so many of the screen's."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=zoom, mobile=False)

    def value(self, script):
        """What JavaScript says, promises kept."""
        answer = self.call("Runtime.evaluate", expression=script, awaitPromise=True,
                           returnByValue=True)
        if "exceptionDetails" in answer:
            sys.exit(f"browser: {script}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def rect(self, element):
        """Left, top, width, height in the window, after it has been scrolled to."""
        return self.value(f"""(() => {{
            const element = {element};
            element.scrollIntoView({{block: "center"}});
            const r = element.getBoundingClientRect();
            return [r.x, r.y, r.width, r.height]; }})()""")

    def mouse(self, kind, x, y):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=1,
                  clickCount=1)

    def click(self, element):
        left, top, width, height = self.rect(element)
        for kind in ("mousePressed", "mouseReleased"):
            self.mouse(kind, left + width / 2, top + height / 2)

    def drag(self, start, end):
        self.mouse("mousePressed", *start)
        self.mouse("mouseMoved", *end)
        self.mouse("mouseReleased", *end)

    def type(self, element, text):
        """Instead of what is there."""
        self.click(element)
        self.value(f"{element}.select()")
        if text:
            self.call("Input.insertText", text=text)
        else:
            self.press("Delete", 46)

    def press(self, key, code, text=""):
        """A key by its name and number; with what it types, if anything."""
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, code=key,
                      windowsVirtualKeyCode=code, **({"text": text} if text else {}))

    def prefer(self, **features):
        """What the person has set up, such as prefers_color_scheme="dark"."""
        self.call("Emulation.setEmulatedMedia", features=[
            {"name": name.replace("_", "-"), "value": value} for name, value in features.items()])

    def save_picture(self, element, path):
        """What is seen where this element is."""
        left, top, width, height = (round(x) for x in self.rect(element))
        scrolled = self.value("scrollY")
        clip = {"x": left, "y": top + scrolled, "width": width, "height": height, "scale": 1}
        data = self.call("Page.captureScreenshot", format="png", clip=clip)["data"]
        path.write_bytes(base64.b64decode(data))


class PageCheck:
    """What checks of pages share: the program, a folder, a browser, and the count of what is wrong."""

    def __init__(self, program, work, browser):
        self.program, self.work, self.browser = program, work, browser
        self.faults = 0

    def piblocks(self, *arguments):
        """@returns the exit code. What is printed is in self.printed."""
        run = subprocess.run([self.program, *arguments], cwd=self.work, stdout=subprocess.PIPE)
        self.printed = run.stdout.decode()
        return run.returncode

    def expect(self, what, found, expected):
        if found != expected:
            print(f"{pathlib.Path(sys.argv[0]).name}: {what}: {found} instead of {expected}", file=sys.stderr)
            self.faults += 1

    def expect_quiet_page(self, what):
        """It asked for nothing but itself and what it contains, and complained of nothing."""
        asked = [event["params"]["request"]["url"] for event in self.browser.events
                 if event["method"] == "Network.requestWillBeSent"]
        elsewhere = [url[:80] for url in asked if not url.startswith(("data:", "file:"))]
        self.expect(f"{what}: requests to other places", elsewhere, [])
        files = [url for url in asked if url.startswith("file:") and "-files/" not in url]
        self.expect(f"{what}: files that were read", len(files), 1)
        complaints = [event["params"] for event in self.browser.events if event["method"] in
                      ("Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Log.entryAdded")]
        self.expect(f"{what}: on the console", complaints, [])


@contextlib.contextmanager
def browsing(driver, *options):
    """A browser and a folder, as long as they are needed. @param driver  such as Browser"""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as work:
        work = pathlib.Path(work)
        browser = driver(work / "profile", *options)
        try:
            yield browser, work
        finally:
            browser.close()


def run_check(make, *options):
    """Runs make(work, browser).run() and ends the process: 1 if anything is wrong, 77 without Chromium.

    @param options  of Chromium
    """
    if not shutil.which("chromium"):
        print("skipped: chromium (Debian package chromium) is missing")
        sys.exit(77)
    with browsing(Browser, *options) as (browser, work):
        check = make(work, browser)
        check.run()
    sys.exit(1 if check.faults else 0)
