#pragma once

#include <cstdio>
#include <cstdlib>

// Ends the process, which libFuzzer takes for a find, where a property does not hold.
inline void require(bool holds, const char* property) {
    if (holds) return;
    std::fprintf(stderr, "property broken: %s\n", property);
    std::abort();
}
