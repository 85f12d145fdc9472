#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""figures.py TABLES FOLDER: draws the figures of gas and combustion of examples/solvers/README.md."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
from tables import BLUE, GREEN, GREY, ORANGE, PINK, RED, column, plt, save, table

METHODS = {"filtered": ("filtered", BLUE, "o"), "VFS_of_the_paper": ("VFS of the paper, 0.9", RED, "s"),
           "VFS_completed": ("VFS completed, 0.9", PINK, "D"), "divided,_clamped": ("divided", GREEN, "^"),
           "centre,_clamped": ("centre", ORANGE, "v")}
LENGTH = 0.145  # of the paper's bed [m]


def extrapolated(rows, speed, order):
    """Richardson's estimate from the two finest meshes; the solids are staircases, so the order is 1 or 2."""
    fine, coarse = sorted((row for row in rows if row["speed"] == speed), key=lambda row: -row["cells_per_diameter"])[:2]
    ratio = (fine["cells_per_diameter"] / coarse["cells_per_diameter"]) ** order
    return fine["gradient"] + (fine["gradient"] - coarse["gradient"]) / (ratio - 1)


def fig_5(tables, to):
    rows, fine = table(tables / "speeds.txt"), table(tables / "resolved.txt")
    finest = max(column(fine, "cells_per_diameter"))
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(11.4, 3.7), layout="constrained")
    speed = column(rows, "speed")
    ergun = column(rows, "ergun")
    curves = (("eisfeld", "Eisfeld, Schnitzlein", "k", "--", ""), ("filtered", "filtered, d/dx 2", BLUE, "-", "o"),
              ("filtered_eisfeld", "the same with their drag", BLUE, "--", "."),
              ("vfs_1", "VFS of the paper, d/dx 1", RED, "--", "s"), ("vfs_2", "VFS of the paper, d/dx 2", RED, "-", "s"),
              ("divided", "divided, d/dx 1", GREEN, "-", "^"))
    drops = [LENGTH * g for g in ergun]
    left.plot(speed, drops, "k-", lw=1, label="Ergun at the mean void fraction")
    middle.plot(speed, [1 for _ in speed], "k-", lw=1)
    for name, label, colour, line, marker in curves:
        values = column(rows, name)
        left.plot(speed, [LENGTH * v for v in values], line, color=colour, marker=marker, ms=3.5, lw=1, label=label)
        middle.plot(speed, [v / e for v, e in zip(values, ergun)], line, color=colour, marker=marker, ms=3.5, lw=1)
    by_speed = dict(zip(speed, ergun))
    for cells in sorted(set(column(fine, "cells_per_diameter"))):
        runs = [row for row in fine if row["cells_per_diameter"] == cells]
        shade = 0.25 + 0.75 * (cells / finest) ** 2
        middle.plot(column(runs, "speed"), [row["gradient"] / by_speed[row["speed"]] for row in runs], ":", marker="*", ms=6,
                    color=PINK, alpha=shade, lw=1, label=f"resolved, d/dx {cells:g}")
        if cells == finest:
            left.plot(column(runs, "speed"), [LENGTH * row["gradient"] for row in runs], ":", marker="*", ms=7, color=PINK,
                      label=f"resolved, d/dx {cells:g}")
    bounds = [[extrapolated(fine, s, order) / by_speed[s] for s in speed] for order in (1, 2)]
    middle.fill_between(speed, *bounds, color=PINK, alpha=0.15, lw=0, label="resolved, extrapolated")
    left.set(xlabel="superficial velocity [m/s]", ylabel="pressure drop over 145 mm [Pa]", title="14 mm spheres, tube of 56 mm")
    left.legend(fontsize=7)
    middle.set(xlabel="superficial velocity [m/s]", ylabel="over Ergun [-]", xscale="log", ylim=(0, None),
               title="The same over Ergun")
    middle.legend(fontsize=7)

    runs = table(tables / "wide.txt")
    for method, (label, colour, marker) in METHODS.items():
        mine = [row for row in runs if row["method"] == method]
        seconds, errors = column(mine, "seconds"), [100 * abs(row["over_ergun"] - 1) for row in mine]
        right.plot(seconds, errors, "-", color=colour, marker=marker, ms=4, lw=1, label=label)
        for row, error in zip(mine, errors):
            right.annotate(f"{row['d_dx']:g}", (row["seconds"], error), textcoords="offset points", xytext=(3, 3),
                           fontsize=6.5, color=colour)
    right.axhline(3, color=GREY, lw=0.8, ls="--")
    right.set(xscale="log", yscale="log", xlabel="run time, solid fraction and flow [s]", ylabel="error of the pressure drop [%]",
              title="Bed without side walls, at each d/dx")
    right.legend(fontsize=7)
    save(figure, to)


