#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "jobs/film_part.h"

namespace voxilux {

// The sum of the parts so far, in any order.
struct PartSum {
    FilmPart total;
    std::vector<std::pair<std::string, SampleSet>> files;  // and the samples that came from them
    bool mixes_devices = false;  // parts from devices of other kinds may be added, too
};

// Adds a part that was read from `file`. Throws Error(input_refused) when it is from another render, contains
// samples that have already been added, or ends within a sample.
void add_part(PartSum& sum, const FilmPart& part, const std::string& file);

// Adds the part in a file, some rows at a time, so that memory is that of one film however many parts there
// are. Throws Error(input_refused) as add_part and read_part_rows; the sum is unusable afterwards.
void add_part_file(PartSum& sum, const std::filesystem::path& file);

// The samples that are missing: those before its last one, and all that were requested.
[[nodiscard]] SampleSet missing_samples(const FilmPart& part);

// The report of the sum: counts and times added up, the error of the whole film. It names its samples unless
// they are the first ones. `reproducible` leaves out what depends on the clock and the machine, as the
// reports of reproducible parts do.
[[nodiscard]] nlohmann::ordered_json merged_report(const FilmPart& total, bool reproducible);

}  // namespace voxilux
