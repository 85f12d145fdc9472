// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <hearth/furnace/ranks.hpp>
#include <hearth/furnace/settings.hpp>
#include <hearth/furnace/shaft_profile.hpp>
#include <hearth/gas/distributed.hpp>
#include <hearth/gas/generate.hpp>
#include <hearth/gas/mesh_traits.hpp>
#include <hearth/gas/solver.hpp>
#include <hearth/voidage/transfer_operator.hpp>

#include "mixture.hpp"
#include "reaction.hpp"

namespace hearth::furnace {

/// The gas of a shaft: mesh, solver, what enters and leaves, and the map between its cells and the parcels.  Cells are those
/// of this rank, and ghosts behind them; what is told of the whole is the same on every rank, and asked by all together.
class shaft_gas {
  public:
    shaft_gas(const settings& scene, double parcel_diameter, const ranks& among);
    shaft_gas(const shaft_gas&) = delete;
    shaft_gas& operator=(const shaft_gas&) = delete;

    /// Premixed gas of all burners [kg/s].
    void set_burners(double mass_flow);
    double burner_flow() const { return burner_flow_; }
    double air_flow() const { return air_flow_; }                ///< [kg/s]
    double fuel_power() const { return burner_flow_ * model->heating_value(); }  ///< [W]
    double burner_enthalpy() const { return burner_flow_ * model->cold_enthalpy(1, scene_.burners.temperature); }  ///< [W]
    /// Excess air: all oxygen over what the fuel needs [-]; 0 without fuel.
    double excess_air_ratio() const;

    /// Everything from a one-dimensional solution, or cold with hot gas around the burners.
    void start(const shaft_profile& profile);

    const std::string& outlet() const { return outlet_; }
    const gas::mesh& grid() const { return mesh_; }
    /// The mesh of all ranks, made anew.
    gas::mesh whole_grid() const;
    const gas::parallel& among() const { return among_; }
    /// Values of the cells of all ranks, by the cell's number in the whole mesh, on rank 0; nothing on the others.
    template <class Value>
    std::vector<Value> of_all_cells(std::vector<Value> own) const {
        own.resize(static_cast<std::size_t>(mesh_.owned_cells()));
        std::vector<Value> in_order = among_.communicator().gather_on_first(own), all(in_order.size());
        if (among_.ranks() == 1) return own;
        for (std::size_t k = 0; k < all.size(); ++k) all[static_cast<std::size_t>(order_[k])] = in_order[k];
        return all;
    }
    /// Mean of a value that cells have, over what leaves, by mass flow.
    double outlet_mean(const std::vector<double>& of_cells) const;
    /// The numbers that the gas carries in a cell.
    const double* carried(int cell) const { return &solver.gas.mass_fraction[model->species_count() * cell]; }
    /// Amounts of the seven species in a cell [mol/kg].
    combustion::per_species composition(int cell) const { return model->composition(solver.gas.temperature[cell], carried(cell)); }
    /// Chemistry for the next iteration of the gas, from the gas as it is; nothing without finite rates.
    void react();
    /// Nothing without finite rates.
    const std::optional<reaction>& chemistry() const { return chemistry_; }

  private:
    settings scene_;
    gas::mesh mesh_;
    gas::distributed<ranks> among_;
    std::vector<std::int64_t> order_;  // on rank 0: the cells of rank 0, of rank 1, ... in the whole mesh
    cell_graph<ranks> graph_;
    cell_locator<gas::mesh, ranks> locator_;
    std::string outlet_;
    double air_flow_ = 0, burner_flow_ = 0;
    std::optional<reaction> chemistry_;

  public:
    transfer_operator<gas::mesh, ranks> fill;      ///< for the solid fraction, as smooth as closures want it
    transfer_operator<gas::mesh, ranks> transfer;  ///< for the exchange of heat, no wider than it must be
    std::shared_ptr<const mixture> model;
    gas::solver solver;
};

/// Value of a profile's cells at a height, by straight lines between the cells' centres.
double at_height(const std::vector<double>& values, double z, double shaft_height);

gas::shaft shape_of(const settings& scene);

/// Cells that the mesh of a scene will have, told without making it.  Throws bad_scene where there can be no mesh.
std::int64_t cell_count_of(const settings& scene);

}  // namespace hearth::furnace
