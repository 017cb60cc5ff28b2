#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Occlusion samples for the cells of the hits. The number of samples that a cell already has is the index of
// its next one in the cell's own sequence, which gives the ray's direction and its origin in the cell: sums
// depend on how many samples were taken, not on which invocation took them. Hits without a cell (on spheres,
// or when the table is full) keep the visibility of their own rays.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/occlusion.glsl"

#include "lib/ao_cells.glsl"
#include "lib/ao_reproject.glsl"
#include "lib/constants.glsl"

VX_SPECIALIZED(uint, reprojects, 1u);  // in the look-up, if it happens here
VX_SPECIALIZED(uint, merged, 0u);      // the look-up happens here
VX_SPECIALIZED(uint, by_pixel, 0u);    // samples start at the hit, in the pixel's sequence

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
    float own_visibility[];
};

uint locate(Hit hit) {
    uint guess = kNoSlot;
    if (reprojects != 0u) guess = reproject(hit, ao_cell_key(cell_of(hit)));
    uint slot = search(hit, guess);
    count(kWorkAoReused, guess != kNoSlot ? 1u : 0u);
    return slot;
}

// The sequence of a hit's next samples: that of its cell or of its pixel.
struct Stream {
    uint stream;
    uvec2 first;  // index of the next sample
    bool of_cell;
};

Stream stream_of(Pixel pixel, AoCell cell, uint slot, bool takes) {
    Stream from;
    from.of_cell = by_pixel == 0u && slot != kNoSlot;
    uvec2 taken = uvec2(0u);
    if (takes && slot != kNoSlot) taken = unpack32(atomicAdd(samples[slot], uint64_t(ao_rays)));
    from.first = from.of_cell ? taken : first_ray(ao_frame.pass_number, ao_rays);
    from.stream = from.of_cell ? ao_cell_stream(ao_cell_key(cell)) : pixel_stream(pixel);
    return from;
}

// Counts rays of a hit that meet nothing. There is a single call of the march for all kinds of hits, because
// software devices run every branch for all invocations.
uint count_open(Hit hit, AoCell cell, Stream from, uint rays) {
    uint own = own_sphere(hit);
    uint open = 0u;
    for (uint i = 0u; i < rays; ++i) {
        SampleKey key = sample_key(from.stream, ray_number(from.first, i), frame.seed);
        vec2 u = draw_2d(key, kPairOcclusion);
        Hit start = hit;
        if (by_pixel == 0u) {
            vec3 point = ao_cell_point(cell, draw_2d(key, kPairPixel));
            start.fraction = from.of_cell ? point : hit.fraction;
        }
        vec3 direction = is_on_sphere(hit) ? cosine_about(surface_normal(hit), u) : cosine_on_face(hit.face, u);
        open += is_occluded(ray_from(start, direction, frame.ao_radius), own) ? 0u : 1u;
    }
    return open;
}

void main() {
    init_scene();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index];
    uint slot = kNoSlot;
    if (hit.face < kFaceInside) slot = merged != 0u ? locate(hit) : located[pixel.index];
    if (merged != 0u) slots[pixel.index] = slot;
    bool is_lit = is_surface(hit) && hit.face != kFaceInside;
    bool takes = is_lit && (slot == kNoSlot || (slot & kSlotRests) == 0u);
    AoCell cell = cell_of(hit);
    Stream from = stream_of(pixel, cell, slot, takes);
    uint open = count_open(hit, cell, from, takes ? ao_rays : 0u);
    if (takes && slot != kNoSlot) atomicAdd(opens[slot], uint64_t(open));
    count(kWorkAoRays, takes ? ao_rays : 0u);
    count(kWorkAoOwnRays, takes && slot == kNoSlot ? ao_rays : 0u);
    own_visibility[pixel.index] = is_lit ? float(open) / float(ao_rays) : (hit.face == kFaceInside ? 0.0 : 1.0);
}
