// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <Eigen/SparseCholesky>

#include <hearth/gas/linear.hpp>

#include "border.hpp"

namespace hearth::gas {

namespace {

/// Compressed rows in single precision: a preconditioner needs no more, and half the bytes are half the time.
struct rows {
    const int *first = nullptr, *column = nullptr;
    array<float> value;

    rows() = default;
    /// On a pattern that outlives it.
    rows(const array<int>& first_, const array<int>& column_)
        : first(first_.data()), column(column_.data()), value(column_.count()) {}
    explicit rows(const sparse& a)
        : value(static_cast<int>(a.nonZeros())),
          own_first_(a.outerIndexPtr(), a.outerIndexPtr() + a.rows() + 1),
          own_column_(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros()) {
        first = own_first_.data();
        column = own_column_.data();
        for (Eigen::Index i = 0; i < a.nonZeros(); ++i) value[i] = static_cast<float>(a.valuePtr()[i]);
    }
    rows(rows&&) = default;  // moving keeps what the pointers point to
    rows& operator=(rows&&) = default;
    float times(int row, const float* x) const {
        float sum = 0;
        for (int i = first[row]; i < first[row + 1]; ++i) sum += value[i] * x[column[i]];
        return sum;
    }

  private:
    array<int> own_first_, own_column_;
};

struct level {
    rows off;                              // off-diagonal part
    array<float> diagonal;
    rows to_fine;                          // from the next level; its transpose leads there
    array<float> row_sum;                  // of the whole row, on coarse levels
    array<float> x, b, kept, outside;      // outside: what other ranks add to b, on coarse levels

    /// A row times x but for other ranks, in differences: a large constant in x, as nearly singular matrices make it, leaves no round-off.
    float times(int row, const array<float>& y) const {
        float sum = row_sum[row] * y[row];
        for (int i = off.first[row]; i < off.first[row + 1]; ++i) sum += off.value[i] * (y[off.column[i]] - y[row]);
        return sum;
    }
};

class multigrid final : public preconditioner {
  public:
    multigrid(const pattern& p, const parallel& ranks) : shape_(&p), ranks_(&ranks), border_(p, ranks) {
        fine_.off = rows(p.first, p.column);
        fine_.diagonal.resize(p.rows);
    }

    void rebuild() override { built_ = false; }

    void update(const matrix& a) override {
        const pattern& p = *shape_;
        for (std::size_t i = 0; i < a.entry.size(); ++i) fine_.off.value[i] = static_cast<float>(a.entry[i]);
        for (int c = 0; c < p.rows; ++c) fine_.diagonal[c] = static_cast<float>(a.diagonal[c]);
        if (!built_) build(a);
        built_ = true;
    }

    void apply(const double* residual, double* correction) override {
        const int n = shape_->rows;
        // scaled to order one, so that no field is too small or large for single precision
        double scale = 0;
        for (int i = 0; i < n; ++i) scale = std::max(scale, std::abs(residual[i]));
        scale = ranks_->max(scale);
        if (!(scale > 0) || !std::isfinite(scale)) {
            std::fill_n(correction, n, 0.0);
            return;
        }
        for (int i = 0; i < n; ++i) fine_.b[i] = static_cast<float>(residual[i] / scale * unit_);
        cycle(0);
        for (int i = 0; i < n; ++i) correction[i] = static_cast<double>(fine_.x[i]) * (scale / unit_);
    }

  private:
    level& at(std::size_t l) { return l == 0 ? fine_ : coarse_[l - 1]; }

    void build(const matrix& a) {
        const pattern& p = *shape_;
        unit_ = 0;
        for (const double d : a.diagonal) unit_ = std::max(unit_, d);
        unit_ = ranks_->max(unit_);
        coarse_.clear();
        sparse current(p.rows, p.rows);
        array<Eigen::Triplet<double, int>> entries;
        entries.reserve(p.column.count() + p.rows);
        for (int c = 0; c < p.rows; ++c) {
            entries.emplace_back(c, c, a.diagonal[c]);
            for (int i = p.first[c]; i < p.first[c + 1]; ++i)
                if (p.column[i] < p.rows) entries.emplace_back(c, p.column[i], a.entry[i]);
        }
        current.setFromTriplets(entries.begin(), entries.end());
        entries = {};
        double threshold = 0.08;
        const bool alone = border_.empty();
        if (!alone) border_.begin(a);
        // all ranks have as many levels, and together few rows on the last
        while (ranks_->max(static_cast<double>(current.rows())) > std::max(400 / ranks_->ranks(), 40)) {
            array<double> across = alone ? array<double>() : border_.row_sum(true);
            across.resize(static_cast<int>(current.rows()));
            int groups = 0;  // of cells that hang on each other; smoothed towards all that a cell hangs on
            const array<int> group = aggregate(strong_part(current, threshold, across, false), groups);
            if (ranks_->max(-groups / static_cast<double>(current.rows())) < -0.8) break;  // nothing left to gain
            const sparse to_fine = prolongation(strong_part(current, threshold, across, true), group, groups);
            const sparse product = current * to_fine;
            current = sparse(to_fine.transpose()) * product;
            level& finer = at(coarse_.size());
            finer.to_fine = rows(to_fine);
            level next;
            next.diagonal.resize(groups);
            for (int c = 0; c < groups; ++c) next.diagonal[c] = static_cast<float>(current.coeff(c, c));
            Eigen::VectorXd sums = current * Eigen::VectorXd::Ones(groups);
            if (!alone) {
                border_.add_level(to_fine);
                const array<double> more = border_.row_sum(false);
                for (int c = 0; c < more.count(); ++c) sums[c] += more[c];
                next.outside.resize(groups);
            }
            for (int c = 0; c < groups; ++c) next.row_sum.push_back(static_cast<float>(sums[c]));
            sparse off = current;
            off.prune([](Eigen::Index row, Eigen::Index column, double) { return row != column; });
            next.off = rows(off);
            coarse_.push_back(std::move(next));
            threshold *= 0.5;
        }
        for (std::size_t l = 0; l <= coarse_.size(); ++l)
            for (auto* v : {&at(l).x, &at(l).b}) v->assign(at(l).diagonal.count(), 0.0F);
        fine_.x.resize(p.columns);
        const sparse whole = border_.gathered(current, first_row_);
        direct_ok_ = whole.rows() <= 20000;
        if (direct_ok_) direct_.compute(Eigen::SparseMatrix<double>(whole));
        direct_ok_ = direct_ok_ && direct_.info() == Eigen::Success;
        right_.resize(whole.rows());
    }

