#!/usr/bin/env python3
"""Lifts, travel and length of Voronoi toolpaths beside pcb2gcode's: benches/peers/pcb2gcode.py FOLDER...

FOLDER holds the copper files named below, at any depth; they are public (gerbv's and pcb2gcode's own examples). Prints the table of
docs/millproject.md. pcb2gcode 2.5.0 needs a desktop's libraries, so its figures were taken once and are kept here: each file as `--front` alone, with
`--voronoi --mill-diameters 0.2mm`, counted from its program. voromill's are those of target/release/voromill, as of its JSON report.
"""
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

VOROMILL = Path("target/release/voromill")
# Name, file, and what pcb2gcode makes of it: lifts, travel in mm, cut in mm.
BOARDS = [
    ("numpres", "numpres.pcb.output_group1.grb", 13, 193, 1026),
    ("rs232, bottom", "rs232_cm.bot", 6, 36, 240),
    ("rs232, top", "rs232_cm.top", 7, 41, 304),
    ("eaglecad1", "top-cop.gbx", 46, 388, 2294),
    ("dan", "top.gbx", 44, 263, 1315),
    ("visolate", "example.grb", 46, 343, 2291),
    ("multivibrator", "multivibrator-B.Cu.gbr", 7, 140, 381),
    ("d1mini, front", "D1MiniGSR-F_Cu.gbr", 5, 215, 255),
    ("project controller", "project-controller-B_Cu.gbr", 5, 104, 485),
]
# voromill's defaults: mm, mm/s, and the machine that it takes for granted.
FEED, PLUNGE, RAPID, RAPID_Z, ACCELERATION = 200 / 60, 100 / 60, 1500 / 60, 600 / 60, 50
SAFE, APPROACH, DEPTH = 2, 0.2, 0.1


def hop(way, speed):
    """Seconds from standstill to standstill."""
    ramp = speed * speed / ACCELERATION
    return way / speed + speed / ACCELERATION if way > ramp else 2 * math.sqrt(way / ACCELERATION)


def seconds(lifts, travel, cut):
    """The same sum for both programs; the way between lifts is taken for evenly long."""
    lift = hop(SAFE + DEPTH, RAPID_Z) + hop(SAFE - APPROACH, RAPID_Z) + hop(APPROACH + DEPTH, PLUNGE)
    return cut / FEED + lifts * (lift + hop(travel / lifts, RAPID))


def ours(path):
    with tempfile.TemporaryDirectory() as out:
        options = ["--tool", "endmill:0.2mm", "--no-html", "--no-verify", "--quiet", "-o", out]
        subprocess.run([VOROMILL, "mill", path, *options], check=True, stderr=subprocess.DEVNULL)
        report = next(Path(out).glob("*.json"))
        program = json.loads(report.read_text())["programs"][0]
    return program["lifts"], program["rapid_mm"], program["cut_mm"]


def main():
    folders = [Path(folder) for folder in sys.argv[1:]]
    print("| board | lifts | travel | cut | seconds |\n|---|---|---|---|---|")
    for name, file, *theirs in BOARDS:
        found = next((path for folder in folders for path in sorted(folder.rglob(file))), None)
        if found is None:
            print(f"{file} is in none of these folders", file=sys.stderr)
            continue
        pairs = zip(*((*figures, seconds(*figures)) for figures in (ours(found), theirs)))
        print(f"| {name} |", " | ".join(f"{a:.0f} : {b:.0f}" for a, b in pairs), "|")


if __name__ == "__main__":
    main()
