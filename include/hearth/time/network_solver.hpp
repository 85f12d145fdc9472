// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <hearth/core/particle_halo.hpp>
#include <hearth/core/thermal_link.hpp>
#include <hearth/time/network_islands.hpp>

namespace hearth {

/// The pair that holds every kind of link.
using thermal_pair = linked_pair<thermal_link<double>>;

namespace detail {

/// diagonal_i x_i + sum_j link_ij (x_i - x_j) = right_i, over the pairs of a list.
///
/// Each pair stands once, in the row of its lower particle, so that a sweep over the rows is half of a Gauss-Seidel
/// step.  Conjugate gradients are preconditioned by symmetric successive over-relaxation in the form of Eisenstat
/// (SIAM J. Sci. Stat. Comput. 2 (1981) 1), whose two sweeps are the product with the matrix as well: an iteration
/// visits each pair twice, as the plain product does for both its ends, and a third of the iterations of a diagonal
/// preconditioner remains.  It reads fastest where particles near each other have near indices.  Between ranks the
/// preconditioner lets go; the matrix does not.
class network_system {
  public:
    std::vector<double> diagonal;  ///< without the links; > 0 [W/K]
    std::vector<double> right;     ///< [W]

    struct outcome {
        int iterations = 0;
        double error = 0.0;  ///< no temperature is farther from the solution than this [K]
        bool converged = true;
    };

    /// Sorts pairs into rows.  Every index is in range.
    template <class Pair>
    void arrange(const std::vector<Pair>& pairs, std::size_t owned, std::size_t ghosts) {
        owned_ = owned;
        begin_.assign(owned + 1, 0);
        for_each_run(pairs, [&](std::size_t i, std::size_t from, std::size_t to) { begin_[i + 1] += to - from; });
        for (std::size_t i = 0; i < owned; ++i) begin_[i + 1] += begin_[i];
        next_.assign(begin_.begin(), begin_.end());
        source_.resize(pairs.size());
        other_.resize(pairs.size());
        link_.resize(pairs.size());
        across_.clear();
        for_each_run(pairs, [&](std::size_t i, std::size_t from, std::size_t to) {
            for (std::size_t k = from, at = next_[i]; k < to; ++k, ++at) {
                source_[at] = k;
                other_[at] = std::max(pairs[k].first, pairs[k].second);
                if (static_cast<std::size_t>(other_[at]) >= owned) across_.push_back({i, at});
            }
            next_[i] += to - from;
        });
        for (std::vector<double>* field : {&whole_, &residual_, &upper_, &pending_}) field->resize(owned + ghosts);
        for (std::vector<double>* field : {&pivot_, &inverse_, &gradient_, &direction_, &product_})
            field->resize(owned);
    }

    /// Takes the links at temperatures [K] of particles and ghosts.
    template <class Pair>
    void freeze(const std::vector<Pair>& pairs, const std::vector<double>& temperature) {
        std::fill(whole_.begin(), whole_.end(), 0.0);
        double *const links = link_.data(), *const whole = whole_.data();
        for (std::size_t i = 0; i < owned_; ++i) {
            double sum = 0.0;
            for (std::size_t k = begin_[i], end = begin_[i + 1]; k < end; ++k) {
                const auto j = static_cast<std::size_t>(other_[k]);
                const double link = pairs[source_[k]].link.secant(temperature[i], temperature[j]);
                links[k] = link;
                sum += link;
                whole[j] += link;
            }
            whole[i] += sum;
        }
    }

    void join(islands& parts) const {
        for (std::size_t i = 0; i < owned_; ++i)
            for (std::size_t k = begin_[i]; k < begin_[i + 1]; ++k) parts.join(static_cast<std::int32_t>(i), other_[k]);
    }

