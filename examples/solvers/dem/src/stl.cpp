// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include <hearth/core/error.hpp>

#include <hearth/dem/wall.hpp>

namespace hearth::dem::shape {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) {
    throw std::runtime_error("hearth: STL file " + path + ": " + what);
}

class reader {
  public:
    reader(const std::string& path, double scale, std::size_t& degenerate)
        : path_(path), scale_(scale), degenerate_(degenerate) {}

    void add(const std::array<vector3, 3>& corner) {
        ++read_;
        for (const vector3& c : corner) {
            if (!is_finite(c)) fail(path_, "a corner of triangle " + std::to_string(read_) + " is not finite");
        }
        const triangle t{scale_ * corner[0], scale_ * corner[1], scale_ * corner[2]};
        const vector3 ab = t.b - t.a, ac = t.c - t.a;
        const double longest = std::fmax(dot(ab, ab), dot(ac, ac));
        if (norm(cross(ab, ac)) <= 1e-12 * longest) ++degenerate_;
        else facets_.push_back(t);
    }

    std::vector<facet> finish() {
        if (facets_.empty()) fail(path_, "holds no triangle with an area");
        return std::move(facets_);
    }

  private:
    const std::string& path_;
    double scale_;
    std::size_t& degenerate_;
    std::size_t read_ = 0;
    std::vector<facet> facets_;
};

/// 80 bytes of title, number of triangles, then 50 bytes each: normal and corners as 12 floats, 2 bytes of attributes.
void read_binary(const std::string& bytes, reader& out) {
    static_assert(sizeof(float) == 4);
    for (std::size_t at = 84; at + 50 <= bytes.size(); at += 50) {
        float numbers[12];
        std::memcpy(numbers, bytes.data() + at, sizeof numbers);
        std::array<vector3, 3> corner;
        for (std::size_t c = 0; c < 3; ++c) {
            const float* n = numbers + 3 + 3 * c;
            corner[c] = {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])};
        }
        out.add(corner);
    }
}

void read_text(const std::string& path, const std::string& bytes, reader& out) {
    std::istringstream in(bytes);
    std::string word;
    std::array<vector3, 3> corner;
    std::size_t corners = 0;
    bool ended = false;
    while (in >> word) {
        if (word == "vertex") {
            if (corners == 3) fail(path, "a facet has more than three corners, near byte " + std::to_string(in.tellg()));
            vector3& c = corner[corners++];
            if (!(in >> c.x >> c.y >> c.z)) fail(path, "a vertex without three numbers");
        } else if (word == "endfacet") {
            if (corners != 3) fail(path, "a facet with " + std::to_string(corners) + " corners");
            out.add(corner);
            corners = 0;
        }
        ended = word == "endsolid" || (ended && word != "facet");
    }
    if (!ended) fail(path, "ends before endsolid");
}

}  // namespace

std::vector<facet> stl(const std::string& path, double scale, std::size_t* degenerate) {
    if (!(scale > 0 && std::isfinite(scale)))
        throw bad_value("scale of STL file", bad_value::no_index, scale, "finite and > 0 [m per unit]");
    std::ifstream in(path, std::ios::binary);
    if (!in) fail(path, "cannot be opened");
    const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};

    std::size_t without_area = 0;
    reader out(path, scale, without_area);
    std::uint32_t count = 0;
    if (bytes.size() >= 84) std::memcpy(&count, bytes.data() + 80, 4);
    // Binary files, too, may begin with "solid": their length tells.
    if (bytes.size() >= 84 && bytes.size() == 84 + std::size_t{50} * count) {
        read_binary(bytes, out);
    } else if (bytes.compare(0, 5, "solid") == 0) {
        read_text(path, bytes, out);
    } else {
        fail(path, "is neither text that begins with solid, nor binary of the length that its number of triangles asks");
    }
    std::vector<facet> facets = out.finish();
    if (degenerate) *degenerate = without_area;
    return facets;
}

}  // namespace hearth::dem::shape
