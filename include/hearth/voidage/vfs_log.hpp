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
        giving.clear();
        receiving.clear();
        pools = 0;
    }

    /// Writes the bits of one entry, one per neighbour.
    class row_writer {
      public:
        explicit row_writer(std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}
        ~row_writer() {
            if (bit_ != 1) bytes_.push_back(static_cast<std::uint8_t>(byte_));
        }
        row_writer(const row_writer&) = delete;
        row_writer& operator=(const row_writer&) = delete;

        void next(bool receives) {
            if (receives) byte_ |= bit_;
            bit_ <<= 1;
            if (bit_ == 256) {
                bytes_.push_back(static_cast<std::uint8_t>(byte_));
                byte_ = 0;
                bit_ = 1;
            }
        }

      private:
        std::vector<std::uint8_t>& bytes_;
        unsigned byte_ = 0;
        unsigned bit_ = 1;
    };

    row_writer append(index cell, double kept) {
        cells_.push_back(cell);
        kept_.push_back(kept);
        return row_writer(receivers_);
    }
    void end_sweep() { sweep_ends_.push_back(cells_.size()); }

    /// Bytes that the bits of a row of so many neighbours take.
    static std::size_t row_bytes(std::size_t neighbours) { return (neighbours + 7) / 8; }

    std::size_t sweeps() const { return sweep_ends_.size(); }
    std::size_t sweep_begin(std::size_t sweep) const { return sweep == 0 ? 0 : sweep_ends_[sweep - 1]; }
    std::size_t sweep_end(std::size_t sweep) const { return sweep_ends_[sweep]; }
    index cell(std::size_t entry) const { return cells_[entry]; }
    double kept(std::size_t entry) const { return kept_[entry]; }
    std::size_t size() const { return cells_.size(); }
    const std::vector<std::uint8_t>& receivers() const { return receivers_; }

    /// The completion: what stuck cells kept, and what cells received of the pools 0 to pools - 1.
    std::vector<pool_entry> giving;
    std::vector<pool_entry> receiving;
    std::int32_t pools = 0;

    /// Bytes in use.
    std::size_t memory() const {
        return cells_.size() * (sizeof(index) + sizeof(double)) + receivers_.size() +
               sweep_ends_.size() * sizeof(std::size_t) + (giving.size() + receiving.size()) * sizeof(pool_entry);
    }

  private:
    std::vector<index> cells_;
    std::vector<double> kept_;
    std::vector<std::uint8_t> receivers_;
    std::vector<std::size_t> sweep_ends_;
};

}  // namespace hearth::detail
