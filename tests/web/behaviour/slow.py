"""Work that takes long.

In: a Check. Out: its faults.
"""

import json
import time

# 200 discs meet 1.8 million times until then, which takes seconds.
SLOW_KEY, SLOW = "time.to", "13000"
# What all other edits take less than.
NORMAL_s = 3


def _begin(check):
    """Waits until the page says that it takes long."""
    check.page.choose("gas")
    check.page.edit("view.size", "640x360")
    check.page.go("2")
    before = check.page.call("digest")
    check.page.value(f"""(async () => {{
        check.set(check.field("{SLOW_KEY}"), "{SLOW}");
        const busy = document.getElementById("busy");
        await check.until("it takes long", () => !busy.hidden, 5000); }})()""")
    return before


def _expect_usable(check, what):
    start = time.monotonic()
    check.expect(f"{what}: messages of an edit", check.page.edit("show.title", what), [])
    check.expect(f"{what}: seconds", time.monotonic() - start < NORMAL_s)
    check.expect(f"{what}: the title", check.shown("show.title"), what)
    check.page.press("next-frame")
    check.expect(f"{what}: messages of the next frame", check.page.call("problems"), [])


def stopping_brings_back_the_scene(check):
    before = _begin(check)
    check.page.press("stop")
    check.page.value("check.later(500).then(check.idle)")
    check.expect("the page works no more", check.is_seen("busy"), False)
    check.expect("messages", check.page.call("problems"), [])
    check.expect("the field", check.shown(SLOW_KEY), "12")
    check.expect("the picture", check.page.call("digest"), before)
    picture, _ = check.page.save("png")
    check.expect("pixels of the PNG that differ", check.page.differences(picture), 0)
    check.expect("the place", check.time(), 2)
    _expect_usable(check, "After Stop")
    check.open_fields()
    check.page.value("check.until('choices', () => document.body.dataset.hasChoices === 'true').then(() => true)")


def picture_is_saved_at_once_after_stopping(check):
    _begin(check)
    check.page.value("document.getElementById('stop').click()")
    picture, _ = check.page.save("png")
    check.page.value("check.idle()")
    check.expect("pixels of the PNG that differ", check.page.differences(picture), 0)


def another_edit_instead(check):
    """The slow one is left, and the page says so."""
    _begin(check)
    check.page.value("check.later(1500)")
    start = time.monotonic()
    check.page.edit("show.title", "Something else")
    check.expect("seconds", time.monotonic() - start < NORMAL_s)
    check.expect("the title", check.shown("show.title"), "Something else")
    check.expect("the message beside the slow value", "too long" in check.said(SLOW_KEY))
    picture, _ = check.page.save("png")
    check.expect("pixels of the PNG that differ", check.page.differences(picture), 0)
    check.page.choose("gas")
    check.expect_fields_of("gas")


def another_scene_instead(check):
    _begin(check)
    check.page.value("check.later(1500)")
    start = time.monotonic()
    check.page.choose("article")
    check.expect("seconds", time.monotonic() - start < NORMAL_s)
    check.expect_fields_of("article")


def stopping_a_text(check):
    """The text of the scene before is there again."""
    check.page.choose("gas")
    check.page.edit("view.size", "640x360")
    before = check.value("text")
    slow = before.replace("time.to = 12", f"time.to = {SLOW}")
    check.expect("another text", slow != before)
    check.page.value("window.check.slow = " + json.dumps(slow))
    check.page.value("""(async () => {
        check.set(document.getElementById("text"), check.slow);
        const busy = document.getElementById("busy");
        await check.until("it takes long", () => !busy.hidden, 5000); })()""")
    check.page.press("stop")
    check.page.value("check.later(500).then(check.idle)")
    check.expect("the text", check.value("text"), before)
    check.expect("messages", check.page.call("problems"), [])
    _expect_usable(check, "After Stop")


def another_scene_instead_of_slow_bodies(check):
    """Nothing of the bodies is said of the other scene."""
    discs = "".join(f'[[body]]\nposition = [{2 * i + 1}, {2 * j + 1}]\nradius = "1/2"\n'
                    f"velocity = [{(3 * i + j) % 5 - 2}, {(i + 2 * j) % 3 + 1}]\n"
                    for i in range(5) for j in range(4))
    check.page.open("time.to = 50000\ntime.allow-uncertain = true\nbox.x = [0, 10]\nbox.y = [0, 8]\n" + discs)
    check.page.value("""(async () => {
        check.set(document.querySelector(".bodies input"), "2");
        await check.until("it takes long", () => !document.getElementById("busy").hidden, 5000);
        await check.later(1500); })()""")
    check.page.choose("article")
    check.expect_fields_of("article")


def refused_value_beside_a_slow_one(check):
    """Both are told."""
    check.page.choose("gas")
    check.page.edit("view.fps", "x")
    refused = check.said("view.fps")
    check.page.value(f"""(async () => {{
        check.set(check.field("{SLOW_KEY}"), "{SLOW}");
        await check.until("it takes long", () => !document.getElementById("busy").hidden, 5000);
        await check.later(1500); }})()""")
    check.page.press("next-frame")
    check.expect("a refused value", refused != "")
    check.expect("what is said of it", check.said("view.fps") != "")
    check.expect("what is said of the slow one", check.said(SLOW_KEY) != "")
    check.page.edit("view.fps", "30")
    check.expect("what is said of a right one", check.said("view.fps"), "")
    check.page.edit(SLOW_KEY, "11")
    check.expect("messages", check.page.call("problems"), [])
