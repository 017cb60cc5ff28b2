#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "jobs/film_part.h"

namespace voxilux {

// Parts added up so far, in whatever order they came.
struct PartSum {
    FilmPart total;
    std::vector<std::pair<std::string, SampleSet>> files;  // that the samples came from
    bool mixes_devices = false;  // parts of devices of other kinds may be added, too
};

// Adds a part that was read from `file`. Throws Error(input_refused) when it is of another render, has
// samples that are there already, or ends within a sample.
void add_part(PartSum& sum, const FilmPart& part, const std::string& file);

// Adds the part in a file, some rows at a time: memory is that of one film, however many parts there are.
// Throws Error(input_refused) as add_part and read_part_rows, and then leaves a sum that is of no use.
void add_part_file(PartSum& sum, const std::filesystem::path& file);

// The samples that the render lacks: those before its last one, and all that it was asked for.
[[nodiscard]] SampleSet missing_samples(const FilmPart& part);

// The report of the sum: counts and times added up, the error that of the whole film. It says which samples
// it is of unless they are the first ones. `reproducible` leaves out what the clock and the machine decide,
// as the reports of reproducible parts do.
[[nodiscard]] nlohmann::ordered_json merged_report(const FilmPart& total, bool reproducible);

}  // namespace voxilux
