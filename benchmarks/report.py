#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Error against run time: reads the JSON files of Google Benchmark, writes report.md and one figure per family.

usage: report.py [--bands FILE] [--output DIR] [--accept] JSON...

Names of benchmarks are FAMILY/METHOD[/VARIANT]/PARAMETER:VALUE, see README.md.  Every value of the counter `error` must lie
in its band of bands.csv (name, lowest, highest, seconds); the script fails if one does not, if a benchmark has no band,
or if a band of a family that was run has no benchmark.  Run time only warns: machines differ.  --accept writes the bands
anew around this run; the change is then seen in review.
"""
import argparse
import collections
import csv
import json
import math
import pathlib
import re
import sys

SLOWER_WARNS = 2.0        # run time over the recorded one that is worth a line
BAND = 1.25               # width of an accepted band, up and down
SMALLEST = 1e-17          # drawn for 0 on a logarithmic axis
EXACT = 1e-12             # an error below this is round-off: its band is [0, 10 * EXACT]
ABSENT = "absent: "       # begins the message of a benchmark whose rival is not installed: it is skipped, with its band
SUFFIX = re.compile(r"/((real|process|manual)_time|(iterations|repeats|threads|min_time|min_warmup_time):[\d.]+)")
UNITS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
# What Google Benchmark itself writes about a benchmark; all else are counters that the benchmark has set.
STANDARD = {"name", "family_index", "per_family_instance_index", "run_name", "run_type", "repetitions", "threads",
            "repetition_index", "iterations", "real_time", "cpu_time", "time_unit", "label", "items_per_second",
            "bytes_per_second"}
# Okabe and Ito's palette: distinct for every kind of colour vision.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#8C6D1F", "#999999"]
MARKERS = "osD^vP*Xh"
LINES = ["-", "--", ":", "-."]
AXES = {"d_dx": "particle over cell size d/dx [-]", "gamma": "acceleration factor [-]", "dt": "step [s]",
        "cells": "cells [-]", "steps": "steps [-]", "ranks": "ranks [-]"}

Point = collections.namedtuple("Point", "name family method variant parameter value seconds error counters label")


def read(files):
    """Returns the points, what went wrong in the benchmarks themselves, and the names of those whose rival is absent."""
    points, failed, absent = [], [], []
    for file in files:
        for entry in json.loads(pathlib.Path(file).read_text())["benchmarks"]:
            if entry.get("error_occurred") and entry["error_message"].startswith(ABSENT):
                absent.append(SUFFIX.sub("", entry["name"]))
                print(f"skipped: {absent[-1]}: {entry['error_message'][len(ABSENT):]}")
                continue
            if entry.get("error_occurred"):
                failed.append(f"{entry['name']} failed: {entry['error_message']}")
                continue
            if entry["run_type"] != "iteration":
                continue
            name = SUFFIX.sub("", entry["name"])
            family, method, *rest = name.split("/") + ([] if "/" in name else [""])
            parameter, _, value = (rest[-1] if rest else "").partition(":")
            wall = any(kind in entry["name"] for kind in ("/real_time", "/manual_time"))
            seconds = entry["real_time" if wall else "cpu_time"] * UNITS[entry["time_unit"]]
            counters = {key: value for key, value in entry.items() if key not in STANDARD and key != "error"}
            points.append(Point(name, family, method, " ".join(rest[:-1]), parameter, value, seconds,
                                entry.get("error"), counters, entry.get("label", "")))
    return points, failed, absent


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


def si(value, unit=""):
    """Three digits with an SI prefix."""
    if value == 0 or not math.isfinite(value):
        return f"{value:g} {unit}".strip()
    exponent = max(-12, min(9, 3 * math.floor(math.log10(abs(value)) / 3)))
    prefix = {-12: "p", -9: "n", -6: "u", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}[exponent]
    return f"{value / 10.0 ** exponent:.3g} {prefix}{unit}".strip()


def unit(points):
    """Of the error, as the family's labels give it."""
    return next((point.label for point in points if point.label), "-")


def table(points):
    curves = list(dict.fromkeys((point.method, point.variant) for point in points))
    points = sorted(points, key=lambda point: curves.index((point.method, point.variant)))
    extra = sorted({key for point in points for key in point.counters})
    head = ["method", points[0].parameter or "parameter", "run time", f"error [{unit(points)}]",
            *(key.replace("_", " ") for key in extra)]
    rows = ["| " + " | ".join(head) + " |", "|---|" + "---:|" * (len(head) - 1)]
    for point in points:
        cells = [f"{point.method} {point.variant}".strip(), point.value, si(point.seconds, "s"),
                 "" if point.error is None else f"{point.error:.3g}"]
        for key in extra:
            value = point.counters.get(key)
            cells.append("" if value is None else si(value, "s") if key == "per_item" else f"{value:.4g}")
        rows.append("| " + " | ".join(cells) + " |")
    return "\n".join(rows)


