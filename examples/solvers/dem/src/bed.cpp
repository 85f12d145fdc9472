// SPDX-License-Identifier: MIT
#include <hearth/dem/bed.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include <hearth/core/agree.hpp>
#include <hearth/core/assert.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/core/error.hpp>

#include "archive.hpp"
#include "check.hpp"
#include "implementation.hpp"

namespace hearth::dem {
namespace {

using detail::check;

/// Refuses particles that differ from rank to rank.
void require_same(const ranks& among, const std::vector<particle>& added) {
    if (among.size() == 1) return;
    detail::writer archive;
    for (const particle& p : added) archive(p);
    const auto sum = static_cast<std::int64_t>(detail::checksum(archive.out.data(), archive.out.size()) >> 1);
    check(among.max(sum) == -among.max(-sum), "number of particles to insert", static_cast<double>(added.size()),
          "the same particles on every rank");
}

double sphere_volume(double radius) { return 4.0 / 3.0 * constants<double>::pi() * radius * radius * radius; }

}  // namespace

bed::implementation::implementation(const bed_settings& s, const decomposition& spread)
    : settings(s),
      among(spread.among),
      shared(among->size() > 1),
      near_factor(spread.near_factor),
      slabs(spread),
      ghosts(spread),
      law(contact_law::between_particles(s.body, s.contact)),
      rolling(s.contact.rolling_friction > 0) {}

bed::bed(const bed_settings& settings, const decomposition& spread) {
    check(settings.step > 0 && std::isfinite(settings.step), "step", settings.step, "finite and > 0 [s]");
    check(is_finite(settings.gravity), "gravity", norm(settings.gravity), "finite [m/s^2]");
    check(settings.skin > 0 && std::isfinite(settings.skin), "skin", settings.skin, "finite and > 0 [-]");
    check(settings.deepest_overlap > 0 && settings.deepest_overlap < 1, "deepest_overlap", settings.deepest_overlap,
          "in (0, 1) [-]");
    check(spread.near_factor >= 0 && std::isfinite(spread.near_factor), "near_factor", spread.near_factor,
          "finite and >= 0 [-]");
    self_ = std::make_unique<implementation>(settings, spread);
}
bed::~bed() = default;
bed::bed(bed&&) noexcept = default;
bed& bed::operator=(bed&&) noexcept = default;

int bed::add_wall(wall w) {
    const contact_law law = contact_law::with_wall(self_->settings.body, w.body, w.contact);
    check(!w.facets.empty(), "number of facets of wall", 0.0, "> 0");
    check(w.temperature > 0 && std::isfinite(w.temperature), "temperature of wall", w.temperature, "finite and > 0 [K]");
    for (const auto& other : self_->walls) {
        check(other.body.patch != w.patch || other.body.temperature == w.temperature, "temperature of wall", w.temperature,
              "that of the other walls of its patch [K]", w.patch);
    }
    std::int64_t id = -1;
    for (const auto& other : self_->walls) id -= static_cast<std::int64_t>(other.body.facets.size());
    detail::wall_list list{};
    list.body = std::move(w);
    list.law = law;
    list.first_id = id;
    // Springs of rolling are kept for all contacts or for none.
    self_->rolling = self_->rolling || law.settings.rolling_friction > 0;
    self_->walls.push_back(std::move(list));
    self_->listed = self_->loaded = false;
    return static_cast<int>(self_->walls.size()) - 1;
}

void bed::set_motion(int wall_number, const wall_motion& motion) {
    check(is_finite(motion.velocity) && is_finite(motion.spin) && is_finite(motion.pivot), "motion of wall",
          norm(motion.velocity), "finite", wall_number);
    self_->walls.at(static_cast<std::size_t>(wall_number)).body.motion = motion;
}
void bed::set_wall_open(int wall_number, bool open) {
    auto& w = self_->walls.at(static_cast<std::size_t>(wall_number));
    if (w.open == open) return;
    w.open = open;
    self_->listed = self_->loaded = false;
}
bool bed::wall_open(int n) const { return self_->walls.at(static_cast<std::size_t>(n)).open; }
void bed::set_patch_temperature(int patch, double kelvin) {
    check(kelvin > 0 && std::isfinite(kelvin), "temperature of patch", kelvin, "finite and > 0 [K]", patch);
    patch_temperature(patch);  // there must be one
    for (auto& w : self_->walls)
        if (w.body.patch == patch) w.body.temperature = kelvin;
}
double bed::patch_temperature(int patch) const {
    for (const auto& w : self_->walls)
        if (w.body.patch == patch) return w.body.temperature;
    throw bad_value("patch", bad_value::no_index, patch, "that of a wall");
}
const wall& bed::wall_at(int n) const { return self_->walls.at(static_cast<std::size_t>(n)).body; }
int bed::wall_count() const { return static_cast<int>(self_->walls.size()); }
vector3 bed::force_on_wall(int n) const {
    vector3 sum;
    for (const vector3& part : self_->among->gather(std::vector<vector3>{self_->walls.at(static_cast<std::size_t>(n)).reaction}))
        sum += part;
    return sum;
}
const contact_law& bed::wall_law(int n) const { return self_->walls.at(static_cast<std::size_t>(n)).law; }
const contact_law& bed::law() const { return self_->law; }

std::int64_t bed::insert(const std::vector<particle>& added) {
    for (std::size_t k = 0; k < added.size(); ++k) {
        const particle& p = added[k];
        const auto at = static_cast<std::int64_t>(k);
        check(p.radius > 0 && std::isfinite(p.radius), "radius of particle", p.radius, "finite and > 0 [m]", at);
        check(p.density > 0 && std::isfinite(p.density), "density of particle", p.density, "finite and > 0 [kg/m^3]", at);
        check(is_finite(p.position), "position of particle", norm(p.position), "finite [m]", at);
        check(is_finite(p.velocity), "velocity of particle", norm(p.velocity), "finite [m/s]", at);
        check(is_finite(p.spin), "spin of particle", norm(p.spin), "finite [rad/s]", at);
        check(p.temperature > 0 && std::isfinite(p.temperature), "temperature of particle", p.temperature,
              "finite and > 0 [K]", at);
    }
    implementation& self = *self_;
    require_same(*self.among, added);
    const std::int64_t first = self.next_id;
    if (added.empty()) return first;
    detail::store& all = self.particles;
    detail::history past = self.remember(self.shared);
    all.drop_ghosts();
    std::vector<std::size_t> mine;
    for (std::size_t k = 0; k < added.size(); ++k)
        if (!self.shared || self.slabs.is_mine(added[k].position)) mine.push_back(k);
    std::size_t i = all.owned;
    all.owned += mine.size();
    all.resize(all.owned);
    for (const std::size_t k : mine) {
        const particle& p = added[k];
        const double mass = p.density * sphere_volume(p.radius);
        all.spheres[i] = {p.position, p.radius};
        all.motions[i] = {p.velocity, 1 / mass, p.spin, 1 / (0.4 * mass * p.radius * p.radius)};
        all.ids[i] = first + static_cast<std::int64_t>(k);
        all.temperatures[i] = p.temperature;
        past.append({}, {});
        ++i;
    }
    self.rebuild(std::move(past), self.everyone());
    self.find_deep(first);
    try {
        self.raise_failure();
    } catch (const motion_error&) {
        std::vector<index> kept;
        for (std::size_t i = 0; i < all.owned; ++i)
            if (all.ids[i] < first) kept.push_back(static_cast<index>(i));
        self.rebuild(self.remember(self.shared), std::move(kept));
        throw;
    }
    self.next_id += static_cast<std::int64_t>(added.size());
    self.loaded = false;
    return first;
}

void bed::remove(const std::vector<index>& indices) {
    implementation& self = *self_;
    std::vector<char> gone(self.particles.owned, 0);
    std::optional<bad_value> bad;
    for (const index i : indices) {
        if (i >= 0 && i < size()) gone[static_cast<std::size_t>(i)] = 1;
        else bad = bad_value("index of particle to remove", bad_value::no_index, i, "0 <= index < size()");
    }
    throw_agreed(*self.among, bad);
    std::vector<index> kept;
    for (index i = 0; i < size(); ++i)
        if (!gone[static_cast<std::size_t>(i)]) kept.push_back(i);
    self.rebuild(self.remember(self.shared), std::move(kept));
    self.loaded = false;
}

void bed::advance(int count) {
    check(count >= 0, "number of steps", count, ">= 0");
    if (count == 0) return;
    implementation& self = *self_;
    if (!self.loaded) {
        if (!self.listed) self.rebuild(self.remember(self.shared), self.everyone());
        self.clear_loads();
        if (self.shared) {  // who knows what was set since
            self.ghosts.begin_motion(self.particles);
            self.ghosts.end_motion(self.particles);
        }
        self.add_forces(0.0);
        self.loaded = true;
    }
    for (int k = 0; k < count; ++k) self.step_once(k == 0);
    if (self.shared) self.raise_failure();
    self.move<implementation::kick::last>();
}

double bed::time() const { return static_cast<double>(self_->steps) * self_->settings.step; }
std::int64_t bed::steps() const { return self_->steps; }
const bed_settings& bed::settings() const { return self_->settings; }
void bed::set_gravity(const vector3& gravity) {
    check(is_finite(gravity), "gravity", norm(gravity), "finite [m/s^2]");
    self_->settings.gravity = gravity;
}

ranks& bed::among() const { return *self_->among; }
bool bed::is_shared() const { return self_->shared; }
std::int64_t bed::size_over_ranks() const { return self_->everybody; }
double bed::largest_radius() const { return self_->largest_radius; }
index bed::ghost_count() const { return static_cast<index>(self_->particles.total() - self_->particles.owned); }
int bed::ghost_owner(index i) const { return self_->ghosts.owners()[static_cast<std::size_t>(i - size())]; }
void bed::update_ghosts() {
    if (self_->shared) self_->ghosts.update(self_->particles);
}

index bed::size() const { return static_cast<index>(self_->particles.owned); }
const sphere* bed::spheres() const { return self_->particles.spheres.data(); }
const motion* bed::motions() const { return self_->particles.motions.data(); }
const load* bed::loads() const { return self_->particles.loads.data(); }
const std::int64_t* bed::ids() const { return self_->particles.ids.data(); }
double bed::mass(index i) const { return 1 / std::fabs(motions()[i].inverse_mass); }
double* bed::temperatures() { return self_->particles.temperatures.data(); }
const double* bed::temperatures() const { return self_->particles.temperatures.data(); }

void bed::set_velocity(index i, const vector3& velocity, const vector3& spin) {
    HEARTH_ASSERT(i >= 0 && i < size());
    check(is_finite(velocity) && is_finite(spin), "velocity or spin of particle", norm(velocity), "finite", i);
    motion& m = self_->particles.motions[static_cast<std::size_t>(i)];
    m.velocity = velocity;
    m.spin = spin;
}

void bed::set_mass(index i, double kg) {
    HEARTH_ASSERT(i >= 0 && i < size());
    check(kg > 0 && std::isfinite(kg), "mass of particle", kg, "finite and > 0 [kg]", i);
    const double radius = spheres()[i].radius;
    motion& m = self_->particles.motions[static_cast<std::size_t>(i)];
    m.inverse_mass = std::copysign(1 / kg, m.inverse_mass);
    m.inverse_inertia = 1 / (0.4 * kg * radius * radius);
}

void bed::set_driven(index i, bool driven) {
    HEARTH_ASSERT(i >= 0 && i < size());
    double& inverse_mass = self_->particles.motions[static_cast<std::size_t>(i)].inverse_mass;
    inverse_mass = std::copysign(inverse_mass, driven ? -1.0 : 1.0);
}

void bed::set_outer_force(index i, const vector3& force) {
    HEARTH_ASSERT(i >= 0 && i < size());
    check(is_finite(force), "outer force on particle", norm(force), "finite [N]", i);
    auto& all = self_->particles;
    if (!all.pushed) all.outer_forces.assign(all.total(), {});
    all.pushed = true;
    const auto at = static_cast<std::size_t>(i);
    all.loads[at].force += force - all.outer_forces[at];
    all.outer_forces[at] = force;
}

std::uint64_t bed::revision() const { return self_->revision; }
std::int64_t bed::rebuilds() const { return self_->rebuilds; }
void bed::expire_lists() { self_->listed = false; }

std::size_t bed::memory() const {
    std::size_t bytes = self_->particles.bytes() + self_->pairs.bytes() + self_->ghosts.bytes();
    for (const auto& w : self_->walls) {
        bytes += w.candidates.capacity() * sizeof(w.candidates[0]) +
                 (w.springs.capacity() + w.rolls.capacity()) * sizeof(vector3);
    }
    return bytes;
}

const std::vector<bed::pair>& bed::candidate_pairs() const { return self_->pairs.pairs; }
std::vector<bed::touch> bed::wall_touches() const {
    std::vector<touch> all;
    std::vector<detail::wall_list::touch> found;
    for (std::size_t w = 0; w < self_->walls.size(); ++w) {
        found.clear();
        self_->walls[w].find_touches(spheres(), found);
        for (const auto& t : found) {
            const index i = self_->walls[w].candidates[t.candidate].particle;
            all.push_back({i, static_cast<int>(w), spheres()[i].radius - std::sqrt(t.squared_distance), t.foot});
        }
    }
    return all;
}

double bed::advised_step(double speed, double steps_per_contact) const {
    check(speed > 0 && std::isfinite(speed), "speed", speed, "finite and > 0 [m/s]");
    check(steps_per_contact > 0, "steps_per_contact", steps_per_contact, "> 0 [-]");
    double shortest = std::numeric_limits<double>::infinity();
    for (index i = 0; i < size(); ++i) {
        const double radius = spheres()[i].radius, m = mass(i);
        shortest = std::fmin(shortest, hertz_impact{radius / 2, m / 2, self_->law.effective_modulus, speed}.duration());
        for (const auto& w : self_->walls) {
            shortest = std::fmin(shortest, hertz_impact{radius, m, w.law.effective_modulus, speed}.duration());
        }
    }
    return self_->among->min(shortest) / steps_per_contact;
}

}  // namespace hearth::dem
