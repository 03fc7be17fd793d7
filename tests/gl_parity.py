#!/usr/bin/env python3
"""Draws the raster engine's triangles with a headless OpenGL and compares label buffers.

usage: gl_parity.py FOLDER

FOLDER is what `VOROMILL_GL_PARITY=FOLDER cargo test --test it an_opengl_gets_the_same` wrote. Needs Mesa's
llvmpipe (Debian: libegl1 libgl1-mesa-dri) and, from PyPI, moderngl and numpy. This is a program of its own because
calling OpenGL takes `unsafe`, which the crate forbids.

Flat scenes must agree in every pixel. In distance meshes a label may differ only where the two depths tie within what
the depth formats can tell apart; such pixels are counted.
"""
import sys
from pathlib import Path

import moderngl
import numpy as np

SIDE = 128
# The picture lies in the middle of a larger buffer: an OpenGL may cut a triangle at the edge of its viewport, and rounds
# the corners it makes there once more.
BUFFER = 512
MARGIN = (BUFFER - SIDE) // 2
DEEPEST = 64.0
# A step of the 24 bit depth buffer, doubled for the rounding of either interpolation, in depth units; and the single
# precision with which an OpenGL interpolates depths.
STEP = 2 * DEEPEST / 2**24 + 4 * DEEPEST / 2**24

VERTEX = """#version 330
in vec2 place; in float depth; in uint label; flat out uint shown;
void main() { gl_Position = vec4(place, depth, 1.0); shown = label; }"""
FRAGMENT = """#version 330
flat in uint shown; out uint label;
void main() { label = shown; }"""


def draw(context, program, triangles):
    """The label buffer of an OpenGL; nearer fragments first, of equal depths the first drawn."""
    labels = context.texture((BUFFER, BUFFER), 1, dtype="u4")
    depths = context.depth_texture((BUFFER, BUFFER))
    target = context.framebuffer([labels], depths)
    target.use()
    target.clear(depth=1.0)
    labels.write(np.zeros(BUFFER * BUFFER, dtype="u4").tobytes())
    context.enable_only(context.DEPTH_TEST)
    context.depth_func = "<"
    order = np.argsort(triangles[:, 0], kind="stable")
    triangles = triangles[order]
    rows = np.zeros(len(triangles) * 3, dtype=[("place", "2f4"), ("depth", "f4"), ("label", "u4")])
    # Row 0 of the engine is row 0 of the buffer. All of it is exact in single precision: the side is a power of two.
    rows["place"] = (triangles[:, 1:7].reshape(-1, 2) + MARGIN * 256) / (BUFFER * 128.0) - 1.0
    rows["depth"] = triangles[:, 7:10].reshape(-1) / (DEEPEST / 2) - 1.0
    rows["label"] = np.repeat(triangles[:, 0].astype("u4"), 3)
    buffer = context.buffer(rows.tobytes())
    context.vertex_array(program, [(buffer, "2f 1f 1u4", "place", "depth", "label")]).render()
    inner = slice(MARGIN, MARGIN + SIDE)
    out = np.frombuffer(labels.read(), dtype="u4").reshape(BUFFER, BUFFER)[inner, inner].copy()
    deep = np.frombuffer(depths.read(), dtype="f4").reshape(BUFFER, BUFFER)[inner, inner] * DEEPEST
    for thing in (target, labels, depths, buffer):
        thing.release()
    return out, deep


# Fans around the first corner, each triangle counted forwards or backwards: where the sum is not zero, the non-zero rule
# fills a contour of any form.
WINDING_VERTEX = """#version 330
in vec2 place;
void main() { gl_Position = vec4(place, 0.0, 1.0); }"""
WINDING_FRAGMENT = """#version 330
out float winding;
void main() { winding = gl_FrontFacing ? 1.0 : -1.0; }"""
BOARD_BUFFER = 2048
BOARD_MARGIN = 256


def compare_board(context, path):
    """Draws the polygons of a board one by one; the number of pixels that differ."""
    (width, height), *lines = [line.split() for line in path.read_text().splitlines()]
    width, height = int(width), int(height)
    program = context.program(vertex_shader=WINDING_VERTEX, fragment_shader=WINDING_FRAGMENT)
    windings = context.texture((BOARD_BUFFER, BOARD_BUFFER), 1, dtype="f4")
    target = context.framebuffer([windings])
    target.use()
    context.enable_only(context.BLEND)
    context.blend_func = context.ONE, context.ONE
    polygons = []
    for first, *corners in lines:
        contour = np.array(corners, dtype="f8").reshape(-1, 2)
        fan = np.stack([np.repeat(contour[:1], len(contour) - 2, 0), contour[1:-1], contour[2:]], 1).reshape(-1, 2)
        if first == "also":
            polygons[-1][1].append(fan)
        else:
            polygons.append((int(first), [fan]))
    theirs = np.zeros((height, width), dtype="u4")
    for label, fans in reversed(polygons):
        target.clear()
        place = (np.concatenate(fans) + BOARD_MARGIN * 256) / (BOARD_BUFFER * 128.0) - 1.0
        buffer = context.buffer(place.astype("f4").tobytes())
        context.vertex_array(program, [(buffer, "2f", "place")]).render()
        sums = np.frombuffer(windings.read(), dtype="f4").reshape(BOARD_BUFFER, BOARD_BUFFER)
        rows, columns = slice(BOARD_MARGIN, BOARD_MARGIN + height), slice(BOARD_MARGIN, BOARD_MARGIN + width)
        theirs[sums[rows, columns] != 0] = label
        buffer.release()
    for thing in (target, windings, program):
        thing.release()
    ours = np.fromfile(path.with_suffix(".labels"), dtype="<u4").reshape(height, width)
    differ = int((ours != theirs).sum())
    print(f"{path.stem}: {len(polygons)} polygons, {width * height} pixels, {differ} differ")
    return differ


def main():
    context = moderngl.create_standalone_context(backend="egl")
    print("OpenGL:", context.info["GL_RENDERER"], context.info["GL_VERSION"])
    program = context.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT)
    folder = Path(sys.argv[1])
    scenes = {"flat": 0, "mesh": 0}
    wrong = {"flat": 0, "mesh": 0}
    ties = {"flat": 0, "mesh": 0}
    boards = sum(compare_board(context, path) for path in sorted(folder.glob("*.polygons")))
    for path in sorted(folder.glob("*.triangles")):
        kind = path.name.split("_")[0]
        triangles = np.loadtxt(path, ndmin=2)
        ours = np.fromfile(path.with_suffix(".labels"), dtype="<u4").reshape(SIDE, SIDE)
        our_depths = np.fromfile(path.with_suffix(".depths"), dtype="<f4").reshape(SIDE, SIDE)
        theirs, their_depths = draw(context, program, triangles)
        differs = ours != theirs
        tied = differs & (np.abs(our_depths - their_depths) <= STEP) & (kind == "mesh")
        scenes[kind] += 1
        ties[kind] += int(tied.sum())
        wrong[kind] += int((differs & ~tied).sum())
    for kind, count in scenes.items():
        pixels = count * SIDE * SIDE
        print(f"{kind}: {count} scenes, {pixels} pixels, {wrong[kind]} differ, {ties[kind]} more where depths tie")
    sys.exit(0 if sum(scenes.values()) and not any(wrong.values()) and not boards else 1)


if __name__ == "__main__":
    main()
