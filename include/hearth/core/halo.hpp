// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <hearth/core/communicator.hpp>

namespace hearth {

/// Which owned cells other ranks need, and which ghosts come from where.
///
/// Words, from this rank's point of view: a rank *owns* its cells; a *ghost* is a copy of a cell that another rank owns
/// and that shares a face with an owned cell.  *Gather* copies the owners' values to the ghosts.  hearth never adds
/// ghost contributions rank by rank: the owner takes sums itself, in the order of the global indices, so that the result
/// does not depend on the number of ranks.
///
/// Fields hold the owned cells first, then the ghosts in order of rank and global index.
template <class Communicator>
class halo {
  public:
    halo() = default;
    halo(Communicator communicator, std::int32_t owned_count, std::vector<std::int32_t> export_cells,
         std::vector<link> exports, std::vector<link> imports)
        : communicator_(communicator),
          owned_count_(owned_count),
          export_cells_(std::move(export_cells)),
          exports_(std::move(exports)),
          imports_(std::move(imports)) {}

    const Communicator& communicator() const { return communicator_; }

    /// Owned cells whose values other ranks hold as ghosts, link by link.
    const std::vector<std::int32_t>& export_cells() const { return export_cells_; }
    const std::vector<link>& exports() const { return exports_; }
    const std::vector<link>& imports() const { return imports_; }

    /// A gather under way: holds the buffers until finish().
    template <class Value>
    struct pending {
        std::vector<Value> buffer;
        typename Communicator::request request;
    };

    /// Starts to copy the owners' values of a field to its ghosts.
    template <class Value>
    pending<Value> begin_gather(Value* field) const {
        pending<Value> under_way;
        if constexpr (Communicator::is_distributed) {
            under_way.buffer.reserve(export_cells_.size());
            for (const std::int32_t cell : export_cells_) under_way.buffer.push_back(field[cell]);
            under_way.request =
                communicator_.begin(under_way.buffer.data(), exports_, field + owned_count_, imports_);
        }
        return under_way;
    }

    /// Ends it; from here on the ghosts may be read and the owners' values changed.
    template <class Value>
    void end_gather(pending<Value>& under_way) const {
        if constexpr (Communicator::is_distributed) communicator_.end(under_way.request);
    }

    /// Copies the owners' values of fields to their ghosts.
    template <class... Values>
    void gather(Values*... fields) const {
        (gather_one(fields), ...);
    }

  private:
    template <class Value>
    void gather_one(Value* field) const {
        auto under_way = begin_gather(field);
        end_gather(under_way);
    }

    Communicator communicator_{};
    std::int32_t owned_count_ = 0;
    std::vector<std::int32_t> export_cells_;
    std::vector<link> exports_;
    std::vector<link> imports_;
};

}  // namespace hearth
