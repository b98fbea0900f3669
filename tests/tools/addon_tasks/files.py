"""Bakes, renders, many keys, other files, the version."""

import time

import bpy

from .steps import add_bodies, empty_scene, run, scene


def bake(program, quality):
    empty_scene()
    found = {}
    settings = bpy.context.preferences.addons["samara_addon"].preferences
    bpy.ops.mesh.primitive_plane_add(size=0.02)
    settings.program = program + "-not"
    found["no_program"] = run(bpy.ops.samara.bake, quality=quality)
    settings.program = program
    found["open"] = run(bpy.ops.samara.bake, quality=quality)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.5)
    o = bpy.context.object
    o.name = "Ball 1"
    o.scale = (-0.04, 0.04, 0.04)
    found["negative"] = run(bpy.ops.samara.bake, quality=quality)
    o.scale = (0.04, 0.04, 0.04)
    o.modifiers.new("smooth", "SUBSURF").levels = 1
    found["error"] = run(bpy.ops.samara.bake, quality=quality)

    from samara_addon import samara_library
    from samara_addon.bake import mesh_corners
    from samara_addon.bake_job import BakeJob

    found["file"] = o.samara.body_file
    body = samara_library.body_of_file(o.samara.body_file)
    found["tables"] = body.has_tables
    vertices, _ = body.surface()
    found["extent"] = list(vertices.max(axis=0) - vertices.min(axis=0))
    found["simulate"] = run(bpy.ops.samara.simulate)
    bpy.ops.mesh.primitive_cube_add()
    found["empty_of_faces"] = ""
    bpy.context.object.data.clear_geometry()
    found["empty_of_faces"] = run(bpy.ops.samara.bake, quality=quality)
    # A bake that is cancelled ends at once.
    job = BakeJob([["sleep", "600"]])
    job.cancel()
    found["cancelled"] = job.cancelled
    return found


def render(file, picture):
    empty_scene()
    add_bodies(file, 20, spread=(0.15, 0.15, 0.1), turn=True, density=1600.0)
    scene.frame_end = 12
    assert run(bpy.ops.samara.simulate) == ""
    bpy.ops.object.camera_add(location=(0.0, -0.6, 0.0), rotation=(1.5708, 0.0, 0.0))
    scene.camera = bpy.context.object
    bpy.ops.object.light_add(type="SUN", rotation=(0.5, 0.3, 0.0))
    bpy.context.object.data.energy = 4.0
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 4
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 320, 240, 100
    scene.render.filepath = picture
    scene.frame_set(12)
    bpy.ops.render.render(write_still=True)
    pixels = bpy.data.images.load(picture).pixels[:]
    return {"bright": sum(p > 0.5 for p in pixels[0::4]) / (len(pixels) / 4)}


def crowd(file, count, frames):
    """Seconds and CPU seconds for many bodies over many frames: of their flights alone, and of the whole button."""
    empty_scene()
    objects = add_bodies(file, int(count), spread=(1.0, 1.0, 1.0), turn=True, density=600.0)
    scene.samara.fluid = "AIR"
    scene.frame_end = int(frames)

    from samara_addon.flight import FlightJob
    from samara_addon.simulate import requests_of

    start, start_cpu = time.perf_counter(), time.process_time()
    FlightJob(requests_of(bpy.context, objects)[0]).wait()
    flown, flown_cpu = time.perf_counter(), time.process_time()
    assert run(bpy.ops.samara.simulate) == ""
    end, end_cpu = time.perf_counter(), time.process_time()
    return {
        "simulation": {"seconds": flown - start, "cpu": flown_cpu - start_cpu},
        "with_keys": {"seconds": end - flown, "cpu": end_cpu - flown_cpu},
    }


def glb(motion):
    """A .glb file, with the importer as this Blender has it."""
    empty_scene()
    found = {"error": run(bpy.ops.import_scene.gltf, filepath=motion)}
    found["meshes"] = sum(o.type == "MESH" for o in scene.objects)
    return found


def version():
    import samara
    from samara_addon import bl_info, samara_library

    return {
        "library": samara_library.version(),
        "bl_info": ".".join(map(str, bl_info["version"])),
        "package": samara.__file__,
    }


TASKS = (bake, render, crowd, glb, version)
