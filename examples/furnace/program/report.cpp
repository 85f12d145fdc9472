// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace hearth::furnace::program {
namespace {

__attribute__((format(printf, 1, 2))) std::string print(const char* format, ...) {
    char text[512];
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return text;
}

std::string size_of(double bytes) {
    return bytes < 1e9 ? print("%.0f MB", bytes / 1e6) : print("%.1f GB", bytes / 1e9);
}

/// The paper's furnace, as far as its numbers hang on it; a scene of another one has nothing to be compared with.
bool is_the_papers(const settings& scene) {
    const settings paper;
    const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(b); };
    return same(scene.shaft.height, paper.shaft.height) && same(scene.shaft.diameter, paper.shaft.diameter) &&
           same(scene.particles.mass_flow, paper.particles.mass_flow) && same(scene.air.volume_flow, paper.air.volume_flow) &&
           same(scene.burners.height, paper.burners.height) && scene.burners.count == paper.burners.count;
}

const char* word(bed_packing p) {
    switch (p) {
        case bed_packing::dem: return "packed by DEM";
        case bed_packing::lattice: return "on a lattice";
        case bed_packing::dense: return "at random, pushed apart";
    }
    return "";
}

const char* word(bed_motion m) {
    switch (m) {
        case bed_motion::dem: return "moved by DEM all the time";
        case bed_motion::recorded: return "moved by what DEM shows of its motion";
        case bed_motion::plug: return "sinking as a plug";
        case bed_motion::frozen: return "at rest";
    }
    return "";
}

const char* word(burning b) {
    switch (b) {
        case burning::none: return "no combustion";
        case burning::mixed_is_burnt: return "complete combustion where gas and air are mixed";
        case burning::equilibrium: return "combustion with CO/H2 in equilibrium";
        case burning::jones_lindstedt: return "combustion at finite rates, four steps, seven species";
    }
    return "";
}

}  // namespace

std::string duration(double seconds) {
    const auto s = static_cast<long>(std::ceil(std::max(0.0, seconds)));
    if (s < 60) return print("%ld s", s);
    if (s < 3600) return print("%ld min %02ld s", s / 60, s % 60);
    return print("%ld h %02ld min", s / 3600, s / 60 % 60);
}

std::string expectation(const settings& scene, const plan& planned) {
    std::string out = scene.title + "\n\n";
    out += print("  shaft      %.4g m high, %.4g m wide, %d burners at %.4g m\n", scene.shaft.height, scene.shaft.diameter,
                 scene.burners.count, scene.burners.height);
    out += print("  gas        %lld cells, %s\n", static_cast<long long>(planned.cells), word(scene.physics.combustion));
    out += print("  bed        %lld parcels that stand for %lld particles, %s, %s\n", static_cast<long long>(planned.parcels),
                 static_cast<long long>(planned.particles), word(scene.bed.packing), word(scene.bed.motion));
    if (planned.waiting > 0) out += print("  hopper     %lld parcels more, cold\n", static_cast<long long>(planned.waiting));
    out += print("  couplings  %d over %.3g residence times\n", planned.couplings, scene.time.residence_times);
    if (planned.motion_steps > 0) out += print("  motion     %.3g steps of DEM in each\n", planned.motion_steps);
    out += print("  expected   %s of memory, %s on one core (+-50 %%)\n", size_of(planned.memory).c_str(), duration(planned.seconds).c_str());
    if (!planned.left_out.empty()) out += "\nLeft out:\n";
    for (const plan::omission& o : planned.left_out) {
        out += "  " + o.what + ", because " + o.because + (o.saves.empty() ? "" : "; saves " + o.saves) + "\n";
    }
    return out;
}

