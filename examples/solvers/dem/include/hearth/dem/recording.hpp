// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include <hearth/dem/moving_bed.hpp>

/// Motion that a short DEM run shows, repeated for as long as asked.
namespace hearth::dem {

/// Mean velocity and packing over radius and height of a shaft.
struct motion_field {
    struct mean {
        double radial = 0, axial = 0;  ///< way of the particles over mass that leaves the bed [m/kg]
        double solid_fraction = 0;     ///< [-]
        double samples = 0;            ///< particles times frames
    };

    zone shaft{};
    int rings = 0, layers = 0;
    std::vector<mean> bins;  ///< ring by ring within a layer, layers from below

    std::size_t bin(const vector3& x) const;  ///< the nearest, for points outside
};

/// A recorded motion: frames of a bed that is fed and discharged steadily, and how the last one goes on as the first.
///
/// A *slot* is where one particle of the DEM run has been, from frame to frame, from its rest on the bed until it left;
/// each frame is a packing of the DEM run as it was.  At the end particles step from the slots of the last frame to
/// those of the first: each to one of its own, near, and of about its size.
class recording {
  public:
    struct settings {
        zone shaft{};  ///< of the field
        int rings = 8, layers = 16;
        double size_weight = 4;  ///< how much a step may be longer for a better fit of radii [-]
    };
    struct frame {
        std::vector<std::uint32_t> slots;  ///< rising
        std::vector<vector3> centres;      ///< of the slots
    };
    /// What the repetition adds to the DEM's motion: of the step from the last frame to the first.
    struct seam {
        double mean_step = 0, longest_step = 0;  ///< [m]
        double size_misfit = 0;                  ///< root mean square, over the mean radius [-]
        int surplus = 0;                         ///< particles of the last frame less those of the first
    };

    /// Bytes that read() takes; in the byte order of this machine.
    std::vector<char> bytes() const;
    /// Throws state_error.
    static recording read(const std::vector<char>& bytes);

    const std::vector<frame>& frames() const { return frames_; }
    double radius(std::uint32_t slot) const { return radii_[slot]; }
    double mass(std::uint32_t slot) const { return masses_[slot]; }
    const std::vector<index>& wrap() const { return wrap_; }
    const motion_field& field() const { return field_; }
    const seam& joint() const { return seam_; }
    std::uint64_t fingerprint() const;
    /// Mass of those who are fed from the first frame until it comes again [kg]; over the mass flow: how long a turn takes.
    double mass_of_turn() const;
    /// Spheres and masses of a frame.
    std::vector<sphere> spheres(std::size_t frame_number) const;
    std::vector<double> masses(std::size_t frame_number) const;

  private:
    friend class recorder;
    recording() = default;
    void join(double size_weight);
    void average(const settings& s);

    std::vector<double> radii_, masses_;  ///< of slots
    std::vector<frame> frames_;
    /// Of each slot of the first frame: place in the last frame of who comes, or passage::fed.
    std::vector<index> wrap_;
    motion_field field_;
    seam seam_;
};

/// Watches a bed that is fed and discharged steadily.  On several ranks all make the calls together, and each gets the
/// same recording, that of the whole bed: the bits of one rank.
class recorder {
  public:
    /// Throws bad_value.
    explicit recorder(const recording::settings& s);
    /// Counts those in who rest on two others, or on one and a wall; from then on they are of the bed, even where they touch
    /// nobody for a while.  Call it now and then before the first frame: a tenth of a bed that moves touches nobody.
    void meet(const bed& b);
    /// Keeps a frame if anybody has left the bed since the last one; call it after each update of the outflow.  Meets the
    /// bed first.
    bool observe(const bed& b);
    /// Mass that has left the bed since the first frame [kg].
    double mass_left() const { return mass_left_; }
    /// The recording, which ends where the number of particles is closest to that of the first frame, in its later
    /// half. Throws bad_value where nothing left, or where the number has changed by more than 5 %.
    recording finish() const;

    /// All that has been seen, with a checksum: a recorder that restores it goes on as this one.  In the byte order of this
    /// machine.
    std::vector<char> state() const;
    /// Into a recorder of the same settings.  Throws state_error with the recorder as it was.
    void restore(const std::vector<char>& state);

  private:
    recording::settings settings_;
    recording record_;
    std::map<std::int64_t, std::uint32_t> slots_;  ///< of the ids of the bed
    double mass_left_ = 0;
};

/// Repeats a recording at any mass flow.  Each state is a frame: a packing of the DEM run as it was.  The next frame
/// comes when the mass of those who leave in between is due, so less than that is ever due.
///
/// A particle keeps the mass that it was fed with; its sphere is that of its slot.
class recorded_bed final : public moving_bed {
  public:
    /// Throws bad_value, or std::invalid_argument where there is no recording.
    recorded_bed(std::shared_ptr<const recording> record, surroundings around, double mass_flow,
                 const decomposition& spread = {});
    vector3 velocity(index i) const override;
    const recording& record() const { return *record_; }

  private:
    void move(double seconds, passage& done) override;
    std::uint64_t fingerprint() const override { return fingerprint_; }
    void next(std::vector<index>& origin, std::vector<index>& leaving) const;

    std::shared_ptr<const recording> record_;
    std::uint64_t fingerprint_;
};

}  // namespace hearth::dem

template <>
struct hearth::contact_traits<hearth::dem::recorded_bed> : contact_traits<hearth::dem::moving_bed> {};
