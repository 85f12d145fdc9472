// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <hearth/core/cell_graph.hpp>
#include <hearth/core/contact_traits.hpp>
#include <hearth/core/particle_traits.hpp>

namespace hearth {

/// What hearth found when it looked at a host through its traits.
struct conformance_report {
    std::vector<std::string> failures;   ///< one sentence each; empty where the host conforms
    std::int64_t checks = 0;             ///< checks made
    double seconds_per_access = 0;       ///< mean time of one look at the host: a volume, a face, a particle [s]

    bool passed() const { return failures.empty(); }
};

namespace detail {

class conformance_checker {
  public:
    conformance_report report;

    /// Only the first few sentences of one kind are kept: a host that is wrong once is often wrong everywhere.
    bool expect(bool holds, const char* what, std::int64_t index) {
        ++report.checks;
        if (holds) return true;
        if (what != last_) repeated_ = 0;
        last_ = what;
        if (++repeated_ <= 3) report.failures.push_back(std::string(what) + ", at " + std::to_string(index));
        return false;
    }

    /// Counts and times accesses to the host.
    template <class Body>
    void access(std::int64_t count, Body&& body) {
        const auto start = std::chrono::steady_clock::now();
        body();
        seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        accesses_ += count;
        report.seconds_per_access = accesses_ > 0 ? seconds_ / static_cast<double>(accesses_) : 0;
    }

