// SPDX-License-Identifier: MIT
//
// A flame inside a bed of hot spheres, and what the mixing time does to it.
//
// Cold premixed methane and air flow through spheres of a given temperature, as at the burners of a shaft furnace.  A
// parcel of gas is followed: reaction in the voids and exchange with the spheres, split after Strang.
//
// Checked: what the gas loses the spheres gain, and far downstream the gas is in equilibrium at their temperature.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <hearth/closure/gunn.hpp>
#include <hearth/combustion/chemistry.hpp>
#include <hearth/combustion/equilibrium.hpp>
#include <hearth/combustion/mixing.hpp>
#include <hearth/combustion/transport.hpp>

using namespace hearth::combustion;

namespace {

constexpr double void_fraction = 0.4, diameter = 0.01775, mass_flux = 1.63,
                 pressure = 1.05e5;        // [-] [m] [kg/(m^2 s)] [Pa]
constexpr double fresh_temperature = 300;  // [K]

struct flame {
    const char* name;
    chemistry::model kind;
    bool with_bed_time;
    double spheres;  ///< [K]
};

/// One parcel of gas, as the one cell of a batch.
struct parcel {
    std::array<double, species_count> y;
    double temperature = fresh_temperature, mixing_time = 0;

    per_species amount() const { return amounts(y); }
    double density() const { return pressure / (gas_constant * temperature * sum(amount())); }
    cell_arrays cell(bool mixing) {
        cell_arrays c{1, &pressure, &temperature, {}, 1, mixing ? &mixing_time : nullptr};
        for (std::size_t k = 0; k < species_count; ++k) c.mass_fraction[k] = &y[k];
        return c;
    }
};

/// Number of transfer units between gas and spheres over a length [-].
double transfer_units(const parcel& gas, double length) {
    const double cp = combine(gas.amount()).heat_capacity(gas.temperature);
    const transport_properties t = transport(gas.temperature, pressure, mole_fractions(gas.amount()));
    const double nusselt = hearth::closure::gunn::nusselt(void_fraction, mass_flux * diameter / t.viscosity,
                                                          t.viscosity * cp / t.conductivity);
    const double surface = 6 * (1 - void_fraction) / diameter;  // [m^2/m^3]
    return nusselt * t.conductivity / diameter * surface * length / (mass_flux * cp);
}

}  // namespace

int main() {
    using model = chemistry::model;
    const per_species fresh = amounts_from_moles({1, 2, 7.52, 0, 0, 0, 0});
    const double enthalpy_in = combine(fresh).enthalpy(fresh_temperature);
    const double combustion =
        enthalpy_in - combine(burn(fresh, enthalpy_in).amount).enthalpy(fresh_temperature);  // [J/kg]

    std::printf(
        "Stoichiometric CH4-air, %.0f K, %.2f kg/(m^2 s), into spheres of %.2f mm; void fraction %.1f\n\n"
        "spheres  mixing, chemistry          peak    at  CH4 gone  burnt  heat from spheres  90 %% given back\n"
        "    [K]                              [K]  [mm]      [mm]   [mm]  before it [%%]      within [mm]\n",
        fresh_temperature, mass_flux, 1e3 * diameter, void_fraction);
    bool good = true;
    for (const double spheres : {1500.0, 1800.0, 2200.0})
        for (const flame& f : {flame{"at once, finite rate", model::finite_rate, false, spheres},
                               flame{"bed's time, finite rate", model::finite_rate, true, spheres},
                               flame{"bed's time, equilibrium", model::equilibrium, true, spheres}}) {
            chemistry settings;
            settings.kind = f.kind;
            parcel gas;
            gas.y = mass_fractions(fresh);
            const cell_arrays cell = gas.cell(f.with_bed_time);
            const double dx = 1e-4, length = 1;  // [m]
            double peak = 0, peak_at = 0, fuel_gone_at = 0, burnt_at = 0, cooled_at = 0;
            double to_spheres = 0, before_peak = 0;  // [J/kg]
            for (double x = dx; x < length; x += dx) {
                const double speed = mass_flux / (gas.density() * void_fraction);
                gas.mixing_time = mixing_model::bed_time(1 - void_fraction, diameter, speed);
                good = advance(settings, 0.5 * dx / speed, cell).failed == 0 && good;
                const nasa7 mixture = combine(gas.amount());
                const double enthalpy = mixture.enthalpy(gas.temperature);
                gas.temperature += (f.spheres - gas.temperature) * -std::expm1(-transfer_units(gas, dx));
                to_spheres += enthalpy - mixture.enthalpy(gas.temperature);
                good = advance(settings, 0.5 * dx / speed, cell).failed == 0 && good;

                const per_species n = gas.amount(), end = equilibrium_at(n, gas.temperature, pressure);
                if (gas.temperature > peak) {
                    peak = gas.temperature;
                    peak_at = x;
                    before_peak = to_spheres;
                }
                if (gas.temperature - f.spheres > 0.1 * (peak - f.spheres)) cooled_at = x;
                if (n[CH4] > 0.01 * fresh[CH4]) fuel_gone_at = x;
                const double unburnt =
                    std::fabs(n[CO] - end[CO]) + std::fabs(n[H2] - end[H2]) + std::fabs(n[CH4] - end[CH4]);
                if (unburnt > 0.02 * fresh[CH4]) burnt_at = x;
            }
            const per_species n = gas.amount(), end = equilibrium_at(fresh, f.spheres, pressure);
            const double balance = (combine(n).enthalpy(gas.temperature) + to_spheres - enthalpy_in) / combustion;
            double apart = std::fabs(gas.temperature / f.spheres - 1);
            for (std::size_t k = 0; k < species_count; ++k)
                apart = std::max(apart, std::fabs(n[k] - end[k]) / sum(end));
            good = good && std::fabs(balance) < 1e-11 && apart < 1e-5;
            std::printf("%7.0f  %-25s %6.0f %5.1f %9.1f %6.1f %18.1f %16.1f   (balance %.0e, end %.0e)\n", f.spheres,
                        f.name, peak, 1e3 * peak_at, 1e3 * fuel_gone_at, 1e3 * burnt_at,
                        -1e2 * before_peak / combustion, 1e3 * (cooled_at - peak_at), balance, apart);
        }
    return good ? 0 : 1;
}
