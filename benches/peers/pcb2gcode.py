#!/usr/bin/env python3
"""Voronoi toolpaths and what making them takes beside pcb2gcode's: benches/peers/pcb2gcode.py FOLDER...

FOLDER holds the copper files named below, at any depth; they are public (gerbv's and pcb2gcode's own examples). Prints the table of
docs/millproject.md (retracts, travel, length and time of the cuts), and those of benches/README.md (CPU time and memory of making them).
pcb2gcode 2.5.0 needs a desktop's libraries, so its figures were taken once and are kept here: each file as `--front` alone, with
`--mill-diameters 0.2mm`, with and without `--voronoi`, counted from its program. voromill's are those of target/release/voromill, as of
its JSON report.
"""
import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

VOROMILL = Path("target/release/voromill")
# Name, file, what pcb2gcode makes of it (retracts, travel in mm, cut in mm), and what it takes (CPU seconds, the least of four runs; peak MiB)
# for Voronoi regions and for outlines.
BOARDS = [
    ("numpres", "numpres.pcb.output_group1.grb", 13, 193, 1026, (0.27, 24), (0.32, 23)),
    ("rs232, bottom", "rs232_cm.bot", 6, 36, 240, (0.06, 18), (0.06, 18)),
    ("rs232, top", "rs232_cm.top", 7, 41, 304, (0.1, 19), (0.12, 20)),
    ("eaglecad1", "top-cop.gbx", 46, 388, 2294, (0.57, 38), (0.69, 38)),
    ("dan", "top.gbx", 44, 263, 1315, (0.37, 27), (0.5, 30)),
    ("visolate", "example.grb", 46, 343, 2291, (0.75, 44), (0.79, 44)),
    ("multivibrator", "multivibrator-B.Cu.gbr", 7, 140, 381, (0.07, 18), (0.08, 18)),
    ("d1mini, front", "D1MiniGSR-F_Cu.gbr", 5, 215, 255, (0.08, 17), (0.08, 17)),
    ("project controller", "project-controller-B_Cu.gbr", 5, 104, 485, (0.11, 33), (0.11, 32)),
]
# The same 1 mm wide, in nine passes: its outline mode's CPU seconds and retracts.
WIDE = {"numpres": (6.3, 22), "eaglecad1": (18.6, 57), "dan": (12.3, 51)}
# voromill's defaults: mm, mm/s, and the machine that it takes for granted.
FEED, PLUNGE, RAPID, RAPID_Z, ACCELERATION = 200 / 60, 100 / 60, 1500 / 60, 600 / 60, 50
SAFE, APPROACH, DEPTH = 2, 0.2, 0.1


def hop(way, speed):
    """Seconds from standstill to standstill."""
    ramp = speed * speed / ACCELERATION
    return way / speed + speed / ACCELERATION if way > ramp else 2 * math.sqrt(way / ACCELERATION)


def seconds(retracts, travel, cut):
    """The same sum for both programs; the way between retracts is taken for evenly long."""
    lift = hop(SAFE + DEPTH, RAPID_Z) + hop(SAFE - APPROACH, RAPID_Z) + hop(APPROACH + DEPTH, PLUNGE)
    return cut / FEED + retracts * (lift + hop(travel / retracts, RAPID))


def ours(path, *more):
    with tempfile.TemporaryDirectory() as out:
        options = ["--tool", "endmill:0.2mm", "--no-html", "--no-verify", "--quiet", "-o", out, *more]
        subprocess.run([VOROMILL, "mill", "--front", path, *options], check=True, stderr=subprocess.DEVNULL)
        report = next(Path(out).glob("*.json"))
        program = json.loads(report.read_text())["programs"][0]
    return program["retracts"], program["rapid_mm"], program["cut_mm"]


def usage(path, *more):
    """CPU seconds, the least of seven runs on one thread, and peak MiB."""
    runs = []
    with tempfile.TemporaryDirectory() as out:
        command = [VOROMILL, "isolate", "--front", path, "--tool", "endmill:0.2mm", "-q", "-j", "1", "-o", Path(out) / "x.ngc", *more]
        for _ in range(7):
            process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
            _, status, used = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            runs.append((used.ru_utime + used.ru_stime, used.ru_maxrss / 1024))
    return min(seconds for seconds, _ in runs), max(memory for _, memory in runs)


def main():
    folders = [Path(folder) for folder in sys.argv[1:]]
    found = []
    for name, file, *theirs in BOARDS:
        path = next((path for folder in folders for path in sorted(folder.rglob(file))), None)
        if path is None:
            print(f"{file} is in none of these folders", file=sys.stderr)
        else:
            found.append((name, path, theirs))
    print("| board | retracts | travel | cut | seconds |\n|---|---|---|---|---|")
    for name, path, (*theirs, _, _) in found:
        pairs = zip(*((*figures, seconds(*figures)) for figures in (ours(path), theirs)), strict=True)
        print(f"| {name} |", " | ".join(f"{a:.0f} : {b:.0f}" for a, b in pairs), "|")
    print("\n| board | Voronoi, CPU s | × | MiB | outline, CPU s | × | MiB |\n|---|---|---|---|---|---|---|")
    cuts = {}
    for name, path, (*_, regions, outlines) in found:
        cells = []
        for options, (cpu, memory) in (([], regions), (["--strategy", "outline"], outlines)):
            spent, peak = usage(path, *options)
            cuts.setdefault(name, spent)
            cells += [f"{spent:.3f} : {cpu}", f"{cpu / spent:.0f}", f"{peak:.0f} : {memory}"]
        print(f"| {name} |", " | ".join(cells), "|")
    print("\n| | one cut | 1 mm wide | × one cut | retracts | pcb2gcode | its retracts | × |\n|---|---|---|---|---|---|---|---|")
    for name, path, _ in found:
        if name in WIDE:
            options, (cpu, lifts) = ["--width", "1mm", "--overlap", "0.1mm"], WIDE[name]
            (spent, peak), cut = usage(path, *options), cuts[name]
            retracts = ours(path, *options)[0]
            wide = f"{spent:.3f} s, {peak:.0f} MiB | {spent / cut:.0f} | {retracts}"
            print(f"| {name} | {cut:.3f} s | {wide} | {cpu} s | {lifts} | {cpu / spent:.0f} |")


if __name__ == "__main__":
    main()
