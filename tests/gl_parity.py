#!/usr/bin/env python3
"""Draws the raster engine's triangles with a headless OpenGL and compares label buffers.

usage: gl_parity.py FOLDER

FOLDER is what `VOROMILL_GL_PARITY=FOLDER cargo test --test it an_opengl_gets_the_same_triangles` wrote. Needs Mesa's
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


def main():
    context = moderngl.create_standalone_context(backend="egl")
    print("OpenGL:", context.info["GL_RENDERER"], context.info["GL_VERSION"])
    program = context.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT)
    folder = Path(sys.argv[1])
    scenes = {"flat": 0, "mesh": 0}
    wrong = {"flat": 0, "mesh": 0}
    ties = {"flat": 0, "mesh": 0}
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
    sys.exit(0 if sum(scenes.values()) and not any(wrong.values()) else 1)


if __name__ == "__main__":
    main()
