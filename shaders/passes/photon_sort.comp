#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Puts each stored photon into its place among those of its bucket.

#include "lib/address.glsl"

#include "lib/invocation.glsl"

#include "lib/photon_frame.glsl"

layout(scalar) readonly buffer PhotonHeads {
    PhotonHead head;
};
layout(scalar) readonly buffer StoredPhotons {
    StoredPhoton stored[];
};
layout(scalar) readonly buffer BucketStarts {
    uint bucket_starts[];
};
layout(scalar) writeonly buffer SortedPlaces {
    uint64_t sorted_places[];
};
layout(scalar) writeonly buffer SortedPowers {
    uint64_t sorted_powers[];
};

void main() {
    uint i = linear_id();
    if (i >= min(head.count, photon.capacity)) return;
    StoredPhoton photon_i = stored[i];
    uint place = bucket_starts[photon_i.bucket] + photon_i.rank;
    sorted_places[2u * place] = pack64(floatBitsToUint(vec2(photon_i.position.x, photon_i.position.y)));
    sorted_places[2u * place + 1u] = pack64(uvec2(floatBitsToUint(photon_i.position.z), photon_i.surface));
    sorted_powers[place] = pack64(photon_i.power);
}
