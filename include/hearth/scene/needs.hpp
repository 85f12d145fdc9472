// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <type_traits>

#include <hearth/core/contact_traits.hpp>
#include <hearth/core/particle_traits.hpp>
#include <hearth/core/quantity.hpp>
#include <hearth/transfer/term.hpp>

namespace hearth {

namespace detail {

template <class Tag, class List>
inline constexpr bool is_among_v = false;
template <class Tag, class... Tags>
inline constexpr bool is_among_v<Tag, quantities<Tags...>> = (std::is_same_v<Tag, Tags> || ...);

/// Appends the tags of the second list that the first lacks.
template <class Known, class More>
struct merged {
    using type = Known;
};
template <class... Known, class Tag, class... More>
struct merged<quantities<Known...>, quantities<Tag, More...>> {
    using next =
        std::conditional_t<is_among_v<Tag, quantities<Known...>>, quantities<Known...>, quantities<Known..., Tag>>;
    using type = typename merged<next, quantities<More...>>::type;
};

template <class... Lists>
struct merged_all {
    using type = quantities<>;
};
template <class First, class... Rest>
struct merged_all<First, Rest...> {
    using type = typename merged<First, typename merged_all<Rest...>::type>::type;
};

/// A list without one tag.
template <class Tag, class List>
struct left_out;
template <class Tag, class... Tags>
struct left_out<Tag, quantities<Tags...>>
    : merged_all<std::conditional_t<std::is_same_v<Tag, Tags>, quantities<>, quantities<Tags>>...> {};

template <class... Terms>
constexpr bool any_has([[maybe_unused]] act kind) {
    return (has_act<Terms>(kind) || ... || false);
}

template <class Tag>
using value_of = std::conditional_t<std::is_same_v<Tag, quantity::force> || std::is_same_v<Tag, quantity::gas_force>,
                                    std::array<double, 3>, double>;

/// One error, and its context names the quantity.
template <class Tag, bool Present>
struct host_gives {
    static_assert(Present, "hearth: the scene reads a quantity that the host lacks: see Tag in host_gives<Tag, false>");
};
template <class Tag, bool Present>
struct host_takes {
    static_assert(Present,
                  "hearth: the scene adds a rate that the host does not take: see Tag in host_takes<Tag, false>");
};

template <class Host, class... Tags>
constexpr bool gives(quantities<Tags...>) {
    return (can_get_v<Host, Tags> && ...);
}
template <class Host, class... Tags>
constexpr bool takes(quantities<Tags...>) {
    return (can_add_v<Host, Tags, value_of<Tags>> && ...);
}

template <class Host>
constexpr void require_gives(quantities<>) {}
template <class Host, class Tag, class... Tags>
constexpr void require_gives(quantities<Tag, Tags...>) {
    if constexpr (can_get_v<Host, Tag>) {
        require_gives<Host>(quantities<Tags...>{});
    } else {
        (void)host_gives<Tag, can_get_v<Host, Tag>>{};
    }
}
template <class Host>
constexpr void require_takes(quantities<>) {}
template <class Host, class Tag, class... Tags>
constexpr void require_takes(quantities<Tag, Tags...>) {
    if constexpr (can_add_v<Host, Tag, value_of<Tag>>) {
        require_takes<Host>(quantities<Tags...>{});
    } else {
        (void)host_takes<Tag, can_add_v<Host, Tag, value_of<Tag>>>{};
    }
}

template <class... Tags>
void list_quantities(std::string& text, const char* title, quantities<Tags...>) {
    if constexpr (sizeof...(Tags) > 0) {
        text += title;
        ((text += std::string("\n    ") + Tags::name + "  " + Tags::symbol + " [" + Tags::unit + "]"), ...);
        text += '\n';
    }
}

}  // namespace detail

/// What a set of terms asks of a host: four lists of quantity tags.
template <class... Terms>
struct needs_of {
    using reads = typename detail::merged_all<typename Terms::reads...>::type;
    using writes = typename detail::merged_all<typename Terms::writes...>::type;
    using gas_reads = typename detail::merged_all<typename Terms::gas_reads...>::type;
    using gas_writes = typename detail::merged_all<typename Terms::gas_writes...>::type;

    /// True where a cloud and the gas at its particles give and take all of it.
    template <class Cloud, class Gas>
    static constexpr bool are_met_by() {
        return detail::gives<Cloud>(reads{}) && detail::takes<Cloud>(writes{}) && detail::gives<Gas>(gas_reads{}) &&
               detail::takes<Gas>(gas_writes{});
    }

    /// Fails to compile with one error whose context names the first quantity that is missing.
    template <class Cloud, class Gas>
    static constexpr void require() {
        if constexpr (!(detail::gives<Cloud>(reads{}) && detail::gives<Gas>(gas_reads{}))) {
            if constexpr (!detail::gives<Cloud>(reads{})) {
                detail::require_gives<Cloud>(reads{});
            } else {
                detail::require_gives<Gas>(gas_reads{});
            }
        } else if constexpr (!detail::takes<Cloud>(writes{})) {
            detail::require_takes<Cloud>(writes{});
        } else if constexpr (!detail::takes<Gas>(gas_writes{})) {
            detail::require_takes<Gas>(gas_writes{});
        }
    }

    /// The same as text, with symbols and units, for a log or a message.
    static std::string text() {
        std::string result;
        detail::list_quantities(result, "of a particle:", reads{});
        detail::list_quantities(result, "rates that a particle takes:", writes{});
        detail::list_quantities(result, "of the gas at a particle:", gas_reads{});
        detail::list_quantities(result, "rates that the gas takes there:", gas_writes{});
        return result;
    }
};

/// What the list of links of a set of terms asks of a host: all that the terms with contacts, neighbours or views read,
/// except temperatures, because a link holds at any, and the pairs themselves.
template <class... Terms>
class link_needs {
    template <class Term, class Tags>
    using if_linked = std::conditional_t<has_act<Term>(act::contact | act::nearby | act::views), Tags, quantities<>>;
    static constexpr bool touch = detail::any_has<Terms...>(act::contact);
    static constexpr bool near = detail::any_has<Terms...>(act::nearby | act::views);

  public:
    using reads =
        typename detail::left_out<quantity::temperature,
                                  typename detail::merged_all<if_linked<Terms, typename Terms::reads>...>::type>::type;
    using gas_reads = typename detail::merged_all<if_linked<Terms, typename Terms::gas_reads>...>::type;

    template <class Cloud, class Contacts, class Gas>
    static constexpr bool are_met_by() {
        return detail::gives<Cloud>(reads{}) && detail::gives<Gas>(gas_reads{}) &&
               (has_contacts_v<Contacts> || !touch) && (has_near_pairs_v<Contacts> || !near);
    }

    /// Fails to compile with one error that names the first thing that is missing.
    template <class Cloud, class Contacts, class Gas>
    static constexpr void require() {
        if constexpr (!detail::gives<Cloud>(reads{})) {
            detail::require_gives<Cloud>(reads{});
        } else if constexpr (!detail::gives<Gas>(gas_reads{})) {
            detail::require_gives<Gas>(gas_reads{});
        } else if constexpr (touch && !has_contacts_v<Contacts>) {
            static_assert(has_contacts_v<Contacts>,
                          "hearth: contact_traits<Contacts> lacks  for_each_contact(contacts, visit)");
        } else if constexpr (near) {
            static_assert(has_near_pairs_v<Contacts>,
                          "hearth: contact_traits<Contacts> lacks  for_each_near(contacts, radius_factor, visit)");
        }
    }
};

}  // namespace hearth
