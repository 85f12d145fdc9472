// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/function.hpp>

namespace hearth::closure {

/// Eight-point Gauss-Legendre rule on [0, 1], exact for polynomials of degree 15.
template <class Real>
struct gauss_legendre {
    HEARTH_FUNCTION static constexpr int count() { return 8; }

    HEARTH_FUNCTION static constexpr Real node(int k) {
        constexpr Real nodes[8]{Real(0.019855071751231884158219565715L), Real(0.101666761293186630204223031762L),
                                Real(0.237233795041835507091130475405L), Real(0.408282678752175097530261928820L),
                                Real(0.591717321247824902469738071180L), Real(0.762766204958164492908869524595L),
                                Real(0.898333238706813369795776968238L), Real(0.980144928248768115841780434285L)};
        return nodes[k];
    }

    HEARTH_FUNCTION static constexpr Real weight(int k) {
        constexpr Real weights[4]{Real(0.050614268145188129576265677155L), Real(0.111190517226687235272177997213L),
                                  Real(0.156853322938943643668981100993L), Real(0.181341891689180991482575224639L)};
        return weights[k < 4 ? k : 7 - k];
    }
};

}  // namespace hearth::closure
