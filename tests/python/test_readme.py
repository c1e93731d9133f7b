"""Every code block of the package's README runs."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import TREE

README = (TREE / "src/python/README.md").read_text()


def blocks(language):
    found = re.findall(rf"^```{language}\n(.*?)^```", README, re.MULTILINE | re.DOTALL)
    assert found
    return found


def test_python_blocks_run_one_after_the_other(capsys):
    names = {}
    for block in blocks("python"):
        exec(compile(block, "README.md", "exec"), names)
    assert capsys.readouterr().out == "314\n"
    for file in ("pi-3.mp4", "turn.pdf", "pi-3.webm", "pi-3.gif"):
        assert Path(file).stat().st_size > 1000
    assert len(names["film"]) == 832 and len(names["brightness"]) == 9


def test_the_commands_of_golden_tests_run():
    [test] = [block for block in blocks("python") if "piblocks_golden" in block]
    Path("test_scenes.py").write_text(test)
    [commands] = [block for block in blocks("sh") if block.startswith("pytest")]
    for line in commands.splitlines():
        _, *arguments = shlex.split(line, comments=True)
        result = subprocess.run([sys.executable, "-m", "pytest", "-p", "piblocks.pytest_plugin",
                                 *arguments], capture_output=True, text=True)
        assert "3 passed" in result.stdout, result.stdout


def test_all_other_commands_install():
    """test_wheel.py runs that without a network."""
    commands = [line for block in blocks("sh") for line in block.splitlines()]
    others = [line for line in commands if not line.startswith("pytest")]
    assert others == ["pip install src/python", "pip install --no-build-isolation src/python"]


def test_the_table_names_everything():
    from piblocks import Scene

    for name in vars(Scene):
        if not name.startswith("_"):
            assert f".{name}" in README, name


@pytest.mark.parametrize("script", ["by_piblocks", "by_matplotlib"])
def test_the_lines_of_the_scripts_are_counted(script):
    text = (TREE / f"tests/python/comparison/{script}.py").read_text()
    lines = sum(1 for line in text.splitlines() if line.strip() and not line.startswith("#"))
    assert f"[{script}.py](../../tests/python/comparison/{script}.py) | {lines} |" in README
