// SPDX-License-Identifier: MIT
#include "filling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <hearth/dem/random.hpp>

#include "driven_bed.hpp"
#include "flat.hpp"
#include "shaft_bed.hpp"

namespace hearth::furnace {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double apart = 1.12,
                 above = 0.73;  // spacing of the start in a layer and of layers, over the largest diameter
constexpr double starting = 1;  // parcels that the bed sinks by before it is recorded, or handed over
constexpr double frames_a_diameter = 5;

double volume(double radius) { return 4.0 / 3.0 * pi * radius * radius * radius; }

}  // namespace

filling::filling(const settings& scene, const ranks& among)
    : scene_(scene), among_(among), largest_(sizes_of(scene).largest()), bed_(empty_shaft(scene, among)) {
    const double top = scene.shaft.height, shaft_radius = 0.5 * scene.shaft.diameter;
    // Loose layers, every second one shifted by half a spacing, too unstable to remain; more than enough to fill what
    // is modelled.  Those above one another are at least 1.04 apart, less twice the jitter.
    const double spacing = apart * largest_;
    const dem::size_distribution sizes = sizes_of(scene);
    dem::random_source random{scene.output.seed};
    const double wanted = 0.65 * pi * shaft_radius * shaft_radius * (top + largest_);
    std::vector<dem::particle> start;
    const auto across = static_cast<int>(shaft_radius / spacing) + 1;
    double filled = 0;
    for (int k = 0; filled < wanted; ++k) {
        const double shift = k % 2 == 0 ? 0 : 0.5;
        for (int j = -across; j <= across; ++j) {
            for (int i = -across; i <= across; ++i) {
                const auto jitter = [&] { return largest_ * random.uniform(-0.04, 0.04); };
                dem::particle p;
                p.radius = 0.5 * sizes.draw(random);
                p.density = scene.particles.density;
                p.temperature = scene.particles.feed_temperature;
                p.position = {(i + shift) * spacing + jitter(), (j + shift) * spacing + jitter(),
                              k * above * largest_ + jitter()};
                if (std::hypot(p.position.x, p.position.y) + p.radius > shaft_radius) continue;
                filled += volume(p.radius);
                start.push_back(p);
            }
        }
    }
    bed_.insert(start);
    set_gravity(weight_of(scene_));
}

void filling::advance() {
    switch (now_) {
        case stage::falling:
            bed_.advance(200);
            if (!at_rest()) return;
            if (goes_on()) return begin_motion();
            // Softened parcels lie deep in one another under the weight of 10 m, which costs void fraction that true
            // stones keep: under a twentieth of it they spring back.
            set_gravity(weight_of(scene_) / 20);
            now_ = stage::springing_back;
            return;
        case stage::springing_back:
            bed_.advance(200);
            if (!at_rest()) return;
            now_ = stage::done;
            return;
        case stage::starting:
            motion_->advance(bed_, driven_motion::stretch);
            if (recorder_) {
                bed_.update_ghosts();
                recorder_->meet(bed_);
            }
            if (motion_->taken() < sinking(starting)) return;
            cut(scene_.shaft.height);
            if (!recorder_) {
                now_ = stage::done;
                return;
            }
            taken_ = motion_->taken();
            recorder_->observe(bed_);
            now_ = stage::recording;
            return;
        case stage::recording:
            motion_->advance(bed_, driven_motion::stretch);
            if (motion_->taken() - taken_ < sinking(1 / frames_a_diameter)) return;
            taken_ = motion_->taken();
            recorder_->observe(bed_);
            if (recorder_->mass_left() >= sinking(scene_.bed.recorded_diameters)) now_ = stage::done;
            return;
        case stage::done:
            return;
    }
}

/// At rest: slower, at the mean of all, than a fall by a five-hundredth of a diameter makes; the column still rings a
/// little.
bool filling::at_rest() const {
    const double energy = sum_over(bed_, [&](dem::index i) {
        return 0.5 * bed_.mass(i) * dot(bed_.motions()[i].velocity, bed_.motions()[i].velocity);
    });
    const double mass = sum_over(bed_, [&](dem::index i) { return bed_.mass(i); });
    const double fall = 0.002 * scene_.bed.coarse_graining * sauter_diameter(scene_) * gravity_of_earth * gravity_;
    // A bed that is to move need not quite rest.
    return bed_.time() > 0.3 / std::sqrt(weight_of(scene_)) && energy / mass < (goes_on() ? 20 * fall : fall);
}

bool filling::goes_on() const {
    return scene_.bed.motion == bed_motion::recorded || scene_.bed.motion == bed_motion::dem;
}

void filling::set_gravity(double share) {
    gravity_ = share;
    set_weight(bed_, share);
}

void filling::begin_motion() {
    set_gravity(weight_of(scene_));
    cut(scene_.shaft.height + largest_);
    const double solid = sum_over(bed_, [&](dem::index i) {
        return bed_.spheres()[i].centre.z < scene_.shaft.height ? volume(bed_.spheres()[i].radius) : 0.0;
    });
    void_fraction_ = 1 - solid / (pi / 4 * scene_.shaft.diameter * scene_.shaft.diameter * scene_.shaft.height);
    make_motion();
    now_ = stage::starting;
}

