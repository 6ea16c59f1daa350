// STL and PLY, as text and binary.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "renderer/data/load/surface_files.h"
#include "renderer/data/load/text_lines.h"

namespace volcast::data::load {

namespace {

/// Numbers points, equal ones alike.
class Welder {
public:
    explicit Welder(Surface& surface) : surface_{surface} {}

    std::int64_t add(const glm::dvec3& point) {
        const auto next = static_cast<std::int64_t>(surface_.points.size());
        const auto [place, isNew] = known_.emplace(std::tuple{point.x, point.y, point.z}, next);
        if (isNew) surface_.points.push_back(point);
        return place->second;
    }

    void addTriangle(const std::array<glm::dvec3, 3>& corners) {
        const std::int64_t a = add(corners[0]);
        const std::int64_t b = add(corners[1]);
        const std::int64_t c = add(corners[2]);
        if (a == b || b == c || c == a) return;
        surface_.facets.push_back({.polygons = {{a, b, c}}});
    }

private:
    Surface& surface_;
    std::map<std::tuple<double, double, double>, std::int64_t> known_;
};

constexpr std::size_t kStlHeader = 84;
constexpr std::size_t kStlTriangle = 50;

Result<Surface> parseBinaryStl(const std::string& path, std::string_view bytes,
                               std::uint32_t triangles) {
    Surface surface;
    Welder welder{surface};
    for (std::uint32_t t = 0; t < triangles; ++t) {
        std::array<float, 9> numbers{};
        constexpr std::size_t kNormal = 12;
        std::memcpy(numbers.data(), bytes.data() + kStlHeader + kStlTriangle * t + kNormal,
                    sizeof numbers);
        for (const float number : numbers) {
            if (std::isfinite(number)) continue;
            return fail(ErrorCode::kInvalidArgument, path + ": triangle " + std::to_string(t) +
                                                         " has a coordinate that is not finite");
        }
        welder.addTriangle({glm::dvec3{numbers[0], numbers[1], numbers[2]},
                            glm::dvec3{numbers[3], numbers[4], numbers[5]},
                            glm::dvec3{numbers[6], numbers[7], numbers[8]}});
    }
    return surface;
}

Result<Surface> parseTextStl(const std::string& path, std::string_view text) {
    TextLines lines{path, text};
    Surface surface;
    Welder welder{surface};
    std::array<glm::dvec3, 3> corners{};
    std::size_t corner = 0;
    bool ended = false;
    while (lines.next()) {
        const std::string_view word = lines.words()[0];
        if (word == "endsolid") ended = true;
        if (word == "endfacet" && corner != 0) return lines.error("a facet has no three corners");
        if (word != "vertex") continue;
        for (int axis = 0; axis < 3; ++axis) {
            const auto value = lines.number(1 + static_cast<std::size_t>(axis));
            if (!value) return value.error();
            corners.at(corner)[axis] = *value;
        }
        if (++corner < 3) continue;
        welder.addTriangle(corners);
        corner = 0;
    }
    if (!ended) return lines.error("ends without endsolid: the file is cut off");
    return surface;
}

enum class PlyFormat { kText, kLittle, kBig };

struct PlyProperty {
    std::string name;
    std::string type;
    std::string countType;  ///< Of a list; empty for a single number.
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties = {};
};

struct PlyHeader {
    PlyFormat format = PlyFormat::kText;
    std::vector<PlyElement> elements;
    std::size_t bytes = 0;
};

/// Bytes of a PLY number type; 0 for an unknown one.
std::size_t plySize(const std::string& type) {
    static const std::map<std::string, std::size_t> kSizes{
        {"char", 1},   {"int8", 1},    {"uchar", 1},  {"uint8", 1},  {"short", 2}, {"int16", 2},
        {"ushort", 2}, {"uint16", 2},  {"int", 4},    {"int32", 4},  {"uint", 4},  {"uint32", 4},
        {"float", 4},  {"float32", 4}, {"double", 8}, {"float64", 8}};
    const auto found = kSizes.find(type);
    return found == kSizes.end() ? 0 : found->second;
}

Result<void> readPlyLine(const TextLines& lines, PlyHeader& header) {
    const auto& words = lines.words();
    const auto word = [&](std::size_t i) {
        return i < words.size() ? std::string{words[i]} : std::string{};
    };
    if (words[0] == "format") {
        if (word(1) == "binary_little_endian")
            header.format = PlyFormat::kLittle;
        else if (word(1) == "binary_big_endian")
            header.format = PlyFormat::kBig;
        else if (word(1) != "ascii")
            return lines.error("format " + word(1) + " is not known");
    } else if (words[0] == "element") {
        const auto count = lines.count(2, "elements", 1);
        if (!count) return count.error();
        header.elements.push_back({.name = word(1), .count = *count});
    } else if (words[0] == "property") {
        if (header.elements.empty()) return lines.error("a property without an element");
        const bool list = word(1) == "list";
        PlyProperty property{.name = word(list ? 4 : 2),
                             .type = word(list ? 3 : 1),
                             .countType = list ? word(2) : std::string{}};
        if (plySize(property.type) == 0 || (list && plySize(property.countType) == 0)) {
            return lines.error("a property has an unknown type");
        }
        header.elements.back().properties.push_back(std::move(property));
    }
    return {};
}

Result<PlyHeader> readPlyHeader(const std::string& path, std::string_view bytes) {
    constexpr std::string_view kEnd = "end_header";
    const std::size_t end = bytes.find(kEnd);
    if (!bytes.starts_with("ply") || end == std::string_view::npos) {
        return fail(ErrorCode::kInvalidArgument,
                    path + ": is no PLY file (it lacks ply or end_header)");
    }
    PlyHeader header;
    header.bytes =
        bytes.find('\n', end) == std::string_view::npos ? bytes.size() : bytes.find('\n', end) + 1;
    TextLines lines{path, bytes.substr(0, end)};
    while (lines.next()) {
        auto done = readPlyLine(lines, header);
        if (!done) return done.error();
    }
    for (const PlyElement& element : header.elements) {
        if (element.count <= bytes.size()) continue;
        return fail(ErrorCode::kLimitExceeded,
                    path + ": says " + std::to_string(element.count) + " of " + element.name +
                        ", which " + std::to_string(bytes.size()) + " bytes cannot hold");
    }
    return header;
}

/// Takes numbers one after the other from the body, whatever its form.
class PlyBody {
public:
    PlyBody(const std::string& path, std::string_view bytes, PlyFormat format)
        : path_{path}, bytes_{bytes}, format_{format}, lines_{path, bytes} {}

