// SPDX-License-Identifier: MIT
#include <hearth/furnace/shaft_profile.hpp>

#include <Eigen/Sparse>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <hearth/closure/air.hpp>
#include <hearth/closure/drag.hpp>
#include <hearth/closure/ergun.hpp>
#include <hearth/closure/gunn.hpp>
#include <hearth/combustion/thermo.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/furnace/spinel.hpp>

#include "mixture.hpp"

namespace hearth::furnace {
namespace {

namespace chem = hearth::combustion;

constexpr double pi = 3.14159265358979323846;

/// Air by moles, and a stoichiometric amount of it per mole of methane: CH4 + 2 O2.
chem::per_species air_moles(double moles) {
    chem::per_species n{};
    n[chem::O2] = 0.21 * moles;
    n[chem::N2] = 0.79 * moles;
    return n;
}

double mass_of(const chem::per_species& moles) {
    double mass = 0;
    for (std::size_t k = 0; k < chem::species_count; ++k) mass += moles[k] * chem::molar_mass[k];
    return mass;
}

/// A flow of gas: moles of each species per second, and its heat.
struct gas_flow {
    chem::per_species moles{};  // [mol/s]
    double mass = 0;            // [kg/s]
    chem::nasa7 heat;           // of the whole flow: enthalpy in W, heat capacity in W/K

    explicit gas_flow(const chem::per_species& given = {}) : moles(given), mass(mass_of(given)), heat(chem::combine(given)) {}

    /// The same elements, burnt: complete combustion in enough oxygen.
    gas_flow burnt() const {
        chem::per_species n = moles;
        const double fuel = n[chem::CH4];
        if (n[chem::O2] < 2 * fuel) {
            std::ostringstream out;
            out << "burners.equivalence_ratio leaves fuel above the burners: " << fuel << " mol/s of CH4 meet " << n[chem::O2]
                << " mol/s of O2, allowed: at least twice as much";
            throw bad_scene(out.str());
        }
        n[chem::CH4] = 0;
        n[chem::O2] -= 2 * fuel;
        n[chem::CO2] += fuel;
        n[chem::H2O] += 2 * fuel;
        return gas_flow(n);
    }
};

/// That of air [Pa s]; burnt gas differs by less than 10 %.
double viscosity(double t) { return closure::air::viscosity(t); }
constexpr double prandtl = 0.71;

/// View of the particles' bed as a heat conductor: k = 4 sigma F d T^3 with F of own Monte Carlo over random packings
/// (1.007 at void fraction 0.382, 1.068 at 0.423), linear in between and beyond.
double radiation_factor(double void_fraction) { return 1.007 + (1.068 - 1.007) / (0.423 - 0.382) * (void_fraction - 0.382); }

class shaft {
  public:
    shaft(const settings& scene, int cells) : scene_(scene), cells_(static_cast<std::size_t>(cells)), dz_(scene.shaft.height / cells) {
        const double d = scene.shaft.diameter;
        section_ = pi / 4 * d * d;
        double inverse = 0;  // Sauter mean: the diameter with the bed's surface per volume
        for (const size_class& size : scene.particles.sizes) inverse += size.mass_share / size.diameter;
        diameter_ = 1 / inverse;
        surface_ = 6 * (1 - scene.bed.void_fraction) / diameter_ * section_ * dz_;
        set_gas();
        losses_.assign(cells_, 0);
        ambients_.assign(cells_, 0);
        for (std::size_t k = 0; k < cells_; ++k) {
            for (const wall_zone& zone : scene.shaft.zones) {
                if (height(k) < zone.from || height(k) >= zone.to) continue;
                losses_[k] = zone.transmittance * pi * d * dz_;
                ambients_[k] = zone.ambient_temperature;
            }
        }
        pressure_.assign(cells_, scene.gas.pressure);
    }

    double height(std::size_t k) const { return (static_cast<double>(k) + 0.5) * dz_; }

    /// Unknowns: gas and particle temperature of each cell in turn.
    Eigen::VectorXd start() const {
        Eigen::VectorXd x(static_cast<Eigen::Index>(2 * cells_));
        const double peak = scene_.burners.height / scene_.shaft.height;
        for (std::size_t k = 0; k < cells_; ++k) {
            const double z = height(k) / scene_.shaft.height;
            double t = scene_.air.temperature + z * (scene_.particles.feed_temperature - scene_.air.temperature);
            if (fuel_power_ > 0) t = 400 + 1700 * (z < peak ? z / peak : (1 - z) / (1 - peak));
            x[static_cast<Eigen::Index>(2 * k)] = x[static_cast<Eigen::Index>(2 * k + 1)] = t;
        }
        return x;
    }

