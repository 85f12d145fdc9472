#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws furnace.png from picture.json and the CSV files that stand beside this script."""
import csv
import json
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import EllipseCollection, PolyCollection

here = os.path.dirname(os.path.abspath(__file__))


def table(name):
    """The columns of a CSV file, an empty field as NaN."""
    with open(os.path.join(here, name), newline="") as file:
        rows = list(csv.reader(file))
    columns = zip(*rows[1:]) if len(rows) > 1 else [[] for _ in rows[0]]
    return {title: [float(v) if v else float("nan") for v in column] for title, column in zip(rows[0], columns)}


def known(values, heights):
    """The pairs without those slices in which there is nothing."""
    pairs = [(v, z) for v, z in zip(values, heights) if v == v]
    return tuple(zip(*pairs)) if pairs else ((), ())


def paint(axes, cut, what, colours, width, low, high, transposed=False):
    """Cells as the plane cuts them, or particles as discs, coloured by temperature."""
    if what == "gas":
        shapes = [list(zip(p[0::2], p[1::2])) for p in cut["cells"]]
        painted = PolyCollection(shapes, array=cut["gas_temperature_K"], edgecolors="face", linewidths=0.2, **colours)
    else:
        x, y, r = zip(*cut["particles"]) if cut["particles"] else ((), (), ())
        diameters = [2 * value for value in r]
        painted = EllipseCollection(diameters, diameters, [0] * len(x), units="xy", offsets=list(zip(x, y)),
                                    transOffset=axes.transData, array=cut["particle_temperature_K"], linewidths=0, **colours)
    axes.add_collection(painted)
    axes.set_xlim(-0.5 * width, 0.5 * width)
    axes.set_ylim(low, high)
    axes.set_aspect("equal")
    return painted


def main():
    with open(os.path.join(here, "picture.json")) as file:
        data = json.load(file)
    now, guess = table("profiles.csv"), table("one_dimensional.csv")
    vertical, plane = data["vertical"], data["burner_plane"]
    width, height = data["diameter_m"], data["height_m"]
    seen = [t for cut in (vertical, plane) for key in ("gas_temperature_K", "particle_temperature_K") for t in cut[key] if t is not None]
    colours = {"cmap": "inferno", "norm": plt.Normalize(min(seen, default=300), max(seen, default=301))}

    plt.rcParams.update({"font.size": 9, "axes.titlesize": 9, "axes.grid": False, "legend.frameon": False})
    figure = plt.figure(figsize=(13, 9), constrained_layout=True)
    figure.suptitle(data["title"], fontsize=12)
    grid = figure.add_gridspec(2, 5, width_ratios=[0.5, 0.5, 2, 1.2, 1.9])

    for column, (what, title) in enumerate((("particles", "particles"), ("gas", "gas"))):
        axes = figure.add_subplot(grid[:, column])
        painted = paint(axes, vertical, what, colours, width, 0, height)
        axes.set_title(title)
        axes.set_xticks([-0.4, 0, 0.4] if width < 1 else [-0.5 * width, 0, 0.5 * width])
        axes.set_xlabel("x [m]")
        if column == 0:
            axes.set_ylabel("height [m]")
        else:
            axes.set_yticklabels([])
    temperatures = figure.add_subplot(grid[:, 2])
    z = now["height_m"]
    if "particle_temperature_K" in now:
        temperatures.fill_betweenx(z, now["particle_temperature_centre_K"], now["particle_temperature_wall_K"], color="0.85",
                                   label="particles, centre to wall")
        temperatures.plot(*known(now["particle_temperature_K"], z), color="#b2182b", label="particles")
        temperatures.plot(*known(now["gas_temperature_K"], z), color="#2166ac", label="gas")
        temperatures.plot(guess["particle_temperature_K"], guess["height_m"], color="#b2182b", lw=0.8, ls="--",
                          label="particles, one-dimensional")
        temperatures.plot(guess["gas_temperature_K"], guess["height_m"], color="#2166ac", lw=0.8, ls="--",
                          label="gas, one-dimensional")
    if data["burners"] > 0:
        temperatures.axhline(data["burner_height_m"], color="0.6", lw=0.8, ls=":")
        temperatures.annotate("burners", (0.02, data["burner_height_m"]), xycoords=("axes fraction", "data"), va="bottom",
                              color="0.4")
    temperatures.set(xlabel="temperature [K]", ylim=(0, height), title="over the height, means of the cross section")
    temperatures.legend(loc="center left")

    pressure = figure.add_subplot(grid[:, 3])
    values, heights = known(now["pressure_Pa"], z)
    pressure.plot([(p - values[-1]) / 1e3 for p in values], heights, color="0.2", label="this run")
    pressure.plot([(p - guess["pressure_Pa"][-1]) / 1e3 for p in guess["pressure_Pa"]], guess["height_m"], color="0.2", lw=0.8, ls="--",
                  label="one-dimensional")
    pressure.set(xlabel="pressure above the top [kPa]", ylim=(0, height), title="pressure")
    pressure.set_yticklabels([])
    pressure.legend(loc="upper right")

    for row, (what, title) in enumerate((("particles", "particles at the burners"), ("gas", "gas at the burners"))):
        axes = figure.add_subplot(grid[row, 4])
        painted = paint(axes, plane, what, colours, width * 1.02, -0.51 * width, 0.51 * width)
        axes.add_patch(plt.Circle((0, 0), 0.5 * width, fill=False, color="0.3", lw=0.8))
        axes.set(title=title, xlabel="x [m]", ylabel="y [m]")
    figure.colorbar(painted, ax=figure.axes, label="temperature [K]", shrink=0.6, aspect=40, location="right", pad=0.01)
    figure.savefig(os.path.join(here, "furnace.png"), dpi=130)


if __name__ == "__main__":
    sys.exit(main())
