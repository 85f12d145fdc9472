// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

/// Powers of many numbers at once, in the vector registers that the compiler may use.
namespace hearth::detail {

#if defined(__GNUC__)  // GCC and Clang: vector types

#if defined(__AVX512F__)
inline constexpr std::size_t register_bytes = 64;
#elif defined(__AVX__)
inline constexpr std::size_t register_bytes = 32;
#else
inline constexpr std::size_t register_bytes = 16;
#endif

/// What lane_power needs to know of float and double.
/// The polynomials are near the best of their degree, with errors below a tenth of a round-off:
/// log2(m) = z logarithm(z^2) with z = (m - 1)/(m + 1) for m in [sqrt(1/2), sqrt(2)], and 2^r for r in [-1/2, 1/2].
template <class Real>
struct power_table;

template <>
struct power_table<double> {
    using bits = std::uint64_t;
    using signed_bits = std::int64_t;
    static constexpr int fraction_bits = 52, bias = 1023, split_bits = 27;
    static constexpr std::int32_t offset = 1 << 20;
    static constexpr bits root_half = 0x3fe6a09e667f3bcdU;
    static constexpr double logarithm[]{2.88539008177792681,  0.961796693925989739, 0.577078016345514082,
                                        0.412198585842294187, 0.320598534765048142, 0.262334360603295472,
                                        0.220912867341801571, 0.213661225027983273};
    static constexpr double exponential[]{1.0,
                                          0.69314718055994530925,
                                          0.24022650695910161351,
                                          0.05550410866482162799,
                                          0.0096181291075865921824,
                                          0.0013333558146406116514,
                                          0.00015403530464573219233,
                                          0.000015252733842009231961,
                                          1.3215432100216046418e-6,
                                          1.0178056855501161077e-7,
                                          7.0742716010737186529e-9,
                                          4.4558591123302076764e-10};
};

template <>
struct power_table<float> {
    using bits = std::uint32_t;
    using signed_bits = std::int32_t;
    static constexpr int fraction_bits = 23, bias = 127, split_bits = 12;
    static constexpr std::int32_t offset = 1 << 12;
    static constexpr bits root_half = 0x3f3504f3U;
    static constexpr float logarithm[]{2.88539008F, 0.961798839F, 0.576715112F, 0.431719726F};
    static constexpr float exponential[]{1.0F,           0.693147207F,   0.240226509F,   0.0555032655F,
                                         0.00961805610F, 0.00134006965F, 0.000154616770F};
};

/// As many numbers as fill a register.
template <class Real>
struct lane_power {
    using table = power_table<Real>;
    static constexpr std::size_t lanes = register_bytes / sizeof(Real);
    typedef Real reals __attribute__((vector_size(register_bytes)));
    typedef typename table::bits bits __attribute__((vector_size(register_bytes)));
    typedef typename table::signed_bits mask __attribute__((vector_size(register_bytes)));
    typedef std::int32_t integers __attribute__((vector_size(lanes * sizeof(std::int32_t))));

    /// x to the power a + tail; tail is what a lost by rounding.  Within two round-offs for x > 0 and |a| <= 32.
    /// The power is 2^n 2^r.  The integer part of log2(x) times a is split off exactly, so that all that is rounded is
    /// of order one, and the error does not grow with the logarithm.  Beyond the range of Real it ends at the range's
    /// end. 0 gives 0, 1 or infinity, infinity the opposite, a negative number and NaN give NaN.
    [[gnu::always_inline]] static inline reals evaluate(const reals& number, const reals& a, const reals& tail) {
        constexpr Real least = std::numeric_limits<Real>::min(), infinity = std::numeric_limits<Real>::infinity();
        const reals x = number < least ? reals{} + least : number;

        // x = 2^k m with m in [sqrt(1/2), sqrt(2)]
        constexpr auto one = static_cast<typename table::bits>(table::bias) << table::fraction_bits;
        const bits representation = as<bits>(x);
        const bits shifted = (representation + (one - table::root_half)) >> table::fraction_bits;
        const bits fraction = representation - ((shifted - table::bias) << table::fraction_bits);
        const reals m = as<reals>(fraction);
        const reals z = (m - Real(1)) / (m + Real(1));
        const reals logarithm = z * polynomial(table::logarithm, z * z);
        const reals k = __builtin_convertvector(__builtin_convertvector(shifted, integers) - table::bias, reals);

        // a in two parts, of which the first is so short that its product with k is exact
        const reals high = as<reals>(as<bits>(a) & ~((typename table::bits(1) << table::split_bits) - 1));
        const reals large = high * k;
        const reals small = (a - high + tail) * k + a * logarithm;

        // n is the nearest integer: the offset makes truncation a floor.  A NaN becomes an integer, too, and comes back
        // with r.
        const reals offset = reals{} + static_cast<Real>(table::offset), sum = large + small;
        const reals above_least = sum > -offset ? sum : -offset;
        const reals bounded = above_least < offset ? above_least : offset;
        const integers n = __builtin_convertvector(bounded + offset + Real(0.5), integers) - table::offset;
        const reals r = (large - __builtin_convertvector(n, reals)) + small;
        const integers end = integers{} + (table::bias - 1);
        const integers below = n > end ? end : n;
        const integers in_range = below < -end ? -end : below;
        const bits scale = __builtin_convertvector(in_range + table::bias, bits) << table::fraction_bits;
        const reals power = as<reals>(scale) * polynomial(table::exponential, r);

        const reals zero = reals{};
        const reals at_zero = a > zero ? zero : (a < zero ? zero + infinity : zero + Real(1));
        const reals at_infinity = a > zero ? zero + infinity : (a < zero ? zero : zero + Real(1));
        const reals undefined = zero + std::numeric_limits<Real>::quiet_NaN();
        const reals above = number < infinity ? power : (number == infinity ? at_infinity : undefined);
        return number > zero ? above : (number == zero ? at_zero : undefined);
    }

