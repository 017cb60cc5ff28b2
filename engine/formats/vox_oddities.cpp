#include "formats/vox_oddities.h"

#include <algorithm>
#include <utility>

#include "base/parallel_blocks.h"
#include "scene/vox_cells.h"

namespace voxilux {
namespace {

// Each thread has a set of cells of up to 2 MiB: no more threads than the voxels pay for.
constexpr std::size_t kVoxelsOfThread = std::size_t{1} << 18;

void count_all_oddities(std::vector<VoxModel>& models) {
    std::size_t voxels = 0;
    for (const VoxModel& model : models)
        voxels += model.voxels.size();
    for_each_block(models.size(), threads_for(voxels, kVoxelsOfThread), [&] {
        return [&, cells = VoxCells()](std::size_t i) mutable { count_oddities(models[i], cells); };
    });
}

void warn_of(const VoxModel& model, std::size_t id, std::size_t offset, VoxReading& reading) {
    if (model.out_of_size > 0)
        reading.warn(offset,
                     fmt::format("model {}: {} voxels outside its size are ignored", id, model.out_of_size));
    if (model.duplicates > 0)
        reading.warn(offset, fmt::format("model {}: {} voxels replace earlier ones", id, model.duplicates));
    if (model.index0 > 0)
        reading.warn(offset, fmt::format("model {}: {} voxels have the empty index 0", id, model.index0));
}

}  // namespace

void note_oddities(VoxReading& reading) {
    count_all_oddities(reading.file.models);
    std::vector<std::string> others = std::exchange(reading.file.warnings, {});
    std::size_t told = 0;
    const auto tell_until = [&](std::size_t end) {
        for (; told < std::min(end, others.size()); ++told)
            reading.keep_warning(std::move(others[told]));
    };
    for (std::size_t id = 0; id < reading.file.models.size(); ++id) {
        const VoxReading::ModelPlace& place = reading.model_places[id];
        tell_until(place.warnings);
        warn_of(reading.file.models[id], id, place.end, reading);
    }
    tell_until(others.size());
}

}  // namespace voxilux
