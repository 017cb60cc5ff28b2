#include "voxelizer/vox_output.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "base/checked_cast.h"
#include "formats/vox_write.h"

namespace voxilux {
namespace {

constexpr std::int32_t kFirstModelNode = 2;  // after the root's transform and the group

// The contents of one XYZI chunk: the blocks of one model.
struct ModelPart {
    std::span<const VoxelBlock> blocks;
    glm::ivec3 low{0};  // of its voxels, in the grid
    glm::ivec3 size{0};
    std::uint64_t voxels = 0;
};

// Calls visit(x, y, z in the model's 256^3 cells) for the interior of a block.
template <class Visit>
void for_each_interior(const VoxelBlock& block, const Visit& visit) {
    const glm::ivec3 offset = block.low % kModelCells;
    for (const InteriorRow& row : block.interior) {
        for (std::uint64_t rest = row.cells; rest != 0; rest &= rest - 1) {
            visit(offset + glm::ivec3(std::countr_zero(rest), row.row % kBlockCells, row.row / kBlockCells));
        }
    }
}

ModelPart part_of(std::span<const VoxelBlock> blocks) {
    ModelPart part{.blocks = blocks};
    glm::ivec3 low(kModelCells);
    glm::ivec3 high(-1);
    const auto add = [&](glm::ivec3 cell) {
        low = glm::min(low, cell);
        high = glm::max(high, cell);
        ++part.voxels;
    };
    for (const VoxelBlock& block : blocks) {
        for (const ColouredVoxel& voxel : block.surface)
            add({voxel.x, voxel.y, voxel.z});
        for_each_interior(block, add);
    }
    part.low = blocks.front().low / kModelCells * kModelCells + low;
    part.size = high - low + 1;
    return part;
}

std::vector<ModelPart> parts_of(const VoxelSet& set) {
    std::vector<ModelPart> parts;
    const std::span<const VoxelBlock> blocks(set.blocks);
    for (std::size_t i = 0; i < blocks.size();) {
        const std::size_t first = i;
        while (i < blocks.size() && blocks[i].model == blocks[first].model)
            ++i;
        parts.push_back(part_of(blocks.subspan(first, i - first)));
    }
    return parts;
}

std::vector<VoxVoxel> voxels_of(const ModelPart& part, const VoxelPalette& palette) {
    std::vector<VoxVoxel> voxels;
    voxels.reserve(static_cast<std::size_t>(part.voxels));
    const glm::ivec3 low = part.low % kModelCells;
    const auto add = [&](glm::ivec3 cell, std::uint8_t entry) {
        const glm::ivec3 c = cell - low;
        voxels.push_back({static_cast<std::uint8_t>(c.x), static_cast<std::uint8_t>(c.y),
                          static_cast<std::uint8_t>(c.z), static_cast<std::uint8_t>(entry + 1)});
    };
    for (const VoxelBlock& block : part.blocks) {
        for (const ColouredVoxel& voxel : block.surface) {
            const glm::ivec3 cell{voxel.x, voxel.y, voxel.z};
            add(cell, palette.entry_of(voxel, cell));
        }
        for_each_interior(block, [&](glm::ivec3 cell) { add(cell, palette.commonest()); });
    }
    return voxels;
}

void add_palette(VoxFile& file, const VoxelPalette& palette) {
    file.has_palette = true;
    file.palette.fill({});
    std::int32_t index = 0;
    for (const PaletteEntry& entry : palette.entries()) {
        file.palette[static_cast<std::size_t>(index)] = {entry.colour.r, entry.colour.g, entry.colour.b, 255};
        file.materials.push_back({.id = ++index, .attributes = material_attributes(entry.look)});
    }
}

// Where the models stand, in cells of the scene.
std::vector<PlacedModel> placed_models(const std::vector<ModelPart>& parts, const MeshGrid& grid,
                                       const std::string& name) {
    std::vector<PlacedModel> placed;
    for (const ModelPart& part : parts) {
        const glm::ivec3 model = part.low / kModelCells;
        const std::string own_name =
            parts.size() == 1 ? name : fmt::format("{} {} {} {}", name, model.x, model.y, model.z);
        placed.push_back({own_name, part.low - grid.origin, part.size});
    }
    return placed;
}

// Rounded to 4 decimal places, without negative zero.
std::string tidy(double value) {
    return fmt::format("{}", std::round(value * 1e4) / 1e4 + 0.0);
}

// MagicaVoxel's camera looks at a focus from a distance, with pitch and yaw in degrees: yaw 0 looks along +y,
// pitch is positive downwards. A pinhole has no focus, so any will do: the middle of the grid's depth.
VoxDict camera_attributes(const MeshCamera& camera, const MeshGrid& grid) {
    const glm::dvec3 position = grid.to_grid(camera.position) - glm::dvec3(grid.origin);
    const glm::dvec3 forward = grid.axes * camera.forward;
    const glm::dvec3 middle(0.0, 0.0, grid.cells.z / 2.0 - grid.origin.z);
    const double radius = std::max(1.0, glm::dot(middle - position, forward));
    const glm::dvec3 focus = position + forward * radius;
    const double pitch = glm::degrees(std::asin(std::clamp(-forward.z, -1.0, 1.0)));
    const double yaw = glm::degrees(std::atan2(-forward.x, forward.y));
    return {{"_mode", "pers"},
            {"_focus", fmt::format("{} {} {}", tidy(focus.x), tidy(focus.y), tidy(focus.z))},
            {"_angle", fmt::format("{} {} 0", tidy(pitch), tidy(yaw))},
            {"_radius", tidy(radius)},
            {"_frustum", "0.414214"},
            {"_fov", tidy(camera.fov_y_deg)}};
}

// Everything but the models.
VoxFile file_around(const std::vector<ModelPart>& parts, const VoxelSet& set, const VoxelPalette& palette,
                    const Mesh& mesh, const std::string& name) {
    VoxFile rest{.version = 200};
    add_graph(rest, placed_models(parts, set.grid, name), name);
    add_palette(rest, palette);
    for (std::size_t i = 0; i < mesh.cameras.size(); ++i) {
        rest.cameras.push_back({.id = checked_cast<std::int32_t>(i, "camera"),
                                .attributes = camera_attributes(mesh.cameras[i], set.grid)});
    }
    return rest;
}

// MagicaVoxel's space is a cube of 2000 voxels about the origin.
constexpr int kLowestPlace = -1000;
constexpr int kHighestPlace = 999;

}  // namespace

void add_graph(VoxFile& file, std::span<const PlacedModel> models, const std::string& name) {
    file.nodes.push_back(VoxTransform{.id = 0, .child = 1, .frames = {{}}});
    VoxGroup group{.id = 1};
    for (std::size_t i = 0; i < models.size(); ++i)
        group.children.push_back(checked_cast<std::int32_t>(kFirstModelNode + 2 * i, "node"));
    file.nodes.push_back(group);
    for (std::size_t i = 0; i < models.size(); ++i) {
        const std::int32_t id = group.children[i];
        const glm::ivec3 at = models[i].low + models[i].size / 2;
        file.nodes.push_back(VoxTransform{.id = id,
                                          .attributes = {{"_name", models[i].name}},
                                          .child = id + 1,
                                          .layer = 0,
                                          .frames = {{{"_t", fmt::format("{} {} {}", at.x, at.y, at.z)}}}});
        file.nodes.push_back(
            VoxShape{.id = id + 1, .models = {{.model = checked_cast<std::int32_t>(i, "model")}}});
    }
    file.layers.push_back({.id = 0, .attributes = {{"_name", name}}});
}

std::optional<std::string> range_warning(const MeshGrid& grid) {
    const glm::ivec3 low = -grid.origin, high = grid.cells - grid.origin - 1;
    for (int axis = 0; axis < 3; ++axis) {
        if (low[axis] >= kLowestPlace && high[axis] <= kHighestPlace) continue;
        return fmt::format("the voxels reach from {} to {} on {}, beyond the {} to {} that MagicaVoxel shows",
                           low[axis], high[axis], "xyz"[axis], kLowestPlace, kHighestPlace);
    }
    return std::nullopt;
}

VoxOutput write_voxels(const std::filesystem::path& file, const VoxelSet& set, const VoxelPalette& palette,
                       const Mesh& mesh, const std::string& name) {
    const std::vector<ModelPart> parts = parts_of(set);
    std::vector<VoxModelHead> heads;
    for (const ModelPart& part : parts)
        heads.push_back({part.size, part.voxels});
    VoxOutput output{.models = parts.size(), .voxels = set.surface + set.interior};
    output.bytes = write_vox_models(
        file, heads, [&](std::size_t i) { return voxels_of(parts[i], palette); },
        file_around(parts, set, palette, mesh, name));
    return output;
}

VoxFile vox_file_of(const VoxelSet& set, const VoxelPalette& palette, const Mesh& mesh,
                    const std::string& name) {
    const std::vector<ModelPart> parts = parts_of(set);
    VoxFile file = file_around(parts, set, palette, mesh, name);
    for (const ModelPart& part : parts)
        file.models.push_back({.size = part.size, .voxels = voxels_of(part, palette)});
    return file;
}

}  // namespace voxilux
