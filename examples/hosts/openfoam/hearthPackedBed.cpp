// SPDX-License-Identifier: MIT
// A source for OpenFOAM's own solvers: a resting bed of spheres that brakes the gas by Ergun's drag and exchanges heat
// with it by Gunn's, both through hearth's transfer operator, with Time Scale Splitting.  In constant/fvOptions:
//
//     bed
//     {
//         type         hearthPackedBed;
//         particles    "bed.csv";       // x y z radius of each [m]
//         energy       h;               // the solver's energy field, h or e
//         density 2500; specificHeat 840; temperature 300; acceleration 200;        // of the bed
//         gas { viscosity 1.8e-5; conductivity 0.026; specificHeat 1005; }
//     }
//
// OpenFOAM's standard solvers know no porosity: their U is superficial, and the gas pays the full pressure drop, which
// is the drag over the void fraction.  The force is on its secant in U; heat is what the spheres took, to round-off.
//
// Linked with OpenFOAM, so the library is under the GPL; this file is not.
#include "fvCFD.H"
#include "fvOption.H"
#include "addToRunTimeSelectionTable.H"

#include <hearth/adapt/openfoam.hpp>
#include <hearth/closure/ergun.hpp>
#include <hearth/closure/gunn.hpp>
#include <hearth/core/strided_cloud.hpp>
#include <hearth/mpi/communicator.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/particle_energy.hpp>
#include <hearth/transfer/convection.hpp>
#include <hearth/transfer/drag.hpp>
#include <hearth/voidage/transfer_operator.hpp>

#include "gas_at_spheres.hpp"
#include "read_particles.hpp"

#include <array>
#include <tuple>
#include <variant>
#include <vector>

namespace {

/// The bed on one kind of mesh, serial or spread over ranks.
template <class Mesh, class Communicator>
class packed_bed {
  public:
    packed_bed(const Mesh& cells, const dictionary& dict, const scalarField& volumes)
        : list_(read_particles(dict.get<fileName>("particles"))),
          volumes_(volumes),
          clock_(dict.get<scalar>("acceleration")),
          caloric_{dict.get<scalar>("specificHeat")},
          graph_(cells, Communicator{}),
          locator_(cells, graph_),
          transfer_(locator_) {
        const dictionary& gas = dict.subDict("gas");
        gas_.viscosity = gas.get<scalar>("viscosity");
        gas_.conductivity = gas.get<scalar>("conductivity");
        gas_.specific_heat = gas.get<scalar>("specificHeat");
        const auto count = list_.ids.size();
        temperature_.assign(count, dict.get<scalar>("temperature"));
        heat_rate_.assign(count, 0.0);
        force_.assign(3 * count, 0.0);
        for (std::size_t i = 0; i < count; ++i) {
            const double r = list_.rows[4 * i + 3];
            mass_.push_back(4.0 / 3.0 * hearth::constants<double>::pi() * r * r * r * dict.get<scalar>("density"));
        }
        cloud_ = list_.view();
        cloud_.velocity = {rest_, 0};
        cloud_.temperature = {temperature_.data(), 1};
        cloud_.heat_rate = {heat_rate_.data(), 1};
        cloud_.force = {force_.data(), 3};
        std::vector<double> void_fraction(static_cast<std::size_t>(volumes.size()));
        transfer_.distribute(cloud_, void_fraction);
        for (double& e : void_fraction) e = 1 - e;
        see(void_fraction, gas_.void_fraction);
    }

    /// Coefficient [kg/(m^3 s)] and force [N/m^3] on the gas of each cell.
    void drag(const volScalarField& rho, const volVectorField& velocity, scalarField& coefficient, vectorField& force) {
        see(rho, gas_.density);
        see(velocity, gas_.velocity);
        for (std::size_t i = 0; i < count(); ++i) {
            for (double& u : gas_.velocity[i]) u /= gas_.void_fraction[i];
        }
        gas_.force.resize(count());
        hearth::scene{hearth::drag{hearth::closure::ergun{}}}.accumulate(cloud_, gas_, clock_);
        std::vector<double> per_slip(count());
        for (std::size_t i = 0; i < count(); ++i) {
            double along = 0, square = 1e-300;
            for (std::size_t a = 0; a < 3; ++a) {
                along -= gas_.force[i][a] * gas_.velocity[i][a];
                square += gas_.velocity[i][a] * gas_.velocity[i][a];
                gas_.force[i][a] /= gas_.void_fraction[i];
            }
            per_slip[i] = along / square / (gas_.void_fraction[i] * gas_.void_fraction[i]);
        }
        transfer_.scatter(std::tie(per_slip, gas_.force), std::tie(coefficient, force));
        coefficient /= volumes_;
        force /= volumes_;
    }

