// Structs that live in device buffers, with the same layout in C++ and in GLSL (scalar block layout). A test
// compares every offset with the compiled SPIR-V.
#ifndef VX_GPU_TYPES_H
#define VX_GPU_TYPES_H

#include "portable.h"
#include "sphere.h"

VX_BEGIN

// Faces of a cell are numbered -x +x -y +y -z +z. The other values of Hit::face:
VX_CONST(uint, kFaceInside, 6u);        // the ray started inside a solid cell
VX_CONST(uint, kFaceSphere, 7u);        // analytic sphere, from outside
VX_CONST(uint, kFaceSphereInside, 8u);  // the same from inside
VX_CONST(uint, kFaceMiss, 0xFFu);       // nothing was hit

struct Ray {
    ivec3 cell;      // of the origin, local to the world
    vec3 fraction;   // of the origin inside its cell, [0,1]
    vec3 direction;  // unit length unless stated
    float t_max;     // hits at or beyond are misses
};

// First hit of a camera ray. All bits set is a miss, so a cleared buffer is a sky of misses.
struct Hit {
    ivec3 cell;     // solid cell local to the world; for a sphere the cell of the hit point
    uint face;      // low 8 bits
    vec3 fraction;  // hit point inside the cell, [0,1]; exact on the face's axis
    float t;        // distance from the camera in voxels
    uint material;  // index into Materials
    uint sphere;    // index into Spheres when face is kFaceSphere or kFaceSphereInside
};

VX_CONST(uint, kHitWords, 10u);

// Pixels that the film processes together, so that their sums, hits, vectors and floats are whole texels of
// four words. Planes consist of whole groups.
VX_CONST(uint, kGroupPixels, 4u);

// Camera rays start at a beam tile (beam.h): one float for each beam tile of a dispatch tile, row by row.
VX_CONST(uint, kBeamPixels, 8u);  // edge of a beam tile

// Tiles that cover a row or a column of `pixels`.
VX_FN uint beam_count(uint pixels) {
    return (pixels + kBeamPixels - 1u) / kBeamPixels;
}

// How light leaves a surface, as the passes read it: lobe weights of metal and of glass; the rest is diffuse.
// All three lobes are multiplied by the albedo.
struct SurfaceMaterial {
    vec3 albedo;     // linear, [0,1]
    float mirror;    // lobe weight, [0,1]
    vec3 emission;   // radiance; where it is not 0 both lobe weights are
    float glass;     // lobe weight; mirror + glass <= 1
    float ior;       // of the glass
    float alpha;     // of microfacets, bsdf.h; 0: a mirror, and clear glass
    uint metal_row;  // of gains, where alpha is not 0
    uint glass_row;  // likewise, from outside; the next one is from inside
};
VX_CONST(uint, kMaterialTexels, 3u);

// An emitter: an emitting sphere, or a face of an emitting voxel (light.h packs `what`).
struct LightRecord {
    ivec3 cell;  // of a face: its voxel, local to the world
    uint what;
};

// Analytic sphere; its anchor is local to the world.
struct SphereRecord {
    Sphere shape;
    uint material;
};

VX_CONST(uint, kNoSphere, 0xFFFFFFFFu);

// A node of the hierarchy over spheres, or one of these spheres, as sphere_tree.h packs them.
struct SphereNode {
    uvec4 texels[4];
};

// What all passes of one tile of one sample share. A tile is a run of rows of the crop window.
struct FrameParams {
    ivec3 chunks;        // of the world, per axis
    ivec3 world_origin;  // scene cell of the world's cell 0
    ivec3 camera_cell;   // local to the world; orthographic: where camera_pixel counts from
    vec3 camera_fraction;
    // Perspective: half the image plane's width and height at distance 1. Orthographic: camera_block pixels
    // to the right and upwards. Panoramas: unit.
    vec3 camera_right;
    vec3 camera_up;
    vec3 camera_forward;  // unit
    float camera_angle;   // fisheye: from the centre of the image to its upper edge, radians
    uint camera_block;    // orthographic: pixels, >= 1
    uvec2 camera_pixel;   // orthographic: pixels from the camera's cell to the image's upper left corner
    float lens_radius;    // thin lens: of the aperture, voxels
    float lens_power;     // thin lens: 1 / distance of the plane of focus along the view axis, 1 / voxels
    uint lens_blades;     // thin lens: corners of the aperture; below 3, it is a disc
    uint width;           // of the whole image, pixels
    uint height;
    uint first_row;  // of the tile, image row
    uint row_count;
    uint first_column;  // of the crop window, image column
    uint column_count;
    uint film_tile_first_row;  // of the film tile that the tile is in, image row
    uint first_element;  // of the tile's planes, index of its first pixel: groups are those of the film tile
    uint sample_index;
    uint seed;
    float ao_radius;  // voxels
    vec3 sky_radiance;
    float sky_turn;          // of an image of the sky, counter-clockwise seen from above, full turns
    vec3 sun_direction;      // unit, towards the sun
    vec3 sun_irradiance;     // on a surface facing the sun
    float sun_cone_height;   // cone_height of the sun's angular radius
    uint ground_material;    // its index; undefined without a ground
    float ground_luminance;  // of the ground where no light is blocked
    uint light_count;
    float light_power;  // of all emitters: sum of light selection weight times etendue
    // Photons of one sample: first of the emitters, then of the sun, from a disc that covers all it reaches.
    uint emitter_photons;
    uint sun_photons;
    vec3 sun_disc_centre;   // local to the world
    float sun_disc_radius;  // voxels
};

