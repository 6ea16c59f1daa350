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
// kTwoMaps: extinction has a map of its own, searched by kDensitySearch, or a field of its own.
// Layout of the buffer (texels of 4 floats), written by renderer/scene/map_table.cpp:
//   0     x: number of points, y: grid cells, z: where the grid begins, w: cells a unit of value
//   1, 2  the first 8 points' values, huge where there are fewer
//   3..5  the same of the map of g
//   6     where sections begin: x: pieces of g, y: levels, z: largest colours, w: pre-integrated
//   7     x: number of levels; y, z: values at the ends of the pre-integrated table
//   then the pieces of f, each 3 texels, and its grid; then the sections
//   piece: 0  colour and extinction where it begins
//          1  their slopes
//          2  x: value where it begins, y: pieces with extinction below, z: up to it, w: its end
//   grid:  a texel a cell: x, y: the lowest and the highest piece in it
#include "shared/bindings.glsl"

const int kMapPieces = 8;  // texel of the first piece of f

layout(std140, binding = kMapBinding) uniform MapHeader {
    vec4 mapGrid;
    vec4 mapFirst;
    vec4 mapSecond;
    vec4 densityGrid;
    vec4 densityFirst;
    vec4 densitySecond;
    vec4 mapSections;
    vec4 mapExtras;
};
layout(binding = kMapUnit) uniform samplerBuffer mapTexels;

// Halves [range.x, range.y], which holds the piece of `value`. No loop, because llvmpipe ends all
// loops of an invocation after 65,535 iterations in total.
ivec2 halved(int pieces, float value, ivec2 range) {
    int middle = (range.x + range.y + 1) >> 1;
    return value >= texelFetch(mapTexels, pieces + 3 * middle + 2).x
               ? ivec2(middle, range.y)
               : ivec2(range.x, max(middle - 1, range.x));
}

int pieceOf(float value, int search, int pieces, vec4 grid, vec4 first, vec4 second) {
    if (search == 0) {
        ivec4 counts = ivec4(greaterThanEqual(vec4(value), first)) +
                       ivec4(greaterThanEqual(vec4(value), second));
        return counts.x + counts.y + counts.z + counts.w;
    }
    ivec2 range = ivec2(0, int(grid.x));
    if (search == 1) {
        float cell = clamp((value - grid.z) * grid.w, 0.0, grid.y - 1.0);
        range = ivec2(texelFetch(mapTexels, pieces + 3 + 3 * int(grid.x) + int(cell)).xy);
    } else {
        range = halved(pieces, value, halved(pieces, value, halved(pieces, value, range)));
        range = halved(pieces, value, halved(pieces, value, halved(pieces, value, range)));
        range = halved(pieces, value, halved(pieces, value, halved(pieces, value, range)));
    }
    return halved(pieces, value, halved(pieces, value, range)).x;
}

int mapPiece(float f) {
    return pieceOf(f, kMapSearch, kMapPieces, mapGrid, mapFirst, mapSecond);
}

int densityPieces() {
    return int(mapSections.x);
}

int densityPiece(float g) {
    return pieceOf(g, kDensitySearch, densityPieces(), densityGrid, densityFirst, densitySecond);
}

// One linear piece of a map.
struct MapPiece {
    vec4 start;  // colour and extinction at `low`
    vec4 slope;
    float low, high;  // values
};

MapPiece fetchPiece(int pieces, int piece) {
    int texel = pieces + 3 * piece;
    vec4 place = texelFetch(mapTexels, texel + 2);
    return MapPiece(texelFetch(mapTexels, texel), texelFetch(mapTexels, texel + 1), place.x,
                    place.w);
}

vec4 valueIn(MapPiece piece, float value) {
    return piece.start + (value - piece.low) * piece.slope;
}

vec4 classify(float f) {
    vec4 matter = valueIn(fetchPiece(kMapPieces, mapPiece(f)), f);
    return vec4(matter.rgb, max(matter.a, 0.0));
}

float extinctionOf(float g) {
    return max(valueIn(fetchPiece(densityPieces(), densityPiece(g)), g).a, 0.0);
}

// C of the map of g.
vec3 densityColour(float g) {
    return valueIn(fetchPiece(densityPieces(), densityPiece(g)), g).rgb;
}

vec4 matterAt(float f, float g) {
    vec4 matter = classify(f);
    return kTwoMaps ? vec4(matter.rgb, extinctionOf(g)) : matter;
}

bool transparentBetween(float lo, float hi) {
    int texel = kMapPieces + 2;
    float below = texelFetch(mapTexels, texel + 3 * mapPiece(lo)).y;
    return texelFetch(mapTexels, texel + 3 * mapPiece(hi)).z == below;
}
