// Parts of a render and their sum, without a device.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <numeric>
#include <random>

#include "base/error.h"
#include "estimators/film_error.h"
#include "jobs/merge_parts.h"
#include "jobs/report.h"
#include "plan/sample_set.h"
#include "renderer/prepared_scene.h"
#include "support/scratch_folder.h"
#include "support/test_images.h"
#include "support/test_scenes.h"

namespace voxilux::test {
namespace {

constexpr std::uint32_t kSamples = 11;

// A scene and its plan, which a part refers to.
struct Job {
    Scene scene;
    RenderPlan plan;
};

const SampleSet kAll = SampleSet::leading(kSamples);

SampleSet shard_of(std::uint32_t number, std::uint32_t count) {
    return SampleSet::shard(number - 1, count, kSamples);
}

Job job_of(const SampleSet& part, std::uint32_t seed = 0, std::uint32_t spp = kSamples) {
    Job job{.scene = white_scene()};
    job.scene.settings.size = {5, 3};
    job.scene.settings.spp = spp;
    job.scene.settings.seed = seed;
    PlanRequest request;
    request.part = part;
    job.plan = prepare_scene(job.scene, request, DeviceLimits{}).plan;
    return job;
}

// The value of a sample: any number that depends on all of its coordinates.
std::int64_t value_of(std::uint32_t sample, std::size_t at) {
    return static_cast<std::int64_t>(hash32(sample * 1000u + static_cast<std::uint32_t>(at))) - (1 << 30);
}

void fill(FilmSums& film, const SampleSet& part, std::uint32_t done) {
    film.even.assign(3, part.even_samples(done));
    film.odd.assign(3, done - part.even_samples(done));
    for (const char* name : {"beauty_a", "beauty_b", "albedo"})
        film.sums[name].assign(5 * 3 * 3, 0);
    film.firsts["depth"].assign(5 * 3, static_cast<float>(part.first()) + 0.1f);
    for (std::uint32_t j = 0; j < done; ++j) {
        const std::uint32_t k = part.sample(j);
        for (std::size_t i = 0; i < 5 * 3 * 3; ++i) {
            film.sums[k % 2 == 0 ? "beauty_a" : "beauty_b"][i] += value_of(k, i);
            film.sums["albedo"][i] += 2 * value_of(k, i);
        }
    }
}

// What a render of these samples leaves after `done` of them.
FilmPart part_after(const SampleSet& part, std::uint32_t done, std::uint32_t seed = 0) {
    const Job job = job_of(part, seed);
    RenderOutcome outcome{.plan = job.plan, .film = FilmSums{.width = 5, .height = 3}};
    outcome.statistics.samples = done;
    outcome.statistics.wall_s = 1.0;
    outcome.statistics.work["hits"] = 10 * done;
    outcome.statistics.faults["ao_table_full"] = done;
    fill(*outcome.film, part, done);
    const nlohmann::ordered_json report = report_json(job.scene, outcome);
    return part_of(job.scene, outcome, report, {.comments = "s.toml", .world_to_camera = glm::mat4(0.1f)},
                   kSamples);
}

FilmPart part_of_samples(const SampleSet& part, std::uint32_t seed = 0) {
    return part_after(part, part.size(), seed);
}

FilmPart saved_and_read(const FilmPart& part) {
    const ScratchFolder scratch;
    (void)write_exr(scratch / "p.exr", image_of(part), part.file);
    return read_part(scratch / "p.exr");
}

std::string refusal_of(PartSum& sum, FilmPart part) {
    try {
        add_part(sum, std::move(part), "new.exr");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        return error.what();
    }
    return "";
}

TEST(FilmPart, file_gives_back_every_bit) {
    FilmPart part = part_of_samples(shard_of(2, 3));
    // Sums that neither float nor double can hold.
    part.film.sums["albedo"] = std::vector<std::int64_t>(45, 0x123456789ABCDEF1);
    part.film.sums["albedo"][7] = std::numeric_limits<std::int64_t>::min();
    part.film.sums["albedo"][8] = -1;
    const FilmPart back = saved_and_read(part);
    EXPECT_EQ(back.film, part.film);
    EXPECT_EQ(back.render, part.render);
    EXPECT_EQ(back.samples, part.samples);
    EXPECT_EQ(back.report, part.report);
    EXPECT_EQ(back.spp, kSamples);
    EXPECT_EQ(back.file.world_to_camera, part.file.world_to_camera);
    EXPECT_EQ(back.file.comments, "s.toml");
    // A change of one bit of one sum is noticed.
    part.film.sums["albedo"][8] ^= 1;
    EXPECT_NE(back.film, part.film);
}

TEST(FilmPart, crop_keeps_its_place_in_the_frame) {
    FilmPart part = part_of_samples(shard_of(1, 2));
    part.file.window = {7, 8, 100, 90};
    const FilmPart back = saved_and_read(part);
    EXPECT_EQ(back.film, part.film) << "of the data window, not of the frame";
    EXPECT_EQ(back.file.window.x, 7);
    EXPECT_EQ(back.file.window.full_height, 90);
}

TEST(FilmPart, rows_ahead_have_one_sample_more) {
    FilmPart part = part_after(shard_of(2, 3), 2);
    part.rows_ahead = 2;
    part.sample_ahead = 7;
    const FilmPart back = saved_and_read(part);
    // Samples 1 and 4; in the upper two rows 7, too.
    EXPECT_EQ(back.film.even, (std::vector<std::uint32_t>{1, 1, 1}));
    EXPECT_EQ(back.film.odd, (std::vector<std::uint32_t>{2, 2, 1}));
    const FilmStart start = start_of(back);
    EXPECT_EQ(start.position.samples, 2u);
    EXPECT_EQ(start.position.rows_ahead, 2u);
    EXPECT_EQ(start.work.at("hits"), 20u);
}

TEST(FilmPart, pictures_readers_do_not_see_the_sums) {
    const ScratchFolder scratch;
    const FilmPart part = part_of_samples(shard_of(1, 1));
    (void)write_exr(scratch / "p.exr", image_of(part), part.file);
    const Image image = read_exr(scratch / "p.exr");
    EXPECT_TRUE(image.words.empty());
    for (const auto& [name, channel] : image.channels)
        EXPECT_FALSE(name.starts_with(kSumsLayer)) << name;
    EXPECT_EQ(image.channels.size(), 9u) << "R G B, error, samples, albedo and Z";
}

TEST(FilmPart, damaged_description_is_refused) {
    const ScratchFolder scratch;
    const Image sound = image_of(part_of_samples(shard_of(2, 3)));
    const auto refusal = [&](const std::string& from, const std::string& to) {
        Image image = sound;
        std::string& text = image.attributes.at(kPartAttribute);
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        if (at != std::string::npos) text.replace(at, from.size(), to);
        seal(image);
        (void)write_exr(scratch / "p.exr", image);
        try {
            (void)read_part(scratch / "p.exr");
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::input_refused);
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(refusal("\"format\":5", "\"format\":5"), "");
    EXPECT_NE(refusal("\"format\":5", "\"format\":4"), "");
    EXPECT_EQ(refusal("\"exposure_ev\":null", "\"exposure_ev\":2.5"), "");
    EXPECT_NE(refusal("\"exposure_ev\":null", "\"exposure_ev\":\"auto\""), "");
    const std::string samples = R"("samples":"1-10x3")";
    EXPECT_NE(refusal(samples, R"("samples":"1-10x0")"), "");
    EXPECT_NE(refusal(samples, R"("samples":"1-10x3,4")"), "") << "a sample twice";
    EXPECT_NE(refusal(samples, R"("samples":"-1")"), "");
    EXPECT_NE(refusal(samples, R"("samples":"0-4294967295")"), "");
    EXPECT_NE(refusal(samples, R"("samples":"0-4000000000x2")"), "") << "ranges without number";
    EXPECT_NE(refusal(samples, R"("samples":4)"), "");
    EXPECT_NE(refusal(R"("rows":0)", R"("rows":3)"), "") << "as many as there are rows";
    EXPECT_NE(refusal(R"("rows":0,"sample":0)", R"("rows":1,"sample":4)"), "") << "a sample that it has";
    EXPECT_EQ(refusal(R"("rows":0,"sample":0)", R"("rows":1,"sample":13)"), "");
    EXPECT_NE(refusal("\"window\":[0,0,0,0]", "\"window\":[0,0,2147483647,3]"), "");
    EXPECT_NE(refusal("\"window\":[0,0,0,0]", "\"window\":[-1,0,5,3]"), "");
    EXPECT_NE(refusal("\"window\":[0,0,0,0]", "\"window\":[1,0,5,3]"), "");
    EXPECT_NE(refusal("{", "["), "");
}

// An image with planes that no film has is refused, and not read beyond its end.
TEST(FilmPart, planes_of_other_forms_are_refused) {
    const ScratchFolder scratch;
    const Image sound = image_of(part_of_samples(shard_of(2, 3)));
    const auto is_refused = [&](const std::function<void(Image&)>& damage) {
        Image image = sound;
        damage(image);
        seal(image);
        (void)write_exr(scratch / "p.exr", image);
        try {
            (void)read_part(scratch / "p.exr");
        } catch (const Error& error) {
            return error.code() == ExitCode::input_refused;
        }
        return false;
    };
    const auto add = [](Image& image, const std::string& name, int components) {
        for (int i = 0; i < components; ++i) {
            for (const char* half : {"lo", "hi"})
                image.words[fmt::format("sums.{}.{}.{}", name, i, half)].resize(5 * 3);
        }
    };
    EXPECT_FALSE(is_refused([](Image&) {}));
    EXPECT_FALSE(is_refused([&](Image& image) { add(image, "normal", 3); }));
    for (const int components : {2, 4})
        EXPECT_TRUE(is_refused([&](Image& image) { add(image, "normal", components); }));
    EXPECT_TRUE(is_refused([&](Image& image) { add(image, "bias_a", 3); })) << "one half";
    EXPECT_TRUE(is_refused([&](Image& image) {
        add(image, "bias_a", 1);
        add(image, "bias_b", 3);
    }));
    EXPECT_TRUE(is_refused([&](Image& image) { add(image, "squares", 1); }));
    for (const auto& [name, words] : sound.words)
        EXPECT_TRUE(!name.starts_with("sums.beauty") || is_refused([&, gone = name](Image& image) {
            image.words.erase(gone);
        })) << name;
}

// Any single bit of what is read, at random places.
TEST(FilmPart, flipped_bit_is_noticed) {
    const ScratchFolder scratch;
    const Image sound = image_of(part_of_samples(shard_of(2, 3)));
    std::mt19937 random(1);
    const auto flip = [&](auto& container) {
        auto& unit = container[random() % container.size()];
        std::uint32_t bits = 0;
        std::memcpy(&bits, &unit, sizeof unit);
        bits ^= 1u << random() % (8 * sizeof unit);
        std::memcpy(&unit, &bits, sizeof unit);
    };
    for (int round = 0; round < 100; ++round) {
        Image image = sound;
        if (round % 3 == 0) {
            flip(image.channels.at("Z").pixels);
        } else if (round % 3 == 1) {
            flip(std::next(image.words.begin(), static_cast<std::ptrdiff_t>(random() % image.words.size()))
                     ->second);
        } else {
            std::string& report = image.attributes.at(kReportAttribute);
            report[random() % report.size()] ^= 1;
        }
        (void)write_exr(scratch / "p.exr", image);
        EXPECT_THROW((void)read_part(scratch / "p.exr"), Error) << round;
    }
}

TEST(FilmPart, finished_one_is_known_by_its_samples_and_its_render) {
    const ScratchFolder scratch;
    const FilmPart part = part_of_samples(shard_of(2, 3));
    const auto is_finished = [&](const FilmPart& wanted) {
        return finished_part(scratch / "p.exr", wanted.render, wanted.samples).has_value();
    };
    EXPECT_FALSE(is_finished(part)) << "no file";
    (void)write_exr(scratch / "p.exr", image_of(part), part.file);
    EXPECT_TRUE(is_finished(part));
    EXPECT_FALSE(is_finished(part_of_samples(shard_of(1, 3))));
    EXPECT_FALSE(is_finished(part_of_samples(shard_of(2, 3), 5))) << "another seed";
    Image damaged = image_of(part);
    damaged.words.begin()->second[3] ^= 1;
    (void)write_exr(scratch / "p.exr", damaged, part.file);
    EXPECT_FALSE(is_finished(part));
}

// All orders of the shards, added one by one, and in groups that are written and read in between.
TEST(MergeParts, sum_in_any_order_is_the_film_of_all_samples) {
    const FilmPart whole = part_of_samples(kAll);
    for (const std::uint32_t count : {2u, 3u, 4u}) {
        std::vector<std::uint32_t> order(count);
        std::iota(order.begin(), order.end(), 0u);
        do {
            PartSum sum;
            for (const std::uint32_t index : order)
                add_part(sum, part_of_samples(shard_of(index + 1, count)), std::to_string(index));
            EXPECT_EQ(sum.total.film, whole.film);
            EXPECT_TRUE(missing_samples(sum.total).empty());
            EXPECT_EQ(picture_of(sum.total.film).channels.at("R").pixels,
                      picture_of(whole.film).channels.at("R").pixels);
        } while (std::ranges::next_permutation(order).found);
    }
    PartSum two;
    add_part(two, part_of_samples(shard_of(4, 4)), "3");
    add_part(two, part_of_samples(shard_of(2, 4)), "1");
    PartSum all;
    add_part(all, part_of_samples(shard_of(3, 4)), "2");
    add_part(all, saved_and_read(two.total), "two");
    add_part(all, part_of_samples(shard_of(1, 4)), "0");
    EXPECT_EQ(all.total.film, whole.film);
}

TEST(MergeParts, one_changed_bit_changes_the_sum) {
    PartSum sum;
    FilmPart changed = part_of_samples(shard_of(2, 2));
    changed.film.sums["beauty_b"][4] ^= 1;
    add_part(sum, part_of_samples(shard_of(1, 2)), "0");
    add_part(sum, std::move(changed), "1");
    EXPECT_NE(sum.total.film, part_of_samples(kAll).film);
}

TEST(MergeParts, report_of_the_whole_adds_counts_and_times) {
    PartSum sum;
    for (const std::uint32_t index : {2u, 0u, 1u})
        add_part(sum, part_of_samples(shard_of(index + 1, 3)), "p");
    const nlohmann::ordered_json report = merged_report(sum.total, false);
    EXPECT_EQ(report["work"]["hits"], 10 * kSamples);
    EXPECT_EQ(report["faults"]["ao_table_full"], kSamples);
    EXPECT_EQ(report["samples"], kSamples);
    EXPECT_EQ(report["wall_s"], 3.0);
    EXPECT_FALSE(report.contains("shard"));
    const FilmPart whole = part_of_samples(kAll);
    nlohmann::ordered_json expected = reproducible_report(whole.report);
    expected["error"] = error_json(error_of(whole.film));
    EXPECT_EQ(merged_report(sum.total, true).dump(), expected.dump()) << "the order of keys, too";
}

TEST(MergeParts, error_has_no_upper_end_where_a_part_lacks_light) {
    PartSum sum;
    add_part(sum, part_of_samples(shard_of(1, 2)), "0");
    FilmPart cut = part_of_samples(shard_of(2, 2));
    cut.report["faults"]["loop_cut"] = 1;
    const ErrorEstimate error = error_of(part_of_samples(kAll).film);
    ASSERT_TRUE(std::isfinite(error.high));
    add_part(sum, std::move(cut), "1");
    const nlohmann::ordered_json claim = merged_report(sum.total, true)["error"];
    EXPECT_EQ(claim["estimate"], error.estimate);
    EXPECT_TRUE(claim["high"].is_null());
}

TEST(MergeParts, missing_samples_are_named) {
    PartSum sum;
    add_part(sum, part_of_samples(shard_of(1, 4)), "0");
    add_part(sum, part_after(shard_of(3, 4), 1), "2");
    EXPECT_EQ(missing_samples(sum.total).text(), "1,3,5-7,9-10");
    EXPECT_EQ(merged_report(sum.total, false)["sample_ranges"], "0-4x2,8");
    EXPECT_EQ(merged_report(sum.total, false)["samples"], 4);
    // Without a number that was asked for, only what lies before the last sample can be missing.
    sum.total.spp = 0;
    EXPECT_EQ(missing_samples(sum.total).text(), "1,3,5-7");
}

// Samples that were added later: with another total number of samples, and beyond it.
TEST(MergeParts, number_of_samples_is_no_part_of_what_they_are_of) {
    PartSum sum;
    add_part(sum, part_of_samples(SampleSet::leading(4)), "first");
    FilmPart more = part_of_samples(*SampleSet::parse("4-10"));
    more.spp = 11;
    sum.total.spp = 4;
    EXPECT_TRUE(missing_samples(sum.total).empty());
    add_part(sum, more, "more");
    EXPECT_EQ(sum.total.film, part_of_samples(kAll).film);
    EXPECT_EQ(sum.total.spp, 11u);
}

// The files are read in runs of rows; the sum is that of whole parts.
TEST(MergeParts, files_in_any_order_and_in_groups_add_up_to_the_film_of_all_samples) {
    const ScratchFolder scratch;
    const FilmPart whole = part_of_samples(kAll);
    std::vector<std::filesystem::path> files;
    for (const char* text : {"0-2,7", "3", "4-6", "8-10x2", "9"}) {
        files.push_back(scratch / (std::string(text) + ".exr"));
        const FilmPart part = part_of_samples(*SampleSet::parse(text));
        (void)write_exr(files.back(), image_of(part), part.file);
    }
    std::mt19937 random(1);
    for (int round = 0; round < 5; ++round) {
        std::ranges::shuffle(files, random);
        PartSum sum, group;
        for (std::size_t i = 0; i < files.size(); ++i)
            add_part_file(i < 2 ? group : sum, files[i]);
        (void)write_exr(scratch / "group.exr", image_of(group.total), group.total.file);
        add_part_file(sum, scratch / "group.exr");
        EXPECT_EQ(sum.total.film, whole.film);
        EXPECT_EQ(sum.total.samples, kAll);
        const Image picture = picture_of(FilmSums(sum.total.film));
        for (const auto& [name, channel] : picture_of(whole.film).channels)
            EXPECT_EQ(picture.channels.at(name).pixels, channel.pixels) << name;
    }
}

TEST(MergeParts, devices_of_other_kinds_are_mixed_only_on_request) {
    FilmPart other = part_of_samples(shard_of(2, 2));
    other.render[kDeviceKey] = "another, 1.0";
    PartSum sum;
    add_part(sum, part_of_samples(shard_of(1, 2)), "old.exr");
    EXPECT_NE(refusal_of(sum, other).find("its device is \"another, 1.0\" and not"), std::string::npos);
    sum.mixes_devices = true;
    add_part(sum, other, "new.exr");
    EXPECT_EQ(sum.total.render[kDeviceKey], kMixedDevices);
    FilmPart other_build = part_of_samples(*SampleSet::parse("11"));
    other_build.render["build"] = "0";
    EXPECT_NE(refusal_of(sum, other_build).find("its build is \"0\" and not"), std::string::npos);
}

TEST(MergeParts, part_that_does_not_belong_is_refused_with_the_reason) {
    PartSum sum;
    add_part(sum, part_of_samples(shard_of(1, 3)), "old.exr");
    EXPECT_EQ(refusal_of(sum, part_of_samples(shard_of(1, 3))),
              "new.exr: its sample 0 is in old.exr already");
    EXPECT_EQ(refusal_of(sum, part_of_samples(shard_of(2, 3), 5)),
              "new.exr: not of the same render as old.exr: its seed is 5 and not 0");
    FilmPart other_version = part_of_samples(shard_of(2, 3));
    other_version.render["version"] = "0.0.1";
    EXPECT_NE(refusal_of(sum, other_version).find("its version is \"0.0.1\" and not"), std::string::npos);
    FilmPart other_scene = part_of_samples(shard_of(2, 3));
    other_scene.render["scene_hash"] = "0";
    EXPECT_NE(refusal_of(sum, other_scene).find("its scene_hash is \"0\" and not"), std::string::npos);
    FilmPart torn = part_after(shard_of(2, 3), 2);
    torn.rows_ahead = 1;
    torn.sample_ahead = 7;
    EXPECT_NE(refusal_of(sum, torn).find("it ends within a sample"), std::string::npos);
    FilmPart poor = part_of_samples(shard_of(2, 3));
    poor.film.sums.erase("albedo");
    EXPECT_NE(refusal_of(sum, poor).find("it has other channels"), std::string::npos);
    FilmPart odd_report = part_of_samples(shard_of(2, 3));
    odd_report.report.erase("work");
    EXPECT_NE(refusal_of(sum, odd_report).find("its report is damaged"), std::string::npos);
}

TEST(RenderKey, more_samples_are_of_the_same_render_and_nothing_else_is) {
    const Job job = job_of({});
    const auto key = render_key(job.scene, job.plan, {});
    const Job longer = job_of({}, 0, 2 * kSamples);
    EXPECT_EQ(difference(render_key(longer.scene, longer.plan, {}), key), std::nullopt);
    const Job other_seed = job_of({}, 1);
    EXPECT_TRUE(difference(render_key(other_seed.scene, other_seed.plan, {}), key).has_value());
    Job moved = job_of({});
    moved.scene.camera = camera_down({0.0, 0.0, 9.0}, 45.0);
    EXPECT_TRUE(difference(render_key(moved.scene, moved.plan, {}), key).has_value());
    EXPECT_TRUE(difference(render_key(job.scene, job.plan, {.driver = "another"}), key).has_value());
}

}  // namespace
}  // namespace voxilux::test
