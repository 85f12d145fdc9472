// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hearth::detail {

/// What one call of the Volume Fraction Smoother did, kept so that it can be done again to other amounts.
///
/// The wave, one entry per cell that gave, in the order of the sweeps: the part of its content that it kept, and one
/// bit per neighbour that says who received (each in proportion to its volume).  13 bytes for a hexahedron.
/// The completion, 16 bytes an entry: the part that a stuck cell kept, the rest going to the pool of its region, and
/// the part of a pool that a cell received.
class smoothing_log {
  public:
    using index = std::int32_t;

    struct pool_entry {
        index cell;
        std::int32_t pool;
        double part;
    };

    void clear() {
        cells_.clear();
        kept_.clear();
        receivers_.clear();
        sweep_ends_.clear();
        giving_.clear();
        receiving_.clear();
        pools_ = 0;
        has_pools_ = false;
    }

    /// A cell that gives, the part that it keeps, and one bit per neighbour that says who receives.
    void append(index cell, double kept, const std::uint8_t* bits, std::size_t bytes) {
        cells_.push_back(cell);
        kept_.push_back(kept);
        receivers_.insert(receivers_.end(), bits, bits + bytes);
    }
    void end_sweep() { sweep_ends_.push_back(static_cast<std::uint32_t>(cells_.size())); }

    /// Bytes that the bits of a row of so many neighbours take.
    static std::size_t row_bytes(std::size_t neighbours) { return (neighbours + 7) / 8; }

    std::size_t sweeps() const { return sweep_ends_.size(); }
    std::size_t sweep_begin(std::size_t sweep) const { return sweep == 0 ? 0 : sweep_ends_[sweep - 1]; }
    std::size_t sweep_end(std::size_t sweep) const { return sweep_ends_[sweep]; }
    index cell(std::size_t entry) const { return cells_[entry]; }
    double kept(std::size_t entry) const { return kept_[entry]; }
    const std::uint8_t* bits() const { return receivers_.data(); }
    const std::uint8_t* bits_end() const { return receivers_.data() + receivers_.size(); }

    /// A stuck cell, and the part that it kept; a cell, and the part of a pool that it received.
    void append_giving(index cell, std::int32_t pool, double kept) { giving_.push_back({cell, pool, kept}); }
    void append_receiving(index cell, std::int32_t pool, double part) { receiving_.push_back({cell, pool, part}); }
    const std::vector<pool_entry>& giving() const { return giving_; }
    const std::vector<pool_entry>& receiving() const { return receiving_; }

    /// Says, on all ranks, that the call had a completion, with so many pools on this one.
    void set_pools(std::int32_t pools) {
        pools_ = pools;
        has_pools_ = true;
    }
    std::int32_t pools() const { return pools_; }
    bool has_pools() const { return has_pools_; }

    /// Bytes in use.
    std::size_t memory() const {
        return cells_.size() * (sizeof(index) + sizeof(double)) + receivers_.size() +
               sweep_ends_.size() * sizeof(std::uint32_t) + (giving_.size() + receiving_.size()) * sizeof(pool_entry);
    }

  private:
    std::vector<index> cells_;
    std::vector<double> kept_;
    std::vector<std::uint8_t> receivers_;
    std::vector<std::uint32_t> sweep_ends_;
    std::vector<pool_entry> giving_;
    std::vector<pool_entry> receiving_;
    std::int32_t pools_ = 0;
    bool has_pools_ = false;
};

}  // namespace hearth::detail
