"""Films: progress, interruption, threads, memory."""

import os
import signal
import subprocess
import sys
import threading
import time

import pytest
from conftest import bytes_of, in_threads, resident_bytes

import piblocks
from piblocks import Scene

SMALL = Scene(2, view_size="128x72")


def test_what_is_returned():
    rendered = SMALL.render("a.mp4", profile=True)
    assert rendered.path == "a.mp4" and rendered.frames == len(SMALL.frames())
    assert rendered.notes == () and rendered.profile["total"] > 0
    assert "video/mp4" in rendered._repr_html_()
    assert SMALL.render("b.mp4", bundle="talk").path == "talk/b.mp4"
    assert SMALL.render("a.mp4", part=(1, 2)).path == "a.mp4.part-1-of-2"
    corner = Scene(blue_position=0.5, red_mass=100, red_position=3, view_size="64x36")
    assert "by convention" in corner.render("null").notes[-1]


def test_progress_is_called_in_order_by_the_caller():
    calls = []
    rendered = SMALL.render("a.mp4", progress=lambda *now: calls.append((*now,
                            threading.current_thread())))
    done = [call[0] for call in calls]
    assert done[0] == 0 and done[-1] == rendered.frames and done == sorted(set(done))
    assert {call[1] for call in calls} == {rendered.frames}
    assert {call[2] for call in calls} == {threading.current_thread()}


def test_progress_as_a_line(capfd):
    SMALL.render("a.mp4", progress=True)
    count = len(SMALL.frames())
    assert capfd.readouterr().err.endswith(f"\ra.mp4: {count} of {count} frames\n")


@pytest.mark.parametrize("at", [0, 1, "last"])
def test_an_exception_of_the_callback_stops_the_rendering(at):
    def stop(done, total):
        if (at == 0) or (at == 1 and done > 0) or done == total:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        SMALL.render("a.mp4", progress=stop)
    assert os.listdir() == []


def test_a_callback_may_use_the_package():
    pictures = []
    SMALL.render("a.mp4", progress=lambda done, total: pictures.append(SMALL.frame(1).sum()))
    assert len(set(pictures)) == 1


#: A film that takes minutes.
SCRIPT = """
import time
from piblocks import Scene
scene = Scene(3, view_size="1920x1080", time_speed="1/100", view_theme="lecture",
              show_panels="velocity,unfolded")
print("begun", flush=True)
try:
    {call}
except KeyboardInterrupt:
    print("interrupted", time.time(), flush=True)
"""


@pytest.mark.parametrize(
    "call",
    [
        "scene.render('a.mp4')", "scene.render('a.webm')", "scene.render('a.html')",
        "scene.render('%06d.png', progress=lambda *_: None)", "Scene(9).log(limit=10**9 // 16)",
        "scene.golden_record('a', '.')",
        "scene.replace(time_speed=1e-3).state(__import__('numpy').linspace(0, 13, 10**7))",
        "scene.replace(show_logo='pipe.png').render('a.mp4')",
    ],
)
def test_ctrl_c_stops_at_once_and_leaves_no_file(call):
    if "pipe" in call:
        os.mkfifo("pipe.png")  # nobody writes to it
    before = os.listdir()
    # A small part of what the call takes; other tests may have all processors for a while.
    assert seconds_until_interrupted(call) < 10
    assert os.listdir() == before


def seconds_until_interrupted(call):
    process = subprocess.Popen([sys.executable, "-c", SCRIPT.format(call=call)],
                               stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "begun\n"
    time.sleep(0.7)
    sent = time.time()
    process.send_signal(signal.SIGINT)
    word, at = process.communicate(timeout=30)[0].split()
    assert word == "interrupted" and process.returncode == 0
    return float(at) - sent


def test_other_threads_run_meanwhile():
    ticks = []
    over = threading.Event()

    def tick():
        while not over.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.005)

    ticker = threading.Thread(target=tick)
    ticker.start()
    Scene(3, view_size="1280x720", time_to=2).render("a.webm", jobs=1)
    over.set()
    ticker.join()
    gaps = [b - a for a, b in zip(ticks, ticks[1:])]
    assert len(gaps) > 20 and sorted(gaps)[len(gaps) // 2] < 0.1


def test_threads_render_side_by_side():
    files = [f"{i}.mp4" for i in range(4)]
    in_threads(SMALL.render, files)
    assert len(set(map(bytes_of, files))) == 1


def test_an_interrupted_rendering_in_a_thread_is_its_own():
    """Ctrl-C belongs to the main thread: another one goes on."""
    thread = threading.Thread(target=Scene(3, view_size="640x360").render, args=("a.mp4",))
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
        time.sleep(1)
    thread.join()
    assert os.path.exists("a.mp4")


def test_memory_does_not_grow_with_renderings():
    tiny = Scene(1, view_size="64x36", view_fps=5, time_to=1)
    for _ in range(100):
        tiny.render("a.mp4")
    before = resident_bytes()
    for _ in range(400):
        tiny.render("a.mp4", jobs=2)
    assert resident_bytes() - before < 3.2e6


def test_a_disk_that_is_full():
    if not os.path.exists("/dev/full"):
        pytest.skip("there is no /dev/full")
    os.symlink("/dev/full", "a.mp4")
    with pytest.raises((piblocks.IoError, piblocks.UsageError)) as raised:
        SMALL.render("a.mp4")
    assert "a.mp4" in str(raised.value)


def test_an_output_that_cannot_be_opened():
    open("file", "w").close()
    for write, name in ((SMALL.render, "file/a.mp4"), (SMALL.still, "file/a.png")):
        with pytest.raises(piblocks.UsageError, match=f"'{name}': Not a directory|'file'"):
            write(name)


AT_EXIT = """
import atexit, threading, time
from piblocks import Scene
scene = Scene(3, view_size="1280x720", time_speed="1/100")
frames = scene.frames()
def work():
    while True:
        {call}
for _ in range(2):
    threading.Thread(target=work, daemon=True).start()
atexit.register(lambda: print(Scene(2, view_size="64x36").render("b.mp4").frames))
time.sleep(0.3)
"""


@pytest.mark.parametrize(
    "call",
    ["scene.render('a.mp4')", "scene.render('a.webm', progress=lambda *_: time.sleep(0.001))",
     "frames[len(frames) // 3]", "scene.frame(3)", "scene.state([1, 2, 3])", "scene.log()",
     "Scene(3)", "scene.still('a.png')"],
)
def test_the_interpreter_may_end_while_other_threads_work(call):
    result = subprocess.run([sys.executable, "-c", AT_EXIT.format(call=call)], capture_output=True,
                            text=True, timeout=60)
    assert (result.returncode, result.stderr) == (0, "")
    assert int(result.stdout) > 100 and set(os.listdir()) <= {"b.mp4", "a.png"}
