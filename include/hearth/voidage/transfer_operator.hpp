// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include <hearth/core/agree.hpp>
#include <hearth/core/cell_locator.hpp>
#include <hearth/core/element.hpp>
#include <hearth/core/error.hpp>
#include <hearth/voidage/deposit.hpp>
#include <hearth/voidage/filtered_fraction_settings.hpp>
#include <hearth/voidage/footprints.hpp>
#include <hearth/voidage/kernel_smoother.hpp>
#include <hearth/voidage/vfs.hpp>

namespace hearth {

/// The map from particles to cells that makes the solid fraction, kept: what it did to volume it does to any other
/// property of the particles (momentum, heat, species sources), and transposed it gives the gas as the particles see
/// it.
///
/// In matrix form  W = L V S V^-1 D^T : D the footprints of the deposit (ramp), S the kernel smoother, V the cell
/// volumes, L the record of the cap.  Each column of W sums to 1: cell c receives the share W_cp of what particle p
/// gives off.
///   scatter:  f_c = sum_p W_cp F_p      extensive values: sources a particle [N, W, kg/s] become sources a cell
///   gather:   u_p = sum_c W_cp u_c      intensive values: the mean of the gas over the particle's shares
/// They are exact transposes, so  sum_c f_c u_c = sum_p F_p u_p : the power that the particles exert on the gas they
/// see is the power that the gas receives.  Sums of sources are kept, and constants are seen as constants.
///
/// distribute() or distribute_like() sets the map; between two calls it belongs to the particles of the first, in their
/// order.  Results are bitwise independent of the number of ranks and of storage order.
///
/// The footprints take 8 bytes an entry, the smoother two work vectors, the cap its record.  Keeps a reference to the
/// locator, and through it to graph and mesh.  One object serves one thread at a time.
template <class Mesh, class Communicator = serial_communicator>
class transfer_operator {
  public:
    using locator_type = cell_locator<Mesh, Communicator>;

    /// Errors: bad_value for a threshold outside (0, 1]; the other settings are checked when they are used.
    explicit transfer_operator(const locator_type& locator, filtered_fraction_settings settings = {})
        : locator_(&locator), settings_(settings), cap_(locator.graph(), vfs_settings{settings.threshold}) {}

    /// Makes the map for these particles, and with it their solid fraction [-] in every owned cell.
    /// Errors, with field and map as they were, on all ranks: those of footprints for bad particles; infeasible_volume
    /// where they do not fit under the threshold; bad_value for bad settings; stale_graph.
    template <class Cloud, class Field, class Policy = deposit::ramp>
    filtered_fraction_report distribute(const Cloud& cloud, Field& solid_fraction, const Policy& policy = {}) {
        graph().require_current();
        footprints_.reset();
        return make_map(std::make_shared<const footprints<Communicator>>(*locator_, cloud, policy), solid_fraction);
    }

    /// The same for the particles that another operator of this locator has its map of, where two kernels are wanted of
    /// the same particles: their footprints, which take most of the time to make and to store, are shared.
    /// Errors as distribute; std::logic_error if the other one has no map or another locator.
    template <class Field>
    filtered_fraction_report distribute_like(const transfer_operator& other, Field& solid_fraction) {
        graph().require_current();
        other.require_map();
        if (other.locator_ != locator_) {
            throw std::logic_error("hearth: transfer_operator: the other one has another locator");
        }
        auto particles = other.footprints_;
        footprints_.reset();
        return make_map(std::move(particles), solid_fraction);
    }

    /// How often distribute() has made a map; 0: never.
    std::uint64_t revision() const { return revision_; }
    const locator_type& locator() const { return *locator_; }
    /// What this rank holds, graph and locator aside; footprints that are shared count with each [bytes].
    std::size_t memory() const {
        return cells_.capacity() * sizeof(double) + cap_.memory() + cap_.log_memory() +
               (smoother_ ? smoother_->memory() : 0) + (footprints_ ? footprints_->memory() : 0);
    }

