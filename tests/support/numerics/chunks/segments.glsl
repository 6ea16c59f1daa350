// An evaluator without a mesh: the ray of each pixel has the segments that a buffer lists for it.
// rays: texels (first segment, number). segments: 2 texels each: front, back, extent, distance;
// 1 where it does not continue the one before. Answers: what endRay gives; hit distance and rounds.
layout(binding = 5) uniform samplerBuffer rays;
layout(binding = 6) uniform samplerBuffer segments;
layout(location = 0) out vec4 answer;
layout(location = 1) out vec4 detail;

const int kMostRounds = 60000;  // llvmpipe ends loops after 65,535

void main() {
    ivec2 ray = ivec2(texelFetch(rays, int(gl_FragCoord.x)).xy);
    RayState state = beginRay(Ray(vec3(0.0), vec3(0.0, 0.0, 1.0)));
    Segment rest = Segment(0.0, 0.0, 0.0, 0.0, -1.0, 0.0);
    int taken = 0;
    int rounds = 0;
    bool finished = false;
    while (!finished && rounds < kMostRounds && (rest.extent >= 0.0 || taken < ray.y)) {
        if (rest.extent < 0.0) {
            vec4 s = texelFetch(segments, 2 * (ray.x + taken));
            rest = Segment(s.x, s.y, s.x, s.y, s.z, s.w);
            if (texelFetch(segments, 2 * (ray.x + taken) + 1).x > 0.0) enterData(state, rest);
            ++taken;
            wholePieces = true;
        }
        finished = stepRay(state, rest);
        wholePieces = false;  // What could not be taken whole is taken in parts.
        ++rounds;
    }
    answer = endRay(state, 1.0);
    detail = vec4(hitDistance(state), float(rounds), 0.0, 0.0);
}
