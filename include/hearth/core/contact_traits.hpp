// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include <hearth/core/mesh_traits.hpp>

namespace hearth {

/// One contact of a particle with a particle or a wall, as the host's motion sees it.
struct contact {
    double normal_force;  ///< elastic part along the normal, >= 0 [N]
    double overlap;       ///< of the (perhaps softened) motion, >= 0 [m]
    point position;       ///< contact point [m]
};

/// How a host tells who touches whom, and how hard.  A host specialises this struct.
///
///     void for_each_contact(contacts, visit)                   visit(i, j, contact): every pair once
///     void for_each_wall_contact(contacts, visit)              visit(i, patch, contact)
///     void for_each_near(contacts, radius_factor, visit)       visit(i, j, distance of centres [m]): every pair with
///                                                              distance < radius_factor * (R_i + R_j), once
///     void for_each_near_wall(contacts, radius_factor, visit)  optional: visit(i, patch, distance of the centre to the
///                                                              wall [m]), distance < radius_factor * 2 R_i
///     double wall_temperature(contacts, patch)                 [K], where a scene exchanges heat with walls
///
/// i and j are the cloud's own indices.  Ghost particles of other ranks may stand for j; they are >= particle_count.
template <class Contacts, class Enable = void>
struct contact_traits {
    using not_specialised = void;
};

namespace detail {

template <class Contacts>
using contacts_of = contact_traits<std::remove_cv_t<std::remove_reference_t<Contacts>>>;

template <class C> const C& contacts_value() noexcept;
template <class T, class C> using contact_call = decltype(T::for_each_contact(contacts_value<C>(), any_visitor{}));
template <class T, class C> using wall_contact_call =
    decltype(T::for_each_wall_contact(contacts_value<C>(), any_visitor{}));
template <class T, class C> using near_call = decltype(T::for_each_near(contacts_value<C>(), 2.5, any_visitor{}));
template <class T, class C> using near_wall_call =
    decltype(T::for_each_near_wall(contacts_value<C>(), 2.5, any_visitor{}));
template <class T, class C> using wall_temperature_call = decltype(T::wall_temperature(contacts_value<C>(), 0));

template <template <class, class> class Expression, class Contacts, class = void>
inline constexpr bool contacts_have_v = false;
template <template <class, class> class Expression, class Contacts>
inline constexpr bool
    contacts_have_v<Expression, Contacts, std::void_t<Expression<contacts_of<Contacts>, Contacts>>> = true;

}  // namespace detail

template <class Contacts>
inline constexpr bool has_contacts_v = detail::contacts_have_v<detail::contact_call, Contacts>;
template <class Contacts>
inline constexpr bool has_wall_contacts_v = detail::contacts_have_v<detail::wall_contact_call, Contacts>;
template <class Contacts>
inline constexpr bool has_near_pairs_v = detail::contacts_have_v<detail::near_call, Contacts>;
template <class Contacts>
inline constexpr bool has_near_walls_v = detail::contacts_have_v<detail::near_wall_call, Contacts>;
template <class Contacts>
inline constexpr bool has_wall_temperature_v = detail::contacts_have_v<detail::wall_temperature_call, Contacts>;

}  // namespace hearth
