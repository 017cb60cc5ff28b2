#include <gtest/gtest.h>

#include "base/assert.h"
#include "vk/program.h"

namespace voxilux {
namespace {

using Groups = std::array<std::uint32_t, 3>;

constexpr Groups kLimit{65535, 65535, 65535};
constexpr Groups kList{64, 1, 1};
constexpr Groups kImage{8, 8, 1};

TEST(GroupCounts, extents_are_divided_rounding_up) {
    EXPECT_EQ(group_counts("t", {1, 1, 1}, kList, kLimit), (Groups{1, 1, 1}));
    EXPECT_EQ(group_counts("t", {64, 1, 1}, kList, kLimit), (Groups{1, 1, 1}));
    EXPECT_EQ(group_counts("t", {65, 1, 1}, kList, kLimit), (Groups{2, 1, 1}));
    EXPECT_EQ(group_counts("t", {17, 16, 3}, kImage, kLimit), (Groups{3, 2, 3}));
}

TEST(GroupCounts, long_list_is_folded_and_covers_every_element) {
    EXPECT_EQ(group_counts("t", {65535u * 64u, 1, 1}, kList, kLimit), (Groups{65535, 1, 1}));
    for (const std::uint32_t extent : {65535u * 64u + 1u, 65536u * 64u, 100'000'007u, 4'000'000'000u}) {
        const Groups groups = group_counts("t", {extent, 1, 1}, kList, kLimit);
        const std::uint64_t covered = std::uint64_t{groups[0]} * groups[1] * 64;
        EXPECT_LE(groups[0], kLimit[0]);
        EXPECT_GE(covered, extent);
        EXPECT_LE(covered, std::uint64_t{1} << 32);              // linear ids do not wrap
        EXPECT_LT(covered - extent, std::uint64_t{65536} * 64);  // less than a row is surplus
    }
}

TEST(GroupCounts, extents_that_do_not_fit_are_refused_by_name) {
    try {
        (void)group_counts("too_wide", {65535u * 8u + 1u, 2, 1}, kImage, kLimit);
        FAIL() << "no error";
    } catch (const InternalError& error) {
        EXPECT_NE(std::string(error.what()).find("too_wide"), std::string::npos);
    }
    EXPECT_THROW((void)group_counts("t", {0xFFFFFFFFu, 1, 1}, kList, kLimit), InternalError);
    EXPECT_THROW((void)group_counts("t", {65535u * 64u + 1u, 1, 1}, kImage, {1000, 65535, 65535}),
                 InternalError);
}

}  // namespace
}  // namespace voxilux