    Result<double> next(const std::string& type) {
        if (format_ != PlyFormat::kText) return nextBinary(type);
        while (word_ >= lines_.words().size()) {
            if (!lines_.next()) return cutOff();
            word_ = 0;
        }
        return lines_.number(word_++);
    }

private:
    [[nodiscard]] Error cutOff() const {
        return fail(ErrorCode::kInvalidArgument, path_ + ": ends before its last element");
    }

    template <class T>
    [[nodiscard]] double as(const std::array<char, 8>& raw) const {
        T value{};
        std::memcpy(&value, raw.data(), sizeof(T));
        return static_cast<double>(value);
    }

    Result<double> nextBinary(const std::string& type) {
        const std::size_t size = plySize(type);
        if (bytes_.size() - at_ < size) return cutOff();
        std::array<char, 8> raw{};
        std::memcpy(raw.data(), bytes_.data() + at_, size);
        at_ += size;
        if (format_ == PlyFormat::kBig) std::reverse(raw.begin(), raw.begin() + size);
        const bool isUnsigned = type.starts_with("u");
        if (type.starts_with("f")) return size == 8 ? as<double>(raw) : as<float>(raw);
        if (size == 8) return as<double>(raw);
        if (size == 4) return isUnsigned ? as<std::uint32_t>(raw) : as<std::int32_t>(raw);
        if (size == 2) return isUnsigned ? as<std::uint16_t>(raw) : as<std::int16_t>(raw);
        return isUnsigned ? as<std::uint8_t>(raw) : as<std::int8_t>(raw);
    }

