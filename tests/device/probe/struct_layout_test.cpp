// Compares the layout of the structs of gpu_types.h in C++ with the layout in the compiled shaders.

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "embedded.h"
#include "shared/alias.h"
#include "shared/denoise.h"
#include "shared/gpu_types.h"
#include "shared/photon_types.h"
#include "shared/sky_view.h"
#include "shared/window.h"
#include "vk/spirv_reflect.h"

namespace voxilux {
namespace {

struct Layout {
    std::string name;
    std::size_t size_bytes = 0;
    std::vector<StructMember> members;
};

#define VX_MEMBER(type, member)                                            \
    StructMember {                                                         \
#member, static_cast < std::uint32_t>(offsetof(gpu::type, member)) \
    }
#define VX_LAYOUT(type, ...)        \
    Layout {                        \
#type, sizeof(gpu::type), { \
            __VA_ARGS__             \
        }                           \
    }

// One row per struct that lives in a buffer, all members in order.
const std::vector<Layout>& layouts() {
    static const std::vector<Layout> rows = {
        VX_LAYOUT(Hit, VX_MEMBER(Hit, cell), VX_MEMBER(Hit, face), VX_MEMBER(Hit, fraction),
                  VX_MEMBER(Hit, t), VX_MEMBER(Hit, material), VX_MEMBER(Hit, sphere)),
        VX_LAYOUT(Sphere, VX_MEMBER(Sphere, anchor), VX_MEMBER(Sphere, curvature), VX_MEMBER(Sphere, normal)),
        VX_LAYOUT(SphereRecord, VX_MEMBER(SphereRecord, shape), VX_MEMBER(SphereRecord, material)),
        VX_LAYOUT(Air, VX_MEMBER(Air, rayleigh), VX_MEMBER(Air, ozone), VX_MEMBER(Air, mie),
                  VX_MEMBER(Air, mie_extinction), VX_MEMBER(Air, mie_g), VX_MEMBER(Air, ground_albedo)),
        VX_LAYOUT(SkyParams, VX_MEMBER(SkyParams, air), VX_MEMBER(SkyParams, height),
                  VX_MEMBER(SkyParams, horizon), VX_MEMBER(SkyParams, top), VX_MEMBER(SkyParams, disc_height),
                  VX_MEMBER(SkyParams, sun_direction), VX_MEMBER(SkyParams, irradiance),
                  VX_MEMBER(SkyParams, resolution), VX_MEMBER(SkyParams, km_per_voxel)),
        VX_LAYOUT(SkyScatterPush, VX_MEMBER(SkyScatterPush, air), VX_MEMBER(SkyScatterPush, is_first)),
        VX_LAYOUT(FrameParams, VX_MEMBER(FrameParams, chunks), VX_MEMBER(FrameParams, world_origin),
                  VX_MEMBER(FrameParams, camera_cell), VX_MEMBER(FrameParams, camera_fraction),
                  VX_MEMBER(FrameParams, camera_right), VX_MEMBER(FrameParams, camera_up),
                  VX_MEMBER(FrameParams, camera_forward), VX_MEMBER(FrameParams, camera_angle),
                  VX_MEMBER(FrameParams, camera_block), VX_MEMBER(FrameParams, camera_pixel),
                  VX_MEMBER(FrameParams, lens_radius), VX_MEMBER(FrameParams, lens_power),
                  VX_MEMBER(FrameParams, lens_blades), VX_MEMBER(FrameParams, width),
                  VX_MEMBER(FrameParams, height), VX_MEMBER(FrameParams, first_row),
                  VX_MEMBER(FrameParams, row_count), VX_MEMBER(FrameParams, first_column),
                  VX_MEMBER(FrameParams, column_count), VX_MEMBER(FrameParams, film_tile_first_row),
                  VX_MEMBER(FrameParams, first_element), VX_MEMBER(FrameParams, sample_index),
                  VX_MEMBER(FrameParams, seed), VX_MEMBER(FrameParams, ao_radius),
                  VX_MEMBER(FrameParams, sky_radiance), VX_MEMBER(FrameParams, sky_turn),
                  VX_MEMBER(FrameParams, sun_direction), VX_MEMBER(FrameParams, sun_irradiance),
                  VX_MEMBER(FrameParams, sun_cone_height), VX_MEMBER(FrameParams, ground_material),
                  VX_MEMBER(FrameParams, ground_luminance), VX_MEMBER(FrameParams, light_count),
                  VX_MEMBER(FrameParams, light_power), VX_MEMBER(FrameParams, emitter_photons),
                  VX_MEMBER(FrameParams, sun_photons), VX_MEMBER(FrameParams, sun_disc_centre),
                  VX_MEMBER(FrameParams, sun_disc_radius)),
        VX_LAYOUT(
            AoParams, VX_MEMBER(AoParams, last_camera_cell), VX_MEMBER(AoParams, last_camera_fraction),
            VX_MEMBER(AoParams, last_right), VX_MEMBER(AoParams, last_up), VX_MEMBER(AoParams, last_forward),
            VX_MEMBER(AoParams, has_last), VX_MEMBER(AoParams, frame), VX_MEMBER(AoParams, pass_number),
            VX_MEMBER(AoParams, table_mask), VX_MEMBER(AoParams, max_age), VX_MEMBER(AoParams, sample_limit),
            VX_MEMBER(AoParams, cell_width), VX_MEMBER(AoParams, parallel_width)),
        VX_LAYOUT(AoFilterPush, VX_MEMBER(AoFilterPush, step)),
        VX_LAYOUT(AoMissed, VX_MEMBER(AoMissed, groups_x), VX_MEMBER(AoMissed, groups_y),
                  VX_MEMBER(AoMissed, groups_z), VX_MEMBER(AoMissed, count)),
        VX_LAYOUT(WorldGrowPush, VX_MEMBER(WorldGrowPush, count), VX_MEMBER(WorldGrowPush, chunks),
                  VX_MEMBER(WorldGrowPush, axis), VX_MEMBER(WorldGrowPush, bound)),
        VX_LAYOUT(PathRay, VX_MEMBER(PathRay, cell), VX_MEMBER(PathRay, fraction),
                  VX_MEMBER(PathRay, direction), VX_MEMBER(PathRay, own), VX_MEMBER(PathRay, medium)),
        VX_LAYOUT(PathState, VX_MEMBER(PathState, ray), VX_MEMBER(PathState, kind),
                  VX_MEMBER(PathState, stream), VX_MEMBER(PathState, throughput), VX_MEMBER(PathState, scale),
                  VX_MEMBER(PathState, pdf), VX_MEMBER(PathState, image_share), VX_MEMBER(PathState, light),
                  VX_MEMBER(PathState, surfaces), VX_MEMBER(PathState, vertices), VX_MEMBER(PathState, flags),
                  VX_MEMBER(PathState, next_id)),
        VX_LAYOUT(PathPush, VX_MEMBER(PathPush, lanes), VX_MEMBER(PathPush, is_last)),
        VX_LAYOUT(DenoisePush, VX_MEMBER(DenoisePush, size), VX_MEMBER(DenoisePush, step),
                  VX_MEMBER(DenoisePush, share)),
        VX_LAYOUT(FilmAddPush, VX_MEMBER(FilmAddPush, first_pixel), VX_MEMBER(FilmAddPush, pixel_count)),
        VX_LAYOUT(DisplayResolvePush, VX_MEMBER(DisplayResolvePush, low), VX_MEMBER(DisplayResolvePush, high),
                  VX_MEMBER(DisplayResolvePush, pixel_count), VX_MEMBER(DisplayResolvePush, width),
                  VX_MEMBER(DisplayResolvePush, first_row), VX_MEMBER(DisplayResolvePush, samples),
                  VX_MEMBER(DisplayResolvePush, rows_ahead), VX_MEMBER(DisplayResolvePush, exposure),
                  VX_MEMBER(DisplayResolvePush, divider)),
        VX_LAYOUT(DisplayRangePush, VX_MEMBER(DisplayRangePush, low), VX_MEMBER(DisplayRangePush, high)),
        VX_LAYOUT(DisplayCellsPush, VX_MEMBER(DisplayCellsPush, pixel_count),
                  VX_MEMBER(DisplayCellsPush, low), VX_MEMBER(DisplayCellsPush, high)),
        VX_LAYOUT(Ray, VX_MEMBER(Ray, cell), VX_MEMBER(Ray, fraction), VX_MEMBER(Ray, direction),
                  VX_MEMBER(Ray, t_max)),
        VX_LAYOUT(BenchHit, VX_MEMBER(BenchHit, cell), VX_MEMBER(BenchHit, face), VX_MEMBER(BenchHit, t),
                  VX_MEMBER(BenchHit, steps)),
        VX_LAYOUT(BenchMarchPush, VX_MEMBER(BenchMarchPush, count), VX_MEMBER(BenchMarchPush, chunks),
                  VX_MEMBER(BenchMarchPush, beams)),
        VX_LAYOUT(PhotonGrid, VX_MEMBER(PhotonGrid, cells_per_voxel),
                  VX_MEMBER(PhotonGrid, x_cells_per_voxel), VX_MEMBER(PhotonGrid, mask)),
        VX_LAYOUT(PhotonParams, VX_MEMBER(PhotonParams, grid), VX_MEMBER(PhotonParams, power_scale),
                  VX_MEMBER(PhotonParams, power_unit), VX_MEMBER(PhotonParams, radius),
                  VX_MEMBER(PhotonParams, half_area_radius), VX_MEMBER(PhotonParams, capacity),
                  VX_MEMBER(PhotonParams, first_photon), VX_MEMBER(PhotonParams, photons),
                  VX_MEMBER(PhotonParams, iteration), VX_MEMBER(PhotonParams, alpha)),
        VX_LAYOUT(AimMap, VX_MEMBER(AimMap, first), VX_MEMBER(AimMap, count), VX_MEMBER(AimMap, low),
                  VX_MEMBER(AimMap, cell)),
        VX_LAYOUT(PixelRadius, VX_MEMBER(PixelRadius, squared), VX_MEMBER(PixelRadius, photons)),
        VX_LAYOUT(PhotonPoint, VX_MEMBER(PhotonPoint, position), VX_MEMBER(PhotonPoint, surface),
                  VX_MEMBER(PhotonPoint, pixel)),
        VX_LAYOUT(PhotonHead, VX_MEMBER(PhotonHead, groups_x), VX_MEMBER(PhotonHead, groups_y),
                  VX_MEMBER(PhotonHead, groups_z), VX_MEMBER(PhotonHead, count)),
    };
    return rows;
}

// One line per difference between the row and the shader's struct; empty when they agree.
std::vector<std::string> layout_differences(const Layout& row, const StructInfo& in_shader) {
    std::vector<std::string> lines;
    if (row.size_bytes != in_shader.size_bytes)
        lines.push_back(row.name + ": " + std::to_string(row.size_bytes) + " bytes in C++, " +
                        std::to_string(in_shader.size_bytes) + " in the shader");
    if (in_shader.array_stride != 0 && in_shader.array_stride != row.size_bytes)
        lines.push_back(row.name + ": array stride " + std::to_string(in_shader.array_stride));
    if (row.members.size() != in_shader.members.size())
        lines.push_back(row.name + ": " + std::to_string(row.members.size()) + " members in C++, " +
                        std::to_string(in_shader.members.size()) + " in the shader");
    for (std::size_t i = 0; i < std::min(row.members.size(), in_shader.members.size()); ++i) {
        const StructMember& a = row.members[i];
        const StructMember& b = in_shader.members[i];
        if (!(a == b))
            lines.push_back(row.name + ": C++ " + a.name + " at " + std::to_string(a.offset) + ", shader " +
                            b.name + " at " + std::to_string(b.offset));
    }
    return lines;
}

struct NamedProgram {
    std::string shader;
    ProgramInfo info;
};

// Every shader, passes and probes, by reflection.
const std::vector<NamedProgram>& programs() {
    static const std::vector<NamedProgram> all = [] {
        std::vector<NamedProgram> found;
        for (const auto shaders : {pass_shaders(), probe_shaders()})
            for (const EmbeddedShader& shader : shaders)
                found.push_back({std::string(shader.name), reflect(shader.spirv)});
        return found;
    }();
    return all;
}

StructInfo first_in_shaders(const std::string& name) {
    for (const NamedProgram& program : programs())
        if (const StructInfo* type = program.info.find_struct(name)) return *type;
    return {};
}

// What shaders read texel by texel, by the place of a member: lib/materials.glsl, lib/lights.glsl,
// lib/path_start.glsl.
TEST(StructLayout, members_of_texels_are_where_shaders_look_for_them) {
    const std::vector<Layout> wanted = {{"SurfaceMaterial",
                                         48,
                                         {{"albedo", 0},
                                          {"mirror", 12},
                                          {"emission", 16},
                                          {"glass", 28},
                                          {"ior", 32},
                                          {"alpha", 36},
                                          {"metal_row", 40},
                                          {"glass_row", 44}}},
                                        {"LightRecord", 16, {{"cell", 0}, {"what", 12}}},
                                        {"AliasEntry", 12, {{"keep", 0}, {"other", 4}, {"pdf", 8}}},
                                        {"PathStart",
                                         64,
                                         {{"cell", 0},
                                          {"stream", 12},
                                          {"fraction", 16},
                                          {"own", 28},
                                          {"direction", 32},
                                          {"medium", 44},
                                          {"normal", 48},
                                          {"is_rough", 60}}}};
    const std::vector<Layout> rows = {
        VX_LAYOUT(SurfaceMaterial, VX_MEMBER(SurfaceMaterial, albedo), VX_MEMBER(SurfaceMaterial, mirror),
                  VX_MEMBER(SurfaceMaterial, emission), VX_MEMBER(SurfaceMaterial, glass),
                  VX_MEMBER(SurfaceMaterial, ior), VX_MEMBER(SurfaceMaterial, alpha),
                  VX_MEMBER(SurfaceMaterial, metal_row), VX_MEMBER(SurfaceMaterial, glass_row)),
        VX_LAYOUT(LightRecord, VX_MEMBER(LightRecord, cell), VX_MEMBER(LightRecord, what)),
        VX_LAYOUT(AliasEntry, VX_MEMBER(AliasEntry, keep), VX_MEMBER(AliasEntry, other),
                  VX_MEMBER(AliasEntry, pdf)),
        VX_LAYOUT(PathStart, VX_MEMBER(PathStart, cell), VX_MEMBER(PathStart, stream),
                  VX_MEMBER(PathStart, fraction), VX_MEMBER(PathStart, own), VX_MEMBER(PathStart, direction),
                  VX_MEMBER(PathStart, medium), VX_MEMBER(PathStart, normal),
                  VX_MEMBER(PathStart, is_rough))};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].size_bytes, wanted[i].size_bytes) << wanted[i].name;
        for (std::size_t m = 0; m < wanted[i].members.size(); ++m)
            EXPECT_EQ(rows[i].members[m].offset, wanted[i].members[m].offset)
                << wanted[i].name << ' ' << wanted[i].members[m].name;
    }
}

