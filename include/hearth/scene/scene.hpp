// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include <hearth/core/contact_traits.hpp>
#include <hearth/core/particle_traits.hpp>
#include <hearth/scene/build_links.hpp>
#include <hearth/scene/needs.hpp>
#include <hearth/time/limits.hpp>
#include <hearth/time/tssm.hpp>
#include <hearth/transfer/links.hpp>
#include <hearth/transfer/term.hpp>

namespace hearth {

/// Stands for the gas where a scene has none.
struct no_gas {};

/// What one term exchanged with the gas in one evaluation, once (not times Gamma): what particles gained, the gas lost.
struct term_ledger {
    double heat_from_gas = 0.0;                   ///< [W]
    std::array<double, 3> force_from_gas{};       ///< drag, without the pressure's share [N]
    std::array<double, 3> force_from_pressure{};  ///< [N]
    double vapour_to_gas = 0.0;                   ///< [kg/s]
    double vapour_enthalpy_to_gas = 0.0;          ///< [W]
};

namespace detail {

/// A term as a base class: an empty one weighs nothing, and two equal ones are different bases.
template <std::size_t I, class Term>
struct indexed : Term {
    constexpr explicit indexed(Term term) : Term(std::move(term)) {}
};

template <class Indices, class... Terms>
struct scene_terms;
template <std::size_t... I, class... Terms>
struct scene_terms<std::index_sequence<I...>, Terms...> : indexed<I, Terms>... {
    constexpr explicit scene_terms(Terms... terms) : indexed<I, Terms>(std::move(terms))... {}

    /// Calls visit(index, term) for each term that has an act of the kind; others leave no trace in the program.
    template <act Kind, class Visit>
    constexpr void for_each(Visit&& visit) const {
        (call<Kind, I, Terms>(visit), ...);
    }

  private:
    template <act Kind, std::size_t K, class Term, class Visit>
    constexpr void call(Visit&& visit) const {
        if constexpr (has_act<Term>(Kind))
            visit(std::integral_constant<std::size_t, K>{},
                  static_cast<const Term&>(static_cast<const indexed<K, Term>&>(*this)));
    }
};

/// The least kind of link that holds what the terms state.
template <bool Conducts, bool Radiates>
using least_link = std::conditional_t<Conducts && Radiates, thermal_link<double>,
                                      std::conditional_t<Radiates, radiative_link<double>, conductive_link<double>>>;

}  // namespace detail

/// Physics composed at compile time: only what is named exists.
///
///     scene cold_bed{drag{closure::ergun{}}};                                  // asks no temperature of the host
///     scene kiln{drag{closure::ergun{}}, convection{closure::gunn{}}, conduction{closure::zhang::constriction{}},
///                radiation{closure::feng_han::monte_carlo_fit{}}};
///
/// The host gives particles and gas by particle_traits: gas is a second cloud that holds, for each particle, the gas as
/// that particle sees it (what the transfer operator gathers), and takes what it receives there (to be scattered).
/// Contacts come by contact_traits.  A clock says what Gamma does (time/tssm.hpp).
///
/// accumulate() is a hot loop and trusts its input as closures do; a NaN shows in the ledger.  The implicit steps of
/// time/ check theirs.
template <class... Terms>
class scene : private detail::scene_terms<std::index_sequence_for<Terms...>, Terms...> {
    using base = detail::scene_terms<std::index_sequence_for<Terms...>, Terms...>;
    static constexpr bool has(act kind) { return detail::any_has<Terms...>(kind); }

  public:
    using needs = needs_of<Terms...>;
    using link = detail::least_link<has(act::contact | act::nearby), has(act::views)>;
    using ledger = std::array<term_ledger, sizeof...(Terms)>;

    constexpr explicit scene(Terms... terms) : base(std::move(terms)...) {}

