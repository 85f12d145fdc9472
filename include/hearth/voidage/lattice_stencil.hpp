// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <hearth/core/cell_graph.hpp>
#include <hearth/core/element.hpp>

namespace hearth::detail {

/// One term of Clenshaw's recurrence, for one cell or a row of cells:
///     out = c * input + factor * (b + rate * sum_n g_n (b_n - b)) - out
struct clenshaw_term {
    double c;
    double factor;
};

/// Applies terms on a structured lattice: coefficients instead of lists, rows that a compiler can vectorise, and
/// several terms in one pass over memory, plane by plane one behind the other.
///
/// Neighbours are added in the order of their numbers as the general path does, so both give the same bits (where the
/// compiler contracts neither to fused multiply-adds).
class lattice_stencil {
  public:
    /// Terms in one pass: three planes a term stay in cache.
    static constexpr std::size_t deepest = 4;

    template <class Graph>
    lattice_stencil(const Graph& graph, const lattice_shape& shape) : cells_(shape.cells), periodic_(shape.periodic) {
        const std::array<std::int64_t, 3> stride{1, cells_[0], std::int64_t{cells_[0]} * cells_[1]};
        for (std::uint32_t k = graph.row_begin(0); k < graph.row_end(0); ++k) {
            for (std::size_t a = 0; a < 3; ++a) {
                if (cells_[a] > 1 && graph.neighbours()[k] == stride[a])
                    g_[a] = static_cast<double>(graph.conductances()[k]);
            }
        }
    }

    /// Does all terms: the first reads b and overwrites b_next, the second the other way round, and so on; the last one
    /// writes to `field`, which is the input of all of them.
    /// general(cell, term, input, b, out before, out) does one cell by the lists.
    template <class Field, class Value, class General>
    void apply(const std::vector<clenshaw_term>& terms, Field& field, Value* b, Value* b_next, double rate,
               const General& general) const {
        const std::size_t depth = periodic_[2] ? 1 : deepest;  // a plane of a ring has both neighbours at once
        for (std::size_t begin = 0; begin < terms.size(); begin += depth) {
            const std::size_t stages = std::min(depth, terms.size() - begin);
            for (std::int64_t front = 0; front < cells_[2] + static_cast<std::int64_t>(stages) - 1; ++front) {
                for (std::size_t s = 0; s < stages; ++s) {
                    const std::int64_t plane = front - static_cast<std::int64_t>(s);
                    if (plane < 0 || plane >= cells_[2]) continue;
                    const bool even = (begin + s) % 2 == 0;
                    const Value* from = even ? b : b_next;
                    Value* to = even ? b_next : b;
                    if (begin + s + 1 == terms.size()) {
                        apply_plane(plane, terms[begin + s], field, from, to, field, rate, general);
                    } else {
                        apply_plane(plane, terms[begin + s], field, from, to, to, rate, general);
                    }
                }
            }
        }
    }

  private:
    template <class Value, class Input, class Output, class General>
    void apply_plane(std::int64_t k, clenshaw_term term, const Input& input, const Value* b, const Value* b_before,
                     Output& output, double rate, const General& general) const {
        const std::int64_t nx = cells_[0], ny = cells_[1], nz = cells_[2];
        for (std::int64_t j = 0; j < ny; ++j) {
            const std::int64_t row = nx * (j + ny * k);
            const bool wraps = (periodic_[1] && (j == 0 || j == ny - 1)) || (periodic_[2] && (k == 0 || k == nz - 1));
            // A wall is a neighbour of the same value: no flux.
            const Value* below = b + (k > 0 ? row - nx * ny : row);
            const Value* south = b + (j > 0 ? row - nx : row);
            const Value* here = b + row;
            const Value* north = b + (j + 1 < ny ? row + nx : row);
            const Value* above = b + (k + 1 < nz ? row + nx * ny : row);
            if (wraps) {
                for (std::int64_t i = 0; i < nx; ++i) general(row + i, term, input, b, b_before, output);
                continue;
            }
            general(row, term, input, b, b_before, output);
            for (std::int64_t i = 1; i < nx - 1; ++i) {
                const Value sum = g_[2] * (below[i] - here[i]) + g_[1] * (south[i] - here[i]) +
                                  g_[0] * (here[i - 1] - here[i]) + g_[0] * (here[i + 1] - here[i]) +
                                  g_[1] * (north[i] - here[i]) + g_[2] * (above[i] - here[i]);
                const Value value = term.c * static_cast<Value>(element(input, row + i)) +
                                    term.factor * (here[i] + rate * sum) - b_before[row + i];
                auto&& target = element(output, row + i);
                target = static_cast<std::decay_t<decltype(target)>>(value);
            }
            if (nx > 1) general(row + nx - 1, term, input, b, b_before, output);
        }
    }

    std::array<std::int32_t, 3> cells_;
    std::array<bool, 3> periodic_;
    std::array<double, 3> g_{0, 0, 0};
};

}  // namespace hearth::detail
