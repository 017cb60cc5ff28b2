#include "formats/scene_hash.h"

#include <array>
#include <bit>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

#include <xxhash.h>

#include "base/assert.h"
#include "formats/vox_write.h"

namespace voxilux {
namespace {

// Collects bytes in blocks and feeds them to XXH3, so that a large scene needs no second copy in memory.
class Hasher {
  public:
    Hasher() : state_(XXH3_createState(), &XXH3_freeState) {
        if (!state_) throw std::bad_alloc();
        XXH3_64bits_reset(state_.get());
        block_.reserve(kBlockBytes + sizeof(std::uint64_t));
    }

    template <class T>
    void add(T value) {
        if constexpr (std::is_enum_v<T>) {
            add(static_cast<std::underlying_type_t<T>>(value));
        } else if constexpr (std::is_same_v<T, float>) {
            add(std::bit_cast<std::uint32_t>(value));
        } else if constexpr (std::is_same_v<T, double>) {
            add(std::bit_cast<std::uint64_t>(value));
        } else {
            static_assert(std::is_integral_v<T>);
            const auto bits = static_cast<std::uint64_t>(value);
            for (std::size_t i = 0; i < sizeof(T); ++i)
                block_.push_back(static_cast<unsigned char>(bits >> (8 * i)));
            if (block_.size() >= kBlockBytes) flush();
        }
    }

    template <glm::length_t N, class T>
    void add(const glm::vec<N, T>& v) {
        for (glm::length_t i = 0; i < N; ++i)
            add(v[i]);
    }

    void add_voxels(std::span<const Voxel> voxels) {
        // A voxel in memory is its serialisation where the machine is little-endian; scenes have up to 2^28
        // of them.
        static_assert(std::has_unique_object_representations_v<Voxel> && sizeof(Voxel) == 8);
        if constexpr (std::endian::native == std::endian::little) {
            flush();
            XXH3_64bits_update(state_.get(), voxels.data(), voxels.size_bytes());
        } else {
            for (const Voxel& voxel : voxels)
                add(glm::u16vec4(voxel.x, voxel.y, voxel.z, voxel.material));
        }
    }

    [[nodiscard]] std::uint64_t digest() {
        flush();
        return XXH3_64bits_digest(state_.get());
    }

  private:
    static constexpr std::size_t kBlockBytes = 1 << 16;

