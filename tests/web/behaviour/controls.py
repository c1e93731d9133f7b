"""Controls that are never refused, in every scene of the program.

In: a Check. Out: its faults.
"""

import base64
import re

# Buttons of the page that make files or leave it.
NO_BUTTONS = ["share", "copy-embed", "copy-text", "full-screen", "play", "play-first", "sound", "stop", "cancel",
              "bring-back", "undo"]

# The size of the picture behind the canvas, as the browser loads it; null if there is none.
POSTER_SIZE = """new Promise(done => {
  const image = new Image();
  image.onload = () => done(`${image.width}x${image.height}`);
  image.onerror = () => done("refused");
  const [, url] = /^url\\("(.*?)"\\)/.exec(getComputedStyle(document.getElementById("picture")).backgroundImage) ?? [];
  if (url) image.src = url;
  else done(null);
})"""

SCRIPT = """
const inputs = kind => [...document.querySelectorAll(`#settings input[type=${kind}]`)]
  .filter(one => check.isThere(one) && !one.disabled);
const nameOf = input => `${input.closest("[data-key]").dataset.key} ${input.value}`;

/** A slider stands at one of its steps. */
const isKept = (input, value, isEnd) => input.type === "checkbox" ? input.checked === value
  : Math.abs(Number(input.value) - Number(value)) <= (isEnd ? 1.001 : 0.501) * Number(input.step);

/** What is refused when controls of this kind are used; each begins with the scene as it is. */
check.refusals = async (scene, kind, values) => {
  const faults = [];
  await check.choose(scene);
  // What boxes can be chosen is asked for when they are seen.
  document.getElementById("more").open = true;
  for (let i = 0; i < inputs(kind).length; ++i) {
    for (const value of values) {
      const input = inputs(kind)[i];
      if (!input) break;
      const before = nameOf(input);
      if (kind === "checkbox") await check.until("choices", () => document.body.dataset.hasChoices === "true");
      if (input.disabled) continue;
      const wanted = value(input);
      ++window.tried;
      const isEnd = [input.min, input.max].some(end => Math.abs(Number(wanted) - Number(end)) < 1e-9);
      const problems = await check.after(() => check.set(input, wanted));
      if (problems.length > 0) faults.push(`${scene}: ${before}: ${problems.join("; ")}`);
      if (!isKept(input, wanted, isEnd)) faults.push(`${scene}: ${before}: ${wanted} is taken back`);
    }
    await check.choose(scene);
  }
  return faults;
};
check.positions = [0, 1, 2, 3, 4, 5, 6, 7, 8].map(i => input =>
  String(Number(input.min) + i / 8 * (Number(input.max) - Number(input.min))));
check.flips = [input => !input.checked, input => !input.checked];
check.choicesOf = async scene => {
  const faults = [];
  for (const select of document.querySelectorAll("#settings select")) {
    for (const option of select.options) {
      ++window.tried;
      const problems = await check.after(() => check.set(select, option.value));
      if (problems.length > 0 || select.value !== option.value) {
        faults.push(`${scene}: ${option.value}: ${problems.join("; ")}`);
      }
    }
  }
  return faults;
};
check.presses = async (scene, not) => {
  const faults = [];
  await check.choose(scene);
  for (const button of document.querySelectorAll("button[id]")) {
    if (not.includes(button.id) || button.disabled || !check.isThere(button) || button.dataset.save) continue;
    ++window.tried;
    const problems = await check.press(button.id);
    if (problems.length > 0) faults.push(`${scene}: ${button.id}: ${problems.join("; ")}`);
  }
  return faults;
};
"""


def _expect_no_refusal(check, call):
    check.page.run(SCRIPT)
    check.page.run("window.tried = 0;")
    for scene in check.scene_names():
        check.page.run(f"window.now = {scene!r};")
        for fault in check.page.value(call):
            check.expect(fault, False)
    check.expect("controls were tried", check.page.value("window.tried") > 100)


def no_slider_is_refused(check):
    _expect_no_refusal(check, "check.refusals(now, 'range', check.positions)")


def no_box_is_refused(check):
    _expect_no_refusal(check, "check.refusals(now, 'checkbox', check.flips)")


def no_choice_is_refused(check):
    _expect_no_refusal(check, "check.choose(now).then(() => check.choicesOf(now))")


def no_button_is_refused(check):
    _expect_no_refusal(check, f"check.presses(now, {NO_BUTTONS})")


