// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <hearth/core/error.hpp>
#include <hearth/core/thermal_link.hpp>
#include <hearth/time/particle_energy.hpp>

namespace hearth {

/// The pair that holds every kind of link.
using thermal_pair = linked_pair<thermal_link<double>>;

namespace detail {

/// The connected parts of a graph of pairs, numbered in order of their first member.
class islands {
  public:
    template <class Pair>
    void find(const std::vector<Pair>& pairs, std::size_t count) {
        label_.resize(count);
        for (std::size_t i = 0; i < count; ++i) label_[i] = static_cast<std::int32_t>(i);
        for (const Pair& pair : pairs) {
            const std::int32_t a = root(pair.first), b = root(pair.second);
            label_[static_cast<std::size_t>(a < b ? b : a)] = a < b ? a : b;
        }
        // A root is the least of its island and stands before its members, so one sweep numbers them all.
        count_ = 0;
        numbers_.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const std::int32_t r = root(static_cast<std::int32_t>(i));
            numbers_[i] = static_cast<std::size_t>(r) == i ? count_++ : numbers_[static_cast<std::size_t>(r)];
        }
    }

    std::size_t of(std::size_t i) const { return numbers_[i]; }

    /// mean = sum of values / sum of weights, island by island.
    template <class Value>
    void means(const std::vector<double>& weight, const Value& value, std::vector<double>& mean) {
        mean.assign(count_, 0.0);
        weights_.assign(count_, 0.0);
        for (std::size_t i = 0; i < numbers_.size(); ++i) {
            mean[numbers_[i]] += value(i);
            weights_[numbers_[i]] += weight[i];
        }
        for (std::size_t k = 0; k < count_; ++k) mean[k] /= weights_[k];
    }

  private:
    std::int32_t root(std::int32_t i) {
        std::int32_t r = i;
        while (label_[static_cast<std::size_t>(r)] != r) r = label_[static_cast<std::size_t>(r)];
        while (label_[static_cast<std::size_t>(i)] != r) {
            const std::int32_t up = label_[static_cast<std::size_t>(i)];
            label_[static_cast<std::size_t>(i)] = r;
            i = up;
        }
        return r;
    }

    std::vector<std::int32_t> label_;
    std::vector<std::size_t> numbers_;
    std::size_t count_ = 0;
    std::vector<double> weights_;
};

/// diagonal_i x_i + sum_j link_ij (x_i - x_j) = right_i, by conjugate gradients with the diagonal as preconditioner.
class network_system {
  public:
    std::vector<double> diagonal;  ///< without the links; > 0 [W/K]
    std::vector<double> right;     ///< [W]

    struct outcome {
        int iterations;
        double residual;
        bool converged;
    };

    template <class Pair>
    outcome solve(const std::vector<Pair>& pairs, const std::vector<double>& link, islands& parts, double tolerance,
                  int limit, std::vector<double>& x) {
        const std::size_t count = x.size();
        inverse_ = diagonal;
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            inverse_[static_cast<std::size_t>(pairs[k].first)] += link[k];
            inverse_[static_cast<std::size_t>(pairs[k].second)] += link[k];
        }
        double scale = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            inverse_[i] = 1.0 / inverse_[i];
            scale += right[i] * right[i] * inverse_[i];
        }
        if (!(scale > 0.0)) {  // nothing pulls
            x.assign(count, 0.0);
            return {0, 0.0, true};
        }
        balance(parts, x);
        double rho = refresh(pairs, link, x), previous = 0.0;
        const double target = tolerance * tolerance * scale;
        direction_.assign(count, 0.0);
        outcome result{0, 0.0, true};
        while (rho > target && result.iterations < limit) {
            const double beta = result.iterations == 0 ? 0.0 : rho / previous;
            for (std::size_t i = 0; i < count; ++i) direction_[i] = inverse_[i] * residual_[i] + beta * direction_[i];
            apply(pairs, link, direction_, product_);
            double curvature = 0.0;
            for (std::size_t i = 0; i < count; ++i) curvature += direction_[i] * product_[i];
            if (!(curvature > 0.0)) break;
            const double alpha = rho / curvature;
            previous = rho;
            rho = 0.0;
            for (std::size_t i = 0; i < count; ++i) {
                x[i] += alpha * direction_[i];
                residual_[i] -= alpha * product_[i];
                rho += residual_[i] * residual_[i] * inverse_[i];
            }
            ++result.iterations;
        }
        result.converged = !(rho > target);
        balance(parts, x);
        result.residual = std::sqrt(refresh(pairs, link, x) / scale);
        return result;
    }

  private:
    template <class Pair>
    void apply(const std::vector<Pair>& pairs, const std::vector<double>& link, const std::vector<double>& x,
               std::vector<double>& y) const {
        y.resize(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) y[i] = diagonal[i] * x[i];
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            const auto a = static_cast<std::size_t>(pairs[k].first), b = static_cast<std::size_t>(pairs[k].second);
            const double flow = link[k] * (x[a] - x[b]);
            y[a] += flow;
            y[b] -= flow;
        }
    }

    /// Residual of x, and its square in the norm of the preconditioner.
    template <class Pair>
    double refresh(const std::vector<Pair>& pairs, const std::vector<double>& link, const std::vector<double>& x) {
        apply(pairs, link, x, product_);
        residual_.resize(x.size());
        double square = 0.0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            residual_[i] = right[i] - product_[i];
            square += residual_[i] * residual_[i] * inverse_[i];
        }
        return square;
    }

    /// Shifts each island so that its energy balance, in which the links cancel, closes.
    void balance(islands& parts, std::vector<double>& x) {
        parts.means(
            diagonal, [&](std::size_t i) { return right[i] - diagonal[i] * x[i]; }, shift_);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += shift_[parts.of(i)];
    }

    std::vector<double> inverse_, residual_, direction_, product_, shift_;
};

}  // namespace detail
}  // namespace hearth
