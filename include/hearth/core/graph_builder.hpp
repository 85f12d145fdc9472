// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <hearth/core/agree.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/halo.hpp>
#include <hearth/core/mesh_traits.hpp>
#include <hearth/core/remote_faces.hpp>
#include <hearth/core/unique_ids.hpp>

namespace hearth::detail {

/// Reads a host's mesh once, checks it, and makes the arrays of a cell_graph.  Lives only while the graph is built.
template <class Mesh, class Communicator>
class graph_builder {
  public:
    graph_builder(const Mesh& mesh, const Communicator& communicator) : mesh_(mesh), communicator_(communicator) {
        read_cells();
        agree();
        check_unique();
        agree();
        if constexpr (Communicator::is_distributed) {
            static_assert(has_global_index_v<Mesh>,
                          "hearth: mesh_traits<Mesh> lacks  std::int64_t global_index(mesh, cell), needed on several ranks");
            static_assert(has_remote_faces_v<Mesh>,
                          "hearth: mesh_traits<Mesh> lacks  for_each_remote_face(mesh, visit), needed on several ranks");
            read_remote_faces();
            agree();
            wrong_ = match_remote_faces(remote_, communicator_, has_faces_v<Mesh>);
            agree();
            make_halo();
        }
        fill_rows();
        agree();
        sort_rows();
        if constexpr (!has_faces_v<Mesh>) check_mutual();
        agree();
    }

    std::int32_t owned = 0;
    std::vector<std::uint32_t> offsets;
    std::vector<std::int32_t> neighbours;
    std::vector<float> conductances;
    std::vector<double> volumes;
    std::vector<std::int64_t> global;
    std::vector<int> ghost_owners;
    std::vector<std::int32_t> export_cells;
    std::vector<link> exports;
    std::vector<link> imports;

  private:
    using traits = mesh_traits<Mesh>;
    using host_index = typename traits::index;

    void agree() { throw_agreed(communicator_, wrong_); }

    void complain(std::string place, std::int64_t index, double value, std::string allowed) {
        if (!wrong_) wrong_.emplace(std::move(place), index, value, std::move(allowed));
    }

    std::int64_t id(std::int32_t cell) const {
        return global.empty() ? cell : global[static_cast<std::size_t>(cell)];
    }

    void read_cells() {
        const auto count = static_cast<std::int64_t>(traits::cell_count(mesh_));
        if (count < 0 || count > std::numeric_limits<std::int32_t>::max()) {
            complain("cell_count", bad_value::no_index, static_cast<double>(count), "0 to 2147483647 on one rank");
            return;
        }
        owned = static_cast<std::int32_t>(count);
        volumes.resize(static_cast<std::size_t>(count));
        if constexpr (has_global_index_v<Mesh>) {
            global.resize(static_cast<std::size_t>(count));
            for (std::int32_t c = 0; c < owned; ++c) {
                global[static_cast<std::size_t>(c)] =
                    static_cast<std::int64_t>(traits::global_index(mesh_, static_cast<host_index>(c)));
            }
        }
        for (std::int32_t c = 0; c < owned; ++c) {
            const auto v = static_cast<double>(traits::volume(mesh_, static_cast<host_index>(c)));
            if (!(v > 0 && std::isfinite(v))) complain("volume of cell", id(c), v, "finite and > 0 [m^3]");
            volumes[static_cast<std::size_t>(c)] = v;
        }
    }

    /// Global indices must be unique on this rank and over all.
    void check_unique() {
        if constexpr (has_global_index_v<Mesh>) {
            by_id_.resize(global.size());
            std::iota(by_id_.begin(), by_id_.end(), 0);
            std::sort(by_id_.begin(), by_id_.end(), [&](std::int32_t a, std::int32_t b) { return id(a) < id(b); });
            if (const auto twice = find_duplicate(communicator_, global)) {
                complain("global index of cell", *twice, static_cast<double>(*twice), "unique over all cells and ranks");
            }
        }
    }

