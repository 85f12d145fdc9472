// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <hearth/core/error.hpp>
#include <hearth/time/drying_step.hpp>
#include <hearth/transfer/term.hpp>

#include <hearth/dem/thermal_bed.hpp>

namespace hearth::dem {

/// Values that belong to the particles of a bed by their ids, in the order of its indices: composition, moisture, marks.
/// For a bed on one rank: follow() throws bad_value for another.
template <class Value>
class per_particle {
  public:
    /// Brings the values into the order of the bed.  made(i) is the value of a particle that is new; gone(value) hears of
    /// those whose particles have left.  Call it before the values are used; it does nothing while no index has changed.
    template <class Made, class Gone>
    void follow(const bed& b, Made&& made, Gone&& gone) {
        if (b.is_shared()) {
            throw bad_value("number of ranks of the bed", bad_value::no_index, b.among().size(),
                            "1: values by id do not go from rank to rank");
        }
        if (followed_ && revision_ == b.revision()) return;
        std::vector<std::pair<std::int64_t, std::size_t>> known;
        for (std::size_t k = 0; k < ids_.size(); ++k) known.emplace_back(ids_[k], k);
        std::sort(known.begin(), known.end());
        std::vector<char> stays(ids_.size(), 0);
        std::vector<Value> now;
        now.reserve(static_cast<std::size_t>(b.size()));
        for (index i = 0; i < b.size(); ++i) {
            const auto found = std::lower_bound(known.begin(), known.end(), std::make_pair(b.ids()[i], std::size_t{0}));
            if (found != known.end() && found->first == b.ids()[i]) {
                stays[found->second] = 1;
                now.push_back(values_[found->second]);
            } else {
                now.push_back(made(i));
            }
        }
        for (std::size_t k = 0; k < ids_.size(); ++k)
            if (!stays[k]) gone(values_[k]);
        values_.swap(now);
        ids_.assign(b.ids(), b.ids() + b.size());
        revision_ = b.revision();
        followed_ = true;
    }

    std::vector<Value>& values() { return values_; }
    const std::vector<Value>& values() const { return values_; }

  private:
    std::vector<Value> values_;
    std::vector<std::int64_t> ids_;
    std::uint64_t revision_ = 0;
    bool followed_ = false;
};

/// A thermal bed whose particles hold water; what dries off is taken from their mass in the motion, too.
///
/// To terms it looks like one grain of each parcel (see grains()), so that a gas film is that of a grain.
class wet_bed {
  public:
    struct content {
        double dry = 0, water = 0;  ///< [kg]
    };
    struct books {
        double evaporated = 0;       ///< less what condensed [kg]
        double vapour_enthalpy = 0;  ///< that went with it [J]
        double heat = 0;             ///< that the baths gave [J]
    };

    /// New particles hold so much water per dry mass; their mass as inserted counts as wet.  Throws bad_value.
    wet_bed(thermal_bed& heated, double moisture_of_new) : heated_(&heated), moisture_of_new_(moisture_of_new) {
        if (!(moisture_of_new >= 0) || !std::isfinite(moisture_of_new))
            throw bad_value("moisture_of_new", bad_value::no_index, moisture_of_new, "finite and >= 0 [kg/kg]");
        follow();
    }

    /// After each advance, feed and outflow of the bed.
    void follow() {
        const bed& b = heated_->spheres();
        contents_.follow(
            b,
            [&](index i) {
                const double dry = b.mass(i) / (1 + moisture_of_new_);
                brought_ += moisture_of_new_ * dry;
                return content{dry, moisture_of_new_ * dry};
            },
            [&](const content& c) { carried_out_ += c.water; });
    }

    thermal_bed& heated() { return *heated_; }
    const thermal_bed& heated() const { return *heated_; }
    const std::vector<content>& contents() const { return contents_.values(); }
    double water() const {
        double sum = 0;
        for (const content& c : contents()) sum += c.water;
        return sum;
    }
    double water_brought() const { return brought_; }          ///< by all particles so far [kg]
    double water_carried_out() const { return carried_out_; }  ///< with those that left [kg]

    /// Heats and dries all particles over a step of the model [s], each on its own clock.  term: drying of the scene; gas: at
    /// the particles; baths: of whole parcels [W/K]; caloric_of(i): of the dry material.
    template <class Drying, class Gas, class CaloricOf, class Clock>
    books dry(const Drying& term, const Gas& gas, const std::vector<heat_bath<double>>& baths, const CaloricOf& caloric_of,
              const Clock& clock, double step);

  private:
    thermal_bed* heated_;
    double moisture_of_new_;
    per_particle<content> contents_;
    double brought_ = 0, carried_out_ = 0;
};

}  // namespace hearth::dem

template <>
struct hearth::particle_traits<hearth::dem::wet_bed> {
    using index = std::int32_t;
    using scalar = double;
    using cloud = dem::wet_bed;
    using of_bed = particle_traits<dem::thermal_bed>;

    static index particle_count(const cloud& c) { return of_bed::particle_count(c.heated()); }
    static double get(quantity::radius, const cloud& c, index i) {
        return of_bed::get(quantity::radius{}, c.heated(), i) / c.heated().parcel_factor();
    }
    static double get(quantity::moisture, const cloud& c, index i) {
        return c.contents()[static_cast<std::size_t>(i)].water / std::pow(c.heated().parcel_factor(), 3);
    }
    template <class Tag>
    static auto get(Tag tag, const cloud& c, index i) -> decltype(of_bed::get(tag, c.heated(), i)) {
        return of_bed::get(tag, c.heated(), i);
    }
};

namespace hearth::dem {

template <class Drying, class Gas, class CaloricOf, class Clock>
wet_bed::books wet_bed::dry(const Drying& term, const Gas& gas, const std::vector<heat_bath<double>>& baths,
                            const CaloricOf& caloric_of, const Clock& clock, double step) {
    follow();
    bed& b = heated_->spheres();
    if (baths.size() != contents().size())
        throw bad_value("number of baths", bad_value::no_index, static_cast<double>(baths.size()), "that of particles");
    if (!(step >= 0) || !std::isfinite(step))
        throw bad_value("step", bad_value::no_index, step, "finite and >= 0 [s]");
    const double grains = std::pow(heated_->parcel_factor(), 3);
    books sum;
    for (index i = 0; i < b.size(); ++i) {
        content& c = contents_.values()[static_cast<std::size_t>(i)];
        const auto film = term.gas_film(view<wet_bed>(*this, i),
                                        view<Gas>(gas, static_cast<particle_index_t<Gas>>(i)), clock);
        const auto after = drying_step(
            b.temperatures()[i], c.dry, c.water, caloric_of(static_cast<std::size_t>(i)), term,
            baths[static_cast<std::size_t>(i)], [&](double kelvin) { return grains * film.rate(kelvin); },
            clock.factor(static_cast<std::size_t>(i)) * step);
        b.temperatures()[i] = after.temperature;
        c.water = after.moisture;
        b.set_mass(i, c.dry + c.water);
        sum.evaporated += after.evaporated;
        sum.vapour_enthalpy += after.vapour_enthalpy;
        sum.heat += after.conducted + after.radiated;
    }
    return sum;
}

}  // namespace hearth::dem
