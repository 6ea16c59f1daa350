#include "renderer/shading/program_cache.h"

#include <array>

namespace volcast::shading {
namespace {

std::string keyOf(std::initializer_list<std::string> parts,
                  const std::vector<Constant>& constants) {
    std::string key;
    for (const std::string& part : parts) key += part + "|";
    for (const Constant& constant : constants) {
        key += constant.name + "=";
        std::visit([&key](auto value) { key += std::to_string(value); }, constant.value);
        key += "|";
    }
    return key;
}

gpu::StageSource stage(gpu::Stage kind, const Assembled& assembled) {
    return {.stage = kind,
            .text = assembled.source,
            .translate = [&assembled](std::string_view log) { return assembled.translate(log); }};
}

}  // namespace

Result<const gpu::Program*> ProgramCache::ray(const Recipe& recipe, const std::string& vertex) {
    std::string key =
        keyOf({vertex, recipe.evaluator, recipe.classify, recipe.segment, recipe.model},
              recipe.constants);
    for (const TextChunk& chunk : recipe.texts) key += chunk.path + "=" + chunk.text + "|";
    if (const auto found = programs_.find(key); found != programs_.end()) {
        return found->second.get();
    }
    return keep(key, build(recipe.evaluator + " + " + recipe.model, vertex, recipe.constants,
                           assemble(recipe, chunks_)));
}

Result<const gpu::Program*> ProgramCache::pass(const std::string& vertex,
                                               const std::string& fragment,
                                               const std::vector<Constant>& constants) {
    const std::string key = keyOf({vertex, fragment}, constants);
    if (const auto found = programs_.find(key); found != programs_.end()) {
        return found->second.get();
    }
    return keep(key,
                build(fragment, vertex, constants, assembleFile(fragment, constants, chunks_)));
}

Result<const gpu::Program*> ProgramCache::compute(const std::string& file,
                                                  const std::vector<Constant>& constants) {
    const std::string key = keyOf({file}, constants);
    if (const auto found = programs_.find(key); found != programs_.end()) {
        return found->second.get();
    }
    const Result<Assembled> assembled = assembleFile(file, constants, chunks_);
    if (!assembled) return assembled.error();
    const std::array stages{stage(gpu::Stage::kCompute, *assembled)};
    return keep(key, gpu::Program::create(*device_, file.c_str(), stages));
}

Result<const gpu::Program*> ProgramCache::keep(const std::string& key,
                                               Result<gpu::Program> program) {
    if (!program) return program.error();
    auto owned = std::make_unique<gpu::Program>(std::move(*program));
    const gpu::Program* made = owned.get();
    programs_.emplace(key, std::move(owned));
    return made;
}

Result<gpu::Program> ProgramCache::build(const std::string& label, const std::string& vertex,
                                         const std::vector<Constant>& constants,
                                         Result<Assembled> fragment) {
    if (!fragment) return fragment.error();
    const Result<Assembled> first = assembleFile(vertex, constants, chunks_);
    if (!first) return first.error();
    const std::array stages{stage(gpu::Stage::kVertex, *first),
                            stage(gpu::Stage::kFragment, *fragment)};
    return gpu::Program::create(*device_, label.c_str(), stages);
}

}  // namespace volcast::shading
