#include "view/resolution.h"

#include <gtest/gtest.h>

namespace voxilux {
namespace {

constexpr glm::ivec2 kWindow{1280, 720};

// A device that takes `fixed_s`, and `pixel_s` for each pixel.
struct Device {
    double fixed_s = 0.0;
    double pixel_s = 0.0;

    [[nodiscard]] double time_of(glm::ivec2 size) const { return fixed_s + pixel_s * size.x * size.y; }
};

// The number of frames until the size stays for twenty of them; a thousand means never.
int frames_until_steady(Resolution& resolution, const Device& device) {
    resolution.start();
    int steady = 0;
    for (int frame = 0; frame < 1000; ++frame) {
        const bool is_other = resolution.learn(device.time_of(resolution.size_in(kWindow)));
        if (is_other) resolution.start();
        steady = is_other ? 0 : steady + 1;
        if (steady == 20) return frame - 19;
    }
    return 1000;
}

TEST(Resolution, settles_within_the_budget_on_fast_and_slow_devices) {
    for (const Device& device : {Device{0.0, 1e-7}, {0.004, 4e-7}, {0.004, 1.5e-6}, {0.001, 3e-9}}) {
        Resolution resolution;
        resolution.set_budget(0.025);
        EXPECT_LT(frames_until_steady(resolution, device), 40) << device.pixel_s;
        EXPECT_LT(device.time_of(resolution.size_in(kWindow)), 1.2 * 0.025) << device.pixel_s;
    }
}

TEST(Resolution, fast_device_shows_every_pixel) {
    Resolution resolution;
    resolution.set_budget(0.025);
    (void)frames_until_steady(resolution, {0.001, 3e-9});
    EXPECT_EQ(resolution.size_in(kWindow), kWindow);
}

TEST(Resolution, first_frames_of_a_plan_do_not_count) {
    Resolution resolution;
    resolution.set_budget(0.025);
    const glm::ivec2 size = resolution.size_in(kWindow);
    resolution.start();
    EXPECT_FALSE(resolution.learn(0.5));               // compiles
    EXPECT_FALSE(resolution.learn(0.3));               // fills occlusion cells
    for (const double frame_s : {0.024, 0.09, 0.023})  // one hiccup
        EXPECT_FALSE(resolution.learn(frame_s));
    EXPECT_EQ(resolution.size_in(kWindow), size);
    for (int i = 0; i < 2; ++i)
        EXPECT_FALSE(resolution.learn(0.1));
    EXPECT_TRUE(resolution.learn(0.1)) << "three slow frames are no hiccup";
}

}  // namespace
}  // namespace voxilux
