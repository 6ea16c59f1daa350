// Steps as long as the map allows. A step is three constant pieces, of the samples at its ends and in
// its middle, by Simpson's rule: 1/6, 4/6 and 1/6 of its length; exact where matter is a cubic of the
// way. How far the middle is from the mean of both ends tells what a step without it would be off by:
// where that is more than its share of kAdaptiveError over the whole ray the step is halved, where it
// is far less the next is doubled. What lies between three samples is not seen: steps are at most
// kLongestStep of the layer's.
// Constants: kSumsColour, kSumsExtinction: the model adds up one of them alone.
// Uses: classify, model.

const float kAdaptiveError = 1.0 / 255.0;
const float kLongestStep = 4.0;  // Of the layer's: by default two voxels, with a sample in each half.
const float kShortestStep = 0.25;

struct Sampled {
    float value;
    vec4 matter;  // none outside of the interval
    vec2 light;
};

Sampled sampledAt(Ray ray, March march, float at) {
    vec2 light;
    float value = litValueAt(ray, march, at, light);
    bool counts = !kInterval || (value >= layer.gather.z && value <= layer.gather.w);
    vec4 matter = matterAt(value, value);
    if (lacksValue(value)) counts = false;
    if (!counts) matter = vec4(0.0);
    return Sampled(value, matter, light);
}

// What a ray is off by at most if a length of `found` counts as `expected`.
float changeOf(vec4 found, vec4 expected, float extent) {
    vec4 off = abs(found - expected);
    float colour = max(off.r, max(off.g, off.b));
    if (kSumsColour) return layer.gather.y * colour * extent;
    if (kSumsExtinction) return layer.gather.x * off.a * extent;
    return (off.a + colour * max(found.a, expected.a)) * extent;
}

bool takeSample(inout RayState state, Sampled s, float extent, float at) {
    if (lacksValue(s.value)) return false;
    if (kInterval && (s.value < layer.gather.z || s.value > layer.gather.w)) return false;
    if (kShaded) pieceLight = s.light;
    Segment piece = sampledPiece(s.value, s.value, extent, at);
    return stepRay(state, piece) && kEarlyStop;
}

// How far what is to be passed over, or taken, at once goes on, world units.
float alikeFrom(RayState state, March march, float at, float reach, out bool shows) {
    if (kByDistance) {
        float empty = emptyFrom(positionAt(march, at), march.perGrid, shows);
        return shows ? reach : max(empty, 0.01 * march.dt);
    }
    shows = !skipsRange(state, rangeAround(positionAt(march, at + 0.5 * reach)));
    return reach;
}

RayState marchedAdaptively(Ray ray, March march) {
    RayState state = beginRay(ray);
    float at = distanceOf(march, float(march.first));
    float end = distanceOf(march, float(march.steps));
    if (!(at < end)) return state;
    float allowed = kAdaptiveError / max(march.extent, 1.0e-30);
    float shortest = kShortestStep * march.dt;
    float step = march.dt;
    vec3 way = abs(march.direction);
    float reach = 2.0 * float(kRangeReach) / max(way.x, max(way.y, way.z));
    Sampled front;
    bool finished = false;
    int rounds = kMaxRaySamples;
    bool jumped = true;
    do {
        float until = end;
        bool shows = true;
        if (kSkipBricks) {
            do {
                until = min(at + alikeFrom(state, march, at, reach, shows), end);
                jumped = jumped || !shows;
                at = shows ? at : until;
            } while (!shows && at < end);
        }
        if (jumped) front = sampledAt(ray, march, at);
        jumped = false;
        if (shows) {
            do {
                --rounds;
                // A rest that is no step of its own goes with this one.
                bool last = at + step + shortest > end;
                float extent = last ? end - at : step;
                Sampled middle = sampledAt(ray, march, at + 0.5 * extent);
                Sampled back = sampledAt(ray, march, at + extent);
                float off = changeOf(middle.matter, 0.5 * (front.matter + back.matter), extent);
                bool fine = off <= allowed * extent || extent <= 2.0 * shortest;
                if (fine) {
                    float sixth = extent * (1.0 / 6.0);
                    finished = takeSample(state, front, sixth, at);
                    if (!finished) finished = takeSample(state, middle, 4.0 * sixth, at + sixth);
                    if (!finished) finished = takeSample(state, back, sixth, at + 5.0 * sixth);
                    at = last ? end : at + extent;
                    front = back;
                }
                bool easy = fine && 16.0 * off <= allowed * extent;
                step = easy ? min(2.0 * step, kLongestStep * march.dt) : fine ? step : 0.5 * extent;
            } while (at < until && !finished && rounds > 0);
        }
    } while (at < end && !finished && rounds > 0);
    return state;
}
