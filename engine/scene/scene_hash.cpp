#include "scene/scene_hash.h"

#include <bit>
#include <memory>
#include <new>
#include <ranges>
#include <tuple>
#include <type_traits>

#include <xxhash.h>

#include "scene/settings.h"

namespace voxilux {
namespace {

// fields_of(): the members of a struct that an image depends on. Each function names all members first, so
// that a member added later does not compile until somebody has decided.

auto fields_of(const Material& material) {
    const auto& [name, albedo, emission, surface, roughness, ior, metallic, transmission] = material;
    return std::tie(albedo, emission, surface, roughness, ior, metallic, transmission);
}

auto fields_of(const VoxelModel& model) {
    const auto& [name, size, voxels, boxes] = model;
    return std::tie(size, voxels, boxes);
}

auto fields_of(const VoxelBox& box) {
    const auto& [cells, material] = box;
    return std::tie(cells.lo, cells.hi, material);
}

auto fields_of(const Rotation& rotation) {
    const auto& [axis, sign] = rotation;
    return std::tie(axis, sign);
}

auto fields_of(const Instance& instance) {
    const auto& [model, rotation, translation] = instance;
    return std::tie(model, rotation, translation);
}

auto fields_of(const Sphere& sphere) {
    const auto& [centre, radius, material] = sphere;
    return std::tie(centre, radius, material);
}

auto fields_of(const Camera& camera) {
    const auto& [position, yaw_deg, pitch_deg, fov_y_deg, projection, pixels_per_voxel] = camera;
    return std::tie(position, yaw_deg, pitch_deg, fov_y_deg, projection, pixels_per_voxel);
}

auto fields_of(const CameraKey& key) {
    const auto& [frame, camera, look_at] = key;
    return std::tie(frame, camera, look_at);
}

auto fields_of(const Turntable& turntable) {
    const auto& [frames, degrees, start_deg, turned] = turntable;
    return std::tie(frames, degrees, start_deg, turned);
}

auto fields_of(const VoxPlacement& placement) {
    const auto& [file, rotation, translation, first_instance, instance_count] = placement;
    return std::tie(file, rotation, translation, first_instance, instance_count);
}

auto fields_of(const AnimatedVox& animated) {
    const auto& [graph, models] = animated;
    return std::tie(graph, models);
}

// Those that a graph has, see graph_of().
auto fields_of(const VoxFile& graph) {
    const auto& [version, pack, models, nodes, layers, palette, has_palette, imap, materials, old_materials,
                 cameras, objects, notes, meta, unknown, warnings] = graph;
    return std::tie(version, pack, models, nodes, layers, meta);
}

auto fields_of(const VoxModel& model) {
    const auto& [size, voxels, out_of_size, duplicates, index0] = model;
    return std::tie(size);
}

auto fields_of(const VoxTransform& node) {
    const auto& [id, attributes, child, reserved, layer, frames] = node;
    return std::tie(id, attributes, child, reserved, layer, frames);
}

auto fields_of(const VoxGroup& node) {
    const auto& [id, attributes, children] = node;
    return std::tie(id, attributes, children);
}

auto fields_of(const VoxShape& node) {
    const auto& [id, attributes, models] = node;
    return std::tie(id, attributes, models);
}

auto fields_of(const VoxShapeModel& model) {
    const auto& [index, attributes] = model;
    return std::tie(index, attributes);
}

auto fields_of(const VoxLayer& layer) {
    const auto& [id, attributes, reserved] = layer;
    return std::tie(id, attributes, reserved);
}

auto fields_of(const Lens& lens) {
    const auto& [aperture, blades, focus, focus_at] = lens;
    return std::tie(aperture, blades, focus, focus_at);
}

auto fields_of(const VoxDict::value_type& attribute) {
    return std::tie(attribute.first, attribute.second);
}

auto fields_of(const Animation& animation) {
    const auto& [camera_keys, camera_path, turntable, files, placements] = animation;
    return std::tie(camera_keys, camera_path, turntable, files, placements);
}

// The other members are hashed as sections, by their settings.
auto fields_of(const Scene& scene) {
    const auto& [materials, models, instances, spheres, sun, sky, background, ground, lens, camera,
                 framing_fov_y_deg, settings, animation, cameras, exposure_ev, warnings, notes] = scene;
    return std::tie(materials, models, instances, spheres, lens, camera, framing_fov_y_deg, animation);
}

class Hasher {
  public:
    Hasher() : state_(XXH3_createState(), &XXH3_freeState) {
        if (!state_) throw std::bad_alloc();
        XXH3_64bits_reset(state_.get());
    }

    // A list starts with its length, so that no two scenes give the same bytes.
    template <class T>
    void add(const T& value) {
        if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
            add_bytes(&value, sizeof(value));
        } else if constexpr (std::ranges::range<T>) {
            add(std::uint64_t{value.size()});
            for (const auto& element : value)
                add(element);
        } else {
            std::apply([&](const auto&... fields) { (add(fields), ...); }, fields_of(value));
        }
    }
    // Scenes have up to 2^28 of them.
    void add(const std::vector<Voxel>& voxels) {
        static_assert(std::has_unique_object_representations_v<Voxel>);
        add(std::uint64_t{voxels.size()});
        add_bytes(voxels.data(), voxels.size() * sizeof(Voxel));
    }
    template <glm::length_t N, class T>
    void add(const glm::vec<N, T>& value) {
        for (glm::length_t i = 0; i < N; ++i)
            add(value[i]);
    }
    template <class T>
    void add(const std::optional<T>& value) {
        add(value.has_value());
        if (value) add(*value);
    }
    template <class... T>
    void add(const std::variant<T...>& value) {
        add(std::uint64_t{value.index()});
        std::visit([&](const auto& held) { add(held); }, value);
    }
    void add(const HexColour&) {}  // another way to write what has been added
    void add(const SkyImage& image) {
        add(image.size);
        add_bytes(image.texels.data(), image.texels.size() * sizeof(glm::vec3));
    }

    [[nodiscard]] std::uint64_t digest() const { return XXH3_64bits_digest(state_.get()); }

  private:
    void add_bytes(const void* bytes, std::size_t count) {
        static_assert(std::endian::native == std::endian::little, "the hash is of little-endian bytes");
        XXH3_64bits_update(state_.get(), bytes, count);
    }

    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

std::uint64_t hash_with(const Scene& scene, std::uint32_t spp) {
    Hasher hasher;
    hasher.add(scene);
    hasher.add(scene.sky.image);
    visit_sections(scene, [&](std::string_view, auto settings) {
        if constexpr (std::is_same_v<decltype(settings), RenderSettings>) settings.spp = spp;
        visit_settings(settings, [&]<class T>(const Setting&, const T& value) {
            // The name of a file does not matter: what is in it has been added.
            if constexpr (!std::is_same_v<T, std::string>) hasher.add(value);
        });
    });
    return hasher.digest();
}

}  // namespace

std::uint64_t scene_hash(const Scene& scene) {
    return hash_with(scene, scene.settings.spp);
}

// No scene has 0 samples, so that this is the hash of no other scene.
std::uint64_t sample_hash(const Scene& scene) {
    return hash_with(scene, 0);
}

}  // namespace voxilux
