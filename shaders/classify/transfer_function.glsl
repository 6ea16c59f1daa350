// Colour and extinction of a value: piecewise linear between control points, clamped outside, and
// evaluated as it is given: no table is resampled, nothing is quantised.
//
// n points make n + 1 pieces; piece k begins at the k-th point and piece 0 lies below them all. So
// the piece of a value is the number of points that are not above it, and of points with one
// value the last counts: they make a step.
// A map of few points without steps is a sum instead, of one slope a piece, clamped to 0..1: no
// piece is looked up, which on llvmpipe costs more than all of the sum.
// Constants: kMapSearch, how a value is found:
//   0  up to 8 points: compare with all
//   1  many points: a uniform grid narrows it to 4 pieces, then 2 halvings
//   2  points too uneven for a grid: 11 halvings
//   3  a sum of kMapSlopes slopes, 4 or 7
// kTwoMaps: extinction has a map of its own, found by kDensitySearch and kDensitySlopes, or a field
// of its own.
// Layout of the buffer (texels of 4 floats), written by renderer/scene/map_texels.cpp:
//   0        x: number of points, y: grid cells, z: where the grid begins, w: cells a unit of value
//   1, 2     the first 8 points' values, huge where there are fewer
//   3, 4     1 / length of the first 7 pieces between points
//   5        colour and extinction below the first point
//   6..12    their rise over each of these pieces
//   13..25   the same of the map of g
//   26       where sections begin: x: pieces of g, y: levels, z: largest colours, w: pre-integrated
//   27       x: number of levels; y, z: values at the ends of the pre-integrated table
//   then the pieces of f, each 3 texels, and its grid; then the sections
//   piece: 0  colour and extinction where it begins
//          1  their slopes
//          2  x: value where it begins, y: below it nothing has extinction from there on, w: its end
//   grid:  a texel a cell: x, y: the lowest and the highest piece in it
#include "shared/bindings.glsl"

const int kMapPieces = 28;  // texel of the first piece of f

struct MapHead {
    vec4 grid;
    vec4 values[2];
    vec4 scales[2];
    vec4 below;
    vec4 rises[7];
};

layout(std140, binding = kMapBinding) uniform MapHeader {
    MapHead uniformMapHead;
    MapHead uniformDensityHead;
    vec4 mapSections;
    vec4 mapExtras;
};
layout(binding = kMapUnit) uniform samplerBuffer mapTexels;

// llvmpipe reads a uniform again in every round of a loop, and checks its bounds each time: that
// was half of the time of a volume. What is computed before the loop stays out of it, so the heads
// are: plus something that is 0, which no compiler knows.
MapHead computed(MapHead head) {
    float zero = max(-gl_FragCoord.x, 0.0);
    head.grid += zero;
    for (int i = 0; i < 2; ++i) {
        head.values[i] += zero;
        head.scales[i] += zero;
    }
    head.below += zero;
    for (int i = 0; i < 7; ++i) head.rises[i] += zero;
    return head;
}

MapHead mapHead = computed(uniformMapHead);
MapHead densityHead = computed(uniformDensityHead);

// Halves [range.x, range.y], which holds the piece of `value`. No loop, because llvmpipe ends all
// loops of an invocation after 65,535 iterations in total.
ivec2 halved(int pieces, float value, ivec2 range) {
    int middle = (range.x + range.y + 1) >> 1;
    return value >= texelFetch(mapTexels, pieces + 3 * middle + 2).x
               ? ivec2(middle, range.y)
               : ivec2(range.x, max(middle - 1, range.x));
}

int pieceOf(float value, int search, int pieces, MapHead head) {
    if (search == 0) {
        ivec4 counts = ivec4(greaterThanEqual(vec4(value), head.values[0])) +
                       ivec4(greaterThanEqual(vec4(value), head.values[1]));
        return counts.x + counts.y + counts.z + counts.w;
    }
    ivec2 range = ivec2(0, int(head.grid.x));
    if (search == 1) {
        float cell = clamp((value - head.grid.z) * head.grid.w, 0.0, head.grid.y - 1.0);
        range = ivec2(texelFetch(mapTexels, pieces + 3 + 3 * int(head.grid.x) + int(cell)).xy);
    } else {
        range = halved(pieces, value, halved(pieces, value, halved(pieces, value, range)));
        range = halved(pieces, value, halved(pieces, value, halved(pieces, value, range)));
        range = halved(pieces, value, halved(pieces, value, halved(pieces, value, range)));
    }
    return halved(pieces, value, halved(pieces, value, range)).x;
}

// Number of points that are not above a value, whatever the search.
int pointsUpTo(float f) {
    return pieceOf(f, kMapSearch == 3 ? 0 : kMapSearch, kMapPieces, mapHead);
}

int densityPieces() {
    return int(mapSections.x);
}

int densityPointsUpTo(float g) {
    return pieceOf(g, kDensitySearch == 3 ? 0 : kDensitySearch, densityPieces(), densityHead);
}

// How much of the first 7 pieces between points lies below `value`, each from 0 to 1.
float shareBelow(MapHead head, float value, int piece) {
    return clamp((value - head.values[piece / 4][piece % 4]) * head.scales[piece / 4][piece % 4],
                 0.0, 1.0);
}

vec4 sumOfSlopes(MapHead head, float value, int slopes) {
    vec4 matter = head.below;
    for (int i = 0; i < slopes; ++i) matter += shareBelow(head, value, i) * head.rises[i];
    return matter;
}

// One linear piece of a map.
struct MapPiece {
    int index;
    vec4 start;  // colour and extinction at `from`
    vec4 slope;
    float from;
    float low, high;  // values
};

MapPiece fetchPiece(int pieces, int index) {
    int texel = pieces + 3 * index;
    vec4 place = texelFetch(mapTexels, texel + 2);
    return MapPiece(index, texelFetch(mapTexels, texel), texelFetch(mapTexels, texel + 1), place.x,
                    index == 0 ? -3.4e38 : place.x, place.w);
}

vec4 valueIn(MapPiece piece, float value) {
    return piece.start + (value - piece.from) * piece.slope;
}

vec4 valueOf(int search, int slopes, MapHead head, int pieces, float value) {
    return search == 3 ? sumOfSlopes(head, value, slopes)
                       : valueIn(fetchPiece(pieces, pieceOf(value, search, pieces, head)), value);
}

vec4 mapValue(float f) {
    return valueOf(kMapSearch, kMapSlopes, mapHead, kMapPieces, f);
}

vec4 densityValue(float g) {
    return valueOf(kDensitySearch, kDensitySlopes, densityHead, densityPieces(), g);
}

vec4 classify(float f) {
    vec4 matter = mapValue(f);
    return vec4(matter.rgb, max(matter.a, 0.0));
}

// C of the map of g.
vec3 densityColour(float g) {
    return densityValue(g).rgb;
}

vec4 matterAt(float f, float g) {
    vec4 matter = classify(f);
    return kTwoMaps ? vec4(matter.rgb, max(densityValue(g).a, 0.0)) : matter;
}

bool transparentBetween(float lo, float hi) {
    return hi < texelFetch(mapTexels, kMapPieces + 2 + 3 * pointsUpTo(lo)).y;
}
