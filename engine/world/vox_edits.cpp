#include "world/vox_edits.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <tuple>

#include "base/error.h"
#include "scene/vox_animation.h"
#include "scene/vox_cells.h"
#include "scene/vox_instances.h"
#include "scene/vox_material.h"
#include "scene/vox_scene.h"
#include "shared/world_cell.h"

namespace voxilux {
namespace {

using Key = std::array<int, 3>;
using Cells = std::map<Key, std::uint8_t>;  // palette indices, 0: empty

Key key_of(glm::ivec3 v) {
    return {v.z, v.y, v.x};
}

[[noreturn]] void refuse_edits(const std::string& why) {
    throw Error(ExitCode::input_refused, "the edits cannot be saved: " + why);
}

// A visible model with the cells that it covers.
struct PlacedModel {
    std::uint32_t model = 0;
    Rotation rotation;
    Box box;

    [[nodiscard]] bool covers(glm::ivec3 cell) const {
        return glm::all(glm::greaterThanEqual(cell, box.lo)) && glm::all(glm::lessThan(cell, box.hi));
    }
    // The cell in the model's own coordinates.
    [[nodiscard]] glm::ivec3 local(glm::ivec3 cell) const {
        glm::ivec3 v(0);
        for (int i = 0; i < 3; ++i) {
            const auto axis = static_cast<std::size_t>(i);
            v[rotation.axis[axis]] = rotation.sign[axis] > 0 ? cell[i] - box.lo[i] : box.hi[i] - 1 - cell[i];
        }
        return v;
    }
};

std::vector<VoxInstance> instances_of(const VoxFile& file) {
    if (is_animated(file)) refuse_edits("the file is animated");
    const auto instances = vox_instances(file);
    if (!instances) refuse_edits(instances.reason());
    return instances.value();
}

std::vector<PlacedModel> placed_models(const VoxFile& file, std::span<const VoxInstance> instances) {
    std::vector<PlacedModel> placed;
    for (const VoxInstance& one : instances) {
        if (one.hidden || one.model >= file.models.size()) continue;
        const glm::ivec3 size = file.models[one.model].size;
        const Instance instance{one.model, one.rotation, one.translation};
        const glm::ivec3 a = world_cell(instance, size, glm::ivec3(0));
        const glm::ivec3 b = world_cell(instance, size, size - 1);
        placed.push_back({one.model, one.rotation, {glm::min(a, b), glm::max(a, b) + 1}});
    }
    return placed;
}

// For each material of a scene, the lowest palette index that looks like it; 0 where none does.
std::vector<std::uint8_t> palette_indices(const VoxFile& file, std::span<const Material> materials) {
    std::vector<std::string> warnings;
    const std::array<Material, 256> looks = vox_materials(file, warnings);
    std::vector<std::uint8_t> indices;
    for (const Material& material : materials) {
        const auto found = std::find(looks.begin() + 1, looks.end(), material);
        indices.push_back(found != looks.end() ? static_cast<std::uint8_t>(found - looks.begin()) : 0);
    }
    return indices;
}

// A world, and the palette indices of its materials.
struct IndexedWorld {
    const VoxelWorld& world;
    std::vector<std::uint8_t> indices;

