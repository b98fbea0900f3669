"""The pictures docs/pictures/blender-window.png and blender-panel.png: leaves on a roof, and the add-on's panel.

  samara bodies leaf -o leaf.body.h5
  xvfb-run -a -s "-screen 0 1360x1000x24" blender --factory-startup --window-geometry 0 0 1360 1000 \\
    --python docs/examples/panel_pictures.py -- ADD-ON.zip leaf.body.h5 docs/scenes/roof.obj WINDOW.png PANEL.png
"""

import os
import random
import sys
import traceback

import bpy
from mathutils import Vector

zip_file, body_file, roof_file, window_picture, panel_picture = map(os.path.abspath, sys.argv[sys.argv.index("--") + 1 :])
try:
    if bpy.ops.preferences.addon_install(filepath=zip_file) != {"FINISHED"}:
        raise RuntimeError("Blender cannot install it")
    if bpy.ops.preferences.addon_enable(module="samara_addon") != {"FINISHED"}:
        raise RuntimeError("Blender finds no module samara_addon")
except RuntimeError as error:
    reasons = [line for line in str(error).splitlines() if line and not line.startswith("Location:")]
    sys.exit(f"{zip_file}: the add-on is not enabled: {reasons[-1]}")
bpy.context.preferences.view.show_splash = False
bpy.context.preferences.view.ui_scale = 1.1


def build():
    """The scene: a roof, a wind, sixty leaves with keys."""
    scene = bpy.context.scene
    for o in list(bpy.data.objects):
        bpy.data.objects.remove(o)
    bpy.ops.import_scene.obj(filepath=roof_file, axis_forward="Y", axis_up="Z")
    roof = bpy.context.selected_objects[0]
    roof.samara.is_obstacle, roof.samara.friction, roof.color = True, 0.9, (0.20, 0.075, 0.045, 1.0)
    surroundings = scene.samara
    surroundings.fluid, surroundings.use_ground, surroundings.bodies_meet = "AIR", True, True
    surroundings.use_wind, surroundings.wind_speed, surroundings.gust_speed = True, 0.6, 0.3
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(os.path.dirname(body_file), "leaves.blend"))
    scene.cursor.location = (-0.55, -0.45, 2.0)
    bpy.ops.samara.add_bodies(
        filepath="//" + os.path.basename(body_file), count=60, spread=(0.8, 0.35, 0.3), turn=True, smallest_size=1.0, largest_size=1.5, release=25.0
    )
    draw = random.Random(2)
    for o in bpy.context.selected_objects:
        o.color = (*draw.choice(((0.8, 0.06, 0.02), (1.0, 0.28, 0.02), (1.0, 0.62, 0.06))), 1.0)
    scene.frame_end = 60
    bpy.ops.samara.simulate()
    scene.frame_set(38)
    for o in bpy.context.selected_objects:
        o.select_set(o == bpy.context.object)
    scene.cursor.location = (0.0, 0.0, -5.0)


def steps():
    """What is done in the window, with the seconds to let it draw."""
    window = bpy.context.window_manager.windows[0]
    areas = {a.type: a for a in window.screen.areas}
    for name in ("OUTLINER", "PROPERTIES"):  # a taller and wider one takes their place
        with bpy.context.temp_override(window=window, area=areas[name]):
            bpy.ops.screen.area_close()
    yield 1.0
    view = next(a for a in window.screen.areas if a.type == "VIEW_3D")
    with bpy.context.temp_override(window=window, area=view):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.7)
    view, properties = sorted((a for a in window.screen.areas if a.type == "VIEW_3D"), key=lambda a: a.x)
    properties.type = "PROPERTIES"
    build()
    yield 1.0
    properties.spaces[0].context = "PHYSICS"
    space = view.spaces[0]
    space.shading.color_type, space.shading.show_shadows, space.shading.show_cavity = "OBJECT", True, True
    space.shading.background_type, space.shading.background_color = "VIEWPORT", (0.16, 0.20, 0.26)
    space.shading.studio_light, space.shading.shadow_intensity = "outdoor.sl", 0.4
    space.overlay.show_cursor = space.overlay.show_relationship_lines = False
    space.region_3d.view_location, space.region_3d.view_distance = (0.0, -0.3, 0.88), 2.7
    space.region_3d.view_rotation = Vector((-0.5, -1.0, 0.5)).to_track_quat("Z", "Y")
    yield 5.0
    bpy.ops.screen.screenshot(filepath=window_picture)

    # The panel alone, scrolled down, in the height of the window.
    with bpy.context.temp_override(window=window, area=next(a for a in window.screen.areas if a.type == "DOPESHEET_EDITOR")):
        bpy.ops.screen.area_close()
    bpy.context.preferences.view.ui_scale = 0.95
    yield 3.0
    properties = next(a for a in window.screen.areas if a.type == "PROPERTIES")
    with bpy.context.temp_override(window=window, area=properties, region=properties.regions[-1]):
        bpy.ops.view2d.scroll_down(page=True)
    yield 3.0
    with bpy.context.temp_override(window=window, area=properties):
        bpy.ops.screen.screenshot_area(filepath=panel_picture)


def go_on(going=steps()):
    try:
        return next(going)
    except StopIteration:
        pass
    except Exception:
        traceback.print_exc()
    bpy.ops.wm.quit_blender()


bpy.app.timers.register(go_on, first_interval=2.0)
