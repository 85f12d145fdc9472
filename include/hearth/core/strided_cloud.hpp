// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <hearth/core/particle_traits.hpp>

namespace hearth {

/// One quantity of all particles in memory that the host owns: element i starts at first[i * stride].
/// A stride of 0 gives every particle the same value; a null pointer means that the host does not have the quantity.
template <class Scalar>
struct strided {
    Scalar* first = nullptr;
    std::ptrdiff_t stride = 1;

    Scalar& operator[](std::ptrdiff_t i) const { return first[i * stride]; }
    Scalar* row(std::ptrdiff_t i) const { return first + i * stride; }
};

/// Ready-made particle view: raw pointers with strides, for hosts in C, Fortran or with arrays of structs.
///
///     strided_cloud cloud;
///     cloud.count = n;
///     cloud.position = {&atoms[0].x, 12};     // x, y, z next to each other
///     cloud.radius = {radii, 1};
template <class Scalar = double>
struct strided_cloud {
    std::int64_t count = 0;
    strided<const Scalar> position{nullptr, 3};
    strided<const Scalar> velocity{nullptr, 3};
    strided<const Scalar> radius;
    strided<const Scalar> mass;
    strided<const Scalar> specific_heat;
    strided<const Scalar> conductivity;
    strided<Scalar> temperature;
    strided<Scalar> heat_rate;
    strided<Scalar> force{nullptr, 3};
    const std::int64_t* ids = nullptr;  ///< persistent and unique over all ranks; the position in the arrays if null
};

template <class Scalar>
struct particle_traits<strided_cloud<Scalar>> {
    using index = std::int64_t;
    using scalar = Scalar;
    using cloud_type = strided_cloud<Scalar>;
    using vector = std::array<Scalar, 3>;

    static index particle_count(const cloud_type& cloud) { return cloud.count; }
    static index global_index(const cloud_type& cloud, index i) { return cloud.ids ? cloud.ids[i] : i; }

    static vector get(quantity::position, const cloud_type& cloud, index i) { return three(cloud.position.row(i)); }
    static vector get(quantity::velocity, const cloud_type& cloud, index i) { return three(cloud.velocity.row(i)); }
    static scalar get(quantity::radius, const cloud_type& cloud, index i) { return cloud.radius[i]; }
    static scalar get(quantity::mass, const cloud_type& cloud, index i) { return cloud.mass[i]; }
    static scalar get(quantity::specific_heat, const cloud_type& cloud, index i) { return cloud.specific_heat[i]; }
    static scalar get(quantity::conductivity, const cloud_type& cloud, index i) { return cloud.conductivity[i]; }
    static scalar get(quantity::temperature, const cloud_type& cloud, index i) { return cloud.temperature[i]; }

    static void set(quantity::temperature, cloud_type& cloud, index i, scalar kelvin) { cloud.temperature[i] = kelvin; }
    static void add(quantity::heat_rate, cloud_type& cloud, index i, scalar watts) { cloud.heat_rate[i] += watts; }
    template <class Vector>
    static void add(quantity::force, cloud_type& cloud, index i, const Vector& newtons) {
        Scalar* force = cloud.force.row(i);
        for (std::size_t a = 0; a < 3; ++a) force[a] += newtons[a];
    }

  private:
    static vector three(const Scalar* row) { return {row[0], row[1], row[2]}; }
};

}  // namespace hearth