    /// Heats the spheres for one step [s] and gives what the gas of each cell got from them [W/m^3].
    void heat(const volScalarField& rho, const volVectorField& velocity, const volScalarField& temperature, double step,
              scalarField& source) {
        see(rho, gas_.density);
        see(velocity, gas_.velocity);
        see(temperature, gas_.temperature);
        for (std::size_t i = 0; i < count(); ++i) {
            for (double& u : gas_.velocity[i]) u /= gas_.void_fraction[i];
        }
        std::vector<double> conductance, given(count());
        hearth::scene{hearth::convection{hearth::closure::gunn{}}}.gas_conductances(cloud_, gas_, conductance, clock_);
        for (std::size_t i = 0; i < count(); ++i) {
            hearth::heat_bath<double> bath;
            bath.add(hearth::conductive_link<double>{conductance[i]}, gas_.temperature[i]);
            const auto taken =
                hearth::etd2_secant::advance(temperature_[i], mass_[i], caloric_, bath, clock_.factor(i) * step);
            temperature_[i] = taken.temperature;
            given[i] = -taken.heat / (clock_.factor(i) * step);
            taken_ += taken.heat / clock_.factor(i);
        }
        transfer_.scatter(given, source);
        given_ -= sum(source) * step;
        source /= volumes_;
    }

    /// Heat into the bed over its acceleration, and heat out of the gas, since the start [J].
    std::array<scalar, 2> ledger() const {
        return {returnReduce(taken_, sumOp<scalar>()), returnReduce(given_, sumOp<scalar>())};
    }

    void write(const fileName& name) const {
        mkDir(name.path());
        OFstream file(name);
        file.precision(12);
        for (std::size_t i = 0; i < count(); ++i) {
            const double* x = &list_.rows[4 * i];
            file << x[0] << ' ' << x[1] << ' ' << x[2] << ' ' << temperature_[i] << nl;
        }
    }

  private:
    std::size_t count() const { return list_.ids.size(); }
    template <class Field, class Values>
    void see(const Field& cells, Values& values) {
        values.resize(count());
        transfer_.gather(cells, values);
    }

    particle_list list_;
    const scalarField& volumes_;
    hearth::tssm clock_;
    hearth::constant_specific_heat<> caloric_;
    hearth::cell_graph<Communicator> graph_;
    hearth::cell_locator<Mesh, Communicator> locator_;
    hearth::transfer_operator<Mesh, Communicator> transfer_;
    std::vector<double> mass_, temperature_, heat_rate_, force_;
    hearth::strided_cloud<> cloud_;
    host::gas_at_spheres gas_{};
    double rest_[3] = {0, 0, 0};
    scalar taken_ = 0, given_ = 0;
};

using distributed = hearth::openfoam::distributed_mesh;

}  // namespace

namespace Foam {
namespace fv {

class hearthPackedBed : public option {
  public:
    TypeName("hearthPackedBed");

    hearthPackedBed(const word& name, const word& type, const dictionary& dict, const fvMesh& mesh)
        : option(name, type, dict, mesh) {
        fieldNames_ = {"U", coeffs_.get<word>("energy")};
        applied_.setSize(2, false);
        if (Pstream::parRun()) {
            cells_.reset(new distributed(mesh));
            bed_.emplace<2>(*cells_, coeffs_, mesh.V());
        } else {
            bed_.emplace<1>(mesh, coeffs_, mesh.V());
        }
    }

    void addSup(const volScalarField& rho, fvMatrix<vector>& eqn, const label) override {
        scalarField coefficient(mesh_.nCells());
        vectorField force(mesh_.nCells());
        on_bed([&](auto& bed) { bed.drag(rho, eqn.psi(), coefficient, force); });
        // Diagonal and source of a matrix stand on its left: a force on the gas counts negative, times the volume.
        eqn.diag() -= coefficient * mesh_.V();
        eqn.source() -= (coefficient * eqn.psi().primitiveField() + force) * mesh_.V();
    }

    void addSup(const volScalarField& rho, fvMatrix<scalar>& eqn, const label) override {
        scalarField heat(mesh_.nCells());
        const auto& db = mesh_.thisDb();
        if (heated_ == mesh_.time().timeIndex()) FatalErrorInFunction << "one outer corrector only" << exit(FatalError);
        heated_ = mesh_.time().timeIndex();
        on_bed([&](auto& bed) {
            bed.heat(rho, db.lookupObject<volVectorField>("U"), db.lookupObject<volScalarField>("T"),
                     mesh_.time().deltaTValue(), heat);
            const auto [taken, given] = bed.ledger();
            Info << "hearth: bed took " << taken << " J, gas gave " << given << " J, difference " << mag(taken - given)
                 << endl;
            if (mesh_.time().writeTime()) bed.write(mesh_.time().timePath() / "hearthParticles");
        });
        eqn.source() -= heat * mesh_.V();
    }

    bool read(const dictionary& dict) override { return option::read(dict); }

  private:
    template <class Body>
    void on_bed(Body&& body) {
        if (bed_.index() == 1)
            body(std::get<1>(bed_));
        else
            body(std::get<2>(bed_));
    }

    autoPtr<distributed> cells_;
    std::variant<std::monostate, packed_bed<fvMesh, hearth::serial_communicator>,
                 packed_bed<distributed, hearth::mpi::communicator>>
        bed_;
    label heated_ = -1;
};

defineTypeNameAndDebug(hearthPackedBed, 0);
addToRunTimeSelectionTable(option, hearthPackedBed, dictionary);

}  // namespace fv
}  // namespace Foam