    /// Unknowns with particles as given and the gas that passes them.
    Eigen::VectorXd beside(const std::vector<double>& particles) const {
        Eigen::VectorXd x(static_cast<Eigen::Index>(2 * cells_));
        for (std::size_t k = 0; k < cells_; ++k) {
            const auto g = static_cast<Eigen::Index>(2 * k);
            x[g + 1] = particles[k];
            x[g] = gas_[k].heat.temperature(pass(k, k == 0 ? 0 : x[g - 2], particles[k]).leaves, particles[k]);
        }
        return x;
    }

    /// Heat balances of gas and particles in each cell [W], and what a profile reports of them.
    Eigen::VectorXd balances(const Eigen::VectorXd& x, shaft_profile* report = nullptr) const {
        Eigen::VectorXd residual(x.size());
        const double flow = scene_.particles.mass_flow;
        double loss = 0;
        for (std::size_t k = 0; k < cells_; ++k) {
            const auto g = static_cast<Eigen::Index>(2 * k), s = g + 1;
            const auto [heat, leaves, h] = pass(k, k == 0 ? 0 : x[g - 2], x[s]);
            residual[g] = leaves - gas_[k].heat.enthalpy(x[g]);
            const double above = k + 1 < cells_ ? x[s + 2] : scene_.particles.feed_temperature;
            double sum = flow * (spinel::enthalpy(above) - spinel::enthalpy(x[s])) + heat - losses_[k] * (x[s] - ambients_[k]);
            if (k > 0) sum -= radiation(x[s - 2], x[s]);
            if (k + 1 < cells_) sum += radiation(x[s], x[s + 2]);
            residual[s] = sum;
            loss += losses_[k] * (x[s] - ambients_[k]);
            if (report != nullptr) report->heat_transfer_coefficient[k] = h;
        }
        if (report != nullptr) report->wall_heat_loss = loss;
        return residual;
    }

    /// Ergun from the outlet down, with the density of each cell.
    void find_pressure(const Eigen::VectorXd& x) {
        double above = scene_.gas.pressure;
        for (std::size_t k = cells_; k-- > 0;) {
            const double t = x[static_cast<Eigen::Index>(2 * k)];
            double moles = 0;
            for (const double n : gas_[k].moles) moles += n;
            double middle = above;
            for (int pass = 0; pass < 4; ++pass) {
                const double volume_flow = moles * chem::gas_constant * t / middle;
                const double density = gas_[k].mass / std::max(volume_flow, 1e-300);
                const double velocity = volume_flow / section_;
                const double e = scene_.bed.void_fraction;
                const double gradient = closure::pressure_gradient(
                    closure::ergun{}, closure::bed_flow<double>{e, velocity / e, density, viscosity(t), diameter_});
                middle = above + 0.5 * dz_ * (gradient + density * 9.81);
            }
            pressure_[k] = middle;
            above = 2 * middle - above;
        }
        bottom_pressure_ = above;
    }

    shaft_profile report(const Eigen::VectorXd& x) const {
        shaft_profile profile;
        profile.heat_transfer_coefficient.resize(cells_);
        balances(x, &profile);
        for (std::size_t k = 0; k < cells_; ++k) {
            profile.height.push_back(height(k));
            profile.gas_temperature.push_back(x[static_cast<Eigen::Index>(2 * k)]);
            profile.particle_temperature.push_back(x[static_cast<Eigen::Index>(2 * k + 1)]);
        }
        profile.pressure = pressure_;
        const auto peak = std::max_element(profile.particle_temperature.begin(), profile.particle_temperature.end());
        profile.peak_particle_temperature = *peak;
        profile.peak_height = height(static_cast<std::size_t>(peak - profile.particle_temperature.begin()));
        profile.offgas_temperature = profile.gas_temperature.back();
        profile.solids_outlet_temperature = profile.particle_temperature.front();
        profile.pressure_drop = bottom_pressure_ - scene_.gas.pressure;
        profile.fuel_power = fuel_power_;
        const double solids = scene_.particles.mass_flow * (spinel::enthalpy(scene_.particles.feed_temperature) -
                                                            spinel::enthalpy(profile.solids_outlet_temperature));
        const double gas = gas_below_.heat.enthalpy(scene_.air.temperature) + fed_total_ - gas_.back().heat.enthalpy(profile.offgas_temperature);
        profile.enthalpy_imbalance = (solids + gas - profile.wall_heat_loss) / std::max(fuel_power_, 1.0);
        return profile;
    }

