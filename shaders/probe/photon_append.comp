// Stores photons from a list, like a pass that traces them.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

#include "lib/address.glsl"

#include "lib/invocation.glsl"

#include "lib/photon_store.glsl"
#include "probe/photon_functions.h"

layout(scalar) readonly buffer In {
    PhotonIn inputs[];
};
layout(push_constant, scalar) uniform Push { uint count; } push;

void main() {
    init_photons();
    uint i = linear_id();
    if (i >= push.count) return;
    PhotonIn given = inputs[i];
    if (given.is_stored != 0u) store_photon(given.position, given.surface, given.power);
    close_store();
}
