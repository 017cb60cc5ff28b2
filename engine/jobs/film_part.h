#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "formats/exr.h"
#include "jobs/render_session.h"

namespace voxilux {

// Some of the samples of a render, with all that is needed to add it to the others: what a shard writes, and
// a checkpoint. Its file is an EXR with its own picture, the exact sums beside it (store_sums) and the rest
// as JSON in the attribute kPartAttribute.
struct FilmPart {
    nlohmann::ordered_json render;  // what its samples are of; they may be added where this is equal
    std::uint32_t spp = 0;          // of the whole render
    std::uint32_t shards = 1;       // that the render is cut into
    std::map<std::uint32_t, std::uint32_t> done;  // whole samples by shard, from 0; absent shards have none
    std::uint32_t rows_ahead = 0;                 // rows from the top that have one more; of one shard only
    FilmSums film;
    nlohmann::ordered_json report;
    ExrOptions file;  // how a picture of it is written
};

inline constexpr const char* kPartAttribute = "voxilux.part";
inline constexpr const char* kReportAttribute = "voxilux.report";
inline constexpr const char* kChecksumAttribute = "voxilux.checksum";

// The part that an outcome holds, which must have kept its film. `report` is that of the outcome.
[[nodiscard]] FilmPart part_of(const Scene& scene, RenderOutcome outcome, nlohmann::ordered_json report,
                               const ExrOptions& file);

// What may be added up: the JSON that FilmPart::render has for this scene and plan.
[[nodiscard]] nlohmann::ordered_json render_key(const Scene& scene, const RenderPlan& plan);

// The picture of a part with everything that read_part() needs.
[[nodiscard]] Image image_of(FilmPart part);

// Gives an image the checksum of all that read_part() uses of it: both texts, sums, positions and depths.
void seal(Image& image);

// Throws Error(input_refused) for a file that is no part, one of an unknown or inconsistent form, or a
// damaged one.
[[nodiscard]] FilmPart read_part(const std::filesystem::path& path);

// The first setting in which two renders differ, as a clause: "its seed is 2 and not 1". Nothing when they
// are the same.
[[nodiscard]] std::optional<std::string> difference(const nlohmann::ordered_json& render,
                                                    const nlohmann::ordered_json& other);

// The film that a render of this part's only shard goes on from.
[[nodiscard]] FilmStart start_of(FilmPart part);

}  // namespace voxilux
