// SPDX-License-Identifier: MIT
#pragma once

/// Plain arrays as a host, for codes in C and Fortran and for those that already hold what hearth asks: face_mesh is the
/// mesh, strided_cloud the particles, strided the fields, and sphere_contacts who touches whom.
#include <hearth/core/face_mesh.hpp>
#include <hearth/core/strided_cloud.hpp>
#include <hearth/transfer/sphere_contacts.hpp>
