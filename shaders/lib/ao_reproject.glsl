// How a hit finds the slot of its cell where the previous sample saw it. Include lib/ao_cells.glsl first.
#ifndef VX_AO_REPROJECT_GLSL
#define VX_AO_REPROJECT_GLSL

layout(scalar) readonly buffer LastSlots {
    uint last_slots[];
};

// The slot that a pixel of the previous sample had, if it is that of `key`.
uint last_slot(ivec2 pixel, uvec2 key) {
    bool inside = pixel.x >= 0 && pixel.y >= 0 && pixel.x < int(frame.column_count) && pixel.y < int(frame.row_count);
    if (!inside) return kNoSlot;
    uint slot = last_slots[uint(pixel.y) * frame.column_count + uint(pixel.x)];
    if (slot == kNoSlot) return kNoSlot;
    slot &= ~kSlotRests;
    return holds_key(slot, key) ? slot : kNoSlot;
}

// The slot of `key` if the previous sample had it where it saw the point of a hit: in that pixel or in its
// three nearest neighbours, because rays go through different points of their pixels in each sample.
uint reproject(Hit hit, uvec2 key) {
    vec3 to_hit = vec3(hit.cell - ao_frame.last_camera_cell) + (hit.fraction - ao_frame.last_camera_fraction);
    float depth = dot(to_hit, ao_frame.last_forward);
    vec2 image = vec2(dot(to_hit, ao_frame.last_right), -dot(to_hit, ao_frame.last_up)) / depth;
    vec2 place = (0.5 * image + 0.5) * vec2(frame.width, frame.height) - vec2(frame.first_column, frame.first_row);
    bool seen = ao_frame.has_last != 0u && depth > 0.0 && place.x > -1.0 && place.y > -1.0 &&
                place.x < float(frame.column_count) + 1.0 && place.y < float(frame.row_count) + 1.0;
    if (!seen) return kNoSlot;
    vec2 corner = floor(place);
    ivec2 nearer = ivec2(place.x - corner.x < 0.5 ? -1 : 1, place.y - corner.y < 0.5 ? -1 : 1);
    uint slot = kNoSlot;
    for (int i = 0; i < 4 && slot == kNoSlot; ++i)
        slot = last_slot(ivec2(corner) + ivec2((i & 1) * nearer.x, (i >> 1) * nearer.y), key);
    return slot;
}

#endif
