#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "formats/exr.h"
#include "jobs/render_session.h"

namespace voxilux {

// Some of the samples of a render, with everything needed to add it to the others: what render --samples and
// checkpoints write. Its file is an EXR with the image of these samples, the exact sums beside it
// (store_sums) and the rest as JSON in the attribute kPartAttribute.
struct FilmPart {
    nlohmann::ordered_json render;   // identifies the render; parts may be added where this is equal
    std::uint32_t spp = 0;           // requested number of samples; 0: no limit
    SampleSet samples;               // complete samples
    std::uint32_t rows_ahead = 0;    // rows from the top that have one more,
    std::uint32_t sample_ahead = 0;  // namely this one
    FilmSums film;
    nlohmann::ordered_json report;
    ExrOptions file;                   // how an image of it is written
    std::optional<float> exposure_ev;  // exposure of its PNGs, when the scene sets one
};

inline constexpr const char* kPartAttribute = "voxilux.part";
inline constexpr const char* kReportAttribute = "voxilux.report";
inline constexpr const char* kChecksumAttribute = "voxilux.checksum";

// The part that an outcome holds; it must have kept its film. `report` is that of the outcome. `spp`: the
// requested number of samples.
[[nodiscard]] FilmPart part_of(const Scene& scene, RenderOutcome outcome, nlohmann::ordered_json report,
                               const ExrOptions& file, std::uint32_t spp);

// What may be added up: the value of FilmPart::render for this scene and plan on this device. Builds and
// devices round differently, so samples from two of them must not be mixed.
[[nodiscard]] nlohmann::ordered_json render_key(const Scene& scene, const RenderPlan& plan,
                                                const DeviceInfo& device);
inline constexpr const char* kDeviceKey = "device";  // of the render key
inline constexpr const char* kMixedDevices =
    "of several";  // its value where parts of other devices were added

// The image of a part with everything that read_part() needs.
[[nodiscard]] Image image_of(FilmPart part);

// Gives an image the checksum of all that read_part() reads: both texts, sums, positions and depths.
void seal(Image& image);

// Reads a part in runs of rows: first calls `accept` with the part, whose film has no planes yet, then `take`
// with the planes of rows from `first` on. Throws Error(input_refused) for a file that is not a part, has an
// unknown or inconsistent format, or is damaged; damage shows at the end, after all rows were taken.
void read_part_rows(const std::filesystem::path& path,
                    const std::function<void(const FilmPart& part)>& accept,
                    const std::function<void(std::size_t first, const FilmSums& rows)>& take);

// Reads the whole part.
[[nodiscard]] FilmPart read_part(const std::filesystem::path& path);

// The description of the part in the file if it is undamaged and holds exactly these samples of a render with
// this key; else nothing.
[[nodiscard]] std::optional<FilmPart> finished_part(const std::filesystem::path& path,
                                                    const nlohmann::ordered_json& render,
                                                    const SampleSet& samples);

// The first setting in which two renders differ, as a clause: "its seed is 2 and not 1". Nothing when they
// are equal.
[[nodiscard]] std::optional<std::string> difference(const nlohmann::ordered_json& render,
                                                    const nlohmann::ordered_json& other);

// The film from which a render continues with this part's samples.
[[nodiscard]] FilmStart start_of(FilmPart part);

}  // namespace voxilux
