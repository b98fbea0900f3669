"""What needs a window: buttons, Esc, frames that wait. Generators that yield the seconds to let it live."""

import os
import threading

import bpy

from .steps import empty_scene, matrices, run, scene, three_bodies


class Watch:
    """What an operator's calls for events return, and its lines while it runs."""

    def __init__(self, operator):
        self.results, self.lines = [], []
        modal, status = operator.modal, operator.status

        def watched_modal(operator, context, event):
            self.results.append(*modal(operator, context, event))
            return {self.results[-1]}

        def watched_status(operator):
            self.lines.append(status(operator))
            return self.lines[-1]

        operator.modal, operator.status = watched_modal, watched_status

    def runs(self):
        return not self.results or self.results[-1] in ("RUNNING_MODAL", "PASS_THROUGH")


def press(operator, **options):
    """A button pressed in the window."""
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        return list(operator("INVOKE_DEFAULT", True, **options))


def press_escape():
    for value in ("PRESS", "RELEASE"):
        bpy.context.window_manager.windows[0].event_simulate(type="ESC", value=value, x=10, y=10)


def simulate_in_window(file):
    """The button that simulates: Esc half way, then to its end, then what it refuses."""
    from samara_addon.simulate import SAMARA_OT_simulate as operator

    objects = three_bodies(file)
    scene.frame_set(31)

    def shown():
        keyed = [o.animation_data is not None for o in objects]
        return [scene.frame_current, keyed] + [[o.rotation_mode, [list(r) for r in o.matrix_basis]] for o in objects]

    before = shown()
    scene.frame_end, scene.samara.step = 3000, 1e-5  # many seconds
    watch = Watch(operator)
    found = {"pressed": press(bpy.ops.samara.simulate)}
    while watch.runs() and watch.lines[-1:] in ([], ["samara is simulating: 0 %"]):
        yield 0.05
    found["halfway"] = watch.lines[-1]
    press_escape()
    while watch.runs():
        yield 0.05
    found["cancelled"] = watch.results[-1]
    found["unchanged"] = shown() == before

    scene.frame_end, scene.samara.step = 71, 0.002
    watch.results.clear()
    press(bpy.ops.samara.simulate)
    while watch.runs():
        yield 0.05
    found["finished"] = watch.results[-1]
    found["keys"] = sorted({len(c.keyframe_points) for o in objects for c in o.animation_data.action.fcurves})
    objects[0].scale = (2.0, 1.0, 2.0)
    found["refused"] = run(bpy.ops.samara.simulate)
    return found


def live_in_window(file):
    """Live while the flights are slow: a late frame is asked for, waited for, and flown to."""
    from samara_addon import live
    from samara_addon.samara_library import Simulation

    objects = three_bodies(file)
    advance_to = Simulation.advance_to
    halfway, released = 30 / 24.0, threading.Event()  # s

    def stop_halfway(simulation, time):
        if time > halfway:
            released.wait()
        advance_to(simulation, time)

    Simulation.advance_to = stop_halfway
    found = {"error": run(bpy.ops.samara.live)}
    early = [list(o.location) for o in objects]
    scene.frame_set(71)
    found["flown"] = min(flight.flown for flight in live._flights.values())
    while any(list(o.location) == there for o, there in zip(objects, early)):
        yield 0.1
    found["moved_on"] = min(flight.flown for flight in live._flights.values())
    released.set()
    while any(flight.is_flying() for flight in live._flights.values()):
        yield 0.2
    yield 0.3
    found["frame"] = scene.frame_current
    found["shown"] = {o.name: [list(row) for row in o.matrix_basis] for o in objects}
    assert run(bpy.ops.samara.live) == ""
    assert run(bpy.ops.samara.simulate) == ""
    found["keyed"] = {name: rows[0] for name, rows in matrices(objects, [71]).items()}
    return found


def bake_in_window(program, folder):
    """The button that bakes: Esc half way, an end with an error, then to its end."""
    from samara_addon.bake import SAMARA_OT_bake as operator

    def program_that(name, text):
        path = os.path.join(folder, name)
        with open(path, "w") as script:
            script.write("#!/bin/sh\n" + text)
        os.chmod(path, 0o755)
        return path

    empty_scene()
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.02)
    body = bpy.context.object.samara
    settings = bpy.context.preferences.addons["samara_addon"].preferences
    process_file = os.path.join(folder, "process")
    watch = Watch(operator)
    settings.program = program_that("slow", f"echo 'case 3 of 10' >&2\necho $$ > '{process_file}'\nexec sleep 600\n")
    found = {"pressed": press(bpy.ops.samara.bake)}
    while watch.runs() and not any("3 of 10" in line for line in watch.lines):
        yield 0.05
    found["halfway"] = watch.lines[-1]
    found["while_running"] = watch.results[-1]
    press_escape()
    while watch.runs():
        yield 0.05
    found["cancelled"] = watch.results[-1]
    with open(process_file) as file:
        found["process_lives"] = os.path.exists(f"/proc/{file.read().strip()}")
    found["file_when_cancelled"] = body.body_file

    settings.program = program_that("failing", "echo 'slow: refused' >&2\nexit 1\n")
    watch.results.clear()
    press(bpy.ops.samara.bake)
    while watch.runs():
        yield 0.05
    found["refused"] = watch.results[-1]

    settings.program = program
    watch.results.clear()
    press(bpy.ops.samara.bake, quality="SHAPE")
    while watch.runs():
        yield 0.05
    found["finished"] = watch.results[-1]
    found["file"] = body.body_file
    return found


TASKS = (simulate_in_window, live_in_window, bake_in_window)
