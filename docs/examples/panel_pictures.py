"""The pictures of the add-on in docs/pictures: the window with leaves on a roof, and each of its panels.

  xvfb-run -a -s "-screen 0 1360x1000x24" blender --factory-startup --enable-event-simulate \\
    --window-geometry 0 0 1360 1000 --python docs/examples/panel_pictures.py -- ADD-ON.zip docs/scenes/roof.obj docs/pictures
"""

import os
import random
import sys
import traceback

import bpy
import numpy
from mathutils import Vector

zip_file, roof_file, folder, *_ = map(os.path.abspath, sys.argv[sys.argv.index("--") + 1 :])
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
    surroundings.use_ground, surroundings.bodies_meet = True, True
    surroundings.use_wind, surroundings.wind_speed, surroundings.gust_speed = True, 0.6, 0.3
    scene.cursor.location = (-0.55, -0.45, 2.0)
    bpy.ops.samara.add_bodies(
        ready="leaf", count=60, spread=(0.8, 0.35, 0.3), turn=True, smallest_size=1.0, largest_size=1.5, release=25.0
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


def save(name, area, rectangle=None):
    """Saves the area, or a rectangle (x, y, width, height) of the window, without the empty rows at its bottom."""
    file = os.path.join(folder, name)
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0], area=area):
        bpy.ops.screen.screenshot_area(filepath=file)
    image = bpy.data.images.load(file)
    pixels = numpy.array(image.pixels[:], numpy.float32).reshape(image.size[1], image.size[0], 4)  # from the bottom row
    bpy.data.images.remove(image)
    if rectangle:
        x, y, width, height = rectangle
        pixels = pixels[y - area.y : y - area.y + height, x - area.x : x - area.x + width]
    inside = pixels[8:, 60:-24, :3]  # without borders, tabs and scroll bar
    pixels = pixels[numpy.flatnonzero(numpy.ptp(inside, axis=1).max(axis=1) > 0.02)[0] :]
    cut = bpy.data.images.new(name, pixels.shape[1], pixels.shape[0])
    cut.pixels = pixels.ravel()
    cut.filepath_raw, cut.file_format = file, "PNG"
    cut.save()


def steps():
    """What is done in the window, with the seconds to let it draw."""
    from samara_addon import panel

    window = bpy.context.window_manager.windows[0]
    for other in bpy.types.Panel.__subclasses__():  # those of the tab Physics
        if getattr(other, "bl_context", "") == "physics" and other not in panel.CLASSES:
            bpy.utils.unregister_class(other)
    panel.SAMARA_PT_bake.bl_options = set()  # open
    for c in reversed(panel.CLASSES):
        bpy.utils.unregister_class(c)
    for c in panel.CLASSES:
        bpy.utils.register_class(c)
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
    bpy.ops.screen.screenshot(filepath=os.path.join(folder, "blender-window.png"))

    # The box of Add > samara Bodies.
    region = next(r for r in view.regions if r.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=view, region=region):
        bpy.ops.samara.add_bodies("INVOKE_DEFAULT", True, ready="leaf", count=100, spread=(0.6, 0.4, 0.5), turn=True,
                                  first_color=(0.8, 0.06, 0.02, 1.0), second_color=(1.0, 0.62, 0.06, 1.0))
    yield 3.0
    box = next(r for r in view.regions if r.type == "HUD")
    for event in ("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE"):  # opens it
        window.event_simulate(type=event[0], value=event[1], x=box.x + 40, y=box.y + box.height - 12)
        yield 0.3
    yield 3.0
    save("blender-add.png", view, (box.x, box.y, box.width, box.height))

    # The panels, in the height of the window.
    with bpy.context.temp_override(window=window, area=next(a for a in window.screen.areas if a.type == "DOPESHEET_EDITOR")):
        bpy.ops.screen.area_close()
    draw_scene = panel.SAMARA_PT_surroundings.draw
    panel.SAMARA_PT_surroundings.draw = lambda self, context: None
    yield 3.0
    save("blender-panel.png", properties)
    panel.SAMARA_PT_surroundings.draw, panel.SAMARA_PT_body.draw = draw_scene, panel.SAMARA_PT_surroundings.draw
    panel.SAMARA_PT_bake.poll = classmethod(lambda cls, context: False)
    properties.tag_redraw()
    yield 3.0
    save("blender-scene.png", properties)


def go_on(going=steps()):
    try:
        return next(going)
    except StopIteration:
        pass
    except Exception:
        traceback.print_exc()
    bpy.ops.wm.quit_blender()


bpy.app.timers.register(go_on, first_interval=2.0)
