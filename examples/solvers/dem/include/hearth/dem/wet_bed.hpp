// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include <hearth/core/error.hpp>
#include <hearth/dem/thermal_bed.hpp>
#include <hearth/time/drying_step.hpp>
#include <hearth/transfer/term.hpp>

namespace hearth::dem {

/// Values that belong to the particles of a bed by their ids, in the order of its indices: composition, moisture,
/// marks. On several ranks they go along with their particles; then they are to be trivially copyable.
template <class Value>
class per_particle {
  public:
    /// Brings the values into the order of the bed, and to the ranks of their particles.  made(i) is the value of a
    /// particle that is new; gone(value) hears of those whose particles have left, on the rank that had them.  Call it
    /// before the values are used; it does nothing while no index has changed.  Together.
    template <class Made, class Gone>
    void follow(const bed& b, Made&& made, Gone&& gone) {
        if (followed_ && revision_ == b.revision()) return;
        const auto index_of = [](const std::vector<known>& sorted, std::int64_t id) {
            const auto found = std::lower_bound(sorted.begin(), sorted.end(), known{id, 0});
            return found != sorted.end() && found->first == id ? static_cast<std::ptrdiff_t>(found->second) : -1;
        };
        const std::vector<known> had = sorted(ids_);
        std::vector<Value> now;
        std::vector<index> strangers;  // new, or come from another rank
        std::vector<char> stays(ids_.size(), 0);
        for (index i = 0; i < b.size(); ++i) {
            const std::ptrdiff_t k = index_of(had, b.ids()[i]);
            if (k < 0) {
                strangers.push_back(i);
            } else {
                stays[static_cast<std::size_t>(k)] = 1;
            }
            now.push_back(k < 0 ? Value{} : values_[static_cast<std::size_t>(k)]);
        }
        std::vector<travelling> missing;  // gone, or gone to another rank
        for (std::size_t k = 0; k < ids_.size(); ++k)
            if (!stays[k]) missing.push_back({ids_[k], values_[k]});

        // What one rank misses is a stranger to another one, or to none.
        std::vector<travelling> lost = missing;
        std::vector<std::int64_t> wanted;
        for (const index i : strangers) wanted.push_back(b.ids()[i]);
        if (b.is_shared()) {
            if constexpr (std::is_trivially_copyable_v<Value>) {
                lost = b.among().gather(missing);
                wanted = b.among().gather(wanted);
            } else {
                throw std::invalid_argument(
                    "hearth: values that are not trivially copyable do not go from rank to rank");
            }
        }
        std::vector<std::int64_t> lost_ids;
        for (const travelling& t : lost) lost_ids.push_back(t.id);
        const std::vector<known> found = sorted(lost_ids), taken = sorted(wanted);
        for (const index i : strangers) {
            const std::ptrdiff_t k = index_of(found, b.ids()[i]);
            now[static_cast<std::size_t>(i)] = k < 0 ? made(i) : lost[static_cast<std::size_t>(k)].value;
        }
        for (const travelling& t : missing)
            if (index_of(taken, t.id) < 0) gone(t.value);
        values_.swap(now);
        ids_.assign(b.ids(), b.ids() + b.size());
        revision_ = b.revision();
        followed_ = true;
    }

    std::vector<Value>& values() { return values_; }
    const std::vector<Value>& values() const { return values_; }

    /// To save: ids()[k] has values()[k].  To restore, on any number of ranks: each rank gives what it has read, and
    /// follow() brings it to its particles.
    const std::vector<std::int64_t>& ids() const { return ids_; }
    void restore(std::vector<std::int64_t> ids, std::vector<Value> values) {
        if (ids.size() != values.size()) {
            throw bad_value("number of values", bad_value::no_index, static_cast<double>(values.size()), "that of ids");
        }
        ids_ = std::move(ids);
        values_ = std::move(values);
        followed_ = false;
    }

  private:
    using known = std::pair<std::int64_t, std::size_t>;
    struct travelling {
        std::int64_t id;
        Value value;
    };
    static std::vector<known> sorted(const std::vector<std::int64_t>& ids) {
        std::vector<known> all;
        for (std::size_t k = 0; k < ids.size(); ++k) all.emplace_back(ids[k], k);
        std::sort(all.begin(), all.end());
        return all;
    }

    std::vector<Value> values_;
    std::vector<std::int64_t> ids_;
    std::uint64_t revision_ = 0;
    bool followed_ = false;
};

/// A thermal bed whose particles hold water; what dries off is taken from their mass in the motion, too.  On several
/// ranks sums are those of this rank: of what it has, has first seen, and has last had.
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

    /// After each advance, feed and outflow of the bed.  Together.
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

    /// What goes on from a restart, beside the bed's own state.  Parts may be given to other ranks than they came from.
    struct state {
        std::vector<std::int64_t> ids;
        std::vector<content> contents;
        double brought = 0, carried_out = 0;  ///< [kg]
    };
    state now() const { return {contents_.ids(), contents(), brought_, carried_out_}; }
    /// After the bed's own restore.  Together.
    void restore(state s) {
        contents_.restore(std::move(s.ids), std::move(s.contents));
        brought_ = s.brought;
        carried_out_ = s.carried_out;
        follow();
    }

    /// Heats and dries all particles over a step of the model [s], each on its own clock.  Together.  term: drying of
    /// the scene; gas: at the particles; baths: of whole parcels [W/K]; caloric_of(i): of the dry material.
    template <class Drying, class Gas, class CaloricOf, class Clock>
    books dry(const Drying& term, const Gas& gas, const std::vector<heat_bath<double>>& baths,
              const CaloricOf& caloric_of, const Clock& clock, double step);

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
    if (!(step >= 0) || !std::isfinite(step)) throw bad_value("step", bad_value::no_index, step, "finite and >= 0 [s]");
    const double grains = std::pow(heated_->parcel_factor(), 3);
    books sum;
    for (index i = 0; i < b.size(); ++i) {
        content& c = contents_.values()[static_cast<std::size_t>(i)];
        const auto film =
            term.gas_film(view<wet_bed>(*this, i), view<Gas>(gas, static_cast<particle_index_t<Gas>>(i)), clock);
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
    b.update_ghosts();  // masses have changed
    return sum;
}

}  // namespace hearth::dem