    const std::string& path_;
    std::string_view bytes_;
    PlyFormat format_;
    std::size_t at_ = 0;
    TextLines lines_;
    std::size_t word_ = 0;
};

/// Which axis a vertex property holds; none: 3.
int axisOf(const std::string& name) {
    return name == "x" ? 0 : name == "y" ? 1 : name == "z" ? 2 : 3;
}

/// The numbers of one property: one, or those of a list.
Result<std::vector<double>> readPlyProperty(PlyBody& body, const PlyProperty& property) {
    std::size_t count = 1;
    if (!property.countType.empty()) {
        const auto said = body.next(property.countType);
        if (!said) return said.error();
        constexpr double kMaxCorners = 1e6;
        if (*said < 0 || *said > kMaxCorners) {
            return fail(ErrorCode::kInvalidArgument, "a list of " + std::to_string(*said));
        }
        count = static_cast<std::size_t>(*said);
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
        const auto value = body.next(property.type);
        if (!value) return value.error();
        values.push_back(*value);
    }
    return values;
}

Result<void> readPlyElement(const std::string& path, PlyBody& body, const PlyElement& element,
                            Surface& surface) {
    for (std::size_t i = 0; i < element.count; ++i) {
        glm::dvec3 point{0.0};
        for (const PlyProperty& property : element.properties) {
            const auto values = readPlyProperty(body, property);
            if (!values) return values.error();
            if (element.name == "vertex" && property.countType.empty() &&
                axisOf(property.name) < 3) {
                if (!std::isfinite(values->front())) {
                    return fail(ErrorCode::kInvalidArgument,
                                path + ": vertex " + std::to_string(i) +
                                    " has a coordinate that is not finite");
                }
                point[axisOf(property.name)] = values->front();
            }
            if (element.name == "face" && property.name.starts_with("vertex_ind")) {
                std::vector<std::int64_t> ring;
                for (const double v : *values) ring.push_back(static_cast<std::int64_t>(v));
                surface.facets.push_back({.polygons = {std::move(ring)}});
            }
        }
        if (element.name == "vertex") surface.points.push_back(point);
    }
    return {};
}

}  // namespace

Result<Surface> parseStl(const std::string& path, std::string_view bytes) {
    std::uint32_t triangles = 0;
    if (bytes.size() >= kStlHeader) std::memcpy(&triangles, bytes.data() + 80, sizeof triangles);
    const std::size_t needed = kStlHeader + kStlTriangle * std::size_t{triangles};
    const bool text = bytes.starts_with("solid") && bytes.size() != needed;
    if (text) return parseTextStl(path, bytes);
    if (bytes.size() < needed || bytes.size() < kStlHeader) {
        return fail(ErrorCode::kInvalidArgument,
                    path + ": is no STL file, or is cut off: " + std::to_string(triangles) +
                        " triangles need " + std::to_string(needed) + " bytes, it has " +
                        std::to_string(bytes.size()));
    }
    return parseBinaryStl(path, bytes, triangles);
}

Result<Surface> parsePly(const std::string& path, std::string_view bytes,
                         std::vector<std::string>& warnings) {
    const auto header = readPlyHeader(path, bytes);
    if (!header) return header.error();
    Surface surface;
    PlyBody body{path, bytes.substr(header->bytes), header->format};
    std::string left;
    for (const PlyElement& element : header->elements) {
        auto done = readPlyElement(path, body, element, surface);
        if (!done) return done.error();
        if (element.name != "vertex") continue;
        for (const PlyProperty& property : element.properties) {
            if (axisOf(property.name) == 3) left += (left.empty() ? "" : ", ") + property.name;
        }
    }
    if (!left.empty()) warnings.push_back("vertex properties are left out: " + left);
    return surface;
}

}  // namespace volcast::data::load
