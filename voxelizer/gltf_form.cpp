#include "voxelizer/gltf_form.h"

#include <fmt/format.h>

#include <span>

#include "voxelizer/gltf_json.h"

namespace voxilux {
namespace {

using nlohmann::json;

enum class Kind {
    whole,    // 0 to 2^53
    integer,  // what an int holds, from 0
    integers,
    number,
    numbers,  // Field::size of them
    flag,
    text,
    object,   // of Field::fields
    objects,  // a list of them
    mark,     // only its presence matters
};

struct Field {
    const char* key;
    Kind kind;
    std::span<const Field> fields = {};
    std::size_t size = 0;
    bool is_required = false;
};

constexpr Field required(Field field) {
    field.is_required = true;
    return field;
}

// Source of all lists: glTF 2.0 specification, section 5, and the extensions of the same names.
constexpr Field kTransform[] = {{"offset", Kind::numbers, {}, 2},
                                {"scale", Kind::numbers, {}, 2},
                                {"rotation", Kind::number},
                                {"texCoord", Kind::integer}};
constexpr Field kTextureInfoExtensions[] = {{"KHR_texture_transform", Kind::object, kTransform}};
constexpr Field kTextureInfo[] = {required({"index", Kind::integer}),
                                  {"texCoord", Kind::integer},
                                  {"extensions", Kind::object, kTextureInfoExtensions}};
constexpr Field kMetallicRoughness[] = {{"baseColorFactor", Kind::numbers, {}, 4},
                                        {"baseColorTexture", Kind::object, kTextureInfo},
                                        {"metallicFactor", Kind::number},
                                        {"roughnessFactor", Kind::number},
                                        {"metallicRoughnessTexture", Kind::object, kTextureInfo}};
constexpr Field kSpecularGlossiness[] = {{"diffuseFactor", Kind::numbers, {}, 4},
                                         {"diffuseTexture", Kind::object, kTextureInfo},
                                         {"glossinessFactor", Kind::number}};
constexpr Field kEmissiveStrength[] = {{"emissiveStrength", Kind::number}};
constexpr Field kTransmission[] = {{"transmissionFactor", Kind::number}, {"transmissionTexture", Kind::mark}};
constexpr Field kIor[] = {{"ior", Kind::number}};
constexpr Field kMaterialExtensions[] = {
    {"KHR_materials_pbrSpecularGlossiness", Kind::object, kSpecularGlossiness},
    {"KHR_materials_emissive_strength", Kind::object, kEmissiveStrength},
    {"KHR_materials_transmission", Kind::object, kTransmission},
    {"KHR_materials_unlit", Kind::object},
    {"KHR_materials_ior", Kind::object, kIor}};
constexpr Field kMaterial[] = {{"name", Kind::text},
                               {"pbrMetallicRoughness", Kind::object, kMetallicRoughness},
                               {"emissiveFactor", Kind::numbers, {}, 3},
                               {"emissiveTexture", Kind::object, kTextureInfo},
                               {"alphaMode", Kind::text},
                               {"alphaCutoff", Kind::number},
                               {"extensions", Kind::object, kMaterialExtensions}};
constexpr Field kTexture[] = {{"source", Kind::integer}, {"sampler", Kind::integer}};
constexpr Field kImage[] = {{"name", Kind::text}, {"uri", Kind::text}, {"bufferView", Kind::integer}};
constexpr Field kSampler[] = {
    {"wrapS", Kind::integer}, {"wrapT", Kind::integer}, {"magFilter", Kind::integer}};
constexpr Field kBuffer[] = {required({"byteLength", Kind::whole}), {"uri", Kind::text}};
constexpr Field kBufferView[] = {required({"buffer", Kind::integer}),
                                 {"byteOffset", Kind::whole},
                                 required({"byteLength", Kind::whole}),
                                 {"byteStride", Kind::whole}};
constexpr Field kSparseIndices[] = {required({"bufferView", Kind::integer}),
                                    {"byteOffset", Kind::integer},
                                    required({"componentType", Kind::integer})};
constexpr Field kSparseValues[] = {required({"bufferView", Kind::integer}), {"byteOffset", Kind::integer}};
constexpr Field kSparse[] = {required({"count", Kind::integer}),
                             required({"indices", Kind::object, kSparseIndices}),
                             required({"values", Kind::object, kSparseValues})};
constexpr Field kAccessor[] = {{"bufferView", Kind::integer},
                               {"byteOffset", Kind::whole},
                               required({"componentType", Kind::integer}),
                               {"normalized", Kind::flag},
                               required({"count", Kind::whole}),
                               required({"type", Kind::text}),
                               {"sparse", Kind::object, kSparse}};
constexpr Field kAttributes[] = {{"POSITION", Kind::integer},
                                 {"TEXCOORD_0", Kind::integer},
                                 {"TEXCOORD_1", Kind::integer},
                                 {"COLOR_0", Kind::integer}};
constexpr Field kPrimitiveExtensions[] = {{"KHR_draco_mesh_compression", Kind::object}};
constexpr Field kPrimitive[] = {required({"attributes", Kind::object, kAttributes}),
                                {"indices", Kind::integer},
                                {"material", Kind::integer},
                                {"mode", Kind::integer},
                                {"targets", Kind::mark},
                                {"extensions", Kind::object, kPrimitiveExtensions}};
constexpr Field kMesh[] = {{"primitives", Kind::objects, kPrimitive}};
constexpr Field kPerspective[] = {{"yfov", Kind::number}};
constexpr Field kCamera[] = {{"name", Kind::text}, {"perspective", Kind::object, kPerspective}};
constexpr Field kInstanceAttributes[] = {
    {"TRANSLATION", Kind::integer}, {"ROTATION", Kind::integer}, {"SCALE", Kind::integer}};
constexpr Field kInstancing[] = {{"attributes", Kind::object, kInstanceAttributes}};
constexpr Field kVisibility[] = {{"visible", Kind::flag}};
constexpr Field kNodeExtensions[] = {{"EXT_mesh_gpu_instancing", Kind::object, kInstancing},
                                     {"KHR_node_visibility", Kind::object, kVisibility}};
constexpr Field kNode[] = {{"mesh", Kind::integer},
                           {"camera", Kind::integer},
                           {"skin", Kind::integer},
                           {"children", Kind::integers},
                           {"matrix", Kind::numbers, {}, 16},
                           {"translation", Kind::numbers, {}, 3},
                           {"rotation", Kind::numbers, {}, 4},
                           {"scale", Kind::numbers, {}, 3},
                           {"extensions", Kind::object, kNodeExtensions}};
constexpr Field kScene[] = {{"name", Kind::text}, {"nodes", Kind::integers}};
constexpr Field kAsset[] = {{"version", Kind::text}};
constexpr Field kDocument[] = {
    {"asset", Kind::object, kAsset},         {"scene", Kind::integer},
    {"scenes", Kind::objects, kScene},       {"nodes", Kind::objects, kNode},
    {"cameras", Kind::objects, kCamera},     {"meshes", Kind::objects, kMesh},
    {"accessors", Kind::objects, kAccessor}, {"bufferViews", Kind::objects, kBufferView},
    {"buffers", Kind::objects, kBuffer},     {"materials", Kind::objects, kMaterial},
    {"textures", Kind::objects, kTexture},   {"images", Kind::objects, kImage},
    {"samplers", Kind::objects, kSampler}};

json form_of(const JsonItem& item, std::span<const Field> fields);

json forms_of(const JsonItem& item, const Field& field) {
    json list = json::array();
    const std::size_t size = list_size(item, field.key);
    list.get_ref<json::array_t&>().reserve(size);
    for (std::size_t i = 0; i < size; ++i)
        list.push_back(form_of(list_item(item, field.key, i), field.fields));
    return list;
}

json value_of(const JsonItem& item, const Field& field) {
    switch (field.kind) {
        case Kind::whole:
            return read_whole(item, field.key);
        case Kind::integer:
            return read_int(item, field.key);
        case Kind::integers:
            return read_ints(item, field.key);
        case Kind::number:
            return read_number(item, field.key);
        case Kind::numbers:
            return read_numbers(item, field.key, field.size);
        case Kind::flag:
            return read_flag(item, field.key);
        case Kind::text:
            return read_text(item, field.key);
        case Kind::object:
            return form_of(child(item, field.key), field.fields);
        case Kind::objects:
            return forms_of(item, field);
        case Kind::mark:
            return json::array({json::object()});
    }
    return {};
}

// Recursion is as deep as the tables above.
json form_of(const JsonItem& item, std::span<const Field> fields) {
    json form = json::object();
    for (const Field& field : fields) {
        const bool is_there = has(item, field.key);
        // A missing required object is reported by the field that it lacks.
        if (!is_there && field.is_required && field.kind != Kind::object)
            refuse(item, field.key, "is missing");
        if (is_there || field.is_required) form[field.key] = value_of(item, field);
    }
    return form;
}

// An item of 3 bytes in the file takes up to 1 kB in memory, a material 2 kB.
void check_sizes(const JsonItem& document) {
    constexpr std::size_t kMaxItems = std::size_t{1} << 22;
    constexpr std::size_t kMaxMaterials = std::size_t{1} << 16;
    for (const Field& field : kDocument) {
        if (field.kind != Kind::objects) continue;
        const std::size_t most = field.fields.data() == kMaterial ? kMaxMaterials : kMaxItems;
        if (const std::size_t size = list_size(document, field.key); size > most)
            refuse(document, field.key, fmt::format("has {} items; at most {} are read", size, most));
    }
}

}  // namespace

json gltf_form(const json& document) {
    const JsonItem item = {&document, ""};
    check_sizes(item);
    return form_of(item, kDocument);
}

}  // namespace voxilux
