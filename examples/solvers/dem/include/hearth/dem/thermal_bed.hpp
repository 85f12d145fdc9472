// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <hearth/core/contact_traits.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/particle_traits.hpp>
#include <hearth/core/thermal_link.hpp>
#include <hearth/transfer/links.hpp>

#include <hearth/dem/bed.hpp>

namespace hearth::dem {

/// What the particles conduct, hold and emit.  A caloric (hearth/time/caloric.hpp) that depends on temperature belongs to
/// the integrator; specific_heat here is what step limits and explicit rates see.
struct thermal_material {
    double specific_heat = 800;  ///< [J/(kg K)]
    double conductivity = 4;     ///< [W/(m K)]
    double emissivity = 1;       ///< [-]
};

/// A bed as the coupling library sees it: particles with temperatures and rates, contacts, neighbours and walls.
///
/// Parcels: a sphere of the bed may stand for k^3 grains of a k-th of its radius.  `grains()` is the cloud of what the gas
/// sees: one grain per parcel, whose exchange counts k^3 times.  Between spheres contacts conduct unscaled and radiation of
/// a pair is divided by k, see scale_parcels(): conductivity and heating of the bed do not depend on k.
class thermal_bed {
  public:
    thermal_bed(bed& spheres, const thermal_material& material, int parcel_factor = 1)
        : bed_(&spheres), material_(material), parcel_factor_(parcel_factor) {
        const auto check = [](bool good, const char* name, double value, const char* allowed) {
            if (!good) throw bad_value(name, bad_value::no_index, value, allowed);
        };
        check(material.specific_heat > 0 && std::isfinite(material.specific_heat), "specific_heat",
              material.specific_heat, "finite and > 0 [J/(kg K)]");
        check(material.conductivity > 0 && std::isfinite(material.conductivity), "conductivity", material.conductivity,
              "finite and > 0 [W/(m K)]");
        check(material.emissivity > 0 && material.emissivity <= 1, "emissivity", material.emissivity, "in (0, 1] [-]");
        check(parcel_factor >= 1, "parcel_factor", parcel_factor, ">= 1");
        clear_rates();
    }

    bed& spheres() { return *bed_; }
    const bed& spheres() const { return *bed_; }
    const thermal_material& material() const { return material_; }
    int parcel_factor() const { return parcel_factor_; }

    /// Rates of all particles to 0, one for each that there is now.  Call it after each advance of the bed.
    void clear_rates() {
        heat_rates.assign(static_cast<std::size_t>(bed_->size()), 0.0);
        forces.assign(static_cast<std::size_t>(bed_->size()), vector3{});
    }

    /// Gamma of each particle: 1 in flight.
    std::vector<double> acceleration_factors(double in_the_bed) const {
        std::vector<double> factors(static_cast<std::size_t>(bed_->size()));
        for (index i = 0; i < bed_->size(); ++i)
            factors[static_cast<std::size_t>(i)] = bed_->in_flight(i) ? 1.0 : in_the_bed;
        return factors;
    }

    /// The forces that terms have added become the outer forces of the motion.
    void push() {
        for (index i = 0; i < bed_->size(); ++i) bed_->set_outer_force(i, forces[static_cast<std::size_t>(i)]);
    }

    std::vector<double> heat_rates;  ///< [W]
    std::vector<vector3> forces;     ///< [N]

  private:
    bed* bed_;
    thermal_material material_;
    int parcel_factor_;
};

/// One grain of each parcel, for terms between particles and gas.
struct grain_cloud {
    thermal_bed* bed;

    /// Times one grain's exchange that the gas gets.
    double count() const {
        const double k = bed->parcel_factor();
        return k * k * k;
    }
};

inline grain_cloud grains(thermal_bed& b) { return {&b}; }

/// To be called once on the links of a scene, so that the bed conducts as one of grains.  A bed of spheres k times as large
/// conducts alike by contacts and gas films, and k times as much by radiation.  Links to walls stay as they are: a parcel's
/// contact is a k-th as good per area of wall, which makes up for the layers of grains that its radius jumps over.
template <class Link>
void scale_parcels(link_list<Link>& links, int parcel_factor) {
    if constexpr (!std::is_same_v<Link, conductive_link<double>>)
        for (auto& pair : links.pairs) pair.link.radiation /= parcel_factor;
}

}  // namespace hearth::dem