    [[nodiscard]] std::uint8_t at(glm::ivec3 cell) const {
        const std::uint16_t voxel = world.get(cell - world.origin());
        return voxel == VoxelWorld::kEmpty ? std::uint8_t{0} : indices.at(voxel & gpu::kVoxelPayloadMask);
    }
};

// The cells in which the worlds differ, with what the second one has there.
Cells difference_of(const IndexedWorld& before, const IndexedWorld& after) {
    Cells cells;
    after.world.for_each_voxel([&](glm::ivec3 local, std::uint16_t) {
        const glm::ivec3 cell = local + after.world.origin();
        const std::uint8_t index = after.at(cell);
        if (index == 0) refuse_edits("the file's palette lacks one of the materials");
        if (index != before.at(cell)) cells[key_of(cell)] = index;
    });
    before.world.for_each_voxel([&](glm::ivec3 local, std::uint16_t) {
        const glm::ivec3 cell = local + before.world.origin();
        if (after.at(cell) == 0) cells[key_of(cell)] = 0;
    });
    return cells;
}

void change_model(VoxModel& model, const Cells& cells) {
    std::erase_if(model.voxels, [&](const VoxVoxel& v) { return cells.contains({v.z, v.y, v.x}); });
    for (const auto& [key, index] : cells) {
        if (index != 0)
            model.voxels.push_back({static_cast<std::uint8_t>(key[2]), static_cast<std::uint8_t>(key[1]),
                                    static_cast<std::uint8_t>(key[0]), index});
    }
    VoxCells seen;
    count_oddities(model, seen);
}

std::int32_t next_id(const VoxFile& file) {
    std::int32_t id = -1;
    for (const VoxNode& node : file.nodes)
        id = std::max(id, std::visit([](const auto& one) { return one.id; }, node));
    return id + 1;
}

void add_node(VoxFile& file, std::int32_t group, std::size_t model, glm::ivec3 translation) {
    const std::int32_t id = next_id(file);
    for (VoxNode& node : file.nodes)
        if (auto* of = std::get_if<VoxGroup>(&node); of != nullptr && of->id == group)
            of->children.push_back(id);
    file.nodes.emplace_back(VoxTransform{
        .id = id,
        .child = id + 1,
        .frames = {{{"_t", fmt::format("{} {} {}", translation.x, translation.y, translation.z)}}}});
    file.nodes.emplace_back(VoxShape{.id = id + 1, .models = {{static_cast<std::int32_t>(model), {}}}});
}

bool is_placed(const VoxTransform& node) {
    return std::ranges::any_of(node.frames, [](const VoxDict& frame) {
        return std::ranges::any_of(frame, [](const auto& pair) {
            return (pair.first == "_t" && pair.second != "0 0 0") ||
                   (pair.first == "_r" && pair.second != "4");
        });
    });
}

// The group below the root, made where the file has no graph.
std::int32_t root_group(VoxFile& file) {
    if (file.nodes.empty()) {
        file.nodes.emplace_back(VoxTransform{.id = 0, .child = 1, .frames = {{}}});
        file.nodes.emplace_back(VoxGroup{.id = 1});
        for (std::size_t i = 0; i < file.models.size(); ++i)
            add_node(file, 1, i, file.models[i].size / 2);
        return 1;
    }
    for (const VoxNode& node : file.nodes) {
        const auto* root = std::get_if<VoxTransform>(&node);
        if (root == nullptr || root->id != 0) continue;
        if (is_placed(*root)) refuse_edits("the file moves or turns the root of its graph");
        for (const VoxNode& child : file.nodes)
            if (const auto* group = std::get_if<VoxGroup>(&child);
                group != nullptr && group->id == root->child)
                return group->id;
    }
    refuse_edits("the file's graph has no group below its root");
}

// Adds a model for each block of 256^3 scene cells that holds some of the cells.
void add_models(VoxFile& file, const Cells& cells) {
    const auto block_of = [](int v) { return v >= 0 ? v / kVoxMaxSide : (v + 1) / kVoxMaxSide - 1; };
    std::map<Key, Cells> blocks;
    for (const auto& [key, index] : cells)
        blocks[{block_of(key[0]), block_of(key[1]), block_of(key[2])}][key] = index;
    for (const auto& [block, inside] : blocks) {
        Box box;
        for (const auto& [key, index] : inside) {
            const glm::ivec3 cell(key[2], key[1], key[0]);
            box = united(box, {cell, cell + 1});
        }
        Cells local;
        for (const auto& [key, index] : inside)
            local[{key[0] - box.lo.z, key[1] - box.lo.y, key[2] - box.lo.x}] = index;
        VoxModel model{.size = box.hi - box.lo};
        change_model(model, local);
        const std::int32_t group = root_group(file);
        file.models.push_back(std::move(model));
        add_node(file, group, file.models.size() - 1, box.lo + file.models.back().size / 2);
    }
}

}  // namespace

VoxFile with_voxels(const VoxFile& file, const VoxelWorld& world, std::span<const Material> materials) {
    const std::vector<VoxInstance> instances = instances_of(file);
    const std::vector<PlacedModel> placed = placed_models(file, instances);
    const Scene scene = scene_from_vox(file);
    const VoxelWorld before = build_world(scene);
    const Cells changed = difference_of({before, palette_indices(file, scene.materials)},
                                        {world, palette_indices(file, materials)});
    std::map<std::uint32_t, Cells> edits;  // by model
    Cells outside;
    for (const auto& [key, index] : changed) {
        const glm::ivec3 cell(key[2], key[1], key[0]);
        const PlacedModel* owner = nullptr;
        for (const PlacedModel& one : placed) {
            if (!one.covers(cell)) continue;
            edits[one.model][key_of(one.local(cell))] = 0;
            owner = &one;
        }
        if (owner != nullptr)
            edits[owner->model][key_of(owner->local(cell))] = index;
        else
            outside[key] = index;
    }
    VoxFile saved = file;
    for (const auto& [model, cells] : edits) {
        if (std::ranges::count(instances, model, &VoxInstance::model) > 1)
            refuse_edits(fmt::format("model {} is shown more than once, and all would change", model));
        change_model(saved.models[model], cells);
    }
    add_models(saved, outside);
    return saved;
}

}  // namespace voxilux