TEST(StructLayout, every_struct_has_the_same_offsets_in_cpp_and_in_every_shader) {
    for (const Layout& row : layouts()) {
        int shaders = 0;
        for (const NamedProgram& program : programs()) {
            const StructInfo* type = program.info.find_struct(row.name);
            if (type == nullptr) continue;
            ++shaders;
            for (const std::string& line : layout_differences(row, *type))
                ADD_FAILURE() << program.shader << ": " << line;
        }
        EXPECT_GT(shaders, 0) << row.name << " is in no shader";
    }
}

// Blocks are not structs of gpu_types.h: they end in an array without a length, or some shader binds them by
// name.
bool is_block(const StructInfo& type) {
    if (type.size_bytes == 0 || type.name == "Push") return true;
    return std::any_of(programs().begin(), programs().end(), [&](const NamedProgram& program) {
        return program.info.find_block(type.name) != nullptr;
    });
}

TEST(StructLayout, every_struct_inside_a_buffer_of_a_pass_has_a_row) {
    for (const EmbeddedShader& shader : pass_shaders()) {
        const ProgramInfo info = reflect(shader.spirv);
        for (const StructInfo& type : info.structs) {
            const bool has_row = std::any_of(layouts().begin(), layouts().end(),
                                             [&](const Layout& row) { return row.name == type.name; });
            EXPECT_TRUE(has_row || is_block(type))
                << shader.name << " uses " << type.name << " without a row here";
        }
    }
}

TEST(StructLayout, a_moved_a_renamed_and_a_missing_member_are_caught) {
    const Layout& row = layouts().front();
    const StructInfo good = first_in_shaders(row.name);
    ASSERT_TRUE(layout_differences(row, good).empty());
    StructInfo moved = good;
    moved.members[1].offset += 4;
    StructInfo renamed = good;
    renamed.members[1].name = "axis";
    StructInfo shorter = good;
    shorter.members.pop_back();
    StructInfo longer = good;
    longer.size_bytes += 4;
    for (const StructInfo& bad : {moved, renamed, shorter, longer})
        EXPECT_EQ(layout_differences(row, bad).size(), 1u);
}

}  // namespace
}  // namespace voxilux
