"""Saving files.

In: a Check. Out: its faults.
"""

import base64

# Takes some seconds.
LONG = 'view.theme = "lecture"\ntime.to = 240\nshow.panels = ["time"]\nsound.on = true\n'
SHORT = 'digits = 2\nview.size = "640x360"\n'
SEEN = "!document.getElementById('saving').hidden"
SHARE = "document.getElementById('saving-progress').value"


def _start_film(check):
    check.page.value(f"""(async () => {{
        check.saver("mp4").click();
        await check.until("the film is begun", () => {SEEN} && {SHARE} > 0); }})()""")


def _files(check):
    return check.page.value("check.files.map(file => file.type)")


def _bytes(check, number):
    return base64.b64decode(check.page.value(f"check.base64(check.files[{number}])"))


def film_tells_its_progress(check):
    check.page.open(LONG)
    shares = check.page.value(f"""(async () => {{
        const shares = [];
        check.saver("mp4").click();
        await check.until("the film", () => {{
          if ({SEEN} && shares.at(-1) !== {SHARE}) shares.push({SHARE});
          return check.files.length > 0;
        }});
        return shares; }})()""")
    check.expect("shares between none and all", len([one for one in shares if 0 < one < 1]) > 3)
    check.expect("more and more", shares, sorted(shares))
    check.page.value(f"check.until('it is over', () => !({SEEN}))")
    check.expect("a note", "mp4" in check.page.text("saved"))
    check.expect("one file", _files(check), ["video/mp4"])


def film_that_is_cancelled(check):
    check.page.open(LONG)
    for _ in range(2):
        _start_film(check)
        check.page.press("cancel")
        check.page.value("check.later(300)")
        check.expect("it is over", check.page.value(SEEN), False)
        check.expect("messages", (check.said("saving-problem"), check.page.call("problems")), ("", []))
        check.expect("a note of a file", check.is_seen("saved"), False)
        check.expect("files", _files(check), [])
    check.page.open(SHORT)
    film, _ = check.page.save("mp4")
    check.expect("a film after it", film[4:8], b"ftyp")


def picture_while_a_film_is_made(check):
    check.page.open(LONG)
    check.page.go("1.5")
    _start_film(check)
    picture, _ = check.page.save("png")
    check.expect("pixels of the PNG that differ", check.page.differences(picture), 0)
    check.expect("the film goes on", check.page.value(SEEN))
    check.expect("files at first", _files(check), ["image/png"])
    check.page.value("check.until('the film', () => check.files.length === 2)")
    check.expect("files", _files(check), ["image/png", "video/mp4"])
    check.expect("messages", check.said("saving-problem"), "")
    film = _bytes(check, 1)
    alone, _ = check.page.save("mp4")
    check.expect("the film is whole", film == alone)


def film_of_a_scene_that_is_edited_meanwhile(check):
    """It is the film of the scene that was there when it began."""
    check.page.open(LONG)
    film, _ = check.page.save("mp4")
    _start_film(check)
    check.page.edit("blue.position", "2.5")
    check.page.value("check.until('the film', () => check.files.length === 2)")
    check.expect("the same film", _bytes(check, 1) == film)


def film_has_the_name_of_its_scene(check):
    """And who writes meanwhile is not disturbed."""
    check.page.choose("gas")
    _start_film(check)
    check.page.choose("circle")
    check.open_fields()
    check.page.value("document.getElementById('instant').focus()")
    check.page.value("check.until('the film', () => check.files.length === 1)")
    check.page.value(f"check.until('it is over', () => !({SEEN}))")
    check.expect("the file", "gas.mp4" in check.page.text("saved"))
    check.expect("the focus", check.page.value("document.activeElement.id"), "instant")
