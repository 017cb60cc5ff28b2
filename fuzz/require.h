#pragma once

#include <cstdio>
#include <cstdlib>

// Aborts where a property does not hold; libFuzzer records that as a crash.
inline void require(bool holds, const char* property) {
    if (holds) return;
    std::fprintf(stderr, "property broken: %s\n", property);
    std::abort();
}