// Where a photon starts and what it carries.
struct PhotonStart {
    ivec3 cell;  // of the origin, local to the world
    vec3 fraction;
    vec3 direction;
    uint sphere;  // on which it starts, or all bits set
    vec3 power;
    uint noise;  // state of its NoiseStream
};

// Its size in 64-bit words, by which shaders read and write it.
VX_CONST(uint, kStartWords, 7u);

#ifdef __cplusplus
static_assert(sizeof(Hit) == 4 * kHitWords && sizeof(SurfaceMaterial) == 16 * kMaterialTexels);
static_assert(sizeof(PhotonStart) == 8 * kStartWords);
#endif

// A ray of a path, which starts on a surface or in a medium.
struct PathRay {
    ivec3 cell;  // of the origin, as in Ray; inside glass the glass voxel
    vec3 fraction;
    vec3 direction;
    uint own;     // the sphere on which it starts, or kNoSphere
    uint medium;  // material of the glass voxels that it is in, or kNoMedium
};

// Where the path of a visible point starts. A direction of zero means no path.
struct PathStart {
    ivec3 cell;   // of the origin, as in Ray
    uint stream;  // sample stream of its pixel
    vec3 fraction;
    uint own;  // the sphere on which it starts, or kNoSphere
    vec3 direction;
    uint medium;    // material of the glass voxel that the visible point is in, or kNoMedium
    vec3 normal;    // unit, on the side that was hit, where needed; at a rough surface three random numbers
    uint is_rough;  // 1: there (two for its direction, one for its lobe), and the ray leads there
};
VX_CONST(uint, kPathStartTexels, 4u);

// A path between two of its rays, from which path_trace continues in the next round (lib/path_walk.glsl:
// Walk).
struct PathState {
    PathRay ray;
    uint kind;
    uint stream;
    vec3 throughput;
    float scale;
    float pdf;
    float image_share;
    vec3 light;
    uint surfaces;
    uint vertices;
    uint flags;    // 1: is_straight, 2: off a rough surface
    uint next_id;  // next pixel of the tile for this invocation; 0 before the first round
};

// Push constants of path_trace.
struct PathPush {
    uint lanes;    // invocations
    uint is_last;  // 1 in the last round of a sample: unfinished paths are lost
};

// What the passes of the ambient occlusion hash share in addition to FrameParams: one sample of one frame.
struct AoParams {
    ivec3 last_camera_cell;  // of the previous sample, for reprojection
    vec3 last_camera_fraction;
    vec3 last_right;       // half the image plane's width at distance 1, divided by its squared length
    vec3 last_up;          // half its height, likewise
    vec3 last_forward;     // unit
    uint has_last;         // 0: there is no previous sample, and the table is emptied
    uint frame;            // number of the frame, which may wrap
    uint pass_number;      // samples taken since the table was empty, which may wrap
    uint table_mask;       // slots of the table minus one
    uint max_age;          // frames for which a cell may stay unseen
    uint sample_limit;     // cells with this many samples take no more; 0: no limit
    float cell_width;      // wanted width of a cell in voxels at distance 1, perspective rays
    float parallel_width;  // for parallel rays, at any distance
};

// Head of the list of pixels whose occlusion cells have to be searched: the workgroups of the search, as an
// indirect dispatch reads them, and the number of pixels that follow.
struct AoMissed {
    uint groups_x;
    uint groups_y;
    uint groups_z;
    uint count;
};

// Push constants of ao_filter.
struct AoFilterPush {
    int step;  // pixels between the taps
};

// Push constants of world_grow.
struct WorldGrowPush {
    uint count;    // cells of the level
    ivec3 chunks;  // of the world, per axis
    uint axis;
    int bound;  // longest distance of this round
};

// Push constants of film_add: pixels of the tile, numbered in its film tile.
struct FilmAddPush {
    uint first_pixel;
    uint pixel_count;
};

// What a march of bench.march found.
struct BenchHit {
    ivec3 cell;  // solid cell local to the world; undefined on a miss
    uint face;   // 0..5, kFaceInside or kFaceMiss
    float t;     // from the start of the ray
    uint steps;
};

// Push constants of bench_march.
struct BenchMarchPush {
    uint count;    // rays
    ivec3 chunks;  // of the world, per axis
    uvec2 beams;   // of the picture, per axis
};

VX_END

#endif
