// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <type_traits>
#include <vector>

namespace hearth::detail {

/// Splits a + b into its rounded sum and the error of that sum, exactly.
/// Knuth, The Art of Computer Programming 2, 4.2.2, theorem B.
struct two_sum {
    two_sum(double a, double b) : sum(a + b) {
        const double part = sum - a;
        error = (a - (sum - part)) + (b - part);
    }
    double sum;
    double error;
};

/// Asks for a cache line ahead of its use; nothing where the compiler cannot.
inline void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__)
    __builtin_prefetch(address);
    asm volatile("" : : "r"(address));  // GCC 12 drops a function that only prefetches, as one without effect
#endif
}

/// Set of the integers below a size, given back in ascending order.  A tree of bits: insert costs one or two writes,
/// drain costs what is in the set, whatever the size.
class ordered_set {
  public:
    explicit ordered_set(std::size_t size) {
        do {
            size = (size + 63) / 64;
            levels_.emplace_back(size, std::uint64_t{0});
        } while (size > 1);
    }

    void insert(std::size_t i) {
        for (auto& level : levels_) {
            std::uint64_t& word = level[i / 64];
            const bool seen_above = word != 0;
            word |= std::uint64_t{1} << (i % 64);
            if (seen_above) return;
            i /= 64;
        }
    }

    /// Visits the members in ascending order and leaves the set empty.
    template <class Visit>
    void drain(Visit&& visit) {
        drain_word(levels_.size() - 1, 0, visit);
    }

  private:
    template <class Visit>
    void drain_word(std::size_t level, std::size_t at, Visit& visit) {
        if (at >= levels_[level].size()) return;  // a set of size 0
        std::uint64_t& word = levels_[level][at];
        for (; word != 0; word &= word - 1) {
            const std::size_t i = at * 64 + lowest_bit(word);
            if (level == 0) {
                visit(i);
            } else {
                drain_word(level - 1, i, visit);
            }
        }
    }

    static std::size_t lowest_bit(std::uint64_t word) {
#if defined(__GNUC__)
        return static_cast<std::size_t>(__builtin_ctzll(word));
#else
        std::size_t bit = 0;
        while ((word >> bit & 1) == 0) ++bit;
        return bit;
#endif
    }

    std::vector<std::vector<std::uint64_t>> levels_;
};

/// The mesh as the Volume Fraction Smoother walks it: rows of ghosts too (their owned neighbours), and the order of the
/// global indices.  Built once per graph.
template <class Graph>
class smoothing_mesh {
  public:
    using index = typename Graph::index;
    static constexpr bool is_distributed = Graph::communicator_type::is_distributed;

    explicit smoothing_mesh(const Graph& graph) : graph_(&graph), owned_(graph.cell_count()) {
        const double* const volumes = graph.volumes();
        const double* const end = volumes + graph.total_count();
        if (volumes != end) largest_volume_ = *std::max_element(volumes, end);
        volume_mask_ = std::all_of(volumes, end, [&](double v) { return v == *volumes; }) ? 0 : -1;
        cells_everywhere_ = owned_;
        graph.communicator().sum(&cells_everywhere_, 1);
        largest_volume_ = graph.communicator().max(largest_volume_);
        sort_by_id();
        if constexpr (is_distributed) turn_rows();
    }

    const Graph& graph() const { return *graph_; }
    index owned() const { return owned_; }
    /// Volume of a cell [m^3]; where all are equal, only one is read.
    double volume(index cell) const { return graph_->volumes()[cell & volume_mask_]; }
    double largest_volume() const { return largest_volume_; }
    std::int64_t cells_everywhere() const { return cells_everywhere_; }

    struct row {
        const index* first;
        const index* last;
        const index* begin() const { return first; }
        const index* end() const { return last; }
    };
    /// Neighbours of an owned cell, or the owned neighbours of a ghost.
    row neighbours(index cell) const {
        if constexpr (is_distributed) {
            if (cell >= owned_) {
                const auto ghost = static_cast<std::size_t>(cell - owned_);
                return {ghost_rows_.data() + ghost_offsets_[ghost], ghost_rows_.data() + ghost_offsets_[ghost + 1]};
            }
        }
        return {graph_->neighbours() + graph_->row_begin(cell), graph_->neighbours() + graph_->row_end(cell)};
    }

    /// Asks for what the cells that come next will need, in the order of dependence: cell_of(k) is the k-th of count
    /// owned cells, scattered over memory; touch(n) asks for what is needed of a neighbour.
    template <class CellOf, class Touch>
    void look_ahead(std::size_t k, std::size_t count, const CellOf& cell_of, const Touch& touch) const {
        if (k + 24 < count) prefetch(graph_->row_bounds() + cell_of(k + 24));
        if (k + 16 < count) prefetch(graph_->neighbours() + graph_->row_begin(cell_of(k + 16)));
        if (k + 8 < count) {
            for (const index n : neighbours(cell_of(k + 8))) touch(n);
        }
    }

    /// Place of a cell in the order of the global indices, and back.
    std::size_t place(index cell) const {
        return places_.empty() ? static_cast<std::size_t>(cell)
                               : static_cast<std::size_t>(places_[static_cast<std::size_t>(cell)]);
    }
    index cell_at(std::size_t place) const { return by_id_.empty() ? static_cast<index>(place) : by_id_[place]; }

