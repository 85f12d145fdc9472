// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include <hearth/core/agree.hpp>
#include <hearth/core/cell_graph.hpp>
#include <hearth/core/element.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/reproducible_sum.hpp>
#include <hearth/voidage/vfs_cells.hpp>
#include <hearth/voidage/vfs_completion.hpp>
#include <hearth/voidage/vfs_log.hpp>
#include <hearth/voidage/vfs_replay.hpp>
#include <hearth/voidage/vfs_wave.hpp>

namespace hearth {

enum class vfs_variant {
    completed,  ///< all cells at or below the threshold, no volume lost
    paper       ///< the paper's wave alone: what is stuck stays where it is, above the threshold
};

struct vfs_settings {
    /// Largest solid fraction of a cell [-], in (0, 1].  0.74 is the densest packing of equal spheres; the paper uses 0.9.
    double threshold = 0.74;
    vfs_variant variant = vfs_variant::completed;
};

/// What a call of the Volume Fraction Smoother did; counts and volumes over all ranks.
struct vfs_report {
    int sweeps = 0;                   ///< of the wave
    int rings = 0;                    ///< of the completion
    std::int64_t touched_cells = 0;   ///< looked at and copied
    std::int64_t smoothed_cells = 0;  ///< that gave solid to their neighbours
    std::int64_t stuck_cells = 0;     ///< over-full, but with no neighbour that the wave could give to
    std::int64_t visited_cells = 0;   ///< by the completion
    double maximum = 0;               ///< largest fraction of all cells that were looked at, afterwards [-]
    double stranded_volume = 0;       ///< solid above the threshold, afterwards [m^3]; 0 if completed
};

/// The Volume Fraction Smoother: spreads solid from cells that hold more than a threshold to their neighbours.
///
/// Fractions are of *solid* volume.  Conserves the solid volume of every connected component to round-off.  The result
/// is bitwise the same for any storage order and any number of ranks, given the same global indices, and mirror-symmetric
/// for mirror-symmetric input to round-off.
///
/// Method: the wave of Spijker et al. (see vfs_wave.hpp), completed (see vfs_completion.hpp).
/// Cost: proportional to the touched cells, and one look at the field where smooth() is not told which cells changed.
///
/// One object serves one thread at a time; objects on the same graph are independent.  In a distributed run all ranks
/// make the same calls.  Keeps a reference to the graph.
template <class Graph>
class volume_fraction_smoother {
  public:
    using index = typename Graph::index;

    /// Errors: bad_value for a threshold outside (0, 1].
    explicit volume_fraction_smoother(const Graph& graph, vfs_settings settings = {})
        : settings_(settings), mesh_(graph), cells_(static_cast<std::size_t>(graph.total_count())),
          wave_(mesh_), completion_(mesh_), replay_(mesh_, log_, completion_) {
        std::optional<bad_value> wrong;
        if (!(settings.threshold > 0 && settings.threshold <= 1)) {
            wrong.emplace("threshold", bad_value::no_index, settings.threshold, "in (0, 1]");
        }
        throw_agreed(graph.communicator(), wrong);
    }
    volume_fraction_smoother(const volume_fraction_smoother&) = delete;
    volume_fraction_smoother& operator=(const volume_fraction_smoother&) = delete;

    /// Smooths a field of solid fractions [-]: anything with [i] over the owned cells, float or double.  The threshold
    /// is taken in the precision of the field.
    /// Errors, with the field as it was, on all ranks: bad_value for fractions that are NaN, negative or above 1e100;
    /// infeasible_volume where a connected component cannot hold its solid (variant completed); stale_graph.
    template <class Field>
    [[nodiscard]] vfs_report smooth(Field&& solid_fraction) {
        const double threshold = begin(solid_fraction);
        cells_.begin_copy();
        double maximum = 0;
        for (index cell = 0; cell < mesh_.owned(); ++cell) {
            const double value = read(solid_fraction, cell);
            cells_.copy(cell, value);
            if (value > threshold) wave_.insert(cell);
            maximum = std::max(maximum, std::min(value, threshold));
        }
        return run(solid_fraction, threshold, maximum, detail::smoothing_cells::all_copied{});
    }

    /// The same where only these owned cells can have come above the threshold, those that a host changed.  Costs what
    /// they and the cells that they spread to cost, whatever the size of the mesh.
    /// Errors: also bad_value for cells that are not owned, and for a cell above the threshold that was not named, where
    /// the completion meets one.
    template <class Field, class Touched>
    [[nodiscard]] vfs_report smooth(Field&& solid_fraction, const Touched& touched) {
        const double threshold = begin(solid_fraction);
        double maximum = 0;
        for (const auto cell : touched) {
            if (cell < 0 || cell >= mesh_.owned()) {
                complain("touched cell", static_cast<std::int64_t>(cell), static_cast<double>(cell),
                         "0 to cell_count - 1");
                continue;
            }
            const double value = read(solid_fraction, static_cast<index>(cell));
            if (value > threshold) wave_.insert(static_cast<index>(cell));
            maximum = std::max(maximum, std::min(value, threshold));
        }
        return run(solid_fraction, threshold, maximum, [&](index cell) { return read(solid_fraction, cell); });
    }

    /// Moves amounts of owned cells, such as sources of momentum, heat or species [unit of choice], as the last call of
    /// smooth() moved the solid: everything that was in a cell goes where its solid went.  Keeps the sum.  Looks only at
    /// cells that gave solid or received some.
    /// Errors, with the field as it was, on all ranks: bad_value for a value of those that is not finite.
    template <class Field>
    void scatter(Field&& amounts) {
        replay_.scatter(amounts);
    }

