"""Edits of single keys.

In: a Check. Out: its faults.
"""

import base64


def edit_that_cannot_be_drawn(check):
    """It is refused, and the scene before can be used on."""
    check.page.choose("lecture")
    check.page.edit("time.freeze", "#400000:1")
    check.expect("a message beside the field", check.said("time.freeze") != "")
    check.page.press("next-frame")
    check.expect("the next frame", (check.frame(), check.said("instant-problem")), (1, ""))
    check.page.go("1.5")
    check.expect("at 1.5", (check.time(), check.said("instant-problem")), (1.5, ""))
    check.expect("the message stays", check.said("time.freeze") != "")
    picture, _ = check.page.save("png")
    check.expect("pixels of the PNG that differ", check.page.differences(picture), 0)


def refused_values_leave_with_their_scene(check):
    check.page.choose("lecture")
    for key, value in [("blue.mass", "-1"), ("time.to", "auto"), ("view.x", "\\"), ("base", "99")]:
        check.page.edit(key, value)
        check.expect(f"a message beside {key}", check.said(key) != "")
    check.page.choose("article")
    check.expect_fields_of("article")


def other_key_of_the_same_value(check):
    """The ratio of masses takes the place of digits that were refused."""
    check.page.choose("article")
    check.page.edit("digits", "0")
    check.expect("a message beside the digits", check.said("digits") != "")
    check.page.edit("mass-ratio", "16")
    check.expect("messages", check.page.call("problems"), [])
    check.expect("the ratio", check.shown("mass-ratio"), "16")
    check.expect("digits that the ratio does not count", check.shown("digits"), "")


def base_keeps_digits(check):
    check.page.open("digits = 5\n")
    for base in [16, 8]:
        check.page.call("moveSlider", "base", base)
        check.expect(f"base {base}: messages", check.page.call("problems"), [])
        check.expect(f"base {base}: base and digits", (check.shown("base"), check.shown("digits")),
                     (str(base), "5"))


def theme_and_back(check):
    """Nothing of another theme stays."""
    check.page.choose("article")
    for instant in ["1.5", "#157"]:
        check.page.go(instant)
        before, fields = check.page.call("digest"), check.page.call("shown")
        check.page.edit("view.theme", "lecture")
        check.expect(f"{instant}: another picture", check.page.call("digest") != before)
        check.page.edit("view.theme", "article")
        check.expect(f"{instant}: the picture", check.page.call("digest"), before)
        check.expect(f"{instant}: the fields", check.page.call("shown"), fields)


def title_that_looks_like_a_number(check):
    for key in ["show.title", "show.caption"]:
        check.page.choose("article")
        check.open_fields()
        field = f"check.field('{key}')"
        check.browser.type(field, "1/2")
        check.page.value("check.idle()")
        check.page.value(f"check.after(() => {field}.blur())")
        check.expect(f"{key} after it is left", check.shown(key), "1/2")
        check.expect(f"{key} in the text", '"1/2"' in check.value("text"))


def escape_gives_up(check):
    check.page.choose("article")
    check.open_fields()
    for key in ["blue.mass", "time.to", "view.x"]:
        before = check.shown(key)
        check.browser.type(f"check.field('{key}')", "x")
        check.page.value("check.idle()")
        check.expect(f"a message beside {key}", check.said(key) != "")
        check.browser.press("Escape", 27)
        check.page.value("check.idle()")
        check.expect(f"{key} after Escape", (check.shown(key), check.page.call("problems")), (before, []))


def png_is_what_is_shown_while_a_value_is_refused(check):
    check.page.choose("article")
    check.page.go("2")
    before, _ = check.page.save("png")
    check.page.edit("blue.mass", "-1")
    after = base64.b64decode(check.page.call("save", "png")["base64"])
    check.expect("the same file", after == before)


def emptied_title_keeps_the_text(check):
    """To clear a field changes no more than that field."""
    check.page.open('digits = 5\nshow.title = "A title"\n')
    check.page.edit("show.title", "")
    check.page.edit("base", "16")
    check.expect("digits", check.shown("digits"), "5")
    check.expect("messages", check.page.call("problems"), [])