std::string table_of(const shaft_profile& base, const std::vector<sensitivity>& all) {
    std::string out = "The one-dimensional model of the scene, and what it becomes with less and more of an input, each alone.\n\n";
    out += print("  %-44s | %13s | %13s | %13s | %13s\n", "input", "peak, K", "off-gas, K", "product, K", "drop, kPa");
    out += "  ---------------------------------------------+---------------+---------------+---------------+--------------\n";
    out += print("  %-44s | %13.0f | %13.0f | %13.0f | %13.1f\n", "as it is", base.peak_particle_temperature, base.offgas_temperature,
                 base.solids_outlet_temperature, 1e-3 * base.pressure_drop);
    for (const sensitivity& s : all) {
        const shaft_profile &a = s.less, &b = s.more;
        out += print("  %-44s | %5.0f to %4.0f | %5.0f to %4.0f | %5.0f to %4.0f | %4.1f to %5.1f%s\n", (s.input + (s.in_paper ? "" : " *")).c_str(),
                     a.peak_particle_temperature, b.peak_particle_temperature, a.offgas_temperature, b.offgas_temperature,
                     a.solids_outlet_temperature, b.solids_outlet_temperature, 1e-3 * a.pressure_drop, 1e-3 * b.pressure_drop,
                     a.converged && b.converged ? "" : "  (not converged)");
    }
    return out + "\n* assumed: the paper leaves it open\n";
}

std::string comparison(const settings& scene, const summary& s) {
    const bool paper = is_the_papers(scene);
    std::string out;
    const auto row = [&](const char* what, const char* in_paper, const summary::number& value, double scale, const char* format,
                         const char* unit) {
        char text[32] = "-";
        if (value) std::snprintf(text, sizeof text, format, *value * scale);
        out += print("  %-42s | %9s | %9s | %s\n", what, paper ? in_paper : "-", text, unit);
    };
    out += print("  %-42s | %9s | %9s | %s\n", "quantity", "paper", "this run", "unit");
    out += "  -------------------------------------------+-----------+-----------+---------\n";
    row("peak particle temperature", "2243", s.peak_particle_temperature, 1, "%.0f", "K");
    row("  its height", "8", s.peak_height, 1, "%.2f", "m");
    row("particles in the centre at that height", "2209", s.centre_temperature_at_peak, 1, "%.0f", "K");
    row("pressure drop (plant: 62)", "67", s.pressure_drop, 1e-3, "%.1f", "kPa");
    row("heat transfer coefficient, 5th percentile", "120", s.heat_transfer_coefficient_p05, 1, "%.0f", "W/(m2 K)");
    row("heat transfer coefficient, 95th percentile", "300", s.heat_transfer_coefficient_p95, 1, "%.0f", "W/(m2 K)");
    row("mean void fraction", "-", s.mean_void_fraction, 1, "%.3f", "-");
    row("off-gas temperature", "-", s.offgas_temperature, 1, "%.0f", "K");
    row("product temperature", "-", s.solids_outlet_temperature, 1, "%.0f", "K");
    row("wall heat loss", "-", s.wall_heat_loss, 1e-3, "%.1f", "kW");
    row("fuel power", "-", s.fuel_power, 1e-3, "%.0f", "kW");
    row("specific heat consumption", "-", s.specific_heat_consumption, 1, "%.0f", "kJ/kg");
    row("oxygen in the dry off-gas", "-", s.oxygen_dry_outlet, 100, "%.2f", "%");
    row("nitric oxide, dry, at 11 % O2", "-", s.nitric_oxide_outlet, 1, "%.0f", "mg/Nm3");
    summary::number share;
    if (s.enthalpy_imbalance && s.fuel_power && *s.fuel_power > 0) share = *s.enthalpy_imbalance / *s.fuel_power;
    row("steady enthalpy imbalance over fuel power", "-", share, 100, "%.2f", "%");
    summary::number audit;
    if (s.enthalpy_audit && s.fuel_power && *s.fuel_power > 0) audit = *s.enthalpy_audit / *s.fuel_power;
    row("  with what the bed stores", "-", audit, 100, "%.3f", "%");
    row("run time", "-", s.wall_time, 1, "%.0f", "s");
    if (!s.converged) {
        out += "\nNot steady yet: heat that comes and heat that leaves differ, or an outlet still drifts.  More time.residence_times\n"
               "and time.couplings bring it nearer.\n";
    }
    if (paper) {
        out +=
            "\nPaper: Spijker, Pollhammer, Raupenstrauch (2023), doi:10.1002/ceat.202200617.  It leaves open, and this run assumes:\n"
            "burner flow and equivalence ratio (temperatures), void fraction (pressure drop), heat loss of the wall (outlets).\n";
    }
    return out;
}

}  // namespace hearth::furnace::program
