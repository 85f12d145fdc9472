// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <hearth/core/contact_traits.hpp>
#include <hearth/core/particle_traits.hpp>
#include <hearth/furnace/settings.hpp>
#include <hearth/furnace/spinel.hpp>

namespace hearth::furnace {

/// A bed that is not packed by DEM: equal parcels on a face-centred lattice, stretched to the scene's void fraction, that
/// sinks as a plug.  What leaves below enters on top at the feed's temperature.
///
/// A parcel stands for k^3 stones of the Sauter mean diameter d and is k d wide.
class plug_bed {
  public:
    explicit plug_bed(const settings& scene) {
        double inverse = 0;
        for (const size_class& size : scene.particles.sizes) inverse += size.mass_share / size.diameter;
        stone_radius_ = 0.5 / inverse;
        parcel_radius_ = scene.bed.coarse_graining * stone_radius_;
        height_ = scene.shaft.height;
        shaft_radius_ = 0.5 * scene.shaft.diameter;
        feed_temperature_ = scene.particles.feed_temperature;
        const double volume = 4.0 / 3.0 * pi * std::pow(parcel_radius_, 3);
        const double wanted = (1 - scene.bed.void_fraction) * pi * shaft_radius_ * shaft_radius_ * height_ / volume;
        // Parcels near the wall come and go with the lattice's spacing, so look for the spacing that holds as many as wanted.
        double low = parcel_radius_, high = 4 * parcel_radius_;
        for (int pass = 0; pass < 60; ++pass) {
            const double middle = 0.5 * (low + high);
            (static_cast<double>(fill(middle).size()) > wanted ? low : high) = middle;
        }
        positions_ = fill(high);
        // The lattice's numbers come in leaps; the parcels are made a little larger to hold all of the solid.
        parcel_radius_ *= std::cbrt(wanted / static_cast<double>(positions_.size()));
        stones_ = std::pow(parcel_radius_ / stone_radius_, 3);
        mass_ = 4.0 / 3.0 * pi * std::pow(parcel_radius_, 3) * scene.particles.density;
        speed_ = scene.particles.mass_flow / (mass_ * static_cast<double>(positions_.size()) / height_);
        temperatures_.assign(positions_.size(), feed_temperature_);
    }

    std::size_t size() const { return positions_.size(); }
    double parcel_radius() const { return parcel_radius_; }
    double stone_radius() const { return stone_radius_; }
    double stones_per_parcel() const { return stones_; }
    double coarse_graining() const { return parcel_radius_ / stone_radius_; }
    double mass() const { return mass_; }            ///< of a parcel [kg]
    double speed() const { return speed_; }          ///< downwards, by the process's clock [m/s]
    double height() const { return height_; }
    double shaft_radius() const { return shaft_radius_; }
    const std::vector<std::array<double, 3>>& positions() const { return positions_; }
    std::vector<std::array<double, 3>>& positions() { return positions_; }
    const std::vector<double>& temperatures() const { return temperatures_; }
    std::vector<double>& temperatures() { return temperatures_; }

    /// What left and what came, by the process's clock.
    struct passage {
        double mass = 0;              ///< [kg]
        double enthalpy_out = 0;      ///< leaving less entering [J]
        double outlet_temperature = 0;///< of the mean enthalpy that left [K]; 0 where nothing left
    };

    passage sink(double process_time) {
        passage passed;
        double left = 0;
        for (std::size_t i = 0; i < positions_.size(); ++i) {
            positions_[i][2] -= speed_ * process_time;
            while (positions_[i][2] < 0) {  // a step may be longer than the shaft
                positions_[i][2] += height_;
                passed.mass += mass_;
                left += mass_ * spinel::enthalpy(temperatures_[i]);
                passed.enthalpy_out += mass_ * (spinel::enthalpy(temperatures_[i]) - spinel::enthalpy(feed_temperature_));
                temperatures_[i] = feed_temperature_;
            }
        }
        if (passed.mass > 0) passed.outlet_temperature = spinel::temperature(left / passed.mass);
        return passed;
    }

    double enthalpy() const {
        double sum = 0;
        for (const double t : temperatures_) sum += mass_ * spinel::enthalpy(t);
        return sum;
    }

  private:
    static constexpr double pi = 3.14159265358979323846;

    /// Face-centred cubic with nearest neighbours at `spacing`, layers across the axis, centres up to the wall, so that the
    /// solid is as dense there as inside; whole layers fit the height, so that the bed closes on itself when it sinks.
    std::vector<std::array<double, 3>> fill(double spacing) const {
        const double layer = spacing / std::sqrt(2.0);
        const auto layers = static_cast<int>(std::max(2.0, 2 * std::floor(height_ / (2 * layer))));
        const double dz = height_ / layers, reach = shaft_radius_;
        const auto across = static_cast<int>(reach / spacing) + 2;
        std::vector<std::array<double, 3>> points;
        for (int k = 0; k < layers; ++k) {
            const double shift = k % 2 == 0 ? 0.0 : 0.5;
            for (int j = -across; j <= across; ++j) {
                for (int i = -across; i <= across; ++i) {
                    const double x = (i + shift) * spacing, y = (j + shift) * spacing;
                    if (x * x + y * y <= reach * reach) points.push_back({x, y, (k + 0.5) * dz});
                }
            }
        }
        return points;
    }

