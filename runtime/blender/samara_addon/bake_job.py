"""Runs the program samara beside Blender to make a body file from a mesh. Does not import Blender's modules."""

import os
import re
import shutil
import signal
import subprocess
import threading

import numpy

from .samara_library import SamaraError


def find_program(name):
    """Returns the path of the program, given by its path or a name on PATH."""
    found = shutil.which(os.path.expanduser(name))
    if not found:
        raise SamaraError(f"the program '{name}' is not found; install samara, or set its path in the add-on's preferences")
    return found


def write_stl(path, corners):
    """Writes triangles (n, 3 corners, 3), in metres, as a binary .stl file."""
    records = numpy.zeros(len(corners), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    records["corners"] = corners
    with open(path, "wb") as file:
        file.write(b"samara".ljust(80))
        file.write(numpy.uint32(len(corners)).tobytes())
        file.write(records.tobytes())


def scene_text(name, shape, density, fluid):
    """Returns the scene (TOML) that `samara bake` reads. fluid: density and viscosity."""
    return (
        f"[scene]\nduration = 1.0\n\n[fluid]\ndensity = {fluid[0]!r}\nviscosity = {fluid[1]!r}\n\n"
        f'[[body]]\nname = "{name}"\nshape = "{shape}"\ndensity = {density!r}\n'
    )


def bake_commands(program, folder, name, quality, density, fluid, meshing=()):
    """Returns the commands that make folder/NAME.body.h5 from folder/NAME.stl, and writes the scene that they read. meshing: options
    of `samara mesh`."""
    shape, commands = f"{name}.stl", []
    if meshing:
        shape = f"{name}.mesh.body.h5"
        commands = [[program, "mesh", os.path.join(folder, f"{name}.stl"), "-o", os.path.join(folder, shape), *meshing]]
    if quality == "SHAPE":
        output = os.path.join(folder, f"{name}.body.h5")
        return commands + [[program, "kirchhoff", os.path.join(folder, shape), "-o", output]]
    scene = os.path.join(folder, f"{name}.toml")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(scene_text(name, shape, density, fluid))
    return commands + [[program, "bake", scene, "-o", folder, "--whole-grid", "--quality", quality.lower()]]


class BakeJob:
    """Commands that run one after the other, their progress and the last line of output."""

    def __init__(self, commands):
        self.line = ""  # the last line that they wrote
        self.cancelled = False
        self._left = list(commands)
        self._start()

    def _start(self):
        command = self._left.pop(0)
        try:
            # A separate process group, so that its solvers end with it.
            self._process = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                start_new_session=True,
            )
        except OSError as error:
            raise SamaraError(f"{command[0]}: {error.strerror}") from None
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self._process.stderr:
            text = line.decode("utf-8", "replace").strip()
            if text:
                self.line = text

    def progress(self):
        """Returns the progress from 0 to 1, by the last line."""
        found = re.search(r"(\d+) of (\d+)", self.line)
        return int(found[1]) / max(1, int(found[2])) if found else 0.0

    def is_done(self):
        """Whether all commands have succeeded. Starts the next one. Raises SamaraError with the message of one that failed."""
        status = self._process.poll()
        if status is None:
            return False
        self._reader.join(timeout=5.0)
        if status != 0:
            raise SamaraError(self.line or f"samara ended with status {status}")
        if self._left:
            self._start()
            return False
        return True

    def wait(self):
        self._process.wait()
        while not self.is_done():
            self._process.wait()

    def cancel(self):
        """Ends the command; solved cases are kept, and the next bake continues from there."""
        if self._process.poll() is not None:
            return
        self.cancelled = True
        for how, seconds in ((signal.SIGINT, 5.0), (signal.SIGTERM, 5.0), (signal.SIGKILL, 5.0)):
            try:
                os.killpg(self._process.pid, how)
                self._process.wait(timeout=seconds)
                return
            except subprocess.TimeoutExpired:
                continue
            except ProcessLookupError:
                return
