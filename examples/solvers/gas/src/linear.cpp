// SPDX-License-Identifier: MIT
#include <hearth/gas/linear.hpp>

#include <algorithm>
#include <cmath>

namespace hearth::gas {

pattern::pattern(const mesh& m) : rows(m.owned_cells()), columns(m.cells()), first(m.owned_cells() + 1, 0) {
    const int internal = m.internal_faces();
    owner_entry.assign(internal, -1);
    neighbour_entry.assign(internal, -1);
    for (int f = 0; f < internal; ++f) {
        ++first[m.owner[f] + 1];
        if (m.neighbour[f] < rows) ++first[m.neighbour[f] + 1];
    }
    for (int c = 0; c < rows; ++c) first[c + 1] += first[c];
    struct slot { int column, face; };
    array<slot> slots(first[rows]);
    array<int> next(first.begin(), first.end() - 1);
    for (int f = 0; f < internal; ++f) {
        slots[next[m.owner[f]]++] = {m.neighbour[f], f};
        if (m.neighbour[f] < rows) slots[next[m.neighbour[f]]++] = {m.owner[f], f};
    }
    column.resize(slots.count());
    for (int c = 0; c < rows; ++c) {
        std::sort(slots.begin() + first[c], slots.begin() + first[c + 1],
                  [](const slot& a, const slot& b) { return a.column != b.column ? a.column < b.column : a.face < b.face; });
        for (int i = first[c]; i < first[c + 1]; ++i) {
            column[i] = slots[i].column;
            (m.owner[slots[i].face] == c ? owner_entry : neighbour_entry)[slots[i].face] = i;
        }
    }
}

void matrix::clear() {
    std::fill(diagonal.begin(), diagonal.end(), 0.0);
    std::fill(entry.begin(), entry.end(), 0.0);
}

void matrix::apply(const double* x, double* y) const {
    for (int c = 0; c < shape->rows; ++c) {
        double sum = diagonal[c] * x[c];
        for (int i = shape->first[c]; i < shape->first[c + 1]; ++i) sum += entry[i] * x[shape->column[i]];
        y[c] = sum;
    }
}

solve_report& solve_report::operator+=(const solve_report& other) {
    iterations += other.iterations;
    first = std::max(first, other.first);
    last = std::max(last, other.last);
    converged = converged && other.converged;
    return *this;
}

template <int Width>
void gauss_seidel(const matrix& a, const double* b, double* x, bool backward) {
    const pattern& p = *a.shape;
    for (int n = 0; n < p.rows; ++n) {
        const int c = backward ? p.rows - 1 - n : n;
        double sum[Width];
        for (int k = 0; k < Width; ++k) sum[k] = b[Width * c + k];
        for (int i = p.first[c]; i < p.first[c + 1]; ++i) {
            const double* other = x + Width * p.column[i];
            for (int k = 0; k < Width; ++k) sum[k] -= a.entry[i] * other[k];
        }
        for (int k = 0; k < Width; ++k) x[Width * c + k] = sum[k] / a.diagonal[c];
    }
}
template void gauss_seidel<1>(const matrix&, const double*, double*, bool);
template void gauss_seidel<3>(const matrix&, const double*, double*, bool);

namespace {

double dot(const parallel& ranks, int n, const double* a, const double* b) {
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += a[i] * b[i];
    return ranks.sum(sum);
}

/// r holds A x and becomes b - A x.  Sets the first residual; returns where to stop, never below the round-off of r.
double begin(const parallel& ranks, int n, const double* b, double* r, const solve_settings& settings,
             solve_report& report) {
    double sums[3] = {0, 0, 0};
    for (int i = 0; i < n; ++i) {
        sums[0] += b[i] * b[i];
        sums[1] += r[i] * r[i];
        r[i] = b[i] - r[i];
        sums[2] += r[i] * r[i];
    }
    ranks.sum(sums, 3);
    report.first = report.last = std::sqrt(sums[2]);
    const double round_off = 2e-16 * (std::sqrt(sums[0]) + std::sqrt(sums[1]));
    return std::max({settings.absolute, settings.relative * report.first, round_off});
}

}  // namespace

symmetric_solver::symmetric_solver(std::unique_ptr<preconditioner> m, const parallel& ranks, workspace& work)
    : preconditioner_(std::move(m)), ranks_(&ranks), work_(&work) {}

solve_report symmetric_solver::solve(const matrix& a, const double* b, double* x, const solve_settings& settings) {
    if (fresh_rate_ == 0) preconditioner_->rebuild();
    preconditioner_->update(a);
    solve_settings patient = settings;
    if (fresh_rate_ > 0)  // time enough to see that the kept hierarchy does not fit any more
        patient.max_iterations = std::min(settings.max_iterations, 60);
    solve_report report = iterate(a, b, x, patient);
    if (report.iterations == 0 || !(report.first > 0)) return report;
    double rate = std::log(report.first / std::max(report.last, 1e-300)) / report.iterations;
    const bool stale = fresh_rate_ > 0 && (rate < fresh_rate_ / 1.5 || !report.converged);
    if (!(fresh_rate_ > 0)) {
        fresh_rate_ = std::max(rate, 1e-6);
    } else if (stale && !report.converged) {
        preconditioner_->rebuild();
        preconditioner_->update(a);
        solve_report again = iterate(a, b, x, settings);
        fresh_rate_ = std::max(1e-6, std::log(again.first / std::max(again.last, 1e-300)) / std::max(1, again.iterations));
        again.iterations += report.iterations;
        again.first = report.first;
        return again;
    } else if (stale) {
        fresh_rate_ = 0;  // rebuild before the next solve
    }
    return report;
}

solve_report symmetric_solver::iterate(const matrix& a, const double* b, double* x, const solve_settings& settings) {
    const int n = a.shape->rows;
    double *const r = workspace::part(work_->first, 0), *const z = workspace::part(work_->first, 1),
           *const p = workspace::part(work_->first, 2), *const q = work_->scalar.data();
    solve_report report;
    ranks_->gather(x, 1);
    a.apply(x, r);
    const double target = begin(*ranks_, n, b, r, settings, report);
    double rho = 0;
    while (!(report.converged = report.last <= target) && std::isfinite(report.last) &&
           report.iterations < settings.max_iterations) {
        preconditioner_->apply(r, z);
        const double rho_new = dot(*ranks_, n, r, z);
        const double beta = rho_new / rho;
        rho = rho_new;
        if (report.iterations == 0) std::copy_n(z, n, p);
        else for (int i = 0; i < n; ++i) p[i] = z[i] + beta * p[i];
        ranks_->gather(p, 1);
        a.apply(p, q);
        const double curvature = dot(*ranks_, n, p, q);
        if (!(curvature > 0) || !std::isfinite(rho)) break;  // not positive definite, or overflow: x stays finite
        const double step = rho / curvature;
        double rest = 0;
        for (int i = 0; i < n; ++i) {
            x[i] += step * p[i];
            r[i] -= step * q[i];
            rest += r[i] * r[i];
        }
        report.last = std::sqrt(ranks_->sum(rest));
        ++report.iterations;
    }
    ranks_->gather(x, 1);
    return report;
}

general_solver::general_solver(const parallel& ranks, workspace& work) : ranks_(&ranks), work_(&work) {}

solve_report general_solver::solve(const matrix& a, const double* b, double* x, const solve_settings& settings) {
    const int n = a.shape->rows;
    double *const r = workspace::part(work_->first, 0), *const start = workspace::part(work_->first, 1),
           *const p = workspace::part(work_->first, 2), *const v = workspace::part(work_->second, 0),
           *const t = workspace::part(work_->second, 1), *const best_x = workspace::part(work_->second, 2),
           *const y = work_->scalar.data();
    const auto precondition = [&](const double* from, double* to) {
        std::fill_n(y, a.shape->columns, 0.0);  // ghosts count as zero: each rank smooths its own block
        gauss_seidel<1>(a, from, y, false);
        gauss_seidel<1>(a, from, y, true);
        ranks_->gather(y, 1);
        a.apply(y, to);
    };
    ranks_->gather(x, 1);
    a.apply(x, r);
    solve_report report;
    const double target = begin(*ranks_, n, b, r, settings, report);
    double best = report.last, rho = 1, alpha = 1, omega = 1;
    std::copy_n(x, n, best_x);
    bool restart = true;
    int breakdowns = 0;
    while (!(report.converged = report.last <= target) && std::isfinite(report.last) &&
           report.iterations < settings.max_iterations) {
        if (restart) {
            std::copy_n(r, n, start);
            rho = alpha = omega = 1;
            std::fill_n(p, n, 0.0);
            std::fill_n(v, n, 0.0);
            restart = false;
        }
        const double rho_new = dot(*ranks_, n, start, r);
        const double beta = rho_new / rho * (alpha / omega);
        rho = rho_new;
        for (int i = 0; i < n; ++i) p[i] = r[i] + beta * (p[i] - omega * v[i]);
        precondition(p, v);
        const double projection = dot(*ranks_, n, start, v);
        ++report.iterations;
        if (!(std::abs(projection) > 1e-300) || !std::isfinite(beta)) {
            if (++breakdowns > 3) break;
            std::copy_n(best_x, n, x);
            ranks_->gather(x, 1);
            a.apply(x, r);
            for (int i = 0; i < n; ++i) r[i] = b[i] - r[i];
            report.last = best;
            restart = true;
            continue;
        }
        alpha = rho / projection;
        for (int i = 0; i < n; ++i) {
            x[i] += alpha * y[i];
            r[i] -= alpha * v[i];
        }
        precondition(r, t);
        const double tt = dot(*ranks_, n, t, t);
        omega = tt > 0 ? dot(*ranks_, n, t, r) / tt : 0;
        double rest = 0;
        for (int i = 0; i < n; ++i) {
            x[i] += omega * y[i];
            r[i] -= omega * t[i];
            rest += r[i] * r[i];
        }
        report.last = std::sqrt(ranks_->sum(rest));
        if (report.last < best) {
            best = report.last;
            std::copy_n(x, n, best_x);
        }
        restart = !(std::abs(omega) > 0);
    }
    if (!report.converged && !(report.last <= best)) {
        std::copy_n(best_x, n, x);
        report.last = best;
    }
    ranks_->gather(x, 1);
    return report;
}

}  // namespace hearth::gas