    /// The shares of one particle, by its id: the cells of this rank that get any, and what each gets of 1.  Called on
    /// all ranks.  As dear as scatter.
    std::vector<std::pair<std::int32_t, double>> footprint(std::int64_t id) {
        require_map();
        const auto& visitors = footprints_->visitors();
        std::vector<double> at_visitors(visitors.size(), 0.0);
        for (std::size_t k = 0; k < visitors.size(); ++k) {
            if (visitors[k].id == id) at_visitors[k] = 1;
        }
        spread(at_visitors);
        std::vector<std::pair<std::int32_t, double>> shares;
        for (std::int32_t c = 0; c < graph().cell_count(); ++c) {
            const double share = cells_[static_cast<std::size_t>(c)];
            if (share != 0) shares.emplace_back(c, share);
        }
        return shares;
    }

    /// Sets cells[c], c an owned cell, to what the particles give it: one number or three for each particle and cell,
    /// in any unit that adds up. Errors, on all ranks: bad_value for values that are not finite, std::logic_error
    /// before distribute(), stale_graph.
    template <class ParticleValues, class CellValues>
    void scatter(const ParticleValues& particles, CellValues& cells) {
        require_map();
        const auto& visitors = footprints_->visitors();
        std::vector<std::vector<double>> result;
        for (std::size_t a = 0; a < component_count<ParticleValues>; ++a) {
            std::vector<double> values;
            std::optional<bad_value> wrong;
            for (std::size_t i = 0; i < visitors.owned_count(); ++i) {
                values.push_back(component(element(particles, i), a));
                if (!std::isfinite(values.back()) && !wrong) {
                    wrong.emplace("value of particle", visitors.owned(i).id, values.back(), "finite");
                }
            }
            throw_agreed(graph().communicator(), wrong);
            spread(visitors.bring(values));
            result.push_back(cells_);
        }
        write(result, cells, static_cast<std::size_t>(graph().cell_count()));
    }

    /// Sets particles[p], p an owned particle, to the mean of the cells' values over its shares.
    /// Errors: as scatter.
    template <class CellValues, class ParticleValues>
    void gather(const CellValues& cells, ParticleValues& particles) {
        require_map();
        std::vector<std::vector<double>> result;
        for (std::size_t a = 0; a < component_count<CellValues>; ++a) {
            std::optional<bad_value> wrong;
            for (std::int32_t c = 0; c < graph().cell_count(); ++c) {
                const double value = cells_[static_cast<std::size_t>(c)] = component(element(cells, c), a);
                if (!std::isfinite(value) && !wrong)
                    wrong.emplace("value of cell", graph().global_index(c), value, "finite");
            }
            throw_agreed(graph().communicator(), wrong);
            cap_.gather(cells_);
            const smoothing_report smoothed = smoother_->smooth(cells_);
            result.push_back(footprints_->gather(cells_.data(), std::max(-smoothed.lowest, smoothed.highest)));
        }
        write(result, particles, footprints_->visitors().owned_count());
    }

  private:
    template <class Values>
    using value = std::decay_t<decltype(element(std::declval<Values&>(), 0))>;
    template <class Values>
    static constexpr std::size_t component_count = std::is_arithmetic_v<value<Values>> ? 1 : 3;

    const cell_graph<Communicator>& graph() const { return locator_->graph(); }

    template <class Field>
    filtered_fraction_report make_map(std::shared_ptr<const footprints<Communicator>> particles,
                                      Field& solid_fraction) {
        filtered_fraction_report report;
        const deposit_report deposited = count_particles(particles->visitors());
        report.particles = deposited.particles;
        report.solid_volume = deposited.solid_volume;
        report.width = settings_.width ? *settings_.width : mean_radius(particles->visitors());
        const std::vector<double> volumes = solid_volumes(*particles, graph().cell_count());
        smooth(volumes, report);
        report.capped_volume = volume_above_threshold(report.smoothed_maximum);
        report.cap = cap_.smooth(cells_);
        report.maximum = report.cap.maximum;

        for (std::int32_t c = 0; c < graph().cell_count(); ++c) {
            element(solid_fraction, c) = static_cast<value<Field>>(cells_[static_cast<std::size_t>(c)]);
        }
        footprints_ = std::move(particles);
        ++revision_;
        return report;
    }

    void require_map() const {
        graph().require_current();
        if (!footprints_) throw std::logic_error("hearth: transfer_operator has no map; call distribute() first");
    }

