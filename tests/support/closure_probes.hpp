// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <tuple>

#include <hearth/closure/air.hpp>
#include <hearth/closure/beetstra.hpp>
#include <hearth/closure/di_felice.hpp>
#include <hearth/closure/drag.hpp>
#include <hearth/closure/eisfeld_schnitzlein.hpp>
#include <hearth/closure/ergun.hpp>
#include <hearth/closure/ergun_wen_yu.hpp>
#include <hearth/closure/evaporation.hpp>
#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/gas_film.hpp>
#include <hearth/closure/gidaspow.hpp>
#include <hearth/closure/grey_exchange.hpp>
#include <hearth/closure/gunn.hpp>
#include <hearth/closure/hertz.hpp>
#include <hearth/closure/intraparticle.hpp>
#include <hearth/closure/ranz_marshall.hpp>
#include <hearth/closure/sphere_pair.hpp>
#include <hearth/closure/wakao_kaguei.hpp>
#include <hearth/closure/wall_view.hpp>
#include <hearth/closure/wen_yu.hpp>
#include <hearth/closure/zhang.hpp>

/// Every closure once, in one form: an array of numbers in, a number out.  So one loop serves a property that all
/// closures must have: precision, derivatives, units, limits, lanes, device code, speed.
namespace hearth_test {

/// Powers of length, mass, time and temperature.
struct dimension {
    int length = 0, mass = 0, time = 0, temperature = 0;
};

inline constexpr dimension one{};
inline constexpr dimension metre{1, 0, 0, 0};
inline constexpr dimension square_metre{2, 0, 0, 0};
inline constexpr dimension kelvin{0, 0, 0, 1};
inline constexpr dimension metre_per_second{1, 0, -1, 0};
inline constexpr dimension newton{1, 1, -2, 0};
inline constexpr dimension pascal{-1, 1, -2, 0};
inline constexpr dimension pascal_second{-1, 1, -1, 0};
inline constexpr dimension density_unit{-3, 1, 0, 0};
inline constexpr dimension conductivity_unit{1, 1, -3, -1};  // W/(m K)
inline constexpr dimension transfer_unit{0, 1, -3, -1};      // W/(m^2 K)
inline constexpr dimension watt_per_kelvin{2, 1, -3, -1};

/// One input: the range from which tests draw it, evenly in its logarithm, and its unit.
struct input {
    double lo, hi;
    dimension unit = one;
};

/// Universal constants and empirical coefficients with units hide in some closures: their units cannot be rescaled.
enum class scaling { any, none };

template <std::size_t Inputs>
struct description {
    const char* name;
    std::array<input, Inputs> inputs;
    dimension output = one;
    scaling units = scaling::any;
    bool has_power = true;  ///< needs power, root, exponential or logarithm: such lanes must be 3 times as fast
};

namespace probes {

namespace c = hearth::closure;

inline constexpr input void_fraction{0.36, 0.999};
inline constexpr input reynolds{0.1, 1e4};
inline constexpr input prandtl{0.5, 3};

template <class Closure>
struct nusselt {
    static constexpr description<3> about() { return {Closure::name(), {{void_fraction, reynolds, prandtl}}}; }
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        return Closure::nusselt(x[0], x[1], x[2]);
    }
};

/// The exchange coefficient, through which all other functions of drag.hpp go.
template <class Drag, bool HasPower>
struct drag {
    Drag closure;
    static constexpr description<5> about() {
        return {Drag::name(),
                {{{0.36, 0.99},
                  {0.01, 5, metre_per_second},
                  {0.2, 2, density_unit},
                  {1e-5, 8e-5, pascal_second},
                  {1e-3, 2e-2, metre}}},
                {-3, 1, -1, 0},
                scaling::any,
                HasPower};
    }
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        return exchange_coefficient(closure, c::bed_flow<Scalar>{x[0], x[1], x[2], x[3], x[4]});
    }
};

struct hertz_radius {
    static constexpr description<6> about() {
        return {"hertz",
                {{{1e-3, 1e3, newton},
                  {1e-3, 2e-2, metre},
                  {1e-3, 2e-2, metre},
                  {1e7, 4e11, pascal},
                  {0.1, 0.45},
                  {1e7, 4e11, pascal}}},
                metre};
    }
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        const Scalar modulus =
            c::hertz::effective_modulus(c::elastic<Scalar>{x[3], x[4]}, c::elastic<Scalar>{x[5], x[4]});
        return c::hertz::contact_radius(x[0], c::hertz::effective_radius(x[1], x[2]), modulus);
    }
};

