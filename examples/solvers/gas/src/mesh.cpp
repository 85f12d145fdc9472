// SPDX-License-Identifier: MIT
#include <hearth/gas/mesh.hpp>

#include <algorithm>
#include <cmath>

namespace hearth::gas {

namespace {

std::string named(const char* noun, int i) { return std::string(noun) + " " + std::to_string(i); }

}  // namespace

mesh::mesh(polyhedra shape_) : patches(shape_.patches), shape(std::move(shape_)) {
    owner = std::move(shape.owner);
    neighbour = std::move(shape.neighbour);
    check_topology();
    int last = -1;
    for (const int c : owner) last = std::max(last, c);
    for (const int c : neighbour) last = std::max(last, c);
    owned_cells_ = last + 1;
    for (auto* numbers : {&shape.face_first, &shape.face_points, &owner, &neighbour}) numbers->shrink_to_fit();
    shape.points.shrink_to_fit();
    compute_geometry();
    check_geometry();
    compute_weights();
}

void mesh::check_topology() const {
    const int face_count = faces(), internal = internal_faces();
    const int point_count = static_cast<int>(shape.points.size());
    if (face_count == 0) throw mesh_error("there are no faces", -1, -1);
    if (static_cast<int>(shape.face_first.size()) != face_count + 1)
        throw mesh_error(std::to_string(shape.face_first.size() - 1) + " faces have points, but " +
                             std::to_string(face_count) + " have an owner", -1, -1);
    if (internal > face_count) throw mesh_error("more neighbours than owners", -1, -1);
    for (std::size_t i = 0; i < shape.points.size(); ++i)
        if (!is_finite(shape.points[i])) throw mesh_error("point " + std::to_string(i) + " is not finite", -1, -1);
    for (int f = 0; f < face_count; ++f) {
        if (shape.face_first[f + 1] - shape.face_first[f] < 3)
            throw mesh_error(named("face", f) + " has fewer than 3 points", -1, f);
        for (int i = shape.face_first[f]; i < shape.face_first[f + 1]; ++i)
            if (shape.face_points[i] < 0 || shape.face_points[i] >= point_count)
                throw mesh_error(named("face", f) + " uses point " + std::to_string(shape.face_points[i]) +
                                     ", but there are " + std::to_string(point_count), -1, f);
        if (owner[f] < 0) throw mesh_error(named("face", f) + " has no owner", owner[f], f);
        if (f < internal && owner[f] >= neighbour[f])
            throw mesh_error(named("face", f) + ": owner " + std::to_string(owner[f]) + " is not below neighbour " +
                                 std::to_string(neighbour[f]), owner[f], f);
    }
    int next = internal;
    for (const patch& p : patches) {
        if (p.first != next || p.count < 0)
            throw mesh_error("patch '" + p.name + "' begins at face " + std::to_string(p.first) + ", expected " +
                                 std::to_string(next), -1, p.first);
        next += p.count;
    }
    if (next != face_count)
        throw mesh_error("the patches end at face " + std::to_string(next) + " of " + std::to_string(face_count), -1,
                         next);
}

void mesh::compute_geometry() {
    const int face_count = faces(), internal = internal_faces();
    area.resize(face_count);
    face_centre.resize(face_count);
    for (int f = 0; f < face_count; ++f) {
        const int* point = &shape.face_points[shape.face_first[f]];
        const int n = shape.face_first[f + 1] - shape.face_first[f];
        vector3 middle;
        for (int i = 0; i < n; ++i) middle += shape.points[point[i]];
        middle *= 1.0 / n;
        vector3 sum, moment;
        double weight = 0;
        for (int i = 0; i < n; ++i) {  // triangles with the mean point: exact area of warped faces too
            const vector3 &a = shape.points[point[i]], &b = shape.points[point[(i + 1) % n]];
            const vector3 s = 0.5 * cross(b - a, middle - a);
            sum += s;
            const double w = norm(s);
            weight += w;
            moment += w / 3 * (a + b + middle);
        }
        area[f] = sum;
        face_centre[f] = weight > 0 ? 1 / weight * moment : middle;
    }
    const int cell_count = owned_cells_;
    volume.assign(cell_count, 0.0);
    centre.assign(cell_count, {});
    array<vector3> middle(cell_count);
    array<int> touched(cell_count, 0);
    const auto for_each_side = [&](auto visit) {
        for (int f = 0; f < face_count; ++f) {
            visit(owner[f], f, 1.0);
            if (f < internal) visit(neighbour[f], f, -1.0);
        }
    };
    for_each_side([&](int c, int f, double) { middle[c] += face_centre[f]; ++touched[c]; });
    for (int c = 0; c < cell_count; ++c)
        if (touched[c] > 0) middle[c] *= 1.0 / touched[c];
    for_each_side([&](int c, int f, double sign) {  // pyramids with the mean of the face centres as top
        const double v = sign * dot(area[f], face_centre[f] - middle[c]) / 3;
        volume[c] += v;
        centre[c] += v * (0.75 * face_centre[f] + 0.25 * middle[c]);
    });
    for (int c = 0; c < cell_count; ++c) centre[c] *= 1 / volume[c];
}

void mesh::check_geometry() const {
    const int internal = internal_faces();
    array<vector3> sum(cells());
    array<double> surface(cells(), 0.0);
    array<int> count(cells(), 0);
    for (int f = 0; f < faces(); ++f) {
        const double s = norm(area[f]);
        if (!(s > 0)) throw mesh_error(named("face", f) + " has no area", owner[f], f);
        sum[owner[f]] += area[f];
        surface[owner[f]] += s;
        ++count[owner[f]];
        if (f < internal) {
            sum[neighbour[f]] -= area[f];
            surface[neighbour[f]] += s;
            ++count[neighbour[f]];
        }
    }
    for (int c = 0; c < owned_cells_; ++c) {
        if (count[c] < 4) throw mesh_error(named("cell", c) + " has " + std::to_string(count[c]) + " faces", c, -1);
        if (norm(sum[c]) > 1e-9 * surface[c])  // round-off of the sums is about 1e-15 of the surface
            throw mesh_error(named("cell", c) + " is not closed: its area vectors add up to " +
                                 std::to_string(norm(sum[c]) / surface[c]) + " of its surface", c, -1);
        if (!(volume[c] > 0))
            throw mesh_error(named("cell", c) + " has volume " + std::to_string(volume[c]) + " m^3", c, -1);
    }
}

void mesh::compute_weights() {
    const int internal = internal_faces();
    conductance.resize(faces());
    owner_weight.resize(internal);
    double least_cosine = 1;
    for (int f = 0; f < faces(); ++f) {
        const vector3 to_face = face_centre[f] - centre[owner[f]];
        const vector3 d = f < internal ? centre[neighbour[f]] - centre[owner[f]] : to_face;
        const double across = dot(area[f], d), size = norm(area[f]);
        // On the boundary the foot of the perpendicular is what counts; between cells the line of centres.
        if (!(across > 0))
            throw mesh_error(named("face", f) + " has its owner " + std::to_string(owner[f]) + " on the wrong side",
                             owner[f], f);
        conductance[f] = size * size / across;
        if (f < internal) {
            const double near_owner = std::abs(dot(area[f], to_face));
            const double near_neighbour = std::abs(dot(area[f], centre[neighbour[f]] - face_centre[f]));
            owner_weight[f] = near_neighbour / (near_owner + near_neighbour);
            least_cosine = std::min(least_cosine, across / (size * norm(d)));
        }
    }
    largest_angle = std::acos(std::min(1.0, least_cosine)) * 180 / std::acos(-1.0);
}

const patch& mesh::find_patch(const std::string& name) const {
    std::string names;
    for (const patch& p : patches) {
        if (p.name == name) return p;
        names += (names.empty() ? "" : ", ") + p.name;
    }
    throw std::invalid_argument("hearth::gas: no patch is called '" + name + "'; there are: " + names);
}

double mesh::area_of(const patch& p) const {
    double sum = 0;
    for (int f = p.first; f < p.first + p.count; ++f) sum += norm(area[f]);
    return sum;
}

}  // namespace hearth::gas
