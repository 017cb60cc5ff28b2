#include "jobs/price_list/price_list.h"

#include <span>

#include "base/file.h"
#include "base/json.h"
#include "film/tonemap.h"
#include "formats/png.h"
#include "jobs/price_list/difference_map.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

void write_picture(const fs::path& folder, const std::string& file, const Image& picture,
                   const Image& reference) {
    write_png(folder / file, to_display(picture).image);
    write_png(folder / difference_of(file), difference_map(picture, reference));
}

void write_row(const PriceList& list, const std::vector<PricedRun>& runs, const EqualRow& row,
               const char* name, const fs::path& folder) {
    for (const EqualPicture& picture : row.pictures) {
        const PricedRun& run = run_of(list, runs, picture, &picture == &row.pictures.front());
        write_picture(folder, file_of_row(name, run.id), picture.picture, list.reference.image);
    }
}

}  // namespace

void write_price_list(const PriceList& list, const fs::path& folder) {
    const std::vector<PricedRun> runs = list_runs(list);
    const Image& reference = list.reference.image;
    write_png(folder / "pictures/reference.png", to_display(reference).image);
    for (const PricedRun& run : runs) {
        const Level& level = level_of(list, run);
        if (!level.picture.channels.empty())
            write_picture(folder, picture_of_run(run), level.picture, reference);
    }
    write_row(list, runs, list.equal_time, "equal-time", folder);
    write_row(list, runs, list.equal_error, "equal-error", folder);
    const std::string csv = to_csv(list);
    write_file_atomically(folder / "tradeoff.csv", std::as_bytes(std::span(csv)));
    const std::string json = json_text(to_json(list), 2) + "\n";
    write_file_atomically(folder / "tradeoff.json", std::as_bytes(std::span(json)));
}

}  // namespace voxilux