    void flush() {
        XXH3_64bits_update(state_.get(), block_.data(), block_.size());
        block_.clear();
    }

    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
    std::vector<unsigned char> block_;
};

// Each list starts with its length, so that no two scenes give the same bytes.
void add_materials(Hasher& hasher, const std::vector<Material>& materials) {
    hasher.add(std::uint64_t{materials.size()});
    for (const Material& material : materials) {
        hasher.add(material.albedo);
        hasher.add(material.emission);
        hasher.add(material.surface);
        hasher.add(material.roughness);
        hasher.add(material.ior);
        hasher.add(material.metallic);
        hasher.add(material.transmission);
    }
}

void add_models(Hasher& hasher, const std::vector<VoxelModel>& models) {
    hasher.add(std::uint64_t{models.size()});
    for (const VoxelModel& model : models) {
        hasher.add(model.size);
        hasher.add(std::uint64_t{model.voxels.size()});
        hasher.add_voxels(model.voxels);
    }
}

void add_rotation(Hasher& hasher, const Rotation& rotation) {
    for (const std::uint8_t axis : rotation.axis)
        hasher.add(axis);
    for (const std::int8_t sign : rotation.sign)
        hasher.add(sign);
}

void add_instances(Hasher& hasher, const std::vector<Instance>& instances) {
    hasher.add(std::uint64_t{instances.size()});
    for (const Instance& instance : instances) {
        hasher.add(instance.model);
        add_rotation(hasher, instance.rotation);
        hasher.add(instance.translation);
    }
}

void add_spheres(Hasher& hasher, const std::vector<Sphere>& spheres) {
    hasher.add(std::uint64_t{spheres.size()});
    for (const Sphere& sphere : spheres) {
        hasher.add(sphere.centre);
        hasher.add(sphere.radius);
        hasher.add(sphere.material);
    }
}

void add_light(Hasher& hasher, const Sun& sun, const Sky& sky) {
    hasher.add(sun.azimuth_deg);
    hasher.add(sun.elevation_deg);
    hasher.add(sun.angular_diameter_deg);
    hasher.add(sun.irradiance);
    hasher.add(sun.on);
    hasher.add(sky.radiance);
}

void add_ao(Hasher& hasher, const AoSettings& ao) {
    hasher.add(ao.method);
    hasher.add(ao.cell_px);
    hasher.add(ao.reproject.has_value());
    hasher.add(ao.reproject.value_or(false));
    hasher.add(ao.merged.has_value());
    hasher.add(ao.merged.value_or(false));
    hasher.add(ao.checkerboard);
    hasher.add(ao.by_pixel);
    hasher.add(ao.filter);
    hasher.add(ao.sample_limit);
    hasher.add(ao.slots);
}

void add_photons(Hasher& hasher, const PhotonSettings& photons) {
    hasher.add(photons.count);
    hasher.add(photons.radius.has_value());
    hasher.add(photons.radius.value_or(0.0));
    hasher.add(photons.alpha);
    hasher.add(photons.scatter);
    hasher.add(photons.classic);
    hasher.add(photons.roulette);
    hasher.add(photons.depth);
    hasher.add(photons.caustics);
    hasher.add(photons.indirect);
}

void add_camera(Hasher& hasher, const Camera& camera) {
    hasher.add(camera.position);
    hasher.add(camera.yaw_deg);
    hasher.add(camera.pitch_deg);
    hasher.add(camera.fov_y_deg);
}

void add_view(Hasher& hasher, const std::optional<Camera>& camera, const RenderSettings& settings,
              std::uint32_t spp) {
    hasher.add(camera.has_value());
    add_camera(hasher, camera.value_or(Camera{}));
    hasher.add(settings.size);
    hasher.add(spp);
    hasher.add(settings.ao_rays);
    hasher.add(settings.ao_radius);
    hasher.add(settings.seed);
    hasher.add(settings.sequence);
    add_ao(hasher, settings.ao);
    add_photons(hasher, settings.photons);
}

void add_camera_motion(Hasher& hasher, const Animation& animation) {
    hasher.add(std::uint64_t{animation.camera_keys.size()});
    hasher.add(animation.camera_path);
    for (const CameraKey& key : animation.camera_keys) {
        hasher.add(key.frame);
        add_camera(hasher, key.camera);
        hasher.add(key.look_at.has_value());
        hasher.add(key.look_at.value_or(glm::dvec3(0.0)));
    }
    const Turntable turntable = animation.turntable.value_or(Turntable{});
    hasher.add(turntable.frames);  // 0 when there is none
    hasher.add(turntable.degrees);
    hasher.add(turntable.start_deg);
}

void add_animated_files(Hasher& hasher, const Animation& animation) {
    hasher.add(std::uint64_t{animation.files.size()});
    for (const AnimatedVox& file : animation.files) {
        const std::vector<std::byte> graph = write_vox(file.graph);
        hasher.add(std::uint64_t{graph.size()});
        for (const std::byte byte : graph)
            hasher.add(std::to_integer<std::uint8_t>(byte));
        hasher.add(std::uint64_t{file.models.size()});
        for (const std::uint32_t model : file.models)
            hasher.add(model);
    }
}

void add_placements(Hasher& hasher, const std::vector<VoxPlacement>& placements) {
    hasher.add(std::uint64_t{placements.size()});
    for (const VoxPlacement& placement : placements) {
        hasher.add(std::uint64_t{placement.file});
        add_rotation(hasher, placement.rotation);
        hasher.add(placement.translation);
        hasher.add(std::uint64_t{placement.first_instance});
        hasher.add(std::uint64_t{placement.instance_count});
    }
}

std::uint64_t hash_with(const Scene& scene, std::uint32_t spp) {
    Hasher hasher;
    add_materials(hasher, scene.materials);
    add_models(hasher, scene.models);
    add_instances(hasher, scene.instances);
    add_spheres(hasher, scene.spheres);
    add_light(hasher, scene.sun, scene.sky);
    add_view(hasher, scene.camera, scene.settings, spp);
    if (!scene.animation.is_still()) {
        add_camera_motion(hasher, scene.animation);
        add_animated_files(hasher, scene.animation);
        add_placements(hasher, scene.animation.placements);
    }
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
