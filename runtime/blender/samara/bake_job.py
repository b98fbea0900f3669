"""The program samara, run beside Blender: from a mesh to a body file. Knows nothing of Blender."""

import os
import re
import shutil
import signal
import subprocess
import threading

import numpy

from .samara_library import SamaraError


def find_program(name):
    """The path of the program, by its path or among those of the system."""
    found = shutil.which(os.path.expanduser(name))
    if not found:
        raise SamaraError(f"the program '{name}' is not found; install samara, or set its path in the add-on's preferences")
    return found


def write_stl(path, corners):
    """Triangles (n, 3 corners, 3), metres, as a binary .stl file."""
    records = numpy.zeros(len(corners), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    records["corners"] = corners
    with open(path, "wb") as file:
        file.write(b"samara".ljust(80))
        file.write(numpy.uint32(len(corners)).tobytes())
        file.write(records.tobytes())


def scene_text(name, stl, density, fluid):
    """The scene that `samara bake` reads. fluid: density and viscosity."""
    return (
        f"[scene]\nduration = 1.0\n\n[fluid]\ndensity = {fluid[0]!r}\nviscosity = {fluid[1]!r}\n\n"
        f'[[body]]\nname = "{name}"\nshape = "{stl}"\ndensity = {density!r}\n'
    )


def bake_command(program, folder, name, quality, density, fluid):
    """The command that makes folder/NAME.body.h5 from folder/NAME.stl. Writes the scene that it reads."""
    if quality == "SHAPE":
        output = os.path.join(folder, f"{name}.body.h5")
        return [program, "kirchhoff", os.path.join(folder, f"{name}.stl"), "-o", output]
    scene = os.path.join(folder, f"{name}.toml")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(scene_text(name, f"{name}.stl", density, fluid))
    return [program, "bake", scene, "-o", folder, "--whole-grid", "--quality", quality.lower()]


class BakeJob:
    """A running command, its progress and its last words."""

    def __init__(self, command):
        self.line = ""  # the last one that it wrote
        self.cancelled = False
        try:
            # A process group of its own, so that its solvers end with it.
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
        """From 0 to 1, as far as its last line tells."""
        found = re.search(r"(\d+) of (\d+)", self.line)
        return int(found[1]) / max(1, int(found[2])) if found else 0.0

    def is_done(self):
        """Whether it has ended well. Raises what it refused."""
        status = self._process.poll()
        if status is None:
            return False
        self._reader.join(timeout=5.0)
        if status != 0:
            raise SamaraError(self.line or f"samara ended with status {status}")
        return True

    def wait(self):
        self._process.wait()
        self.is_done()

    def cancel(self):
        """Ends it; what is solved is kept, and the next bake goes on from there."""
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
