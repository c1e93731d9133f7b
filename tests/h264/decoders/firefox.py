"""A page in Firefox, for checks of what it shows.

In: scripts. Out: what they say.
"""

import base64
import json
import socket
import subprocess
import sys
import time

KEYS = {"ArrowRight": "\ue014"}  # as WebDriver calls them


class Firefox:
    """With one page, by the Marionette protocol over a socket."""

    def __init__(self, folder):
        folder.mkdir()
        # Any port that is free; Firefox says which one.
        (folder / "user.js").write_text('user_pref("marionette.port", 0);\nuser_pref("ui.prefersReducedMotion", 1);\n')
        self._process = subprocess.Popen(
            ["firefox-esr", "--headless", "--marionette", "--remote-allow-system-access", "--no-remote",
             "--profile", folder],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self._socket = socket.create_connection(("127.0.0.1", self._port(folder)))
        self._answers = self._socket.makefile("rb")
        self._number = 0
        self._next_message()
        self.call("WebDriver:NewSession")
        self.call("WebDriver:SetTimeouts", script=600000)

    def watch_workers(self):
        """The browser's own console tells of workers anyway."""

    def close(self):
        self._process.terminate()
        self._process.wait()

    def _port(self, folder):
        file = folder / "MarionetteActivePort"
        for _ in range(600):
            if file.exists() and file.read_text():
                return int(file.read_text())
            if self._process.poll() is not None:
                break
            time.sleep(0.1)
        self.close()
        sys.exit("firefox: does not start")

    def _next_message(self):
        size = b""
        while not size.endswith(b":"):
            byte = self._answers.read(1)
            if not byte:
                sys.exit("firefox: Firefox has ended")
            size += byte
        return json.loads(self._answers.read(int(size[:-1])))

    def call(self, method, **parameters):
        self._number += 1
        command = json.dumps([0, self._number, method, parameters]).encode()
        self._socket.sendall(b"%d:%s" % (len(command), command))
        _, _, error, result = self._next_message()
        if error:
            sys.exit(f"firefox: {method}: {error['message']}")
        return result

    def show_address(self, address):
        self.call("WebDriver:Navigate", url=address)

    def resize(self, width, height):
        """The page, without what the window has around it."""
        around = self.value("[outerWidth - innerWidth, outerHeight - innerHeight]")
        self.call("WebDriver:SetWindowRect", width=width + around[0], height=height + around[1])

    def press(self, key, _code):
        """A key by its name. Its number is what Chromium wants."""
        actions = [{"type": kind, "value": KEYS[key]} for kind in ("keyDown", "keyUp")]
        self.call("WebDriver:PerformActions", actions=[{"type": "key", "id": "keyboard", "actions": actions}])

    def save_picture(self, _element, path):
        """What is seen in the window."""
        path.write_bytes(base64.b64decode(self.call("WebDriver:TakeScreenshot", full=False)["value"]))

    def value(self, script):
        """What JavaScript says, promises kept."""
        text = f"""const done = arguments[0];
            (async () => ({script}))().then(value => done([value]), error => done(String(error)))"""
        found = self.call("WebDriver:ExecuteAsyncScript", script=text, args=[], sandbox=None)["value"]
        if isinstance(found, str):
            sys.exit(f"firefox: {script[:80]}: {found}")
        return found[0]

    def take_exceptions(self):
        """What escaped, promises too, in all pages and workers since the last call.

        Marionette runs no script before those of a page. The browser's own console has the errors of
        all of them.
        """
        self.call("Marionette:SetContext", value="chrome")
        taken = self.value("""(() => {
            const errors = Services.console.getMessageArray()
              .filter(one => one instanceof Ci.nsIScriptError)
              .filter(one => ["content javascript", "Web Worker"].includes(one.category))
              .filter(one => !(one.flags & Ci.nsIScriptError.warningFlag))
              .map(one => one.errorMessage);
            Services.console.reset();
            return errors; })()""")
        self.call("Marionette:SetContext", value="content")
        return taken
