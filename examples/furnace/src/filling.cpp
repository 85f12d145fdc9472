// SPDX-License-Identifier: MIT
#include "filling.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <hearth/core/reproducible_sum.hpp>
#include <hearth/dem/random.hpp>
#include <hearth/furnace/shaft_profile.hpp>

#include "flat.hpp"
#include "shaft_gas.hpp"

namespace hearth::furnace {

namespace {

constexpr double pi = 3.14159265358979323846, earth = 9.81;
constexpr double apart = 1.12,
                 above = 0.73;  // spacing of the start in a layer and of layers, over the largest diameter
constexpr int floor_wall = 0;
constexpr int stretch = 100;    // steps between two updates of feed, outflow and the gas's push
constexpr double starting = 1;  // parcels that the bed sinks by before it is recorded
constexpr double frames_a_diameter = 5;
constexpr double stiff =
    3.77e8;  // modulus at which the bed's weight makes overlaps that do not count [Pa]; the paper's

double volume(double radius) { return 4.0 / 3.0 * pi * radius * radius * radius; }

/// Sum over the parcels of all ranks, the same bits on any number of them.
template <class Term>
double sum_over(const dem::bed& bed, Term&& term) {
    double largest = 0;
    for (dem::index i = 0; i < bed.size(); ++i) largest = std::max(largest, std::abs(term(i)));
    reproducible_sum total(bed.among().max(largest), std::int64_t{1} << 36);
    for (dem::index i = 0; i < bed.size(); ++i) total.add(term(i));
    bed.among().sum(total.limbs(), reproducible_sum::limb_count());
    return total.value();
}

/// A plain value as the bytes that it is.
template <class Value>
std::vector<double> bits_of(const Value& value) {
    std::vector<char> bytes(sizeof(Value));
    std::memcpy(bytes.data(), &value, sizeof(Value));
    return to_numbers(bytes);
}
template <class Value>
Value value_of(const std::vector<double>& numbers) {
    const std::vector<char> bytes = to_bytes(numbers);
    if (bytes.size() != sizeof(Value)) throw bad_scene("the state of the filling is damaged");
    Value value;
    std::memcpy(&value, bytes.data(), sizeof(Value));
    return value;
}

}  // namespace

filling::filling(const settings& scene, const ranks& among)
    : scene_(scene),
      among_(among),
      largest_(sizes_of(scene).largest()),
      bed_(bed_settings_of(scene), {dem::over(among), 2}) {
    const double top = scene.shaft.height, shaft_radius = 0.5 * scene.shaft.diameter;
    dem::wall floor;
    floor.facets = dem::shape::plane({0, 0, -0.5 * largest_}, {0, 0, 1});
    floor.body = softened(scene);
    floor.contact = contact_of(scene);
    bed_.add_wall(floor);
    bed_.add_wall(shaft_wall(scene, 4 * top));
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
    set_gravity(weight());
}

void filling::advance() {
    switch (now_) {
        case stage::falling:
            bed_.advance(200);
            if (!at_rest()) return;
            if (scene_.bed.motion == bed_motion::recorded) return begin_motion();
            // Softened parcels lie deep in one another under the weight of 10 m, which costs void fraction that true
            // stones keep: under a twentieth of it they spring back.
            set_gravity(weight() / 20);
            now_ = stage::springing_back;
            return;
        case stage::springing_back:
            bed_.advance(200);
            if (!at_rest()) return;
            now_ = stage::done;
            return;
        case stage::starting:
            move();
            bed_.update_ghosts();
            recorder_->meet(bed_);
            if (outflow_->now().taken < sinking(starting)) return;
            cut(scene_.shaft.height);
            taken_ = outflow_->now().taken;
            recorder_->observe(bed_);
            now_ = stage::recording;
            return;
        case stage::recording:
            move();
            if (outflow_->now().taken - taken_ < sinking(1 / frames_a_diameter)) return;
            taken_ = outflow_->now().taken;
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
    const double fall = 0.002 * scene_.bed.coarse_graining * sauter_diameter(scene_) * earth * gravity_;
    const bool goes_on = scene_.bed.motion == bed_motion::recorded;  // to move: it need not quite rest
    return bed_.time() > 0.3 / std::sqrt(weight()) && energy / mass < (goes_on ? 20 * fall : fall);
}

/// A bed that is softer than the paper's falls and moves as the stiff one does under its full weight, by the same
/// numbers of Froude, v^2 / (g d), and of stiffness, E / (rho g H): gravity is less, and speed by its root.
double filling::weight() const { return std::min(1.0, scene_.bed.softened_modulus / stiff); }

void filling::set_gravity(double share) {
    gravity_ = share;
    bed_.set_gravity({0, 0, -earth * share});
}

void filling::begin_motion() {
    set_gravity(weight());
    cut(scene_.shaft.height + largest_);
    const double solid = sum_over(bed_, [&](dem::index i) {
        return bed_.spheres()[i].centre.z < scene_.shaft.height ? volume(bed_.spheres()[i].radius) : 0.0;
    });
    void_fraction_ = 1 - solid / (pi / 4 * scene_.shaft.diameter * scene_.shaft.diameter * scene_.shaft.height);
    make_motion();
    now_ = stage::starting;
}

void filling::make_motion() {
    const double shaft_radius = 0.5 * scene_.shaft.diameter,
                 flow = scene_.particles.mass_flow * scene_.bed.recording_acceleration_factor * std::sqrt(gravity_);
    dem::feed::settings f;
    f.where = {{0, 0, scene_.shaft.height + 2.5 * largest_}, shaft_radius, 6 * largest_};
    f.mass_flow = flow;
    f.density = scene_.particles.density;
    f.temperature = scene_.particles.feed_temperature;
    f.velocity = {0, 0, -std::sqrt(2 * earth * gravity_ * largest_)};
    f.seed = scene_.output.seed + 1;
    feed_.emplace(f, sizes_of(scene_));
    dem::outflow::settings o;
    o.floor = floor_wall;
    o.height = -0.5 * largest_;
    o.mass_flow = flow;
    outflow_.emplace(o);
    recorder_.emplace(dem::recording::settings{{{0, 0, 0}, shaft_radius, scene_.shaft.height}, 6, 20});
    // The gas carries a part of the bed's weight, above the burners the most.
    settings measured = scene_;
    measured.bed.void_fraction = void_fraction_;
    const std::vector<double> pressure = solve_shaft_profile(measured).pressure;
    const double dz = scene_.shaft.height / static_cast<double>(pressure.size());
    lift_.assign(pressure.size(), 0.0);
    for (std::size_t k = 0; k < pressure.size(); ++k) {
        const std::size_t low = k > 0 ? k - 1 : 0, high = std::min(k + 1, pressure.size() - 1);
        lift_[k] = high > low ? (pressure[low] - pressure[high]) / (dz * static_cast<double>(high - low)) : 0.0;
    }
}

void filling::push_by_gas() {
    // All of the pressure gradient acts on the solid.
    const double bed_over_solid = gravity_ / (1 - void_fraction_);
    for (dem::index i = 0; i < bed_.size(); ++i) {
        const dem::sphere& s = bed_.spheres()[i];
        const bool inside = s.centre.z < scene_.shaft.height;
        bed_.set_outer_force(
            i, {0, 0,
                inside ? bed_over_solid * volume(s.radius) * at_height(lift_, s.centre.z, scene_.shaft.height) : 0.0});
    }
}

void filling::move() {
    const double seconds = stretch * bed_.settings().step;
    push_by_gas();
    bed_.advance(stretch);
    feed_->update(bed_, seconds);
    outflow_->update(bed_, seconds);
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
    const bool moves = scene_.bed.motion == bed_motion::recorded;
    const double fall = moves ? 0.4 : 0.9, all = starting + scene_.bed.recorded_diameters;
    const double expected = (std::sqrt(2 * 0.3 * scene_.shaft.height / earth) + 0.5) /
                            std::sqrt(weight());  // the top falls by a quarter of the height, then rests
    switch (now_) {
        case stage::falling:
            return fall * std::min(1.0, bed_.time() / expected);
        case stage::springing_back:
            return fall;
        case stage::starting:
            return fall + (1 - fall) * std::min(1.0, outflow_->now().taken / sinking(all));
        case stage::recording:
            return std::min(1.0, fall + (1 - fall) * (sinking(starting) + recorder_->mass_left()) / sinking(all));
        case stage::done:
            break;
    }
    return 1;
}

std::unique_ptr<dem::moving_bed> filling::finished() const {
    if (recorder_) {
        return std::make_unique<dem::recorded_bed>(std::make_shared<const dem::recording>(recorder_->finish()),
                                                   surroundings_of(scene_), scene_.particles.mass_flow);
    }
    std::vector<dem::sphere> spheres;
    std::vector<double> masses;
    for (const dem::particle& p : parcels()) {
        if (p.position.z < 0 || p.position.z >= scene_.shaft.height) continue;
        spheres.push_back({p.position, p.radius});
        masses.push_back(p.density * volume(p.radius));
    }
    return bed_of(scene_, std::move(spheres), std::move(masses));
}

std::vector<dem::particle> filling::parcels() const {
    struct known {
        std::int64_t id;
        dem::sphere where;
    };
    std::vector<known> mine;
    for (dem::index i = 0; i < bed_.size(); ++i) mine.push_back({bed_.ids()[i], bed_.spheres()[i]});
    std::vector<known> all = among_.gather(mine);
    std::sort(all.begin(), all.end(), [](const known& a, const known& b) { return a.id < b.id; });
    std::vector<dem::particle> found(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
        found[k].position = all[k].where.centre;
        found[k].radius = all[k].where.radius;
        found[k].density = scene_.particles.density;
    }
    return found;
}

void filling::save(saved_state& into) const {
    into["filling/stage"] = {static_cast<double>(now_), gravity_, void_fraction_, taken_};
    into["filling/state"] = to_numbers(bed_.state());
    if (!feed_) return;
    into["filling/feed"] = bits_of(feed_->now());
    into["filling/outflow"] = bits_of(outflow_->now());
    into["filling/recorder"] = to_numbers(recorder_->state());
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
        read.feed_->restore(value_of<dem::feed::state>(find("filling/feed")));
        read.outflow_->restore(value_of<dem::outflow::state>(find("filling/outflow")));
        read.recorder_->restore(to_bytes(find("filling/recorder")));
    }
    // The parts of those that saved it, dealt out to those that there are.
    const std::vector<double>& all = find("filling/state");
    std::vector<std::vector<char>> mine;
    int part = 0;
    for (std::size_t at = 0; at < all.size(); ++part) {
        const double bytes = std::ceil(all[at] / sizeof(double));
        if (!(bytes >= 0 && bytes < static_cast<double>(all.size() - at))) throw bad_scene("the state of the filling is damaged");
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(at), last = first + 1 + static_cast<std::ptrdiff_t>(bytes);
        if (part % among_.size() == among_.rank()) mine.push_back(to_bytes({first, last}));
        at += 1 + static_cast<std::size_t>(bytes);
    }
    read.bed_.restore_parts(mine);
    *this = std::move(read);
}

}  // namespace hearth::furnace
