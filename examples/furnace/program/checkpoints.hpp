// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include <hearth/furnace/ranks.hpp>
#include <hearth/furnace/settings.hpp>
#include <hearth/furnace/snapshot.hpp>

namespace hearth::furnace::program {

/// The checkpoints of a run: checkpoint_0001.h5, checkpoint_0002.h5, ... in one folder, of which the last two are kept.
///
/// Each is written under a new name, checksummed, brought to the disk and only then renamed; older ones go after that.  So
/// whenever a run is killed, at least one whole checkpoint is there from the first one on.  All ranks write it together.
class checkpoints {
  public:
    checkpoints(std::filesystem::path folder, ranks among);

    /// Writes the next one, of each rank its part of the state, and returns its path.  Throws io::file_error, with the earlier ones untouched, where it cannot.
    std::filesystem::path write(const saved_state& state, const settings& scene);

  private:
    std::filesystem::path folder_;
    ranks among_;
};

/// Reads a checkpoint, or the latest whole one of a folder, the state of all ranks on every rank.  Writes nothing.  `remark` tells of a damaged one that was passed
/// over for the one before it.  Throws io::file_error for what is damaged, cut off, no checkpoint or not there, and
/// bad_scene for one of another scene, with the keys that differ.
saved_state read_checkpoint(const std::filesystem::path& file_or_folder, const settings& scene, std::string& remark);

}  // namespace hearth::furnace::program
