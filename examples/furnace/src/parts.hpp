// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/gunn.hpp>
#include <hearth/closure/zhang.hpp>
#include <hearth/furnace/furnace.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/time/gas_exchange.hpp>
#include <hearth/time/thermal_network.hpp>
#include <hearth/time/tssm.hpp>
#include <hearth/transfer/conduction.hpp>
#include <hearth/transfer/convection.hpp>
#include <hearth/transfer/radiation.hpp>

#include "filling.hpp"
#include "gas_at_particles.hpp"
#include "packing.hpp"
#include "shaft_gas.hpp"
#include "steadying.hpp"
#include "stones.hpp"

namespace hearth::furnace {

using gas_convection = convection<closure::gunn, parabolic_particle>;
using stone_radiation = radiation<closure::feng_han::monte_carlo_fit, closure::wall_view::bed>;
using stone_conduction = conduction<closure::zhang::constriction>;

/// Adds the time of a block to a sum.
class stopwatch {
  public:
    explicit stopwatch(double& sum) : sum_(sum), begin_(std::chrono::steady_clock::now()) {}
    ~stopwatch() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }
    stopwatch(const stopwatch&) = delete;
    stopwatch& operator=(const stopwatch&) = delete;

  private:
    double& sum_;
    std::chrono::steady_clock::time_point begin_;
};

/// What each coupling did, one entry each: the books that balances and drifts are read from.  By the process's clock.
struct history {
    std::vector<double> gas_out;          ///< enthalpy of off-gas less air and burner gas [W]
    std::vector<double> solids_out;       ///< enthalpy of the product less the feed [W]
    std::vector<double> product;          ///< mass that left [kg]
    std::vector<double> product_enthalpy; ///< of that mass [J]
    std::vector<double> wall;             ///< to the ambient [W]
    std::vector<double> stored;           ///< by the bed [W]
    std::vector<double> offgas;           ///< [K]
    std::vector<double> peak;             ///< of the stones [K]
    std::vector<double> peak_height;      ///< [m]
    std::vector<double> centre;           ///< of the stones at that height [K]; NaN where none is near
    std::vector<double> pressure_drop;    ///< [Pa]
    std::vector<double> gas_missing;      ///< mass: in less out [kg/s]
    std::vector<double> solid_missing;    ///< mass: in less out less stored [kg/s]

    template <class Part>
    void each(Part&& part) {
        part("gas_out", gas_out);
        part("solids_out", solids_out);
        part("product", product);
        part("product_enthalpy", product_enthalpy);
        part("wall", wall);
        part("stored", stored);
        part("offgas", offgas);
        part("peak", peak);
        part("peak_height", peak_height);
        part("centre", centre);
        part("pressure_drop", pressure_drop);
        part("gas_missing", gas_missing);
        part("solid_missing", solid_missing);
    }
};

/// Wall time of this rank's work [s].
struct timings {
    double dem = 0, motion = 0, voidage = 0, transfer = 0, gas = 0, convection = 0, links = 0, radiation = 0, all = 0;
    std::vector<double> phases = std::vector<double>(5, 0.0);

    template <class Part>
    void each(Part&& part) {
        part("dem", dem);
        part("motion", motion);
        part("voidage", voidage);
        part("transfer", transfer);
        part("gas", gas);
        part("convection", convection);
        part("links", links);
        part("radiation", radiation);
        part("all", all);
        part("phases", phases);
    }
};

/// Mean of the last `count` entries, `back` of them left out at the end.
double recent_mean(const std::vector<double>& values, std::size_t count, std::size_t back = 0);

struct furnace::parts {
    parts(const settings& given, ranks given_ranks);

    void fill_step();
    void ignite();
    void couple();
    double step_length() const;  ///< of the next coupling, by the process's clock [s]
    std::size_t couplings_of_turn() const;
    void judge();
    void lead_to_steady();

    void use_bed(std::unique_ptr<dem::moving_bed> made);
    bool packed_by_dem() const { return scene.bed.packing == bed_packing::dem; }
    void fit_to_packing();
    void move(double process_time);
    void exchange_with_gas();
    void exchange_with_neighbours();
    void look_at_share();
    void tell_mechanisms();
    void place_bed();
    /// Height from which on parcels wait in the hopper, as the bed that sinks as a plug has them [m].
    double end_of_bed() const { return scene.shaft.hopper_fill > 0 ? scene.shaft.height : std::numeric_limits<double>::infinity(); }
    double mass_in_shaft() const;  ///< without the hopper [kg]
    double top() const { return scene.shaft.height + scene.shaft.hopper_height; }  ///< of the mesh [m]
    parcels cloud() const { return {*bed, fields, top()}; }
    double bed_enthalpy() const;
    std::size_t window() const;             ///< couplings that a balance is averaged over
    double imbalance(std::size_t back = 0) const;  ///< of the steady furnace, averaged [W]
    double element_imbalance() const;       ///< of the gas, over what brings them [-]
    double outlet_temperature(std::size_t back = 0) const;  ///< of the product, averaged [K]; 0 where nothing left
    std::size_t hottest_stone() const;
    double pressure_drop() const;
    /// Mean temperature of the stones about a height, from one share of the shaft's radius to another; NaN where there are none.
    double mean_temperature(double z, double from, double to) const;

    /// Visits everything that a step takes from the one before: saving and restoring both walk this list.
    /// part(name, array of doubles, vectors or numbers; or a number)
    template <class Part>
    void each_part(Part&& part);
    saved_state save();
    void restore(const saved_state& saved);

    ranks among;
    settings scene;
    settings measured;  ///< the scene with the void fraction that the bed has
    shaft_profile profile;
    phase now = phase::fill;
    double coarse_graining;
    shaft_gas shaft;
    std::optional<filling> fill;
    std::unique_ptr<dem::moving_bed> bed;
    stone_fields fields;
    wall_rings rings;
    shares share;
    tssm clock;
    hearth::scene<gas_convection> gas_terms;
    hearth::scene<stone_radiation, stone_conduction> stone_terms;
    gas_exchange exchange;
    thermal_network network;
    gas_at_particles seen;
    link_list<thermal_link<double>> links;
    gas::report gas_report;
    history past;
    steadying leap;

    double turn_length = 0;  ///< of a recorded motion until it repeats, by the process's clock [s]; 0 of others
    double bed_mass = 0, residence_time = 0, process_step = 0, process_time = 0;
    double wall_loss = 0, stranded = 0;
    double clamped = 0;
    int couplings = 0, leaps = 0, halved_leaps = 0;
    std::int64_t held = 0;  ///< times that a stone or a ring of the wall was held where a leap would have led it beyond what is steady
    bool converged = false;
    std::vector<double> product_hottest, product_hot_seconds;  // of watched parcels that left
    double fed_mass = 0, passed_mass = 0, passed_enthalpy = 0, passed_over_feed = 0;  // of this coupling
    timings seconds;
    timings slowest() const;  ///< each the largest of all ranks
};

}  // namespace hearth::furnace
