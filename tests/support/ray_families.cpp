#include "support/ray_families.h"

#include <fmt/format.h>

#include <functional>
#include <limits>

namespace voxilux::test {
namespace {

class Dice {
  public:
    explicit Dice(std::uint32_t seed) : engine_(seed) {}
    float unit() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
    int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint32_t>(n)); }
    float sign() { return below(2) == 0 ? -1.0f : 1.0f; }

    glm::vec3 direction() {
        for (;;) {
            const glm::vec3 v(2.0f * unit() - 1.0f, 2.0f * unit() - 1.0f, 2.0f * unit() - 1.0f);
            const float square = glm::dot(v, v);
            if (square > 0.01f && square < 1.0f) return v / std::sqrt(square);
        }
    }
    glm::ivec3 cell(glm::ivec3 size) { return {below(size.x), below(size.y), below(size.z)}; }
    glm::vec3 fraction() { return {unit(), unit(), unit()}; }
    glm::vec3 corner() {
        return {static_cast<float>(below(2)), static_cast<float>(below(2)), static_cast<float>(below(2))};
    }

  private:
    std::mt19937 engine_;
};

glm::vec3 small_integers(Dice& dice) {
    for (;;) {
        const glm::vec3 d(static_cast<float>(dice.below(5) - 2), static_cast<float>(dice.below(5) - 2),
                          static_cast<float>(dice.below(5) - 2));
        if (d != glm::vec3(0.0f)) return d;
    }
}

glm::vec3 axial(Dice& dice, float other) {
    glm::vec3 d(other * dice.sign(), other * dice.sign(), other * dice.sign());
    d[dice.below(3)] = dice.sign();
    return d;
}

using Draw = std::function<gpu::Ray(Dice&)>;

RayFamily draw_family(const std::string& name, int count, Dice& dice, const Draw& draw) {
    RayFamily family{name, {}};
    for (int i = 0; i < count; ++i)
        family.rays.push_back(draw(dice));
    return family;
}

}  // namespace

std::vector<RayFamily> ray_families(glm::ivec3 size, int count, std::uint32_t seed) {
    Dice dice(seed);
    const auto ray = [size](Dice& d, glm::vec3 fraction, glm::vec3 direction) {
        return gpu::Ray{d.cell(size), fraction, direction, gpu::kUnbounded};
    };
    const float denormal = std::numeric_limits<float>::denorm_min();
    return {
        draw_family("random", count, dice, [&](Dice& d) { return ray(d, d.fraction(), d.direction()); }),
        draw_family("axial", count, dice, [&](Dice& d) { return ray(d, d.fraction(), axial(d, 0.0f)); }),
        draw_family("axial_on_lattice", count, dice,
                    [&](Dice& d) { return ray(d, d.corner(), axial(d, 0.0f)); }),
        draw_family("corners", count, dice, [&](Dice& d) { return ray(d, d.corner(), small_integers(d)); }),
        draw_family("diagonal_from_centre", count, dice,
                    [&](Dice& d) { return ray(d, glm::vec3(0.5f), small_integers(d)); }),
        draw_family("corner_to_random", count, dice,
                    [&](Dice& d) { return ray(d, d.corner(), d.direction()); }),
        draw_family("near_axial", count, dice,
                    [&](Dice& d) { return ray(d, d.fraction(), axial(d, 1e-7f)); }),
        draw_family("denormal", count, dice, [&](Dice& d) { return ray(d, d.corner(), axial(d, denormal)); }),
        draw_family("short", count, dice,
                    [&](Dice& d) {
                        gpu::Ray r = ray(d, d.fraction(), d.direction());
                        r.t_max = 8.0f * d.unit();
                        return r;
                    }),
    };
}

namespace {

VoxelWorld fill(glm::ivec3 chunks, const std::function<bool(glm::ivec3)>& is_solid) {
    VoxelWorld world(glm::ivec3(0), chunks);
    const glm::ivec3 size = world.size();
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                if (is_solid({x, y, z}))
                    world.set({x, y, z}, static_cast<std::uint16_t>((x + 3 * y + 7 * z) % 255));
            }
        }
    }
    return world;
}

}  // namespace

std::vector<NamedWorld> small_worlds(std::uint32_t seed) {
    Dice dice(seed);
    const glm::ivec3 one(1);
    const glm::ivec3 wide(3, 2, 1);
    std::vector<NamedWorld> worlds;
    worlds.push_back({"empty", fill(wide, [](glm::ivec3) { return false; })});
    worlds.push_back({"full", fill(one, [](glm::ivec3) { return true; })});
    worlds.push_back({"one_voxel", fill(wide, [](glm::ivec3 c) { return c == glm::ivec3(20, 17, 5); })});
    worlds.push_back({"checkerboard", fill(one, [](glm::ivec3 c) { return (c.x + c.y + c.z) % 2 == 0; })});
    worlds.push_back({"diagonal_wall", fill({2, 2, 1}, [](glm::ivec3 c) { return c.x + c.y == 31; })});
    worlds.push_back({"corner_wall", fill({2, 2, 2}, [](glm::ivec3 c) { return c.x + c.y + c.z == 40; })});
    worlds.push_back({"shell", fill({2, 2, 2}, [](glm::ivec3 c) {
                          const auto edge = [](int v) { return v == 1 || v == 30; };
                          const auto inside = [](int v) { return v >= 1 && v <= 30; };
                          return (edge(c.x) || edge(c.y) || edge(c.z)) && inside(c.x) && inside(c.y) &&
                                 inside(c.z);
                      })});
    worlds.push_back({"rod", fill({1, 1, 4}, [](glm::ivec3 c) { return c.x == 8 && c.y == 8; })});
    for (const float density : {0.001f, 0.02f, 0.3f, 0.9f})
        worlds.push_back({fmt::format("random_{}", density),
                          fill(wide, [&](glm::ivec3) { return dice.unit() < density; })});
    return worlds;
}

}  // namespace voxilux::test