    template <class Value>
    static double component(const Value& v, std::size_t a) {
        if constexpr (std::is_arithmetic_v<Value>) {
            return static_cast<double>(v);
        } else {
            return static_cast<double>(element(v, a));
        }
    }

    template <class Values>
    static void write(const std::vector<std::vector<double>>& components, Values& values, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            auto&& target = element(values, i);
            if constexpr (component_count<Values> == 1) {
                target = static_cast<value<Values>>(components[0][i]);
            } else {
                for (std::size_t a = 0; a < 3; ++a) {
                    auto&& along = element(target, a);
                    along = static_cast<std::decay_t<decltype(along)>>(components[a][i]);
                }
            }
        }
    }

    /// Smooths the deposited volumes into cells_ [-], with a series so tight that no cell falls below zero by more than
    /// round-off, where the usual one does (see kernel_smoother).
    void smooth(const std::vector<double>& volumes, filtered_fraction_report& report) {
        const auto load = [&] {
            cells_.resize(volumes.size());
            for (std::size_t c = 0; c < volumes.size(); ++c) {
                cells_[c] = volumes[c] / graph().volume(static_cast<std::int32_t>(c));
            }
        };
        load();
        for (const double fraction : cells_) report.deposited_maximum = std::max(report.deposited_maximum, fraction);
        report.deposited_maximum = graph().communicator().max(report.deposited_maximum);

        if (!smoother_ || smoother_->width() != report.width || smoother_->tolerance() != settings_.tolerance) {
            smoother_.emplace(graph(), report.width, kernel_settings{settings_.tolerance});
        }
        smoothing_report smoothed = smoother_->smooth(cells_);
        if (smoothed.lowest < 0) {
            report.tightened = true;
            smoother_.emplace(graph(), report.width, kernel_settings{1e-16});
            load();
            smoothed = smoother_->smooth(cells_);
            zero_negatives(report);
        }
        report.terms = smoothed.terms;
        report.smoothed_maximum = std::max(smoothed.highest, 0.0);
    }

    void zero_negatives(filtered_fraction_report& report) {
        reproducible_sum volume(locator_->largest_volume(), std::int64_t{1} << 36);
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            if (cells_[c] >= 0) continue;
            ++report.zeroed_cells;
            volume.add(-cells_[c] * graph().volume(static_cast<std::int32_t>(c)));
            cells_[c] = 0;
        }
        graph().communicator().sum(&report.zeroed_cells, 1);
        graph().communicator().sum(volume.limbs(), reproducible_sum::limb_count());
        report.zeroed_volume = volume.value();
    }

    double volume_above_threshold(double highest) const {
        if (!(highest > settings_.threshold)) return 0;
        reproducible_sum volume(highest * locator_->largest_volume(), std::int64_t{1} << 36);
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            const double excess = cells_[c] - settings_.threshold;
            if (excess > 0) volume.add(excess * graph().volume(static_cast<std::int32_t>(c)));
        }
        graph().communicator().sum(volume.limbs(), reproducible_sum::limb_count());
        return volume.value();
    }

    /// W on one value for each visitor; the result stays in cells_.
    void spread(const std::vector<double>& at_visitors) {
        std::fill(cells_.begin(), cells_.end(), 0.0);
        footprints_->scatter(at_visitors, cells_.data());
        for (std::int32_t c = 0; c < graph().cell_count(); ++c)
            cells_[static_cast<std::size_t>(c)] /= graph().volume(c);
        smoother_->smooth(cells_);
        for (std::int32_t c = 0; c < graph().cell_count(); ++c)
            cells_[static_cast<std::size_t>(c)] *= graph().volume(c);
        cap_.scatter(cells_);
    }

    const locator_type* locator_;
    filtered_fraction_settings settings_;
    std::shared_ptr<const footprints<Communicator>> footprints_;
    std::optional<kernel_smoother<Communicator>> smoother_;
    volume_fraction_smoother<cell_graph<Communicator>> cap_;
    std::vector<double> cells_;  // one value for each owned cell, between the steps
    std::uint64_t revision_ = 0;
};

}  // namespace hearth
