"""The table of bodies.

In: a Check. Out: its faults.
"""

# Those that can be seen.
ROWS = "[...document.querySelectorAll('.bodies tr')].filter(one => one.checkVisibility())"
ADD = "document.querySelector('#add-body')"
REMOVERS = "[...document.querySelectorAll('.bodies td button')].filter(one => !one.disabled)"


def _bodies(check):
    """Rows without the head."""
    return check.page.value(f"{ROWS}.filter(row => row.querySelector('input')).length")


def refused_cell_leaves_with_its_scene(check):
    check.page.choose("three-blocks")
    check.page.call("editCell", 0, "mass", "-1")
    check.expect("a message", check.said("bodies-problem") != "")
    check.page.choose("cradle")
    check.expect("bodies", _bodies(check), 6)
    check.expect_fields_of("cradle")


def many_bodies_have_no_table(check):
    for before in ["lecture", "three-blocks"]:
        check.page.choose(before)
        check.page.choose("gas")
        check.expect(f"rows after {before}", check.page.value(f"{ROWS}.length"), 0)
        is_seen = check.page.value(f"{ADD}.checkVisibility()")
        check.expect(f"a button to add one after {before}", is_seen, False)
    check.page.choose("three-blocks")
    check.expect("rows again", _bodies(check), 3)


def removing_all_but_one_and_adding(check):
    check.page.choose("three-blocks")
    for _ in range(5):
        check.page.value(f"check.after(() => {REMOVERS}[0]?.click())")
    check.expect("bodies that are left", _bodies(check), 1)
    check.expect("messages", check.page.call("problems"), [])
    # The one that is left is behind the others: there may be no room in the box.
    check.page.choose("cradle")
    for count in [7, 8]:
        check.page.value("check.until('the room is known', () => document.body.dataset.hasChoices === 'true')")
        check.page.value(f"check.after(() => {ADD}.click())")
        check.expect("bodies", _bodies(check), count)
    check.expect("messages of the cradle", check.page.call("problems"), [])
    text = check.value("text")
    check.expect("bodies in the text", text.count("mass ="), 8)


def leaving_a_cell_after_another_scene(check):
    check.page.choose("three-blocks")
    check.page.value("check.cell(0, 'mass').focus()")
    check.page.choose("article")
    check.page.value("check.later(400)")
    check.page.choose("three-blocks")
    check.page.value("check.cell(0, 'mass').focus()")
    check.page.choose("storyboard")
    check.page.value("(document.activeElement.blur(), check.later(400))")  # the page waits 300 ms
    check.expect_fields_of("storyboard")


def cell_shows_the_number_of_the_scene(check):
    check.page.choose("three-blocks")
    check.page.value("""(async () => {
        check.set(document.querySelector(".bodies input"), "10^2");
        await check.idle(); })()""")
    check.expect("the cell", check.page.value("document.querySelector('.bodies input').value"), "100")
    check.expect("messages", check.page.call("problems"), [])
