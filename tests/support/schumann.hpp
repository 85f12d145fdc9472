// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

/// Exact solution of a packed bed at T0 that meets gas of T_in at its entrance, without axial conduction.
/// Schumann, J. Franklin Inst. 208 (1929) 405, doi:10.1016/S0016-0032(29)91186-8.
///
/// With h [W/(m^2 K)], specific surface a [1/m], position x [m], superficial velocity U [m/s], void fraction e:
///     xi  = h a x / (rho_gas c_gas U)                                [-]
///     tau = h a (t - x e / U) / ((1 - e) rho_solid c_solid)          [-]
/// and (T - T0)/(T_in - T0) is gas(xi, tau) and solid(xi, tau).  Both are good to a few round-offs.
namespace hearth_test::schumann {

namespace detail {

/// exp(-z) I0(z), z >= 0: power series (all terms positive), and the asymptotic one where its smallest term is below
/// 1e-40.
inline long double scaled_bessel_i0(long double z) {
    if (z < 50) {
        const long double quarter = z * z / 4;
        long double term = std::exp(-z), sum = term;
        for (int k = 1; term > 1e-22L * sum; ++k) {
            term *= quarter / (static_cast<long double>(k) * static_cast<long double>(k));
            sum += term;
        }
        return sum;
    }
    long double term = 1, sum = 1;
    for (int k = 1; term > 1e-22L; ++k) {
        const auto odd = static_cast<long double>(2 * k - 1);
        term *= odd * odd / (8 * z * static_cast<long double>(k));
        sum += term;
    }
    return sum / std::sqrt(2 * 3.14159265358979323846L * z);
}

/// Integral over t in [from, to] of 2 t exp(-(t - sqrt(y))^2) exp(-z) I0(z), z = 2 t sqrt(y).
/// This is exp(-y) times the integral of exp(-s) I0(2 sqrt(y s)) over s = t^2: a bell of unit width, without overflow.
/// Eight-point Gauss-Legendre on panels of 1/4: the bell is entire, so each panel is exact to round-off.
inline long double bell(long double from, long double to, long double y) {
    constexpr std::array<long double, 4> node{
        0.183434642495649804939476142360184L, 0.525532409916328985817739049189246L,
        0.796666477413626739591553936475830L, 0.960289856497536231683560868569473L};
    constexpr std::array<long double, 4> weight{
        0.362683783378361982965150449277196L, 0.313706645877887287337962201986601L,
        0.222381034453374470544355994426241L, 0.101228536290376259152531354309962L};
    const long double centre = std::sqrt(y);
    from = std::max(from, centre - 7.5L);  // exp(-7.5^2) = 4e-25
    to = std::min(to, std::max(from, centre) + 7.5L);
    if (!(to > from)) return 0;
    const auto integrand = [centre](long double t) {
        const long double d = t - centre;
        return 2 * t * std::exp(-d * d) * scaled_bessel_i0(2 * t * centre);
    };
    const int panels = static_cast<int>(std::ceil((to - from) * 4));
    const long double half = (to - from) / (2 * static_cast<long double>(panels));
    long double sum = 0;
    for (int p = 0; p < panels; ++p) {
        const long double middle = from + half * static_cast<long double>(2 * p + 1);
        for (std::size_t k = 0; k < node.size(); ++k)
            sum += weight[k] * (integrand(middle - half * node[k]) + integrand(middle + half * node[k]));
    }
    return half * sum;
}

inline constexpr long double infinity = 1e9L;

}  // namespace detail

/// Gas temperature (T - T0)/(T_in - T0) for xi >= 0; the gas that has not come yet (tau < 0) finds the bed cold.
inline long double gas(long double xi, long double tau) {
    if (tau < 0) return 0;
    const long double x = std::sqrt(xi);
    return xi > tau ? detail::bell(x, detail::infinity, tau) : 1 - detail::bell(0, x, tau);
}

/// Temperature of the solid (T - T0)/(T_in - T0).
inline long double solid(long double xi, long double tau) {
    if (tau <= 0) return 0;
    const long double t = std::sqrt(tau);
    return tau > xi ? 1 - detail::bell(t, detail::infinity, xi) : detail::bell(0, t, xi);
}

}  // namespace hearth_test::schumann
