// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace hearth::dem {

/// A point or vector in space; the unit stands where it is used.
struct vector3 {
    double x = 0, y = 0, z = 0;

    constexpr double operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
    constexpr double& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
    constexpr vector3& operator+=(const vector3& b) { x += b.x; y += b.y; z += b.z; return *this; }
    constexpr vector3& operator-=(const vector3& b) { x -= b.x; y -= b.y; z -= b.z; return *this; }
    constexpr vector3& operator*=(double s) { x *= s; y *= s; z *= s; return *this; }
};

constexpr vector3 operator+(vector3 a, const vector3& b) { return a += b; }
constexpr vector3 operator-(vector3 a, const vector3& b) { return a -= b; }
constexpr vector3 operator-(const vector3& a) { return {-a.x, -a.y, -a.z}; }
constexpr vector3 operator*(double s, vector3 a) { return a *= s; }
constexpr double dot(const vector3& a, const vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr vector3 cross(const vector3& a, const vector3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const vector3& a) { return std::sqrt(dot(a, a)); }
inline bool is_finite(const vector3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }
/// Length 1 along a; a must not be zero.
inline vector3 unit(const vector3& a) { return (1.0 / norm(a)) * a; }

}  // namespace hearth::dem
