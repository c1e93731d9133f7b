"""Going through the film by buttons, keys and the mouse.

In: a Check. Out: its faults.
"""

import io
import wave

# Two pairs meet at the same time, and then the inner ones.
PAIRS = """view.size = "640x360"
[[body]]
position = -4
velocity = 1
width = 1
[[body]]
mass = 3
position = -1.5
width = 1
[[body]]
mass = 3
position = 1.5
width = 1
[[body]]
position = 4
velocity = -1
width = 1
"""
MOST_STEPS = 400
SPACE = (" ", 32, " ")


def instant_that_is_refused(check):
    """The picture stays, and so does the place when the scene is edited then."""
    check.page.choose("article")
    check.page.go("1.5")
    before = check.page.call("digest")
    check.page.go("#400")
    check.expect("a message", check.said("instant-problem") != "")
    check.expect("the place", check.time(), 1.5)
    check.expect("the picture", check.page.call("digest"), before)
    check.page.call("moveSlider", "blue.position", 2.5)
    check.expect("no message after an edit", check.said("instant-problem"), "")
    check.expect("the place after an edit", check.time(), 1.5)
    after = check.page.call("digest")
    check.expect("another picture", after != before)
    check.page.go("1.5")
    check.expect("the picture of the place", after, check.page.call("digest"))


def _walk(check, button):
    """Counts that are shown until nothing changes any more, or at the first frame."""
    counts = [check.count()]
    for _ in range(MOST_STEPS):
        check.expect(f"{button} after {counts[-1]}: problems", check.page.press(button), [])
        if check.count() == counts[-1]:
            return counts
        counts.append(check.count())
    check.expect(f"{button} comes to an end", False)
    return counts


def _expect_walk(check, what, count):
    check.expect(f"{what}: problems", check.page.go("last"), [])
    check.expect(f"{what}: the last", check.count(), count)
    check.page.press("start")
    up = _walk(check, "next-collision")
    check.expect(f"{what}: ups", all(one < other for one, other in zip(up, up[1:])))
    check.expect(f"{what}: from and to", (up[0], up[-1]), (0, count))
    down = _walk(check, "previous-collision")
    check.expect(f"{what}: downs", all(one > other for one, other in zip(down, down[1:])))
    check.expect(f"{what}: back from and to", (down[0], down[-1]), (count, 0))
    check.expect(f"{what}: the same counts", down[::-1], up)
    check.expect(f"{what}: the frame", check.frame(), 0)


def all_collisions_one_by_one(check):
    check.page.open(PAIRS)
    _expect_walk(check, "pairs", 3)
    check.page.open('digits = 2\nview.size = "640x360"\n')
    _expect_walk(check, "two digits", 31)


def the_collision_before(check):
    check.page.choose("article")
    check.page.go("#157")
    check.expect("problems", check.page.press("previous-collision"), [])
    check.expect("one before", check.count(), 156)
    check.page.press("next-collision")
    check.expect("and again", check.count(), 157)
    check.page.press("next-frame")
    check.page.go("turn")
    turn = check.count()
    check.page.press("next-collision")
    check.expect("after the turn", check.count(), turn + 1)


def _press(check, *key):
    check.browser.press(*key)
    check.page.value("check.idle()")


def keys_work_after_a_click_on_a_button(check):
    check.page.choose("article")
    check.browser.click("document.getElementById('play')")
    check.browser.click("document.getElementById('play')")
    check.page.press("start")
    _press(check, "ArrowRight", 39)
    check.expect("a frame", check.frame(), 1)
    check.open_fields()
    check.browser.click("document.getElementById('next-frame')")
    check.page.value("check.idle()")
    check.expect("another frame", check.frame(), 2)
    _press(check, ".", 190)
    check.expect("a collision", check.count(), 1)
    _press(check, "t", 84)
    turn = check.count()
    check.page.go("turn")
    check.expect("the turn", turn, check.count())


def space_plays_wherever_the_focus_is(check):
    check.page.choose("article")
    check.open_fields()
    for name in ["next-frame", "previous-collision", "time-slider", "play", "add-body", "more"]:
        check.page.value(f"(document.getElementById('{name}').focus(), true)")
        _press(check, *SPACE)
        check.expect(f"{name}: plays", check.page.text("play"), "Pause")
        _press(check, *SPACE)
        check.expect(f"{name}: plays no more", check.page.text("play"), "Play")


def space_plays(check):
    check.page.choose("article")
    check.page.value("document.activeElement.blur()")
    _press(check, *SPACE)
    check.expect("plays", check.page.text("play"), "Pause")
    _press(check, *SPACE)
    check.expect("plays no more", check.page.text("play"), "Play")


def keys_in_a_field_are_its_own(check):
    check.page.choose("article")
    check.open_fields()
    check.browser.click("check.field('show.title')")
    _press(check, "t", 84, "t")
    _press(check, *SPACE)
    _press(check, ".", 190, ".")
    check.expect("the title", check.shown("show.title"), "t .")
    check.expect("the place", (check.frame(), check.page.text("play")), (0, "Play"))


def _click_picture(check, button, buttons):
    left, top, width, height = check.browser.rect("document.getElementById('picture')")
    for kind in ("mousePressed", "mouseReleased"):
        check.browser.call("Input.dispatchMouseEvent", type=kind, x=left + width / 2, y=top + height / 2,
                           button=button, buttons=buttons if kind == "mousePressed" else 0, clickCount=1)
    check.page.value("check.later(50)")


