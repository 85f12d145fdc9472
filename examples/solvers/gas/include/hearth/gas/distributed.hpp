// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include <hearth/core/cell_graph.hpp>
#include <hearth/gas/mesh.hpp>
#include <hearth/gas/mesh_traits.hpp>
#include <hearth/gas/parallel.hpp>

namespace hearth::gas {

/// The ranks of a mesh that is cut into shares, over any communicator of hearth: that of MPI, or threads.
/// Sums are taken in order of rank, so they give the same bits on every rank and in every run.
/// Errors: bad_value, on all ranks, where the shares do not fit together.
template <class Communicator>
class distributed : public parallel {
  public:
    distributed(const mesh& share, Communicator communicator)
        : owned_(share.owned_cells()), halo_(cell_graph<Communicator>(share, communicator).halo()) {}

    int ranks() const override { return communicator().size(); }
    int rank() const override { return communicator().rank(); }

    void gather(double* field, int width) const override {
        const auto w = static_cast<std::size_t>(width);
        buffer_.resize(halo_.export_cells().size() * w);
        double* to = buffer_.data();
        for (const std::int32_t cell : halo_.export_cells())
            to = std::copy_n(field + w * static_cast<std::size_t>(cell), w, to);
        auto under_way = communicator().begin(buffer_.data(), times(halo_.exports(), w),
                                              field + w * static_cast<std::size_t>(owned_), times(halo_.imports(), w));
        communicator().end(under_way);
    }

    /// Each rank's terms travel as integers in a place of their own, which no order of additions can change.
    void sum(double* values, int count) const override {
        const auto n = static_cast<std::size_t>(count), all = static_cast<std::size_t>(ranks());
        terms_.assign(all * n, 0);
        std::memcpy(&terms_[static_cast<std::size_t>(rank()) * n], values, n * sizeof(double));
        communicator().sum(terms_.data(), terms_.size());
        for (std::size_t i = 0; i < n; ++i) {
            values[i] = 0;
            for (std::size_t r = 0; r < all; ++r) {
                double term = 0;
                std::memcpy(&term, &terms_[r * n + i], sizeof term);
                values[i] += term;
            }
        }
    }
    using parallel::sum;

    double max(double mine) const override {
        return communicator().max(std::isnan(mine) ? std::numeric_limits<double>::infinity() : mine);
    }

    const Communicator& communicator() const { return halo_.communicator(); }

  private:
    static std::vector<link> times(std::vector<link> links, std::size_t width) {
        for (link& l : links) {
            l.begin *= width;
            l.end *= width;
        }
        return links;
    }

    int owned_;
    halo<Communicator> halo_;
    mutable std::vector<double> buffer_;
    mutable std::vector<std::int64_t> terms_;
};

}  // namespace hearth::gas
