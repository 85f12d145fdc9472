// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <hearth/combustion/equilibrium.hpp>
#include <hearth/combustion/jones_lindstedt.hpp>
#include <hearth/combustion/thermo.hpp>

#include "require.hpp"

namespace hearth::combustion {
namespace {

struct value_and_slope {
    double value, slope;
};

/// Root of a rising function in [lo, hi] by Newton, or bisection where Newton leaves the bracket or is slow; the nearer
/// end where there is no change of sign.  Each pass halves the bracket or takes 0.6 of the last step at most: 300
/// passes are more than the digits of a double allow.
template <class Function>
double rising_root(const Function& f, double lo, double hi, double guess, double tolerance) {
    double x = std::clamp(guess, lo, hi);
    double step = hi - lo;
    for (int i = 0; i < 300; ++i) {
        const value_and_slope y = f(x);
        if (y.value == 0) return x;
        (y.value < 0 ? lo : hi) = x;
        const double newton = x - y.value / y.slope;
        const double bisected = 0.5 * (lo + hi);
        const bool take = newton > lo && newton < hi && std::fabs(newton - x) < 0.6 * step;
        const double next = take ? newton : bisected;
        step = std::fabs(next - x);
        if (step <= tolerance * std::fabs(x) || next == x) return next;
        x = next;
    }
    return x;
}

/// Equilibrium at a temperature.  The ratios alpha = [CO2]/[CO] and beta = [H2O]/[H2] are proportional to
/// z = sqrt(p_O2/p0).  For a given z and methane m, carbon leaves c = C - m of CO and CO2, and hydrogen leaves
/// q = H/2 - 2 m of H2 and H2O.
class isothermal {
  public:
    isothermal(const per_element& elements, double pressure)
        : carbon_(elements[carbon]),
          hydrogen_(elements[hydrogen]),
          oxygen_(elements[oxygen]),
          nitrogen_(0.5 * elements[nitrogen]),
          pressure_(pressure / standard_pressure) {}

    /// Nothing can react without oxygen, or with nothing but oxygen.
    bool inert() const { return !(oxygen_ > 0) || !(carbon_ + hydrogen_ > 0); }

    per_species at(double temperature) {
        const auto ln_k = [&](reaction_step s) {
            return -step_thermo[s].gibbs(temperature) / (gas_constant * temperature);
        };
        beta_over_z_ = ln_k(hydrogen_oxidation);
        alpha_over_z_ = ln_k(hydrogen_oxidation) + ln_k(water_gas_shift);
        methane_ = -ln_k(reforming);
        const double most = 0.5 * std::log(pressure_);
        // There CO2 and H2O are below round-off, and so is whatever methane could still give up.
        const double least = std::min(most, -std::max(alpha_over_z_, beta_over_z_)) - 180 - std::max(0.0, -methane_);
        ln_z_ = rising_root([&](double ln_z) { return oxygen_balance(ln_z); }, least, most,
                            started_ ? ln_z_ : first_guess(), 1e-15);
        started_ = true;
        return composition();
    }

  private:
    /// Where oxygen is left: its partial pressure after complete combustion.  Else: as if H2O/H2 held what the carbon
    /// of CO leaves of the oxygen.
    double first_guess() const {
        const double left = 0.5 * (oxygen_ - 2 * carbon_ - 0.5 * hydrogen_);
        if (left > 0) return 0.5 * std::log(pressure_ * left / (carbon_ + 0.5 * hydrogen_ + nitrogen_ + left));
        const double share = std::clamp((oxygen_ - carbon_) / (carbon_ + 0.5 * hydrogen_), 1e-6, 1 - 1e-6);
        return std::log(share / (1 - share)) - beta_over_z_;
    }

    /// Oxygen in the mixture beyond the given one, over ln z.
    value_and_slope oxygen_balance(double ln_z) {
        z2_ = std::exp(2 * ln_z);
        alpha_ = std::exp(alpha_over_z_ + ln_z);
        beta_ = std::exp(beta_over_z_ + ln_z);
        // p_O2 = z^2: moles of all gases are those of the others over 1 - z^2/p.
        share_ = -std::expm1(2 * ln_z - std::log(pressure_));
        if (!(share_ > 0)) return {1e300, 1e300};
        // m = factor c q^2 / n^2, from the reforming equilibrium
        const double factor = std::exp(methane_ + 2 * std::log(pressure_) - beta_over_z_ - ln_z) / (1 + alpha_) /
                              ((1 + beta_) * (1 + beta_));
        const double most = std::min(carbon_, 0.25 * hydrogen_);
        const auto moles = [&](double m) { return (carbon_ + 0.5 * hydrogen_ + nitrogen_ - 2 * m) / share_; };
        m_ = 0;
        if (most > 0)
            m_ = rising_root(
                [&](double m) -> value_and_slope {
                    const double c = carbon_ - m, q = 0.5 * hydrogen_ - 2 * m, n = moles(m);
                    const double b = factor / (n * n);
                    return {m - b * c * q * q, 1 + b * (q * q + 4 * c * q - 4 * c * q * q / (n * share_))};
                },
                0.0, most, 0.0, 1e-15);
        c_ = carbon_ - m_;
        q_ = 0.5 * hydrogen_ - 2 * m_;
        const double n = moles(m_), o2 = n * z2_ / pressure_;
        const double a = alpha_ / (1 + alpha_), b = beta_ / (1 + beta_);
        // How methane follows z, from the logarithm of its equilibrium.
        double m_slope = 0;
        if (m_ > 0 && c_ > 0 && q_ > 0) {
            const double by_z = a + 2 * b + 1 + 4 * z2_ / (pressure_ * share_);
            m_slope = -by_z / (1 / m_ + 1 / c_ + 4 / q_ - 4 / (n * share_));
        }
        const double slope = c_ * a * (1 - a) + q_ * b * (1 - b) + 4 * o2 / share_ -
                             m_slope * (1 + a + 2 * b + 4 * z2_ / (pressure_ * share_));
        return {c_ * (1 + a) + q_ * b + 2 * o2 - oxygen_, slope};
    }