def only_the_main_button_plays(check):
    check.page.choose("article")
    for button, buttons in [("right", 2), ("middle", 4)]:
        _click_picture(check, button, buttons)
        check.expect(f"after the {button} button", check.page.text("play"), "Play")
    _click_picture(check, "left", 1)
    check.expect("after the left button", check.page.text("play"), "Pause")


def _played_frames(check):
    """Between now and a little later."""
    before = check.frame()
    check.page.value("check.later(700)")
    return check.frame() - before


def film_goes_on_while_it_is_edited(check):
    check.page.choose("article")
    check.browser.click("document.getElementById('play')")
    check.expect("plays", _played_frames(check) > 5)
    check.page.value("""(async () => {
        const knob = document.querySelector("[data-key='blue.position'] input[type=range]");
        for (let i = 0; i < 20; ++i) {
          check.set(knob, 2 + i / 20);
          await check.later(10);
        } })()""")
    check.expect("plays on", (check.page.text("play"), _played_frames(check) > 5), ("Pause", True))
    check.page.edit("blue.mass", "-1")
    check.expect("plays while a value is refused", (check.page.text("play"), _played_frames(check) > 5),
                 ("Pause", True))
    check.page.choose("circle")
    check.expect("another scene begins still", (check.page.text("play"), check.frame()), ("Play", 0))


# Keeps the left and right samples that are played, in turn, and when each piece of them begins.
LISTEN = """window.heard = [];
window.starts = [];
const start = AudioBufferSourceNode.prototype.start;
AudioBufferSourceNode.prototype.start = function(...details) {
  const [left, right] = [0, 1].map(side => this.buffer.getChannelData(side));
  left.forEach((sample, i) => heard.push(sample, right[i]));
  starts.push(details[0]);
  start.apply(this, details);
};"""
PIECE = 24000


def _samples_of_wav(data):
    with wave.open(io.BytesIO(data)) as file:
        bits = 8 * file.getsampwidth()
        words = file.readframes(file.getnframes())
    step = bits // 8
    return [int.from_bytes(words[i:i + step], "little", signed=True) / 2 ** (bits - 1)
            for i in range(0, len(words), step)]


def samples_that_are_played_are_those_of_the_wav(check):
    check.page.choose("article")
    check.page.run(LISTEN)
    check.page.go("turn")
    frame = int(check.value("time-slider"))
    # Browsers begin sound only after a real click.
    check.browser.click("document.getElementById('sound')")
    check.browser.click("document.getElementById('play')")
    check.page.value("check.until('sound', () => starts.length > 1)")
    check.page.press("play")
    first, second = check.page.value("starts.slice(0, 2)")
    # A machine that is late may leave a gap.
    check.expect(f"one piece after the other: {second - first} s", second - first > PIECE / 48000 - 1e-6)
    wav, _ = check.page.save("wav")
    samples = _samples_of_wav(wav)[2 * frame * 48000 // 60:]
    for begin, end in [(0, 4000), (2 * PIECE - 10000, 2 * PIECE + 10000)]:
        heard = check.page.value(f"heard.slice({begin}, {end})")
        check.expect(f"from {begin}: samples", len(heard), end - begin)
        check.expect(f"from {begin}: loud enough", max(map(abs, heard)) > 0.01)
        different = max(abs(one - other) for one, other in zip(heard, samples[begin:end]))
        check.expect(f"from {begin}: samples that differ, by {different}", different < 2 / 2 ** 23)
    check.expect("messages", check.said("sound-problem"), "")


def _expect_sound(check, what):
    """From now on more of it begins."""
    check.page.value("(async () => { const before = starts.length;"
                     f"await check.until('{what}', () => starts.length > before, 5000); }})()")
    is_on = check.page.value("document.getElementById('sound').getAttribute('aria-pressed')")
    check.expect(f"{what}: sound is on", (is_on, check.said("sound-problem")), ("true", ""))


def film_plays_with_sound(check):
    """As far as a browser without loudspeakers tells."""
    check.page.choose("lecture")
    check.page.run(LISTEN)
    check.browser.click("document.getElementById('sound')")
    check.browser.click("document.getElementById('play')")
    check.page.value("check.later(500)")
    check.expect("plays", _played_frames(check) > 5)
    _expect_sound(check, "sound at first")
    check.page.call("moveSlider", "red.velocity", -2)
    check.page.value("check.later(500)")
    check.expect("plays on", (check.page.text("play"), _played_frames(check) > 5), ("Pause", True))
    _expect_sound(check, "sound after an edit")
    check.browser.click("document.getElementById('sound')")
    check.expect("plays on without", (check.page.text("play"), _played_frames(check) > 5), ("Pause", True))
    check.browser.click("document.getElementById('play')")
    check.page.value("check.idle()")
    check.expect("stands still", _played_frames(check), 0)


def film_that_vanishes_while_it_plays(check):
    check.page.choose("article")
    check.page.press("play")
    check.page.edit("time.from", "100")
    check.expect("the button", check.page.text("play"), "Play")
    check.page.edit("time.from", "0")
    check.expect("the button of the film that is back", check.page.text("play"), "Play")
    check.expect("messages", check.page.call("problems"), [])