    /// Improves x, in which the ghosts' places are the solver's own, until no value is farther than `allowed` from the
    /// solution, by the maximum principle (largest residual over diagonal), or until round-off ends it.  With rough > 0
    /// it ends where the residual has fallen as it must for that error, a hundredfold at least, and looks no further.
    template <class Communicator>
    outcome solve(const particle_halo<Communicator>& halo, islands& parts, double allowed, double rough, int limit,
                  std::vector<double>& x) {
        const Communicator& ranks = halo.communicator();
        const double relaxation = prepare(ranks);
        double scale = 0.0;
        for (std::size_t i = 0; i < owned_; ++i) scale += right[i] * right[i] * inverse_[i];
        const double floor = 1e-28 * sum_over_ranks(ranks, scale);

        balance(halo, parts, x);
        outcome result;
        result.error = refresh(halo, x);
        bool ended = false, in_full = false;
        while (result.error > allowed && !ended && result.iterations < limit) {
            double rho = sum_over_ranks(ranks, start());
            // The residual is to fall as the error has to, but not farther than its recurrence can be trusted.
            const double full = 1e-12, aim = rough > 0.0 ? std::min(rough, 0.05 * result.error) : allowed;
            const double wanted = std::max(0.2 * aim / result.error, full);
            const double fall = in_full ? full : wanted;
            const double target = std::max(rho * fall * fall, floor);
            ended = target <= floor;
            while (rho > target && result.iterations < limit) {
                const double curvature = sum_over_ranks(ranks, multiply(halo, relaxation));
                if (!(curvature > 0.0)) break;
                const double before = rho;
                rho = sum_over_ranks(ranks, descend(before / curvature, x));
                const double beta = rho / before;
                for (std::size_t i = 0; i < owned_; ++i)
                    direction_[i] = gradient_[i] * pivot_[i] + beta * direction_[i];
                ++result.iterations;
            }
            balance(halo, parts, x);
            if (rough > 0.0) break;
            const double before = result.error;
            result.error = refresh(halo, x);
            // Where all that the recurrence can give does not help, round-off has the last word.
            if (!(result.error < 0.5 * before)) ended = ended || fall <= full, in_full = true;
        }
        result.converged = result.error <= allowed || (result.iterations < limit && std::isfinite(result.error));
        return result;
    }

  private:
    /// visit(row, from, to) for pairs that stand one after the other and belong to one row, that of the lower particle:
    /// ghosts stand behind all owned ones and hold none.
    template <class Pair, class Visit>
    static void for_each_run(const std::vector<Pair>& pairs, Visit&& visit) {
        const auto row = [&](std::size_t k) { return std::min(pairs[k].first, pairs[k].second); };
        for (std::size_t from = 0, to = 0; from < pairs.size(); from = to) {
            const std::int32_t i = row(from);
            while (to < pairs.size() && row(to) == i) ++to;
            visit(static_cast<std::size_t>(i), from, to);
        }
    }

    /// Diagonal with the links, over the factor of relaxation, which is returned: Young's for what the links take of
    /// the diagonal on the mean; more than 1.6 does not pay where each particle has many neighbours.
    template <class Communicator>
    double prepare(const Communicator& ranks) {
        double links = 0.0, whole = 0.0;
        for (std::size_t i = 0; i < owned_; ++i) {
            links += whole_[i];
            whole += whole_[i] + diagonal[i];
        }
        const double share = sum_over_ranks(ranks, links) / sum_over_ranks(ranks, whole);
        const double relaxation = std::fmin(1.6, 2.0 / (1.0 + std::sqrt(std::fmax(0.0, 1.0 - share * share))));
        for (std::size_t i = 0; i < owned_; ++i) {
            pivot_[i] = (whole_[i] + diagonal[i]) / relaxation;
            inverse_[i] = 1.0 / pivot_[i];
        }
        return relaxation;
    }

    /// Residual of x; returns the bound of its error.
    template <class Communicator>
    double refresh(const particle_halo<Communicator>& halo, std::vector<double>& x) {
        halo.gather(x);
        for (std::size_t i = 0; i < owned_; ++i) residual_[i] = right[i] - diagonal[i] * x[i];
        const double *const links = link_.data(), *const known = x.data();
        double* const rest = residual_.data();
        for (std::size_t i = 0; i < owned_; ++i) {
            double sum = 0.0;
            for (std::size_t k = begin_[i], end = begin_[i + 1]; k < end; ++k) {
                const std::int32_t j = other_[k];
                const double flow = links[k] * (known[i] - known[j]);
                sum += flow;
                rest[j] += flow;
            }
            rest[i] -= sum;
        }
        double largest = 0.0;
        for (std::size_t i = 0; i < owned_; ++i) largest = std::max(largest, std::fabs(residual_[i]) / diagonal[i]);
        return halo.communicator().max(largest);
    }

