// The levels of isosurfaces, ascending, and their colours. Section `levels` of the map's texels: a
// texel a level: x: its value, yzw: its colour.
// A segment meets level c where (front < c) != (back < c): of two cells at a face on the level
// exactly one does.
// Uses: classify.

vec4 levelAt(int index) {
    return texelFetch(mapTexels, int(mapSections.y) + index);
}

// Of the isosurface of a level: the level's own, or that of g there.
vec3 levelColour(int index, float g) {
    return kTwoMaps ? densityColour(g) : levelAt(index).yzw;
}

int levelCount() {
    return int(mapExtras.x);
}

// Where a ray is among the levels; `below` and `above` are those next to its value.
struct LevelCursor {
    int index;  // number of levels that are not above the value
    float below, above;
};

// At most kMaxLevels = 256: 8 halvings, without a loop.
int levelsUpTo(float value) {
    int index = 0;
    int last = levelCount();
    for (int width = 256; width > 0; width >>= 1) {
        int probe = index + width;
        if (probe <= last && value >= levelAt(probe - 1).x) index = probe;
    }
    return index;
}

LevelCursor placeAmongLevels(float value) {
    int index = levelsUpTo(value);
    return LevelCursor(index, index > 0 ? levelAt(index - 1).x : -3.4e38,
                       index < levelCount() ? levelAt(index).x : 3.4e38);
}

struct LevelHit {
    bool met;
    int index;    // of the level
    float share;  // of the segment's extent, from its front
    float value;
};

LevelHit firstLevel(LevelCursor cursor, Segment piece) {
    bool rises = piece.back >= cursor.above;
    bool falls = piece.back < cursor.below;
    float value = rises ? cursor.above : cursor.below;
    bool met = rises || falls;
    float share = met ? clamp((value - piece.front) / (piece.back - piece.front), 0.0, 1.0) : 1.0;
    return LevelHit(met, rises ? cursor.index : cursor.index - 1, share, value);
}
