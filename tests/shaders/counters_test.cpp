#include "shared/counters.h"

#include <gtest/gtest.h>

#include <set>
#include <string_view>

namespace voxilux::gpu {
namespace {

// Reports show these names; that each number has one is checked where they are listed.
TEST(Counters, counters_keep_the_names_of_reports) {
    EXPECT_EQ(std::set<std::string_view>(kCounterNames.begin(), kCounterNames.end()),
              (std::set<std::string_view>{
                  "ray_unsound",       "march_exhausted", "film_clamped",  "film_non_finite", "ao_table_full",
                  "photon_store_full", "photon_power",    "path_too_long", "loop_cut",        "hits",
                  "ao_rays",           "sun_rays",        "ao_reused",     "ao_searches",     "ao_probes",
                  "ao_claimed",        "ao_evicted",      "ao_dropped",    "ao_own_rays",     "ao_swaps",
                  "photons_stored",    "path_segments"}));
    EXPECT_EQ(kCounterNames.size(), kCounterCount);
    EXPECT_STREQ(kCounterNames[kFaultLoopCut], "loop_cut");
    EXPECT_STREQ(kCounterNames[kWorkHits], "hits");
    EXPECT_EQ(kFaultCount, kWorkHits);
}

}  // namespace
}  // namespace voxilux::gpu
