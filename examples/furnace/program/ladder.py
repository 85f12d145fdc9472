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


def two_spheres(figure, summary):
    left, right = figure.subplots(1, 2)
    t = table("heat_over_force.csv")
    left.loglog(t["force_N"], t["sphere_and_wall_W"], "s", color=BLUE, ms=4, label="sphere and wall")
    left.loglog(t["force_N"], t["two_spheres_W"], "o", color=RED, ms=4, label="two spheres")
    left.loglog(t["force_N"], t["hertz_W"], color=RED, lw=0.8, label="2 k a, Hertz: slope 1/3")
    left.loglog(t["force_N"], t["with_gas_film_W"], color=GREEN, lw=1, ls="--", label="two spheres with the gas in their gap")
    left.loglog(t["force_N"], t["letter_of_eq_2_W"], color=GREY, lw=1, ls=":", label="Eq. 2 by the letter")
    left.set(xlabel="contact force [N]", ylabel="heat [W]", title="two bodies in contact (Fig. 1)")
    left.legend()
    m = table("over_modulus.csv")
    right.loglog(m["time_of_process_second_s"], m["by_overlap_error"], "s-", color=GREY, ms=4, lw=1, label="contact by the softened overlap")
    right.loglog(m["time_of_process_second_s"], [max(e, 1e-16) for e in m["by_force_error"]], "o-", color=RED, ms=4, lw=1,
                 label="contact by the force, true modulus")
    for x, y, modulus in zip(m["time_of_process_second_s"], m["by_overlap_error"], m["modulus_Pa"]):
        right.annotate("%.0e Pa" % modulus, (x, y), xytext=(3, 3), textcoords="offset points", fontsize=7, color=GREY)
    right.set(xlabel="run time of a second of the motion [s]", ylabel="error of the heat", title="error against run time, over the modulus of the motion")
    right.legend(loc="center left")


def plates(figure, summary):
    left, right = figure.subplots(1, 2)
    t = table("conductivity.csv")
    kelvin = t["temperature_K"]
    left.fill_between(kelvin, t["yagi_kunii_0.9_W_per_mK"], t["yagi_kunii_W_per_mK"], color="0.85", label="Yagi and Kunii, Eq. 15, beta 0.9 to 1")
    left.plot(kelvin, t["core_W_per_mK"], "o-", color="k", ms=4, lw=1, label="core of the bed")
    for name, colour, word in (("radiation", RED, "of that: radiation"), ("gas_film", GREEN, "gas films"), ("contact", BLUE, "contacts")):
        left.plot(kelvin, t[name + "_W_per_mK"], color=colour, lw=1, label=word)
    left.plot(kelvin, t["between_plates_W_per_mK"], color="k", lw=0.8, ls=":", label="from plate to plate")
    left.set(xlabel="temperature [K]", ylabel="effective conductivity [W/(m K)]", title="iron spheres between plates (Fig. 3)")
    left.legend()
    c = table("over_cutoff.csv")
    right.plot(c["time_s"][1:], [100 * e for e in c["error"][1:]], "o", color=RED, ms=4)
    for x, y, cutoff in zip(c["time_s"][1:], c["error"][1:], c["cutoff_in_diameters"][1:]):
        right.annotate("%g d" % cutoff, (x, 100 * y), xytext=(4, 3), textcoords="offset points", fontsize=8)
    right.axhline(0, color=GREY, lw=0.8)
    right.set(xlabel="run time of links and steady state [s]", ylabel="radiative conductivity off a cutoff of %g d [%%]" % c["cutoff_in_diameters"][0],
              title="error against run time, over how far radiation looks")


METHODS = (("filtered", RED, "filtered (default)"), ("vfs_paper", BLUE, "smoother of the paper"),
           ("vfs_completed", GREEN, "smoother completed"), ("cut_off", ORANGE, "cut off at 0.9"))


