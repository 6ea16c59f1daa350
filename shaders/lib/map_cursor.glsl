// Where a ray is in its layer's maps: the pieces that hold its values, and what they give there.
// Along a ray that goes on, the next piece is a neighbour of the last: nothing has to be searched.
// Constants: kMapSteps, kDensitySteps: the maps of f and g jump somewhere.
struct MapCursor {
    int piece;         // of f
    int densityPiece;  // of g; kTwoMaps
    vec4 matter;       // C(f), rho(g) at the front of what comes next
};

MapCursor noCursor() {
    return MapCursor(0, 0, vec4(0.0));
}

// To be called where values do not continue those before.
void placeCursor(inout MapCursor cursor, Segment piece) {
    cursor.piece = mapPiece(piece.front);
    if (kTwoMaps) cursor.densityPiece = densityPiece(piece.densityFront);
    cursor.matter = matterAt(piece.front, piece.densityFront);
}

// All of `rest` is taken; `matter` is what the maps give at its back.
void takeAll(inout MapCursor cursor, inout Segment rest, vec4 matter) {
    rest.extent = -1.0;
    cursor.matter = matter;
}

// The front part of a segment, in which both maps are linear.
struct LinearPart {
    vec4 first, last;  // C and rho at both ends
    float f, g;        // values at its back end
    float extent;      // world units
    bool all;          // it is all of the segment
    ivec2 turn;        // the piece that comes next in each map: -1, 0 or 1 from this one
};

int stepTowards(float from, float to) {
    return to > from ? 1 : -1;
}

// The share of a segment up to where a value is `bend`.
float shareUpTo(float bend, float front, float back) {
    return clamp((bend - front) / (back - front), 0.0, 1.0);
}

LinearPart linearPart(MapCursor cursor, Segment rest) {
    LinearPart part;
    part.first = cursor.matter;
    // Beyond a step the map begins anew.
    if (kMapSteps) part.first = mapValue(cursor.piece, rest.front);
    if (kTwoMaps && (kMapSteps || kDensitySteps)) {
        part.first.a = densityValue(cursor.densityPiece, rest.densityFront).a;
    }
    if (kMapSteps || kDensitySteps) part.first.a = max(part.first.a, 0.0);
    part.f = mapBend(cursor.piece, rest.front, rest.back);
    part.g = rest.densityBack;
    part.all = part.f == rest.back;
    float share = part.all ? 1.0 : shareUpTo(part.f, rest.front, rest.back);
    part.turn = ivec2(part.all ? 0 : stepTowards(part.f, rest.back), 0);
    if (kTwoMaps) {
        float g = densityBend(cursor.densityPiece, rest.densityFront, rest.densityBack);
        bool whole = g == rest.densityBack;
        float other = whole ? 1.0 : shareUpTo(g, rest.densityFront, rest.densityBack);
        // The map that bends first decides; where both do, both go on.
        bool second = !whole && (part.all || other < share);
        bool both = !whole && !part.all && other == share;
        part.turn.y = second || both ? stepTowards(g, rest.densityBack) : 0;
        part.g = second || both || (whole && part.all)
                     ? g : mix(rest.densityFront, rest.densityBack, share);
        if (second) part.turn.x = 0;
        if (second) part.f = mix(rest.front, rest.back, other);
        share = second ? other : share;
        part.all = part.all && whole;
    }
    part.last = mapValue(cursor.piece, part.f);
    if (kTwoMaps) part.last.a = densityValue(cursor.densityPiece, part.g).a;
    part.last.a = max(part.last.a, 0.0);
    part.extent = part.all ? rest.extent : rest.extent * share;
    return part;
}

// Only the front `share` of `part`; the segment goes on in the same pieces.
void shorten(inout LinearPart part, Segment rest, float share) {
    part.f = mix(rest.front, part.f, share);
    part.g = mix(rest.densityFront, part.g, share);
    part.last = mix(part.first, part.last, share);
    part.extent *= share;
    part.all = false;
    part.turn = ivec2(0);
}

// Takes `part` off the front of `rest`.
void takePart(inout MapCursor cursor, inout Segment rest, LinearPart part) {
    rest.front = part.f;
    if (kTwoMaps) rest.densityFront = part.g;
    rest.distance += part.extent;
    rest.extent = part.all ? -1.0 : max(rest.extent - part.extent, 0.0);
    cursor.piece += part.turn.x;
    if (kTwoMaps) cursor.densityPiece += part.turn.y;
    cursor.matter = part.last;
}
