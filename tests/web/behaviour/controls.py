"""Controls that are never refused, in every scene of the program.

In: a Check. Out: its faults.
"""

# Buttons of the page that make files or leave it.
NO_BUTTONS = ["share", "copy-embed", "copy-text", "full-screen", "play", "play-first", "sound", "stop", "cancel",
              "bring-back", "undo"]

SCRIPT = """
const inputs = kind => [...document.querySelectorAll(`#settings input[type=${kind}]`)]
  .filter(one => check.isThere(one) && !one.disabled);
const nameOf = input => `${input.closest("[data-key]").dataset.key} ${input.value}`;

/** What is refused when controls of this kind are used; each begins with the scene as it is. */
check.refusals = async (scene, kind, values) => {
  const faults = [];
  await check.choose(scene);
  for (let i = 0; i < inputs(kind).length; ++i) {
    for (const value of values) {
      const input = inputs(kind)[i];
      if (!input) break;
      const before = nameOf(input);
      if (kind === "checkbox") await check.until("choices", () => document.body.dataset.hasChoices === "true");
      if (input.disabled) continue;
      const problems = await check.after(() => check.set(input, value(input)));
      if (problems.length > 0) faults.push(`${scene}: ${before}: ${problems.join("; ")}`);
      // Nor is it taken back.
      const note = input.closest("[data-key]").querySelector(".hint");
      if (kind === "range" && !note.hidden) faults.push(`${scene}: ${before}: ${note.textContent}`);
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
      const problems = await check.after(() => check.set(select, option.value));
      if (problems.length > 0) faults.push(`${scene}: ${option.value}: ${problems.join("; ")}`);
    }
  }
  return faults;
};
check.presses = async (scene, not) => {
  const faults = [];
  await check.choose(scene);
  for (const button of document.querySelectorAll("button[id]")) {
    if (not.includes(button.id) || button.disabled || !check.isThere(button) || button.dataset.save) continue;
    const problems = await check.press(button.id);
    if (problems.length > 0) faults.push(`${scene}: ${button.id}: ${problems.join("; ")}`);
  }
  return faults;
};
"""


def _expect_no_refusal(check, call):
    check.page.run(SCRIPT)
    for scene in check.scene_names():
        check.page.run(f"window.now = {scene!r};")
        for fault in check.page.value(call):
            check.expect(fault, False)


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
    check.page.edit("blue.position", "2.5")
    edited = check.page.call("digest")
    check.page.value("check.later(400)")
    check.page.choose("lecture")
    check.page.value("check.later(400)")
    for what, expected in [("the edit", ("article", edited)), ("the scene", ("article", None))]:
        check.page.value("(history.back(), check.later(400).then(check.idle))")
        if expected[1]:
            check.expect(f"{what}: the picture", check.page.call("digest"), expected[1])
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