  private:
    template <class To, class From>
    static To as(const From& from) {
        static_assert(sizeof(To) == sizeof(From));
        To to;
        std::memcpy(&to, &from, sizeof to);
        return to;
    }

    template <std::size_t Count>
    static reals polynomial(const Real (&coefficients)[Count], const reals& x) {
        reals sum = reals{} + coefficients[Count - 1];
        for (std::size_t k = Count - 1; k-- > 0;) sum = sum * x + coefficients[k];
        return sum;
    }
};

/// Calls chunk(begin, bytes) for register after register; the size of whole ones is a constant, so that their copies
/// are single instructions.
template <class Real, class Chunk>
[[gnu::always_inline]] inline void for_each_register(std::size_t count, Chunk&& chunk) {
    constexpr std::size_t lanes = lane_power<Real>::lanes;
    std::size_t k = 0;
    for (; k + lanes <= count; k += lanes) chunk(k, std::integral_constant<std::size_t, register_bytes>{});
    if (k < count) chunk(k, sizeof(Real) * (count - k));
}

/// y[k] = x[k] where x[k] is infinite or NaN.
template <class Real>
[[gnu::always_inline]] inline void keep_infinity(const Real* x, Real* y, std::size_t count) {
    using reals = typename lane_power<Real>::reals;
    for_each_register<Real>(count, [=](std::size_t k, auto bytes) {
        reals from = reals{}, to = reals{};
        std::memcpy(&from, x + k, bytes);
        std::memcpy(&to, y + k, bytes);
        to = from < std::numeric_limits<Real>::infinity() ? to : from;
        std::memcpy(y + k, &to, bytes);
    });
}

/// y[k] = x[k] to the power a + tail.
template <class Real>
[[gnu::always_inline]] inline void raise_to_power(const Real* x, Real* y, std::size_t count, Real a, Real tail = 0) {
    using reals = typename lane_power<Real>::reals;
    for_each_register<Real>(count, [=](std::size_t k, auto bytes) {
        reals number = reals{};
        std::memcpy(&number, x + k, bytes);
        number = lane_power<Real>::evaluate(number, reals{} + a, reals{} + tail);
        std::memcpy(y + k, &number, bytes);
    });
}

/// y[k] = x[k] to the power a[k].
template <class Real>
[[gnu::always_inline]] inline void raise_to_powers(const Real* x, const Real* a, Real* y, std::size_t count) {
    using reals = typename lane_power<Real>::reals;
    for_each_register<Real>(count, [=](std::size_t k, auto bytes) {
        reals number = reals{}, exponent = reals{};
        std::memcpy(&number, x + k, bytes);
        std::memcpy(&exponent, a + k, bytes);
        number = lane_power<Real>::evaluate(number, exponent, reals{});
        std::memcpy(y + k, &number, bytes);
    });
}

#else  // no vector types: one by one

template <class Real>
void keep_infinity(const Real* x, Real* y, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k)
        if (!(x[k] < std::numeric_limits<Real>::infinity())) y[k] = x[k];
}

template <class Real>
void raise_to_power(const Real* x, Real* y, std::size_t count, Real a, Real = 0) {
    for (std::size_t k = 0; k < count; ++k) y[k] = std::pow(x[k], a);
}

template <class Real>
void raise_to_powers(const Real* x, const Real* a, Real* y, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) y[k] = std::pow(x[k], a[k]);
}

#endif

}  // namespace hearth::detail