    /// Minor partners from the equilibrium, major ones from the elements; what is left of the oxygen's balance goes
    /// where it changes least.
    per_species composition() const {
        const auto part = [](double whole, double ratio, double& first, double& second) {  // second = ratio * first
            if (ratio > 1) {
                first = whole / (1 + ratio);
                second = whole - first;
            } else {
                second = whole * ratio / (1 + ratio);
                first = whole - second;
            }
        };
        per_species n{};
        n[N2] = nitrogen_;
        n[CH4] = m_;
        part(std::max(c_, 0.0), alpha_, n[CO], n[CO2]);
        part(std::max(q_, 0.0), beta_, n[H2], n[H2O]);
        n[O2] = share_ > 0 ? (carbon_ + 0.5 * hydrogen_ + nitrogen_ - 2 * m_) / share_ * z2_ / pressure_ : 0.0;
        const double missing = oxygen_ - (n[CO] + 2 * n[CO2] + n[H2O] + 2 * n[O2]);
        const double in_oxygen = n[O2], in_hydrogen = std::min(n[H2], n[H2O]), in_carbon = std::min(n[CO], n[CO2]);
        const double in_methane = std::min({n[CH4], n[CO], 0.5 * n[H2]});
        const double most = std::max({in_oxygen, in_hydrogen, in_carbon, in_methane});
        if (most == in_oxygen) {
            n[O2] = std::max(0.0, n[O2] + 0.5 * missing);
        } else if (most == in_hydrogen) {
            const double d = std::clamp(missing, -n[H2O], n[H2]);
            n[H2O] += d;
            n[H2] -= d;
        } else if (most == in_carbon) {
            const double d = std::clamp(missing, -n[CO2], n[CO]);
            n[CO2] += d;
            n[CO] -= d;
        } else {
            const double d = std::clamp(missing, -std::min(n[CO], 0.5 * n[H2]), n[CH4]);
            n[CH4] -= d;
            n[CO] += d;
            n[H2] += 2 * d;
        }
        return n;
    }

    double carbon_, hydrogen_, oxygen_, nitrogen_, pressure_;
    double alpha_over_z_ = 0, beta_over_z_ = 0, methane_ = 0;  // logarithms of equilibrium constants
    double ln_z_ = 0, z2_ = 0, alpha_ = 0, beta_ = 0, share_ = 0, m_ = 0, c_ = 0, q_ = 0;
    bool started_ = false;
};

/// Where the equilibrium constants stay within the range of a double, and beyond any flame [K].
constexpr double coldest = 150, hottest = 15000;

mixture_state with_enthalpy(const per_species& n, double enthalpy, double temperature_guess) {
    const double t = combine(n).temperature(enthalpy, temperature_guess);
    require(t > 0 && std::isfinite(t), "enthalpy", enthalpy, "that of a positive temperature [J/kg]");
    return {n, t};
}

}  // namespace

mixture_state burn(const per_species& amount, double enthalpy) {
    require_mixture(amount);
    per_species n = amount;
    const double demand = 2 * n[CH4] + 0.5 * (n[CO] + n[H2]);
    const double share = demand > n[O2] ? n[O2] / demand : 1.0;
    const double ch4 = share * n[CH4], co = share * n[CO], h2 = share * n[H2];
    n[CH4] -= ch4;
    n[CO] -= co;
    n[H2] -= h2;
    n[O2] = share < 1 ? 0.0 : n[O2] - demand;
    n[CO2] += ch4 + co;
    n[H2O] += 2 * ch4 + h2;
    return with_enthalpy(n, enthalpy, 1500);
}

per_species equilibrium_at(const per_species& amount, double temperature, double pressure) {
    require_mixture(amount);
    require_pressure(pressure);
    require(coldest <= temperature && temperature <= hottest, "temperature", temperature, "150 to 15000 [K]");
    isothermal gas(element_amounts(amount), pressure);
    return gas.inert() ? amount : gas.at(temperature);
}

mixture_state equilibrium(const per_species& amount, double enthalpy, double pressure, double temperature_guess) {
    require_mixture(amount);
    require_pressure(pressure);
    require(std::isfinite(enthalpy), "enthalpy", enthalpy, "finite [J/kg]");
    isothermal gas(element_amounts(amount), pressure);
    if (gas.inert()) return with_enthalpy(amount, enthalpy, temperature_guess);
    double previous_t = 0, previous_residual = 0;
    const auto excess = [&](double t) -> value_and_slope {
        const nasa7 mixture = combine(gas.at(t));
        const double residual = mixture.enthalpy(t) - enthalpy;
        const double secant = (residual - previous_residual) / (t - previous_t);
        const double slope = previous_t > 0 && secant > 0 ? secant : 1.5 * mixture.heat_capacity(t);
        previous_t = t;
        previous_residual = residual;
        return {residual, slope};
    };
    const double t = rising_root(excess, coldest, hottest, temperature_guess, 1e-13);
    return with_enthalpy(gas.at(t), enthalpy, t);
}

}  // namespace hearth::combustion
