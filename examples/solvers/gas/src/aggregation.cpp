// SPDX-License-Identifier: MIT
#include "aggregation.hpp"

#include <algorithm>
#include <cmath>

namespace hearth::gas {

array<int> aggregate(const sparse& strong, int& groups) {
    const int n = static_cast<int>(strong.rows());
    array<int> group(n, -1);
    groups = 0;
    for (int c = 0; c < n; ++c) {  // cells whose strong neighbours are all free begin a group
        bool free = group[c] < 0;
        for (sparse::InnerIterator i(strong, c); free && i; ++i) free = group[i.col()] < 0;
        if (!free) continue;
        group[c] = groups;
        for (sparse::InnerIterator i(strong, c); i; ++i) group[i.col()] = groups;
        ++groups;
    }
    array<int> joined = group;
    for (int c = 0; c < n; ++c) {  // the rest join the group that they are most strongly coupled to
        double most = 0;
        if (group[c] >= 0) continue;
        for (sparse::InnerIterator i(strong, c); i; ++i)
            if (i.col() != c && group[i.col()] >= 0 && -i.value() > most) {
                most = -i.value();
                joined[c] = group[i.col()];
            }
    }
    for (int c = 0; c < n; ++c) {  // cells that are coupled to none of those
        if (joined[c] >= 0) continue;
        joined[c] = groups;
        for (sparse::InnerIterator i(strong, c); i; ++i)
            if (joined[i.col()] < 0) joined[i.col()] = groups;
        ++groups;
    }
    return joined;
}

sparse strong_part(const sparse& a, double threshold, const array<double>& across, bool by_row) {
    const Eigen::VectorXd d = a.diagonal();
    array<Eigen::Triplet<double, int>> entries;
    entries.reserve(static_cast<int>(a.nonZeros()));
    for (int c = 0; c < a.rows(); ++c) {
        double diagonal = -across[c];
        for (sparse::InnerIterator i(a, c); i; ++i) {
            const double scale = by_row ? d[c] * d[c] : d[c] * d[i.col()];
            const bool keep = i.col() != c && i.value() * i.value() > threshold * threshold * scale;
            if (keep) entries.emplace_back(c, static_cast<int>(i.col()), i.value());
            else diagonal += i.value();
        }
        // lumping weak positive couplings must not empty the row
        entries.emplace_back(c, c, std::max(diagonal, 0.1 * d[c]));
    }
    sparse out(a.rows(), a.cols());
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
}

sparse prolongation(const sparse& strong, const array<int>& group, int groups) {
    const int n = static_cast<int>(strong.rows());
    sparse tentative(n, groups);
    array<Eigen::Triplet<double, int>> entries;
    for (int c = 0; c < n; ++c) entries.emplace_back(c, group[c], 1.0);
    tentative.setFromTriplets(entries.begin(), entries.end());
    sparse smoother = strong;
    double radius = 0;  // Gershgorin bound of D^-1 A
    for (int c = 0; c < n; ++c) {
        double diagonal = 0, sum = 0;
        for (sparse::InnerIterator i(smoother, c); i; ++i) {
            if (i.col() == c) diagonal = i.value();
            sum += std::abs(i.value());
        }
        radius = std::max(radius, sum / diagonal);
        for (sparse::InnerIterator i(smoother, c); i; ++i) i.valueRef() /= diagonal;
    }
    const sparse smoothed = smoother * tentative;
    return tentative - (4.0 / 3.0 / radius) * smoothed;
}

}  // namespace hearth::gas
