// SPDX-License-Identifier: MIT
#include "border.hpp"

#include <algorithm>

namespace hearth::gas {

border::border(const pattern& p, const parallel& ranks) : ranks_(&ranks), shape_(&p) {
    if (ranks.ranks() == 1) return;
    halo_.assign(p.columns, 0.0);
    for (int c = 0; c < p.rows; ++c) {
        for (int i = p.first[c]; i < p.first[c + 1]; ++i)
            if (p.column[i] >= p.rows) ghost_.push_back(p.column[i]);
        if (ghost_.count() == first_.back()) continue;
        cells_.push_back(c);
        first_.push_back(ghost_.count());
    }
    strength_.resize(ghost_.count());
}

void border::begin(const matrix& a) {
    const pattern& p = *shape_;
    levels_.clear();
    ones_.clear();
    rows identity;
    for (int i = 0, j = 0; i < cells_.count(); ++i) {
        for (int k = p.first[cells_[i]]; k < p.first[cells_[i] + 1]; ++k)
            if (p.column[k] >= p.rows) strength_[j++] = -a.entry[k];
        identity.column.push_back(cells_[i]);
        identity.value.push_back(1);
        identity.first.push_back(i + 1);
    }
    levels_.push_back(std::move(identity));
    ones_.emplace_back(cells_.count());
    for (int i = 0; i < cells_.count(); ++i)
        for (int j = first_[i]; j < first_[i + 1]; ++j) ones_[0][i] += strength_[j];
}

void border::add_level(const sparse& to_fine) {
    const rows& last = levels_.back();
    rows next;
    array<double> sums(static_cast<int>(to_fine.cols()), 0.0);  // of one row, emptied after each
    for (int i = 0; i < cells_.count(); ++i) {
        const int begin = next.column.count();
        for (int k = last.first[i]; k < last.first[i + 1]; ++k)
            for (sparse::InnerIterator j(to_fine, last.column[k]); j; ++j) {
                const int column = static_cast<int>(j.col());
                if (std::find(next.column.begin() + begin, next.column.end(), column) == next.column.end())
                    next.column.push_back(column);
                sums[column] += last.value[k] * j.value();
            }
        for (int k = begin; k < next.column.count(); ++k) {
            next.value.push_back(sums[next.column[k]]);
            sums[next.column[k]] = 0;
        }
        next.first.push_back(next.column.count());
    }
    levels_.push_back(std::move(next));
    const array<float> one(static_cast<int>(to_fine.cols()), 1.0F);
    fill(levels_.back(), one.data());
    ones_.emplace_back(cells_.count());
    for (int i = 0; i < cells_.count(); ++i) ones_.back()[i] = sum(i);
}

array<double> border::row_sum(bool inner) const {
    const rows& last = levels_.back();
    int most = -1;
    for (const int column : last.column) most = std::max(most, column);
    array<double> out(most + 1, 0.0);
    for (int i = 0; i < cells_.count(); ++i) {
        double mine = 0, strength = 0;
        for (int k = last.first[i]; k < last.first[i + 1]; ++k) mine += last.value[k];
        for (int j = first_[i]; j < first_[i + 1]; ++j) strength += strength_[j];
        for (int k = last.first[i]; k < last.first[i + 1]; ++k)
            out[last.column[k]] += last.value[k] * (inner ? strength * mine : -ones_.back()[i]);
    }
    return out;
}

double border::sum(int i) const {
    double all = 0;
    for (int j = first_[i]; j < first_[i + 1]; ++j) all += strength_[j] * halo_[ghost_[j]];
    return all;
}

void border::fill(const rows& to_fine, const float* x) const {
    for (int i = 0; i < cells_.count(); ++i) {
        double value = 0;
        for (int k = to_fine.first[i]; k < to_fine.first[i + 1]; ++k)
            value += to_fine.value[k] * static_cast<double>(x[to_fine.column[k]]);
        halo_[cells_[i]] = value;
    }
    ranks_->gather(halo_.data(), 1);
}

void border::gather(float* x) const {
    fill(levels_.front(), x);
    for (const int g : ghost_) x[g] = static_cast<float>(halo_[g]);
}

void border::bring(std::size_t level, const float* x, float* out, bool difference) const {
    const rows& to_fine = levels_[level];
    fill(to_fine, x);
    for (int i = 0; i < cells_.count(); ++i) {
        const double brought = sum(i), here = difference ? ones_[level][i] : 0;
        for (int k = to_fine.first[i]; k < to_fine.first[i + 1]; ++k) {
            const int c = to_fine.column[k];
            out[c] += static_cast<float>(to_fine.value[k] * (brought - here * static_cast<double>(x[c])));
        }
    }
}

sparse border::gathered(const sparse& own, int& first_row) const {
    first_row = 0;
    if (empty()) return own;
    const int n = static_cast<int>(own.rows()), ranks = ranks_->ranks();
    array<double> sizes(ranks, 0.0);
    sizes[ranks_->rank()] = n;
    ranks_->sum(sizes.data(), ranks);
    int total = 0;
    for (int r = 0; r < ranks; ++r) {
        if (r == ranks_->rank()) first_row = total;
        total += static_cast<int>(sizes[r]);
    }
    const auto n_total = static_cast<Eigen::Index>(total);
    array<Eigen::Triplet<double, int>> entries;
    for (int c = 0; c < n; ++c)
        for (sparse::InnerIterator i(own, c); i; ++i)
            entries.emplace_back(first_row + c, first_row + static_cast<int>(i.col()), i.value());
    // The rows of the ghosts' prolongations come one entry at a time: column, then value.
    const rows& mine = levels_.back();
    int widest = 0;
    for (int i = 0; i < cells_.count(); ++i) widest = std::max(widest, mine.first[i + 1] - mine.first[i]);
    widest = static_cast<int>(ranks_->max(widest));
    array<double> passed(2 * shape_->columns);
    for (int w = 0; w < widest; ++w) {
        for (int i = 0; i < cells_.count(); ++i) {
            const int k = mine.first[i] + w;
            const bool there = k < mine.first[i + 1];
            passed[2 * cells_[i]] = there ? first_row + mine.column[k] : 0;
            passed[2 * cells_[i] + 1] = there ? mine.value[k] : 0;
        }
        ranks_->gather(passed.data(), 2);
        for (int i = 0; i < cells_.count(); ++i)
            for (int j = first_[i]; j < first_[i + 1]; ++j)
                for (int k = mine.first[i]; k < mine.first[i + 1]; ++k)
                    entries.emplace_back(first_row + mine.column[k], static_cast<int>(passed[2 * ghost_[j]]),
                                         -strength_[j] * mine.value[k] * passed[2 * ghost_[j] + 1]);
    }
    sparse rows_here(n_total, n_total);
    rows_here.setFromTriplets(entries.begin(), entries.end());
    // every rank's entries in a place of their own
    std::fill(sizes.begin(), sizes.end(), 0.0);
    sizes[ranks_->rank()] = static_cast<double>(rows_here.nonZeros());
    ranks_->sum(sizes.data(), ranks);
    int before = 0, all = 0;
    for (int r = 0; r < ranks; ++r) {
        if (r < ranks_->rank()) before += static_cast<int>(sizes[r]);
        all += static_cast<int>(sizes[r]);
    }
    array<double> lists(3 * all, 0.0);
    for (int c = 0, at = 3 * before; c < total; ++c)
        for (sparse::InnerIterator i(rows_here, c); i; ++i) {
            lists[at++] = c;
            lists[at++] = static_cast<double>(i.col());
            lists[at++] = i.value();
        }
    ranks_->sum(lists.data(), lists.count());
    entries.clear();
    for (int i = 0; i < all; ++i)
        entries.emplace_back(static_cast<int>(lists[3 * i]), static_cast<int>(lists[3 * i + 1]), lists[3 * i + 2]);
    sparse whole(n_total, n_total);
    whole.setFromTriplets(entries.begin(), entries.end());
    return whole;
}

}  // namespace hearth::gas