    /// The transpose of scatter(): for each owned cell the mean of a field over the places where the solid of that cell
    /// went; sum(amount * gather(value)) = sum(scatter(amount) * value).  A constant stays as it is.
    /// Errors: as scatter.
    template <class Field>
    void gather(Field&& values) {
        replay_.gather(values);
    }

    const Graph& graph() const { return mesh_.graph(); }
    const vfs_settings& settings() const { return settings_; }

    /// Bytes that this rank holds, the graph and the log aside.
    std::size_t memory() const { return mesh_.memory() + cells_.memory() + wave_.memory() + completion_.memory(); }
    /// Bytes of the record of the last call, kept for scatter() and gather().
    std::size_t log_memory() const { return log_.memory(); }

  private:
    void complain(const char* place, std::int64_t at, double value, const char* allowed) {
        if (!wrong_) wrong_.emplace(place, at, value, allowed);
    }
    void agree() { throw_agreed(graph().communicator(), wrong_); }

    template <class Field>
    using scalar_of = std::remove_cv_t<std::remove_reference_t<decltype(element(std::declval<Field&>(), 0))>>;

    /// Forgets the former call; the threshold in the precision of the field.
    template <class Field>
    double begin(Field&) {
        using scalar = scalar_of<Field>;
        static_assert(std::is_floating_point_v<scalar>, "hearth: a solid fraction is a field of float or double");
        graph().require_current();
        wrong_.reset();
        log_.clear();
        wave_.clear();
        cells_.release(mesh_.owned(), [](index) {});  // what an exception left behind
        return static_cast<double>(static_cast<scalar>(settings_.threshold));
    }

    template <class Field>
    double read(const Field& field, index cell) {
        const auto value = static_cast<double>(element(field, cell));
        if (value >= 0 && value <= 1e100) return value;
        complain("solid fraction of cell", graph().global_index(cell), value, "0 to 1e100 [-]");
        return 0;
    }

    template <class Field, class Read>
    vfs_report run(Field& field, double threshold, double maximum, const Read& read) {
        using scalar = scalar_of<Field>;
        // What a component may hold above its capacity: the round-off of the host's own sums.
        const double roundoff = std::max(1e-14, 0.5 * static_cast<double>(std::numeric_limits<scalar>::epsilon()));
        agree();
        wave_.run(threshold, cells_, log_, read);
        agree();  // cells that smooth() was not told of are read by the wave

        vfs_report report;
        report.sweeps = wave_.sweeps();
        report.stuck_cells = total(wave_.stuck_cells().size());
        if (report.stuck_cells > 0) {
            if (settings_.variant == vfs_variant::paper) {
                report.stranded_volume = stranded_volume(threshold);
            } else {
                if constexpr (std::is_same_v<Read, detail::smoothing_cells::all_copied>) {
                    completion_.find_room(threshold, wave_.stuck_cells(), cells_, read);
                } else {
                    completion_.find_room(threshold, wave_.stuck_cells(), cells_, [&](index cell) {
                        const double value = read(cell);
                        if (value <= threshold) return value;
                        complain("solid fraction of cell", graph().global_index(cell), value,
                                 "at most the threshold where a cell is not named as touched");
                        return threshold;
                    });
                }
                agree();
                completion_.fill(threshold, roundoff, cells_, log_);
                report.rings = completion_.rings();
                report.visited_cells = total(completion_.visited_cells());
            }
        }
        std::int64_t touched = 0;
        cells_.release(mesh_.owned(), [&](index cell) {
            const double value = cells_.fraction(cell);
            element(field, cell) = static_cast<scalar>(value);
            maximum = std::max(maximum, value);
            ++touched;
        });
        report.maximum = graph().communicator().max(maximum);
        report.touched_cells = total(touched);
        report.smoothed_cells = total(wave_.smoothed_cells());
        return report;
    }

    /// Sum over all ranks.
    template <class Count>
    std::int64_t total(Count mine) const {
        auto sum = static_cast<std::int64_t>(mine);
        graph().communicator().sum(&sum, 1);
        return sum;
    }

    double stranded_volume(double threshold) {
        const auto excess = [&](index cell) {
            return cells_.above(cell, threshold) * mesh_.volume(cell);
        };
        double largest = 0;
        for (const index cell : wave_.stuck_cells()) largest = std::max(largest, excess(cell));
        reproducible_sum sum(graph().communicator().max(largest), mesh_.cells_everywhere());
        for (const index cell : wave_.stuck_cells()) sum.add(excess(cell));
        graph().communicator().sum(sum.limbs(), sum.limb_count());
        return sum.value();
    }

    vfs_settings settings_;
    detail::smoothing_mesh<Graph> mesh_;
    detail::smoothing_cells cells_;
    detail::smoothing_log log_;
    detail::smoothing_wave<Graph> wave_;
    detail::smoothing_completion<Graph> completion_;
    detail::smoothing_replay<Graph> replay_;
    std::optional<bad_value> wrong_;
};

/// Smooths a field of solid fractions [-] of a host's mesh in one call:
///
///     const auto report = hearth::smooth_volume_fraction(mesh, solid_fraction, {0.9});
///
/// Reads the mesh each time: a host that smooths often keeps a cell_graph and a volume_fraction_smoother.
template <class Mesh, class Field, class Communicator = serial_communicator>
[[nodiscard]] vfs_report smooth_volume_fraction(const Mesh& mesh, Field&& solid_fraction, vfs_settings settings = {},
                                                Communicator communicator = {}) {
    require_cell_graph<Mesh>();
    if constexpr (is_cell_graph_v<Mesh>) {
        const cell_graph<Communicator> graph(mesh, communicator);
        return volume_fraction_smoother<cell_graph<Communicator>>(graph, settings).smooth(solid_fraction);
    } else {
        return {};
    }
}

}  // namespace hearth
