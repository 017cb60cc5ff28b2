#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "film/tonemap.h"
#include "formats/exr.h"
#include "jobs/film_part.h"

namespace voxilux {

// The files that an image is written to, and how.
struct PictureFiles {
    std::vector<std::string> files;  // .exr or .png
    ToneMapOptions tone;             // of PNGs
    bool reproducible = false;       // no date and no times: equal runs give equal bytes
    bool is_part = false;            // EXRs contain the exact sums, for merging
    std::uint32_t spp = 0;           // that all parts make up together; 0: no limit
    std::string scene_name;          // for people: the name of the scene's file
};

// Values that do not fit a file format, by the name of the fault.
using WriteFaults = std::map<std::string, std::uint64_t>;

[[nodiscard]] bool is_exr(const std::filesystem::path& file);
[[nodiscard]] bool is_png(const std::filesystem::path& file);

// Writes `exr` or `png`, by the file extension.
void write_picture(const std::filesystem::path& file, const Image& exr, const ExrOptions& options,
                   const Image& png, const ToneMapOptions& tone, WriteFaults& faults);

// The tone mapping of PNGs: the user's exposure, else the scene's.
[[nodiscard]] ToneMapOptions tone_of(const PictureFiles& pictures, const std::optional<float>& exposure_ev);

// Writes the image into every file and counts among the faults what did not fit their formats. `scene` is the
// still one that was rendered.
void write_pictures(const PictureFiles& pictures, const Scene& scene, RenderOutcome& outcome);

// The outcome as a part, with the report of its image.
[[nodiscard]] FilmPart part_to_write(const PictureFiles& pictures, const Scene& scene, RenderOutcome outcome);

}  // namespace voxilux