    temperature_range range() const {
        temperature_range found{std::min(scene_.air.temperature, scene_.particles.feed_temperature),
                                std::max({scene_.air.temperature, scene_.particles.feed_temperature, flame()})};
        if (burner_gas_.mass > 0) found.coldest = std::min(found.coldest, scene_.burners.temperature);
        for (std::size_t k = 0; k < cells_; ++k) {
            if (!(losses_[k] > 0)) continue;
            found.coldest = std::min(found.coldest, ambients_[k]);
            found.hottest = std::max(found.hottest, ambients_[k]);
        }
        return found;
    }

  private:
    struct passage {
        double heat;         // to the particles [W]
        double leaves;       // enthalpy of the gas [W]
        double coefficient;  // of heat transfer [W/(m^2 K)]
    };
    /// Gas of the cell below, and what is fed, pass the particles of a cell and near their temperature by transfer units.
    passage pass(std::size_t k, double gas_below, double particles) const {
        const gas_flow& gas = gas_[k];
        const double entering = (k == 0 ? gas_below_.heat.enthalpy(scene_.air.temperature) : gas_[k - 1].heat.enthalpy(gas_below)) + fed_[k];
        const double mixed = gas.heat.temperature(entering, k == 0 ? 300.0 : gas_below);
        const double film = std::clamp(0.5 * (mixed + particles), 200.0, 3500.0);
        const double h = transfer_coefficient(gas, film, particles);
        const double capacity = gas.heat.heat_capacity(film);
        const double heat = capacity > 0 ? capacity * -std::expm1(-h * surface_ / capacity) * (mixed - particles) : 0;
        return {heat, entering - heat, h};
    }

    /// Of the burners' gas, completely burnt with air as hot as itself where it lacks oxygen [K].
    double flame() const {
        if (!(burner_gas_.mass > 0)) return 0;
        const gas_flow air(air_moles(std::max(0.0, 2 * burner_gas_.moles[chem::CH4] - burner_gas_.moles[chem::O2]) / 0.21));
        chem::per_species all = burner_gas_.moles;
        for (std::size_t i = 0; i < chem::species_count; ++i) all[i] += air.moles[i];
        all[chem::O2] = std::max(all[chem::O2], 2 * all[chem::CH4]);  // not a rounding less
        chem::nasa7 gained = gas_flow(all).burnt().heat;
        gained.add(-1, air.heat);  // it comes and leaves with the flame's own temperature
        return gained.temperature(burner_gas_.heat.enthalpy(scene_.burners.temperature));
    }

    void set_gas() {
        const double air = scene_.air.volume_flow * 101325 / (chem::gas_constant * 273.15);  // [mol/s]
        gas_below_ = gas_flow(air_moles(air));
        const double phi = fuel_ratio(scene_);
        chem::per_species mixture = air_moles(2 / 0.21);
        mixture[chem::CH4] = phi;
        const double share = scene_.burners.count > 0 ? scene_.burners.mass_flow / mass_of(mixture) : 0.0;
        for (double& n : mixture) n *= share;
        // A burner's jet spreads over about its own distance from the next: the gas is fed over 0.1 m.
        const double from = scene_.burners.height - 0.05, to = scene_.burners.height + 0.05;
        chem::per_species fed{};
        fed_.assign(cells_, 0);
        burner_gas_ = gas_flow(mixture);
        const double fed_enthalpy = burner_gas_.heat.enthalpy(scene_.burners.temperature);
        for (std::size_t k = 0; k < cells_; ++k) {
            const double low = static_cast<double>(k) * dz_;
            const double part = std::clamp((std::min(low + dz_, to) - std::max(low, from)) / (to - from), 0.0, 1.0);
            for (std::size_t i = 0; i < chem::species_count; ++i) fed[i] += part * mixture[i];
            fed_[k] = part * fed_enthalpy;
            fed_total_ += fed_[k];
            chem::per_species all = fed;
            for (std::size_t i = 0; i < chem::species_count; ++i) all[i] += gas_below_.moles[i];
            gas_.push_back(gas_flow(all).burnt());
        }
        chem::per_species with_air = mixture;  // rich gas takes what it lacks from the air
        with_air[chem::O2] = std::max(mixture[chem::O2], 2 * mixture[chem::CH4]);
        const gas_flow enough(with_air);
        fuel_power_ = enough.heat.enthalpy(298.15) - enough.burnt().heat.enthalpy(298.15);
    }

    double transfer_coefficient(const gas_flow& gas, double film, double solid) const {
        const double mu = viscosity(film);
        const double reynolds = gas.mass / section_ * diameter_ / mu;
        const double conductivity = gas.heat.heat_capacity(film) / std::max(gas.mass, 1e-300) * mu / prandtl;
        const double h = closure::gunn::nusselt(scene_.bed.void_fraction, reynolds, prandtl) * conductivity / diameter_;
        return 1 / (1 / h + diameter_ / (10 * spinel::conductivity(std::clamp(solid, 200.0, 3500.0))));
    }

