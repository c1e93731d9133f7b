"""The live page, opened in a browser.

In: a Browser or a Firefox, scenes, what a person would do. Out: what the page shows and saves.
"""

import base64
import json
import pathlib
import sys
import time

# Functions that stay in the page.
HELPERS = (pathlib.Path(__file__).resolve().parent / "live_page.js").read_text()


class LivePage:
    def __init__(self, browser, path, address=""):
        self.browser = browser
        # The page would play by itself.
        if hasattr(browser, "prefer"):
            browser.prefer(prefers_reduced_motion="reduce")
        self.load(path, address)

    def load(self, path, address=""):
        uri = path.as_uri() + address
        # Another fragment alone would not load the page again.
        self.browser.show_address("about:blank")
        self.browser.show_address(uri)
        self.run(HELPERS)
        for _ in range(1500):
            if self.value("document.getElementById('state').children.length > 0 || "
                          "!document.getElementById('problem').hidden"):
                break
            time.sleep(0.02)
        else:
            sys.exit(f"live_page: shows nothing: {address[:40]} {self.take_failures()}")
        self.value("check.idle().then(() => true)")
        self.run("if (!document.getElementById('exact').checked) document.getElementById('exact').click();")

    def value(self, script):
        return self.browser.value(script)

    def run(self, script):
        """Statements, which leave what they give to `window`."""
        self.value(f"(() => {{ {script}\nreturn true; }})()")

    def call(self, name, *arguments):
        """What a function of live_page.js says."""
        return self.value(f"check.{name}({', '.join(map(json.dumps, arguments))})")

    def open(self, text):
        """@returns what the page says is wrong."""
        return self.call("open", text)

    def go(self, instant):
        return self.call("go", instant)

    def press(self, button):
        return self.call("press", button)

    def edit(self, key, value):
        return self.call("edit", key, value)

    def choose(self, scene):
        return self.call("choose", scene)

    def state_rows(self):
        """{name: texts}; digits are not grouped."""
        return {name: [text.replace("\u202f", "") for text in texts]
                for name, texts in self.call("stateRows").items()}

    def differences(self, png):
        return self.call("differences", base64.b64encode(png).decode())

    def save(self, extension):
        """@returns the bytes and the seconds that it took."""
        saved = self.call("save", extension)
        if "problem" in saved:
            sys.exit(f"live_page: {extension}: {saved['problem']}")
        return base64.b64decode(saved["base64"]), saved["seconds"]

    def text(self, name):
        return self.value(f"document.getElementById('{name}').textContent")

    def take_failures(self):
        """Exceptions that escaped since the last call, also in pages that were shown before."""
        return self.browser.take_exceptions()
