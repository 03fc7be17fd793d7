#!/usr/bin/env python3
"""The whole program beside what public registries have for parts of its work, on the same copper files.

usage: benches/peers/mill.py [FILE...]     (from the root of the project; installs what it needs under target/peers)

Without files it takes the copper of the fixture boards. Each row is a process of its own; its CPU seconds (user and
system) and peak memory are printed, and CPU as a multiple of voromill's for the same work, which uses all cores:

  read        gerbonara and pygerber (PyPI) parse the file       beside `voromill inspect`, which finds the nets, too
  picture     gerbv (Debian) draws the copper at 1000 DPI        beside `voromill draw --stage copper`
  isolation   shapely (PyPI, GEOS): union of gerbonara's shapes and buffers, the way FlatCAM isolates,
              and pyvoronoi (PyPI, Boost's segment Voronoi diagram, what pcb2gcode's --voronoi rests on) of the
              union's outlines                                    beside `voromill isolate`

pcb2gcode, FlatCAM and Visolate themselves are in neither registry in a form that runs without a desktop.
"""
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

FOLDER = Path("target/peers")
PYTHON = FOLDER / "mill/bin/python"
PACKAGES = ["gerbonara", "pygerber", "shapely", "pyvoronoi"]
VOROMILL = Path("target/release/voromill")
TOOL = 0.2


def install():
    if not PYTHON.exists():
        subprocess.check_call([sys.executable, "-m", "venv", FOLDER / "mill"])
    subprocess.check_call([PYTHON, "-m", "pip", "install", "-q", *PACKAGES])
    subprocess.check_call(["cargo", "build", "--release", "--quiet"])
    return gerbv()


def gerbv():
    """A command that runs gerbv and its environment: the system's own, or Debian's packages unpacked; none elsewhere."""
    if found := shutil.which("gerbv"):
        return [found], None
    if not shutil.which("apt-get"):
        return None
    root = (FOLDER / "debian").resolve()
    if not (root / "usr/bin/gerbv").exists():
        missing = subprocess.run(
            ["apt-get", "install", "--print-uris", "-qq", "gerbv"], capture_output=True, text=True
        ).stdout.splitlines()
        names = [line.split()[1].split("_")[0] for line in missing]
        root.mkdir(parents=True, exist_ok=True)
        if not names or subprocess.run(["apt-get", "download", "-qq", *names], cwd=root).returncode:
            return None
        for package in root.glob("*.deb"):
            subprocess.check_call(["dpkg", "-x", package, root])
    libraries = ":".join(str(path) for path in [*root.glob("usr/lib/*-linux-*"), root / "usr/lib"])
    return [root / "usr/bin/gerbv"], {**os.environ, "LD_LIBRARY_PATH": libraries}


def copper_files(folder):
    told = subprocess.run([VOROMILL, "inspect", "--format", "json", folder], capture_output=True, text=True).stdout
    sources = json.loads(told)["sources"]
    return [folder / source["file"] for source in sources if source["role"].endswith("copper")]


def measure(command, env=None):
    """CPU seconds and peak MiB of a process; none where it fails."""
    with open(os.devnull, "w") as nothing:
        process = subprocess.Popen([str(part) for part in command], stdout=nothing, stderr=nothing, env=env)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = status
    if status:
        return None
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def least(command, env=None, rounds=3):
    runs = [measure(command, env) for _ in range(rounds)]
    return None if None in runs else (min(run[0] for run in runs), min(run[1] for run in runs))


def row(work, name, ours, figures):
    if figures is None:
        print(f"  {work:10} {name:34} failed")
        return
    seconds, memory = figures
    print(f"  {work:10} {name:34} {seconds:8.3f} s {memory:7.0f} MiB   {seconds / ours[0]:6.1f} x")


def compare(path, gerbv_command):
    work = FOLDER / "work"
    work.mkdir(exist_ok=True)
    print(path)
    ours = least([VOROMILL, "inspect", path, "-q"])
    row("read", "voromill inspect", ours, ours)
    for peer in ("gerbonara", "pygerber"):
        row("read", peer, ours, least([PYTHON, __file__, "--child", peer, path]))
    ours = least([VOROMILL, "draw", path, "--stage", "copper", "--dpi", "1000", "-q", "-o", work / "ours.png"])
    row("picture", "voromill draw", ours, ours)
    if gerbv_command:
        command, env = gerbv_command
        row("picture", "gerbv", ours, least([*command, "-x", "png", "-D", "1000", "-o", work / "gerbv.png", path], env))
    ours = least([VOROMILL, "isolate", path, "--tool", f"endmill:{TOOL}mm", "-q", "-o", work / "ours.ngc"])
    row("isolation", "voromill isolate", ours, ours)
    for peer in ("shapely", "pyvoronoi"):
        row("isolation", peer, ours, least([PYTHON, __file__, "--child", peer, path]))


# What the peers do, each in a process of its own.


def shapes(path):
    """The file's shapes as gerbonara sees them, as shapely polygons in millimetres, dark and clear."""
    from gerbonara import GerberFile
    from shapely.geometry import LineString, Point, Polygon, box
    from shapely.affinity import rotate

    for thing in GerberFile.open(path).objects:
        for shape in thing.to_primitives("mm"):
            kind = type(shape).__name__
            if kind == "Circle":
                made = Point(shape.x, shape.y).buffer(shape.r)
            elif kind == "Line":
                made = LineString([(shape.x1, shape.y1), (shape.x2, shape.y2)]).buffer(shape.width / 2)
            elif kind == "Rectangle":
                made = box(shape.x - shape.w / 2, shape.y - shape.h / 2, shape.x + shape.w / 2, shape.y + shape.h / 2)
                made = rotate(made, shape.rotation, use_radians=True)
            elif kind == "ArcPoly":
                made = Polygon(shape.outline).buffer(0)
            else:
                continue
            yield shape.polarity_dark, made


def copper(path):
    """Dark less clear, in the order of the file."""
    from shapely import unary_union

    whole, run, dark = None, [], True
    for is_dark, shape in [*shapes(path), (None, None)]:
        if is_dark != dark and run:
            part = unary_union(run)
            whole = part if whole is None else whole.union(part) if dark else whole.difference(part)
            run = []
        dark = is_dark
        run.append(shape)
    return whole


def outlines(whole):
    parts = getattr(whole, "geoms", [whole])
    return [ring for part in parts for ring in (part.exterior, *part.interiors)]


def child(peer, path):
    if peer == "gerbonara":
        from gerbonara import GerberFile

        list(GerberFile.open(path).objects)
    elif peer == "pygerber":
        from pygerber.gerberx3.api.v2 import GerberFile as Parsed

        Parsed.from_file(path).parse()
    elif peer == "shapely":
        [ring.length for ring in outlines(copper(path).buffer(TOOL / 2))]
    else:
        import pyvoronoi

        diagram = pyvoronoi.Pyvoronoi(1_000_000)
        for ring in outlines(copper(path)):
            points = list(ring.coords)
            for start, end in zip(points, points[1:]):
                diagram.AddSegment([start, end])
        diagram.Construct()
        diagram.GetEdges()


if __name__ == "__main__":
    if sys.argv[1:2] == ["--child"]:
        child(*sys.argv[2:])
    else:
        drawn = install()
        files = [Path(name) for name in sys.argv[1:]]
        for board in sorted(Path("fixtures/boards").iterdir()) if not files else []:
            if board.is_dir():
                files += copper_files(board)
        for path in files:
            compare(path, drawn)