    std::int32_t find_owned(std::int64_t g) const {
        const auto at = std::lower_bound(by_id_.begin(), by_id_.end(), g,
                                         [&](std::int32_t c, std::int64_t value) { return id(c) < value; });
        return at != by_id_.end() && id(*at) == g ? *at : -1;
    }

    void read_remote_faces() {
        traits::for_each_remote_face(
            mesh_, [&](host_index cell, int rank, std::int64_t there, double, double conductance) {
                if (cell < 0 || cell >= owned) {
                    complain("cell of a remote face", static_cast<std::int64_t>(cell), static_cast<double>(cell),
                             "0 to cell_count - 1");
                } else if (rank < 0 || rank >= communicator_.size() || rank == communicator_.rank()) {
                    complain("rank of a remote face of cell", id(static_cast<std::int32_t>(cell)), rank,
                             "another rank of the communicator");
                } else {
                    check_conductance(id(static_cast<std::int32_t>(cell)), conductance);
                    remote_.push_back({rank, id(static_cast<std::int32_t>(cell)), there, conductance});
                }
            });
    }

    /// Ghosts in order of rank and global index; the exporting rank lists its cells in the same order.
    void make_halo() {
        halo_cells exported;
        for (const remote_face& face : remote_) {
            ghosts_.cells.emplace_back(face.rank, face.there);
            exported.cells.emplace_back(face.rank, face.here);
        }
        ghosts_.tidy();
        exported.tidy();
        imports = ghosts_.links();
        exports = exported.links();
        for (const auto& [rank, g] : ghosts_.cells) {
            ghost_owners.push_back(rank);
            global.push_back(g);
        }
        for (const auto& [rank, g] : exported.cells) export_cells.push_back(find_owned(g));
        volumes.resize(volumes.size() + ghosts_.cells.size());
        halo<Communicator>(communicator_, owned, export_cells, exports, imports).gather(volumes.data());
    }

    void check_conductance(std::int64_t cell, double conductance) {
        if constexpr (has_faces_v<Mesh>) {
            if (!(conductance > 0 && conductance < static_cast<double>(std::numeric_limits<float>::max()))) {
                complain("conductance of a face of cell", cell, conductance, "finite and > 0 [m]");
            }
        }
    }

    bool is_link(std::int64_t cell, std::int64_t neighbour) {
        if (cell < 0 || cell >= owned) {
            complain("cell of a face", bad_value::no_index, static_cast<double>(cell), "0 to cell_count - 1");
        } else if (neighbour < 0 || neighbour >= owned) {
            complain("neighbour of cell", id(static_cast<std::int32_t>(cell)), static_cast<double>(neighbour),
                     "0 to cell_count - 1");
        } else {
            return neighbour != cell;
        }
        return false;
    }

    /// Visits every link of an owned cell, both ways round for faces: visit(cell, neighbour, conductance).
    template <class Visit>
    void for_each_link(Visit&& visit) {
        if constexpr (has_faces_v<Mesh>) {
            traits::for_each_face(mesh_, [&](host_index a, host_index b, double, double conductance) {
                if (!is_link(a, b)) return;
                check_conductance(id(static_cast<std::int32_t>(a)), conductance);
                visit(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), conductance);
                visit(static_cast<std::int32_t>(b), static_cast<std::int32_t>(a), conductance);
            });
        } else {
            for (std::int32_t c = 0; c < owned; ++c) {
                traits::for_each_neighbour(mesh_, static_cast<host_index>(c), [&](host_index n) {
                    if (is_link(c, n)) visit(c, static_cast<std::int32_t>(n), 0.0);
                });
            }
        }
        for (const remote_face& face : remote_) {
            const auto ghost = std::lower_bound(ghosts_.cells.begin(), ghosts_.cells.end(), std::pair(face.rank, face.there));
            visit(find_owned(face.here), owned + static_cast<std::int32_t>(ghost - ghosts_.cells.begin()), face.conductance);
        }
    }