    /// W-cycle: each coarse level is visited twice, so that the iterations do not grow with the number of levels.
    void cycle(std::size_t l) {
        level& v = at(l);
        const int n = static_cast<int>(v.diagonal.size());
        if (l == coarse_.size() && direct_ok_) {
            right_.setZero();
            for (int i = 0; i < n; ++i) right_[first_row_ + i] = static_cast<double>(v.b[i]);
            ranks_->sum(right_.data(), static_cast<int>(right_.size()));
            const Eigen::VectorXd solution = direct_.solve(right_);
            for (int i = 0; i < n; ++i) v.x[i] = static_cast<float>(solution[first_row_ + i]);
            return;
        }
        for (int c = 0; c < n; ++c) {  // forward sweep from zero: columns above c are still zero
            float sum = v.b[c];
            for (int i = v.off.first[c]; i < v.off.first[c + 1] && v.off.column[i] < c; ++i)
                sum -= v.off.value[i] * v.x[v.off.column[i]];
            v.x[c] = sum / v.diagonal[c];
        }
        const auto outside = [&v](int c) { return v.outside.empty() ? 0.0F : v.outside[c]; };
        hear(l, v.x, false);
        if (l < coarse_.size()) {
            level& next = at(l + 1);
            std::fill(next.b.begin(), next.b.end(), 0.0F);
            for (int c = 0; c < n; ++c) {
                float rest = outside(c);  // the sweep left of each row what is above its diagonal
                for (int i = v.off.first[c + 1]; i-- > v.off.first[c] && v.off.column[i] > c;)
                    rest -= v.off.value[i] * v.x[v.off.column[i]];
                for (int i = v.to_fine.first[c]; i < v.to_fine.first[c + 1]; ++i)
                    next.b[v.to_fine.column[i]] += v.to_fine.value[i] * rest;
            }
            cycle(l + 1);
            if (l + 1 < coarse_.size()) {  // once more for what is left
                const int m = next.diagonal.count();
                next.kept = next.x;
                for (int c = 0; c < m; ++c) next.b[c] -= next.times(c, next.kept);
                hear(l + 1, next.kept, true);
                for (int c = 0; c < next.outside.count(); ++c) next.b[c] += next.outside[c];
                cycle(l + 1);
                for (int c = 0; c < m; ++c) next.x[c] += next.kept[c];
            }
            for (int c = 0; c < n; ++c) v.x[c] += v.to_fine.times(c, next.x.data());
            hear(l, v.x, false);
        }
        for (int c = n - 1; c >= 0; --c) v.x[c] = (v.b[c] + outside(c) - v.off.times(c, v.x.data())) / v.diagonal[c];
    }

    /// Takes in what other ranks hold: ghosts on the finest level, on the others what they add to the right-hand side.
    void hear(std::size_t l, array<float>& x, bool difference) {
        if (border_.empty()) return;
        if (l == 0) return border_.gather(x.data());
        array<float>& out = at(l).outside;
        std::fill(out.begin(), out.end(), 0.0F);
        border_.bring(l, x.data(), out.data(), difference);
    }

    const pattern* shape_;
    const parallel* ranks_;
    border border_;
    level fine_;
    array<level> coarse_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> direct_;
    Eigen::VectorXd right_;
    double unit_ = 1;
    int first_row_ = 0;
    bool built_ = false, direct_ok_ = false;
};

}  // namespace

std::unique_ptr<preconditioner> make_multigrid(const pattern& p, const parallel& ranks) {
    return std::make_unique<multigrid>(p, ranks);
}

std::unique_ptr<preconditioner> parallel::make_preconditioner(const pattern& p) const { return make_multigrid(p, *this); }

}  // namespace hearth::gas
