"""Programs run to their end, and what that took.

In: words of commands. Out: wall time, processor time, memory, what they printed; on what machine; how
near a video is to what was drawn.
"""

import dataclasses
import os
import pathlib
import re
import signal
import time


class Failed(Exception):
    """A command did not succeed."""


@dataclasses.dataclass
class Finished:
    exit_code: int  # 127 if it could not be started
    seconds: float = 0  # from before it is started until it has ended
    cpu_seconds: float = 0  # user and system, of the process and of all that it has waited for
    peak_MB: float = 0  # resident set of the largest single process
    out: str = ""
    err: str = ""


def stop_on_signals():
    """The end of a terminal or of a job removes what is left as Ctrl-C does."""
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.default_int_handler)


def try_run(command, work):
    """@param work  a folder for what it prints"""
    command = [str(word) for word in command]
    streams = [work / "stdout", work / "stderr"]
    files = [(os.POSIX_SPAWN_OPEN, 0, os.devnull, os.O_RDONLY, 0)]
    files += [(os.POSIX_SPAWN_OPEN, number, file, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
              for number, file in enumerate(streams, 1)]
    begin = time.perf_counter()
    try:
        # In a process group of its own, so that a signal can end it with all that it has started.
        child = os.posix_spawnp(command[0], command, os.environ, file_actions=files, setpgroup=0,
                                setsigdef=[signal.SIGPIPE])
    except OSError as error:
        return Finished(127, err=f"cannot start {command[0]}: {error.strerror}")
    try:
        _, status, used = os.wait4(child, 0)
    except KeyboardInterrupt:
        os.killpg(child, signal.SIGTERM)
        os.waitpid(child, 0)
        raise
    seconds = time.perf_counter() - begin
    out, err = (file.read_text(errors="replace") for file in streams)
    return Finished(os.waitstatus_to_exitcode(status), seconds, used.ru_utime + used.ru_stime,
                    used.ru_maxrss * 1024 / 1e6, out, err)


def run(command, work):
    finished = try_run(command, work)
    if finished.exit_code:
        words = " ".join(map(str, command))
        raise Failed(f"{words} failed with {finished.exit_code}: {last_line(finished.err)}")
    return finished


def last_line(text):
    return text.strip("\n").rpartition("\n")[2]


def cpu_name():
    found = re.search(r"^model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    return found[1] if found else "unknown"


def compiler_of(build):
    found = next((build / "CMakeFiles").glob("*/CMakeCXXCompiler.cmake")).read_text()
    kind, version = (re.search(rf'CMAKE_CXX_COMPILER_{what} "(.*)"', found)[1] for what in ("ID", "VERSION"))
    return f"{'GCC' if kind == 'GNU' else kind} {version}"


def quality_of(video, drawn, work):
    """By ffmpeg, in dB and of all planes in 4:2:0, against the frames that the video was made of."""
    said = run(["ffmpeg", "-hide_banner", "-i", video, "-i", drawn, "-filter_complex",
                "[0:v]split[a][b];[1:v]split[c][d];[a][c]psnr[p];[b][d]ssim[s]", "-map", "[p]", "-f", "null",
                "-", "-map", "[s]", "-f", "null", "-"], work).err
    return {name: float(re.search(words + "([0-9.]+)", said)[1]) for name, words in
            (("psnr_dB", "PSNR .*average:"), ("least_psnr_dB", "PSNR .*min:"), ("ssim", "SSIM .*All:"))}
