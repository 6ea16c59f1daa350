# Writes the chunks under FOLDER into OUTPUT, a C++ source: cmake -D FOLDER=.. -D OUTPUT=.. -P this
file(GLOB_RECURSE chunks RELATIVE ${FOLDER} ${FOLDER}/*.glsl)
list(SORT chunks)
set(rows "")
foreach(chunk ${chunks})
    file(READ ${FOLDER}/${chunk} text)
    string(APPEND rows "    {\"${chunk}\", R\"chunk(${text})chunk\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// Made by embed_chunks.cmake.
#include \"renderer/shading/embedded_chunks.h\"

namespace volcast::shading {
namespace {

constexpr EmbeddedChunk kChunks[] = {
${rows}};

}  // namespace

std::span<const EmbeddedChunk> embeddedChunkTable() { return kChunks; }

}  // namespace volcast::shading
")
