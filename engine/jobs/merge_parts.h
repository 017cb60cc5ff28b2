#pragma once

#include <map>
#include <string>
#include <vector>

#include "jobs/film_part.h"

namespace voxilux {

// Parts added up so far, in whatever order they came.
struct PartSum {
    FilmPart total;
    std::map<std::uint32_t, std::string> files;  // that the samples of each shard came from
};

// Adds a part that was read from `file`. Throws Error(input_refused) when it is of another render, has
// samples that are there already, or ends within a sample.
void add_part(PartSum& sum, FilmPart part, const std::string& file);

// What a whole render lacks, shard by shard: "2/4", or "2/4 (3 of 4 samples)". Empty when nothing does.
[[nodiscard]] std::vector<std::string> missing_shards(const FilmPart& part);

// The report of the sum: counts and times added up, the error that of the whole film. It says which shards it
// is of unless they are all there. `reproducible` leaves out what the clock and the machine decide, as the
// reports of reproducible parts do.
[[nodiscard]] nlohmann::ordered_json merged_report(const FilmPart& total, bool reproducible);

}  // namespace voxilux
