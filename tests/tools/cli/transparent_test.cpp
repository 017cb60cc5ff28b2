// Images without a background, laid over a colour: the render over that colour, shadows included.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "formats/exr.h"
#include "formats/png.h"
#include "support/scratch_folder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

constexpr float kHalf = 0x1p-9f;  // relative: two roundings to halves

class TransparentPictures {
  public:
    TransparentPictures() : cut_(render({"--transparent"}, "cut")) {}

    // Values of the render over a colour that are not those of the transparent image laid over 20a1fe: to an
    // EXR's halves, and to one code of a PNG.
    int differences(const std::string& colour) {
        const Pictures laid = render({"--background", colour}, colour.substr(1));
        int count = 0;
        for (std::size_t i = 0; i < pixel_count(cut_.exr); ++i)
            for (int c = 0; c < 3; ++c)
                count += is_off_exr(laid, i, c) || is_off_png(laid, i, c) ? 1 : 0;
        return count;
    }

    // Pixels that are neither the scene alone nor the background alone.
    [[nodiscard]] std::ptrdiff_t partly_covered() const {
        const auto& alphas = cut_.exr.channels.at("A").pixels;
        return std::ranges::count_if(alphas, [](float alpha) { return alpha > 0.05f && alpha < 0.95f; });
    }

  private:
    struct Pictures {
        Image exr;
        Image png;
    };
    static constexpr std::array<std::uint8_t, 3> kColour{0x20, 0xa1, 0xfe};

    Pictures render(const Words& how, const std::string& name) {
        const Words scene = {"render",      scene_file("shadow_catcher"),
                             "--size",      "64x36",
                             "--spp",       "4",
                             "--exposure",  "0",
                             "-q",          "-o",
                             name + ".exr", "-o",
                             name + ".png"};
        EXPECT_EQ(run(with(scene, how), {.folder = scratch_.path()}).code, 0) << name;
        return {read_exr(scratch_ / (name + ".exr")), read_png(scratch_ / (name + ".png"))};
    }

    static float value(const Image& image, int c, std::size_t i) {
        return image.channels.at(std::string(1, "RGBA"[c])).pixels[i];
    }

    [[nodiscard]] bool is_off_exr(const Pictures& laid, std::size_t i, int c) const {
        const float behind = linear_from_srgb(kColour[static_cast<std::size_t>(c)]);
        const float want = value(cut_.exr, c, i) + (1.0f - value(cut_.exr, 3, i)) * behind;
        return std::abs(want - value(laid.exr, c, i)) > kHalf * std::max(want, 1.0f);
    }

    [[nodiscard]] bool is_off_png(const Pictures& laid, std::size_t i, int c) const {
        const double alpha = value(cut_.png, 3, i);
        const double over =
            alpha * srgb_code(value(cut_.png, c, i)) + (1.0 - alpha) * kColour[static_cast<std::size_t>(c)];
        return std::abs(std::round(over) - srgb_code(value(laid.png, c, i))) > 1.0;
    }

    const ScratchFolder scratch_;
    Pictures cut_;
};

TEST(TransparentNightly, image_over_a_colour_is_the_render_over_it_shadows_included) {
    TransparentPictures pictures;
    EXPECT_GT(pictures.partly_covered(), 50);
    EXPECT_EQ(pictures.differences("#20a1fe"), 0);
    EXPECT_GT(pictures.differences("#20a1f0"), 100) << "the negative control: another blue";
}

}  // namespace
}  // namespace voxilux::test
