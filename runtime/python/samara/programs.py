"""plan and bake, which run the program samara: they need gmsh and OpenFOAM (the package samara-baking)."""

import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Iterable
from typing import Any, Callable, Optional, Union

from ._samara import Error

_COUNT = re.compile(r": ([\d.]+) of ([\d.]+) ")

_Path = Union[str, "os.PathLike[str]"]
_Progress = Optional[Callable[[float, float], object]]


def _run(command: str, arguments: Iterable[_Path], progress: _Progress) -> dict[str, Any]:
    program = shutil.which("samara")
    if program is None:
        raise Error("samara: the program is not found; install the package samara-baking, or add its folder to PATH")
    words = [program, command, *(os.fspath(argument) for argument in arguments), "--json"]
    with tempfile.TemporaryFile("w+") as told, subprocess.Popen(
        words, stdout=told, stderr=subprocess.PIPE, text=True
    ) as process:
        last = ""
        try:
            assert process.stderr
            for line in process.stderr:
                last = line.strip() or last
                count = _COUNT.search(line)
                if progress and count:
                    progress(float(count[1]), float(count[2]))
            process.wait()
        except BaseException:
            process.send_signal(signal.SIGINT)  # which keeps what is solved
            process.communicate()
            raise
        if process.returncode != 0:
            raise Error(last.removeprefix(f"samara {command}: ") or f"samara {command} ended with the status {process.returncode}")
        told.seek(0)
        result: dict[str, Any] = json.load(told)
    return result


def _options(options: dict[str, Any]) -> list[str]:
    words: list[str] = []
    for key, value in options.items():
        if hasattr(value, "tolist"):
            value = value.tolist()  # of numpy
        if value is None or value is False:
            continue
        words.append("--" + key.replace("_", "-"))
        if value is not True:
            words.append(",".join(map(str, value)) if isinstance(value, (list, tuple)) else str(value))
    return words


def plan(scene: _Path, *, progress: _Progress = None, **options: Any) -> dict[str, Any]:
    """Returns what a scene needs, as a dict: the models that matter, and the cases that its bake starts with.

    scene: a scene file. The options are those of 'samara plan', with underscores: plan("scene.toml", tolerance=0.1). Raises Error
    where the program is missing or fails."""
    return _run("plan", [scene, *_options(options)], progress)


def bake(shape: _Path, output: _Path, *, progress: _Progress = None, **options: Any) -> dict[str, Any]:
    """Bakes a shape into a body file, or the bodies of a scene into a folder, with OpenFOAM; returns the program's result as a dict.

    It takes minutes to hours. An interrupt keeps the solved cases, and the same call continues from there. progress: called with
    (done, total) cases. The options are those of 'samara bake', with underscores:
    bake("leaf.geo", "leaf.body.h5", quality="standard", fluid="air", density=600). Raises Error where the program is missing or
    fails."""
    return _run("bake", [shape, "-o", output, *_options(options)], progress)