/// Radius of the true modulus from an overlap of the softened one.
struct hertz_softened {
    static constexpr description<4> about() {
        return {"hertz (softened)",
                {{{1e-7, 1e-4, metre}, {1e-3, 2e-2, metre}, {1e6, 1e9, pascal}, {1e10, 4e11, pascal}}},
                metre};
    }
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        const Scalar force = c::hertz::normal_force(x[0], x[1], x[2]);
        const Scalar radius = c::hertz::contact_radius(force, x[1], x[2]);
        return c::hertz::true_contact_radius(radius, x[2], x[3]) +
               hearth::square_root(Scalar(c::hertz::true_overlap(x[0], x[2], x[3]) * x[1]));
    }
};

template <class Closure>
struct contact {
    Closure closure;
    static constexpr description<6> about(const char* name, scaling units, bool has_power) {
        return {name,
                {{{1e-5, 1e-3, metre},
                  {1e-2, 1e3, newton},
                  {0.5, 100, conductivity_unit},
                  {0.5, 100, conductivity_unit},
                  {1e-3, 2e-2, metre},
                  {1e-3, 2e-2, metre}}},
                watt_per_kelvin,
                units,
                has_power};
    }
    static constexpr description<6> about();
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        return closure.conductance(c::contact_pair<Scalar>{x[0], x[1], x[2], x[3], x[4], x[5]});
    }
};
template <>
constexpr description<6> contact<c::zhang::constriction>::about() {
    return about("zhang::constriction", scaling::any, false);
}
template <>
constexpr description<6> contact<c::zhang::series>::about() {
    return about("zhang::series", scaling::any, false);
}
template <>
constexpr description<6> contact<c::zhang::micro_gap>::about() {
    return about("zhang::micro_gap", scaling::none, true);  // roughness and hardness are set in SI
}

template <class Closure, bool Wall>
struct film {
    static constexpr description<7> about() {
        constexpr bool lens = std::is_same_v<Closure, c::rong_horio>;
        return {lens ? (Wall ? "rong_horio (wall)" : "rong_horio") : (Wall ? "gas_film (wall)" : "gas_film"),
                {{{1e-7, 1e-4, metre},
                  {2e-3, 2e-2, metre},
                  {2e-3, 2e-2, metre},
                  {0.5, 100, conductivity_unit},
                  {0.5, 100, conductivity_unit},
                  {0.02, 0.2, conductivity_unit},
                  {0.36, 0.9}}},
                watt_per_kelvin};
    }
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        const c::film_pair<Scalar> pair{x[0], x[1], x[2], x[3], x[4], x[5], x[6]};
        if constexpr (Wall)
            return Closure::wall_conductance(pair);
        else
            return Closure::conductance(pair);
    }
};

struct feng_han_pair {
    static constexpr description<2> about() { return {"feng_han::monte_carlo_fit", {{{1, 3.9}, {0.57, 0.64}}}}; }
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        return c::feng_han::monte_carlo_fit::view_factor(x[0], x[1]);
    }
};

struct unshaded_pair {
    static constexpr description<1> about() { return {"sphere_pair", {{{1, 20}}}, one, scaling::any, false}; }
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        return c::sphere_pair::view_factor(x[0]);
    }
};

struct wall_bed {
    c::wall_view::bed closure;
    static constexpr description<1> about() { return {"wall_view::bed", {{{0.5, 4}}}}; }
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        return closure.view_factor(x[0]);
    }
};

struct grey {
    c::grey_exchange closure;
    static constexpr description<3> about() {
        return {"grey_exchange",
                {{{1e-6, 1e-3, square_metre}, {250, 2500, kelvin}, {250, 2500, kelvin}}},
                {2, 1, -3, 0},
                scaling::none,  // Stefan-Boltzmann
                false};
    }
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        return closure.heat_rate(x[0], x[1], x[2]);
    }
};

