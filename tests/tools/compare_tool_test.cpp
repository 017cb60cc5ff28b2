#include "compare/compare.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "formats/exr.h"
#include "formats/image_file.h"
#include "formats/png.h"
#include "support/scratch_folder.h"
#include "support/test_images.h"

using namespace voxilux;

namespace {

constexpr int kDone = static_cast<int>(ExitCode::done);
constexpr int kOver = static_cast<int>(ExitCode::over_threshold);

// A reference of 0.5 and a test image of 0.75, both EXR, 16x16.
struct Pair {
    ScratchFolder folder;
    CompareOptions options{.ref = folder / "ref.exr", .test = folder / "test.exr"};

    Pair() {
        write_exr(options.ref, test::constant_image(16, 16, 0.5f));
        write_exr(options.test, test::constant_image(16, 16, 0.75f));
    }

    nlohmann::ordered_json json() {
        options.json = (folder / "out.json").string();
        run_compare(options);
        const std::vector<std::byte> bytes = read_file(options.json);
        return nlohmann::ordered_json::parse(
            std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    }
};

ExitCode refusal(const CompareOptions& options) {
    try {
        run_compare(options);
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.code();
    }
    return ExitCode::done;
}

}  // namespace

TEST(CompareTool, json_has_exactly_the_keys_of_the_contract) {
    Pair pair;
    const auto json = pair.json();
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items())
        keys.push_back(key);
    EXPECT_EQ(keys, (std::vector<std::string>{"rmse", "mae", "relmse", "smape", "flip", "psnr", "mean_ref",
                                              "mean_test", "max_abs"}));
    EXPECT_DOUBLE_EQ(json["rmse"], 0.25);
    EXPECT_DOUBLE_EQ(json["relmse"], 0.0625 / 0.26);
    EXPECT_EQ(json["mean_test"], (std::vector<double>{0.75, 0.75, 0.75}));
    EXPECT_TRUE(json["flip"].is_number());
}

TEST(CompareTool, equal_images_pass_every_limit_of_zero) {
    Pair pair;
    pair.options.test = pair.options.ref;
    for (const char* name : {"rmse", "relmse", "flip", "mae", "abs"})
        pair.options.max[name] = 0.0;
    EXPECT_EQ(run_compare(pair.options), kDone);
    const auto json = pair.json();
    EXPECT_TRUE(json["psnr"].is_null());
    EXPECT_EQ(json["flip"], 0.0);
}

TEST(CompareTool, each_limit_fails_when_it_is_exceeded) {
    Pair pair;
    for (const char* name : {"rmse", "relmse", "flip", "mae", "abs"}) {
        pair.options.max = {{name, 1e-3}};
        EXPECT_EQ(run_compare(pair.options), kOver) << name;
        pair.options.max = {{name, 1.0}};
        EXPECT_EQ(run_compare(pair.options), kDone) << name;
    }
}

TEST(CompareTool, nan_in_the_test_image_passes_no_limit) {
    Pair pair;
    // A single pixel does not compress, so its floats lie in the file as they are; write_exr itself stores no
    // NaN.
    const float mark = 0.7071f, nan = std::numeric_limits<float>::quiet_NaN();
    write_exr(pair.options.ref, test::constant_image(1, 1, mark));
    std::vector<std::byte> bytes = read_file(pair.options.ref);
    const auto needle = std::as_bytes(std::span(&mark, 1));
    const auto at = std::search(bytes.begin(), bytes.end(), needle.begin(), needle.end());
    ASSERT_NE(at, bytes.end());
    std::memcpy(&*at, &nan, sizeof nan);
    write_file_atomically(pair.options.test, bytes);
    const auto json = pair.json();
    EXPECT_TRUE(json["rmse"].is_null());
    EXPECT_TRUE(json["flip"].is_null());
    for (const char* name : {"rmse", "relmse", "flip", "mae", "abs"}) {
        pair.options.max = {{name, 1e30}};
        EXPECT_EQ(run_compare(pair.options), kOver) << name;
    }
}

TEST(CompareTool, black_reference_has_no_flip_and_fails_its_limit) {
    Pair pair;
    write_exr(pair.options.ref, test::constant_image(16, 16, 0.0f));
    EXPECT_TRUE(pair.json()["flip"].is_null());
    pair.options.max = {{"flip", 1.0}};
    EXPECT_EQ(run_compare(pair.options), kOver);
}

