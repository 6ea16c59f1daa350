// Colour and extinction of a value: piecewise linear between control points, clamped outside, and
// evaluated as it is given: no table is resampled, nothing is quantised.
//
// n points make n + 1 pieces; piece k begins at the k-th point and piece 0 lies below them all. So
// the piece of a value is the number of points that are not above it, and of points with one
// value the last counts: they make a step.
// Constants: kMapSearch, how that number is found.
//   0  up to 8 points: compare with all
//   1  many points: a uniform grid narrows it to 4 pieces, then 2 halvings
//   2  points too uneven for a grid: 11 halvings
// Layout of the buffer (texels of 4 floats), written by renderer/scene/map_table.cpp:
//   0     x: number of points, y: grid cells, z: where the grid begins, w: cells a unit of value
//   1, 2  the first 8 points' values, huge where there are fewer
//   3 + 3 k      colour and extinction where piece k begins
//   4 + 3 k      their slopes
//   5 + 3 k      x: value where piece k begins, y: pieces with extinction below k, z: up to k
//   then a texel a grid cell: x, y: the lowest and the highest piece in it
#include "shared/bindings.glsl"

layout(std140, binding = kMapBinding) uniform MapHeader {
    vec4 mapGrid;
    vec4 mapFirst;
    vec4 mapSecond;
};
layout(binding = kMapUnit) uniform samplerBuffer mapTexels;

float mapStart(int piece) {
    return texelFetch(mapTexels, 5 + 3 * piece).x;
}

// Halves [range.x, range.y], which holds the piece of `value`. No loop, because llvmpipe ends all
// loops of an invocation after 65,535 iterations in total.
ivec2 halved(float value, ivec2 range) {
    int middle = (range.x + range.y + 1) >> 1;
    return value >= mapStart(middle) ? ivec2(middle, range.y)
                                     : ivec2(range.x, max(middle - 1, range.x));
}

int mapPiece(float value) {
    if (kMapSearch == 0) {
        ivec4 counts = ivec4(greaterThanEqual(vec4(value), mapFirst)) +
                       ivec4(greaterThanEqual(vec4(value), mapSecond));
        return counts.x + counts.y + counts.z + counts.w;
    }
    ivec2 range = ivec2(0, int(mapGrid.x));
    if (kMapSearch == 1) {
        float cell = clamp((value - mapGrid.z) * mapGrid.w, 0.0, mapGrid.y - 1.0);
        range = ivec2(texelFetch(mapTexels, 6 + 3 * int(mapGrid.x) + int(cell)).xy);
    } else {
        range = halved(value, halved(value, halved(value, range)));
        range = halved(value, halved(value, halved(value, range)));
        range = halved(value, halved(value, halved(value, range)));
    }
    return halved(value, halved(value, range)).x;
}

vec4 classify(float value) {
    int piece = mapPiece(value);
    vec4 start = texelFetch(mapTexels, 3 + 3 * piece);
    vec4 slope = texelFetch(mapTexels, 4 + 3 * piece);
    vec4 matter = start + (value - mapStart(piece)) * slope;
    return vec4(matter.rgb, max(matter.a, 0.0));
}

bool transparentBetween(float lo, float hi) {
    float below = texelFetch(mapTexels, 5 + 3 * mapPiece(lo)).y;
    return texelFetch(mapTexels, 5 + 3 * mapPiece(hi)).z == below;
}
