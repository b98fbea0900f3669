"""Flights on disk, so that a scene that is opened again, or a setting that is taken back, is not flown anew.

A file is named by the digest of all that the motion depends on, so that none is ever out of date. The folder lies beside
the .blend file, or among temporary files as long as it is not saved, and may be deleted at any time.
"""

import os
import tempfile

import bpy
import numpy

from . import samara_library
from .flight import Flight

MOST_BYTES = 512 * 2**20  # of all files; the oldest go first


def folder_of_file():
    """Where the open .blend file's flights are."""
    if bpy.data.filepath:
        return bpy.path.abspath("//samara/live")
    return os.path.join(tempfile.gettempdir(), f"samara-{os.getuid()}", "live")


def _file(request, folder):
    return os.path.join(folder, request.digest() + ".npy")


def read(request, folder):
    """The whole flight of a request, or None."""
    file = _file(request, folder)
    try:
        poses = numpy.load(file, allow_pickle=False)
        os.utime(file)  # the oldest are those that nobody reads
    except (OSError, ValueError, EOFError):
        return None
    frames = request.surroundings.frames
    if poses.shape != (frames, samara_library.POSE_SIZE) or poses.dtype != float or not numpy.isfinite(poses).all():
        return None
    return Flight(request, poses)


def write(flight, folder):
    """Keeps a flight that is flown to its end. A disk that is full or may not be written to costs the time to fly anew."""
    file = _file(flight.request, folder)
    try:
        os.makedirs(folder, exist_ok=True)
        handle, part = tempfile.mkstemp(dir=folder, suffix=".part")
        try:
            with os.fdopen(handle, "wb") as written:
                numpy.save(written, flight.poses)
            os.replace(part, file)
        except OSError:
            os.remove(part)
            raise
    except OSError:
        pass


def trim(folder):
    """Deletes the oldest files, so that those that stay have MOST_BYTES at most."""
    try:
        files = [entry for entry in os.scandir(folder) if entry.name.endswith((".npy", ".part"))]
        kept = 0
        for entry in sorted(files, key=lambda entry: entry.stat().st_mtime, reverse=True):
            kept += entry.stat().st_size
            if kept > MOST_BYTES:
                os.remove(entry.path)
    except OSError:
        pass
