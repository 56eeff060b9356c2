"""Noise of Blender Cycles' random walk against CPU time, for comparison with `lychnite render --method walk`.

    blender --background --python tools/cycles_compare.py -- MODEL.ply SIZE_MM SAMPLES SEEDS

Renders the mesh in the fig6 material (docs/physics.md) with the Principled shader's random-walk subsurface scattering, lit
from behind (parallel:150,20) and seen by the default orbit camera, SEEDS times with different seeds, and prints the
standard error over the mean of the object's pixels (root mean square over pixels and channels, the walk's `noise`)
and the CPU seconds of one render.
"""
import math
import resource
import sys
import tempfile

import bpy
from mathutils import Matrix, Vector

FIG6_SCATTERING = (1.63, 2.41, 3.44)  # 1/mm
FIG6_ABSORPTION = (0.0125, 0.0206, 0.0487)
RESOLUTION = 600


def direction(azimuth, elevation):
    """Towards a light or camera, as docs/physics.md has it: azimuth 0 is +z, 90 is +x; y is up."""
    a, e = math.radians(azimuth), math.radians(elevation)
    return Vector((math.cos(e) * math.sin(a), math.sin(e), math.cos(e) * math.cos(a)))


def diffuse_colour(albedo):
    """The diffuse albedo of a half-space of this single-scattering albedo (van de Hulst's fit), which Cycles turns back."""
    s = math.sqrt(1 - albedo)
    return (1 - s) * (1 - 0.139 * s) / (1 + 1.17 * s)


def add_object(path, size_mm):
    bpy.ops.import_mesh.ply(filepath=path)
    thing = bpy.context.selected_objects[0]
    corners = [Vector(c) for c in thing.bound_box]
    low = Vector(min(c[i] for c in corners) for i in range(3))
    high = Vector(max(c[i] for c in corners) for i in range(3))
    centre, scale = (low + high) / 2, size_mm / max(high - low)
    for vertex in thing.data.vertices:
        vertex.co = (vertex.co - centre) * scale
    for polygon in thing.data.polygons:
        polygon.use_smooth = True
    thing.data.update()
    return thing, max(v.co.length for v in thing.data.vertices)


def add_material(thing):
    extinction = [s + a for s, a in zip(FIG6_SCATTERING, FIG6_ABSORPTION)]
    albedo = [s / t for s, t in zip(FIG6_SCATTERING, extinction)]
    material = bpy.data.materials.new("fig6")
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    colour = [diffuse_colour(a) for a in albedo] + [1]
    shader.inputs["Base Color"].default_value = colour
    shader.inputs["Subsurface Color"].default_value = colour
    shader.inputs["Subsurface"].default_value = 1
    # With a fixed radius, Cycles takes a quarter of it over pi for the mean free path.
    shader.inputs["Subsurface Radius"].default_value = [4 * math.pi / t for t in extinction]
    shader.inputs["Subsurface IOR"].default_value = 1.3
    shader.inputs["IOR"].default_value = 1.3
    shader.inputs["Specular"].default_value = 0
    shader.subsurface_method = "RANDOM_WALK_FIXED_RADIUS"
    thing.data.materials.clear()
    thing.data.materials.append(material)


def add_light_and_camera(radius):
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.data.angle = math.pi, 0
    sun.rotation_euler = direction(150, 20).to_track_quat("Z", "Y").to_euler()
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.sensor_fit, camera.data.angle = "VERTICAL", math.radians(30)
    towards = direction(0, 10)
    camera.location = towards * (radius / math.sin(math.radians(15)))
    right = Vector((0, 1, 0)).cross(towards).normalized()
    axes = Matrix((right, towards.cross(right), towards)).transposed()  # y is up
    camera.rotation_euler = axes.to_euler()
    camera.data.clip_start, camera.data.clip_end = radius / 100, radius * 100
    for thing in (sun, camera):
        bpy.context.collection.objects.link(thing)
    bpy.context.scene.camera = camera


def settings(samples):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.render.filter_size = 1
    scene.render.film_transparent = True
    scene.render.resolution_x = scene.render.resolution_y = RESOLUTION
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.world.use_nodes = False
    scene.world.color = (0, 0, 0)
    return scene


def cpu_seconds():
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def render(scene, seed):
    """Pixels of one render, RGBA after RGBA, and its CPU seconds."""
    scene.cycles.seed = seed
    scene.render.filepath = tempfile.mktemp(suffix=".exr")
    before = cpu_seconds()
    bpy.ops.render.render(write_still=True)
    seconds = cpu_seconds() - before
    image = bpy.data.images.load(scene.render.filepath)
    return list(image.pixels), seconds


def noise(pictures):
    """Root mean square of the standard error of one picture over the mean; where the object covers the pixel."""
    count = variance = total = 0
    for i in range(0, len(pictures[0]), 4):
        if pictures[0][i + 3] <= 0:
            continue
        for c in range(3):
            values = [p[i + c] for p in pictures]
            mean = sum(values) / len(values)
            variance += sum((v - mean) ** 2 for v in values) / (len(values) - 1)
            total += mean
            count += 1
    return math.sqrt(variance / count) / (total / count)


def main():
    path, size, samples, seeds = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.world = bpy.data.worlds.new("world")
    thing, radius = add_object(path, float(size))
    add_material(thing)
    add_light_and_camera(radius)
    scene = settings(int(samples))
    made = [render(scene, seed) for seed in range(1, int(seeds) + 1)]
    seconds = sum(s for _, s in made) / len(made)
    print(f"cycles: {samples} samples, noise {noise([p for p, _ in made]):.3f}, {seconds:.1f} CPU seconds")


main()