def what_cannot_be_shown_is_left_out_and_comes_back(check):
    """A picture never stands in the way of a control."""
    check.page.choose("circle")
    before = check.page.call("digest")
    check.expect("nothing is left out", check.is_seen("left-out"), False)
    check.page.call("moveSlider", "restitution", 0.5)
    check.expect("refused", check.page.call("problems"), [])
    check.expect("left out", check.is_seen("left-out"))
    check.expect("its name", "ellipse" in check.page.text("left-out"))
    check.page.press("bring-back")
    check.page.value("check.later(300).then(check.idle)")
    check.expect("the picture", check.page.call("digest"), before)
    check.expect("nothing is left out any more", check.is_seen("left-out"), False)


def back_goes_through_scenes_and_edits(check):
    check.page.choose("article")
    first = check.page.call("digest")
    check.page.edit("blue.position", "2.5")
    edited = check.page.call("digest")
    check.page.value("check.later(400)")
    check.page.choose("lecture")
    check.page.value("check.later(400)")
    for what, picture in [("the edit", edited), ("the scene", first)]:
        check.page.value("(history.back(), check.later(400).then(check.idle))")
        check.expect(f"{what}: the picture", check.page.call("digest"), picture)
    check.expect("the scene in the list", check.value("scenes"), "article")
    check.expect("the position", check.shown("blue.position"), "2")


# Where pixels of this colour are: left, top, width and height in the page.
BOX = """(colour => {
  const picture = document.getElementById("picture");
  const {width, height} = picture;
  const data = picture.getContext("2d").getImageData(0, 0, width, height).data;
  const xs = [], ys = [];
  for (let i = 0; i < width * height; ++i) {
    if ([0, 1, 2].some(j => data[4 * i + j] !== colour[j])) continue;
    xs.push(i % width);
    ys.push(Math.floor(i / width));
  }
  const of = list => [list.reduce((a, b) => Math.min(a, b)), list.reduce((a, b) => Math.max(a, b)) + 1];
  const [left, right] = of(xs), [top, bottom] = of(ys);
  const box = picture.getBoundingClientRect();
  const unit = box.width / width;
  return [box.left + left * unit, box.top + top * unit, (right - left) * unit, (bottom - top) * unit];
})"""


def a_block_is_dragged(check):
    """By its own width, which is 1; from later on, too, where it is set to where it is dropped."""
    for instant, position, expected in [("0", 2, 3), ("1", 2, 1.5)]:
        check.page.choose("article")
        check.page.go(instant)
        left, top, width, height = check.page.value(f"{BOX}([0, 0, 255])")
        start = (left + width / 2, top + height / 2)
        _drag(check, start, (start[0] + (expected - position) * width, start[1]))
        check.expect("messages", check.page.call("problems"), [])
        check.expect(f"the position after {instant}", abs(float(check.shown("blue.position")) - expected) < 0.03)
        check.expect("the time", check.time(), 0)


def _drag(check, start, end):
    for kind, (x, y), buttons in [("mousePressed", start, 1), ("mouseMoved", end, 1), ("mouseReleased", end, 0)]:
        check.browser.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=buttons, clickCount=1)
    check.page.value("check.later(100).then(check.idle)")


def what_is_refused_leaves_what_was_accepted(check):
    """The value before, not that of the text; the message stands beside what was typed."""
    check.page.choose("article")
    check.page.edit("red.position", "3.5")
    before = check.page.call("digest")
    check.page.edit("red.position", "3.5x")
    check.expect("the picture", check.page.call("digest"), before)
    check.page.edit("red.position", "3.5")
    check.page.edit("blue.position", "3")
    check.expect("the picture of an overlap", check.page.call("digest"), before)
    check.expect("a message beside blue, not red", (check.said("blue.position") != "", check.said("red.position")),
                 (True, ""))


def one_restitution_leaves_the_other(check):
    check.page.choose("article")
    check.page.call("moveSlider", "restitution", 0.5)
    check.page.edit("blocks.restitution", "0.7")
    check.expect("both", (check.shown("blocks.restitution"), check.shown("wall.restitution")), ("0.7", "0.5"))


def a_drag_is_one_step(check):
    check.page.choose("article")
    for value in [2.1, 2.2, 2.3, 2.4, 2.5]:
        check.page.call("moveSlider", "blue.position", value)
    check.browser.call("Input.dispatchKeyEvent", type="keyDown", key="z", code="KeyZ", windowsVirtualKeyCode=90,
                       modifiers=2)
    check.page.value("check.later(400).then(check.idle)")
    check.expect("the position after Undo", check.shown("blue.position"), "2")


