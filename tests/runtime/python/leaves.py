"""The scenes that the tests of the Python module fly."""

import subprocess
import sys
import textwrap


def leaves(**more):
    body = {"name": "leaf", "shape": "samara:leaf", "position": [0, 0, 2], "count": 3, "spread": {"angle": 0.5}}
    return {"scene": {"duration": 0.5, "step": 0.002, "frame_rate": 50}, "fluid": {"preset": "air"}, "body": [body | more]}


def endless():
    """A dict that holds itself."""
    values = {}
    values["self"] = values
    return values


# So many, for so long, that a flight can be stopped on its way.
long_flight = leaves(count=200) | {"scene": {"duration": 60.0}}


def ended_in_the_middle(target, argument):
    """An interpreter that exited while a thread of it was in the call of `target`, both given as source, where `long` is a
    scene of long_flight."""
    program = textwrap.dedent(f"""
        import threading, samara
        long = samara.Scene({long_flight!r})
        begun = threading.Event()
        thread = threading.Thread(target={target}, args=({argument},), daemon=True,
                                  kwargs=dict(progress=lambda done, total: begun.set()))
        thread.start()
        begun.wait()
    """)
    return subprocess.run([sys.executable, "-c", program], capture_output=True, timeout=100, check=False)
