#!/usr/bin/env python3
"""The order of random trails by LKH, beside which `cargo bench --bench order` can be read: benches/peers/order.py COUNT [TRIALS]

The trails are those of the bench. LKH (K. Helsgaun, An effective implementation of the Lin-Kernighan traveling salesman heuristic, 2000) comes
with the Python package LKHpy, installed into target/peers. Each trail is an edge that its tour must have; the tour also passes home, and
the dearer of the two ways there is taken out, so that what is left begins at home as the program does.
"""
import math
import os
import subprocess
import sys
import time
from pathlib import Path

FOLDER = Path("target/peers")
PYTHON = FOLDER / "order/bin/python"
# CPU seconds; what is found by then counts.
LIMIT = 3600
# LKHpy 0.0.9 takes 40 808 bytes for LKH's hash table and writes past them, which kills it from some thousand trails on: they are made more.
ROOM = "#include <stddef.h>\nextern void *__libc_malloc(size_t);\nvoid *malloc(size_t n) { return __libc_malloc(n == 40808 ? n + (1 << 21) : n); }\n"


def trails(count):
    """As `scattered` in benches/order.rs makes them, in nanometres."""
    state, mask = 88_172_645_463_325_252, 2**64 - 1

    def draw(below):
        nonlocal state
        state = (state ^ state << 13) & mask
        state ^= state >> 7
        state = (state ^ state << 17) & mask
        return (state >> 1) % below

    side, reach = 2_000_000 * math.isqrt(count), 4_000_000
    for _ in range(count):
        x, y = draw(side), draw(side)
        yield (x, y), (x + draw(reach) - reach // 2, y + draw(reach) - reach // 2)


def solve(count, trials):
    import LKHpy

    ends = [end for trail in trails(count) for end in trail]
    points = [(0, 0), *ends]
    # LKH counts whole units: micrometres.
    places = "".join(f"{i} {x / 1000:.3f} {y / 1000:.3f}\n" for i, (x, y) in enumerate(points, 1))
    fixed = "".join(f"{2 * i + 2} {2 * i + 3}\n" for i in range(count))
    problem, parameters, found = FOLDER / "order.tsp", FOLDER / "order.par", FOLDER / "order.tour"
    FOLDER.mkdir(parents=True, exist_ok=True)
    problem.write_text(
        f"NAME : trails\nTYPE : TSP\nDIMENSION : {len(points)}\nEDGE_WEIGHT_TYPE : EUC_2D\nNODE_COORD_SECTION\n{places}"
        f"FIXED_EDGES_SECTION\n{fixed}-1\nEOF\n"
    )
    parameters.write_text(
        f"PROBLEM_FILE = {problem}\nOUTPUT_TOUR_FILE = {found}\nRUNS = 1\nMAX_TRIALS = {trials}\n"
        f"CANDIDATE_SET_TYPE = QUADRANT\nEXTRA_CANDIDATES = 4\nINITIAL_PERIOD = 300\nMAX_CANDIDATES = 6\nTIME_LIMIT = {LIMIT}\n"
    )
    begin = time.process_time()
    LKHpy.par_file(str(parameters))
    tour = [int(word) - 1 for word in found.read_text().split("TOUR_SECTION")[1].split("-1")[0].split()]
    seconds = time.process_time() - begin
    home = tour.index(0)
    tour = tour[home:] + tour[:home]
    assert sorted(tour) == list(range(len(points))), "every end once"
    air = [(a, b) for a, b in zip(tour, tour[1:] + [0]) if a == 0 or b == 0 or (a - 1) // 2 != (b - 1) // 2]
    assert len(air) == count + 1, "every trail is passed"
    travel = sum(math.dist(points[a], points[b]) for a, b in air)
    travel -= max(math.dist(points[a], points[b]) for a, b in (air[0], air[-1]))
    print(f"{count} trails, {trials} trials: {travel / 1e6:.1f} mm, {seconds:.0f} s")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--child"]:
        solve(*map(int, sys.argv[2:]))
    else:
        if not PYTHON.exists():
            subprocess.check_call([sys.executable, "-m", "venv", FOLDER / "order"])
            subprocess.check_call([PYTHON, "-m", "pip", "install", "-q", "LKHpy", "numpy"])
        room = FOLDER / "room.so"
        subprocess.run(["cc", "-shared", "-fPIC", "-O2", "-x", "c", "-", "-o", room], input=ROOM, text=True, check=True)
        count = sys.argv[1]
        command = [PYTHON, __file__, "--child", count, *(sys.argv[2:3] or [count])]
        subprocess.check_call(command, env=dict(os.environ, LD_PRELOAD=str(room.resolve())))
