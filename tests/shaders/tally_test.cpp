#include "shared/tally.h"

#include <gtest/gtest.h>

#include <set>
#include <string_view>

namespace voxilux::gpu {
namespace {

// Reports show these names; that each number has one is checked where they are listed.
TEST(Tally, counters_keep_the_names_of_reports) {
    EXPECT_EQ(std::set<std::string_view>(kTallyNames.begin(), kTallyNames.end()),
              (std::set<std::string_view>{
                  "ray_unsound",       "march_exhausted", "film_clamped",  "film_non_finite", "ao_table_full",
                  "photon_store_full", "photon_power",    "path_too_long", "loop_cut",        "hits",
                  "ao_rays",           "sun_rays",        "ao_reused",     "ao_searches",     "ao_probes",
                  "ao_claimed",        "ao_evicted",      "ao_dropped",    "ao_own_rays",     "ao_swaps",
                  "photons_stored",    "path_segments"}));
    EXPECT_EQ(kTallyNames.size(), kTallyCount);
    EXPECT_STREQ(kTallyNames[kFaultLoopCut], "loop_cut");
    EXPECT_STREQ(kTallyNames[kWorkHits], "hits");
    EXPECT_EQ(kFaultCount, kWorkHits);
}

}  // namespace
}  // namespace voxilux::gpu