    /// First direction from the residual; returns the square of the gradient.
    double start() {
        forward(residual_.data(), gradient_.data());
        double square = 0.0;
        for (std::size_t i = 0; i < owned_; ++i) {
            direction_[i] = gradient_[i] * pivot_[i];
            square += gradient_[i] * direction_[i];
        }
        return square;
    }

    /// Solves the lower triangle: left is used up.
    void forward(double* left, double* solution) const {
        const double* const links = link_.data();
        const std::int32_t* const other = other_.data();
        for (std::size_t i = 0; i < owned_; ++i) {
            const double here = left[i] * inverse_[i];
            solution[i] = here;
            std::size_t k = begin_[i];
            // Written out by four, or compilers that do not unroll wait for the counter.
            for (const std::size_t end = begin_[i + 1]; k + 4 <= end; k += 4) {
                left[other[k]] += links[k] * here;
                left[other[k + 1]] += links[k + 1] * here;
                left[other[k + 2]] += links[k + 2] * here;
                left[other[k + 3]] += links[k + 3] * here;
            }
            for (; k < begin_[i + 1]; ++k) left[other[k]] += links[k] * here;
        }
    }

    /// Solves the upper triangle.
    void backward(const double* right_side, double* solution) const {
        const double* const links = link_.data();
        const std::int32_t* const other = other_.data();
        for (std::size_t i = owned_; i-- > 0;) {
            // Four sums, and the nearest rows last: the processor need not wait for the row before.
            double a = right_side[i], b = 0.0, c = 0.0, d = 0.0;
            std::size_t k = begin_[i + 1];
            for (const std::size_t begin = begin_[i]; k >= begin + 4; k -= 4) {
                a += links[k - 1] * solution[other[k - 1]];
                b += links[k - 2] * solution[other[k - 2]];
                c += links[k - 3] * solution[other[k - 3]];
                d += links[k - 4] * solution[other[k - 4]];
            }
            for (; k > begin_[i]; --k) a += links[k - 1] * solution[other[k - 1]];
            solution[i] = ((a + b) + (c + d)) * inverse_[i];
        }
    }

    /// Product of the matrix, between its two triangles, with the direction; returns that with the direction again.
    template <class Communicator>
    double multiply(const particle_halo<Communicator>& halo, double relaxation) {
        std::fill(upper_.begin() + static_cast<std::ptrdiff_t>(owned_), upper_.end(), 0.0);
        backward(direction_.data(), upper_.data());
        halo.gather(upper_);
        for (std::size_t i = 0; i < owned_; ++i)
            pending_[i] = direction_[i] + (relaxation - 2.0) * pivot_[i] * upper_[i];
        for (const entry& pair : across_)
            pending_[pair.row] -= link_[pair.at] * upper_[static_cast<std::size_t>(other_[pair.at])];
        forward(pending_.data(), product_.data());
        double curvature = 0.0;
        for (std::size_t i = 0; i < owned_; ++i) {
            product_[i] += upper_[i];
            curvature += direction_[i] * product_[i];
        }
        return curvature;
    }

    double descend(double length, std::vector<double>& x) {
        double square = 0.0;
        for (std::size_t i = 0; i < owned_; ++i) {
            x[i] += length * upper_[i];
            gradient_[i] -= length * product_[i];
            square += gradient_[i] * gradient_[i] * pivot_[i];
        }
        return square;
    }

    /// Shifts each island so that its energy balance, in which the links cancel, closes.
    template <class Communicator>
    void balance(const particle_halo<Communicator>& halo, islands& parts, std::vector<double>& x) {
        parts.means(
            halo, diagonal, [&](std::size_t i) { return right[i] - diagonal[i] * x[i]; }, shift_);
        for (std::size_t i = 0; i < owned_; ++i) x[i] += shift_[parts.of(i)];
    }

    struct entry {
        std::size_t row, at;
    };
    std::size_t owned_ = 0;
    std::vector<std::size_t> begin_, next_, source_;  // source: place of a row's pair in the list
    std::vector<std::int32_t> other_;
    std::vector<double> link_;   // [W/K]
    std::vector<double> whole_;  // sum of links [W/K]
    std::vector<entry> across_;  // pairs with ghosts
    std::vector<double> pivot_, inverse_, residual_, gradient_, direction_, product_, upper_, pending_, shift_;
};

}  // namespace detail
}  // namespace hearth
