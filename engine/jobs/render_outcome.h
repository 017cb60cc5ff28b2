#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/step_times.h"
#include "estimators/error_estimate.h"
#include "film/film_sums.h"
#include "formats/image.h"
#include "jobs/denoise_film.h"
#include "jobs/error_rounds.h"
#include "jobs/forecast.h"
#include "jobs/next_minute.h"
#include "plan/render_plan.h"
#include "renderer/film_steps.h"
#include "vk/device.h"

namespace voxilux {

enum class StopReason : std::uint8_t { finished, error_target, time_limit, interrupted };

// What a render did: the numbers of the report.
struct RenderStatistics {
    DeviceInfo device;
    double wall_s = 0.0;
    double cpu_s = 0.0;
    double peak_rss_mib = 0.0;
    double load_s = 0.0;          // scene, world and structure, on the CPU
    std::vector<StepTime> steps;  // of loading, in their order
    double first_pixel_s =
        0.0;  // from RenderOptions::started to the end of the first tile; 0 when there is none
    double gpu_ms = 0.0;
    std::vector<PassTime> passes;
    std::map<std::string, std::uint64_t> work;
    std::map<std::string, std::uint64_t> faults;
    std::vector<MemoryRow> memory;
    std::uint64_t pipelines = 0;
    std::uint32_t samples = 0;     // complete ones, of the plan's part
    std::uint64_t live_cells = 0;  // occlusion cells at the end
    ErrorEstimate error;
    std::uint32_t rounds = 0;  // after which the error was compared with its target; 0: no target
    DecidedBy decided_by = DecidedBy::request;
    std::optional<Forecast> forecast;       // from a pilot
    std::optional<NextMinute> next_minute;  // nothing where the error is unknown
    StopReason stop = StopReason::finished;
    std::vector<std::string> warnings;
    std::vector<std::string> validation;  // messages of the validation layers
};

struct RenderOutcome {
    Image image;
    RenderPlan plan;
    RenderStatistics statistics;
    std::optional<Denoised> denoised;  // set when requested, for a whole image
    std::optional<FilmSums> film;      // see RenderOptions::needs_film
    std::uint32_t rows_ahead = 0;      // rows from the top that have one sample more than statistics.samples

    // Of what is shown: the denoised image where there is one.
    [[nodiscard]] const ErrorEstimate& error() const {
        return denoised && denoised->is_filtered() ? denoised->claim : statistics.error;
    }
};

// Adds what a step of this plan did: times, counters and faults.
void add_step(const StepResult& step, const RenderPlan& plan, RenderStatistics& statistics);

// Whether the device cut off paths, photons or sums: light is then missing that the error estimate does not
// see.
[[nodiscard]] bool lacks_light(const std::map<std::string, std::uint64_t>& faults);

// The error of a film; it has no upper end where light is missing.
[[nodiscard]] ErrorEstimate claim_with(ErrorEstimate error,
                                       const std::map<std::string, std::uint64_t>& faults);
[[nodiscard]] ErrorEstimate claimed_error_of(const FilmSums& film,
                                             const std::map<std::string, std::uint64_t>& faults);

// Device milliseconds spent on samples, without the build of the world.
[[nodiscard]] double sampling_ms(const RenderStatistics& statistics);

}  // namespace voxilux
