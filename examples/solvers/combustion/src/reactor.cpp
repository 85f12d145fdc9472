// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <hearth/combustion/reactor.hpp>

#include "require.hpp"

namespace hearth::combustion {
namespace {

using matrix = std::array<extents, extent_count>;

/// LU decomposition with partial pivoting.
struct decomposition {
    matrix a;
    std::array<std::size_t, extent_count> row{0, 1, 2};

    explicit decomposition(const matrix& m) : a(m) {
        for (std::size_t c = 0; c + 1 < extent_count; ++c) {
            std::size_t pivot = c;
            for (std::size_t r = c + 1; r < extent_count; ++r)
                if (std::fabs(a[r][c]) > std::fabs(a[pivot][c])) pivot = r;
            std::swap(a[c], a[pivot]);
            std::swap(row[c], row[pivot]);
            for (std::size_t r = c + 1; r < extent_count; ++r) {
                a[r][c] /= a[c][c];
                for (std::size_t k = c + 1; k < extent_count; ++k) a[r][k] -= a[r][c] * a[c][k];
            }
        }
        for (std::size_t i = 0; i < extent_count; ++i) a[i][i] = 1 / a[i][i];
    }

    extents solve(const extents& b) const {
        extents x{b[row[0]], b[row[1]], b[row[2]]};
        x[1] -= a[1][0] * x[0];
        x[2] -= a[2][0] * x[0] + a[2][1] * x[1];
        x[2] *= a[2][2];
        x[1] = (x[1] - a[1][2] * x[2]) * a[1][1];
        x[0] = (x[0] - a[0][1] * x[1] - a[0][2] * x[2]) * a[0][0];
        return x;
    }
};

/// Rodas4 in the form that needs no product with the Jacobian:
///     (1/(h gamma) - J) k_i = f(y + sum a_ij k_j) + sum c_ij k_j/h.
/// The new state is y + sum a_6j k_j + k_6, and k_6 estimates its error.
struct rodas4 {
    static constexpr std::size_t stages = 6;
    static constexpr double gamma = 0.25;
    static constexpr double a[stages][stages] = {
        {},
        {1.544},
        {0.9466785280815826, 0.2557011698983284},
        {3.314825187068521, 2.896124015972201, 0.9986419139977817},
        {1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950},
        {1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950, 1}};
    static constexpr double c[stages][stages] = {
        {},
        {-5.6688},
        {-2.430093356833875, -0.2063599157091915},
        {-0.1073529058151375, -9.594562251023355, -20.47028614809616},
        {7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160},
        {8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136, -6.058818238834054}};
};

matrix shifted(double diagonal, const matrix& jacobian) {
    matrix m;
    for (std::size_t i = 0; i < extent_count; ++i)
        for (std::size_t j = 0; j < extent_count; ++j) m[i][j] = (i == j ? diagonal : 0.0) - jacobian[i][j];
    return m;
}

/// The absolute tolerance of each species [mol/kg]: at most a hundredth of what its elements could make of it, since a
/// trace of hydrogen drives the oxidation of CO; but no less than a hundredth of the regularisation, below which the
/// rates are linear.
per_species absolute_tolerance(const per_species& n, double total, const tolerance& tol,
                               const jones_lindstedt& mechanism) {
    const per_element elements = element_amounts(n);
    per_species allowed;
    for (std::size_t k = 0; k < species_count; ++k) {
        double most = total;
        for (std::size_t i = 0; i < element_count; ++i)
            if (atoms[k][i] > 0) most = std::min(most, elements[i] / atoms[k][i]);
        allowed[k] = std::min(tol.absolute * total, 0.01 * std::max(most, mechanism.regularisation * total));
    }
    return allowed;
}

/// Largest change of an amount by a change of the extents, in units of the tolerance.  NaN comes through.
double weighted(const extents& change, const per_species& n, const per_species& m, const per_species& absolute,
                double relative) {
    double largest = 0;
    for (std::size_t k = 0; k < species_count; ++k) {
        double d = 0;
        for (std::size_t i = 0; i < extent_count; ++i) d += extent_stoichiometry[i][k] * change[i];
        const double w = std::fabs(d) / (relative * std::max(std::fabs(n[k]), std::fabs(m[k])) + absolute[k]);
        if (!(w <= largest)) largest = w;
    }
    return largest;
}

/// Exchanges that can restore a negative amount: the four steps and the simple sums of them.
constexpr std::array<extents, 8> exchanges{
    {{1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}, {1, 4, 1}, {1, 0, -1}, {1, 0, 1}}};

/// Takes amounts below -allowed to zero by the exchange that has the most room.  False where none has.
bool make_positive(extents& e, per_species& n, double allowed) {
    for (std::size_t pass = 0; pass < species_count; ++pass) {
        const std::size_t worst = static_cast<std::size_t>(std::min_element(n.begin(), n.end()) - n.begin());
        if (n[worst] >= -allowed) return true;
        const double needed = -n[worst];
        double most_room = 0;
        extents chosen{};
        for (const extents& exchange : exchanges) {
            per_species made{};
            for (std::size_t i = 0; i < extent_count; ++i)
                for (std::size_t k = 0; k < species_count; ++k) made[k] += extent_stoichiometry[i][k] * exchange[i];
            if (made[worst] == 0) continue;
            double room = needed * 1e6;
            for (std::size_t k = 0; k < species_count; ++k)
                if (const double lost = -made[k] / made[worst]; lost > 0) room = std::min(room, n[k] / lost);
            if (room <= most_room) continue;
            most_room = room;
            for (std::size_t i = 0; i < extent_count; ++i) chosen[i] = exchange[i] * needed / made[worst];
        }
        if (most_room < needed) return false;
        for (std::size_t i = 0; i < extent_count; ++i) {
            e[i] += chosen[i];
            for (std::size_t k = 0; k < species_count; ++k) n[k] += extent_stoichiometry[i][k] * chosen[i];
        }
        n[worst] = 0;
    }
    return false;
}

/// What a step of length h makes of a state.
struct trial {
    extents next{}, error{};
    bool usable = true;  ///< false where a stage strays so far below zero that its rates would mean nothing
};

trial attempt(reactor& gas, const extents& e, const extents& rate, const matrix& jacobian, double h, double total) {
    const decomposition lu(shifted(1 / (rodas4::gamma * h), jacobian));
    std::array<extents, rodas4::stages> k;
    trial t;
    for (std::size_t i = 0; i < rodas4::stages; ++i) {
        extents b = rate;
        if (i > 0) {
            t.next = e;
            for (std::size_t j = 0; j < i; ++j)
                for (std::size_t d = 0; d < extent_count; ++d) t.next[d] += rodas4::a[i][j] * k[j][d];
            const per_species n = gas.amount(t.next);
            t.usable = *std::min_element(n.begin(), n.end()) > -0.02 * total;
            if (!t.usable) return t;
            gas.evaluate<false>(t.next, b);
        }
        for (std::size_t j = 0; j < i; ++j)
            for (std::size_t d = 0; d < extent_count; ++d) b[d] += rodas4::c[i][j] / h * k[j][d];
        k[i] = lu.solve(b);
    }
    t.error = k.back();
    for (std::size_t d = 0; d < extent_count; ++d) t.next[d] += t.error[d];
    return t;
}

}  // namespace

reactor::reactor(const jones_lindstedt& mechanism, const per_species& amount, double temperature, double pressure,
                 double exchange_rate)
    : mechanism_(mechanism),
      amount_(amount),
      mixture_(combine(amount)),
      enthalpy_(mixture_.enthalpy(temperature)),
      pressure_(pressure),
      exchange_rate_(exchange_rate),
      total_(sum(amount)),
      temperature_(temperature),
      base_temperature_(temperature) {
    require_mechanism(mechanism);
    require_mixture(amount);
    require(temperature > 0 && std::isfinite(temperature), "temperature", temperature, "finite and > 0 [K]");
    require_pressure(pressure);
    require(exchange_rate >= 0 && std::isfinite(exchange_rate), "exchange_rate", exchange_rate,
            "finite and >= 0 [1/s]");
}

integration integrate(reactor& gas, extents& e, double duration, const tolerance& tol, long max_steps) {
    require_duration("duration", duration);
    require_tolerance(tol);
    integration report;
    if (duration == 0) return report;
    extents rate;
    matrix jacobian;
    gas.evaluate<true>(e, rate, &jacobian);
    per_species n = gas.amount(e);
    const double total = sum(n), round_off = 4e-16 * total;
    const per_species absolute = absolute_tolerance(n, total, tol, gas.mechanism());

    const double speed = weighted(rate, n, n, absolute, tol.relative);
    if (speed * duration <= 0.01) {
        // Next to nothing happens: one linearly implicit step of Euler is within a hundredth of the tolerance.
        const extents change = decomposition(shifted(1 / duration, jacobian)).solve(rate);
        extents next = e;
        for (std::size_t d = 0; d < extent_count; ++d) next[d] += change[d];
        const per_species m = gas.amount(next);
        if (*std::min_element(m.begin(), m.end()) >= -round_off) {
            e = next;
            report.steps = 1;
            report.error = speed * duration;
            return report;
        }
    }

    double h = std::min(duration, 10 / speed);  // ten tolerances: small for the method, and it may grow sixfold
    double time = 0, previous_h = 0, previous_error = 0;
    bool after_rejection = false;
    while (time < duration) {
        if (report.steps + report.rejected >= max_steps || !(time + h > time)) {
            report.finished = false;
            return report;
        }
        const double left = duration - time;
        if (h > 0.5 * left) h = h > 0.999 * left ? left : 0.5 * left;  // no crumb at the end

        trial step = attempt(gas, e, rate, jacobian, h, total);
        per_species m = gas.amount(step.next);
        double error = step.usable ? weighted(step.error, n, m, absolute, tol.relative) : 1e4;
        if (!(error < 1e4)) error = 1e4;
        double factor = std::clamp(0.9 * std::pow(std::max(error, 1e-8), -0.25), 0.1, 6.0);

        bool accepted = error <= 1;
        if (accepted && *std::min_element(m.begin(), m.end()) < -round_off) {
            for (std::size_t k = 0; k < species_count; ++k) accepted = accepted && m[k] >= -absolute[k];
            accepted = accepted && make_positive(step.next, m, round_off);
            if (accepted)
                ++report.limited;
            else
                factor = 0.5;
        }
        if (!accepted) {
            ++report.rejected;
            h *= factor;
            after_rejection = true;
            continue;
        }
        ++report.steps;
        report.error += error;
        e = step.next;
        n = m;
        time = h == left ? duration : time + h;
        if (time < duration) gas.evaluate<true>(e, rate, &jacobian);

        // Gustafsson's predictive controller (Hairer & Wanner, sec. IV.8): steps that have to shrink do so unasked.
        if (previous_h > 0) {
            const double trend = 0.9 * h / previous_h * std::pow(previous_error / (error * error), 0.25);
            factor = std::min(factor, std::max(0.1, trend));
        }
        if (after_rejection) factor = std::min(factor, 1.0);
        after_rejection = false;
        previous_h = h;
        previous_error = std::max(error, 1e-2);
        h *= factor;
    }
    return report;
}

}  // namespace hearth::combustion
