// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <hearth/core/communicator.hpp>
#include <hearth/core/error.hpp>

namespace hearth::detail {

/// A face to a cell of another rank, by global indices.
struct remote_face {
    int rank;
    std::int64_t here;
    std::int64_t there;
    double conductance;
};

/// Cells of a halo by rank and global index, and the part of the list that each rank has.
struct halo_cells {
    std::vector<std::pair<int, std::int64_t>> cells;

    void tidy() {
        std::sort(cells.begin(), cells.end());
        cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    }
    std::vector<link> links() const {
        std::vector<link> result;
        for (std::size_t k = 0; k < cells.size(); ++k) {
            if (result.empty() || result.back().rank != cells[k].first) result.push_back({cells[k].first, k, k});
            result.back().end = k + 1;
        }
        return result;
    }
};

/// Compares the faces that this rank lists with what the ranks beyond them list, for both must list each.  On return
/// the faces are in order of rank and global indices, and a conductance is that of the side with the lower index, so
/// that both ranks hold the same number.  Returns what is wrong, if anything.
template <class Communicator>
std::optional<bad_value> match_remote_faces(std::vector<remote_face>& faces, const Communicator& communicator,
                                            bool compare_conductances) {
    struct mirrored_face {
        std::int64_t sender;
        std::int64_t receiver;
        double conductance;
    };
    std::sort(faces.begin(), faces.end(), [](const remote_face& a, const remote_face& b) {
        return std::tie(a.rank, a.here, a.there, a.conductance) < std::tie(b.rank, b.here, b.there, b.conductance);
    });
    std::vector<parcel<mirrored_face>> outgoing;
    for (const remote_face& face : faces) {
        if (outgoing.empty() || outgoing.back().rank != face.rank) outgoing.push_back({face.rank, {}});
        outgoing.back().values.push_back({face.here, face.there, face.conductance});
    }
    const auto one_sided = [](std::int64_t here, std::int64_t there) {
        return bad_value("face between ranks of cell", here, static_cast<double>(there),
                         "a neighbour that both ranks list");
    };
    std::size_t next = 0;  // faces below it have their mirror image
    for (auto& from : communicator.exchange(std::move(outgoing))) {
        std::sort(from.values.begin(), from.values.end(), [](const mirrored_face& a, const mirrored_face& b) {
            return std::tie(a.receiver, a.sender, a.conductance) < std::tie(b.receiver, b.sender, b.conductance);
        });
        for (const mirrored_face& theirs : from.values) {
            if (next == faces.size() || faces[next].rank > from.rank) return one_sided(theirs.receiver, theirs.sender);
            remote_face& mine = faces[next++];
            if (mine.rank < from.rank || mine.here != theirs.receiver || mine.there != theirs.sender) {
                return one_sided(mine.here, mine.there);
            }
            if (compare_conductances && !(std::abs(mine.conductance - theirs.conductance) <=
                                          1e-6 * std::max(mine.conductance, theirs.conductance))) {
                return bad_value("conductance of a remote face of cell", mine.here, mine.conductance,
                                 "the same on both ranks, which disagree [m]");
            }
            if (mine.there < mine.here) mine.conductance = theirs.conductance;
        }
    }
    if (next < faces.size()) return one_sided(faces[next].here, faces[next].there);
    return std::nullopt;
}

}  // namespace hearth::detail
