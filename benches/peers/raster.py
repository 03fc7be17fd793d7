#!/usr/bin/env python3
"""The raster engine beside what one would otherwise take for nearest-site pictures.

usage: benches/peers/raster.py            (from the root of the project; installs what it needs under target/peers)

Two threads each where the other can. SciPy, OpenCV and edt start from the sites drawn as pixels, as they must; a label
counts as wrong where another segment is nearer by more than half a pixel, which is what that costs at most, and is
listed as "off" where it differs at all. llvmpipe draws the same cones (64 sides) and curtains as triangles.
"""
import os
import subprocess
import sys
import time
from pathlib import Path

FOLDER = Path("target/peers")
PYTHON = FOLDER / "venv/bin/python"
PACKAGES = ["numpy", "scipy", "opencv-python-headless", "edt", "moderngl"]


def install():
    if not PYTHON.exists():
        subprocess.check_call([sys.executable, "-m", "venv", FOLDER / "venv"])
    subprocess.check_call([PYTHON, "-m", "pip", "install", "-q", *PACKAGES])


def least(rounds, work):
    best = float("inf")
    for _ in range(rounds):
        start = time.perf_counter()
        result = work()
        best = min(best, time.perf_counter() - start)
    return best, result


def load(name, side):
    import numpy as np

    segments = np.loadtxt(FOLDER / f"{name}.segments")
    labels = np.fromfile(FOLDER / f"{name}.labels", dtype="<u4").reshape(side, side)
    return segments, labels, float((FOLDER / f"{name}.time").read_text())


def sites(segments, side):
    """Zero beside the label of a segment on the pixels it passes through, sampled four times a pixel."""
    import numpy as np

    labels = np.zeros((side, side), dtype="u4")
    for label, x0, y0, x1, y1 in segments[::-1]:
        steps = int(4 * max(abs(x1 - x0), abs(y1 - y0))) + 1
        t = np.linspace(0.0, 1.0, steps + 1)
        column = np.clip((x0 + t * (x1 - x0)).astype(int), 0, side - 1)
        row = np.clip((y0 + t * (y1 - y0)).astype(int), 0, side - 1)
        labels[row, column] = int(label)
    return labels


def distance(segments, index, xs, ys):
    """From pixel centres to the segments at `index`, in double precision."""
    import numpy as np

    _, x0, y0, x1, y1 = segments[index].T
    dx, dy = x1 - x0, y1 - y0
    length = np.maximum(dx * dx + dy * dy, 1e-300)
    t = np.clip(((xs - x0) * dx + (ys - y0) * dy) / length, 0.0, 1.0)
    return np.hypot(xs - x0 - t * dx, ys - y0 - t * dy)


def nearest(segments, side):
    """Brute force: the distance to the nearest segment at every pixel centre."""
    import numpy as np

    best = np.full((side, side), np.inf)
    ys, xs = np.mgrid[0:side, 0:side] + 0.5
    for number in range(len(segments)):
        best = np.minimum(best, distance(segments, np.array([number]), xs, ys))
    return best


def judge(segments, labels, best):
    """Shares of pixels whose label is off, and off by more than half a pixel, in percent."""
    import numpy as np

    side = len(labels)
    ys, xs = np.mgrid[0:side, 0:side] + 0.5
    off = np.empty((side, side))
    for row in range(side):
        off[row] = distance(segments, labels[row].astype(int) - 1, xs[row], ys[row]) - best[row]
    return 100 * (off > 1e-3).mean(), 100 * (off > 0.5).mean()


def peers():
    """Name and a function from a picture of sites to the picture of nearest labels."""
    import cv2
    import edt
    import numpy as np
    from scipy import ndimage

    cv2.setNumThreads(2)

    def scipy_labels(drawn):
        _, (rows, columns) = ndimage.distance_transform_edt(drawn == 0, return_indices=True)
        return drawn[rows, columns]

    def opencv_labels(mask):
        def run(drawn):
            source = np.where(drawn == 0, 255, 0).astype("u1")
            _, nearest_pixel = cv2.distanceTransformWithLabels(
                source, cv2.DIST_L2, mask, labelType=cv2.DIST_LABEL_PIXEL
            )
            table = np.zeros(nearest_pixel.max() + 1, dtype="u4")
            table[nearest_pixel[drawn > 0]] = drawn[drawn > 0]
            return table[nearest_pixel]

        return run

    def edt_distances(drawn):
        edt.edt(drawn == 0, parallel=2)

    yield "SciPy distance_transform_edt", scipy_labels
    yield "OpenCV distanceTransformWithLabels, 5 x 5", opencv_labels(cv2.DIST_MASK_5)
    yield "edt, distances alone", edt_distances


