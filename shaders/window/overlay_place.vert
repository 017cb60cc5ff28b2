#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Triangles of the user interface, in pixels of the window.

#include "shared/window.h"

struct OverlayVertex {
    vec2 position;
    vec2 texel;
    uint rgba;
};
layout(scalar, set = 0, binding = 1) readonly buffer Vertices {
    OverlayVertex vertices[];
};
layout(scalar, set = 0, binding = 2) readonly buffer Indices {
    uint indices[];
};
layout(push_constant, scalar) uniform Push {
    WindowPush push;
};
layout(location = 0) out vec2 texel;
layout(location = 1) out vec4 colour;

void main() {
    OverlayVertex vertex = vertices[indices[gl_VertexIndex]];
    texel = vertex.texel;
    colour = unpackUnorm4x8(vertex.rgba);
    gl_Position = vec4(2.0 * vertex.position / push.window - 1.0, 0.0, 1.0);
}
