// SPDX-License-Identifier: MIT
#include <hearth/gas/gradient.hpp>

namespace hearth::gas {

gradient::gradient(const mesh& m) : mesh_(&m), inverse_(m.cells(), symmetric{0, 0, 0, 0, 0, 0}) {
    const auto add = [&](int c, const vector3& d) {
        const double w = 1 / dot(d, d);
        symmetric& s = inverse_[c];
        s.xx += w * d.x * d.x;
        s.xy += w * d.x * d.y;
        s.xz += w * d.x * d.z;
        s.yy += w * d.y * d.y;
        s.yz += w * d.y * d.z;
        s.zz += w * d.z * d.z;
    };
    const int internal = m.internal_faces();
    for (int f = 0; f < m.faces(); ++f) {
        const int p = m.owner[f];
        const vector3 d = (f < internal ? m.centre[m.neighbour[f]] : m.face_centre[f]) - m.centre[p];
        add(p, d);
        if (f < internal) add(m.neighbour[f], d);
    }
    for (int c = 0; c < m.owned_cells(); ++c) {
        symmetric& s = inverse_[c];
        const double a = s.yy * s.zz - s.yz * s.yz, b = s.xz * s.yz - s.xy * s.zz, e = s.xy * s.yz - s.xz * s.yy;
        const double det = s.xx * a + s.xy * b + s.xz * e;
        if (!(det > 0)) throw mesh_error("cell " + std::to_string(c) + " has its faces in one plane", c, -1);
        s = {a / det, b / det, e / det, (s.xx * s.zz - s.xz * s.xz) / det, (s.xy * s.xz - s.xx * s.yz) / det,
             (s.xx * s.yy - s.xy * s.xy) / det};
    }
}

template <int Width>
void gradient::solve(vector3* sums) const {
    for (int c = 0; c < mesh_->owned_cells(); ++c) {
        const symmetric& s = inverse_[c];
        for (int k = 0; k < Width; ++k) {
            vector3& g = sums[Width * c + k];
            g = {s.xx * g.x + s.xy * g.y + s.xz * g.z, s.xy * g.x + s.yy * g.y + s.yz * g.z,
                 s.xz * g.x + s.yz * g.y + s.zz * g.z};
        }
    }
}
template void gradient::solve<1>(vector3*) const;

template <int Width>
void gradient::compute(const double* field, const double* boundary, vector3* out) const {
    const mesh& m = *mesh_;
    const int internal = m.internal_faces();
    for (int i = 0; i < Width * m.cells(); ++i) out[i] = {};
    for (int f = 0; f < internal; ++f) {
        const int p = m.owner[f], q = m.neighbour[f];
        const vector3 d = m.centre[q] - m.centre[p];
        const double w = 1 / dot(d, d);
        for (int k = 0; k < Width; ++k) {
            const vector3 step = w * (field[Width * q + k] - field[Width * p + k]) * d;
            out[Width * p + k] += step;
            out[Width * q + k] += step;
        }
    }
    for (int f = internal; f < m.faces(); ++f) {
        const int p = m.owner[f];
        const vector3 d = m.face_centre[f] - m.centre[p];
        const double w = 1 / dot(d, d);
        for (int k = 0; k < Width; ++k)
            out[Width * p + k] += w * (boundary[Width * (f - internal) + k] - field[Width * p + k]) * d;
    }
    solve<Width>(out);
}
template void gradient::compute<1>(const double*, const double*, vector3*) const;
template void gradient::compute<3>(const double*, const double*, vector3*) const;

}  // namespace hearth::gas
