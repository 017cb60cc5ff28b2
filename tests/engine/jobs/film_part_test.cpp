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
#include "plan/shard.h"
#include "renderer/prepared_scene.h"
#include "support/scratch_folder.h"
#include "support/test_images.h"
#include "support/test_scenes.h"

namespace voxilux::test {
namespace {

constexpr std::uint32_t kSamples = 11;

// Samples of the shard, one by one.
std::vector<std::uint32_t> samples_of(Shard shard, std::uint32_t spp) {
    std::vector<std::uint32_t> samples;
    for (std::uint32_t k = 0; k < spp; ++k) {
        if (k % shard.count == shard.index) samples.push_back(k);
    }
    return samples;
}

TEST(Shard, counts_are_those_of_the_samples_one_by_one) {
    for (std::uint32_t count = 1; count <= 6; ++count) {
        for (std::uint32_t index = 0; index < count; ++index) {
            for (std::uint32_t spp = 0; spp <= 20; ++spp) {
                const Shard shard{index, count};
                const std::vector<std::uint32_t> samples = samples_of(shard, spp);
                ASSERT_EQ(shard.samples(spp), samples.size()) << index << "/" << count << " of " << spp;
                for (std::uint32_t done = 0; done < samples.size(); ++done)
                    ASSERT_EQ(shard.sample(done), samples[done]);
                const auto even = std::ranges::count_if(samples, [](std::uint32_t k) { return k % 2 == 0; });
                ASSERT_EQ(shard.even_samples(shard.samples(spp)), even)
                    << index << "/" << count << " of " << spp;
            }
        }
    }
}

TEST(Shard, counts_hold_up_to_the_largest_number) {
    const std::uint32_t most = std::numeric_limits<std::uint32_t>::max();
    EXPECT_EQ(Shard{}.samples(most), most);
    EXPECT_EQ((Shard{most - 1, most}.samples(most)), 1u);
    EXPECT_EQ((Shard{1, 2}.samples(most)), most / 2);
    EXPECT_EQ(Shard{}.even_samples(most), most / 2 + 1);
}

// A scene and its plan: what a part says it is of.
struct Job {
    Scene scene;
    RenderPlan plan;
};

Job job_of(Shard shard, std::uint32_t seed = 0, std::uint32_t spp = kSamples) {
    Job job{.scene = white_scene()};
    job.scene.settings.size = {5, 3};
    job.scene.settings.spp = spp;
    job.scene.settings.seed = seed;
    PlanRequest request;
    request.shard = shard;
    job.plan = prepare_scene(job.scene, request, DeviceLimits{}).plan;
    return job;
}

// The value of a sample: any number that depends on what it is of.
std::int64_t value_of(std::uint32_t sample, std::size_t at) {
    return static_cast<std::int64_t>(hash32(sample * 1000u + static_cast<std::uint32_t>(at))) - (1 << 30);
}

void fill(FilmSums& film, Shard shard, std::uint32_t done) {
    film.even.assign(3, shard.even_samples(done));
    film.odd.assign(3, done - shard.even_samples(done));
    for (const char* name : {"beauty_a", "beauty_b", "albedo"})
        film.sums[name].assign(5 * 3 * 3, 0);
    film.firsts["depth"].assign(5 * 3, static_cast<float>(shard.index) + 0.1f);
    for (std::uint32_t j = 0; j < done; ++j) {
        const std::uint32_t k = shard.sample(j);
        for (std::size_t i = 0; i < 5 * 3 * 3; ++i) {
            film.sums[k % 2 == 0 ? "beauty_a" : "beauty_b"][i] += value_of(k, i);
            film.sums["albedo"][i] += 2 * value_of(k, i);
        }
    }
}

// What a shard leaves after `done` samples.
FilmPart part_after(Shard shard, std::uint32_t done, std::uint32_t seed = 0) {
    const Job job = job_of(shard, seed);
    RenderOutcome outcome{.plan = job.plan, .film = FilmSums{.width = 5, .height = 3}};
    outcome.statistics.samples = done;
    outcome.statistics.wall_s = 1.0;
    outcome.statistics.work["hits"] = 10 * done;
    outcome.statistics.faults["ao_table_full"] = done;
    fill(*outcome.film, shard, done);
    const nlohmann::ordered_json report = report_json(job.scene, outcome);
    return part_of(job.scene, outcome, report, {.comments = "s.toml", .world_to_camera = glm::mat4(0.1f)});
}

FilmPart part_of_shard(Shard shard, std::uint32_t seed = 0) {
    return part_after(shard, shard.samples(kSamples), seed);
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
    FilmPart part = part_of_shard({1, 3});
    // Sums that no float and no double holds.
    part.film.sums["albedo"] = std::vector<std::int64_t>(45, 0x123456789ABCDEF1);
    part.film.sums["albedo"][7] = std::numeric_limits<std::int64_t>::min();
    part.film.sums["albedo"][8] = -1;
    const FilmPart back = saved_and_read(part);
    EXPECT_EQ(back.film, part.film);
    EXPECT_EQ(back.render, part.render);
    EXPECT_EQ(back.done, part.done);
    EXPECT_EQ(back.report, part.report);
    EXPECT_EQ(back.spp, kSamples);
    EXPECT_EQ(back.shards, 3u);
    EXPECT_EQ(back.file.world_to_camera, part.file.world_to_camera);
    EXPECT_EQ(back.file.comments, "s.toml");
    // One bit of one sum is seen.
    part.film.sums["albedo"][8] ^= 1;
    EXPECT_NE(back.film, part.film);
}

TEST(FilmPart, crop_keeps_its_place_in_the_frame) {
    FilmPart part = part_of_shard({0, 2});
    part.file.window = {7, 8, 100, 90};
    const FilmPart back = saved_and_read(part);
    EXPECT_EQ(back.film, part.film) << "of the data window, not of the frame";
    EXPECT_EQ(back.file.window.x, 7);
    EXPECT_EQ(back.file.window.full_height, 90);
}

TEST(FilmPart, rows_ahead_have_one_sample_more) {
    FilmPart part = part_after({1, 3}, 2);
    part.rows_ahead = 2;
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
    const FilmPart part = part_of_shard({0, 1});
    (void)write_exr(scratch / "p.exr", image_of(part), part.file);
    const Image image = read_exr(scratch / "p.exr");
    EXPECT_TRUE(image.words.empty());
    for (const auto& [name, channel] : image.channels)
        EXPECT_FALSE(name.starts_with(kSumsLayer)) << name;
    EXPECT_EQ(image.channels.size(), 9u) << "R G B, error, samples, albedo and Z";
}

TEST(FilmPart, damaged_description_is_refused) {
    const ScratchFolder scratch;
    const Image sound = image_of(part_of_shard({1, 3}));
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
    EXPECT_EQ(refusal("\"format\":3", "\"format\":3"), "");
    EXPECT_NE(refusal("\"format\":3", "\"format\":2"), "");
    EXPECT_NE(refusal("\"shards\":3", "\"shards\":0"), "");
    EXPECT_NE(refusal("\"shards\":3", "\"shards\":1"), "") << "shard 2 of 1";
    EXPECT_NE(refusal("\"samples\":4", "\"samples\":5"), "") << "more than a shard has";
    EXPECT_NE(refusal("\"samples\":4", "\"samples\":-4"), "");
    EXPECT_NE(refusal("\"rows_ahead\":0", "\"rows_ahead\":3"), "") << "as many as there are rows";
    EXPECT_NE(refusal("\"done\":[{", "\"done\":[{\"shard\":2,\"samples\":1},{"), "") << "a shard twice";
    EXPECT_NE(refusal("\"shards\":3", "\"shards\":4294967295"), "");
    EXPECT_NE(refusal("\"window\":[0,0,0,0]", "\"window\":[0,0,2147483647,3]"), "");
    EXPECT_NE(refusal("\"window\":[0,0,0,0]", "\"window\":[-1,0,5,3]"), "");
    EXPECT_NE(refusal("\"window\":[0,0,0,0]", "\"window\":[1,0,5,3]"), "");
    EXPECT_NE(refusal("{", "["), "");
}

// An image with planes that no film has is refused, and not read past its end.
TEST(FilmPart, planes_of_other_forms_are_refused) {
    const ScratchFolder scratch;
    const Image sound = image_of(part_of_shard({1, 3}));
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
    const Image sound = image_of(part_of_shard({1, 3}));
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

// All orders of the shards, added one by one, and in groups that are written and read in between.
TEST(MergeParts, sum_in_any_order_is_the_film_of_all_samples) {
    const FilmPart whole = part_of_shard({});
    for (const std::uint32_t count : {2u, 3u, 4u}) {
        std::vector<std::uint32_t> order(count);
        std::iota(order.begin(), order.end(), 0u);
        do {
            PartSum sum;
            for (const std::uint32_t index : order)
                add_part(sum, part_of_shard({index, count}), std::to_string(index));
            EXPECT_EQ(sum.total.film, whole.film);
            EXPECT_TRUE(missing_shards(sum.total).empty());
            EXPECT_EQ(picture_of(sum.total.film).channels.at("R").pixels,
                      picture_of(whole.film).channels.at("R").pixels);
        } while (std::ranges::next_permutation(order).found);
    }
    PartSum two;
    add_part(two, part_of_shard({3, 4}), "3");
    add_part(two, part_of_shard({1, 4}), "1");
    PartSum all;
    add_part(all, part_of_shard({2, 4}), "2");
    add_part(all, saved_and_read(two.total), "two");
    add_part(all, part_of_shard({0, 4}), "0");
    EXPECT_EQ(all.total.film, whole.film);
}

TEST(MergeParts, one_changed_bit_changes_the_sum) {
    PartSum sum;
    FilmPart changed = part_of_shard({1, 2});
    changed.film.sums["beauty_b"][4] ^= 1;
    add_part(sum, part_of_shard({0, 2}), "0");
    add_part(sum, std::move(changed), "1");
    EXPECT_NE(sum.total.film, part_of_shard({}).film);
}

TEST(MergeParts, report_of_the_whole_adds_counts_and_times) {
    PartSum sum;
    for (const std::uint32_t index : {2u, 0u, 1u})
        add_part(sum, part_of_shard({index, 3}), "p");
    const nlohmann::ordered_json report = merged_report(sum.total, false);
    EXPECT_EQ(report["work"]["hits"], 10 * kSamples);
    EXPECT_EQ(report["faults"]["ao_table_full"], kSamples);
    EXPECT_EQ(report["samples"], kSamples);
    EXPECT_EQ(report["wall_s"], 3.0);
    EXPECT_FALSE(report.contains("shard"));
    const FilmPart whole = part_of_shard({});
    nlohmann::ordered_json expected = reproducible_report(whole.report);
    expected["error"] = error_json(error_of(whole.film));
    EXPECT_EQ(merged_report(sum.total, true).dump(), expected.dump()) << "the order of keys, too";
}

TEST(MergeParts, error_has_no_upper_end_where_a_part_lacks_light) {
    PartSum sum;
    add_part(sum, part_of_shard({0, 2}), "0");
    FilmPart cut = part_of_shard({1, 2});
    cut.report["faults"]["loop_cut"] = 1;
    const ErrorEstimate error = error_of(part_of_shard({}).film);
    ASSERT_TRUE(std::isfinite(error.high));
    add_part(sum, std::move(cut), "1");
    const nlohmann::ordered_json claim = merged_report(sum.total, true)["error"];
    EXPECT_EQ(claim["estimate"], error.estimate);
    EXPECT_TRUE(claim["high"].is_null());
}

TEST(MergeParts, missing_shards_are_named) {
    PartSum sum;
    add_part(sum, part_of_shard({0, 4}), "0");
    add_part(sum, part_after({2, 4}, 1), "2");
    EXPECT_EQ(missing_shards(sum.total), (std::vector<std::string>{"2/4", "3/4 (1 of 3 samples)", "4/4"}));
    EXPECT_EQ(merged_report(sum.total, false)["shard"], "1, 3 of 4");
    EXPECT_EQ(merged_report(sum.total, false)["samples"], 4);
}

TEST(MergeParts, part_that_does_not_belong_is_refused_with_the_reason) {
    PartSum sum;
    add_part(sum, part_of_shard({0, 3}), "old.exr");
    EXPECT_EQ(refusal_of(sum, part_of_shard({0, 3})),
              "new.exr: its samples of shard 1/3 are in old.exr already");
    EXPECT_EQ(refusal_of(sum, part_of_shard({1, 3}, 5)),
              "new.exr: not of the same render as old.exr: its seed is 5 and not 0");
    EXPECT_EQ(refusal_of(sum, part_of_shard({1, 4})),
              "new.exr: not of the same render as old.exr: it is of 4 shards and not 3");
    FilmPart longer = part_of_shard({1, 3});
    longer.spp = 100;
    EXPECT_EQ(refusal_of(sum, longer),
              "new.exr: not of the same render as old.exr: it is of 100 samples and not 11");
    FilmPart other_version = part_of_shard({1, 3});
    other_version.render["version"] = "0.0.1";
    EXPECT_NE(refusal_of(sum, other_version).find("its version is \"0.0.1\" and not"), std::string::npos);
    FilmPart other_scene = part_of_shard({1, 3});
    other_scene.render["scene_hash"] = "0";
    EXPECT_NE(refusal_of(sum, other_scene).find("its scene_hash is \"0\" and not"), std::string::npos);
    FilmPart torn = part_after({1, 3}, 2);
    torn.rows_ahead = 1;
    EXPECT_NE(refusal_of(sum, torn).find("it ends within a sample"), std::string::npos);
    FilmPart poor = part_of_shard({1, 3});
    poor.film.sums.erase("albedo");
    EXPECT_NE(refusal_of(sum, poor).find("it has other channels"), std::string::npos);
    FilmPart odd_report = part_of_shard({1, 3});
    odd_report.report.erase("work");
    EXPECT_NE(refusal_of(sum, odd_report).find("its report is damaged"), std::string::npos);
}

TEST(RenderKey, more_samples_are_of_the_same_render_and_nothing_else_is) {
    const Job job = job_of({});
    const auto key = render_key(job.scene, job.plan);
    const Job longer = job_of({}, 0, 2 * kSamples);
    EXPECT_EQ(difference(render_key(longer.scene, longer.plan), key), std::nullopt);
    const Job other_seed = job_of({}, 1);
    EXPECT_TRUE(difference(render_key(other_seed.scene, other_seed.plan), key).has_value());
    Job moved = job_of({});
    moved.scene.camera = camera_down({0.0, 0.0, 9.0}, 45.0);
    EXPECT_TRUE(difference(render_key(moved.scene, moved.plan), key).has_value());
}

}  // namespace
}  // namespace voxilux::test
