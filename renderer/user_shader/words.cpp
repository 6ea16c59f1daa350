#include "renderer/user_shader/words.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <span>

namespace volcast::user_shader {
namespace {

constexpr std::string_view kTypes[] = {"bool",   "bvec2",  "bvec3",  "bvec4",  "float",  "int",
                                       "ivec2",  "ivec3",  "ivec4",  "mat2",   "mat2x2", "mat2x3",
                                       "mat2x4", "mat3",   "mat3x2", "mat3x3", "mat3x4", "mat4",
                                       "mat4x2", "mat4x3", "mat4x4", "uint",   "uvec2",  "uvec3",
                                       "uvec4",  "vec2",   "vec3",   "vec4",   "void"};
constexpr std::string_view kKeywords[] = {"break",     "case",   "const",  "continue", "default",
                                          "else",      "false",  "for",    "highp",    "if",
                                          "in",        "inout",  "lowp",   "mediump",  "out",
                                          "precision", "return", "struct", "switch",   "true"};
constexpr std::string_view kFunctions[] = {"abs",
                                           "acos",
                                           "acosh",
                                           "all",
                                           "any",
                                           "asin",
                                           "asinh",
                                           "atan",
                                           "atanh",
                                           "bitCount",
                                           "bitfieldExtract",
                                           "bitfieldInsert",
                                           "bitfieldReverse",
                                           "ceil",
                                           "clamp",
                                           "cos",
                                           "cosh",
                                           "cross",
                                           "degrees",
                                           "determinant",
                                           "distance",
                                           "dot",
                                           "equal",
                                           "exp",
                                           "exp2",
                                           "faceforward",
                                           "findLSB",
                                           "findMSB",
                                           "floatBitsToInt",
                                           "floatBitsToUint",
                                           "floor",
                                           "fma",
                                           "fract",
                                           "greaterThan",
                                           "greaterThanEqual",
                                           "intBitsToFloat",
                                           "inverse",
                                           "inversesqrt",
                                           "isinf",
                                           "isnan",
                                           "length",
                                           "lessThan",
                                           "lessThanEqual",
                                           "log",
                                           "log2",
                                           "matrixCompMult",
                                           "max",
                                           "min",
                                           "mix",
                                           "mod",
                                           "normalize",
                                           "not",
                                           "notEqual",
                                           "outerProduct",
                                           "pow",
                                           "radians",
                                           "reflect",
                                           "refract",
                                           "round",
                                           "roundEven",
                                           "sign",
                                           "sin",
                                           "sinh",
                                           "smoothstep",
                                           "sqrt",
                                           "step",
                                           "tan",
                                           "tanh",
                                           "transpose",
                                           "trunc",
                                           "uintBitsToFloat"};
constexpr std::string_view kOffered[] = {
    "VOLUME_RENDERING", "emitGrayscale",   "emitIntensity", "emitRGB",
    "emitRGBA",         "emitTransparent", "getDataValue",  "getInterpolatedDataValue",
    "int16_t",          "toNormalized",    "toRaw",         "uint16_t",
    "uint8_t"};

// Both in one table would hide which words need a sentence of their own.
const std::map<std::string_view, std::string_view>& refusals() {
    constexpr std::string_view kLoops =
        "only for loops with constant bounds are allowed, so that every ray ends";
    constexpr std::string_view kResources = "code reads data and controls, nothing else";
    constexpr std::string_view kDoubles = "numbers have single precision";
    static const std::map<std::string_view, std::string_view> kRefusals{
        {"while", kLoops},
        {"do", kLoops},
        {"goto", kLoops},
        {"discard", "call emitTransparent() and return"},
        {"uniform", "declare a control instead: #uicontrol"},
        {"buffer", kResources},
        {"shared", kResources},
        {"layout", kResources},
        {"attribute", kResources},
        {"varying", kResources},
        {"subroutine", kResources},
        {"atomic_uint", kResources},
        {"coherent", kResources},
        {"volatile", kResources},
        {"restrict", kResources},
        {"readonly", kResources},
        {"writeonly", kResources},
        {"double", kDoubles},
        {"invariant", "results go nowhere but to emit functions"},
        {"precise", "results go nowhere but to emit functions"},
        {"centroid", kResources},
        {"flat", kResources},
        {"smooth", kResources},
        {"noperspective", kResources},
        {"patch", kResources},
        {"sample", kResources}};
    return kRefusals;
}

bool contains(std::span<const std::string_view> words, std::string_view word) {
    return std::ranges::binary_search(words, word);
}

/// Families of types: dvec3, sampler3D, iimageCube, textureBuffer, ...
std::string_view familyRefusal(std::string_view word) {
    if (word.starts_with("dvec") || word.starts_with("dmat")) return refusals().at("double");
    for (const std::string_view family : {"sampler", "image", "texture"}) {
        std::string_view rest = word;
        if (!rest.starts_with(family)) rest.remove_prefix(1);
        if (!rest.starts_with(family)) continue;
        rest.remove_prefix(family.size());
        for (const std::string_view shape : {"1D", "2D", "3D", "Cube", "Buffer"}) {
            if (rest.starts_with(shape)) return refusals().at("buffer");
        }
    }
    return {};
}

}  // namespace

std::string_view refusalOf(std::string_view word) {
    const auto found = refusals().find(word);
    if (found != refusals().end()) return found->second;
    if (word.starts_with("gl_")) return "names of GLSL's own variables are not offered";
    if (word.find("__") != std::string_view::npos) return "two underscores in a row are reserved";
    return familyRefusal(word);
}

Word wordKind(std::string_view word) {
    if (contains(kTypes, word)) return Word::kType;
    if (contains(kKeywords, word)) return Word::kKeyword;
    if (contains(kFunctions, word)) return Word::kFunction;
    if (contains(kOffered, word)) return Word::kOffered;
    return refusalOf(word).empty() ? Word::kOther : Word::kRefused;
}

bool isSelector(std::string_view word) {
    if (word == "length") return true;
    if (word.empty() || word.size() > 4) return false;
    for (const std::string_view letters : {"xyzw", "rgba", "stpq"}) {
        if (word.find_first_not_of(letters) == std::string_view::npos) return true;
    }
    return false;
}

}  // namespace volcast::user_shader