def cold_bed(figure, summary):
    left, right = figure.subplots(1, 2)
    t = table("pressure_drop.csv")
    u = t["velocity_m_per_s"]
    left.loglog(u, t["ergun_Pa"], color="k", lw=0.8, ls=":", label="Ergun")
    left.loglog(u, t["eisfeld_schnitzlein_Pa"], color="k", lw=1, label="Eisfeld and Schnitzlein")
    for name, colour, word in METHODS:
        if name + "_Pa" in t:
            left.loglog(u, t[name + "_Pa"], "o--", color=colour, ms=4, lw=0.8, label=word)
    left.set(xlabel="superficial velocity [m/s]", ylabel="pressure drop [Pa]", title="cold bed (Fig. 5)")
    left.legend()
    m = table("over_mesh.csv")
    for name, colour, word in METHODS:
        if name + "_time_s" in m:
            right.loglog(m[name + "_time_s"], m[name + "_over_reference"], "o-", color=colour, ms=4, lw=1, label=word)
            for x, y, k in zip(m[name + "_time_s"], m[name + "_over_reference"], m["cells_per_diameter"]):
                right.annotate("%g" % k, (x, y), xytext=(3, 3), textcoords="offset points", color=colour, fontsize=7)
    right.axhspan(1 / 1.15, 1.15, color="0.9")
    right.set(xlabel="run time [s]", ylabel="pressure gradient over Eisfeld and Schnitzlein", title="against run time, over cells per diameter")


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


def silo(figure, summary):
    left, middle, right = figure.subplots(1, 3)
    j, law, v, f = table("janssen.csv"), table("janssen_law.csv"), table("velocity.csv"), table("flow.csv")
    left.plot([p / 1e3 for p in j["floor_Pa"]], j["level_m"], "o", color=RED, ms=5, label="floor, DEM")
    left.plot([p / 1e3 for p in law["floor_Pa"]], law["level_m"], color=RED, lw=1, label="Janssen, K = %.2f" % summary["janssen_coefficient"])
    left.plot([p / 1e3 for p in law["head_Pa"]], law["level_m"], color=GREY, lw=1, ls=":", label="head")
    left.set(xlabel="stress on the floor [kPa]", ylabel="level of the filling [m]", title="silo: filling")
    left.legend()
    middle.plot(v["radius_m"], [1e3 * u for u in v["velocity_m_per_s"]], "o-", color=RED, ms=5, lw=1, label="DEM")
    middle.plot(v["radius_m"], [1e3 * u for u in v["plug_m_per_s"]], color=GREY, lw=1, ls=":", label="plug")
    middle.set(xlabel="radius [m]", ylabel="velocity of sinking [mm/s]", title="while it is fed and emptied", ylim=(0, None))
    middle.legend()
    right.plot(f["time_s"], f["taken_kg"], color=RED, lw=1, label="taken")
    right.plot(f["time_s"], f["held_kg"], color=BLUE, lw=1, label="held")
    right.set(xlabel="time [s]", ylabel="mass [kg]", title="masses", ylim=(0, None))
    right.legend()


def burner(figure, summary):
    left, right = figure.subplots(1, 2)
    t, p = table("burn_out.csv"), table("plane.csv")
    left.plot(t["bed_temperature_K"], t["burn_out"], "o-", color=RED, ms=4, lw=1, label="burn-out of the heat")
    left.plot(t["bed_temperature_K"], t["methane_left"], "o-", color=BLUE, ms=4, lw=1, label="methane left")
    left.set(xlabel="temperature of the bed [K]", ylabel="share", title="one burner in a bed that stands still")
    left.legend(loc="center left")
    places = {(round(a, 9), round(b, 9)): k for k, (a, b) in enumerate(zip(p["x_m"], p["z_m"]))}
    x, z = sorted({a for a, _ in places}), sorted({b for _, b in places})
    grid = [[p["gas_temperature_K"][places[a, b]] if (a, b) in places else float("nan") for a in x] for b in z]
    painted = right.pcolormesh(x, z, grid, cmap="inferno", shading="nearest")
    right.quiver(p["x_m"], p["z_m"], p["velocity_x_m_per_s"], p["velocity_z_m_per_s"], color="w", width=0.003)
    right.set(xlabel="depth from the burner's wall [m]", ylabel="height [m]", aspect="equal",
              title="gas at %g K of the bed" % t["bed_temperature_K"][-1])
    figure.colorbar(painted, ax=right, label="gas temperature [K]")


def main():
    with open(os.path.join(here, "summary.json")) as file:
        summary = json.load(file)
    plt.rcParams.update({"font.size": 9, "axes.titlesize": 9, "legend.frameon": False, "legend.fontsize": 8})
    figure = plt.figure(figsize=(10, 4.2), constrained_layout=True)
    globals()[summary["kind"]](figure, summary)
    figure.savefig(os.path.join(here, summary["kind"] + ".png"), dpi=100)


if __name__ == "__main__":
    sys.exit(main())