  private:
    const char* last_ = nullptr;
    int repeated_ = 0;
    double seconds_ = 0;
    std::int64_t accesses_ = 0;
};

template <class Vector>
bool is_finite_point(const Vector& x) {
    return std::isfinite(static_cast<double>(x[0])) && std::isfinite(static_cast<double>(x[1])) &&
           std::isfinite(static_cast<double>(x[2]));
}

}  // namespace detail

/// Tests that any host runs over its mesh traits: `hearth::conformance(mesh)` after the adapter is written, and again
/// after each change of it.  In parallel all ranks call it; each reports its own cells.
template <class Mesh, class Communicator = serial_communicator>
[[nodiscard]] conformance_report conformance(const Mesh& mesh, const Communicator& communicator = {}) {
    require_cell_graph<Mesh>();
    using traits = mesh_traits<Mesh>;
    using index = mesh_index_t<Mesh>;
    detail::conformance_checker check;
    // Volumes, neighbours, ids, conductances, and both sides of each face between ranks.
    try {
        const cell_graph<Communicator> graph(mesh, communicator);
        check.expect(true, "graph", 0);
        std::vector<std::int64_t> ids(static_cast<std::size_t>(graph.total_count()), -1);
        for (std::int32_t c = 0; c < graph.cell_count(); ++c) ids[static_cast<std::size_t>(c)] = graph.global_index(c);
        graph.halo().gather(ids.data());
        for (std::int32_t c = 0; c < graph.total_count(); ++c) {
            check.expect(ids[static_cast<std::size_t>(c)] == graph.global_index(c), "a ghost is not its owner's cell", c);
        }
        graph.require_current();
    } catch (const std::exception& error) {
        check.report.failures.emplace_back(error.what());
        return check.report;
    }
    const index count = traits::cell_count(mesh);
    double sum = 0;
    check.access(static_cast<std::int64_t>(count), [&] {
        for (index c = 0; c < count; ++c) sum += static_cast<double>(traits::volume(mesh, c));
    });
    check.expect(std::isfinite(sum), "the sum of the volumes is not finite", 0);
    if constexpr (has_faces_v<Mesh>) {
        std::vector<std::pair<index, index>> faces, again;
        const auto read = [&](auto& list) {
            traits::for_each_face(mesh, [&](index a, index b, double area, double) {
                check.expect(area > 0 && std::isfinite(area), "the area of a face is not finite and > 0", std::int64_t{a});
                list.emplace_back(a, b);
            });
        };
        read(faces);
        check.access(static_cast<std::int64_t>(faces.size()), [&] { read(again); });
        check.expect(faces == again, "for_each_face visits other faces the second time", 0);
        if constexpr (has_neighbours_v<Mesh>) {
            std::vector<std::pair<index, index>> listed;
            for (index c = 0; c < count; ++c) {
                traits::for_each_neighbour(mesh, c, [&](index n) {
                    if (n != c) listed.emplace_back(std::min(c, n), std::max(c, n));
                });
            }
            for (auto& [a, b] : faces) {
                if (b < a) std::swap(a, b);
            }
            faces.erase(std::remove_if(faces.begin(), faces.end(), [](auto& f) { return f.first == f.second; }),
                        faces.end());
            for (auto* list : {&faces, &listed}) {
                std::sort(list->begin(), list->end());
                list->erase(std::unique(list->begin(), list->end()), list->end());
            }
            check.expect(faces == listed, "for_each_neighbour and for_each_face list different neighbours", 0);
        }
    }
    if constexpr (is_located_mesh_v<Mesh>) {
        for (index c = 0; c < count; ++c) {
            const auto x = traits::centre(mesh, c);
            const auto cell = static_cast<std::int64_t>(c);
            if (!check.expect(detail::is_finite_point(x), "the centre of a cell is not finite", cell)) continue;
            if constexpr (has_find_cell_v<Mesh>) {
                const point at{static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
                check.expect(traits::find_cell(mesh, at) == c, "find_cell does not find a cell at its own centre", cell);
            }
            if constexpr (has_extent_v<Mesh>) {
                const auto h = traits::extent(mesh, c);
                check.expect(detail::is_finite_point(h) && h[0] > 0 && h[1] > 0 && h[2] > 0,
                             "an extent of a cell is not finite and > 0", cell);
            }
        }
    }
    return check.report;
}

/// The same for particles: ids, positions, radii, and state that comes back as it was set.
template <class Cloud>
[[nodiscard]] conformance_report cloud_conformance(Cloud& cloud) {
    require_particle_cloud<Cloud>();
    using traits = particle_traits<Cloud>;
    using index = particle_index_t<Cloud>;
    detail::conformance_checker check;
    const index count = traits::particle_count(cloud);
    std::vector<std::int64_t> ids;
    check.access(2 * static_cast<std::int64_t>(count), [&] {
        for (index i = 0; i < count; ++i) {
            const auto at = static_cast<std::int64_t>(i);
            check.expect(detail::is_finite_point(traits::get(quantity::position{}, cloud, i)),
                         "the position of a particle is not finite", at);
            const auto radius = static_cast<double>(traits::get(quantity::radius{}, cloud, i));
            check.expect(radius > 0 && std::isfinite(radius), "the radius of a particle is not finite and > 0", at);
        }
    });
    for (index i = 0; i < count; ++i) ids.push_back(particle_global_index(cloud, i));
    std::sort(ids.begin(), ids.end());
    const auto twice = std::adjacent_find(ids.begin(), ids.end());
    check.expect(twice == ids.end(), "two particles have one global index", twice == ids.end() ? 0 : *twice);
    if constexpr (can_get_v<Cloud, quantity::temperature> && can_set_v<Cloud, quantity::temperature>) {
        for (index i = 0; i < count; ++i) {
            const auto before = traits::get(quantity::temperature{}, cloud, i);
            traits::set(quantity::temperature{}, cloud, i, before);
            check.expect(traits::get(quantity::temperature{}, cloud, i) == before,
                         "a temperature does not come back as it was set", static_cast<std::int64_t>(i));
        }
    }
    return check.report;
}

/// The same for contacts: indices, forces, and every pair once.
template <class Contacts>
[[nodiscard]] conformance_report contact_conformance(const Contacts& contacts, std::int64_t particle_count) {
    static_assert(has_contacts_v<Contacts>, "hearth: contact_traits<Contacts> lacks  for_each_contact(contacts, visit)");
    using traits = contact_traits<Contacts>;
    detail::conformance_checker check;
    std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
    traits::for_each_contact(contacts, [&](auto i, auto j, const contact& touch) {
        const std::int64_t a = std::min<std::int64_t>(i, j), b = std::max<std::int64_t>(i, j);
        check.expect(a >= 0 && a < particle_count && a != b, "a contact of no particle of this rank", a);
        check.expect(touch.normal_force >= 0 && std::isfinite(touch.normal_force), "a normal force is not >= 0", a);
        check.expect(touch.overlap >= 0 && std::isfinite(touch.overlap), "an overlap is not >= 0", a);
        pairs.emplace_back(a, b);
    });
    std::sort(pairs.begin(), pairs.end());
    const auto twice = std::adjacent_find(pairs.begin(), pairs.end());
    check.expect(twice == pairs.end(), "a pair in contact is visited twice", twice == pairs.end() ? 0 : twice->first);
    return check.report;
}

}  // namespace hearth
