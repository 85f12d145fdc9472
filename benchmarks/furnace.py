#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Error of the whole furnace against its run time, over what can be turned.

    furnace.py FURNACE SCENE FOLDER

Runs the scene (column.toml), coarse, once for each turn of one knob, and once with all of them fine, which the others are compared
with.  All runs cover the same process time from the same start.  Writes work_precision.csv and work_precision.png.
Run time is processor time of the whole program, so other work on the machine hardly counts.
"""
import csv
import json
import pathlib
import resource
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

def cells(size):
    return {"mesh.axial_size_m": size, "mesh.axial_size_bottom_m": size / 2, "mesh.axial_size_burners_m": size / 2}


COMMON = {"time.residence_times": 0.1, "time.couplings": 15, "time.balance_tolerance": 1, "bed.coarse_graining": 2.8, **cells(0.08),
          "output.picture": "false", "output.frames": 0, "output.checkpoint_interval_s": 1e6}


# knob: [(what a point is called, the keys that it sets)]
KNOBS = {
    "height of cells": [(f"{1000 * s:.0f} mm", cells(s)) for s in (0.16, 0.04)],
    "cells across": [("6", {"mesh.cells_across": 6})],
    "k, parcel over stone": [(f"k {k}", {"bed.coarse_graining": k}) for k in (2.0,)],
    "couplings": [(str(n), {"time.couplings": n}) for n in (8, 30, 60)],
    "Gamma": [("50", {"time.acceleration_factor": 50}), ("10 000", {"time.acceleration_factor": 10000})],
    "voidage": [("paper's VFS", {"voidage.method": "vfs", "voidage.threshold": 0.9}), ("kernel 1 d", {"voidage.width_in_diameters": 1.0})],
    "chemistry": [("equilibrium", {"physics.combustion": "equilibrium"}), ("finite rates", {"physics.combustion": "jones_lindstedt"})],
}
FINEST = {**cells(0.03), "bed.coarse_graining": 1.8, "time.couplings": 60}
QUANTITIES = [("peak_particle_temperature_K", "peak, K", 1), ("centre_temperature_at_peak_K", "centre, K", 1),
              ("offgas_temperature_K", "off-gas, K", 1), ("solids_outlet_temperature_K", "product, K", 1),
              ("pressure_drop_Pa", "pressure drop, Pa", 1)]


def run(furnace, scene, folder, changes):
    """Summary of a run, and its processor time in seconds."""
    command = [furnace, scene, "--quiet", "--output", str(folder)]
    for key, value in {**COMMON, **changes}.items():
        command += ["--set", f"{key}={value}"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        return None, done.stderr.strip().splitlines()[-1:]
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return json.loads((folder / "summary.json").read_text()), spent


def main(furnace, scene, folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    points = [("", "start", {})] + [(knob, name, keys) for knob, turns in KNOBS.items() for name, keys in turns]
    points.append(("finest", "finest", FINEST))
    rows = []
    for number, (knob, name, keys) in enumerate(points):
        summary, seconds = run(furnace, scene, folder / f"run_{number}", keys)
        if summary is None:
            print(f"{knob:22} {name:14} failed: {' '.join(seconds)}", flush=True)
            continue
        values = [summary[key] * scale for key, _, scale in QUANTITIES]
        rows.append((knob, name, seconds, values))
        print(f"{knob:22} {name:14} {seconds:7.1f} s  " + "  ".join(f"{v:9.1f}" for v in values), flush=True)
    if not rows or rows[-1][0] != "finest":
        sys.exit("furnace.py: without the finest run there is nothing to compare with")
    finest = rows.pop()
    with open(folder / "work_precision.csv", "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["knob", "point", "processor_time_s"] + [key for key, _, _ in QUANTITIES])
        for knob, name, seconds, values in rows + [finest]:
            table.writerow([knob, name, f"{seconds:.2f}"] + [f"{v:.3f}" for v in values])
    draw(rows, finest, folder / "work_precision.png")


def draw(rows, finest, path):
    figure, axes = plt.subplots(1, len(QUANTITIES), figsize=(17, 4.2), sharex=True)
    markers = dict(zip(KNOBS, "os^Dv*P"))
    for at, (axis, (_, label, _)) in enumerate(zip(axes, QUANTITIES)):
        base = rows[0]
        error = lambda row: max(abs(row[3][at] - finest[3][at]), 1e-2)
        for knob, marker in markers.items():
            turns = [base] + [row for row in rows if row[0] == knob]
            turns.sort(key=lambda row: row[2])
            axis.plot([row[2] for row in turns], [error(row) for row in turns], marker=marker, markersize=5, label=knob,
                      linewidth=0 if knob in ("voidage", "chemistry") else 0.8)  # these are kinds, not degrees
        axis.plot(base[2], error(base), "k+", markersize=14, markeredgewidth=2, label="start")
        axis.set(xscale="log", yscale="log", xlabel="processor time, s", title=label)
        axis.set_xticks([2, 5, 10, 20], ["2", "5", "10", "20"])
        axis.set_xticks([], minor=True)
        axis.grid(True, which="both", alpha=0.25)
    axes[0].set_ylabel("difference to the finest run")
    axes[0].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(path, dpi=85)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
