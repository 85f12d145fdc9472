// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <hearth/adapt/liggghts.hpp>  // before fvCFD.H, which opens namespace Foam: both have a Pair

#include "fvCFD.H"

#include <hearth/adapt/openfoam.hpp>
#include <hearth/closure/gidaspow.hpp>
#include <hearth/closure/gunn.hpp>
#include <hearth/mpi/communicator.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/gas_exchange.hpp>
#include <hearth/time/tssm_ledger.hpp>
#include <hearth/transfer/convection.hpp>
#include <hearth/transfer/drag.hpp>
#include <hearth/voidage/transfer_operator.hpp>

#include "../openfoam/gas_at_spheres.hpp"

/// The spheres of a running LIGGGHTS in the gas of an OpenFOAM solver: all that is between the two.  Drag and
/// heat are implicit in the gas; what one side gets the other loses, to round-off.
class spheres {
  public:
    /// density [kg/m^3], gravity [m/s^2]; of `gas` the constant properties.
    spheres(const fvMesh& mesh, const dictionary& dict, const host::gas_at_spheres& gas, double density,
            const vector& gravity)
        : mesh_(mesh),
          gas_(gas),
          density_(density),
          gravity_(gravity),
          clock_(dict.get<scalar>("acceleration"), dict.getOrDefault("paperStorage", false)
                                                       ? hearth::gas_storage::paper
                                                       : hearth::gas_storage::corrected),
          at_rest_(dict.getOrDefault("atRest", false)),
          caloric_{{dict.get<scalar>("specificHeat")}},
          cells_(mesh),
          graph_(cells_, hearth::mpi::communicator{}),
          locator_(cells_, graph_),
          transfer_(locator_) {
        // With `none` for screen or log LIGGGHTS crashes on insertion.
        const char* options[] = {"hearthFoam", "-screen", "liggghts.screen", "-log", "liggghts.log"};
        lammps_open(5, const_cast<char**>(options), MPI_COMM_WORLD, &dem_);
        lammps_file(dem_, dict.get<fileName>("script").c_str());
    }
    ~spheres() { lammps_close(dem_); }
    spheres(const spheres&) = delete;
    spheres& operator=(const spheres&) = delete;

    const hearth::tssm& clock() const { return clock_; }

    /// Makes the void fraction of where the spheres are now, and the map W of all that follows in this step.
    void place(volScalarField& void_fraction) {
        atoms_ = hearth::liggghts::atoms(dem_, ids_);
        scalarField solid(mesh_.nCells());
        transfer_.distribute(atoms_, solid);
        void_fraction.primitiveFieldRef() = 1 - solid;
        void_fraction.correctBoundaryConditions();
        see(void_fraction, gas_.void_fraction);
        gas_.density.assign(count(), density_);
    }

    /// Drag on the gas: force - coefficient * velocity, [N/m^3] and [kg/(m^3 s)].
    void drag(const volVectorField& velocity, scalarField& coefficient, vectorField& force) {
        see(velocity, gas_.velocity);
        drag_.resize(count());
        pushed_.resize(count());
        for (std::size_t i = 0; i < count(); ++i) {
            const auto exchange = hearth::drag{hearth::closure::gidaspow{}}.gas_force(
                hearth::view<hearth::strided_cloud<>>(atoms_, static_cast<std::int64_t>(i)),
                hearth::view<host::gas_at_spheres>(gas_, i), clock_);
            drag_[i] = exchange.coefficient;
            for (std::size_t a = 0; a < 3; ++a) pushed_[i][a] = drag_[i] * (gas_.velocity[i][a] - exchange.slip[a]);
        }
        give(drag_, coefficient);
        give(pushed_, force);
    }

    /// Forces on the spheres, from the gas after its step: drag, and their share of the pressure with its static part.
    void push(const volVectorField& velocity, const volVectorField& pressure_gradient, double step) {
        see(velocity, gas_.velocity);
        see(pressure_gradient, gas_.pressure_gradient);
        auto** force = static_cast<double**>(lammps_extract_fix(dem_, "push", 1, 2, 0, 0));
        for (std::size_t i = 0; i < count(); ++i) {
            const double r = atoms_.radius[at(i)], volume = 4.0 / 3.0 * hearth::constants<double>::pi() * r * r * r;
            for (std::size_t a = 0; a < 3; ++a) {
                const double drag = drag_[i] * gas_.velocity[i][a] - pushed_[i][a];
                const double pressure = -volume * gas_.pressure_gradient[i][a];
                force[i][a] = drag + pressure - volume * density_ * gravity_[static_cast<direction>(a)];
                drag_book_.particle(drag * step, 1);
                pressure_book_.particle(pressure * step, 1);
            }
        }
    }

    /// Books what the gas's equations had in each cell [N]: drag, and the share of the pressure that it left to
    /// spheres.
    void book(const vectorField& drag, const vectorField& pressure, double step) {
        forAll(drag, c) {
            for (direction a = 0; a < 3; ++a) {
                drag_book_.boundary(-drag[c][a] * step);
                pressure_book_.boundary(pressure[c][a] * step);
            }
        }
    }

