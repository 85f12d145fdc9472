// SPDX-License-Identifier: MIT
// The combustion solver for examples/solvers/README.md, as tables: combustion FOLDER [TABLE ...].
//   flames     adiabatic flame temperatures over the equivalence ratio, beside the published ones
//   ignition   temperature over time of stoichiometric gas, beside CVODE at 1e-10
//   chemistry  error and time per cell and 1e-4 s over the tolerance, beside CVODE's
#include <cmath>
#include <string>

#include "combustion/ensembles.hpp"
#include "solvers/combustion/flames.hpp"
#include "support/tables.hpp"

namespace {

using namespace hearth::combustion;

void flames(std::ostream& out) {
    out << "ratio complete equilibrium published_complete published\n";
    for (int i = 0; i <= 20; ++i) {
        const double ratio = 0.5 + 0.05 * i;
        const per_species n = amounts_from_moles({ratio, 2, 2 * dry, 0, 0, 0, 0});
        const double h = combine(n).enthalpy(298.15);
        out << ratio << ' ' << burn(n, h).temperature << ' ' << equilibrium(n, h, 101325).temperature;
        double complete = none, burnt = none;  // 0 where none is published
        for (const flame& f : published)
            if (f.nitrogen == dry && f.temperature == 298.15 && f.pressure == 101325 &&
                std::abs(f.ratio - ratio) < 1e-9) {
                complete = f.complete;
                burnt = f.burnt;
            }
        out << ' ' << complete << ' ' << burnt << std::endl;
    }
}

void ignition(std::ostream& out) {
    out << "start time ours cvode\n";
    const per_species n = methane_air(1.0);
    oracle::cvode reference({});
    for (const double start : {1000.0, 1300.0, 1800.0})
        for (int i = 0; i <= 60; ++i) {
            const double time = 1e-6 * std::pow(10, i / 15.0);
            reactor gas({}, n, start, pressure);
            extents e{};
            if (!integrate(gas, e, time, tolerance{}).finished) throw std::runtime_error("ignition did not finish");
            const double ours = combine(gas.amount(e)).temperature(gas.enthalpy());
            const oracle::state exact = reference.run(oracle::state_of(n, start), time, 1e-10, 1e-15);
            out << start << ' ' << time << ' ' << ours << ' ' << exact[species_count] << std::endl;
        }
}

void chemistry(std::ostream& out) {
    out << "kind method relative error seconds\n";
    oracle::cvode cvode({});
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const ensemble& cells = ensembles()[i];
        const auto row = [&](const char* method, double relative, const auto& run) {
            std::string kind = kinds[i];
            std::replace(kind.begin(), kind.end(), ' ', '_');
            out << kind << ' ' << method << ' ' << relative << ' ' << cells.error(run) << ' ' << cells.seconds(run)
                << std::endl;
        };
        for (const double relative : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6})
            row("ours", relative, [=](const oracle::state& s) { return by_hearth(s, {relative, 1e-2 * relative}); });
        for (const double relative : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7})
            row("CVODE", relative,
                [&](const oracle::state& s) { return cvode.run(s, duration, relative, 1e-6 * relative); });
    }
}

}  // namespace

int main(int count, char** words) {
    return bench::write_tables(count, words, {{"flames", flames}, {"ignition", ignition}, {"chemistry", chemistry}});
}
