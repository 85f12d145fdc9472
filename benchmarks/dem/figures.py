#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""figures.py TABLES FOLDER: draws the figures of examples/solvers/README.md from the tables of dem_validation."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
from tables import BLUE, GREEN, GREY, ORANGE, RED, column, plt, save, table


def conductivity(tables, to):
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 3.4), width_ratios=(1.6, 1), layout="constrained")
    rows = table(tables / "fig_3.txt")
    kelvin = column(rows, "kelvin")
    low, high = column(rows, "yk_low"), column(rows, "yk_high")
    left.fill_between(kelvin, [0.75 * v for v in low], [1.25 * v for v in high], color=GREY, alpha=0.12, lw=0,
                      label="25 % around it")
    left.fill_between(kelvin, low, high, color=GREY, alpha=0.45, lw=0, label="Yagi and Kunii, Eq. 15")
    left.plot(kelvin, column(rows, "zbs"), "--", color="black", lw=1, label="Zehner, Bauer, Schlünder")
    left.plot(kelvin, column(rows, "all"), "o-", color=BLUE, ms=3.5, label="this bed")
    for name, label, colour in (("radiation", "radiation", RED), ("film", "gas films", GREEN), ("contact", "contacts", ORANGE)):
        left.plot(kelvin, column(rows, name), color=colour, lw=1.2, label=label)
    left.set(xlabel="temperature [K]", ylabel="effective conductivity [W/(m K)]", xlim=(300, 1200), ylim=(0, 6),
             title="Iron spheres of 11 mm in air")
    left.legend(fontsize=8)

    rows = table(tables / "exchange.txt")
    known = [(0.57671, 1.06765), (0.59292, 1.04145), (0.61780, 1.00659), (0.63687, 0.97567)]
    solid, factor = zip(*known)
    right.fill_between(solid, [0.97 * f for f in factor], [1.03 * f for f in factor], color=GREY, alpha=0.2, lw=0)
    right.plot(solid, factor, "k-", lw=1, label="view factors by rays, 3 %")
    right.plot(column(rows, "solid"), column(rows, "cutoff_2.5"), "o", color=BLUE, ms=5, label="list to 2.5 d")
    right.plot(column(rows, "solid"), column(rows, "cutoff_4"), "s", color=RED, ms=5, mfc="none", label="list to 4 d")
    right.set(xlabel="solid fraction [-]", ylabel="exchange factor [-]", ylim=(0.9, 1.15),
              title="Radiation alone")
    right.legend(fontsize=8)
    save(figure, to)


def accuracy(tables, to):
    rows = table(tables / "sweeps.txt")
    poured = next(row for row in rows if row["what"] == "reference")
    parcels = [{**row, "value": row["k"]} for row in table(tables / "parcels.txt")]
    figure, axes = plt.subplots(1, 4, figsize=(9.6, 3.2), sharey=True, layout="constrained")
    quantities = (("height", "bed height", BLUE, "o"), ("solid", "solid fraction", RED, "s"),
                  ("floor_stress", "stress on the floor", GREEN, "^"), ("conductivity", "conductivity", ORANGE, "D"))
    for axis, (what, title) in zip(axes, (("step", "step [s]"), ("skin", "skin over diameter [-]"),
                                          ("modulus", "modulus of the motion [Pa]"), ("k", "parcel factor k [-]"))):
        runs, best = [row for row in rows if row["what"] == what], poured
        if what == "k":
            best, *runs = parcels
        for name, label, colour, marker in quantities:
            axis.scatter(column(runs, "value"), [100 * abs(row[name] / best[name] - 1) for row in runs], color=colour,
                         marker=marker, s=22, label=label)
        for row in runs:
            axis.annotate(f"{row['seconds']:.1f} s", (row["value"], 0.013), fontsize=7, ha="center", color=GREY)
        axis.set(xscale="log", yscale="log", xlabel=title, ylim=(0.01, 100))
        if what == "k":
            axis.set(xscale="linear", xticks=column(runs, "value"))
            axis.annotate(f"grains: {best['seconds']:.0f} s", (0.5, 0.93), xycoords="axes fraction", fontsize=7, ha="center", color=GREY)
        axis.margins(x=0.15)
    axes[0].set_ylabel("difference to the reference [%]")
    axes[0].legend(fontsize=7)
    save(figure, to)


if __name__ == "__main__":
    tables, folder = map(pathlib.Path, sys.argv[1:])
    conductivity(tables, folder / "dem_conductivity.svg")
    accuracy(tables, folder / "dem_accuracy.svg")
