"""A command line as a call of the package.

In: the arguments of a command that both know. Out: the same request to the package. Which option
sets which key of a scene is read from the program's source, so that it stands in one place.
"""

import re

from conftest import TREE
from piblocks import Scene, scenes

_SOURCE = (TREE / "src/cli/scene_options.cpp").read_text()
#: "--size": "view.size"
KEY_OF = {
    option: key
    for key, option in re.findall(r'add_(?:key|text)\(\s*"([^"]+)",\s*"(--[^"]+)"', _SOURCE)
}
#: "--loop": ("time.loop", "true")
FLAG_OF = {
    option: (key, value)
    for key, option, value in re.findall(
        r'add_flag\(\s*\{"([^"]+)",\s*"(--[^"]+)",\s*"([^"]+)"\}', _SOURCE
    )
}
_SPECIAL = {"for": "for_", "from": "from_"}
_OWN_FLAGS = {"--smallest", "--bounds", "--quiet", "--profile"}


class NotTranslatable(Exception):
    """The request is about the command line itself."""


def keyword(key):
    return key.replace(".", "_").replace("-", "_")


def _own(option):
    name = option.removeprefix("--").replace("-", "_")
    return _SPECIAL.get(name, name)


def _option(argument, rest):
    """Option and value, or None as the value of a flag."""
    argument = {"-o": "--output"}.get(argument, argument)
    if "=" in argument:
        return tuple(argument.split("=", 1))
    if argument in FLAG_OF or argument in _OWN_FLAGS:
        return argument, None
    if not rest:
        raise NotTranslatable("an option without its value")
    return argument, rest.pop(0)


def parse(arguments):
    """Command, positional arguments, keys of the scene, options of the command."""
    command, *rest = arguments
    positional, keys, own = [], {}, {}
    while rest:
        argument = rest.pop(0)
        if not argument.startswith("-"):
            positional.append(argument)
            continue
        option, value = _option(argument, rest)
        if option in FLAG_OF:
            key, value = FLAG_OF[option]
            if keyword(key) in keys:
                raise NotTranslatable("two flags for one key")
            keys[keyword(key)] = value
        elif option in KEY_OF and not (command == "log" and option in ("--from", "--to")):
            if keyword(KEY_OF[option]) in keys:
                raise NotTranslatable("an option that is given twice")
            keys[keyword(KEY_OF[option])] = value
        elif _own(option) in own:
            raise NotTranslatable("an option that is given twice")
        elif option != "--quiet":
            own[_own(option)] = True if value is None else value
    return command, positional, keys, own


def _scene(positional, keys):
    if len(positional) > 1:
        raise NotTranslatable("several scenes")
    if not positional:
        return Scene(**keys)
    if "." in positional[0] or "/" in positional[0]:
        return Scene.from_toml(positional[0], **keys)
    if positional[0] not in scenes():
        raise NotTranslatable("a name that could be one of a file")
    return Scene.shipped(positional[0], **keys)


def _output(own):
    if "output" not in own:
        raise NotTranslatable("no output")
    if own["output"] == "-":
        raise NotTranslatable("standard output")
    return own.pop("output")


def call(arguments):
    """Asks the package for what the command line asks for."""
    command, positional, keys, own = parse(arguments)
    if command not in ("render", "still", "sheet", "log", "state", "count"):
        raise NotTranslatable(f"no counterpart of '{command}'")
    if command in ("still", "state") and "at" not in own:
        raise NotTranslatable("no instant")
    if command == "log" and ("output" in own or own.get("format", "npy") != "npy"):
        raise NotTranslatable("a log is an array")
    output = _output(own) if command in ("render", "still", "sheet") else own.pop("output", None)
    scene = _scene(positional, keys)
    if command == "count":
        return scene.count
    if command == "state":
        times = own.pop("at").split(",")
        if "" in times:
            raise NotTranslatable("instants are a list, not a text with commas")
        return [scene.state(t, **own) for t in times]
    if command == "log":
        own.pop("format", None)
        return scene.log(**{k: int(v) if k in ("first", "limit") else v for k, v in own.items()})
    if command == "still":
        return scene.still(output, own.pop("at"), **own)
    return getattr(scene, command)(output, **own)
