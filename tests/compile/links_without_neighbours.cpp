// SPDX-License-Identifier: MIT
// error: hearth: contact_traits<Contacts> lacks  for_each_near(contacts, radius_factor, visit)
#include <hearth/closure/feng_han.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/transfer/radiation.hpp>

#include "host.hpp"

template <>
struct hearth::particle_traits<host::cloud> {
    using index = int;
    using scalar = double;
    static index particle_count(const host::cloud&) { return 1; }
    static scalar get(quantity::radius, const host::cloud&, index) { return 1; }
};

template <>
struct hearth::contact_traits<host::mesh> {
#ifdef MENDED
    template <class Visit>
    static void for_each_near(const host::mesh&, double, Visit&& visit) {
        visit(0, 1, 2.5);
    }
#endif
};

void plug_in(const host::cloud& cloud, const host::mesh& contacts) {
    (void)hearth::scene{hearth::radiation{hearth::closure::feng_han::monte_carlo_fit{}}}.links(cloud, contacts);
}
