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
#include <hearth/voidage/columns.hpp>
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
        return cells_.capacity() * sizeof(double) + cells_of_four_.capacity() * sizeof(detail::four) + cap_.memory() +
               cap_.log_memory() + (smoother_ ? smoother_->memory() : 0) + (footprints_ ? footprints_->memory() : 0);
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
    /// in any unit that adds up.  Several fields at once take less time, half of it on a mesh without a lattice:
    ///     transfer.scatter(std::tie(heat, force), std::tie(heat_source, momentum_source));
    /// Errors, on all ranks, with the cells as they were: bad_value for values that are not finite, std::logic_error
    /// before distribute(), stale_graph.
    template <class ParticleValues, class CellValues>
    void scatter(const ParticleValues& particles, CellValues&& cells) {
        check_columns<ParticleValues, std::decay_t<CellValues>>();
        require_map();
        const auto& visitors = footprints_->visitors();
        const auto count = visitors.owned_count();
        refuse_infinite(particles, count, "value of particle", [&](std::size_t i) { return visitors.owned(i).id; });
        detail::for_each_block_of_columns<ParticleValues>([&](std::size_t first, auto kind) {
            using number_type = decltype(kind);
            std::vector<number_type> values;
            detail::read_columns(particles, first, count, values);
            spread(visitors.bring(values));
            detail::write_columns(at_cells<number_type>(), first, cell_count(), cells);
        });
    }

    /// Sets particles[p], p an owned particle, to the mean of the cells' values over its shares.  Several fields at
    /// once, as in scatter:
    ///     transfer.gather(std::tie(gas_temperature, gas_velocity), std::tie(gas.temperature, gas.velocity));
    /// Errors: as scatter.
    template <class CellValues, class ParticleValues>
    void gather(const CellValues& cells, ParticleValues&& particles) {
        check_columns<CellValues, std::decay_t<ParticleValues>>();
        require_map();
        refuse_infinite(cells, cell_count(), "value of cell",
                        [&](std::size_t c) { return graph().global_index(static_cast<std::int32_t>(c)); });
        detail::for_each_block_of_columns<CellValues>([&](std::size_t first, auto kind) {
            std::vector<decltype(kind)>& values = at_cells<decltype(kind)>();
            detail::read_columns(cells, first, cell_count(), values);
            for_each_field(values, [&](auto field) { cap_.gather(field); });
            const auto seen = footprints_->gather(values.data(), bound_of(smoother_->smooth(values)));
            detail::write_columns(seen, first, footprints_->visitors().owned_count(), particles);
        });
    }

  private:
    template <class Values>
    using value = std::decay_t<decltype(element(std::declval<Values&>(), 0))>;

    template <class From, class To>
    static constexpr void check_columns() {
        static_assert(detail::columns<From>::count == detail::columns<To>::count,
                      "hearth: transfer_operator: as many numbers for a particle as for a cell");
    }

    std::size_t cell_count() const { return static_cast<std::size_t>(graph().cell_count()); }

    template <class Value>
    std::vector<Value>& at_cells() {
        if constexpr (std::is_same_v<Value, double>) {
            return cells_;
        } else {
            return cells_of_four_;
        }
    }

    template <class Value, class Visit>
    static void for_each_field(std::vector<Value>& values, Visit&& visit) {
        for (std::size_t k = 0; k < detail::fields_in<Value>; ++k) visit(detail::one_of<Value>(values, k));
    }

    static double bound_of(const smoothing_report& report) { return std::max(-report.lowest, report.highest); }
    static detail::four bound_of(const std::array<smoothing_report, detail::four::size>& reports) {
        detail::four bounds;
        for (std::size_t k = 0; k < reports.size(); ++k) bounds.of[k] = bound_of(reports[k]);
        return bounds;
    }

    template <class Fields, class IdOf>
    void refuse_infinite(const Fields& fields, std::size_t count, const char* place, const IdOf& id_of) const {
        std::optional<bad_value> wrong;
        detail::columns<Fields>::for_each(fields, 0, [&](std::size_t, const auto& field, std::size_t a) {
            for (std::size_t i = 0; i < count && !wrong; ++i) {
                const double number = detail::component(element(field, i), a);
                if (!std::isfinite(number)) wrong.emplace(place, id_of(i), number, "finite");
            }
        });
        throw_agreed(graph().communicator(), wrong);
    }

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

    /// W on one value for each visitor, or one of four fields; the result stays at the cells.
    template <class Value>
    void spread(const std::vector<Value>& at_visitors) {
        std::vector<Value>& values = at_cells<Value>();
        values.assign(cell_count(), Value{});
        footprints_->scatter(at_visitors, values.data());
        for (std::size_t c = 0; c < values.size(); ++c) values[c] /= graph().volume(static_cast<std::int32_t>(c));
        smoother_->smooth(values);
        for (std::size_t c = 0; c < values.size(); ++c) values[c] *= graph().volume(static_cast<std::int32_t>(c));
        for_each_field(values, [&](auto field) { cap_.scatter(field); });
    }

    const locator_type* locator_;
    filtered_fraction_settings settings_;
    std::shared_ptr<const footprints<Communicator>> footprints_;
    std::optional<kernel_smoother<Communicator>> smoother_;
    volume_fraction_smoother<cell_graph<Communicator>> cap_;
    std::vector<double> cells_;                // one value for each owned cell, between the steps
    std::vector<detail::four> cells_of_four_;  // the same where several fields go together
    std::uint64_t revision_ = 0;
};

}  // namespace hearth
