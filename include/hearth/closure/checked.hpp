// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <sstream>
#include <string>

#include <hearth/closure/drag.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/interval.hpp>
#include <hearth/core/scalar.hpp>

namespace hearth::closure {

/// An argument of a closure, its name and the range in which the closure was fitted.
template <class Scalar>
struct ranged {
    const char* name;
    interval range;
    Scalar value;
};

/// What happens outside the fitted range is a policy.  It is called with the closure's name and all arguments of one
/// evaluation that have a range, and may change their values.

/// Nothing: the closure extrapolates; it stays total and finite.
struct trust {
    template <class... Arguments>
    HEARTH_FUNCTION void operator()(const char*, Arguments&...) const {}
};

/// The nearest value of the range is taken instead.  NaN stays NaN.
struct clamp {
    template <class... Arguments>
    HEARTH_FUNCTION void operator()(const char*, Arguments&... arguments) const {
        ((arguments.value = arguments.range.clamp(arguments.value)), ...);
    }
};

/// How many evaluations there were, and how many of them had an argument outside.  The caller owns it.
/// Threads may share it; where that is felt, give each thread its own and add them up.
struct range_counter {
    std::atomic<std::int64_t> evaluations{0};
    std::atomic<std::int64_t> outside{0};

    /// Share of the evaluations that were outside [-]; 0 before the first.
    double share() const {
        const std::int64_t total = evaluations.load();
        return total > 0 ? static_cast<double>(outside.load()) / static_cast<double>(total) : 0.0;
    }
};

/// The closure extrapolates, and the caller's counter learns of it.  NaN counts as outside; each lane counts.
class count {
  public:
    /// The counter must outlive every copy.
    explicit count(range_counter& counter) : counter_(&counter) {}

    template <class Scalar, class... Others>
    void operator()(const char*, const ranged<Scalar>& first, const Others&... others) const {
        const std::int64_t lanes = lane_count(first.value);
        std::int64_t outside = 0;
        for (std::int64_t k = 0; k < lanes; ++k)
            if (!(inside(first, k) && ... && inside(others, k))) ++outside;
        counter_->evaluations.fetch_add(lanes, std::memory_order_relaxed);
        if (outside > 0) counter_->outside.fetch_add(outside, std::memory_order_relaxed);
    }

  private:
    template <class Scalar>
    static bool inside(const ranged<Scalar>& argument, std::int64_t k) {
        return argument.range.contains(lane(argument.value, k));
    }

    range_counter* counter_;
};

/// Throws bad_value with the name of closure and argument, the lane where there is more than one, the value and the
/// range.  For hosts, not for kernels.
struct raise {
    template <class... Arguments>
    void operator()(const char* closure, const Arguments&... arguments) const {
        (check(closure, arguments), ...);
    }

  private:
    template <class Scalar>
    static void check(const char* closure, const ranged<Scalar>& argument) {
        const std::int64_t lanes = lane_count(argument.value);
        for (std::int64_t k = 0; k < lanes; ++k) {
            const real_t<Scalar> value = lane(argument.value, k);
            if (argument.range.contains(value)) continue;
            std::ostringstream allowed;
            allowed << "in [" << argument.range.lo << ", " << argument.range.hi << ']';
            const std::string place = std::string(argument.name) + " of closure " + closure;
            throw bad_value(lanes > 1 ? place + ", lane" : place, lanes > 1 ? k : bad_value::no_index,
                            static_cast<double>(value), allowed.str());
        }
    }
};

/// A closure that watches its arguments:  checked<gunn, count> nusselt{gunn{}, count{counter}}.
/// It has the closure's functions and takes its place everywhere.  With `trust` it costs nothing and weighs nothing.
template <class Closure, class Policy = trust>
class checked : private Closure, private Policy {
  public:
    HEARTH_FUNCTION explicit checked(const Closure& closure = Closure(), const Policy& policy = Policy())
        : Closure(closure), Policy(policy) {}

    HEARTH_FUNCTION const Closure& closure() const { return *this; }
    HEARTH_FUNCTION static constexpr momentum_model model() { return Closure::model(); }

    /// Nusselt number [-].
    template <class Scalar>
    HEARTH_FUNCTION Scalar nusselt(const Scalar& void_fraction, const Scalar& reynolds, const Scalar& prandtl) const {
        const auto [e, re] = watched(void_fraction, reynolds);
        return closure().nusselt(e.value, re.value, prandtl);
    }

    /// Sherwood number [-].
    template <class Scalar>
    HEARTH_FUNCTION Scalar sherwood(const Scalar& void_fraction, const Scalar& reynolds, const Scalar& schmidt) const {
        const auto [e, re] = watched(void_fraction, reynolds);
        return closure().sherwood(e.value, re.value, schmidt);
    }

    /// Of a drag closure, see drag.hpp [-].
    template <class Scalar>
    HEARTH_FUNCTION Scalar dimensionless_exchange(const Scalar& void_fraction, const Scalar& reynolds) const {
        const auto [e, re] = watched(void_fraction, reynolds);
        return closure().dimensionless_exchange(e.value, re.value);
    }

    /// View factor of a pair of spheres [-].
    template <class Scalar>
    HEARTH_FUNCTION Scalar view_factor(const Scalar& distance_ratio) const {
        ranged<Scalar> s{"distance_ratio", Closure::distance_ratio_range(), distance_ratio};
        policy()(Closure::name(), s);
        return closure().view_factor(s.value);
    }

    /// View factor of a pair of spheres in a bed of a solid fraction [-].
    template <class Scalar>
    HEARTH_FUNCTION Scalar view_factor(const Scalar& distance_ratio, const Scalar& solid_fraction) const {
        ranged<Scalar> s{"distance_ratio", Closure::distance_ratio_range(), distance_ratio};
        ranged<Scalar> p{"solid_fraction", Closure::solid_fraction_range(), solid_fraction};
        policy()(Closure::name(), s, p);
        return closure().view_factor(s.value, p.value);
    }

  private:
    template <class Scalar>
    struct flow_arguments {
        ranged<Scalar> void_fraction;
        ranged<Scalar> reynolds;
    };

    HEARTH_FUNCTION const Policy& policy() const { return *this; }

    template <class Scalar>
    HEARTH_FUNCTION flow_arguments<Scalar> watched(const Scalar& void_fraction, const Scalar& reynolds) const {
        flow_arguments<Scalar> watched{{"void_fraction", Closure::void_fraction_range(), void_fraction},
                                       {"reynolds", Closure::reynolds_range(), reynolds}};
        policy()(Closure::name(), watched.void_fraction, watched.reynolds);
        return watched;
    }
};

}  // namespace hearth::closure
