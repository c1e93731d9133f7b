"""Browsers that may be installed, as decoders of H.264 and as players.

In: files in a folder. Out: what a page there says of them.
"""

import functools
import http.server
import json
import pathlib
import shutil
import sys
import threading

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent.parent / "golden"))
from browser import Browser
from firefox import Firefox


class Handler(http.server.SimpleHTTPRequestHandler):
    """Says nothing of what is asked for."""

    def log_message(self, *_):
        pass


class Server:
    """Lends a folder to browsers: over http, for only then may a page decode."""

    def __init__(self, folder):
        shutil.copy(HERE / "page.html", folder)
        self.server = http.server.ThreadingHTTPServer(
            ("127.0.0.1", 0), functools.partial(Handler, directory=folder))
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.page = f"http://127.0.0.1:{self.server.server_port}/page.html"


class WebBrowser:
    """Decodes a stream by WebCodecs, and plays a file."""

    def __init__(self, name, program, browser):
        self.name, self.package, self.browser = name, program, browser
        self._page = None

    def is_there(self):
        return shutil.which(self.package)

    def begin(self, work, server):
        self._page = self.browser(work / f"{self.name}-profile")
        self._page.show_address(server.page)

    def close(self):
        if self._page:
            self._page.close()

    def value(self, function, *arguments):
        return self._page.value(f"{function}({', '.join(map(json.dumps, arguments))})")

    def pictures(self, stream):
        return self.value("decode", stream.file.name, stream.codec(), stream.units())


BROWSERS = [WebBrowser("Chromium", "chromium", Browser),
            WebBrowser("Firefox", "firefox-esr", Firefox)]