struct grey_factor {
    static constexpr description<1> about() {
        return {"grey_exchange::bed_factor", {{{0.1, 1}}}, one, scaling::any, false};
    }
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        return c::grey_exchange::bed_factor(x[0]);
    }
};

struct biot_corrected {
    static constexpr description<3> about() {
        return {"intraparticle",
                {{{1, 1e3, transfer_unit}, {1e-3, 3e-2, metre}, {0.2, 100, conductivity_unit}}},
                transfer_unit,
                scaling::any,
                false};
    }
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        return c::intraparticle::transfer_coefficient(x[0], x[1], x[2]);
    }
};

struct water_pressure {
    static constexpr description<1> about() {
        return {"water::saturation_pressure", {{{273.16, 640, kelvin}}}, pascal, scaling::none};
    }
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        return c::water::saturation_pressure(x[0]);
    }
};

struct water_latent_heat {
    static constexpr description<1> about() {
        return {"water::latent_heat", {{{273.16, 640, kelvin}}}, {2, 0, -2, 0}, scaling::none};
    }
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        return c::water::latent_heat(x[0]);
    }
};

/// Evaporation with the diffusivity of the film.
struct drying {
    static constexpr description<6> about() {
        return {"evaporation",
                {{{1e-3, 2e-2, metre},
                  {2, 60},
                  {290, 440, kelvin},
                  {9e4, 1.2e5, pascal},
                  {3e3, 6e4, pascal},
                  {1e2, 2e3, pascal}}},
                {0, 1, -1, 0},
                scaling::none};  // gas constant
    }
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        const Scalar diffusivity = c::water::diffusivity_in_air(x[2], x[3]);
        return c::evaporation::mass_rate(c::wet_sphere<Scalar>{x[0], x[1], diffusivity, x[2], x[3], x[4], x[5]});
    }
};

struct air_prandtl {
    static constexpr description<1> about() { return {"air::prandtl", {{{200, 2400, kelvin}}}, one, scaling::none}; }
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        return c::air::prandtl(x[0]);
    }
};

struct air_density {
    static constexpr description<2> about() {
        return {"air::density", {{{200, 2400, kelvin}, {5e4, 2e5, pascal}}}, density_unit, scaling::none, false};
    }
    template <class Scalar>
    HEARTH_FUNCTION Scalar operator()(const Scalar* x) const {
        return c::air::density(x[0], x[1]);
    }
};

}  // namespace probes

/// Calls visit(probe) for every closure.
template <class Visit>
void for_each_closure(Visit&& visit) {
    namespace c = hearth::closure;
    visit(probes::nusselt<c::gunn>{});
    visit(probes::nusselt<c::wakao_kaguei>{});
    visit(probes::nusselt<c::ranz_marshall>{});
    visit(probes::drag<c::ergun, false>{});
    visit(probes::drag<c::ergun::paper, false>{});
    visit(probes::drag<c::wen_yu, true>{});
    visit(probes::drag<c::gidaspow, true>{});
    visit(probes::drag<c::ergun_wen_yu, true>{});
    visit(probes::drag<c::di_felice, true>{});
    visit(probes::drag<c::beetstra, true>{});
    visit(probes::drag<c::eisfeld_schnitzlein, false>{c::eisfeld_schnitzlein(7)});
    visit(probes::hertz_radius{});
    visit(probes::hertz_softened{});
    visit(probes::contact<c::zhang::constriction>{});
    visit(probes::contact<c::zhang::series>{c::zhang::series()});
    visit(probes::contact<c::zhang::micro_gap>{c::zhang::micro_gap({1e-6, 0.1, 2e9})});
    visit(probes::film<c::gas_film, false>{});
    visit(probes::film<c::gas_film, true>{});
    visit(probes::film<c::rong_horio, false>{});
    visit(probes::film<c::rong_horio, true>{});
    visit(probes::feng_han_pair{});
    visit(probes::unshaded_pair{});
    visit(probes::wall_bed{c::wall_view::bed(0.61)});
    visit(probes::grey{c::grey_exchange(0.86)});
    visit(probes::grey_factor{});
    visit(probes::biot_corrected{});
    visit(probes::water_pressure{});
    visit(probes::water_latent_heat{});
    visit(probes::drying{});
    visit(probes::air_prandtl{});
    visit(probes::air_density{});
}

}  // namespace hearth_test
