#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "scene/ao_settings.h"
#include "scene/box.h"
#include "scene/path_settings.h"
#include "scene/photon_settings.h"
#include "scene/sky_settings.h"
#include "scene/vox_file.h"

namespace voxilux {

// Scene space: right handed, z up, one unit is one voxel, and a cell c covers [c, c+1) on each axis. It is
// MagicaVoxel's world space. Colours are linear Rec. 709.

// How light leaves a surface; lobe_weights() says what the passes make of it.
enum class Surface : std::uint8_t { diffuse, metal, glass, emit, blend, media };
// Those that scene files name.
inline constexpr std::array<std::string_view, 4> kSurfaceNames{"diffuse", "metal", "glass", "emit"};

struct Material {
    std::string name;
    glm::vec3 albedo{0.8f};    // [0,1] linear
    glm::vec3 emission{0.0f};  // radiance, W/(m^2 sr) in the units of the sun and the sky; >= 0
    Surface surface = Surface::diffuse;
    float roughness = 1.0f;  // [0,1]
    float ior = 1.5f;        // glass, media: > 1
    float metallic = 0.0f;
    float transmission = 0.0f;

    bool operator==(const Material&) const = default;
};

// Materials of a scene. Voxels on the device hold their numbers in 15 bits, and a ground takes one, too.
inline constexpr std::size_t kMaxMaterials = 32767;

// A filled cell of a model. `material` indexes Scene::materials.
struct Voxel {
    std::uint16_t x = 0;
    std::uint16_t y = 0;
    std::uint16_t z = 0;
    std::uint16_t material = 0;

    bool operator==(const Voxel&) const = default;
};

// Cells of one material.
struct VoxelBox {
    Box cells;
    std::uint16_t material = 0;
};

// Holds each cell at most once, inside `size`: voxels of files, boxes of shapes.
struct VoxelModel {
    std::string name;
    glm::ivec3 size{0};
    std::vector<Voxel> voxels;
    std::vector<VoxelBox> boxes;
};

// A signed permutation of the axes: all 24 rotations and 24 mirrored ones. Component i of the result is
// sign[i] * v[axis[i]].
struct Rotation {
    std::array<std::uint8_t, 3> axis{0, 1, 2};
    std::array<std::int8_t, 3> sign{1, 1, 1};

    bool operator==(const Rotation&) const = default;

    [[nodiscard]] glm::ivec3 apply(glm::ivec3 v) const {
        return {sign[0] * v[axis[0]], sign[1] * v[axis[1]], sign[2] * v[axis[2]]};
    }
    // First `inner`, then this.
    [[nodiscard]] Rotation after(const Rotation& inner) const {
        Rotation both;
        for (std::size_t i = 0; i < 3; ++i) {
            both.axis[i] = inner.axis[axis[i]];
            both.sign[i] = static_cast<std::int8_t>(sign[i] * inner.sign[axis[i]]);
        }
        return both;
    }
};

// A model in the scene. Voxel v of the model fills the scene cell floor(R (v + 1/2 - pivot)) + translation,
// with pivot = floor(size / 2): MagicaVoxel's rule, exact for odd and even sizes and for mirrors (see
// world_cell).
struct Instance {
    std::uint32_t model = 0;
    Rotation rotation;
    glm::ivec3 translation{0};

    bool operator==(const Instance&) const = default;
};

// The scene cell of voxel `v` of a model of `size` under `instance`.
[[nodiscard]] glm::ivec3 world_cell(const Instance& instance, glm::ivec3 size, glm::ivec3 v);
// The scene cells of a box of cells of the model.
[[nodiscard]] Box world_cells(const Instance& instance, glm::ivec3 size, const Box& box);

struct Sphere {
    glm::dvec3 centre{0.0};
    double radius = 1.0;  // > 0
    std::uint32_t material = 0;
};

// Light from one direction. It gives no light when it is switched off, when `irradiance` is zero, or when it
// is not above the horizon (z <= 0; under an atmosphere, that of the planet): see sunlight().
struct Sun {
    float azimuth_deg = 215.0f;              // counter-clockwise from +x, seen from above
    float elevation_deg = 45.0f;             // above the horizon
    float angular_diameter_deg = 0.53f;      // 0 gives hard shadows
    glm::vec3 irradiance{3.0f, 2.8f, 2.5f};  // on a surface that faces the sun; above an atmosphere
    bool on = true;

    [[nodiscard]] glm::vec3 direction() const;  // unit, from the scene towards the sun
};

// What the camera sees where it sees nothing of the scene. The light of the sky does not depend on it.
enum class Backdrop : std::uint8_t { sky, color, transparent };
inline constexpr std::array<std::string_view, 3> kBackdropNames{"sky", "color", "transparent"};

struct Background {
    Backdrop shown = Backdrop::sky;
    glm::vec3 radiance{0.0f};  // of a colour
};

// An infinite plane that faces up. On the device it is the last sphere, one of curvature 0, and its material
// is the last one.
struct Ground {
    bool on = false;
    glm::vec3 albedo{0.3f};
    bool shadow_only = false;      // in front of a background that is not the sky: shows only its shadows
    std::optional<double> height;  // z; that of the scene's lowest voxel or sphere once a scene is loaded

