// SPDX-License-Identifier: MIT
#include "both.hpp"

int main() { return cxx17().standard == 201703L && cxx20().standard >= 202002L ? 0 : 1; }
