// The meshes of the shared data: what each holds, and how each wrong one is refused.

#include <gtest/gtest.h>

#include "base/error.h"
#include "support/shared_data.h"
#include "voxelizer/load_mesh.h"

namespace voxilux {
namespace {

struct Known {
    const char* file;
    std::size_t triangles, materials, warnings;
    glm::dvec3 extent;
};

// Triangles and extents, from an independent reader in Python.
const Known kMeshes[] = {
    {"AlphaBlendModeTest.glb", 61, 6, 0, {8.60000038, 2.39953339, 1.30000001}},
    {"BoxInterleaved.glb", 12, 1, 0, {1, 1, 1}},
    {"BoxVertexColors.glb", 12, 1, 0, {1, 1, 1}},
    {"CubeImageUriSpaces/CubeImageUriSpaces.gltf", 12, 1, 0, {1, 1, 1}},
    {"Duck.glb", 4212, 1, 0, {1.65478397, 1.54040628, 1.15253393}},
    {"FlightHelmet/FlightHelmet.gltf", 94722, 6, 0, {0.366583347, 0.716021862, 0.371574953}},
    {"Mesh_PrimitiveMode_04/Mesh_PrimitiveMode_04.gltf", 2, 1, 0, {1, 1, 0}},
    {"Mesh_PrimitiveMode_12/Mesh_PrimitiveMode_12.gltf", 2, 1, 0, {1, 1, 0}},
    {"Sponza_LowPoly/Sponza_LowPoly.gltf", 63084, 1, 0, {29.7668334, 12.4470747, 18.3058661}},
    {"TextureTransformTest/TextureTransformTest.gltf", 24, 9, 0, {3.2, 2.19126749, 0.01}},
    {"balloon/scene.gltf", 35698, 37, 0, {0.579828978, 0.694710016, 0.577764034}},
    {"box_sparse/box_sparse.gltf", 12, 1, 1, {1, 1, 1}},
    {"cornell-box.glb", 1040, 5, 0, {2.26322532, 2, 2.06563517}},
    {"cube-vertexcol.obj", 12, 1, 4, {2, 2, 2}},
    {"stanford-bunny.obj", 69451, 1, 0, {0.155699, 0.154334, 0.120674}},
    {"subpass_scene_transparent/subpass_scene_transparent.gltf",
     208,
     1,
     0,
     {16.0968981, 9.68218303, 16.0968969}},
};

TEST(MeshExternal, every_mesh_has_the_triangles_and_the_size_of_an_independent_reader) {
    SKIP_WITHOUT_SHARED_DATA();
    for (const Known& known : kMeshes) {
        const Mesh mesh = load_mesh(shared_data() / "data/meshes" / known.file);
        EXPECT_EQ(mesh.triangles.size(), known.triangles) << known.file;
        EXPECT_EQ(mesh.materials.size(), known.materials) << known.file;
        EXPECT_EQ(mesh.warnings.size(), known.warnings) << known.file;
        glm::dvec3 low(1e300), high(-1e300);
        for (const MeshTriangle& triangle : mesh.triangles) {
            for (int c = 0; c < 3; ++c) {
                low = glm::min(low, mesh.positions[triangle.vertices[c]]);
                high = glm::max(high, mesh.positions[triangle.vertices[c]]);
            }
        }
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR((high - low)[axis], known.extent[axis], 1e-6 * glm::length(known.extent))
                << known.file;
    }
}

struct Refused {
    const char* file;
    const char* words;
};

const Refused kRefused[] = {
    {"malformed/gltf/BoxTextured.gltf", "needs "},
    {"malformed/gltf/IndexOutOfRange/IndexOutOfRange.gltf", "names vertex 255 of 24"},
    {"malformed/gltf/NoScene.gltf", "no triangles"},
    {"malformed/gltf/RecursiveNodes.gltf", "nodes[0] is reached twice"},
    {"malformed/gltf/badArray.gltf", "meshes[0].primitives is not an array"},
    {"malformed/gltf/badUint.gltf", "baseColorTexture.index is not a whole number"},
    {"malformed/gltf/chunk_too_big.glb", "the GLB header says"},
    {"malformed/gltf/integer-out-of-bounds.gltf", "bufferViews[0].byteLength is not a whole number"},
    {"malformed/gltf/invalid-buffer-index.gltf", "bufferViews[1].buffer names buffers[1]"},
    {"malformed/gltf/invalid_json_chunk.glb", "not valid JSON at byte 2"},
    {"malformed/gltf/invalid_version.glb", "GLB version 0 is not 2"},
    {"malformed/gltf/issue-492.glb", "no triangles"},
    {"malformed/gltf/length_mismatch.glb", "the GLB header says 49 bytes, but there are 48"},
    {"malformed/gltf/no_header.glb", "not valid JSON"},
    {"malformed/gltf/truncated_chunk_data.glb", "the GLB header says 48 bytes, but there are 47"},
    {"malformed/obj/invalid-relative-vertex-index.obj", "line 1: a face names line -4 of 0"},
    {"malformed/obj/malformed.obj", "line 23: a face names line 12 of 8"},
    {"unsupported/BoxTextured.gltf", "glTF '1.0' is not read"},
    {"unsupported/BoxDraco/BoxDraco.gltf", "KHR_draco_mesh_compression, which is not read"},
    {"unsupported/BoxMeshopt/BoxMeshopt.gltf", "'EXT_meshopt_compression', which is not read"},
};

TEST(MeshExternal, every_wrong_mesh_is_refused_with_its_reason) {
    SKIP_WITHOUT_SHARED_DATA();
    for (const Refused& refused : kRefused) {
        try {
            (void)load_mesh(shared_data() / "data" / refused.file);
            ADD_FAILURE() << refused.file << " is read";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::input_refused);
            EXPECT_NE(std::string(error.what()).find(refused.words), std::string::npos) << error.what();
        }
    }
}

TEST(MeshExternal, strict_loading_refuses_what_was_left_out) {
    SKIP_WITHOUT_SHARED_DATA();
    EXPECT_THROW(
        (void)load_mesh(shared_data() / "data/meshes/box_sparse/box_sparse.gltf", {.is_strict = true}),
        Error);
    EXPECT_NO_THROW((void)load_mesh(shared_data() / "data/meshes/Duck.glb", {.is_strict = true}));
}

}  // namespace
}  // namespace voxilux
