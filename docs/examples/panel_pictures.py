"""The pictures docs/pictures/blender-window.png and blender-panel.png: leaves on a roof, and the add-on's panel.

  samara bodies leaf -o leaf.body.h5
  xvfb-run -a -s "-screen 0 1360x900x24" blender --factory-startup --window-geometry 0 0 1360 900 \\
    --python docs/examples/panel_pictures.py -- ADD-ON.zip leaf.body.h5 docs/scenes/roof.obj WINDOW.png PANEL.png
"""

import os
import random
import sys

import bpy
from mathutils import Vector

zip_file, body_file, roof_file, window_picture, panel_picture = map(os.path.abspath, sys.argv[sys.argv.index("--") + 1 :])
bpy.ops.preferences.addon_install(filepath=zip_file)
bpy.ops.preferences.addon_enable(module="samara")
bpy.context.preferences.view.show_splash = False
bpy.context.preferences.view.ui_scale = 1.1


def build():
    """The scene: a roof, a wind, sixty leaves with keys."""
    scene = bpy.context.scene
    for o in list(bpy.data.objects):
        bpy.data.objects.remove(o)
    bpy.ops.import_scene.obj(filepath=roof_file, axis_forward="Y", axis_up="Z")
    roof = bpy.context.selected_objects[0]
    roof.samara.is_obstacle, roof.samara.friction, roof.color = True, 0.9, (0.10, 0.11, 0.13, 1.0)
    surroundings = scene.samara
    surroundings.fluid, surroundings.use_ground, surroundings.bodies_meet = "AIR", True, True
    surroundings.use_wind, surroundings.wind_speed, surroundings.gust_speed = True, 0.6, 0.3
    scene.cursor.location = (-0.9, -0.45, 2.1)
    bpy.ops.samara.add_bodies(
        filepath=body_file, count=60, spread=(0.7, 0.35, 0.3), turn=True, smallest_size=1.0, largest_size=1.5, release=25.0
    )
    draw = random.Random(2)
    for o in bpy.context.selected_objects:
        o.color = (*draw.choice(((0.75, 0.07, 0.01), (0.9, 0.25, 0.01), (0.9, 0.5, 0.03))), 1.0)
    scene.frame_end = 60
    bpy.ops.samara.simulate()
    scene.frame_set(36)
    for o in bpy.context.selected_objects:
        o.select_set(o == bpy.context.object)
    scene.cursor.location = (0.0, 0.0, -5.0)


def steps():
    """What is done in the window, with the seconds to let it draw."""
    window = bpy.context.window_manager.windows[0]
    areas = {a.type: a for a in window.screen.areas}
    with bpy.context.temp_override(window=window, area=areas["OUTLINER"]):
        bpy.ops.screen.area_close()
    yield 1.0
    areas = {a.type: a for a in window.screen.areas}
    properties, view = areas["PROPERTIES"], areas["VIEW_3D"]
    with bpy.context.temp_override(window=window):
        bpy.ops.screen.area_move(x=properties.x - 1, y=properties.y + 300, delta=-60)
    build()
    yield 1.0
    properties.spaces[0].context = "PHYSICS"
    space = view.spaces[0]
    space.shading.color_type, space.shading.show_shadows, space.shading.show_cavity = "OBJECT", True, True
    space.overlay.show_cursor = space.overlay.show_relationship_lines = False
    space.region_3d.view_location, space.region_3d.view_distance = (0.0, -0.3, 1.0), 3.4
    space.region_3d.view_rotation = Vector((-0.5, -1.0, 0.5)).to_track_quat("Z", "Y")
    yield 5.0
    with bpy.context.temp_override(window=window, area=properties):
        bpy.ops.screen.screenshot_area(filepath=panel_picture)
    bpy.ops.screen.screenshot(filepath=window_picture)
    bpy.ops.wm.quit_blender()


going = steps()
bpy.app.timers.register(lambda: next(going, None), first_interval=2.0)