    /// Heat that radiation carries down from the upper of two cells [W].
    double radiation(double below, double above) const {
        if (!scene_.physics.radiation) return 0;
        const double secant = constants<double>::stefan_boltzmann() * (above + below) * (above * above + below * below);
        return radiation_factor(scene_.bed.void_fraction) * scene_.particles.emissivity * diameter_ * secant * section_ / dz_ * (above - below);
    }

    const settings& scene_;
    std::size_t cells_;
    double dz_, section_ = 0, diameter_ = 0, surface_ = 0, bottom_pressure_ = 0, fuel_power_ = 0, fed_total_ = 0;
    gas_flow gas_below_, burner_gas_;
    std::vector<gas_flow> gas_;
    std::vector<double> fed_, losses_, ambients_, pressure_;
};

/// The Jacobian by differences: a balance sees the temperatures of its own cell and of the next ones, so every third
/// cell can be disturbed at once.
Eigen::SparseMatrix<double> jacobian(const shaft& model, const Eigen::VectorXd& x, const Eigen::VectorXd& at_x) {
    const Eigen::Index cells = x.size() / 2;
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index colour = 0; colour < 6; ++colour) {
        Eigen::VectorXd disturbed = x;
        const Eigen::Index variable = colour % 2, first = colour / 2;
        for (Eigen::Index k = first; k < cells; k += 3) disturbed[2 * k + variable] += 1e-4;
        const Eigen::VectorXd change = (model.balances(disturbed) - at_x) / 1e-4;
        for (Eigen::Index k = first; k < cells; k += 3) {
            for (Eigen::Index row = std::max<Eigen::Index>(0, 2 * (k - 1)); row < std::min(2 * (k + 2), 2 * cells); ++row) {
                if (change[row] != 0) entries.emplace_back(row, 2 * k + variable, change[row]);
            }
        }
    }
    Eigen::SparseMatrix<double> matrix(x.size(), x.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

struct newton {
    Eigen::VectorXd x;
    int iterations = 0;
    bool converged = false;
};

/// Temperatures whose balances are closed by what is added to them [W].
newton solve(const shaft& model, Eigen::VectorXd start, const Eigen::VectorXd& added) {
    newton n{std::move(start)};
    Eigen::SparseLU<Eigen::SparseMatrix<double>> solver;
    while (!n.converged && n.iterations < 200) {
        ++n.iterations;
        const Eigen::VectorXd rest = model.balances(n.x);
        solver.compute(jacobian(model, n.x, rest));
        if (solver.info() != Eigen::Success) break;
        const Eigen::VectorXd step = solver.solve(-rest - added);
        const double largest = step.lpNorm<Eigen::Infinity>();
        if (!std::isfinite(largest)) break;
        // The slow mode of a counter-current shaft overshoots, so no temperature moves far at once.
        n.x = (n.x + step.cwiseMax(-150).cwiseMin(150)).cwiseMax(200).cwiseMin(3400);
        n.converged = largest < 1e-6;
    }
    return n;
}

}  // namespace

shaft_profile solve_shaft_profile(const settings& scene, int cells) {
    shaft model(scene, cells);
    const newton found = solve(model, model.start(), Eigen::VectorXd::Zero(2 * cells));
    model.find_pressure(found.x);
    shaft_profile profile = model.report(found.x);
    profile.iterations = found.iterations;
    profile.converged = found.converged;
    return profile;
}

temperature_range steady_range(const settings& scene) { return shaft(scene, 100).range(); }

std::vector<double> shift_to_steady(const settings& scene, const std::vector<double>& particle_temperature,
                                    const std::vector<double>& storage) {
    const auto cells = static_cast<int>(particle_temperature.size());
    const shaft model(scene, cells);
    const Eigen::VectorXd x = model.beside(particle_temperature);
    // What the shaft stores and the model does not know of is added to the model.
    const Eigen::VectorXd here = model.balances(x);
    Eigen::VectorXd added = Eigen::VectorXd::Zero(2 * cells);
    for (int k = 0; k < cells; ++k) added[2 * k + 1] = storage[static_cast<std::size_t>(k)] * scene.shaft.height / cells - here[2 * k + 1];
    const newton steady = solve(model, x, added);
    std::vector<double> shift;
    for (int k = 0; k < cells && steady.converged; ++k) shift.push_back(steady.x[2 * k + 1] - x[2 * k + 1]);
    return shift;
}

}  // namespace hearth::furnace
