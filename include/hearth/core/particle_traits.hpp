// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

#include <hearth/core/quantity.hpp>

namespace hearth {

/// How a host's particles answer hearth.  A host specialises this struct with one overload per quantity that it has.
///
///     using index  = ...;                                      signed integer, 0 <= i < particle_count
///     using scalar = ...;                                      float or double
///     index  particle_count(cloud)                             particles that this rank owns
///     scalar get(quantity::radius, cloud, i)                   position and velocity: anything with [0], [1], [2]
///     void   add(quantity::heat_rate, cloud, i, watts)         rates, positive into the particle
///     void   set(quantity::temperature, cloud, i, kelvin)      state that an integrator of hearth may advance
///     std::int64_t global_index(cloud, i)                      optional: unique over all ranks and persistent
///
/// hearth asks only for the quantities that the terms of a scene read and write.
template <class Cloud, class Enable = void>
struct particle_traits {
    using not_specialised = void;
};

namespace detail {

template <class Cloud>
using particles_of = particle_traits<std::remove_cv_t<std::remove_reference_t<Cloud>>>;

template <class Cloud> const Cloud& cloud_value() noexcept;
template <class Cloud> Cloud& mutable_cloud_value() noexcept;

template <class Cloud, class = void>
struct particle_index { using type = std::int64_t; };
template <class Cloud>
struct particle_index<Cloud, std::void_t<typename particles_of<Cloud>::index>> {
    using type = typename particles_of<Cloud>::index;
};

template <class Cloud, class = void>
struct particle_scalar { using type = double; };
template <class Cloud>
struct particle_scalar<Cloud, std::void_t<typename particles_of<Cloud>::scalar>> {
    using type = typename particles_of<Cloud>::scalar;
};

template <class Cloud, class = void>
inline constexpr bool has_particle_count_v = false;
template <class Cloud>
inline constexpr bool
    has_particle_count_v<Cloud, std::void_t<decltype(particles_of<Cloud>::particle_count(cloud_value<Cloud>()))>> =
        true;

template <class Cloud, class = void>
inline constexpr bool has_particle_index_v = false;
template <class Cloud>
inline constexpr bool has_particle_index_v<
    Cloud, std::void_t<decltype(particles_of<Cloud>::global_index(
               cloud_value<Cloud>(), std::declval<typename particle_index<Cloud>::type>()))>> = true;

}  // namespace detail

template <class Cloud> using particle_index_t = typename detail::particle_index<Cloud>::type;
template <class Cloud> using particle_scalar_t = typename detail::particle_scalar<Cloud>::type;

/// True where the host can tell the quantity `Tag` of a particle.
template <class Cloud, class Tag, class = void>
inline constexpr bool can_get_v = false;
template <class Cloud, class Tag>
inline constexpr bool can_get_v<Cloud, Tag,
                                std::void_t<decltype(detail::particles_of<Cloud>::get(
                                    Tag{}, detail::cloud_value<Cloud>(), particle_index_t<Cloud>{}))>> = true;

/// True where the host takes a rate `Tag` of a particle.
template <class Cloud, class Tag, class Value = double, class = void>
inline constexpr bool can_add_v = false;
template <class Cloud, class Tag, class Value>
inline constexpr bool
    can_add_v<Cloud, Tag, Value,
              std::void_t<decltype(detail::particles_of<Cloud>::add(Tag{}, detail::mutable_cloud_value<Cloud>(),
                                                                    particle_index_t<Cloud>{},
                                                                    std::declval<const Value&>()))>> = true;

/// True where the host lets hearth set the state `Tag` of a particle.
template <class Cloud, class Tag, class Value = double, class = void>
inline constexpr bool can_set_v = false;
template <class Cloud, class Tag, class Value>
inline constexpr bool
    can_set_v<Cloud, Tag, Value,
              std::void_t<decltype(detail::particles_of<Cloud>::set(Tag{}, detail::mutable_cloud_value<Cloud>(),
                                                                    particle_index_t<Cloud>{},
                                                                    std::declval<const Value&>()))>> = true;

/// True where the host counts its particles and tells where each one is and how large: enough to deposit them.
template <class Cloud>
inline constexpr bool is_particle_cloud_v =
    detail::has_particle_count_v<Cloud> && can_get_v<Cloud, quantity::position> && can_get_v<Cloud, quantity::radius>;

/// Global index of a particle; its local index where the host has no other.
template <class Cloud>
std::int64_t particle_global_index(const Cloud& cloud, particle_index_t<Cloud> i) {
    if constexpr (detail::has_particle_index_v<Cloud>) {
        return static_cast<std::int64_t>(detail::particles_of<Cloud>::global_index(cloud, i));
    } else {
        return static_cast<std::int64_t>(i);
    }
}

/// Fails to compile with one sentence that names the first member that the host's traits lack.
template <class Cloud>
constexpr void require_particle_cloud() {
    if constexpr (!detail::has_particle_count_v<Cloud>) {
        static_assert(detail::has_particle_count_v<Cloud>,
                      "hearth: particle_traits<Cloud> lacks  index particle_count(cloud)");
    } else if constexpr (!can_get_v<Cloud, quantity::position>) {
        static_assert(can_get_v<Cloud, quantity::position>,
                      "hearth: particle_traits<Cloud> lacks  get(quantity::position, cloud, i)  [m]");
    } else {
        static_assert(can_get_v<Cloud, quantity::radius>,
                      "hearth: particle_traits<Cloud> lacks  get(quantity::radius, cloud, i)  [m]");
    }
}

}  // namespace hearth
