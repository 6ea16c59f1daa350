// Colour and extinction of a value of each of several channels, as classify/transfer_function.glsl
// says of one: the same pieces, grids and searches, but no map is a sum of slopes.
// Constants: kChannelSearch: 2 bits a channel, from the lowest: how its values are found.
// Layout of the buffer (texels of 4 floats), written by renderer/scene/channel_table.cpp:
//   0     where each channel's part begins
//   1, 2  ends of the interval in which each channel's values count
//   then the parts, each laid out as renderer/scene/map_texels.cpp has it
#include "shared/bindings.glsl"

layout(binding = kMapUnit) uniform samplerBuffer mapTexels;

const int kMapPieces = 28;  // of a part: texel of its first piece

struct ChannelMap {
    int search;
    int pieces;  // texel of the first piece
    vec4 grid;   // number of points, grid cells, where the grid begins, cells a unit of value
    vec4 low, high;  // the first 8 points' values
};

ChannelMap channelMap(int channel) {
    int part = int(texelFetch(mapTexels, 0)[channel]);
    return ChannelMap(kChannelSearch >> (2 * channel) & 3, part + kMapPieces, texelFetch(mapTexels, part),
                      texelFetch(mapTexels, part + 1), texelFetch(mapTexels, part + 2));
}

// Halves [range.x, range.y], which holds the piece of `value`; no loop, as llvmpipe counts them.
ivec2 halved(ChannelMap map, float value, ivec2 range) {
    int middle = (range.x + range.y + 1) >> 1;
    return value >= texelFetch(mapTexels, map.pieces + 3 * middle + 2).x
               ? ivec2(middle, range.y)
               : ivec2(range.x, max(middle - 1, range.x));
}

int pieceOf(ChannelMap map, float value) {
    if (map.search == 0 || map.search == 3) {
        ivec4 counts = ivec4(greaterThanEqual(vec4(value), map.low)) +
                       ivec4(greaterThanEqual(vec4(value), map.high));
        return counts.x + counts.y + counts.z + counts.w;
    }
    ivec2 range = ivec2(0, int(map.grid.x));
    if (map.search == 1) {
        float cell = clamp((value - map.grid.z) * map.grid.w, 0.0, map.grid.y - 1.0);
        range = ivec2(texelFetch(mapTexels, map.pieces + 3 + 3 * int(map.grid.x) + int(cell)).xy);
    } else {
        range = halved(map, value, halved(map, value, halved(map, value, range)));
        range = halved(map, value, halved(map, value, halved(map, value, range)));
        range = halved(map, value, halved(map, value, halved(map, value, range)));
    }
    return halved(map, value, halved(map, value, range)).x;
}

vec4 matterOf(ChannelMap map, float value) {
    int texel = map.pieces + 3 * pieceOf(map, value);
    float from = texelFetch(mapTexels, texel + 2).x;
    vec4 matter = texelFetch(mapTexels, texel) + (value - from) * texelFetch(mapTexels, texel + 1);
    return vec4(matter.rgb, max(matter.a, 0.0));
}

// Whether no value from `low` to `high` has extinction.
bool transparentBetween(ChannelMap map, float low, float high) {
    return high < texelFetch(mapTexels, map.pieces + 3 * pieceOf(map, low) + 2).y;
}