    /// Adds to each particle and to the gas at it what they exchange: heat and water times Gamma into the particle and
    /// once into the gas, forces once.  One loop over particles for all terms.  Returns a ledger per term, in their
    /// order.
    template <class Cloud, class Gas, class Clock = unsplit>
    ledger accumulate(Cloud& cloud, Gas& gas, const Clock& clock = {}) const {
        needs::template require<Cloud, Gas>();
        ledger books{};
        if constexpr (needs::template are_met_by<Cloud, Gas>()) {
            using traits = detail::particles_of<Cloud>;
            using gas_traits = detail::particles_of<Gas>;
            using index = particle_index_t<Cloud>;
            const index count = traits::particle_count(cloud);
            // The body stands here and not in a function of its own, so that the ledger stays in registers.
            for (index i = 0; i < count; ++i) {
                const auto k = static_cast<particle_index_t<Gas>>(i);
                const view<Cloud> p(cloud, i);
                const view<Gas> g(gas, k);
                if constexpr (has(act::gas_heat)) {
                    double heat = 0.0;
                    this->template for_each<act::gas_heat>([&](auto number, const auto& term) {
                        const double q = term.gas_link(p, g, clock)
                                             .heat(static_cast<double>(p[quantity::temperature{}]),
                                                   static_cast<double>(g[quantity::gas_temperature{}]));
                        heat += q;
                        books[number].heat_from_gas += q;
                    });
                    traits::add(quantity::heat_rate{}, cloud, i, clock.factor(i) * heat);
                    gas_traits::add(quantity::gas_heat_rate{}, gas, k, -heat);
                }
                if constexpr (has(act::gas_force)) {
                    std::array<double, 3> force{}, reaction{};
                    this->template for_each<act::gas_force>([&](auto number, const auto& term) {
                        const drag_exchange exchange = term.gas_force(p, g, clock);
                        detail::for_each_axis([&](std::size_t a) {
                            const double f = exchange.coefficient * exchange.slip[a];
                            force[a] += f + exchange.pressure_force[a];
                            reaction[a] -= f;
                            books[number].force_from_gas[a] += f;
                            books[number].force_from_pressure[a] += exchange.pressure_force[a];
                        });
                    });
                    traits::add(quantity::force{}, cloud, i, force);
                    gas_traits::add(quantity::gas_force{}, gas, k, reaction);
                }
                if constexpr (has(act::gas_mass)) {
                    double mass = 0.0, enthalpy = 0.0, latent = 0.0;
                    this->template for_each<act::gas_mass>([&](auto number, const auto& term) {
                        const vapour_exchange exchange = term.gas_mass(p, g, clock);
                        mass += exchange.rate;
                        latent += exchange.rate * exchange.latent_heat;
                        enthalpy += exchange.rate * exchange.vapour_enthalpy;
                        books[number].vapour_to_gas += exchange.rate;
                        books[number].vapour_enthalpy_to_gas += exchange.rate * exchange.vapour_enthalpy;
                    });
                    traits::add(quantity::mass_rate{}, cloud, i, -clock.factor(i) * mass);
                    traits::add(quantity::heat_rate{}, cloud, i, -clock.factor(i) * latent);
                    gas_traits::add(quantity::vapour_rate{}, gas, k, mass);
                    gas_traits::add(quantity::vapour_enthalpy_rate{}, gas, k, enthalpy);
                }
            }
        }
        return books;
    }

    /// Conductance of each particle to its gas, all terms together [W/K]: for gas_exchange, through_flow and limits.
    template <class Cloud, class Gas, class Clock = unsplit>
    void gas_conductances(const Cloud& cloud, const Gas& gas, std::vector<double>& conductance,
                          const Clock& clock = {}) const {
        using index = particle_index_t<Cloud>;
        const index count = detail::particles_of<Cloud>::particle_count(cloud);
        conductance.assign(static_cast<std::size_t>(count), 0.0);
        for (index i = 0; i < count; ++i) {
            const view<Cloud> p(cloud, i);
            const view<Gas> g(gas, static_cast<particle_index_t<Gas>>(i));
            this->template for_each<act::gas_heat>([&](auto, const auto& term) {
                conductance[static_cast<std::size_t>(i)] += term.gas_link(p, g, clock).conductance;
            });
        }
    }

    /// All exchange of heat beside the gas, as numbers; to be made anew when particles have moved.  Asks what the terms
    /// with contacts, neighbours or views read, except temperatures: a link holds at any.
    template <class Cloud, class Contacts, class Gas = no_gas>
    link_list<link> links(const Cloud& cloud, const Contacts& contacts, const Gas& gas = {}) const {
        link_list<link> list;
        links(cloud, contacts, gas, list);
        return list;
    }

    /// The same into a list whose memory is used again.
    template <class Cloud, class Contacts, class Gas>
    void links(const Cloud& cloud, const Contacts& contacts, const Gas& gas, link_list<link>& list) const {
        list.clear();
        using wanted = link_needs<Terms...>;
        wanted::template require<Cloud, Contacts, Gas>();
        if constexpr (wanted::template are_met_by<Cloud, Contacts, Gas>()) list_links(cloud, contacts, gas, list);
    }

