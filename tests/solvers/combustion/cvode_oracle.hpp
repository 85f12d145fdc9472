// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>

#include <hearth/combustion/jones_lindstedt.hpp>
#include <hearth/combustion/species.hpp>
#include <hearth/combustion/thermo.hpp>

namespace hearth::combustion::oracle {

/// Mass fractions, then the temperature [K].
inline constexpr std::size_t unknowns = species_count + 1;
using state = std::array<double, unknowns>;

inline state state_of(const per_species& amount, double temperature) {
    const per_species y = mass_fractions(amount);
    state s;
    std::copy(y.begin(), y.end(), s.begin());
    s[species_count] = temperature;
    return s;
}

/// A reactor at constant pressure in the usual form, dY/dt and dT/dt, with its analytic Jacobian.  It shares the rates
/// with the library and nothing else: eight unknowns instead of three extents, the temperature integrated instead of
/// found from the enthalpy.
struct reactor_equations {
    jones_lindstedt mechanism;
    double pressure = standard_pressure;
    double exchange_rate = 0;  ///< of a perfectly stirred reactor; 0: closed [1/s]
    state feed{};              ///< of the perfectly stirred reactor

    /// dy/dt, and where asked for d(dy/dt)/dy by columns.
    void operator()(const double* y, double* rate, double* jacobian) const {
        per_species n;
        for (std::size_t k = 0; k < species_count; ++k) n[k] = y[k] / molar_mass[k];
        const double t = y[species_count], total = sum(n);
        per_species x, inside;
        bool negative = false;
        for (std::size_t k = 0; k < species_count; ++k) {
            x[k] = n[k] / total;
            inside[k] = std::max(x[k], 0.0);
            negative = negative || x[k] < 0;
        }
        rate_terms r;
        const rate_constants constants = rate_constants_at(mechanism, t, pressure);
        if (jacobian || negative)
            evaluate<true>(mechanism, constants, inside, r);
        else
            evaluate<false>(mechanism, constants, inside, r);
        per_step net;
        for (std::size_t s = 0; s < step_count; ++s) {
            net[s] = total * (r.forward[s] - r.backward[s]);
            // CVODE steps below zero.  Rates that go on along their tangent serve it best: with rates that stay at
            // their value at zero it needs up to thirty times as many steps.
            if (negative)
                for (std::size_t k = 0; k < species_count; ++k)
                    net[s] += total * r.by_fraction[s][k] * (x[k] - inside[k]);
        }
        const nasa7 mixture = combine(n);
        const double heat_capacity = mixture.heat_capacity(t);
        per_step enthalpy;
        double heat = 0;  // [J/(kg s)]
        for (std::size_t s = 0; s < step_count; ++s) {
            enthalpy[s] = step_thermo[s].enthalpy(t);
            heat -= enthalpy[s] * net[s];
        }
        for (std::size_t k = 0; k < species_count; ++k) {
            rate[k] = exchange_rate * (feed[k] - y[k]);
            for (std::size_t s = 0; s < step_count; ++s) rate[k] += molar_mass[k] * stoichiometry[s][k] * net[s];
        }
        per_species feed_enthalpy{};  // h_k(T_feed) - h_k(T) [J/kg]
        double feed_heat = 0;
        if (exchange_rate > 0)
            for (std::size_t k = 0; k < species_count; ++k) {
                feed_enthalpy[k] =
                    (thermo_table[k].enthalpy(feed[species_count]) - thermo_table[k].enthalpy(t)) / molar_mass[k];
                feed_heat += exchange_rate * feed[k] * feed_enthalpy[k];
            }
        rate[species_count] = (heat + feed_heat) / heat_capacity;
        if (!jacobian) return;

        for (std::size_t j = 0; j < unknowns; ++j) {
            const bool by_temperature = j == species_count;
            per_step d;
            for (std::size_t s = 0; s < step_count; ++s) {
                if (by_temperature) {
                    d[s] = total * r.by_temperature[s];
                } else {
                    d[s] = r.forward[s] - r.backward[s] + r.by_fraction[s][j];
                    for (std::size_t k = 0; k < species_count; ++k) d[s] -= x[k] * r.by_fraction[s][k];
                    d[s] /= molar_mass[j];
                }
            }
            double* column = jacobian + unknowns * j;
            double d_heat = 0;
            for (std::size_t s = 0; s < step_count; ++s) d_heat -= enthalpy[s] * d[s];
            for (std::size_t k = 0; k < species_count; ++k) {
                column[k] = k == j ? -exchange_rate : 0.0;
                for (std::size_t s = 0; s < step_count; ++s) column[k] += molar_mass[k] * stoichiometry[s][k] * d[s];
            }
            double d_capacity = 0;
            if (by_temperature) {
                const double h = 1e-3 * t;  // the slope of cp is used only here: a difference of a smooth function
                d_capacity = (mixture.heat_capacity(t + h) - mixture.heat_capacity(t - h)) / (2 * h);
                for (std::size_t s = 0; s < step_count; ++s) d_heat -= step_thermo[s].heat_capacity(t) * net[s];
                if (exchange_rate > 0)
                    for (std::size_t k = 0; k < species_count; ++k)
                        d_heat -= exchange_rate * feed[k] * thermo_table[k].heat_capacity(t) / molar_mass[k];
            } else {
                d_capacity = thermo_table[j].heat_capacity(t) / molar_mass[j];
            }
            column[species_count] = (d_heat - rate[species_count] * d_capacity) / heat_capacity;
        }
    }
};

/// CVODE (Hindmarsh et al., doi:10.1145/1089014.1089020) with its dense solver, made once and used for many runs.
class cvode {
  public:
    explicit cvode(const reactor_equations& equations) : equations_(equations) {
        SUNContext_Create(nullptr, &context_);
        y_ = N_VNew_Serial(unknowns, context_);
        matrix_ = SUNDenseMatrix(unknowns, unknowns, context_);
        solver_ = SUNLinSol_Dense(y_, matrix_, context_);
        memory_ = CVodeCreate(CV_BDF, context_);
        N_VConst(1.0, y_);
        CVodeInit(memory_, right_hand_side, 0.0, y_);
        CVodeSStolerances(memory_, 1e-4, 1e-10);
        CVodeSetLinearSolver(memory_, solver_, matrix_);
        CVodeSetJacFn(memory_, jacobian);
        CVodeSetUserData(memory_, &equations_);
        CVodeSetMaxNumSteps(memory_, 10000000);
        CVodeSetErrFile(memory_, nullptr);
    }
    ~cvode() {
        CVodeFree(&memory_);
        SUNLinSolFree(solver_);
        SUNMatDestroy(matrix_);
        N_VDestroy(y_);
        SUNContext_Free(&context_);
    }
    cvode(const cvode&) = delete;
    cvode& operator=(const cvode&) = delete;

