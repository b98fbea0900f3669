"""Installs the add-on's zip in Blender, does one task of addon_tasks with it, and prints what came of it as a line of JSON
after "FOUND ":

  blender -b --factory-startup --python-exit-code 3 --python use_addon.py -- ZIP TASK [ARGUMENT ...]

Tasks in a window, which are generators that yield the seconds to let it live, need one in place of -b:

  xvfb-run -a blender --factory-startup --enable-event-simulate --python use_addon.py -- ZIP TASK [ARGUMENT ...]
"""

import inspect
import json
import os
import sys
import traceback

import addon_utils
import bpy

sys.dont_write_bytecode = True  # the sources stay as they are
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from addon_tasks import bodies, files, flights, surroundings, window  # noqa: E402

zip_file, task, *arguments = sys.argv[sys.argv.index("--") + 1 :]

bpy.ops.preferences.addon_install(filepath=zip_file)
bpy.ops.preferences.addon_enable(module="samara_addon")
assert addon_utils.check("samara_addon")[1], "the add-on is not enabled"


def finish(found):
    bpy.ops.preferences.addon_disable(module="samara_addon")
    print("\nFOUND " + json.dumps(found), flush=True)


def go_on(steps):
    """The next step of a task in a window; ends Blender after the last one, and after one that fails."""
    try:
        return next(steps)
    except StopIteration as end:
        finish(end.value)
    except Exception:
        traceback.print_exc()
    bpy.ops.wm.quit_blender()
    return None


tasks = {f.__name__: f for module in (bodies, flights, surroundings, files, window) for f in module.TASKS}
found = tasks[task](*arguments)
if inspect.isgenerator(found):
    bpy.context.preferences.view.show_splash = False
    bpy.app.timers.register(lambda: go_on(found), first_interval=0.5)
else:
    finish(found)
