#include "jobs/render_outcome.h"

#include <gtest/gtest.h>

namespace voxilux {
namespace {

TEST(RenderOutcome, every_fault_but_a_full_table_of_cells_may_hide_light) {
    EXPECT_FALSE(lacks_light({}));
    for (const char* name : {"ray_unsound", "march_exhausted", "film_clamped", "film_non_finite",
                             "photon_store_full", "photon_power", "path_too_long", "loop_cut"}) {
        EXPECT_TRUE(lacks_light({{name, 1}})) << name;
        EXPECT_FALSE(lacks_light({{name, 0}})) << name;
    }
    EXPECT_FALSE(lacks_light({{"ao_table_full", 9}, {"exr_clamped", 1}}));
}

}  // namespace
}  // namespace voxilux