    /// Heat into the gas: source - coefficient * temperature, [W/m^3] and [W/(m^3 K)].
    void heat(const volScalarField& temperature, double step, scalarField& coefficient, scalarField& source) {
        see(temperature, gas_.temperature);
        temperature_.assign(atoms_.temperature.first, atoms_.temperature.first + count());
        mass_.assign(atoms_.mass.first, atoms_.mass.first + count());
        std::vector<double> conductance;
        hearth::scene{hearth::convection{hearth::closure::gunn{}}}.gas_conductances(atoms_, gas_, conductance, clock_);
        exchange_.prepare(conductance, gas_.temperature, mass_, caloric_, clock_, step, temperature_);
        give(exchange_.coefficient(), coefficient);
        give(exchange_.source(), source);
    }

    /// Warms the spheres by the gas after its step; books it, and `lost` [J] of the gas's cells.
    void warm(const volScalarField& temperature, const scalarField& lost) {
        see(temperature, gas_.temperature);
        std::vector<hearth::particle_step<double>> taken;
        exchange_.finish(gas_.temperature, mass_, caloric_, clock_, temperature_, taken);
        std::copy(temperature_.begin(), temperature_.end(), atoms_.temperature.first);
        for (std::size_t i = 0; i < count(); ++i) heat_book_.particle(taken[i].heat, clock_.factor(i));
        for (const scalar joules : lost) heat_book_.boundary(joules);
    }

    /// LIGGGHTS moves the spheres, and books what of their momentum is neither hearth's force nor weight: walls.
    void move(double step) {
        if (at_rest_) return;
        auto** force = static_cast<double**>(lammps_extract_fix(dem_, "push", 1, 2, 0, 0));
        vector impulse(Zero), weight(Zero), before = momentum();
        for (std::size_t i = 0; i < count(); ++i) {
            impulse += step * vector(force[i][0], force[i][1], force[i][2]);
            weight += step * atoms_.mass[at(i)] * gravity_;
        }
        const double between = *static_cast<double*>(lammps_extract_global(dem_, "dt"));
        lammps_command(dem_, ("run " + std::to_string(std::lround(step / between))).c_str());
        atoms_ = hearth::liggghts::atoms(dem_, ids_);
        const vector gained = momentum() - before;
        reduce(impulse, sumOp<vector>());
        reduce(weight, sumOp<vector>());
        for (direction a = 0; a < 3; ++a) {
            motion_.particle(gained[a], 1);
            motion_.boundary(impulse[a]);
            motion_.boundary(weight[a]);
        }
    }

    /// What of drag, pressure and heat one side got and the other did not lose, and what of the spheres' momentum came
    /// from walls; of all that was moved [-].
    std::array<scalar, 4> imbalance() const {
        std::array<scalar, 4> result{};
        const hearth::tssm_ledger* books[] = {&drag_book_, &pressure_book_, &heat_book_, &motion_};
        for (std::size_t k = 0; k < result.size(); ++k) {
            const scalar moved = returnReduce(books[k]->turnover(), sumOp<scalar>());
            result[k] = mag(returnReduce(books[k]->imbalance(), sumOp<scalar>())) / max(moved, VSMALL);
        }
        return result;
    }

    /// Number, x y z, vertical velocity and temperature of each sphere of this rank.
    void write(const fileName& name) const {
        mkDir(name.path());
        OFstream file(name);
        file.precision(15);
        for (std::size_t i = 0; i < count(); ++i) {
            const double* x = atoms_.position.row(at(i));
            file << static_cast<label>(ids_[i]) << ' ' << x[0] << ' ' << x[1] << ' ' << x[2] << ' '
                 << atoms_.velocity.row(at(i))[2] << ' ' << atoms_.temperature[at(i)] << nl;
        }
    }

  private:
    std::size_t count() const { return ids_.size(); }
    static std::int64_t at(std::size_t i) { return static_cast<std::int64_t>(i); }

    vector momentum() const {
        vector sum(Zero);
        for (std::size_t i = 0; i < count(); ++i) {
            const double* v = atoms_.velocity.row(at(i));
            sum += atoms_.mass[at(i)] * vector(v[0], v[1], v[2]);
        }
        return returnReduce(sum, sumOp<vector>());
    }

    /// Gas at the spheres; and what the spheres give, over the cells' volumes.
    template <class Field, class Values>
    void see(const Field& cells, Values& values) {
        values.resize(count());
        transfer_.gather(cells, values);
    }
    template <class Values, class Field>
    void give(const Values& values, Field& cells) {
        transfer_.scatter(values, cells);
        cells /= mesh_.V();
    }

    const fvMesh& mesh_;
    host::gas_at_spheres gas_;
    double density_;
    vector gravity_;
    hearth::tssm clock_;
    bool at_rest_;  // the spheres hang still
    struct {
        hearth::constant_specific_heat<> all;
        auto operator()(std::size_t) const { return all; }
    } caloric_;
    hearth::openfoam::distributed_mesh cells_;  // one rank, too
    hearth::cell_graph<hearth::mpi::communicator> graph_;
    hearth::cell_locator<hearth::openfoam::distributed_mesh, hearth::mpi::communicator> locator_;
    hearth::transfer_operator<hearth::openfoam::distributed_mesh, hearth::mpi::communicator> transfer_;
    void* dem_ = nullptr;
    std::vector<std::int64_t> ids_;
    hearth::strided_cloud<> atoms_;
    std::vector<double> drag_, temperature_, mass_;  // coefficients [kg/s]; [K]; [kg]
    std::vector<host::point> pushed_;                // coefficient times true velocity of the sphere [N]
    hearth::gas_exchange exchange_;
    hearth::tssm_ledger drag_book_, pressure_book_, heat_book_, motion_;
};
