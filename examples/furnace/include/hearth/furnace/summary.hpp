// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hearth::furnace {

/// What a run ends with.  A number that the scene's physics does not have, or that is not known yet, is absent; none is
/// ever made up.  Powers are rates by the process's clock; fractions of gases are of moles.
struct summary {
    using number = std::optional<double>;

    number peak_particle_temperature;        ///< [K]
    number peak_height;                      ///< [m]
    number centre_temperature_at_peak;       ///< mean within a fifth of the radius, at the height of the peak [K]
    number pressure_drop;                    ///< [Pa]
    number mean_void_fraction;               ///< of the shaft, from true sphere volumes [-]
    number offgas_temperature;               ///< [K]
    number solids_outlet_temperature;        ///< of the mean enthalpy of what left [K]
    number centre_minus_wall_at_1m;          ///< of the particles [K]
    number centre_minus_wall_at_5m;          ///< [K]
    number oxygen_dry_outlet;                ///< [-]
    number carbon_monoxide_outlet;           ///< [-]
    number wall_heat_loss;                   ///< [W]
    number fuel_power;                       ///< lower heating value times fuel flow [W]
    number enthalpy_imbalance;               ///< of the steady furnace: what comes less what leaves [W]
    number enthalpy_audit;                   ///< the same with storage: what the discrete balance lacks [W]
    number gas_mass_imbalance;               ///< [kg/s]
    number solid_mass_imbalance;             ///< fed less taken out less stored [kg/s]
    number element_imbalance;                ///< greatest of C, H, O, N, over its flow [-]
    number heat_transfer_coefficient_p05;    ///< over particles from 0.5 m to 0.2 m below the burners [W/(m^2 K)]
    number heat_transfer_coefficient_p95;    ///< [W/(m^2 K)]
    number nitric_oxide_outlet;              ///< dry, at 11 % oxygen [mg/Nm^3]
    number methane_outlet;                   ///< [-]
    number specific_heat_consumption;        ///< fuel power over solids [kJ/kg]
    number excess_air_ratio;                 ///< of all air over that of complete combustion [-]
    number product_share_above_2130_K;       ///< share of the product whose greatest temperature passed it [-]
    number product_share_above_2320_K;       ///< [-]
    number median_time_above_2130_K;         ///< by the process's clock, of the product that left [s]
    number bed_mass;                         ///< [kg]
    number residence_time;                   ///< bed mass over solids flow [h]
    number maximum_temperature;              ///< of gas and particles [K]
    number stranded_volume;                  ///< solid that no cell could take [m^3]
    number clamped_evaluations;              ///< closures outside of their range and gas outside of its tables
    number steadying_leaps;                  ///< towards the steady state [-]
    number steadying_leaps_halved;           ///< or left out, as they led slices of the bed beyond what can be steady [-]
    number steadying_held;                   ///< times that a stone or ring was held where a leap led it there [-]
    number acceleration_factor;              ///< Gamma, also where the scene left it to the program [-]
    number coupling_time_over_allowance;     ///< voidage and transfer, time of all ranks over 0.5 us a cell and 2 us a parcel for each coupling [-]
    number coupling_share;                   ///< of the wall time: voidage and transfer [-]
    number wall_time;                        ///< [s]
    number peak_memory;                      ///< [bytes]

    struct timing {
        std::string name;
        double seconds;
    };
    std::vector<timing> phases;   ///< wall time of each
    std::vector<timing> modules;  ///< dem, voidage, transfer, gas, combustion, radiation, ...

    bool converged = false;
    std::vector<std::string> warnings;  ///< temperatures that only preheated gas explains, and the like
};

/// Every number of a summary once, with the key that files use, unit included: visit(key, value), value an
/// std::optional<double>.  Summary is summary or const summary.
template <class Summary, class Visit>
void for_each_number(Summary& s, Visit&& visit) {
    visit("peak_particle_temperature_K", s.peak_particle_temperature);
    visit("peak_height_m", s.peak_height);
    visit("centre_temperature_at_peak_K", s.centre_temperature_at_peak);
    visit("pressure_drop_Pa", s.pressure_drop);
    visit("mean_void_fraction", s.mean_void_fraction);
    visit("offgas_temperature_K", s.offgas_temperature);
    visit("solids_outlet_temperature_K", s.solids_outlet_temperature);
    visit("centre_minus_wall_K_at_1m", s.centre_minus_wall_at_1m);
    visit("centre_minus_wall_K_at_5m", s.centre_minus_wall_at_5m);
    visit("oxygen_dry_mole_fraction_outlet", s.oxygen_dry_outlet);
    visit("carbon_monoxide_mole_fraction_outlet", s.carbon_monoxide_outlet);
    visit("wall_heat_loss_W", s.wall_heat_loss);
    visit("fuel_power_W", s.fuel_power);
    visit("enthalpy_imbalance_W", s.enthalpy_imbalance);
    visit("enthalpy_audit_W", s.enthalpy_audit);
    visit("gas_mass_imbalance_kg_per_s", s.gas_mass_imbalance);
    visit("solid_mass_imbalance_kg_per_s", s.solid_mass_imbalance);
    visit("element_imbalance", s.element_imbalance);
    visit("heat_transfer_coefficient_p05_W_per_m2K", s.heat_transfer_coefficient_p05);
    visit("heat_transfer_coefficient_p95_W_per_m2K", s.heat_transfer_coefficient_p95);
    visit("nitric_oxide_outlet_mg_per_Nm3_dry_at_11_percent_O2", s.nitric_oxide_outlet);
    visit("methane_mole_fraction_outlet", s.methane_outlet);
    visit("specific_heat_consumption_kJ_per_kg", s.specific_heat_consumption);
    visit("excess_air_ratio", s.excess_air_ratio);
    visit("product_share_above_2130_K", s.product_share_above_2130_K);
    visit("product_share_above_2320_K", s.product_share_above_2320_K);
    visit("median_time_above_2130_K_s", s.median_time_above_2130_K);
    visit("bed_mass_kg", s.bed_mass);
    visit("residence_time_h", s.residence_time);
    visit("maximum_temperature_K", s.maximum_temperature);
    visit("stranded_volume_m3", s.stranded_volume);
    visit("clamped_evaluations", s.clamped_evaluations);
    visit("steadying_leaps", s.steadying_leaps);
    visit("steadying_leaps_halved", s.steadying_leaps_halved);
    visit("steadying_held", s.steadying_held);
    visit("acceleration_factor", s.acceleration_factor);
    visit("coupling_time_over_allowance", s.coupling_time_over_allowance);
    visit("coupling_share", s.coupling_share);
    visit("wall_time_s", s.wall_time);
    visit("peak_memory_bytes", s.peak_memory);
}

}  // namespace hearth::furnace
