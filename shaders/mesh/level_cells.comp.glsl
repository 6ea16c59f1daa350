// Lists the cells that meet each level of an isosurface, once for each change of field or levels. A
// cell meets level c where (f < c) differs between its corners.
// Constants: kValuesAt.
#include "mesh/corner_values.glsl"

layout(local_size_x = 128) in;

layout(binding = kCornerUnit) uniform isamplerBuffer cellCorners;
layout(binding = kFieldUnit) uniform samplerBuffer fieldValues;
layout(binding = kLevelUnit) uniform samplerBuffer levelValues;
layout(std430, binding = kNodeStorage) writeonly buffer LevelCells {
    ivec2 listed[];  // cell, level
};
layout(std430, binding = kCountStorage) buffer Count {
    uint count;  // also of those that did not fit
};

void main() {
    int cell = int(gl_GlobalInvocationID.x +
                   gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x);
    if (cell >= textureSize(cellCorners)) return;
    vec4 values = cornerValues(fieldValues, kValuesAt, cell, texelFetch(cellCorners, cell));
    float low = min(min(values.x, values.y), min(values.z, values.w));
    float high = max(max(values.x, values.y), max(values.z, values.w));
    for (int level = 0; level < textureSize(levelValues); ++level) {
        float value = texelFetch(levelValues, level).r;
        if (low >= value || high < value) continue;
        uint place = atomicAdd(count, 1u);
        if (place < uint(listed.length())) listed[place] = ivec2(cell, level);
    }
}
