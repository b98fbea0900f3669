"""Stores simulated poses on disk, so that reopened scenes and reverted settings are not simulated again.

A file is named by the digest of all that the motion depends on, so that none is ever out of date. The folder lies beside
the .blend file, or among temporary files as long as it is not saved, and may be deleted at any time.
"""

import os
import tempfile

import bpy
import numpy

from . import samara_library
from .flight import Flight

MOST_BYTES = 512 * 2**20  # of all files; the oldest are deleted first


def folder_of_file():
    """Returns the folder of the open .blend file's flights."""
    if bpy.data.filepath:
        return bpy.path.abspath("//samara/live")
    return os.path.join(tempfile.gettempdir(), f"samara-{os.getuid()}", "live")


def _file(request, folder):
    return os.path.join(folder, request.digest() + ".npy")


def read(request, folder):
    """Returns the complete poses of a request, or None."""
    file = _file(request, folder)
    try:
        poses = numpy.load(file, allow_pickle=False)
        os.utime(file)  # the least recently read files are the oldest
    except (OSError, ValueError, EOFError):
        return None
    frames = request.surroundings.frames
    if poses.shape != (frames, samara_library.POSE_SIZE) or poses.dtype != float or not numpy.isfinite(poses).all():
        return None
    return Flight(request, poses)


def write(flight, folder):
    """Stores a complete flight. Where the disk is full or read-only, it will be simulated again."""
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
    """Deletes the oldest files until the others have at most MOST_BYTES."""
    try:
        files = [entry for entry in os.scandir(folder) if entry.name.endswith((".npy", ".part"))]
        kept = 0
        for entry in sorted(files, key=lambda entry: entry.stat().st_mtime, reverse=True):
            kept += entry.stat().st_size
            if kept > MOST_BYTES:
                os.remove(entry.path)
    except OSError:
        pass
