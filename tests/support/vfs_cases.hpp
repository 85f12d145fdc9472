// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <hearth/core/cell_graph.hpp>

#include "support/meshes.hpp"

/// Input for tests of the Volume Fraction Smoother, and its wave written as plainly as the paper describes it.
namespace hearth::test {

/// Label of the connected component of each cell, counted from 0.
inline std::vector<int> components(const listed_graph& graph) {
    std::vector<std::size_t> parent(graph.volumes.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto find = [&](std::size_t c) {
        while (parent[c] != c) c = parent[c] = parent[parent[c]];
        return c;
    };
    for (const auto& f : graph.faces) {
        parent[find(static_cast<std::size_t>(f.a))] = find(static_cast<std::size_t>(f.b));
    }
    std::vector<int> labels(parent.size(), -1);
    std::vector<int> label_of_root(parent.size(), -1);
    int count = 0;
    for (std::size_t c = 0; c < parent.size(); ++c) {
        int& label = label_of_root[find(c)];
        if (label < 0) label = count++;
        labels[c] = label;
    }
    return labels;
}

/// Solid volume of each component, summed in long double.
template <class Field>
std::vector<long double> volumes_of_components(const listed_graph& graph, const std::vector<int>& labels,
                                               const Field& solid_fraction) {
    std::vector<long double> sums(labels.empty() ? 0 : 1 + static_cast<std::size_t>(*std::max_element(labels.begin(), labels.end())));
    for (std::size_t c = 0; c < labels.size(); ++c) {
        sums[static_cast<std::size_t>(labels[c])] +=
            static_cast<long double>(solid_fraction[c]) * static_cast<long double>(graph.volumes[c]);
    }
    return sums;
}

/// A graph of any kind, a field of any kind of which each component fits below the threshold: with 0.3 to 0.02 to
/// spare, less, or nothing but the rounding of the field.
struct vfs_case {
    listed_graph graph;
    std::vector<int> labels;
    std::vector<double> solid_fraction;
    double threshold;
    bool full;

    vfs_case(std::uint64_t seed, double most_cells) {
        seeded random(seed);
        const auto kind = static_cast<graph_kind>(random.index(graph_kind_count));
        const auto cells = static_cast<std::size_t>(random.log_uniform(2, most_cells));
        graph = random_graph(kind, cells, random.uniform(0, 1) < 0.5 ? 1 : 1e6, seed);
        labels = components(graph);
        solid_fraction.assign(graph.volumes.size(), 0.0);
        if (random.uniform(0, 1) < 0.2) {  // all in one cell of each component
            std::vector<bool> seen(solid_fraction.size(), false);
            for (std::size_t c = solid_fraction.size(); c-- > 0;) {
                if (!seen[static_cast<std::size_t>(labels[c])]) solid_fraction[c] = 1;
                seen[static_cast<std::size_t>(labels[c])] = true;
            }
        } else {
            const double crowd = random.uniform(0, 0.5);
            for (double& s : solid_fraction) {
                s = random.uniform(0, 1) < crowd ? random.log_uniform(0.5, 50) : random.uniform(0, 0.3);
            }
        }
        threshold = random.uniform(0.3, 1.0);
        full = random.uniform(0, 1) < 0.3;
        const double mean = full ? threshold : threshold - (random.uniform(0, 1) < 0.5 ? random.uniform(0, 0.02)
                                                                                      : random.uniform(0.02, 0.29));
        const auto solid = volumes_of_components(graph, labels, solid_fraction);
        const auto volume = volumes_of_components(graph, labels, std::vector<double>(solid_fraction.size(), 1.0));
        for (std::size_t c = 0; c < solid_fraction.size(); ++c) {
            const auto k = static_cast<std::size_t>(labels[c]);
            const auto wanted = static_cast<long double>(mean) * volume[k] / solid[k];
            solid_fraction[c] = static_cast<double>(static_cast<long double>(solid_fraction[c]) * wanted);
        }
    }
};

/// The wave as full scans over plain lists, in long double: slow and obvious.  Returns the cells left stuck.
inline std::vector<std::size_t> plain_wave(const listed_graph& graph, double threshold, std::vector<long double>& fraction) {
    std::vector<std::vector<std::size_t>> neighbours(fraction.size());
    for (const auto& f : graph.faces) {
        if (f.a == f.b) continue;
        neighbours[static_cast<std::size_t>(f.a)].push_back(static_cast<std::size_t>(f.b));
        neighbours[static_cast<std::size_t>(f.b)].push_back(static_cast<std::size_t>(f.a));
    }
    for (auto& row : neighbours) {
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
    }
    const auto volume = [&](std::size_t c) { return static_cast<long double>(graph.volumes[c]); };
    std::vector<bool> smoothed(fraction.size(), false);
    std::vector<std::size_t> stuck;
    for (bool again = true; again;) {
        again = false;
        std::vector<std::size_t> over;
        for (std::size_t c = 0; c < fraction.size(); ++c) {
            // The wave compares in double: a value that rounds to the threshold is not above it.
            if (!smoothed[c] && static_cast<double>(fraction[c]) > threshold) over.push_back(c);
        }
        for (const std::size_t c : over) smoothed[c] = true;
        for (const std::size_t c : over) {
            long double receivers = 0;
            for (const std::size_t n : neighbours[c]) {
                if (!smoothed[n]) receivers += volume(n);
            }
            if (receivers == 0) {
                stuck.push_back(c);
                continue;
            }
            again = true;
            const long double given = (fraction[c] - static_cast<long double>(threshold)) * volume(c);
            for (const std::size_t n : neighbours[c]) {
                if (!smoothed[n]) fraction[n] += given / receivers;
            }
            fraction[c] = static_cast<long double>(threshold);
        }
    }
    return stuck;
}

}  // namespace hearth::test
