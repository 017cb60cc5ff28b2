#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "base/error.h"
#include "formats/scene_toml.h"

namespace voxilux {
namespace {

// The message that refuses `text`, or "accepted".
std::string refusal(std::string_view text, const LoadOptions& options = {}) {
    try {
        (void)parse_scene(text, "s.toml", options);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused) << error.what();
        return error.what();
    }
    return "accepted";
}

struct RefusedText {
    const char* name;
    const char* text;
    const char* message;
};

void PrintTo(const RefusedText& refused, std::ostream* os) {
    *os << refused.name;
}

std::string name_of(const testing::TestParamInfo<RefusedText>& test) {
    return test.param.name;
}

class SceneTomlRefusal : public testing::TestWithParam<RefusedText> {};

TEST_P(SceneTomlRefusal, bad_text_gives_its_line) {
    EXPECT_EQ(refusal(GetParam().text), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    settings, SceneTomlRefusal,
    testing::Values(
        RefusedText{"key_near", "[sun]\nazimuth = 3\n  elevaton = 4\n",
                    "s.toml:3:3: unknown key 'elevaton' in [sun]; did you mean 'elevation'?"},
        RefusedText{"key_far", "[sun]\nzzzzzzzz = 1\n",
                    "s.toml:2:1: unknown key 'zzzzzzzz' in [sun]; known: 'azimuth', 'elevation', "
                    "'angular_diameter', 'irradiance', 'on'"},
        RefusedText{"technique_near", "[technique]\nao = \"hsh\"\n",
                    "s.toml:2:6: 'ao' in [technique] must be one of 'auto', 'brute', 'hash', not 'hsh'"},
        RefusedText{"technique_of_near", "[technique]\nindirct = \"none\"\n",
                    "s.toml:2:1: unknown key 'indirct' in [technique]; did you mean 'indirect'?"},
        RefusedText{"techniques_of_unlike_photons",
                    "[technique]\ncaustics = \"photons\"\nindirect = \"splatting\"\n",
                    "s.toml:2:12: 'caustics' in [technique] excludes another technique of photons: caustics "
                    "and indirect share them"},
        RefusedText{"section_near", "\n[rendr]\nspp = 1\n",
                    "s.toml:2:2: unknown key 'rendr' in the scene; did you mean 'render'?"},
        RefusedText{"syntax", "[sun\n",
                    "s.toml:1:5: Error while parsing table header: expected ']', saw '\\n'"},
        RefusedText{"section_is_value", "sun = 3\n", "s.toml:1:7: 'sun' must be a section [sun]"},
        RefusedText{"section_is_list", "[[sun]]\non = true\n", "s.toml:1:1: 'sun' must be a section [sun]"},
        RefusedText{"number_is_text", "[sun]\nelevation = \"high\"\n",
                    "s.toml:2:13: 'elevation' in [sun] must be a number in [-90, 90], not the text \"high\""},
        RefusedText{"number_is_nan", "[sun]\nelevation = nan\n",
                    "s.toml:2:13: 'elevation' in [sun] must be a number in [-90, 90], not nan"},
        RefusedText{"number_is_inf", "[sun]\nazimuth = -inf\n",
                    "s.toml:2:11: 'azimuth' in [sun] must be a number in [-3600, 3600], not -inf"},
        RefusedText{"elevation_high", "[sun]\nelevation = 90.5\n",
                    "s.toml:2:13: 'elevation' in [sun] must be a number in [-90, 90], not 90.5"},
        RefusedText{"disc_too_wide", "[sun]\nangular_diameter = 180\n",
                    "s.toml:2:20: 'angular_diameter' in [sun] must be a number in [0, 180), not 180"},
        RefusedText{
            "irradiance_negative", "[sun]\nirradiance = [1, -1, 1]\n",
            "s.toml:2:18: 'irradiance' in [sun] must be [x, y, z] with numbers in [0, 1000000], not -1"},
        RefusedText{
            "irradiance_short", "[sun]\nirradiance = [1, 1]\n",
            "s.toml:2:14: 'irradiance' in [sun] must be [x, y, z] with numbers in [0, 1000000], not a "
            "list of 2"},
        RefusedText{"on_is_number", "[sun]\non = 1\n",
                    "s.toml:2:6: 'on' in [sun] must be true or false, not 1"},
        RefusedText{"sky_twice", "[sky]\nradiance = [1,1,1]\ncolor = \"#ffffff\"\n",
                    "s.toml:3:9: 'color' in [sky] excludes 'radiance'"},
        RefusedText{"colour_word", "[sky]\ncolor = \"blue\"\n",
                    "s.toml:2:9: 'color' in [sky] must be \"#rrggbb\" (sRGB), not \"blue\""},
        RefusedText{"colour_sign", "[sky]\ncolor = \"#-12345\"\n",
                    "s.toml:2:9: 'color' in [sky] must be \"#rrggbb\" (sRGB), not \"#-12345\""},
        RefusedText{"size_zero", "[render]\nsize = [0, 4]\n",
                    "s.toml:2:9: 'size' in [render] must be two whole numbers in [1, 65535], not 0"},
        RefusedText{"size_fraction", "[render]\nsize = [1.5, 4]\n",
                    "s.toml:2:9: 'size' in [render] must be two whole numbers in [1, 65535], not 1.5"},
        RefusedText{"spp_zero", "[render]\nspp = 0\n",
                    "s.toml:2:7: 'spp' in [render] must be a whole number in [1, 4294967295], not 0"},
        RefusedText{
            "seed_huge", "[render]\nseed = 4294967296\n",
            "s.toml:2:8: 'seed' in [render] must be a whole number in [0, 4294967295], not 4294967296"},
        RefusedText{"ao_radius_zero", "[render]\nao_radius = 0\n",
                    "s.toml:2:13: 'ao_radius' in [render] must be a number in (0, 65536], not 0"},
        RefusedText{
            "sequence", "[render]\nsequence = \"sobel\"\n",
            "s.toml:2:12: 'sequence' in [render] must be one of 'sobol', 'halton', 'white', not 'sobel'"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    photons, SceneTomlRefusal,
    testing::Values(
        RefusedText{"count_negative", "[photons]\ncount = -1\n",
                    "s.toml:2:9: 'count' in [photons] must be a whole number in [0, 16777216], not -1"},
        RefusedText{"count_huge", "[photons]\ncount = 16777217\n",
                    "s.toml:2:9: 'count' in [photons] must be a whole number in [0, 16777216], not 16777217"},
        RefusedText{"radius_zero", "[photons]\nradius = 0\n",
                    "s.toml:2:10: 'radius' in [photons] must be a number in (0, 65536], not 0"},
        RefusedText{"alpha_zero", "[photons]\nalpha = 0\n",
                    "s.toml:2:9: 'alpha' in [photons] must be a number in (0, 1], not 0"},
        RefusedText{"alpha_high", "[photons]\nalpha = 1.5\n",
                    "s.toml:2:9: 'alpha' in [photons] must be a number in (0, 1], not 1.5"},
        RefusedText{"depth_zero", "[photons]\ndepth = 0\n",
                    "s.toml:2:9: 'depth' in [photons] must be a whole number in [1, 4096], not 0"},
        RefusedText{"scatter_is_number", "[photons]\nscatter = 1\n",
                    "s.toml:2:11: 'scatter' in [photons] must be true or false, not 1"},
        RefusedText{
            "key", "[photons]\nphotons = 1\n",
            "s.toml:2:1: unknown key 'photons' in [photons]; known: 'count', 'radius', 'alpha', 'scatter', "
            "'classic', 'roulette', 'depth', 'aim', 'caustics', 'indirect'"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    camera, SceneTomlRefusal,
    testing::Values(
        RefusedText{"fov_zero", "[camera]\nfov = 0\n",
                    "s.toml:2:7: 'fov' in [camera] must be a number in (0, 360], not 0"},
        RefusedText{
            "fov_180", "[camera]\nfov = 180.0\n",
            "s.toml:2:7: 'fov' in [camera] must be below 180 unless the projection is fisheye, not 180"},
        RefusedText{
            "fov_too_narrow",
            "[camera]\nfov = 1e-300\n[[sphere]]\ncenter=[0,0,0]\nradius=1\nmaterial=\"m\"\n"
            "[material.m]\n",
            "s.toml:2:7: 'fov' in [camera] is so narrow that the whole scene fits only from beyond 2^30 "
            "voxels "
            "away"},
        RefusedText{"looks_at_itself", "[camera]\nposition = [1, 2, 3]\nlook_at = [1.0, 2, 3]\n",
                    "s.toml:3:11: 'look_at' in [camera] must differ from 'position'"},
        RefusedText{"position_alone", "[camera]\nposition = [1, 2, 3]\n",
                    "s.toml:1:1: [camera] with 'position' needs 'look_at', or 'yaw' and 'pitch'"},
        RefusedText{"direction_alone", "[camera]\nyaw = 3\n",
                    "s.toml:1:1: [camera] needs 'position' or 'preset'"},
        RefusedText{"two_directions", "[camera]\nposition = [1, 2, 3]\nlook_at = [1, 2, 4]\nyaw = 3\n",
                    "s.toml:3:11: 'look_at' in [camera] excludes 'yaw' and 'pitch': give one or the other"},
        RefusedText{"preset_and_position", "[camera]\nposition = [1, 2, 3]\npreset = \"top\"\n",
                    "s.toml:3:10: 'preset' in [camera] excludes 'position', 'look_at', 'yaw' and 'pitch'"},
        RefusedText{
            "preset_unknown", "[camera]\npreset = \"botom\"\n",
            "s.toml:2:10: 'preset' in [camera] must be one of 'three_quarter', 'front', 'back', 'left', "
            "'right', "
            "'top', 'bottom', 'iso', not 'botom'"},
        RefusedText{"scale_of_perspective", "[camera]\nprojection = \"perspective\"\npixels_per_voxel = 4\n",
                    "s.toml:3:20: 'pixels_per_voxel' in [camera] needs projection = \"orthographic\""},
        RefusedText{"scale_missing",
                    "[camera]\nprojection = \"orthographic\"\nposition = [1, 2, 3]\nlook_at = [1, 2, 4]\n",
                    "s.toml:1:1: [camera] with 'position' and projection = \"orthographic\" needs "
                    "'pixels_per_voxel'"},
        RefusedText{"scale_zero", "[camera]\npixels_per_voxel = 0\n",
                    "s.toml:2:20: 'pixels_per_voxel' in [camera] must be a number in (0, 4096], not 0"},
        RefusedText{"focus_twice", "[camera]\nfocus = 3\nfocus_at = [1, 2, 3]\n",
                    "s.toml:3:12: 'focus_at' in [camera] excludes 'focus': give one or the other"},
        RefusedText{"focus_on_the_lens", "[camera]\naperture = 1\nfocus = 0\n",
                    "s.toml:3:9: 'focus' in [camera] must be a number in (0, 1073741824], not 0"},
        RefusedText{"panorama_is_no_flat_image", "[camera]\nprojection = \"equirectangular\"\nfov = 200\n",
                    "s.toml:3:7: 'fov' in [camera] must be below 180 unless the projection is fisheye, not "
                    "200"},
        RefusedText{"pitch_beyond_zenith", "[camera]\nposition = [0, 0, 0]\nyaw = 0\npitch = 90.01\n",
                    "s.toml:4:9: 'pitch' in [camera] must be a number in [-90, 90], not 90.01"},
        RefusedText{"position_far", "[camera]\nposition = [2e9, 0, 0]\nyaw = 0\npitch = 0\n",
                    "s.toml:2:13: 'position' in [camera] must be [x, y, z] with numbers in [-1073741824, "
                    "1073741824], not "
                    "2000000000"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    objects, SceneTomlRefusal,
    testing::Values(
        RefusedText{"material_key", "[material.a]\nrougness = 1\n",
                    "s.toml:2:1: unknown key 'rougness' in [material.a]; did you mean 'roughness'?"},
        RefusedText{"material_value", "[material]\na = 1\n",
                    "s.toml:2:5: 'a' in [material] must be a section [material.a]"},
        RefusedText{"material_air", "[material.air]\n",
                    "s.toml:1:1: [material.air] has the name of what carves: choose another name"},
        RefusedText{
            "albedo_high", "[material.a]\nalbedo = [0.5, 1.5, 0.5]\n",
            "s.toml:2:16: 'albedo' in [material.a] must be [x, y, z] with numbers in [0, 1], not 1.5"},
        RefusedText{
            "albedo_nan", "[material.a]\nalbedo = [0.5, nan, 0.5]\n",
            "s.toml:2:16: 'albedo' in [material.a] must be [x, y, z] with numbers in [0, 1], not nan"},
        RefusedText{"ior_zero", "[material.a]\nior = 0\n",
                    "s.toml:2:7: 'ior' in [material.a] must be a number in [1, 4], not 0"},
        RefusedText{"ior_negative", "[material.a]\nior = -1.5\n",
                    "s.toml:2:7: 'ior' in [material.a] must be a number in [1, 4], not -1.5"},
        RefusedText{"ior_nan", "[material.a]\nior = nan\n",
                    "s.toml:2:7: 'ior' in [material.a] must be a number in [1, 4], not nan"},
        RefusedText{"ior_infinite", "[material.a]\nior = inf\n",
                    "s.toml:2:7: 'ior' in [material.a] must be a number in [1, 4], not inf"},
        RefusedText{"ior_huge", "[material.a]\nior = 1e9\n",
                    "s.toml:2:7: 'ior' in [material.a] must be a number in [1, 4], not 1000000000"},
        RefusedText{
            "emission_nan", "[material.a]\nemission = [0, nan, 0]\n",
            "s.toml:2:16: 'emission' in [material.a] must be [x, y, z] with numbers in [0, 1000000], not "
            "nan"},
        RefusedText{
            "emission_negative", "[material.a]\nemission = [-1, 0, 0]\n",
            "s.toml:2:13: 'emission' in [material.a] must be [x, y, z] with numbers in [0, 1000000], not -1"},
        RefusedText{"emit_dark", "[material.a]\nsurface = \"emit\"\n",
                    "s.toml:2:11: 'surface' in [material.a] is \"emit\", which needs 'emission' above zero"},
        RefusedText{
            "surface_unknown", "[material.a]\nsurface = \"mirror\"\n",
            "s.toml:2:11: 'surface' in [material.a] must be one of 'diffuse', 'metal', 'glass', 'emit', not "
            "'mirror'"},
        RefusedText{"sphere_single_brackets", "[sphere]\nradius = 1\n",
                    "s.toml:1:1: 'sphere' must be sections [[sphere]] in double brackets"},
        RefusedText{"sphere_radius_missing", "[[sphere]]\ncenter = [0, 0, 0]\n",
                    "s.toml:1:1: [[sphere]] needs 'radius'"},
        RefusedText{"sphere_radius_zero", "[[sphere]]\ncenter = [0, 0, 0]\nradius = 0.0\n",
                    "s.toml:3:10: 'radius' in [[sphere]] must be a number in (0, 536870912], not 0"},
        RefusedText{
            "sphere_material",
            "[material.grass]\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = "
            "\"gras\"\n",
            "s.toml:5:12: 'material' in [[sphere]] names the unknown material 'gras'; did you mean 'grass'?"},
        RefusedText{"model_file_missing", "[[model]]\nfile = \"gone.vox\"\n",
                    "s.toml:2:8: 'file' in [[model]] cannot be used: gone.vox: cannot open: No such file or "
                    "directory"},
        RefusedText{"model_key_missing", "[[model]]\nframe = 1\n", "s.toml:1:1: [[model]] needs 'file'"},
        RefusedText{"model_rotate", "[[model]]\nfile = \"a.vox\"\nrotate = [\"x90\", \"w90\"]\n",
                    "s.toml:3:10: 'rotate' in [[model]] must be of \"x90\", \"x180\", \"x270\", \"y90\", ... "
                    "\"z270\", not "
                    "\"w90\""},
        RefusedText{"model_rotate_number", "[[model]]\nfile = \"a.vox\"\nrotate = [\"x90\", 90]\n",
                    "s.toml:3:18: 'rotate' in [[model]] must be a text in quotes or a list of them, not 90"},
        RefusedText{"model_rotate_empty", "[[model]]\nfile = \"a.vox\"\nrotate = \"\"\n",
                    "s.toml:3:10: 'rotate' in [[model]] must be of \"x90\", \"x180\", \"x270\", \"y90\", ... "
                    "\"z270\", not "
                    "\"\""},
        RefusedText{"model_mirror", "[[model]]\nfile = \"a.vox\"\nmirror = \"w\"\n",
                    "s.toml:3:10: 'mirror' in [[model]] must be of \"x\", \"y\", \"z\", not \"w\""},
        RefusedText{
            "model_translate", "[[model]]\nfile = \"a.vox\"\ntranslate = [0.5, 0, 0]\n",
            "s.toml:3:14: 'translate' in [[model]] must be [x, y, z] with whole numbers in [-268435456, "
            "268435456], not 0.5"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    shapes, SceneTomlRefusal,
    testing::Values(
        RefusedText{"kind_missing", "[[shape]]\nmaterial = \"air\"\n", "s.toml:1:1: [[shape]] needs 'shape'"},
        RefusedText{
            "kind_unknown", "[[shape]]\nshape = \"cube\"\n",
            "s.toml:2:9: 'shape' in [[shape]] must be one of 'box', 'ball', 'terrain', 'tree', not 'cube'"},
        RefusedText{
            "key_of_other_kind",
            "[[shape]]\nshape = \"box\"\nfrom = [0,0,0]\nto = [1,1,1]\nradius = 3\nmaterial = \"air\"\n",
            "s.toml:5:1: unknown key 'radius' in [[shape]] \"box\"; known: 'shape', 'from', 'to', "
            "'material', "
            "'hollow'"},
        RefusedText{
            "box_empty", "[[shape]]\nshape = \"box\"\nfrom = [0,0,0]\nto = [1,0,1]\nmaterial = \"air\"\n",
            "s.toml:4:6: 'to' in [[shape]] \"box\" must be above 'from' on every axis: the cell 'to' is "
            "the first "
            "outside"},
        RefusedText{
            "too_many_cells",
            "[[shape]]\nshape = \"box\"\nfrom = [0,0,0]\nto = [1024,1024,257]\nmaterial = \"air\"\n",
            "s.toml:1:1: [[shape]] brings the shapes of this scene to 269484032 cells; the limit is 2^28 = "
            "268435456"},
        RefusedText{
            "ball_beyond_grid",
            "[[shape]]\nshape = \"ball\"\ncenter = [8388600, 0, 0]\nradius = 20\nmaterial = \"air\"\n",
            "s.toml:1:1: [[shape]] reaches 8388620 voxels from the origin; the limit is 8388608"},
        RefusedText{"layers_empty",
                    "[[shape]]\nshape = \"terrain\"\nfrom = [0,0,0]\nto = [4,4,4]\nlayers = []\n",
                    "s.toml:5:10: 'layers' in [[shape]] \"terrain\" must name at least one material"},
        RefusedText{"layers_unknown",
                    "[[shape]]\nshape = \"terrain\"\nfrom = [0,0,0]\nto = [4,4,4]\nlayers = [\"rock\"]\n",
                    "s.toml:5:10: 'layers' in [[shape]] \"terrain\" names the unknown material 'rock'"},
        RefusedText{
            "tree_without_ground",
            "[material.a]\n[[shape]]\nshape = \"tree\"\nbase = [0, 0]\ntrunk = \"a\"\nleaves = \"a\"\n",
            "s.toml:4:8: 'base' in [[shape]] \"tree\" has no ground: no earlier shape fills this column; "
            "give "
            "[x, y, z]"}),
    name_of);

TEST(SceneTomlRefused, limit_of_cells_is_exact) {
    const std::string box = "[[shape]]\nshape = \"box\"\nfrom = [0,0,0]\nmaterial = \"air\"\nto = ";
    EXPECT_EQ(refusal(box + "[1024,1024,256]\n"), "accepted");
    EXPECT_NE(refusal(box + "[1024,1024,256]\n" + box + "[1,1,1]\n"), "accepted");
}

TEST(SceneTomlRefused, errors_name_the_option) {
    const auto message = [](const std::string& option) {
        return refusal(
            "[sun]\nelevation = 80\n[[sphere]]\ncenter = [0,0,0]\nradius = 1\nmaterial = \"a\"\n"
            "[material.a]\n",
            {.overrides = {option}});
    };
    EXPECT_EQ(message("sun.elevation=95"),
              "-D sun.elevation=95: 'elevation' in [sun] must be a number in [-90, 90], not 95");
    EXPECT_EQ(message("sun.elevaton=5"),
              "-D sun.elevaton=5: unknown key 'elevaton' in [sun]; did you mean 'elevation'?");
    EXPECT_EQ(message("sun.elevation=1o"),
              "-D sun.elevation=1o: 'elevation' in [sun] must be a number in [-90, 90], not the text \"1o\"");
    EXPECT_EQ(message("sun=3"), "-D sun=3: 'sun' must be a section [sun]");
    EXPECT_EQ(message("elevation"), "-D elevation: must be key=value, for example sun.elevation=10");
    EXPECT_EQ(message("=3"), "-D =3: must be key=value, for example sun.elevation=10");
    EXPECT_EQ(message("sphere.1.radius=3"),
              "-D sphere.1.radius=3: '1' is no position in a list of 1 (the first is 0)");
    EXPECT_EQ(message("sphere.x.radius=3"),
              "-D sphere.x.radius=3: 'x' is no position in a list of 1 (the first is 0)");
    EXPECT_EQ(message("sun.elevation=15"), "accepted");
}

TEST(SceneTomlRefused, deep_nesting_is_refused) {
    const std::string deep = "a = " + std::string(100000, '[');
    EXPECT_NE(refusal(deep), "accepted");
    EXPECT_EQ(refusal(deep).find('\n'), std::string::npos);
}

TEST(SceneTomlRefused, unknown_extension_is_refused) {
    try {
        (void)load_scene("scene.ply");
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        EXPECT_STREQ(error.what(), "scene.ply: unknown kind of scene; give a .vox or a .toml file");
    }
}

}  // namespace
}  // namespace voxilux
