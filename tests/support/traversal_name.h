#pragma once

// Traversals as parameters of tests: how they are printed and named.

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "world/march_world.h"

namespace voxilux {

inline void PrintTo(Traversal traversal, std::ostream* out) {
    *out << name_of(traversal);
}

namespace test {

inline std::string traversal_name(const testing::TestParamInfo<Traversal>& one) {
    return std::string(name_of(one.param));
}

}  // namespace test
}  // namespace voxilux
