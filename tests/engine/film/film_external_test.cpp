// Images that other programs wrote, measured by other programs: the constants come from numpy 2.4 in double
// precision over pixels read with OpenEXR 3.5, and from flip-evaluator 1.7.

#include <gtest/gtest.h>

#include <cmath>

#include "estimators/flip.h"
#include "estimators/metrics.h"
#include "formats/exr.h"
#include "support/shared_data.h"

using namespace voxilux;

namespace {

constexpr double kRelative = 1e-12;      // numpy sums pairwise, we sum compensated
constexpr double kFlipTolerance = 1e-4;  // as in flip_test.cpp

Image reference_image(const char* name) {
    return read_exr(shared_data() / "data" / "reference" / name);
}

void expect_close(double value, double expected) {
    EXPECT_NEAR(value, expected, kRelative * std::abs(expected));
}

}  // namespace

TEST(FilmExternal, metrics_of_two_foreign_images_match_numpy) {
    SKIP_WITHOUT_SHARED_DATA();
    const Image ref = reference_image("cornell_512x384.exr");
    const Image test = reference_image("surgery_512x384.exr");
    const Metrics m = measure_difference(ref, test, selected_pixels(ref.width, ref.height, {}));
    expect_close(m.rmse, 2.25681812889705);
    expect_close(m.mae, 0.820796718946762);
    expect_close(m.relmse, 41.3924759235356);
    expect_close(m.smape, 0.944880186178339);
    expect_close(m.max_abs, 19.9676601523533);
    expect_close(m.mean_ref[0], 0.609976294115951);
    expect_close(m.mean_ref[1], 0.278471344553366);
    expect_close(m.mean_ref[2], 0.456399485582177);
}

TEST(FilmExternal, hdr_flip_of_two_foreign_images_matches_the_authors_program) {
    SKIP_WITHOUT_SHARED_DATA();
    const Image ref = reference_image("cornell_512x384.exr");
    const auto result = flip(ref, reference_image("surgery_512x384.exr"));
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(result->exposures, 7);
    EXPECT_NEAR(mean_flip(*result, selected_pixels(ref.width, ref.height, {})), 0.784487342657,
                kFlipTolerance);
}