def draw(family, points, file):
    """Error over run time, a colour per method and a line style per variant; beside it error over the parameter, if the
    methods share one."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    methods = list(dict.fromkeys(point.method for point in points))
    variants = list(dict.fromkeys(point.variant for point in points if point.variant))
    over_parameter = len({point.parameter for point in points}) == 1 and all(number(point.value) for point in points) \
        and len({point.value for point in points}) > 2
    panels = [("run time [s]", lambda point: point.seconds)]
    if over_parameter:
        panels.append((AXES.get(points[0].parameter, points[0].parameter), lambda point: number(point.value)))
    figure, axes = plt.subplots(1, len(panels), figsize=(1.2 + 5.3 * len(panels), 4.8), squeeze=False, sharey=True,
                                layout="constrained")
    ends = {}
    for axis, (label, abscissa) in zip(axes[0], panels):
        for method, variant in dict.fromkeys((point.method, point.variant) for point in points):
            curve = [point for point in points if (point.method, point.variant) == (method, variant)]
            x = [abscissa(point) for point in curve]
            y = [max(point.error, SMALLEST) for point in curve]
            index = methods.index(method)
            axis.plot(x, y, color=COLOURS[index % len(COLOURS)], marker=MARKERS[index % len(MARKERS)], markersize=5,
                      linewidth=1.6, linestyle=LINES[variants.index(variant) % len(LINES) if variant else 0])
            if axis is axes[0][-1]:
                ends.setdefault(method, max(zip(x, y)))  # of the first variant
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_xlabel(label)
        axis.grid(True, which="major", color="0.9")
        axis.spines[["top", "right"]].set_visible(False)
    if over_parameter:
        ticks = sorted({number(point.value) for point in points})
        axes[0][1].set_xticks(ticks, [f"{tick:g}" for tick in ticks])
        axes[0][1].tick_params(axis="x", which="minor", bottom=False, labelbottom=False)
    for line, variant in zip(LINES, variants if len(variants) > 1 else []):
        axes[0][0].plot([], [], color="0.3", linestyle=line, label=variant)
    if len(variants) > 1:
        axes[0][0].legend(frameon=False, fontsize=9, loc="lower left")
    axes[0][0].set_ylabel(f"error [{unit(points)}]")
    figure.suptitle(family)

    # The names stand at the ends of the curves, pushed apart where they would touch.
    axis = axes[0][-1]
    names = sorted(methods, key=lambda method: ends[method][1])
    wanted = [axis.transAxes.inverted().transform(axis.transData.transform(ends[method]))[1] for method in names]
    for method, height in zip(names, spread(wanted, 0.05)):
        colour = COLOURS[methods.index(method) % len(COLOURS)]
        axis.annotate(method, ends[method], xytext=(1.03, height), textcoords="axes fraction", color=colour, fontsize=9,
                      va="center", arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.5, "alpha": 0.5})
    figure.savefig(file, dpi=150)
    plt.close(figure)


def spread(heights, step):
    """Rising heights, moved as little as needed to be a step apart and, if there is room, below 1."""
    for i in range(1, len(heights)):
        heights[i] = max(heights[i], heights[i - 1] + step)
    ceiling = 1.0
    for i in reversed(range(len(heights))):
        heights[i] = min(heights[i], ceiling)
        ceiling = heights[i] - step
    return heights


def read_bands(file):
    if not file.exists():
        return {}
    with file.open(newline="") as stream:
        return {row["name"]: {key: float(row[key]) for key in ("lowest", "highest", "seconds")}
                for row in csv.DictReader(stream)}


def accept(points, bands, file):
    for point in points:
        low, high = (0.0, 10 * EXACT) if point.error < EXACT else (point.error / BAND, point.error * BAND)
        bands[point.name] = {"lowest": low, "highest": high, "seconds": point.seconds}
    with file.open("w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(["name", "lowest", "highest", "seconds"])
        for name in sorted(bands):
            writer.writerow([name, *(f"{bands[name][key]:.3g}" for key in ("lowest", "highest", "seconds"))])


def check(points, bands, absent):
    """Returns what is wrong; prints what is only slow."""
    wrong = []
    for point in points:
        band = bands.get(point.name)
        if band is None:
            wrong.append(f"{point.name}: error {point.error:.3g} has no band yet (--accept)")
        elif not band["lowest"] <= point.error <= band["highest"]:
            wrong.append(f"{point.name}: error {point.error:.3g} is outside [{band['lowest']:g}, {band['highest']:g}]")
        elif point.seconds > SLOWER_WARNS * band["seconds"]:
            print(f"warning: {point.name} took {si(point.seconds, 's')}, recorded {si(band['seconds'], 's')}")
    names, families = {point.name for point in points}, {point.family for point in points}
    wrong += [f"{name}: has a band, but was not run" for name in sorted(bands)
              if name not in names and name not in absent and name.split("/")[0] in families]
    return wrong


def main():
    here = pathlib.Path(__file__).resolve().parent
    parser = argparse.ArgumentParser(description="Error against run time from Google Benchmark's JSON")
    parser.add_argument("json", nargs="+")
    parser.add_argument("--bands", type=pathlib.Path, default=here / "bands.csv")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("report"))
    parser.add_argument("--accept", action="store_true", help="write the bands anew around this run")
    arguments = parser.parse_args()

    points, failed, absent = read(arguments.json)
    arguments.output.mkdir(parents=True, exist_ok=True)
    text = ["# Error against run time", "", "Run time is of one iteration; `over stream` is run time over the time that the"
            " bytes which must move take at the STREAM bandwidth of the same run.", ""]
    for family in dict.fromkeys(point.family for point in points):
        members = [point for point in points if point.family == family]
        text += [f"## {family}", "", table(members), ""]
        curves = [point for point in members if point.error is not None]
        if any(point.error >= EXACT for point in curves):
            figure = re.sub(r"[^a-z0-9]+", "_", family.lower()).strip("_") + ".png"
            draw(family, curves, arguments.output / figure)
            text += [f"![{family}]({figure})", ""]
    (arguments.output / "report.md").write_text("\n".join(text))
    print(f"report: {arguments.output / 'report.md'}")

    with_error = [point for point in points if point.error is not None]
    bands = read_bands(arguments.bands)
    if arguments.accept:
        accept(with_error, bands, arguments.bands)
        return 0
    wrong = failed + check(with_error, bands, absent)
    for line in wrong:
        print("error: " + line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