    reactor_equations& equations() { return equations_; }

    /// The state after a duration [s].  Throws std::runtime_error where CVODE gives up.
    state run(const state& start, double duration, double relative, double absolute) {
        std::copy(start.begin(), start.end(), N_VGetArrayPointer(y_));
        CVodeReInit(memory_, 0.0, y_);
        CVodeSStolerances(memory_, relative, absolute);
        CVodeSetStopTime(memory_, duration);
        double reached = 0;
        if (CVode(memory_, duration, y_, &reached, CV_NORMAL) < 0) throw std::runtime_error("CVODE failed");
        state out;
        std::copy_n(N_VGetArrayPointer(y_), unknowns, out.begin());
        return out;
    }

    long steps() const {
        long n = 0;
        CVodeGetNumSteps(memory_, &n);
        return n;
    }

  private:
    static int right_hand_side(realtype, N_Vector y, N_Vector rate, void* self) {
        (*static_cast<reactor_equations*>(self))(N_VGetArrayPointer(y), N_VGetArrayPointer(rate), nullptr);
        return 0;
    }
    static int jacobian(realtype, N_Vector y, N_Vector, SUNMatrix m, void* self, N_Vector rate, N_Vector, N_Vector) {
        (*static_cast<reactor_equations*>(self))(N_VGetArrayPointer(y), N_VGetArrayPointer(rate),
                                                 SUNDenseMatrix_Data(m));
        return 0;
    }

    reactor_equations equations_;
    SUNContext context_ = nullptr;
    N_Vector y_ = nullptr;
    SUNMatrix matrix_ = nullptr;
    SUNLinearSolver solver_ = nullptr;
    void* memory_ = nullptr;
};

/// Largest deviation: of the temperature, relative; of the mass fractions, relative, or of a thousandth for traces. [-]
inline double deviation(const state& a, const state& exact) {
    double largest = std::fabs(a[species_count] / exact[species_count] - 1);
    for (std::size_t k = 0; k < species_count; ++k)
        largest = std::max(largest, std::fabs(a[k] - exact[k]) / std::max(exact[k], 1e-3));
    return largest;
}

}  // namespace hearth::combustion::oracle