def a_lecture_fills_the_screen(check):
    check.page.choose("lecture")
    check.page.value("(document.querySelector('#first input').focus(), true)")
    digits = check.shown("digits")
    _key(check, "b", 66)
    _key(check, "f", 70)
    check.page.value("check.later(300).then(check.idle)")
    size = check.page.value("[document.getElementById('picture').width, document.getElementById('picture').height]")
    check.expect("the shape of the screen", abs(size[0] / size[1] - check.page.value("innerWidth / innerHeight")) < 0.01)
    check.expect("not black", check.page.value("document.getElementById('screen').classList.contains('blank')"), False)
    for count in [1, 2]:
        _key(check, "PageDown", 34)
        check.expect("a collision", check.count(), count)
    check.expect("digits", check.shown("digits"), digits)
    _key(check, "b", 66)
    check.expect("black", check.page.value("document.getElementById('screen').classList.contains('blank')"))
    check.page.value("check.later(2400)")
    check.expect("the bar has faded", check.page.value("document.body.classList.contains('idle')"))
    _key(check, "Escape", 27)
    check.page.value("check.later(300).then(check.idle)")
    check.expect("as before", check.page.value("document.body.className"), "")


def _key(check, key, code):
    check.browser.press(key, code)
    check.page.value("check.later(100).then(check.idle)")


def what_is_copied_is_what_is_shown(check):
    """Also while the film plays. A page from a file copies the scene."""
    check.page.choose("article")
    check.page.run("""window.copied = [];
        Object.defineProperty(navigator, "clipboard", {value: {writeText: async words => { copied.push(words); }}});""")
    check.page.edit("blue.position", "2.5")
    check.page.press("play")
    check.page.press("share")
    check.expect("it says so", check.is_seen("shared"))
    check.page.press("copy-embed")
    check.page.press("play")
    scene, frame = check.page.value("copied")
    check.expect("the scene", scene, check.page.value("document.getElementById('text').value"))
    check.expect("is that of the edit", scene != check.scene("article"))
    check.expect("the frame", frame.startswith("<iframe src=") and "embed=1" in frame and "#toml=" in frame)


def plays_by_itself_once(check):
    check.browser.prefer(prefers_reduced_motion="no-preference")
    for address, plays in [("", True), ("?autoplay=0", False), ("#lecture@3", False), ("?embed=1", True)]:
        check.browser.show_address("about:blank")
        check.browser.show_address(check.path.as_uri() + address)
        for _ in range(100):
            if check.page.value("document.body.dataset.isPlaying === 'true'"):
                break
            check.page.value("new Promise(done => setTimeout(done, 30))")
        found = check.page.value("document.body.dataset.isPlaying === 'true'")
        check.expect(f"plays at {address}", found, plays)
    check.browser.prefer(prefers_reduced_motion="reduce")


def a_poster_is_seen_until_the_program_draws(check):
    stub = check.browser.call("Page.addScriptToEvaluateOnNewDocument",
                              source="Worker = class { postMessage() {} };")
    for address, width, height, size in [("", 1280, 900, "1280x720"), ("", 390, 844, "720x900"),
                                         ("?embed=1", 1280, 900, None), ("#article", 1280, 900, None)]:
        check.browser.resize(width, height)
        check.browser.show_address("about:blank")
        check.browser.show_address(check.path.as_uri() + address)
        check.expect(f"the poster at {address} {width}x{height}", check.page.value(POSTER_SIZE), size)
    check.browser.call("Page.removeScriptToEvaluateOnNewDocument", **stub)
    check.browser.resize(1280, 900)
    posters = re.findall(r"url\(data:image/png;base64,([^)]*)\)", check.path.read_text())
    check.page.load(check.path)
    check.expect("the poster over a picture", check.page.value(POSTER_SIZE), None)
    for size, poster in zip(["1280x720", "720x900"], posters, strict=True):
        check.page.edit("view.size", size)
        check.expect(f"pixels of the poster {size} that differ", check.page.differences(base64.b64decode(poster)), 0)


def a_telephone_has_an_upright_picture(check):
    check.browser.resize(390, 844)
    check.page.load(check.path)
    width, height = check.page.value("[document.getElementById('picture').width, document.getElementById('picture').height]")
    check.expect("upright", height > width)
    below = check.page.value("document.getElementById('play').getBoundingClientRect().bottom")
    check.expect("Play is in sight", below < 844)
    check.browser.resize(844, 390)
    check.page.load(check.path)
    below = check.page.value("document.getElementById('play').getBoundingClientRect().bottom")
    check.expect("Play is in sight when it lies", below <= 390)
