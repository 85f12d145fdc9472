// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <hearth/furnace/furnace.hpp>
#include <hearth/furnace/ranks.hpp>

namespace hearth::furnace::program {

/// Numbers that were watched, coupling by coupling: history.csv.
struct history {
    static constexpr std::size_t columns = 8;
    std::vector<double> rows;
    void add(const status& now);
};

/// What a run writes into its folder: rank 0 writes, and all ranks ask it together.  Every function throws io::file_error, on
/// every rank, where a file cannot be written, and leaves a file that was there as it was.
class results {
  public:
    /// Makes the folder.
    results(std::filesystem::path folder, ranks among);

    /// cells_NNNN.hdf and particles_NNNN.hdf for ParaView.
    void frame(int number, const furnace& shaft) const;
    /// scene.toml: the scene as it ran, every key with its value.
    void scene(const settings& s) const;
    /// profiles.csv, one_dimensional.csv, history.csv and the data and the script of the pictures.
    void end(const furnace& shaft, const snapshot& seen, const history& watched) const;
    /// summary.json, and a copy where `also` is not empty.
    void summary_file(const furnace& shaft, const snapshot& seen, const summary& s, const plan& planned, const std::string& also) const;

    const std::filesystem::path& folder() const { return folder_; }

  private:
    template <class Write>
    void on_first(Write&& write) const;
    void frame_of(int number, const snapshot& seen, const cell_shapes& shapes) const;
    void end_of(const furnace& shaft, const axial_profile& now, const snapshot& seen, const history& watched) const;

    std::filesystem::path folder_;
    ranks among_;
};

/// The summary as JSON: keys with units; what is absent is null, with the reason under "absent".
std::string json(const furnace& shaft, const snapshot& seen, const summary& s, const plan& planned, int ranks);

/// FNV-1a of all that a furnace shows of itself: two runs with the same answer, bit for bit, have the same.
std::uint64_t answer_hash(const snapshot& seen);

}  // namespace hearth::furnace::program
