#include "renderer/shading/assemble.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>
#include <span>

#include "renderer/shading/glsl_scan.h"

namespace volcast::shading {
namespace {

/// What the chunk in a slot must define.
struct Slot {
    const char* name;
    std::string Recipe::*chunk;
    std::vector<const char*> functions;
};

// In the order of emission: each slot may call what those before it define.
const std::array<Slot, 4>& slots() {
    static const std::array<Slot, 4> kSlots{
        Slot{"classify", &Recipe::classify, {"classify", "matterAt", "transparentBetween"}},
        Slot{"segment", &Recipe::segment, {"integrateSegment"}},
        Slot{"model",
             &Recipe::model,
             {"beginRay", "enterData", "stepRay", "skipsBetween", "endRay", "hitDistance",
              "packRay", "unpackRay"}},
        Slot{"evaluator", &Recipe::evaluator, {"main"}}};
    return kSlots;
}

std::string at(const LineOrigin& origin) {
    return origin.file + ":" + std::to_string(origin.line);
}

std::string floatText(float value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.9g", value);
    const std::string digits{text.data()};
    return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
}

std::string declaration(const Constant& constant) {
    const std::string left = " " + constant.name + " = ";
    if (const bool* flag = std::get_if<bool>(&constant.value)) {
        return "const bool" + left + (*flag ? "true;" : "false;");
    }
    if (const int* integer = std::get_if<int>(&constant.value)) {
        return "const int" + left + std::to_string(*integer) + ";";
    }
    return "const float" + left + floatText(std::get<float>(constant.value)) + ";";
}

/// Joins lines and remembers where each came from.
class Writer {
public:
    explicit Writer(const ChunkSource& chunks) : chunks_{chunks} {
        line("#version 450 core", {.file = "version", .line = 1});
    }

    void constants(std::span<const Constant> constants) {
        for (const Constant& constant : constants) {
            line(declaration(constant), {.file = "constant " + constant.name, .line = 1});
        }
    }

    /// Emits a chunk, its includes first met in it in their places, all at most once.
    Result<void> chunk(const std::string& path, const LineOrigin& wantedBy) {
        if (std::ranges::find(open_, path) != open_.end()) {
            return fail(ErrorCode::kShaderBuild, at(wantedBy) + ": " + path + " includes itself");
        }
        if (!done_.insert(path).second) return {};
        const std::optional<std::string> text = chunks_(path);
        if (!text) {
            return fail(ErrorCode::kShaderBuild, at(wantedBy) + ": there is no chunk " + path);
        }
        open_.push_back(path);
        Result<void> emitted = lines(path, *text);
        open_.pop_back();
        return emitted;
    }

    [[nodiscard]] Assembled take() { return std::move(result_); }
    [[nodiscard]] const Assembled& result() const noexcept { return result_; }

private:
    void line(std::string_view text, LineOrigin origin) {
        result_.source.append(text).push_back('\n');
        result_.lines.push_back(std::move(origin));
    }

    Result<void> lines(const std::string& path, std::string_view text) {
        for (int number = 1; !text.empty(); ++number) {
            const std::size_t end = text.find('\n');
            const std::string_view content = text.substr(0, end);
            text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
            const LineOrigin origin{.file = path, .line = number};
            constexpr std::string_view kInclude = "#include \"";
            if (!content.starts_with(kInclude)) {
                line(content, origin);
                continue;
            }
            const std::string_view rest = content.substr(kInclude.size());
            const std::size_t quote = rest.find('"');
            if (quote == std::string_view::npos) {
                return fail(ErrorCode::kShaderBuild, at(origin) + ": no closing quote");
            }
            const Result<void> included = chunk(std::string{rest.substr(0, quote)}, origin);
            if (!included) return included.error();
        }
        return {};
    }

    const ChunkSource& chunks_;
    Assembled result_;
    std::set<std::string> done_;
    std::vector<std::string> open_;
};

/// Each of `functions` must be defined once, in whatever file; `chunk` fills `slot`.
Result<void> checkSlot(const Assembled& assembled, const std::vector<FunctionDefinition>& defined,
                       const std::string& slot, const std::string& chunk,
                       std::span<const char* const> functions) {
    for (const char* function : functions) {
        const LineOrigin* first = nullptr;
        for (const FunctionDefinition& definition : defined) {
            if (definition.name != function) continue;
            const LineOrigin& origin =
                assembled.lines[static_cast<std::size_t>(definition.line) - 1];
            if (first != nullptr) {
                return fail(ErrorCode::kShaderBuild, at(origin) + ": " + function +
                                                         "() is already defined at " + at(*first));
            }
            first = &origin;
        }
        if (first == nullptr) {
            std::string message = chunk;
            message.append(":1: the slot ").append(slot).append(" needs a function ");
            return fail(ErrorCode::kShaderBuild, message.append(function).append("()"));
        }
    }
    return {};
}

}  // namespace

ChunkSource withTexts(const std::vector<TextChunk>& texts, const ChunkSource& chunks) {
    return [&texts, &chunks](std::string_view path) -> std::optional<std::string> {
        const auto found = std::ranges::find(texts, path, &TextChunk::path);
        return found == texts.end() ? chunks(path) : found->text;
    };
}

Result<Assembled> assemble(const Recipe& recipe, const ChunkSource& files) {
    if (recipe.evaluator.empty()) {
        return fail(ErrorCode::kShaderBuild, "a recipe without an evaluator draws nothing");
    }
    const ChunkSource chunks = withTexts(recipe.texts, files);
    Writer writer{chunks};
    writer.constants(recipe.constants);
    for (const char* contract : {"contract/ray.glsl", "contract/segment.glsl"}) {
        const Result<void> emitted = writer.chunk(contract, {.file = "recipe", .line = 1});
        if (!emitted) return emitted.error();
    }
    for (const Slot& slot : slots()) {
        const std::string& chunk = recipe.*slot.chunk;
        if (chunk.empty()) continue;
        const Result<void> emitted =
            writer.chunk(chunk, {.file = std::string{"recipe "} + slot.name, .line = 1});
        if (!emitted) return emitted.error();
    }
    const std::vector<FunctionDefinition> defined = functionDefinitions(writer.result().source);
    for (const Slot& slot : slots()) {
        const std::string& chunk = recipe.*slot.chunk;
        if (chunk.empty()) continue;
        const Result<void> valid =
            checkSlot(writer.result(), defined, slot.name, chunk, slot.functions);
        if (!valid) return valid.error();
    }
    return writer.take();
}

Result<Assembled> assembleFile(const std::string& path, const std::vector<Constant>& constants,
                               const ChunkSource& chunks) {
    Writer writer{chunks};
    writer.constants(constants);
    const Result<void> emitted = writer.chunk(path, {.file = "pass", .line = 1});
    if (!emitted) return emitted.error();
    const std::array<const char*, 1> main{"main"};
    const Result<void> valid =
        checkSlot(writer.result(), functionDefinitions(writer.result().source), "pass", path, main);
    if (!valid) return valid.error();
    return writer.take();
}

}  // namespace volcast::shading
