// SPDX-License-Identifier: MIT
// error: hearth: the scene reads a quantity that the host lacks: see Tag in host_gives<Tag, false>
#include <hearth/closure/zhang.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/transfer/conduction.hpp>

#include "host.hpp"

template <>
struct hearth::particle_traits<host::cloud> {  // no temperature: links ask none
    using index = int;
    using scalar = double;
    static index particle_count(const host::cloud&) { return 1; }
    static scalar get(quantity::radius, const host::cloud&, index) { return 1; }
#ifdef MENDED
    static scalar get(quantity::conductivity, const host::cloud&, index) { return 1; }
#endif
};

template <>
struct hearth::contact_traits<host::mesh> {
    template <class Visit>
    static void for_each_contact(const host::mesh&, Visit&& visit) {
        visit(0, 1, contact{1.0, 1e-6, {}});
    }
};

void plug_in(const host::cloud& cloud, const host::mesh& contacts) {
    (void)hearth::scene{hearth::conduction{hearth::closure::zhang::constriction{}}}.links(cloud, contacts);
}