    std::size_t memory() const {
        return (places_.capacity() + by_id_.capacity() + ghost_rows_.capacity()) * sizeof(index) +
               ghost_offsets_.capacity() * sizeof(std::size_t);
    }

  private:
    void sort_by_id() {
        const auto total = static_cast<std::size_t>(graph_->total_count());
        bool sorted = true;
        for (index c = 1; c < graph_->total_count() && sorted; ++c) {
            sorted = graph_->global_index(c - 1) < graph_->global_index(c);
        }
        if (sorted) return;
        by_id_.resize(total);
        std::iota(by_id_.begin(), by_id_.end(), index{0});
        std::sort(by_id_.begin(), by_id_.end(),
                  [&](index a, index b) { return graph_->global_index(a) < graph_->global_index(b); });
        places_.resize(total);
        for (std::size_t k = 0; k < total; ++k) places_[static_cast<std::size_t>(by_id_[k])] = static_cast<index>(k);
    }

    void turn_rows() {
        ghost_offsets_.assign(static_cast<std::size_t>(graph_->total_count() - owned_) + 1, 0);
        const auto for_each_link = [&](auto&& visit) {
            for (index c = 0; c < owned_; ++c) {
                graph_->for_each_neighbour(c, [&](index n) {
                    if (n >= owned_) visit(c, static_cast<std::size_t>(n - owned_));
                });
            }
        };
        for_each_link([&](index, std::size_t ghost) { ++ghost_offsets_[ghost + 1]; });
        std::partial_sum(ghost_offsets_.begin(), ghost_offsets_.end(), ghost_offsets_.begin());
        ghost_rows_.resize(ghost_offsets_.back());
        std::vector<std::size_t> next(ghost_offsets_.begin(), ghost_offsets_.end() - 1);
        for_each_link([&](index c, std::size_t ghost) { ghost_rows_[next[ghost]++] = c; });
    }

    const Graph* graph_;
    index owned_;
    index volume_mask_ = -1;
    double largest_volume_ = 0;
    std::int64_t cells_everywhere_ = 0;
    std::vector<index> places_;  // empty: the cells are stored in the order of their global indices
    std::vector<index> by_id_;
    std::vector<std::size_t> ghost_offsets_;
    std::vector<index> ghost_rows_;
};

/// Working copy of the fractions, of all cells or of those that a call touches.
class smoothing_cells {
  public:
    using index = std::int32_t;

    enum flag : std::uint32_t {
        touched = 1,
        marked = 2,  // over-full in this sweep or an earlier one
        visited = 4  // by the completion
    };
    /// value + rest is the solid fraction; the rest is what rounding took from the value.
    struct content {
        double value;
        float rest;
        std::uint32_t flags;
    };
    /// Instead of a function that reads the host's field: all cells were copied at the beginning.
    struct all_copied {};

    explicit smoothing_cells(std::size_t total) : contents_(total, content{0, 0, 0}) {}

    /// Visits every owned cell that was touched, and forgets all.  Costs what was touched, or one pass over the cells
    /// if all were copied.
    template <class Visit>
    void release(index owned, Visit&& visit) {
        const auto leave = [&](index cell) {
            visit(cell);
            (*this)[cell].flags = 0;
        };
        for (const index cell : touched_) leave(cell);
        touched_.clear();
        if (!copied_all_) return;
        copied_all_ = false;
        for (index cell = 0; cell < owned; ++cell) {
            if ((*this)[cell].flags != 0) leave(cell);
        }
    }

    /// Before copying each cell with copy().
    void begin_copy() { copied_all_ = true; }
    void copy(index cell, double value) { (*this)[cell] = {value, 0, 0}; }

    content& operator[](index cell) { return contents_[static_cast<std::size_t>(cell)]; }
    const content& operator[](index cell) const { return contents_[static_cast<std::size_t>(cell)]; }
    double fraction(index cell) const { return (*this)[cell].value + static_cast<double>((*this)[cell].rest); }
    /// What a cell holds above a fraction.
    double above(index cell, double fraction) const {
        return ((*this)[cell].value - fraction) + static_cast<double>((*this)[cell].rest);
    }

    bool is(index cell, flag which) const { return ((*this)[cell].flags & which) != 0; }
    void set(index cell, flag which) { (*this)[cell].flags |= which; }
    void set_fraction(index cell, double value) {
        (*this)[cell].value = value;
        (*this)[cell].rest = 0;
    }
    content* data() { return contents_.data(); }

    /// Content of a cell, copied from the host when it is first touched.
    template <class Read>
    content& touch(index cell, [[maybe_unused]] const Read& read) {
        content& mine = (*this)[cell];
        if constexpr (!std::is_same_v<Read, all_copied>) {
            if ((mine.flags & touched) == 0) {
                touched_.push_back(cell);
                mine = {read(cell), 0, 0};
            }
        }
        mine.flags |= touched;
        return mine;
    }

    void prefetch(index cell) const { detail::prefetch(&(*this)[cell]); }

    std::size_t memory() const {
        return contents_.capacity() * sizeof(content) + touched_.capacity() * sizeof(index);
    }

  private:
    std::vector<content> contents_;
    std::vector<index> touched_;
    bool copied_all_ = false;
};

}  // namespace hearth::detail
