"""The page that has the program in it, opened in a browser.

In: a Browser or a Firefox, scenes, what a person would do. Out: what the page shows and saves.
"""

import base64
import json
import sys
import time

# Functions that stay in the page.
HELPERS = """
window.check = {
  failures: [],
  async idle() {
    while (document.body.dataset.isBusy !== "false") await new Promise(done => setTimeout(done, 1));
  },
  set(input, value) {
    if (input.type === "checkbox") input.checked = value; else input.value = value;
    input.dispatchEvent(new Event("input", {bubbles: true}));
    input.dispatchEvent(new Event("change", {bubbles: true}));
  },
  /** Later than the page waits for more of a text. */
  async open(text) {
    check.set(document.getElementById("text"), text);
    await new Promise(done => setTimeout(done, 160));
    await check.idle();
    return check.problems();
  },
  async go(instant) {
    document.getElementById("instant").value = instant;
    document.getElementById("go").click();
    await check.idle();
    return check.problems();
  },
  problems() {
    return [...document.querySelectorAll("#problem, .problem")]
      .filter(one => one.checkVisibility ? one.checkVisibility() : !one.hidden)
      .filter(one => one.textContent).map(one => one.textContent);
  },
  field(key) {
    const root = document.querySelector(`[data-key="${key}"]`);
    return root.querySelector("input[type=text]") ?? root.querySelector("select, input");
  },
  async edit(key, value) {
    check.set(check.field(key), value);
    await check.idle();
    return check.problems();
  },
  pixels(source, width, height) {
    const canvas = document.createElement("canvas");
    Object.assign(canvas, {width, height});
    const context = canvas.getContext("2d", {willReadFrequently: true});
    context.drawImage(source, 0, 0);
    return new Uint32Array(context.getImageData(0, 0, width, height).data.buffer);
  },
  /** Pixels of the page's picture that differ from this PNG, as this browser decodes it. */
  async differences(png) {
    const bytes = Uint8Array.from(atob(png), c => c.charCodeAt(0));
    const expected = await createImageBitmap(new Blob([bytes], {type: "image/png"}),
      {premultiplyAlpha: "none", colorSpaceConversion: "none"});
    const picture = document.getElementById("picture");
    const {width, height} = expected;
    if (picture.width !== width || picture.height !== height) return width * height;
    const found = picture.getContext("2d").getImageData(0, 0, width, height).data;
    const words = new Uint32Array(found.buffer);
    return check.pixels(expected, width, height).reduce((sum, one, i) => sum + (one !== words[i]), 0);
  },
  /** The bytes of a file that a button saves, in base64; a text of what is wrong. */
  async save(ending) {
    const create = URL.createObjectURL;
    let saved = null;
    URL.createObjectURL = blob => create.call(URL, blob.type.startsWith("text/") ? blob : saved = blob);
    const start = performance.now();
    document.querySelector(`[data-save=${ending}]`).click();
    const problem = document.getElementById("saving-problem");
    while (!saved && problem.hidden) await new Promise(done => setTimeout(done, 2));
    URL.createObjectURL = create;
    if (!saved) return {problem: problem.textContent};
    const seconds = (performance.now() - start) / 1000;
    const address = await new Promise(done => {
      const reader = new FileReader();
      reader.onload = () => done(reader.result);
      reader.readAsDataURL(saved);
    });
    return {base64: address.split(",")[1], seconds};
  },
};
addEventListener("error", event => check.failures.push(String(event.message)));
addEventListener("unhandledrejection", event => check.failures.push(String(event.reason)));
"""


class LivePage:
    def __init__(self, browser, path, address=""):
        self.browser = browser
        self.load(path, address)

    def load(self, path, address=""):
        uri = path.as_uri() + address
        # Another fragment alone would not load the page again.
        self.browser.show_address("about:blank")
        self.browser.show_address(uri)
        self.browser.value(f"(() => {{ {HELPERS} return true; }})()")
        for _ in range(1500):
            if self.value("document.getElementById('read-outs').children.length > 0 || "
                          "!document.getElementById('problem').hidden"):
                break
            time.sleep(0.02)
        else:
            sys.exit("live_page: shows nothing")
        self.value("check.idle().then(() => true)")

    def value(self, script):
        return self.browser.value(script)

    def _call(self, name, *arguments):
        return self.value(f"check.{name}({', '.join(map(json.dumps, arguments))})")

    def open(self, text):
        """@returns what the page says is wrong."""
        return self._call("open", text)

    def go(self, instant):
        return self._call("go", instant)

    def edit(self, key, value):
        return self._call("edit", key, value)

    def differences(self, png):
        return self._call("differences", base64.b64encode(png).decode())

    def save(self, ending):
        """@returns the bytes and the seconds that it took."""
        saved = self._call("save", ending)
        if "problem" in saved:
            sys.exit(f"live_page: {ending}: {saved['problem']}")
        return base64.b64decode(saved["base64"]), saved["seconds"]

    def text(self, name):
        return self.value(f"document.getElementById('{name}').textContent")

    def failures(self):
        return self.value("check.failures")