void filling::make_motion() {
    motion_.emplace(scene_, void_fraction_);
    if (scene_.bed.motion != bed_motion::recorded) return;
    recorder_.emplace(dem::recording::settings{{{0, 0, 0}, 0.5 * scene_.shaft.diameter, scene_.shaft.height}, 6, 20});
}

/// Takes away what lies above a level; not what still falls.
void filling::cut(double level) {
    bed_.update_ghosts();
    const std::vector<int> contacts = bed_.contact_counts();
    std::vector<dem::index> above;
    for (dem::index i = 0; i < bed_.size(); ++i) {
        if (bed_.spheres()[i].centre.z >= level &&
            (now_ == stage::falling || contacts[static_cast<std::size_t>(i)] >= 2))
            above.push_back(i);
    }
    if (among_.any(!above.empty())) bed_.remove(above);
}

double filling::sinking(double diameters) const {
    const double section = pi / 4 * scene_.shaft.diameter * scene_.shaft.diameter;
    return diameters * largest_ * section * (1 - void_fraction_) * scene_.particles.density;
}

double filling::level() const {
    if (now_ != stage::falling) return scene_.shaft.height;
    const std::vector<int> contacts = bed_.contact_counts();
    const double settled = sum_over(bed_, [&](dem::index i) {
        return contacts[static_cast<std::size_t>(i)] >= 3 ? volume(bed_.spheres()[i].radius) : 0.0;
    });
    const double section = pi / 4 * scene_.shaft.diameter * scene_.shaft.diameter;
    return std::min(settled / (0.59 * section), scene_.shaft.height);
}

double filling::share() const {
    const double fall = goes_on() ? 0.4 : 0.9;
    const double all = starting + (scene_.bed.motion == bed_motion::recorded ? scene_.bed.recorded_diameters : 0.0);
    const double expected = (std::sqrt(2 * 0.3 * scene_.shaft.height / gravity_of_earth) + 0.5) /
                            std::sqrt(weight_of(scene_));  // the top falls by a quarter of the height, then rests
    switch (now_) {
        case stage::falling:
            return fall * std::min(1.0, bed_.time() / expected);
        case stage::springing_back:
            return fall;
        case stage::starting:
            return fall + (1 - fall) * std::min(1.0, motion_->taken() / sinking(all));
        case stage::recording:
            return std::min(1.0, fall + (1 - fall) * (sinking(starting) + recorder_->mass_left()) / sinking(all));
        case stage::done:
            break;
    }
    return 1;
}

std::unique_ptr<dem::moving_bed> filling::finished() {
    if (recorder_) {
        return std::make_unique<dem::recorded_bed>(std::make_shared<const dem::recording>(recorder_->finish()),
                                                   surroundings_of(scene_), scene_.particles.mass_flow);
    }
    if (motion_) {
        return std::make_unique<driven_bed>(scene_, among_, std::move(bed_), std::move(*motion_), void_fraction_);
    }
    std::vector<dem::sphere> spheres;
    std::vector<double> masses;
    for (const parcel_of_shaft& p : all_parcels(bed_, among_)) {
        if (p.where.centre.z < 0 || p.where.centre.z >= scene_.shaft.height) continue;
        spheres.push_back(p.where);
        masses.push_back(p.mass);
    }
    return bed_of(scene_, std::move(spheres), std::move(masses));
}

std::vector<dem::sphere> filling::parcels() const {
    std::vector<dem::sphere> found;
    for (const parcel_of_shaft& p : all_parcels(bed_, among_)) found.push_back(p.where);
    return found;
}

void filling::save(saved_state& into) const {
    into["filling/stage"] = {static_cast<double>(now_), gravity_, void_fraction_, taken_};
    into["filling/state"] = to_numbers(bed_.state());
    if (motion_) motion_->save(into, "filling");
    if (recorder_) into["filling/recorder"] = to_numbers(recorder_->state());
}

void filling::restore(const saved_state& from) {
    const auto find = [&](const char* name) -> const std::vector<double>& {
        const auto found = from.find(name);
        if (found == from.end()) throw bad_scene(std::string("the state lacks ") + name);
        return found->second;
    };
    const std::vector<double>& numbers = find("filling/stage");
    if (numbers.size() != 4) throw bad_scene("the state of the filling is damaged");
    filling read(scene_, among_);  // so that this one stays as it is if something is wrong
    read.now_ = static_cast<stage>(numbers[0]);
    read.set_gravity(numbers[1]);
    read.void_fraction_ = numbers[2];
    read.taken_ = numbers[3];
    if (read.now_ == stage::starting || read.now_ == stage::recording) {
        read.make_motion();
        read.motion_->restore(from, "filling");
        if (read.recorder_) read.recorder_->restore(to_bytes(find("filling/recorder")));
    }
    restore_parts(read.bed_, find("filling/state"), among_);
    *this = std::move(read);
}

}  // namespace hearth::furnace