    double stone_radius_, parcel_radius_, stones_, height_, shaft_radius_, feed_temperature_, mass_, speed_;
    std::vector<std::array<double, 3>> positions_;
    std::vector<double> temperatures_;
};

/// The bed as parcels: what fills the cells, and what sees its neighbours.
struct parcels {
    const plug_bed& bed;
};

/// The bed as stones, one for each parcel: what the closures were fitted for.
struct stones {
    const plug_bed& bed;
    double acceleration_factor;  ///< the velocities that hearth asks for are those of the accelerated motion
};

/// Who is near whom, by parcels; and the wall in rings, each with its own temperature.
struct bed_neighbours {
    const plug_bed& bed;
    const std::vector<double>& ring_temperature;

    int ring(double z) const {
        const auto count = static_cast<double>(ring_temperature.size());
        return static_cast<int>(std::min(count - 1, std::max(0.0, z / bed.height() * count)));
    }
};

}  // namespace hearth::furnace

template <>
struct hearth::particle_traits<hearth::furnace::parcels> {
    using index = std::int32_t;
    using scalar = double;
    using cloud = furnace::parcels;
    static index particle_count(const cloud& c) { return static_cast<index>(c.bed.size()); }
    static const std::array<double, 3>& get(quantity::position, const cloud& c, index i) {
        return c.bed.positions()[static_cast<std::size_t>(i)];
    }
    static scalar get(quantity::radius, const cloud& c, index) { return c.bed.parcel_radius(); }
    static scalar get(quantity::temperature, const cloud& c, index i) {
        return c.bed.temperatures()[static_cast<std::size_t>(i)];
    }
};

template <>
struct hearth::particle_traits<hearth::furnace::stones> {
    using index = std::int32_t;
    using scalar = double;
    using cloud = furnace::stones;
    static index particle_count(const cloud& c) { return static_cast<index>(c.bed.size()); }
    static scalar get(quantity::radius, const cloud& c, index) { return c.bed.stone_radius(); }
    static std::array<double, 3> get(quantity::velocity, const cloud& c, index) { return {0, 0, -c.bed.speed() * c.acceleration_factor}; }
    static scalar get(quantity::temperature, const cloud& c, index i) {
        return c.bed.temperatures()[static_cast<std::size_t>(i)];
    }
    static scalar get(quantity::conductivity, const cloud& c, index i) {
        return furnace::spinel::conductivity(c.bed.temperatures()[static_cast<std::size_t>(i)]);
    }
};

template <>
struct hearth::contact_traits<hearth::furnace::bed_neighbours> {
    using host = furnace::bed_neighbours;

    /// On the lattice nobody touches: conduction is left to beds that DEM packs.
    template <class Visit>
    static void for_each_contact(const host&, Visit&&) {}
    template <class Visit>
    static void for_each_wall_contact(const host&, Visit&&) {}

    /// Every pair once, through bins of the reach.
    template <class Visit>
    static void for_each_near(const host& h, double radius_factor, Visit&& visit) {
        const auto& x = h.bed.positions();
        const double reach = radius_factor * 2 * h.bed.parcel_radius(), wide = h.bed.shaft_radius();
        const auto bin = [&](double value, double low, int count) {
            return std::min(count - 1, std::max(0, static_cast<int>((value - low) / reach)));
        };
        const int nx = static_cast<int>(2 * wide / reach) + 1, nz = static_cast<int>(h.bed.height() / reach) + 1;
        std::vector<std::vector<std::int32_t>> bins(static_cast<std::size_t>(nx * nx * nz));
        const auto place = [&](const std::array<double, 3>& at) {
            return std::array<int, 3>{bin(at[0], -wide, nx), bin(at[1], -wide, nx), bin(at[2], 0, nz)};
        };
        for (std::size_t i = 0; i < x.size(); ++i) {
            const auto b = place(x[i]);
            for (int k = std::max(0, b[2] - 1); k <= std::min(nz - 1, b[2] + 1); ++k) {
                for (int j = std::max(0, b[1] - 1); j <= std::min(nx - 1, b[1] + 1); ++j) {
                    for (int m = std::max(0, b[0] - 1); m <= std::min(nx - 1, b[0] + 1); ++m) {
                        for (const std::int32_t other : bins[static_cast<std::size_t>((k * nx + j) * nx + m)]) {
                            const auto& y = x[static_cast<std::size_t>(other)];
                            const double distance = std::hypot(x[i][0] - y[0], x[i][1] - y[1], x[i][2] - y[2]);
                            if (distance < reach) visit(other, static_cast<std::int32_t>(i), distance);
                        }
                    }
                }
            }
            bins[static_cast<std::size_t>((b[2] * nx + b[1]) * nx + b[0])].push_back(static_cast<std::int32_t>(i));
        }
    }

    template <class Visit>
    static void for_each_near_wall(const host& h, double radius_factor, Visit&& visit) {
        const auto& x = h.bed.positions();
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double distance = std::max(h.bed.parcel_radius(), h.bed.shaft_radius() - std::hypot(x[i][0], x[i][1]));
            if (distance < radius_factor * 2 * h.bed.parcel_radius()) visit(static_cast<std::int32_t>(i), h.ring(x[i][2]), distance);
        }
    }

    static double wall_temperature(const host& h, int patch) { return h.ring_temperature[static_cast<std::size_t>(patch)]; }
};
