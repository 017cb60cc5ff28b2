#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

namespace voxilux {

// A MagicaVoxel .vox file as plain data, lossless for the chunks we know. Format: ephtracy/voxel-model,
// "MagicaVoxel-file-format-vox.txt" and "...-vox-extension.txt", with what newer files add (versions 150 and
// 200).

// MagicaVoxel's own bound: a voxel's coordinate is one byte, so a longer side could not be filled.
inline constexpr int kVoxMaxSide = 256;
// Frames, models and children: bounded by the file's size. Instances: a few hundred bytes of shared groups
// can name 10^7 of them. 2^18 is far above any scene that MagicaVoxel can edit, and takes 10 MiB as
// VoxInstance.
inline constexpr std::uint64_t kVoxMaxInstances = std::uint64_t{1} << 18;
// Steps of the walk over the graph: a group reached on many paths is walked once for each of them.
inline constexpr std::uint64_t kVoxMaxVisits = std::uint64_t{1} << 22;
// Voxels, on each axis, of a key frame's translation and of a whole chain of them. Keeps cell arithmetic in
// 32 bits.
inline constexpr std::int64_t kVoxMaxTranslation = std::int64_t{1} << 28;
// A hostile file can cause a warning for every few bytes; warnings beyond this are counted.
inline constexpr std::size_t kVoxMaxWarnings = 64;

// Attributes in file order. A key that repeats: the last one counts.
using VoxDict = std::vector<std::pair<std::string, std::string>>;

// The value of `key`, or nullptr.
[[nodiscard]] const std::string* find_value(const VoxDict& dict, std::string_view key);

struct VoxVoxel {
    std::uint8_t x = 0;
    std::uint8_t y = 0;
    std::uint8_t z = 0;
    std::uint8_t index = 0;  // palette index, 0 is empty

    bool operator==(const VoxVoxel&) const = default;
};

struct VoxModel {
    glm::ivec3 size{0};            // each side in [1, kVoxMaxSide]
    std::vector<VoxVoxel> voxels;  // as stored: see filled_voxels() for what they mean
    // What is odd about them, as count_oddities() says.
    std::uint32_t out_of_size = 0;  // entries outside `size`
    std::uint32_t duplicates = 0;   // entries whose cell an earlier entry has named
    std::uint32_t index0 = 0;       // entries of the empty index

    bool operator==(const VoxModel&) const = default;
};

struct VoxTransform {  // nTRN
    std::int32_t id = 0;
    VoxDict attributes;  // _name, _hidden, _loop
    std::int32_t child = -1;
    std::int32_t reserved = -1;
    std::int32_t layer = -1;
    std::vector<VoxDict> frames;  // _f, _r, _t

    bool operator==(const VoxTransform&) const = default;
};

struct VoxGroup {  // nGRP
    std::int32_t id = 0;
    VoxDict attributes;
    std::vector<std::int32_t> children;

    bool operator==(const VoxGroup&) const = default;
};

struct VoxShapeModel {
    std::int32_t model = 0;
    VoxDict attributes;  // _f

    bool operator==(const VoxShapeModel&) const = default;
};

struct VoxShape {  // nSHP
    std::int32_t id = 0;
    VoxDict attributes;  // _loop
    std::vector<VoxShapeModel> models;

    bool operator==(const VoxShape&) const = default;
};

using VoxNode = std::variant<VoxTransform, VoxGroup, VoxShape>;

struct VoxLayer {  // LAYR
    std::int32_t id = 0;
    VoxDict attributes;  // _name, _hidden, _color
    std::int32_t reserved = -1;

    bool operator==(const VoxLayer&) const = default;
};

struct VoxRecord {  // MATL (the id is the palette index), rCAM
    std::int32_t id = 0;
    VoxDict attributes;

    bool operator==(const VoxRecord&) const = default;
};

struct VoxOldMaterial {  // MATT, the materials of files before 0.99
    std::int32_t id = 0;
    std::int32_t type = 0;  // 0 diffuse, 1 metal, 2 glass, 3 emissive
    float weight = 1.0f;    // finite
    std::uint32_t present =
        0;  // bits 0-6: which of plastic, roughness, specular, ior, attenuation, power, glow follow
    std::vector<float> values;  // one for each of these bits, or fewer; finite

    bool operator==(const VoxOldMaterial&) const = default;
};

struct VoxUnknownChunk {
    std::array<char, 4> id{};
    std::vector<std::byte> content;
    std::vector<std::byte> children;

    bool operator==(const VoxUnknownChunk&) const = default;
};

struct VoxColour {
    std::uint8_t r = 0;
    std::uint8_t g = 0;
    std::uint8_t b = 0;
    std::uint8_t a = 0;

    bool operator==(const VoxColour&) const = default;
};

using VoxPalette = std::array<VoxColour, 256>;

// The palette of a file without one, by the published rule: a 6x6x6 cube without its black corner, then ramps
// of red, green, blue and grey. In the order of an RGBA chunk: entry i is the colour of index i + 1, entry
// 255 is unused.
[[nodiscard]] VoxPalette default_vox_palette();

struct VoxFile {
    std::int32_t version = 150;
    std::optional<std::uint32_t> pack;  // PACK: the models are frames of an old animation
    std::vector<VoxModel> models;
    std::vector<VoxNode> nodes;  // no two with one id, no cycle below node 0
    std::vector<VoxLayer> layers;
    VoxPalette palette = default_vox_palette();  // entry i is the colour of index i + 1
    bool has_palette = false;                    // from an RGBA chunk
    std::optional<std::array<std::uint8_t, 256>>
        imap;                          // order of the palette on the editor's screen; colours ignore it
    std::vector<VoxRecord> materials;  // MATL
    std::vector<VoxOldMaterial> old_materials;      // MATT
    std::vector<VoxRecord> cameras;                 // rCAM
    std::vector<VoxDict> objects;                   // rOBJ
    std::optional<std::vector<std::string>> notes;  // NOTE: names of the palette's rows
    std::optional<VoxDict> meta;                    // META: range of the animation
    std::vector<VoxUnknownChunk> unknown;           // kept, so that writing the file again loses nothing
    std::vector<std::string> warnings;  // what was repaired or ignored, at most kVoxMaxWarnings + 1

    bool operator==(const VoxFile&) const = default;
};

// The colour of a voxel's index (1..255).
[[nodiscard]] VoxColour colour_of(const VoxFile& file, std::uint8_t index);

}  // namespace voxilux
