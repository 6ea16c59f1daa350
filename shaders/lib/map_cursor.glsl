// Where a ray is in its layer's maps. Along a ray that goes on, the next piece of a map is a neighbour
// of the last: nothing has to be searched.
struct MapCursor {
    MapPiece piece;         // of f
    MapPiece densityPiece;  // of g; kTwoMaps
    vec4 matter;            // C(f), rho(g) at the front of what comes next
};

MapCursor noCursor() {
    MapPiece none = MapPiece(0, vec4(0.0), vec4(0.0), 0.0, 0.0, 0.0);
    return MapCursor(none, none, vec4(0.0));
}

// To be called where values do not continue those before.
void placeCursor(inout MapCursor cursor, Segment piece) {
    cursor.piece = fetchPiece(kMapPieces, pointsUpTo(piece.front));
    if (kTwoMaps) {
        cursor.densityPiece = fetchPiece(densityPieces(), densityPointsUpTo(piece.densityFront));
    }
    cursor.matter = matterAt(piece.front, piece.densityFront);
}

// All of `rest` is taken; `matter` is what the maps give at its back.
void takeAll(inout MapCursor cursor, inout Segment rest, vec4 matter) {
    rest.extent = -1.0;
    cursor.matter = matter;
}

// C(f) and rho(g) of values in the cursor's pieces.
vec4 matterIn(MapCursor cursor, float f, float g) {
    vec4 matter = valueIn(cursor.piece, f);
    if (kTwoMaps) matter.a = valueIn(cursor.densityPiece, g).a;
    return vec4(matter.rgb, max(matter.a, 0.0));
}

bool holds(MapPiece piece, float value) {
    return value >= piece.low && value <= piece.high;
}

// Both maps are linear on all of a segment.
bool isLinear(MapCursor cursor, Segment rest) {
    return holds(cursor.piece, rest.back) &&
           (!kTwoMaps || holds(cursor.densityPiece, rest.densityBack));
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
    part.first = matterIn(cursor, rest.front, rest.densityFront);
    part.f = clamp(rest.back, cursor.piece.low, cursor.piece.high);
    part.g = rest.densityBack;
    part.all = part.f == rest.back;
    float share = part.all ? 1.0 : shareUpTo(part.f, rest.front, rest.back);
    part.turn = ivec2(part.all ? 0 : stepTowards(part.f, rest.back), 0);
    if (kTwoMaps) {
        float g = clamp(rest.densityBack, cursor.densityPiece.low, cursor.densityPiece.high);
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
    part.last = matterIn(cursor, part.f, part.g);
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
    cursor.piece = fetchPiece(kMapPieces, cursor.piece.index + part.turn.x);
    if (!kTwoMaps) return;
    cursor.densityPiece = fetchPiece(densityPieces(), cursor.densityPiece.index + part.turn.y);
}