    void fill_rows() {
        std::vector<std::uint64_t> ends(static_cast<std::size_t>(owned) + 1, 0);
        for_each_link([&](std::int32_t cell, std::int32_t, double) { ++ends[static_cast<std::size_t>(cell) + 1]; });
        if (wrong_) return;
        std::partial_sum(ends.begin(), ends.end(), ends.begin());
        if (ends.back() > std::numeric_limits<std::uint32_t>::max()) {
            complain("number of links between cells", bad_value::no_index, static_cast<double>(ends.back()),
                     "at most 4294967295 on one rank");
            return;
        }
        offsets.assign(ends.begin(), ends.end());
        neighbours.resize(ends.back());
        if constexpr (has_faces_v<Mesh>) conductances.resize(ends.back());
        ends.pop_back();  // now the place of the next link of each cell
        for_each_link([&](std::int32_t cell, std::int32_t neighbour, double conductance) {
            const std::uint64_t at = ends[static_cast<std::size_t>(cell)]++;
            neighbours[at] = neighbour;
            if constexpr (has_faces_v<Mesh>) conductances[at] = static_cast<float>(conductance);
        });
    }

    /// Neighbours by global index, each once.
    void sort_rows() {
        if (wrong_) return;
        struct entry {
            std::int64_t id;
            float conductance;
            std::int32_t cell;
        };
        std::vector<entry> row;
        std::uint32_t write = 0;
        for (std::size_t c = 0; c < static_cast<std::size_t>(owned); ++c) {
            row.clear();
            for (std::uint32_t k = offsets[c]; k < offsets[c + 1]; ++k) {
                row.push_back({id(neighbours[k]), conductances.empty() ? 0.0F : conductances[k], neighbours[k]});
            }
            std::sort(row.begin(), row.end(), [](const entry& a, const entry& b) {
                return std::tie(a.id, a.conductance) < std::tie(b.id, b.conductance);
            });
            offsets[c] = write;
            for (std::size_t k = 0; k < row.size(); ++k) {
                if (k > 0 && row[k].cell == row[k - 1].cell) {
                    if (!conductances.empty()) conductances[write - 1] += row[k].conductance;
                } else {
                    neighbours[write] = row[k].cell;
                    if (!conductances.empty()) conductances[write] = row[k].conductance;
                    ++write;
                }
            }
        }
        if (!offsets.empty()) offsets.back() = write;
        if (write < neighbours.size()) {
            neighbours.resize(write);
            neighbours.shrink_to_fit();
            if (!conductances.empty()) conductances.resize(write);
            conductances.shrink_to_fit();
        }
    }

    void check_mutual() {
        if (wrong_) return;
        for (std::int32_t c = 0; c < owned; ++c) {
            for (std::uint32_t k = offsets[static_cast<std::size_t>(c)]; k < offsets[static_cast<std::size_t>(c) + 1];
                 ++k) {
                const std::int32_t n = neighbours[k];
                if (n >= owned) continue;  // remote faces are matched already
                const auto first = neighbours.begin() + offsets[static_cast<std::size_t>(n)];
                const auto last = neighbours.begin() + offsets[static_cast<std::size_t>(n) + 1];
                const auto back =
                    std::lower_bound(first, last, id(c), [&](std::int32_t m, std::int64_t g) { return id(m) < g; });
                if (back == last || *back != c) {
                    complain("neighbour of cell", id(c), static_cast<double>(id(n)),
                             "mutual: that cell must list this one too");
                }
            }
        }
    }

    const Mesh& mesh_;
    const Communicator& communicator_;
    std::optional<bad_value> wrong_;
    std::vector<std::int32_t> by_id_;  // owned cells in order of their global indices
    std::vector<remote_face> remote_;
    halo_cells ghosts_;
};

}  // namespace hearth::detail
