#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws KIND.png from summary.json and the CSV files that stand beside this script: one function for each kind of scene."""
import csv
import json
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

here = os.path.dirname(os.path.abspath(__file__))
RED, BLUE, GREEN, ORANGE, GREY = "#b2182b", "#2166ac", "#1b7837", "#e08214", "0.5"


def table(name):
    """The columns of a CSV file, an empty field as NaN."""
    with open(os.path.join(here, name), newline="") as file:
        rows = list(csv.reader(file))
    columns = zip(*rows[1:]) if len(rows) > 1 else [[] for _ in rows[0]]
    return {title: [float(v) if v else float("nan") for v in column] for title, column in zip(rows[0], columns)}


def heated_bed(figure, summary):
    left, right = figure.subplots(1, 2)
    t = table("temperatures.csv")
    places = [name[len("exact_"):] for name in t if name.startswith("exact_")]
    for place, colour in zip(places, (RED, BLUE, GREEN, ORANGE, GREY)):
        left.plot(t["time_s"], t["exact_" + place], color=colour, lw=0.8, label=place.replace("_mm_K", " mm"))
        left.plot(t["time_s"][::6], t["gamma_1_" + place][::6], ".", color=colour, ms=4)
        left.plot(t["time_s"], t["paper_" + place], color=colour, lw=1, ls="--")
    left.plot([], [], "k-", lw=0.8, label="Schumann, exact")
    left.plot([], [], "k.", ms=4, label=r"$\Gamma$ = 1")
    left.plot([], [], "k--", lw=1, label=r"$\Gamma$ = 200 as the paper")
    left.set(xlabel="process time [s]", ylabel="particles [K]", title="heated bed (Fig. 6)")
    left.legend()
    g, s, c = table("over_gamma.csv"), table("over_step.csv"), table("over_cells.csv")
    for form, colour, word in (("paper", RED, r"$\Gamma$, as the paper"), ("corrected", BLUE, r"$\Gamma$, storage corrected"),
                               ("quasi_steady", GREEN, r"$\Gamma$, quasi-steady gas")):
        right.loglog(g[form + "_time_s"], g[form + "_error_K"], "o-", color=colour, ms=4, lw=1, label=word)
        for x, y, name in zip(g[form + "_time_s"], g[form + "_error_K"], g["acceleration_factor"]):
            right.annotate("%g" % name, (x, y), xytext=(3, 3), textcoords="offset points", color=colour, fontsize=7)
    right.loglog(s["time_s"], s["error_K"], "s:", color=ORANGE, ms=3, lw=1, label="step, storage corrected")
    right.loglog(c["time_s"], c["error_K"], "^:", color=GREY, ms=3, lw=1, label="cells, storage corrected")
    right.set(xlabel="run time [s]", ylabel="largest error [K of 100 K]", title="error against run time")
    right.legend()


def main():
    with open(os.path.join(here, "summary.json")) as file:
        summary = json.load(file)
    plt.rcParams.update({"font.size": 9, "axes.titlesize": 9, "legend.frameon": False, "legend.fontsize": 8})
    figure = plt.figure(figsize=(10, 4.2), constrained_layout=True)
    globals()[summary["kind"]](figure, summary)
    figure.savefig(os.path.join(here, summary["kind"] + ".png"), dpi=100)


if __name__ == "__main__":
    sys.exit(main())
