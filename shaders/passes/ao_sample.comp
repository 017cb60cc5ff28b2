#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Occlusion samples for the cells that the hits lie in. The number of samples that a cell already has is the number of the
// next one in the cell's own sequence, which gives its direction and the point of the cell that it starts from: sums
// depend on how many samples were taken, not on who took them. Hits without a cell (on spheres, or when the table has
// no room) keep their own rays' openness instead.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/occlusion.glsl"

#include "lib/ao_cells.glsl"

layout(constant_id = 23) const uint merged = 0u;      // the look-up happens here
layout(constant_id = 24) const uint by_pixel = 0u;    // samples start at the hit, in the pixel's sequence

layout(scalar) buffer Opens {
    uint64_t opens[];
};
layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) readonly buffer Located {
    uint located[];
};
layout(scalar) writeonly buffer Own {
    float own_openness[];
};

uint trace_for_cell(AoCell cell, uvec2 key, uvec2 first) {
    uint open = 0u;
    for (uint i = 0u; i < frame.ao_rays; ++i) {
        SampleKey sample_of_cell = sample_key(ao_cell_stream(key), ray_number(first, i), frame.seed);
        vec3 direction = cosine_on_face(cell.face, sample_2d(frame.sequence, sample_of_cell, kPairOcclusion));
        vec3 start = ao_cell_point(cell, sample_2d(frame.sequence, sample_of_cell, kPairPixel));
        Ray ray = leave_surface(cell.voxel, cell.face, start, direction, frame.ao_radius);
        open += is_occluded(ray, kNoSphere) ? 0u : 1u;
    }
    return open;
}

void sample_cell(Pixel pixel, Hit hit, uint slot) {
    uvec2 first = unpack32(atomicAdd(samples[slot], uint64_t(frame.ao_rays)));
    uint open = 0u;
    if (by_pixel != 0u) {
        float share = trace_openness(pixel, hit, first_ray(ao_frame.pass_number, frame.ao_rays));
        open = uint(share * float(frame.ao_rays) + 0.5);
    } else {
        AoCell cell = cell_of(hit);
        open = trace_for_cell(cell, ao_cell_key(cell), first);
    }
    if (open > 0u) atomicAdd(opens[slot], uint64_t(open));
    count(kWorkAoRays, frame.ao_rays);
    count(kWorkAoAtomics, open > 0u ? 2u : 1u);
}

void main() {
    open_world();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index];
    uint slot = kNoSlot;
    if (hit.face < kFaceInside) slot = merged != 0u ? locate(hit) : located[pixel.index];
    if (merged != 0u) slots[pixel.index] = slot;
    float openness = hit.face == kFaceInside ? 0.0 : 1.0;
    if (slot != kNoSlot) {
        if ((slot & kSlotRests) == 0u) sample_cell(pixel, hit, slot);
    } else if (is_surface(hit) && hit.face != kFaceInside) {
        openness = trace_openness(pixel, hit, first_ray(ao_frame.pass_number, frame.ao_rays));
        count(kWorkAoRays, frame.ao_rays);
        count(kWorkAoOwnRays, frame.ao_rays);
    }
    own_openness[pixel.index] = openness;
}