def gas(tables, to):
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(11.4, 3.4), layout="constrained")
    rows = table(tables / "orders.txt")
    for name, marker in (("straight", "o"), ("bent", "s"), ("shaken", "^")):
        mine = [row for row in rows if row["mesh"] == name]
        left.loglog(column(mine, "cells"), column(mine, "velocity"), "-", color=BLUE, marker=marker, ms=4, lw=1,
                    label=f"velocity, {name}")
        left.loglog(column(mine, "cells"), column(mine, "pressure"), "-", color=RED, marker=marker, ms=4, lw=1,
                    label=f"pressure, {name}")
    left.loglog([16, 128], [6e-3, 6e-3 / 64], color=GREY, ls="--", lw=0.8, label="second order")
    left.set_xticks([16, 32, 64, 128], ["16", "32", "64", "128"])
    left.minorticks_off()
    left.set(xlabel="cells across [-]", ylabel="error, root mean square [-]", title="Manufactured flow through a bed")
    left.legend(fontsize=6.5)

    rows = table(tables / "channel.txt")
    reference = sorted((row["y_plus"], row["log_law"]) for row in rows)
    middle.semilogx(*zip(*reference), color="k", lw=1, label="log law")
    for cells, colour, marker in ((12, RED, "s"), (20, BLUE, "o")):
        mine = [row for row in rows if row["cells"] == cells]
        middle.semilogx(column(mine, "y_plus"), column(mine, "u_plus"), marker, color=colour, ms=4, mfc="none",
                        label=f"{cells} cells on the half height")
    middle.set(xlabel="distance from the wall, y+", ylabel="velocity, u+", title="Channel, Re 67 000, k-epsilon")
    middle.legend(fontsize=7)

    rows = table(tables / "jump.txt")
    for fraction, colour, marker in ((0.1, RED, "s"), (0.4, BLUE, "o"), (0.8, GREEN, "^")):
        mine = [row for row in rows if row["void_fraction"] == fraction and abs(row["height"] - 0.15) < 0.045]
        step = 1 - fraction ** 2  # Bernoulli's, over the dynamic pressure
        without = [row["pressure"] - (row["exact"] + step if row["height"] < 0.15 else 0) for row in mine]
        right.plot([1000 * row["height"] for row in mine], [p / step for p in without], marker, color=colour, ms=4,
                   mfc="none", label=f"bed of void fraction {fraction:g}")
    right.plot([105, 150, 150, 195], [-1, -1, 0, 0], color="k", lw=0.8, label="Bernoulli")
    right.set(xlabel="height [mm]", ylabel="pressure without friction, over the step [-]",
              title="Gas that leaves a bed at 150 mm")
    right.legend(fontsize=7)
    save(figure, to)


def combustion(tables, to):
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(11.4, 3.4), layout="constrained")
    rows = table(tables / "flames.txt")
    ratio = column(rows, "ratio")
    left.plot(ratio, column(rows, "complete"), "-", color=RED, lw=1, label="mixed is burnt")
    left.plot(ratio, column(rows, "equilibrium"), "-", color=BLUE, lw=1, label="equilibrium")
    for name, colour in (("published_complete", RED), ("published", BLUE)):
        known = [row for row in rows if row[name] > 0]
        left.plot(column(known, "ratio"), column(known, name), "o", color=colour, ms=4, mfc="none",
                  label="Gibbs energy, minimised" if name == "published" else None)
    left.set(xlabel="equivalence ratio [-]", ylabel="flame temperature [K]", title="Methane in air, 298 K, 1 atm")
    left.legend(fontsize=7)

    rows = table(tables / "ignition.txt")
    for start, colour in ((1000, GREEN), (1300, ORANGE), (1800, RED)):
        mine = [row for row in rows if row["start"] == start]
        middle.semilogx(column(mine, "time"), column(mine, "cvode"), "-", color=colour, lw=1, label=f"CVODE, from {start} K")
        middle.semilogx(column(mine, "time"), column(mine, "ours"), "o", color=colour, ms=3, mfc="none")
    middle.set(xlabel="time [s]", ylabel="temperature [K]", title="Ignition; circles: ours, usual tolerance")
    middle.legend(fontsize=7)

    rows = table(tables / "chemistry.txt")
    for kind, marker in (("burnt_cells", "o"), ("cells_at_1000_K", "s"), ("igniting_cells", "^")):
        for method, colour in (("ours", BLUE), ("CVODE", RED)):
            mine = [row for row in rows if row["kind"] == kind and row["method"] == method]
            right.loglog([1e6 * row["seconds"] for row in mine], column(mine, "error"), "-", color=colour, marker=marker, ms=4,
                         lw=1, label=f"{method}, {kind.replace('_', ' ')}")
    right.set(xlabel="time per cell and 1e-4 s [us]", ylabel="error, root mean square [-]", title="Chemistry of a cell",
              ylim=(2e-10, 3e-2))
    right.legend(fontsize=6.5, loc="lower left")
    save(figure, to)


if __name__ == "__main__":
    tables, folder = map(pathlib.Path, sys.argv[1:])
    fig_5(tables, folder / "gas_packed_bed.svg")
    gas(tables, folder / "gas_accuracy.svg")
    combustion(tables, folder / "combustion.svg")
