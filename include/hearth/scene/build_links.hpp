// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <hearth/core/contact_traits.hpp>
#include <hearth/core/particle_traits.hpp>
#include <hearth/transfer/links.hpp>
#include <hearth/transfer/radiation.hpp>
#include <hearth/transfer/term.hpp>

namespace hearth::detail {

/// What a row of a radiation term holds while it is made [-]: the shares of a particle's view.
struct view_row {
    double pairs = 0.0;
    double walls = 0.0;
    double open = 0.0;
    bool beside_wall = false;
};

/// Scales pairs by the mean of what their two rows need, a few times: symmetric, and the rows tend to 1.
template <class Pair, class Black>
double close_rows(std::vector<view_row>& rows, std::size_t first_pair, std::vector<Pair>& pairs, const Black& black) {
    double before = 0.0, after = 0.0;
    for (const view_row& row : rows) before += row.pairs;
    for (int sweep = 0; sweep < 20; ++sweep) {
        std::vector<double> wanted(rows.size(), 1.0);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const double target = std::max(0.0, 1.0 - rows[i].walls - rows[i].open);
            if (rows[i].pairs > 0.0) wanted[i] = target / rows[i].pairs;
            rows[i].pairs = 0.0;
        }
        for (std::size_t k = first_pair; k < pairs.size(); ++k) {
            const auto a = static_cast<std::size_t>(pairs[k].first), b = static_cast<std::size_t>(pairs[k].second);
            const bool ghost = b >= rows.size();
            pairs[k].link.radiation *= ghost ? wanted[a] : 0.5 * (wanted[a] + wanted[b]);
            rows[a].pairs += pairs[k].link.radiation / black(a);
            if (!ghost) rows[b].pairs += pairs[k].link.radiation / black(b);
        }
    }
    for (const view_row& row : rows) after += row.pairs;
    return before > 0.0 ? after / before : 1.0;
}

inline void summarise(const std::vector<view_row>& rows, view_report& report) {
    double sum = 0.0;
    std::int64_t inside = 0;
    for (const view_row& row : rows) {
        if (row.open > 0.0) {
            ++report.open;
            report.open_view += row.open;
            continue;
        }
        const double total = row.pairs + row.walls;
        report.row_least = inside == 0 ? total : std::min(report.row_least, total);
        report.row_largest = inside == 0 ? total : std::max(report.row_largest, total);
        sum += total;
        ++inside;
    }
    report.row_mean = inside > 0 ? sum / static_cast<double>(inside) : 0.0;
}

/// Makes the radiation of one term: pairs to the cutoff, walls, open views, rows as the term wants them.
/// Pairs of which only the first particle is owned (j >= count) are for the caller's list alone if j is a ghost that
/// the cloud can be asked for.
template <class Term, class Cloud, class Contacts, class Pair, class Wall>
view_report build_radiation(const Term& term, const Cloud& cloud, const Contacts& contacts, std::vector<Pair>& pairs,
                            std::vector<Wall>& walls, std::vector<linked_surroundings>& surroundings) {
    using index = particle_index_t<Cloud>;
    const auto at = [&](std::int64_t i) { return view<Cloud>(cloud, static_cast<index>(i)); };
    const auto count = static_cast<std::int64_t>(particles_of<Cloud>::particle_count(cloud));
    const double emission = term.emission();
    std::vector<view_row> rows(static_cast<std::size_t>(count));
    const std::size_t first_pair = pairs.size();

    contacts_of<Contacts>::for_each_near(contacts, term.reach(), [&](auto i, auto j, double distance) {
        const auto p = at(i), q = at(j);
        const double area = term.pair_area(p, q, distance);
        if (area == 0.0) return;  // NaN goes on, to be refused by what reads the list
        pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), {}});
        pairs.back().link.radiation = emission * area;
        rows[static_cast<std::size_t>(i)].pairs += area;
        if (static_cast<std::int64_t>(j) < count) rows[static_cast<std::size_t>(j)].pairs += area;
    });
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].pairs /= term.surface(at(static_cast<std::int64_t>(i)));

    if constexpr (has_near_walls_v<Contacts>) {
        contacts_of<Contacts>::for_each_near_wall(contacts, term.beside_wall(), [&](auto i, auto, double) {
            rows[static_cast<std::size_t>(i)].beside_wall = true;
        });
    }
    const auto see_wall = [&](auto i, auto patch, double distance) {
        const auto p = at(i);
        const double area = term.wall_area(p, distance);
        if (area == 0.0) return;  // NaN goes on, to be refused by what reads the list
        walls.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(patch), {}});
        walls.back().link.radiation = emission * area;
        view_row& row = rows[static_cast<std::size_t>(i)];
        row.walls += area / term.surface(p);
        row.beside_wall = true;
    };
    constexpr bool at_distance = !decltype(term.wall)::touching_only();
    if constexpr (at_distance && has_near_walls_v<Contacts>) {
        contacts_of<Contacts>::for_each_near_wall(contacts, term.reach(), see_wall);
    } else if constexpr (has_wall_contacts_v<Contacts>) {
        // A view that is meant for touching particles, or a host that knows of no others.
        contacts_of<Contacts>::for_each_wall_contact(contacts, [&](auto i, auto patch, const contact&) {
            see_wall(i, patch, static_cast<double>(at(i)[quantity::radius{}]));
        });
    }

    // A particle that misses more of its view than the scatter inside a bed explains looks out of the bed.
    const bed_view inside = bed_view::within(term.params.cutoff, term.params.solid_fraction);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        // A wall view for touching particles lets them stand for the others beside the wall, which are not open for
        // that.
        const double behind = rows[i].beside_wall ? std::max(rows[i].walls, term.behind_wall()) : 0.0;
        const double missing = 1.0 - behind - rows[i].pairs / inside.seen;
        if (!(missing > term.params.open_from)) continue;
        rows[i].open = missing;
        surroundings.push_back({static_cast<std::int32_t>(i),
                                term.params.surroundings,
                                {emission * missing * term.surface(at(static_cast<std::int64_t>(i)))}});
    }

    view_report report;
    if (term.params.rows == view_rows::conductivity) {
        report.scale = 1.0 / inside.carried;
        for (std::size_t k = first_pair; k < pairs.size(); ++k) pairs[k].link.radiation *= report.scale;
        for (view_row& row : rows) row.pairs *= report.scale;
    } else {
        report.scale = close_rows(rows, first_pair, pairs, [&](std::size_t i) {
            return emission * term.surface(at(static_cast<std::int64_t>(i)));
        });
    }
    summarise(rows, report);
    return report;
}

}  // namespace hearth::detail
