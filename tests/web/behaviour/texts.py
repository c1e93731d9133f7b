"""The text of the scene, and links.

In: a Check. Out: its faults.
"""

import base64
import zlib

REFUSED = "# What is wrong is below.\nblue.mass = -1\n"
TEXT = "document.getElementById('text')"


def _address(text):
    packer = zlib.compressobj(wbits=-15)
    packed = packer.compress(text.encode()) + packer.flush()
    return "#toml=" + base64.urlsafe_b64encode(packed).decode().rstrip("=")


def _leave_all_fields(check):
    check.page.value("""(async () => {
        for (const input of document.querySelectorAll("input, select, textarea")) {
          input.focus();
          await check.later(1);
          input.blur();
        }
        await check.later(20);
        await check.idle(); })()""")


def _load_refused(check):
    check.page.load(check.path, _address(REFUSED))
    check.page.value("check.later(100).then(check.idle)")


def link_with_a_text_that_is_refused(check):
    _load_refused(check)
    check.expect("the text", check.value("text"), REFUSED)
    check.expect("its message", "mass" in check.said("text-problem"))
    check.expect("something is shown", check.page.state_rows() != {})
    check.page.choose("article")
    check.expect("the scene's text", check.value("text"), check.scene("article"))
    check.expect_fields_of("article")


def page_is_usable_after_a_refused_link(check):
    _load_refused(check)
    _leave_all_fields(check)
    check.expect("exceptions of fields", check.page.take_failures(), [])
    check.expect("the text stays", check.value("text"), REFUSED)
    check.page.press("share")
    check.page.press("next-frame")
    check.page.press("show-text")
    check.expect("messages after the text was given up", check.page.call("problems"), [])
    check.expect("a scene again", check.value("text") not in ("", REFUSED))
    check.page.edit("blue.position", "2.5")
    check.expect("messages after an edit", check.page.call("problems"), [])
    _leave_all_fields(check)


def scene_that_is_chosen_while_a_text_waits(check):
    check.page.choose("lecture")
    check.page.value(f"check.set({TEXT}, 'digits = 7')")
    check.page.choose("article")
    check.page.value("check.later(500).then(check.idle)")
    check.expect("the scene in the list", check.value("scenes"), "article")
    check.expect("the text", check.value("text"), check.scene("article"))
    check.expect_fields_of("article")


def scene_that_is_chosen_while_the_text_has_the_focus(check):
    check.page.choose("lecture")
    check.open_fields()
    check.browser.type(TEXT, "digits = 3\nbase")
    check.page.value("check.later(300).then(check.idle)")
    check.expect("a message", check.said("text-problem") != "")
    check.page.choose("article")
    check.expect("the text", check.value("text"), check.scene("article"))


def back_from_a_refused_text(check):
    """With its comments."""
    check.page.choose("article")
    text = check.value("text")
    check.expect("the text of a scene", text, check.scene("article"))
    for wrong in ["x = \n", "blue.mass = -1\n", text + "digits = 0\n"]:
        check.expect(f"{wrong[-12:]}: refused", check.page.open(wrong) != [])
        check.expect(f"{wrong[-12:]}: stays", check.value("text"), wrong)
        check.page.press("show-text")
        check.expect(f"{wrong[-12:]}: the text before", check.value("text"), text)
        check.expect(f"{wrong[-12:]}: messages", check.page.call("problems"), [])
    # Before the page has looked at it.
    check.page.value(f"check.set({TEXT}, 'digits = 7')")
    check.page.press("show-text")
    check.page.value("check.later(300).then(check.idle)")
    check.expect("the text before", check.value("text"), text)
    check.expect("digits", check.shown("digits"), "3")


def text_that_is_too_long(check):
    check.page.choose("article")
    before = check.page.call("digest")
    check.page.open("# " + "x" * (1 << 20) + "\n")
    check.expect("the message", "longer than" in check.said("text-problem"))
    check.expect("the picture", check.page.call("digest"), before)
    check.page.open("# " + "x" * ((1 << 20) - 100) + "\ndigits = 4\n")
    check.expect("a shorter one", (check.said("text-problem"), check.shown("digits")), ("", "4"))


def link_of_what_is_shown(check):
    """Another page shows the same."""
    check.page.choose("lecture")
    check.page.edit("blue.position", "2.5")
    check.page.edit("show.title", "1/2")
    before, fields = check.page.call("digest"), check.page.call("shown")
    check.page.value("check.later(800)")
    address = check.page.value("location.hash")
    check.page.load(check.path, "#circle")
    check.page.load(check.path, address)
    check.expect("the picture", check.page.call("digest"), before)
    check.expect("the fields", check.page.call("shown"), fields)


def address_that_changes(check):
    """As by a link to the same page, or by hand."""
    check.page.value("(location.hash = '#circle', check.later(100).then(check.idle))")
    check.expect("the scene in the list", check.value("scenes"), "circle")
    before = check.page.call("digest")
    check.page.value("(location.hash = '#nothing', check.later(100).then(check.idle))")
    check.expect("a message", check.said("problem").startswith("Link: "))
    check.expect("the picture", check.page.call("digest"), before)
    check.page.choose("article")
    check.expect("messages", check.page.call("problems"), [])
