// SPDX-License-Identifier: MIT
// Uses the lowest layer alone.
#include <cdt/predicates.h>

int main() { return loft::cdt::orient({0, 0}, {1, 0}, {0, 1}) == 1 ? 0 : 1; }
