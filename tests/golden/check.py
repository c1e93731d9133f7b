"""What checks of videos share: programs that may not complain, and the count of what is wrong.

In: what is found, and what is expected. Out: complaints on standard error, an exit code.
"""

import pathlib
import subprocess
import sys
import tempfile


class Check:
    def __init__(self, name, work):
        self.name, self.work = name, work
        self.faults = 0

    def fail(self, what):
        print(f"{self.name}: {what}", file=sys.stderr)
        self.faults += 1

    def expect(self, what, found, expected):
        if found != expected:
            self.fail(f"{what}: {found} instead of {expected}")

    def run(self, *command, **streams):
        """What it prints; nothing may be complained of."""
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **streams)
        self.expect(f"{command[0]}: exit code", done.returncode, 0)
        self.expect(f"{command[0]}: complaints", done.stderr.decode(), "")
        return done.stdout


def run_check(make, usage):
    """Runs make(program, scene, options, work).all() and ends the process: 1 if anything is wrong.

    @param usage  words that name the arguments, the options in brackets
    """
    if len(sys.argv) < 3 or len(sys.argv) > 3 and "[" not in usage:
        print(f"usage: {usage}", file=sys.stderr)
        sys.exit(2)
    program, scene = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    with tempfile.TemporaryDirectory() as work:
        check = make(program, scene, sys.argv[3:], pathlib.Path(work))
        check.all()
    sys.exit(1 if check.faults else 0)
