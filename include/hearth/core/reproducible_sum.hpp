// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hearth {

/// A sum that does not depend on the order of its terms nor on how they are spread over ranks: each term is cut into
/// three integers of a fixed scale, and integers add exactly.
///
/// bound: no term is larger in magnitude.  count: no more terms than this over all ranks, up to 2^40.
/// Error: at most count * 2^-3w * bound with w = 61 - log2(count) bits a limb; for count = 1e6 that is 1e-31 of bound,
/// so the rounding of value() to double is what remains.
class reproducible_sum {
  public:
    reproducible_sum(double bound, std::int64_t count) {
        int count_bits = 0;
        while (count_bits < 40 && (std::int64_t{1} << count_bits) < count) ++count_bits;
        const int width = 61 - count_bits;
        int exponent = 0;
        std::frexp(bound, &exponent);  // bound < 2^exponent
        const int scale = width - exponent;
        limb_ = std::ldexp(1.0, width);
        // A single power of two could overflow for tiny bounds, so scale in two exact steps.
        scale_first_ = std::ldexp(1.0, scale / 2);
        scale_second_ = std::ldexp(1.0, scale - scale / 2);
    }

    void add(double term) {
        double rest = term * scale_first_ * scale_second_;
        for (std::int64_t& limb : limbs_) {
            const auto whole = static_cast<std::int64_t>(rest);
            limb += whole;
            rest = (rest - static_cast<double>(whole)) * limb_;
        }
    }

    /// Adds or takes away, without rounding, a sum of the same bound and count.
    void add(const reproducible_sum& other) {
        for (std::size_t k = 0; k < limb_count(); ++k) limbs_[k] += other.limbs_[k];
    }
    void subtract(const reproducible_sum& other) {
        for (std::size_t k = 0; k < limb_count(); ++k) limbs_[k] -= other.limbs_[k];
    }
    /// Back to zero.
    void clear() { limbs_ = {}; }

    /// The integers, to be added over ranks: communicator.sum(total.limbs(), total.limb_count()).
    std::int64_t* limbs() { return limbs_.data(); }
    static constexpr std::size_t limb_count() { return 3; }

    double value() const {
        const auto limb = static_cast<long double>(limb_);
        const long double sum = static_cast<long double>(limbs_[0]) +
                                (static_cast<long double>(limbs_[1]) + static_cast<long double>(limbs_[2]) / limb) / limb;
        return static_cast<double>(sum) / scale_second_ / scale_first_;  // powers of two
    }

  private:
    std::array<std::int64_t, 3> limbs_{};
    double scale_first_ = 1;
    double scale_second_ = 1;
    double limb_ = 1;
};

}  // namespace hearth