    /// Bath of each particle: gas, walls and open views at their present temperatures, for the integrators of time/.
    template <class Cloud, class Contacts, class Gas, class Clock = unsplit>
    std::vector<heat_bath<double>> baths(const Cloud& cloud, const Contacts& contacts, const Gas& gas,
                                         const link_list<link>& list, const Clock& clock = {}) const {
        using index = particle_index_t<Cloud>;
        const index count = detail::particles_of<Cloud>::particle_count(cloud);
        std::vector<heat_bath<double>> result(static_cast<std::size_t>(count));
        if constexpr (has(act::gas_heat)) {
            std::vector<double> conductance;
            gas_conductances(cloud, gas, conductance, clock);
            for (index i = 0; i < count; ++i) {
                const auto k = static_cast<std::size_t>(i);
                const view<Gas> g(gas, static_cast<particle_index_t<Gas>>(i));
                result[k].add(conductive_link<double>{conductance[k]},
                              static_cast<double>(g[quantity::gas_temperature{}]));
            }
        }
        if constexpr (has_wall_temperature_v<Contacts>) {
            for (const auto& wall : list.walls)
                result[static_cast<std::size_t>(wall.particle)].add(
                    wall.link, detail::contacts_of<Contacts>::wall_temperature(contacts, wall.patch));
        } else {
            static_assert(!has_wall_contacts_v<Contacts> && !has_near_walls_v<Contacts>,
                          "hearth: contact_traits<Contacts> lacks  double wall_temperature(contacts, patch)  [K]");
        }
        for (const auto& open : list.surroundings)
            result[static_cast<std::size_t>(open.particle)].add(open.link, open.temperature);
        return result;
    }

    /// Largest stable step of the explicit exchange of heat with baths and pairs, by the model's clock [s]; gas and
    /// walls held (a gas that is explicit too: stable_step::particle_and_gas).  capacity[i] = m c_p [J/K].
    template <class Clock = unsplit>
    static double largest_step(const link_list<link>& list, const std::vector<heat_bath<double>>& baths,
                               std::vector<double> capacity, const std::vector<double>& temperature,
                               const Clock& clock = {}) {
        for (std::size_t i = 0; i < capacity.size(); ++i) capacity[i] /= clock.factor(i);
        return stable_step::network(list.pairs, baths, capacity, temperature);
    }

  private:
    template <class Cloud, class Contacts, class Gas>
    void list_links(const Cloud& cloud, const Contacts& contacts, const Gas& gas, link_list<link>& list) const {
        using index = particle_index_t<Cloud>;
        const auto particle = [&](auto i) { return view<Cloud>(cloud, static_cast<index>(i)); };
        const auto gas_at = [&](auto i) { return view<Gas>(gas, static_cast<particle_index_t<Gas>>(i)); };
        // Asked outside of the loops over terms, or a host would owe what no term wants.
        if constexpr (has(act::contact)) {
            this->template for_each<act::contact>([&](auto number, const auto& term) {
                detail::contacts_of<Contacts>::for_each_contact(contacts, [&](auto i, auto j, const contact& touch) {
                    add_pair(list, i, j, term.contact_link(particle(i), particle(j), gas_at(i), gas_at(j), touch));
                });
                if constexpr (has_wall_contacts_v<Contacts>) {
                    detail::contacts_of<Contacts>::for_each_wall_contact(
                        contacts, [&](auto i, auto patch, const contact& touch) {
                            const auto made = term.wall_contact_link(particle(i), gas_at(i), touch);
                            if (made.conductance != 0.0)
                                list.walls.push_back(
                                    {static_cast<std::int32_t>(i), static_cast<std::int32_t>(patch), narrowed(made)});
                        });
                }
                list.close_part(number);
            });
        }
        if constexpr (has(act::nearby)) {
            this->template for_each<act::nearby>([&](auto number, const auto& term) {
                detail::contacts_of<Contacts>::for_each_near(
                    contacts, term.reach(), [&](auto i, auto j, double distance) {
                        add_pair(list, i, j, term.near_link(particle(i), particle(j), gas_at(i), gas_at(j), distance));
                    });
                list.close_part(number);
            });
        }
        this->template for_each<act::views>([&](auto number, const auto& term) {
            list.views.push_back(
                detail::build_radiation(term, cloud, contacts, list.pairs, list.walls, list.surroundings));
            list.close_part(number);
        });
    }

    template <class Link>
    static link narrowed(const Link& made) {
        const thermal_link<double> wide = widened(made);
        if constexpr (std::is_same_v<link, thermal_link<double>>)
            return wide;
        else if constexpr (std::is_same_v<link, radiative_link<double>>)
            return {wide.radiation};
        else
            return {wide.conductance};
    }

    template <class I, class J, class Link>
    static void add_pair(link_list<link>& list, I i, J j, const Link& made) {
        if (made.conductance != 0.0)
            list.pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), narrowed(made)});
    }
};

template <class... Terms>
scene(Terms...) -> scene<Terms...>;

}  // namespace hearth
