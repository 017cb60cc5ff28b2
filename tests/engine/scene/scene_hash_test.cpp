// The hash covers everything that a picture depends on, field by field.

#include "scene/scene_hash.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "scene/settings.h"

namespace voxilux {
namespace {

// Something of every kind.
Scene full_scene() {
    Scene scene;
    scene.materials = {{.name = "plain"}};
    scene.models = {{.size = {4, 5, 6}, .voxels = {{1, 2, 3, 0}}}};
    scene.instances = {{.model = 0, .translation = {10, 20, 30}}};
    scene.spheres = {{.centre = {1, 2, 3}, .radius = 2.0, .material = 0}};
    scene.camera = Camera{};
    scene.animation.camera_keys = {{.frame = 1, .look_at = glm::dvec3(1.0)}, {.frame = 2}};
    scene.animation.turntable = Turntable{.frames = 8};
    VoxFile graph{.pack = 2, .models = {{.size = {1, 2, 3}}}, .meta = VoxDict{{"_anim_range", "0 3"}}};
    graph.nodes = {VoxTransform{.id = 0, .attributes = {{"_loop", "1"}}, .frames = {{{"_t", "1 2 3"}}}},
                   VoxGroup{.id = 1, .attributes = {{"a", "b"}}, .children = {2}},
                   VoxShape{.id = 2, .models = {{.model = 0, .attributes = {{"_f", "1"}}}}}};
    graph.layers = {{.id = 3, .attributes = {{"_hidden", "0"}}}};
    scene.animation.files = {{.graph = graph, .models = {0}}};
    scene.animation.placements = {{}};
    return scene;
}

using Change = std::function<void(Scene&)>;

// The changes whose hash equals that of another scene.
std::vector<std::size_t> unnoticed(const std::vector<Change>& changes,
                                   const std::function<std::uint64_t(const Scene&)>& hash) {
    std::set<std::uint64_t> hashes{hash(full_scene())};
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < changes.size(); ++i) {
        Scene scene = full_scene();
        changes[i](scene);
        if (!hashes.insert(hash(scene)).second) result.push_back(i);
    }
    return result;
}

template <class T>
void change(T& value) {
    if constexpr (std::is_enum_v<T>)
        value = static_cast<T>(static_cast<int>(value) + 1);
    else if constexpr (std::is_same_v<T, bool>)
        value = !value;
    else
        value += T(1);
}
void change(std::string& name) {
    name += "x";
}
template <class T>
void change(std::optional<T>& value) {
    value = T{};
}
template <glm::length_t N, class T>
void change(glm::vec<N, T>& value) {
    value[N - 1] += T(1);
}
void change(HexColour& colour) {
    colour.linear.x += 1.0f;
}

// A change for each row of the sections.
std::vector<Change> row_changes(std::vector<std::string>& names) {
    std::vector<Change> changes;
    Scene scene = full_scene();
    visit_sections(scene, [&](std::string_view section, auto& settings) {
        visit_settings(settings, [&]<class T>(const Setting& row, T&&) {
            if constexpr (std::is_same_v<std::remove_cvref_t<T>, std::string>) return;  // the name of a file
            names.push_back(std::string(section) + "." + std::string(row.name));
            changes.push_back([name = names.back()](Scene& to_change) {
                visit_sections(to_change, [&](std::string_view in, auto& its) {
                    visit_settings(its, [&](const Setting& one, auto&& value) {
                        if (std::string(in) + "." + std::string(one.name) == name) change(value);
                    });
                });
            });
        });
    });
    return changes;
}

TEST(SceneHashRows, every_row_changes_the_hash) {
    std::vector<std::string> names;
    const std::vector<Change> changes = row_changes(names);
    EXPECT_EQ(std::set(names.begin(), names.end()).size(), names.size());
    EXPECT_GT(names.size(), 28u);
    for (const std::size_t i : unnoticed(changes, scene_hash))
        ADD_FAILURE() << names[i];
    EXPECT_EQ(unnoticed(changes,
                        [](const Scene& scene) {
                            Scene forgetful = scene;
                            forgetful.settings.photons.classic = false;
                            return scene_hash(forgetful);
                        })
                  .size(),
              1u)
        << "a hash that forgets a field is found out";
}

TEST(SceneHashRows, samples_do_not_matter_to_the_hash_of_samples) {
    std::vector<std::string> names;
    const std::vector<Change> changes = row_changes(names);
    const std::vector<std::size_t> same = unnoticed(changes, sample_hash);
    ASSERT_EQ(same.size(), 1u);
    EXPECT_EQ(names[same[0]], "render.spp");
}

TEST(SceneHash, texels_of_a_sky_matter_and_the_name_of_their_file_does_not) {
    const std::vector<Change> changes = {
        [](Scene& s) {
            s.sky.image = {{1, 1}, {glm::vec3(1.0f)}};
        },
        [](Scene& s) {
            s.sky.image = {{1, 1}, {glm::vec3(1.0f, 1.0f, 2.0f)}};
        },
        [](Scene& s) {
            s.sky.image = {{2, 1}, {glm::vec3(1.0f), glm::vec3(1.0f)}};
        },
        [](Scene& s) {
            s.sky.image = {{1, 2}, {glm::vec3(1.0f), glm::vec3(1.0f)}};
        },
    };
    EXPECT_EQ(unnoticed(changes, scene_hash), std::vector<std::size_t>());
    EXPECT_EQ(unnoticed({[](Scene& s) { s.sky.image_file = "a.exr"; }}, scene_hash).size(), 1u);
}

AnimatedVox& file_of(Scene& scene) {
    return scene.animation.files[0];
}
template <class Node>
Node& node_of(Scene& scene, std::size_t index) {
    return std::get<Node>(file_of(scene).graph.nodes[index]);
}

TEST(SceneHash, everything_that_moves_changes_the_hash) {
    const std::vector<Change> changes = {
        [](Scene& s) { s.animation.camera_keys[1].frame = 3; },
        [](Scene& s) { s.animation.camera_keys[1].camera.position.z = 1.0; },
        [](Scene& s) { s.animation.camera_keys[1].camera.yaw_deg = 1.0; },
        [](Scene& s) { s.animation.camera_keys[1].camera.pitch_deg = 1.0; },
        [](Scene& s) { s.animation.camera_keys[1].camera.fov_y_deg = 1.0; },
        [](Scene& s) { s.animation.camera_keys[1].look_at = glm::dvec3(0.0); },
        [](Scene& s) { s.animation.camera_keys[0].look_at->y = 2.0; },
        [](Scene& s) { s.animation.camera_keys[0].look_at.reset(); },
        [](Scene& s) { s.animation.camera_keys.pop_back(); },
        [](Scene& s) { s.animation.camera_path = CameraPath::linear; },
        [](Scene& s) { s.animation.turntable->frames = 9; },
        [](Scene& s) { s.animation.turntable->degrees = 90.0; },
        [](Scene& s) { s.animation.turntable->start_deg = 90.0; },
        [](Scene& s) { s.animation.turntable.reset(); },
        [](Scene& s) { file_of(s).models[0] = 1; },
        [](Scene& s) { file_of(s).models.push_back(0); },
        [](Scene& s) { file_of(s).graph.pack = 3; },
        [](Scene& s) { file_of(s).graph.models[0].size.z = 4; },
        [](Scene& s) { file_of(s).graph.meta->at(0).second = "0 4"; },
        [](Scene& s) { file_of(s).graph.layers[0].id = 4; },
        [](Scene& s) { file_of(s).graph.layers[0].attributes[0].second = "1"; },
        [](Scene& s) { node_of<VoxTransform>(s, 0).id = 7; },
        [](Scene& s) { node_of<VoxTransform>(s, 0).attributes[0].second = "0"; },
        [](Scene& s) { node_of<VoxTransform>(s, 0).child = 1; },
        [](Scene& s) { node_of<VoxTransform>(s, 0).layer = 3; },
        [](Scene& s) { node_of<VoxTransform>(s, 0).frames[0][0].second = "1 2 4"; },
        [](Scene& s) { node_of<VoxTransform>(s, 0).frames[0][0].first = "_r"; },
        [](Scene& s) { node_of<VoxGroup>(s, 1).id = 7; },
        [](Scene& s) { node_of<VoxGroup>(s, 1).attributes.clear(); },
        [](Scene& s) { node_of<VoxGroup>(s, 1).children[0] = 0; },
        [](Scene& s) { node_of<VoxShape>(s, 2).id = 7; },
        [](Scene& s) { node_of<VoxShape>(s, 2).models[0].model = 1; },
        [](Scene& s) { node_of<VoxShape>(s, 2).models[0].attributes[0].second = "2"; },
        [](Scene& s) { s.animation.placements[0].file = 1; },
        [](Scene& s) { s.animation.placements[0].rotation.sign[1] = -1; },
        [](Scene& s) { s.animation.placements[0].translation.y = 1; },
        [](Scene& s) { s.animation.placements[0].first_instance = 1; },
        [](Scene& s) { s.animation.placements[0].instance_count = 1; },
    };
    EXPECT_EQ(unnoticed(changes, scene_hash), std::vector<std::size_t>());
    EXPECT_EQ(unnoticed(changes, [](const Scene&) { return std::uint64_t{1}; }).size(), changes.size());
}

// An element that moves from one list to the next must not give the same bytes.
TEST(SceneHash, lists_do_not_run_together) {
    Scene one = full_scene();
    Scene other = full_scene();
    one.animation.files[0].graph.nodes = {VoxGroup{.children = {1, 2}}, VoxGroup{.children = {}}};
    other.animation.files[0].graph.nodes = {VoxGroup{.children = {1}}, VoxGroup{.children = {2}}};
    EXPECT_NE(scene_hash(one), scene_hash(other));
}

}  // namespace
}  // namespace voxilux
