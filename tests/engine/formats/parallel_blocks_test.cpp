#include "base/parallel_blocks.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace voxilux {
namespace {

TEST(ParallelBlocks, parts_cover_all_of_the_work_once) {
    for (const std::size_t count : {0u, 1u, 7u, 64u, 1000u})
        for (const std::size_t part : {1u, 8u, 1000u}) {
            std::vector<std::atomic<int>> done(count);
            for_each_part(count, part, [&](std::size_t first, std::size_t end) {
                EXPECT_LE(end - first, part);
                for (std::size_t i = first; i < end; ++i)
                    ++done[i];
            });
            for (const std::atomic<int>& times : done)
                EXPECT_EQ(times, 1) << count << " in parts of " << part;
        }
}

TEST(ParallelBlocks, no_more_threads_are_made_than_there_is_work_for) {
    std::atomic<int> workers{0};
    for_each_block(3, 16, [&] {
        ++workers;
        return [](std::size_t) {};
    });
    EXPECT_LE(workers, 3);
    EXPECT_EQ(threads_for(0, 100), 1u);
    EXPECT_EQ(threads_for(99, 100), 1u);
    EXPECT_LE(threads_for(250, 100), 3u);
}

TEST(ParallelBlocks, first_exception_ends_the_others_and_is_thrown_again) {
    std::atomic<std::size_t> done{0};
    const auto run = [&] {
        for_each_block(100000, 4, [&] {
            return [&](std::size_t i) {
                if (i == 10) throw std::runtime_error("ten");
                ++done;
            };
        });
    };
    EXPECT_THROW(run(), std::runtime_error);
    EXPECT_LT(done, 100000u);
}

}  // namespace
}  // namespace voxilux
