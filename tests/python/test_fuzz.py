"""Random calls for ten seconds; fuzz_binding.py takes longer where asked to."""

import os
import subprocess
import sys
from pathlib import Path

FUZZER = Path(__file__).with_name("fuzz_binding.py")


def test_random_calls_neither_crash_nor_hang():
    seconds = os.environ.get("PIBLOCKS_FUZZ_SECONDS", "10")
    result = subprocess.run([sys.executable, str(FUZZER), seconds], capture_output=True, text=True)
    assert result.returncode == 0, result.stdout[-3000:] + result.stderr[-3000:]
