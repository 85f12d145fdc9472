// SPDX-License-Identifier: MIT
// Every closure far outside the range in which it was fitted: it stays finite, in every precision and on lanes.
#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <doctest/doctest.h>

#include <hearth/eigen.hpp>

#include "support/closure_probes.hpp"

namespace {

using namespace hearth::closure;

/// Calls visit for every drag closure.
template <class Visit>
void for_each_drag(Visit&& visit) {
    visit(ergun{}), visit(ergun::paper{}), visit(wen_yu{}), visit(gidaspow{}), visit(ergun_wen_yu{});
    visit(di_felice{}), visit(beetstra{}), visit(eisfeld_schnitzlein{5}), visit(eisfeld_schnitzlein{1e300});
}

template <class Number>
bool finite(const Number& x) {
    bool all = true;
    for (std::int64_t k = 0; k < hearth::lane_count(x); ++k) all = all && std::isfinite(hearth::lane(x, k));
    return all;
}

}  // namespace

TEST_CASE_TEMPLATE("limits: transfer and drag from rest to Reynolds number 1e8, from void fraction 0.1 to 1", Number,
                   float, double, long double, Eigen::Array<double, 8, 1>, Eigen::Array<float, 16, 1>) {
    using real = hearth::real_t<Number>;
    const auto number = [](double x) { return hearth::uniform(Number(), static_cast<real>(x)); };
    for (const double void_fraction : {0.1, 0.35, 0.8, 0.9999, 1.0})
        for (const double reynolds : {0.0, 1e-30, 1e-8, 1.0, 1000.0, 1e8}) {
            CAPTURE(void_fraction);
            CAPTURE(reynolds);
            const Number e = number(void_fraction), re = number(reynolds), pr = number(0.7);
            CHECK(finite(gunn::nusselt(e, re, pr)));
            CHECK(finite(wakao_kaguei::nusselt(e, re, pr)));
            CHECK(finite(ranz_marshall::nusselt(e, re, pr)));
            CHECK(hearth::lane(gunn::nusselt(e, re, pr), 0) >= real(1.99));
            for_each_drag([&](const auto& drag) {
                CAPTURE(std::string(drag.name()));
                const Number exchange = drag.dimensionless_exchange(e, re);
                CHECK(finite(exchange));
                CHECK(hearth::lane(exchange, 0) >= 0);
                // rho = mu = d = 1: the slip is the Reynolds number
                const bed_flow<Number> flow{e, re, number(1), number(1), number(1)};
                CHECK(finite(exchange_coefficient(drag, flow)));
                CHECK(finite(particle_coefficient(drag, flow)));
                CHECK(finite(pressure_gradient(drag, flow)));
            });
        }
}

TEST_CASE("limits: derivatives of transfer and drag at rest are infinite at most, never NaN") {
    using dual = Eigen::AutoDiffScalar<Eigen::Vector3d>;
    for (const double void_fraction : {0.1, 0.4, 0.9})
        for (const double reynolds : {0.0, 1e-12, 1e8}) {
            const dual e(void_fraction, 3, 0), re(reynolds, 3, 1), pr(0.7, 3, 2);
            const auto usable = [](const dual& y) {
                return std::isfinite(y.value()) && !y.derivatives().array().isNaN().any();
            };
            CHECK(usable(gunn::nusselt(e, re, pr)));
            CHECK(usable(wakao_kaguei::nusselt(e, re, pr)));
            CHECK(usable(ranz_marshall::nusselt(e, re, pr)));
            // a bed at rest, differentiated by the void fraction alone
            CHECK(gunn::nusselt(e, dual(reynolds), pr).derivatives().allFinite());
            for_each_drag([&](const auto& drag) {
                CAPTURE(std::string(drag.name()));
                CAPTURE(reynolds);
                CHECK(usable(drag.dimensionless_exchange(e, re)));
            });
        }
}

TEST_CASE_TEMPLATE("limits: contacts without force, films without gap, radiation from 1 K to 1e4 K", Number, float,
                   double, long double, Eigen::Array<double, 8, 1>) {
    using real = hearth::real_t<Number>;
    const auto number = [](double x) { return hearth::uniform(Number(), static_cast<real>(x)); };
    for (const double force : {-1.0, 0.0, 1e-12, 1e6}) {
        const Number radius = hertz::contact_radius(number(force), number(1e-3), number(1e11));
        CHECK(finite(radius));
        const contact_pair<Number> pair{radius, number(force), number(1), number(100), number(1e-3), number(0)};
        CHECK(finite(zhang::constriction::conductance(pair)));
        CHECK(finite(zhang::series{}.conductance(pair)));
        CHECK(finite(zhang::micro_gap({1e-6, 0.1, 1e9}).conductance(pair)));
    }
    for (const double gap : {-1e-4, -1e-12, 0.0, 1e-12, 1e-3, 1.0})
        for (const double void_fraction : {0.1, 0.4, 1.0})
            for (const double gas : {0.0, 1e-3, 1.0}) {
                CAPTURE(gap);
                const film_pair<Number> pair{number(gap),  number(1e-3), number(1e-2),         number(0.1),
                                             number(1000), number(gas),  number(void_fraction)};
                CHECK(finite(gas_film::conductance(pair)));
                CHECK(finite(gas_film::wall_conductance(pair)));
                CHECK(finite(rong_horio::conductance(pair)));
                CHECK(finite(rong_horio::wall_conductance(pair)));
            }
    for (const double s : {0.0, 1.0, 2.0, 10.0, 1e6}) {
        CHECK(finite(feng_han::monte_carlo_fit{}.view_factor(number(s))));
        CHECK(finite(sphere_pair::view_factor(number(s))));
        CHECK(finite(wall_view::bed{}.view_factor(number(s))));
        CHECK(finite(wall_view::closed{}.view_factor(number(s))));
    }
    for (const double t : {1.0, 300.0, 647.096, 1e4}) {
        CHECK(finite(grey_exchange{}.heat_rate(number(1e-4), number(t), number(300))));
        CHECK(finite(water::saturation_pressure(number(t))));
        CHECK(finite(water::latent_heat(number(t))));
        CHECK(finite(air::conductivity(number(t))));
        CHECK(finite(air::viscosity(number(t))));
    }
    for (const double e : {0.0, 0.2, 1.0}) CHECK(finite(grey_exchange::bed_factor(number(e))));
}