TEST(CompareTool, box_and_mask_restrict_the_comparison) {
    Pair pair;
    write_exr(pair.options.test,
              test::rgb_image(16, 16, [](int x, int, int) { return x < 8 ? 0.5f : 0.75f; }));
    pair.options.max = {{"abs", 0.0}};
    EXPECT_EQ(run_compare(pair.options), kOver);
    pair.options.box = {0, 0, 8, 16};
    EXPECT_EQ(run_compare(pair.options), kDone);
    pair.options.box = {0, 0, 9, 16};
    EXPECT_EQ(run_compare(pair.options), kOver);
    pair.options.box.reset();
    pair.options.mask = pair.folder / "mask.png";
    write_png(pair.options.mask,
              test::rgb_image(16, 16, [](int x, int, int) { return x < 8 ? 1.0f : 0.0f; }));
    EXPECT_EQ(run_compare(pair.options), kDone);
}

TEST(CompareTool, unusable_inputs_are_refused) {
    Pair pair;
    CompareOptions options = pair.options;
    options.ref = pair.folder / "absent.exr";
    EXPECT_EQ(refusal(options), ExitCode::input_refused);
    options = pair.options;
    write_exr(options.test, test::constant_image(16, 15, 0.5f));
    EXPECT_EQ(refusal(options), ExitCode::input_refused);
    Image depth{.width = 16, .height = 16};
    depth.channels["Z"].pixels.assign(256, 1.0f);
    write_exr(options.test, depth);
    EXPECT_EQ(refusal(options), ExitCode::input_refused);
    options = pair.options;
    options.box = {0, 0, 17, 1};
    EXPECT_EQ(refusal(options), ExitCode::input_refused);
}

TEST(CompareTool, png_pair_is_compared_in_linear_light) {
    Pair pair;
    pair.options.ref = pair.folder / "a.png";
    pair.options.test = pair.folder / "b.png";
    write_image(pair.options.ref, test::code_image(16, 16, [](int, int, int) { return 0u; }));
    write_image(pair.options.test, test::code_image(16, 16, [](int, int, int) { return 188u; }));
    const double linear = std::pow((188.0 / 255.0 + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(pair.json()["mae"].get<double>(), linear, 1e-6);
}

TEST(CompareTool, difference_picture_shows_where_the_error_is) {
    Pair pair;
    pair.options.diff = pair.folder / "diff.exr";
    run_compare(pair.options);
    const Image diff = read_exr(pair.options.diff);
    EXPECT_EQ(diff.channels.at("G").pixels, std::vector<float>(256, 0.25f));
    EXPECT_TRUE(diff.channels.contains("flip.Y"));
    pair.options.diff = pair.folder / "diff.png";
    run_compare(pair.options);
    EXPECT_GT(read_png(pair.options.diff).channels.at("R").pixels[0], 0.0f);
    pair.options.diff = pair.folder / "diff.txt";
    EXPECT_EQ(refusal(pair.options), ExitCode::usage);
}

TEST(CompareTool, command_line_fills_the_options) {
    CLI::App app;
    CompareOptions options;
    Flags flags(app);
    add_compare_flags(flags, options);
    app.parse("a.exr b.exr --json - --box 1,2,3,4 --max-flip 0.01 --max-abs 2 --mask m.png --diff d.png");
    EXPECT_EQ(options.ref, "a.exr");
    EXPECT_EQ(options.test, "b.exr");
    EXPECT_EQ(options.json, "-");
    ASSERT_TRUE(options.box);
    EXPECT_EQ(options.box->x0, 1);
    EXPECT_EQ(options.box->y0, 2);
    EXPECT_EQ(options.box->x1, 3);
    EXPECT_EQ(options.box->y1, 4);
    EXPECT_EQ(options.max, (std::map<std::string, double>{{"flip", 0.01}, {"abs", 2.0}}));
    EXPECT_EQ(options.mask, "m.png");
    EXPECT_EQ(options.diff, "d.png");
    EXPECT_THROW(app.parse("a.exr"), CLI::ParseError);
    EXPECT_THROW(app.parse("a.exr b.exr --max-rmse -1"), Error);
}
