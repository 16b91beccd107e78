# Run by scripts/bench-cycles inside Blender: makes the glTF scene that both renderers read, and renders it with Cycles.
#   blender -b --factory-startup -P sphere_plane.py -- make SCENE.glb ROUGHNESS
#   blender -b --factory-startup -P sphere_plane.py -- render SCENE.glb MAP.hdr ROUGHNESS SIZE SAMPLES SEED THREADS OUT.exr
# Cycles is set up to solve the same problem: Lambert and GGX without Fresnel, box pixel filter, texels as constant
# patches, no adaptive sampling, no denoiser, no clamping, no caustics switched off, no filmic view.
import json
import struct
import sys
import time

import bpy
import numpy

numpy.bool = bool  # Debian's importer asks for the name that Debian's NumPy dropped


def make_scene(path, roughness):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_plane_add(size=24)
    plane = bpy.context.object
    bpy.ops.mesh.primitive_uv_sphere_add(segments=256, ring_count=128, radius=1, location=(0, 0, 1))
    bpy.ops.object.shade_smooth()
    sphere = bpy.context.object
    for thing, name, metallic, colour, rough in ((plane, "plane", 0, (0.5, 0.5, 0.5, 1), 1),
                                                 (sphere, "sphere", 1, (1, 1, 1, 1), roughness)):
        material = bpy.data.materials.new(name)
        material.use_nodes = True
        shader = material.node_tree.nodes["Principled BSDF"]
        shader.inputs["Base Color"].default_value = colour
        shader.inputs["Metallic"].default_value = metallic
        shader.inputs["Roughness"].default_value = rough
        thing.data.materials.append(material)
    camera = bpy.data.cameras.new("camera")
    camera.angle = 0.7
    viewer = bpy.data.objects.new("camera", camera)
    viewer.location, viewer.rotation_euler = (0, -5, 2.2), (1.35, 0, 0)
    bpy.context.collection.objects.link(viewer)
    bpy.context.scene.camera = viewer
    bpy.context.scene.render.resolution_x = bpy.context.scene.render.resolution_y = 256
    bpy.ops.export_scene.gltf(filepath=path, export_format="GLB", export_cameras=True)
    without_dielectric_reflection(path)


# KHR_materials_ior with 1 leaves the plane Lambert's law alone.
def without_dielectric_reflection(path):
    with open(path, "rb") as file:
        data = file.read()
    size = struct.unpack_from("<I", data, 12)[0]
    document, rest = json.loads(data[20:20 + size]), data[20 + size:]
    for material in document["materials"]:
        material.setdefault("extensions", {})["KHR_materials_ior"] = {"ior": 1.0}
    document.setdefault("extensionsUsed", []).append("KHR_materials_ior")
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(rest)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text + rest)


def replace_shader(material, roughness):
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    if material.name.startswith("sphere"):
        shader = nodes.new("ShaderNodeBsdfGlossy")
        shader.distribution = "GGX"
        shader.inputs["Color"].default_value = (1, 1, 1, 1)
        shader.inputs["Roughness"].default_value = roughness
    else:
        shader = nodes.new("ShaderNodeBsdfDiffuse")
        shader.inputs["Color"].default_value = (0.5, 0.5, 0.5, 1)
    links.new(shader.outputs[0], output.inputs["Surface"])


def light_by(map_path):
    world = bpy.data.worlds.new("world")
    bpy.context.scene.world = world
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    texture = nodes.new("ShaderNodeTexEnvironment")
    texture.image = bpy.data.images.load(map_path)
    texture.interpolation = "Closest"
    links.new(texture.outputs["Color"], nodes["Background"].inputs["Color"])
    world.cycles.sampling_method = "MANUAL"
    world.cycles.sample_map_resolution = texture.image.size[0]


def set_up(size, samples, seed, threads):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.render.threads_mode, scene.render.threads = "FIXED", threads
    scene.cycles.samples, scene.cycles.seed = samples, seed
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 1.0
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = scene.cycles.glossy_bounces = 64
    scene.cycles.sample_clamp_direct = scene.cycles.sample_clamp_indirect = 0
    scene.cycles.caustics_reflective, scene.cycles.blur_glossy = True, 0
    scene.cycles.light_sampling_threshold = 0
    scene.render.resolution_x = scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    scene.render.use_compositing = scene.render.use_sequencer = False
    scene.view_settings.view_transform = "Raw"
    picture = scene.render.image_settings
    picture.file_format, picture.color_mode, picture.color_depth = "OPEN_EXR", "RGB", "32"


def render(scene_path, map_path, roughness, size, samples, seed, threads, out):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=scene_path)
    for material in bpy.data.materials:
        if material.use_nodes:
            replace_shader(material, roughness)
    bpy.context.scene.camera = next(o for o in bpy.data.objects if o.type == "CAMERA")
    light_by(map_path)
    set_up(size, samples, seed, threads)
    bpy.context.scene.render.filepath = out
    start = time.monotonic()
    bpy.ops.render.render(write_still=True)
    print(f"cycles seconds {time.monotonic() - start:.3f}")


arguments = sys.argv[sys.argv.index("--") + 1:]
if arguments[0] == "make":
    make_scene(arguments[1], float(arguments[2]))
else:
    a = arguments[1:]
    render(a[0], a[1], float(a[2]), int(a[3]), int(a[4]), int(a[5]), int(a[6]), a[7])
