// Writes the seed corpus of mesh_fuzz into a folder: one small file for each feature of the readers.

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "support/gltf_builder.h"
#include "support/mesh_file_builder.h"

namespace {

using gltf_builder::bytes_of;
using gltf_builder::File;
using gltf_builder::json;

std::string sparse() {
    File file;
    const std::vector<std::uint8_t> places = {0, 1, 2, 3};
    const json block = {{"count", 4},
                        {"indices", {{"bufferView", file.view(bytes_of(places))}, {"componentType", 5121}}},
                        {"values", {{"bufferView", file.view(bytes_of(gltf_builder::kSquare))}}}};
    file.primitive({{"POSITION", file.accessor(-1, 5126, "VEC3", 4, {{"sparse", block}})}}, {{"mode", 5}});
    return file.gltf();
}

std::string nodes() {
    File file = gltf_builder::square();
    file.root["scene"] = 0;
    file.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    file.root["nodes"] = {
        {{"children", {1, 2}}, {"scale", {1, -2, 1}}, {"rotation", {0, 0, 0.6, 0.8}}},
        {{"mesh", 0}, {"skin", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}},
        {{"camera", 0}, {"translation", {0, 0, 9}}}};
    return file.gltf();
}

std::string materials() {
    File file = gltf_builder::textured_square();
    json& material = file.root["materials"][0];
    material["alphaMode"] = "MASK";
    material["alphaCutoff"] = 0.4;
    material["emissiveFactor"] = {1, 1, 0.5};
    material["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
    material["extensions"] = {{"KHR_materials_emissive_strength", {{"emissiveStrength", 3}}},
                              {"KHR_materials_transmission", {{"transmissionFactor", 0.5}}},
                              {"KHR_materials_ior", {{"ior", 1.4}}}};
    json& texture = material["pbrMetallicRoughness"]["baseColorTexture"];
    texture["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.1, 0.2}}, {"rotation", 1}, {"scale", {2, 3}}};
    file.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    file.root["textures"][0]["sampler"] = 0;
    json& attributes = file.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["TEXCOORD_1"] = file.accessor(file.view(bytes_of(std::vector<std::uint8_t>(16, 90)), 4), 5121,
                                             "VEC2", 4, {{"normalized", true}});
    attributes["COLOR_0"] = attributes["TEXCOORD_1"];
    return file.gltf();
}

std::map<std::string, std::string> seeds() {
    using mesh_file_builder::PlyWriting;
    return {
        {"square.gltf", gltf_builder::square().gltf()},
        {"square.glb", gltf_builder::square().glb()},
        {"textured.glb", gltf_builder::textured_square().glb()},
        {"sparse.gltf", sparse()},
        {"nodes.gltf", nodes()},
        {"materials.gltf", materials()},
        {"square.obj",
         "mtllib a.mtl\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 nan\nvt 0 1\nvt 1 1\nusemtl a\n"
         "f 1/1 2/2 3//1\nf -4 -3 \\\n-2 -1\nl 1 2\n"},
        {"concave.obj", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\nf 5 4 3 2 1\n"},
        {"text.stl", mesh_file_builder::stl_text(mesh_file_builder::random_mesh(1))},
        {"binary.stl", mesh_file_builder::stl_binary(mesh_file_builder::random_mesh(2))},
        {"text.ply", mesh_file_builder::ply(mesh_file_builder::random_mesh(1), PlyWriting::text)},
        {"little.ply", mesh_file_builder::ply(mesh_file_builder::random_mesh(2), PlyWriting::little_endian)},
        {"big.ply", mesh_file_builder::ply_points(mesh_file_builder::random_mesh(3), PlyWriting::big_endian)},
        {"colours.las", mesh_file_builder::las(mesh_file_builder::random_mesh(1), 2, 12)},
        {"wide.las", mesh_file_builder::las(mesh_file_builder::random_mesh(2), 7, 14)},
        {"a.mtl",
         "newmtl a\nKd 0.5 0.5 1\nKe 1 1 1\nd 0.5\nNs 9\nNi 1.4\nillum 7\nPm 1\nPr 0.2\n"
         "map_Kd -s 2 2 -o 0.5 0 -clamp on a b.png\nmap_Ke a.png\nmap_d x.png\nTr 0.1\n"},
    };
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: make_mesh_seeds FOLDER\n");
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    for (const auto& [name, text] : seeds()) {
        std::ofstream out(folder / name, std::ios::binary);
        out << text;
        if (!out.flush()) {
            std::fprintf(stderr, "cannot write %s\n", (folder / name).c_str());
            return 1;
        }
    }
    return 0;
}