template <>
struct hearth::particle_traits<hearth::dem::thermal_bed> {
    using index = std::int32_t;
    using scalar = double;
    using cloud = dem::thermal_bed;

    static index particle_count(const cloud& c) { return c.spheres().size(); }
    static std::int64_t global_index(const cloud& c, index i) { return c.spheres().ids()[i]; }
    static dem::vector3 get(quantity::position, const cloud& c, index i) { return c.spheres().spheres()[i].centre; }
    static std::array<double, 3> get(quantity::velocity, const cloud& c, index i) {
        const dem::vector3& v = c.spheres().motions()[i].velocity;
        return {v.x, v.y, v.z};
    }
    static double get(quantity::radius, const cloud& c, index i) { return c.spheres().spheres()[i].radius; }
    static double get(quantity::mass, const cloud& c, index i) { return c.spheres().mass(i); }
    static double get(quantity::temperature, const cloud& c, index i) { return c.spheres().temperatures()[i]; }
    static double get(quantity::specific_heat, const cloud& c, index) { return c.material().specific_heat; }
    static double get(quantity::conductivity, const cloud& c, index) { return c.material().conductivity; }
    static double get(quantity::emissivity, const cloud& c, index) { return c.material().emissivity; }
    static void set(quantity::temperature, cloud& c, index i, double kelvin) { c.spheres().temperatures()[i] = kelvin; }
    static void add(quantity::heat_rate, cloud& c, index i, double watts) {
        c.heat_rates[static_cast<std::size_t>(i)] += watts;
    }
    template <class Vector>
    static void add(quantity::force, cloud& c, index i, const Vector& newtons) {
        c.forces[static_cast<std::size_t>(i)] += dem::vector3{newtons[0], newtons[1], newtons[2]};
    }
};

template <>
struct hearth::particle_traits<hearth::dem::grain_cloud> {
    using index = std::int32_t;
    using scalar = double;
    using cloud = dem::grain_cloud;
    using of_bed = particle_traits<dem::thermal_bed>;

    static index particle_count(const cloud& c) { return of_bed::particle_count(*c.bed); }
    static std::int64_t global_index(const cloud& c, index i) { return of_bed::global_index(*c.bed, i); }
    static double get(quantity::radius, const cloud& c, index i) {
        return of_bed::get(quantity::radius{}, *c.bed, i) / c.bed->parcel_factor();
    }
    static double get(quantity::mass, const cloud& c, index i) {
        return of_bed::get(quantity::mass{}, *c.bed, i) / c.count();
    }
    template <class Tag>
    static auto get(Tag tag, const cloud& c, index i) -> decltype(of_bed::get(tag, *c.bed, i)) {
        return of_bed::get(tag, *c.bed, i);
    }
    static void add(quantity::heat_rate tag, cloud& c, index i, double watts) {
        of_bed::add(tag, *c.bed, i, c.count() * watts);
    }
    template <class Vector>
    static void add(quantity::force tag, cloud& c, index i, const Vector& newtons) {
        const double n = c.count();
        of_bed::add(tag, *c.bed, i, std::array<double, 3>{n * newtons[0], n * newtons[1], n * newtons[2]});
    }
};

template <>
struct hearth::contact_traits<hearth::dem::thermal_bed> {
    using contacts = dem::thermal_bed;

    template <class Visit>
    static void for_each_contact(const contacts& c, Visit&& visit) {
        c.spheres().for_each_contact([&](std::int32_t i, std::int32_t j, double force, double overlap, const dem::vector3& x) {
            visit(i, j, contact{force, overlap, {x.x, x.y, x.z}});
        });
    }
    template <class Visit>
    static void for_each_wall_contact(const contacts& c, Visit&& visit) {
        c.spheres().for_each_wall_contact([&](std::int32_t i, int w, double force, double overlap, const dem::vector3& x) {
            visit(i, c.spheres().wall_at(w).patch, contact{force, overlap, {x.x, x.y, x.z}});
        });
    }
    template <class Visit>
    static void for_each_near(const contacts& c, double factor, Visit&& visit) {
        c.spheres().for_each_near(factor, visit);
    }
    template <class Visit>
    static void for_each_near_wall(const contacts& c, double factor, Visit&& visit) {
        c.spheres().for_each_near_wall(factor, [&](std::int32_t i, int w, double distance) {
            visit(i, c.spheres().wall_at(w).patch, distance);
        });
    }
    static double wall_temperature(const contacts& c, int patch) { return c.spheres().patch_temperature(patch); }
};