    [[nodiscard]] std::size_t count() const { return on ? 1 : 0; }
};

// How a camera maps directions to pixels, see shaders/shared/projection.h.
enum class Projection : std::uint8_t { perspective, orthographic, equirectangular, fisheye };
inline constexpr std::array<std::string_view, 4> kProjectionNames{"perspective", "orthographic",
                                                                  "equirectangular", "fisheye"};

// Yaw is counter-clockwise from +x seen from above, pitch is up; roll is zero.
struct Camera {
    glm::dvec3 position{0.0};  // orthographic: a point in the plane that rays start from
    double yaw_deg = 0.0;
    double pitch_deg = 0.0;
    double fov_y_deg = 45.0;  // vertical; in (0, 180) for perspective, in (0, 360] for fisheye
    Projection projection = Projection::perspective;
    double pixels_per_voxel = 0.0;  // orthographic: > 0
};

// What a perspective camera sees through. Sharp is the plane at right angles to the view axis at a distance,
// or through a point; behind the camera, it counts as infinitely far away.
struct Lens {
    double aperture = 0.0;        // diameter, voxels; 0: a pinhole
    std::uint32_t blades = 0;     // corners of the aperture; below 3, it is a disc
    std::optional<double> focus;  // voxels
    std::optional<glm::dvec3>
        focus_at;  // the middle of the scene once it is loaded, unless one of both is given
};

enum class Sequence : std::uint8_t { sobol, halton, white };
inline constexpr std::array<std::string_view, 3> kSequenceNames{"sobol", "halton", "white"};  // in that order
[[nodiscard]] constexpr std::string_view name_of(Sequence sequence) {
    return kSequenceNames[static_cast<std::size_t>(sequence)];
}

struct RenderSettings {
    glm::ivec2 size{640, 360};  // pixels
    std::uint32_t spp = 16;     // samples per pixel
    std::uint32_t ao_rays = 1;  // occlusion rays per sample
    float ao_radius = 32.0f;    // voxels
    std::uint32_t seed = 0;
    Sequence sequence = Sequence::sobol;
    bool traces_air = false;  // for the light of an atmosphere, instead of tables
    AoSettings ao;
    PhotonSettings photons;
    PathSettings paths;

    bool operator==(const RenderSettings&) const = default;
};

// A key of the camera's path.
struct CameraKey {
    std::int64_t frame = 0;
    Camera camera;
    std::optional<glm::dvec3> look_at;  // the point that gave the camera its direction
};

// How the camera goes from key to key, see camera_on_path.
enum class CameraPath : std::uint8_t { smooth, linear };
inline constexpr std::array<std::string_view, 2> kCameraPathNames{"smooth", "linear"};

// What a turntable turns. Voxels stay on whole cells, so for a turning model camera and sun go round it the
// other way.
enum class Turned : std::uint8_t { camera, model, light };
inline constexpr std::array<std::string_view, 3> kTurnedNames{"camera", "model", "light"};

// The camera, the model or the sun goes round the vertical line through the middle of the scene's box,
// counter-clockwise seen from above; the others stay. Frame 1 shows the angle `start_deg`, and frame `frames`
// + 1 equals frame 1.
struct Turntable {
    std::int64_t frames = 0;  // of a turn, >= 1
    double degrees = 360.0;   // of a turn; negative goes clockwise
    double start_deg = 0.0;
    Turned turned = Turned::camera;
};

// An animated .vox file in the scene.
struct AnimatedVox {
    VoxFile graph;                      // nodes, layers and the sizes of its models: no voxels, no materials
    std::vector<std::uint32_t> models;  // Scene::models of each of its models, or kNoModel
};
inline constexpr std::uint32_t kNoModel = 0xFFFFFFFF;  // a model without a voxel

// Where an animated file stands, and its part of Scene::instances.
struct VoxPlacement {
    std::size_t file = 0;  // in Animation::files
    Rotation rotation;
    glm::ivec3 translation{0};
    std::size_t first_instance = 0;
    std::size_t instance_count = 0;
};

// What changes from frame to frame. The camera has keys or a turntable, or neither.
struct Animation {
    std::vector<CameraKey> camera_keys;  // none, or at least two with rising frames
    CameraPath camera_path = CameraPath::smooth;
    std::optional<Turntable> turntable;
    std::vector<AnimatedVox> files;
    std::vector<VoxPlacement> placements;  // in the order of Scene::instances

    [[nodiscard]] bool is_still() const { return camera_keys.empty() && !turntable && placements.empty(); }
};

// A camera saved in a file. An orthographic one shows `height` voxels from top to bottom.
struct SavedCamera {
    std::string name;
    Camera camera;
    double height = 0.0;
};

// All that an image depends on, as plain data. An animated scene holds the instances of the frame that it was
// loaded for; scene_at_frame gives the other frames.
struct Scene {
    std::vector<Material> materials;
    std::vector<VoxelModel> models;
    std::vector<Instance> instances;  // the visible ones; where two fill a cell the later wins
    std::vector<Sphere> spheres;
    Sun sun;
    Sky sky;
    Background background;
    Ground ground;
    Lens lens;
    std::optional<Camera> camera;     // absent: camera_of() frames the scene
    double framing_fov_y_deg = 45.0;  // with this, degrees
    RenderSettings settings;
    Animation animation;
    std::vector<SavedCamera> cameras;
    std::optional<float> exposure_ev;   // of PNGs, stops, unless a flag sets another
    std::vector<std::string> warnings;  // what was dropped or repaired while loading, one line each
    std::vector<std::string> notes;     // what a file asks for that is not shown, likewise
};

}  // namespace voxilux