def triangles(segments, limit, deepest):
    """Cones of 64 sides at both ends and a roof of two strips: (place, depth, label) by vertex."""
    import numpy as np

    parts = []
    label, x0, y0, x1, y1 = segments.T
    turn = np.linspace(0.0, 2 * np.pi, 65)
    for x, y in ((x0, y0), (x1, y1)):
        rim = [np.stack([x + limit * np.cos(a), y + limit * np.sin(a), np.full_like(x, limit)], 1) for a in turn]
        apex = np.stack([x, y, np.zeros_like(x)], 1)
        for a, b in zip(rim, rim[1:]):
            parts.append(np.stack([apex, a, b], 1))
    length = np.maximum(np.hypot(x1 - x0, y1 - y0), 1e-9)
    nx, ny = -(y1 - y0) / length * limit, (x1 - x0) / length * limit
    zero, far = np.zeros_like(x0), np.full_like(x0, limit)
    for sign in (1, -1):
        corners = [(x0, y0, zero), (x1, y1, zero), (x1 + sign * nx, y1 + sign * ny, far), (x0 + sign * nx, y0 + sign * ny, far)]
        a, b, c, d = (np.stack(corner, 1) for corner in corners)
        parts += [np.stack([a, b, c], 1), np.stack([a, c, d], 1)]
    corners = np.concatenate(parts).reshape(-1, 3)
    return corners, np.repeat(np.tile(label, len(parts)), 3)


def llvmpipe(segments, side, limit):
    """Seconds that OpenGL takes to draw the segments' meshes, and its label picture."""
    import moderngl
    import numpy as np

    context = moderngl.create_standalone_context(backend="egl")
    program = context.program(
        vertex_shader="""#version 330
        in vec3 place; in uint label; flat out uint shown;
        void main() { gl_Position = vec4(place, 1.0); shown = label; }""",
        fragment_shader="""#version 330
        flat in uint shown; out uint label;
        void main() { label = shown; }""",
    )
    corners, label = triangles(segments, limit, limit)
    rows = np.zeros(len(corners), dtype=[("place", "3f4"), ("label", "u4")])
    rows["place"][:, :2] = corners[:, :2] * 2 / side - 1
    rows["place"][:, 2] = corners[:, 2] * 2 / (limit * 1.001) - 1
    rows["label"] = label
    picture = context.texture((side, side), 1, dtype="u4")
    target = context.framebuffer([picture], context.depth_texture((side, side)))
    target.use()
    context.enable_only(context.DEPTH_TEST)
    mesh = context.vertex_array(program, [(context.buffer(rows.tobytes()), "3f 1u4", "place", "label")])

    def draw():
        target.clear(depth=1.0)
        mesh.render()
        context.finish()

    draw()
    seconds, _ = least(3, draw)
    labels = np.frombuffer(picture.read(), dtype="u4").reshape(side, side)
    return context.info["GL_RENDERER"], len(corners) // 3, seconds, labels


def compare():
    import numpy as np

    segments, ours, our_time = load("small", 1024)
    large, _, our_large = load("large", 4096)
    best = nearest(segments, 1024)
    drawn, drawn_large = sites(segments, 1024), sites(large, 4096)
    print(f"{'':44} 1024² ms  4096² ms   ratio   off %  wrong %")

    def row(name, small, big, verdict):
        print(f"{name:44} {small * 1e3:8.1f} {big * 1e3:9.1f} {big / our_large:7.1f}   " + verdict)

    row("voromill", our_time, our_large, "{:5.3f}  {:7.3f}".format(*judge(segments, ours, best)))
    for name, run in peers():
        small, labels = least(3, lambda: run(drawn))
        big, _ = least(2, lambda: run(drawn_large))
        verdict = "no labels" if labels is None else "{:5.3f}  {:7.3f}".format(*judge(segments, labels, best))
        row(name, small, big, verdict)
    limited, ours, our_time = load("limited", 4096)
    renderer, count, seconds, labels = llvmpipe(limited, 4096, 300.0)
    differ = 100 * np.mean(labels != ours)
    print(f"{renderer}: {count} triangles, limit 300 pixels, 4096²: {seconds * 1e3:.0f} ms")
    print(f"voromill, the same surfaces: {our_time * 1e3:.1f} ms: {seconds / our_time:.0f} x; {differ:.2f} % of the labels differ (64-sided cones)")


if __name__ == "__main__":
    if os.environ.get("VOROMILL_PEERS_INSTALLED"):
        compare()
    else:
        install()
        subprocess.check_call(["cargo", "bench", "--bench", "raster"], env={**os.environ, "VOROMILL_PEERS": str(FOLDER.resolve())})
        subprocess.check_call([PYTHON, __file__], env={**os.environ, "VOROMILL_PEERS_INSTALLED": "1", "LP_NUM_THREADS": "2"})
