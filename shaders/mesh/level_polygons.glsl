// Where lines meet the triangle that a level cuts out of a cell; of all the nearest shows.
// Constants: kTwoMaps: coloured by g; kLit: under a light at the eye.
// Uses: classify.
#include "lib/depth.glsl"
#include "lib/levels.glsl"
#include "lib/window.glsl"
#include "mesh/face_mean.glsl"
#include "mesh/mesh.glsl"

layout(location = 0) flat in vec4 pointA;  // as in mesh/level_polygons.vert.glsl
layout(location = 1) flat in vec4 pointB;
layout(location = 2) flat in vec4 pointC;
layout(location = 3) flat in ivec4 edgesAB;
layout(location = 4) flat in ivec3 edgeC;
layout(location = 5) flat in vec3 gradient;

layout(location = 0) out vec4 colour;
layout(location = 1) out float distanceOut;

bool isFirst(ivec2 p, ivec2 q) {
    return p.x < q.x || (p.x == q.x && p.y < q.y);
}

// Areas beside the line, of which each weighs the corner opposite. False: the line does not meet
// the triangle.
bool meets(Sight sight, out vec3 weights) {
    vec2 a = beside(pointA.xyz, sight);
    vec2 b = beside(pointB.xyz, sight);
    vec2 c = beside(pointC.xyz, sight);
    vec3 areas = vec3(areaOf(b, c), areaOf(c, a), areaOf(a, b));
    bvec3 left = bvec3(isLeft(areas.x, b, c, isFirst(edgesAB.zw, edgeC.xy)),
                       isLeft(areas.y, c, a, isFirst(edgeC.xy, edgesAB.xy)),
                       isLeft(areas.z, a, b, isFirst(edgesAB.xy, edgesAB.zw)));
    weights = abs(areas);
    return all(left) || !any(left);
}

float facingOf(Sight sight) {
    vec3 along = vec3(sight.slope, 1.0);
    float length2 = dot(gradient, gradient) * dot(along, along);
    return length2 > 0.0 ? min(abs(dot(gradient, along)) * inversesqrt(length2), 1.0) : 0.0;
}

void main() {
    if (gl_HelperInvocation) return;
    Sight sight = sightThrough(pictureFrom(gl_FragCoord.xy));
    vec3 weights;
    if (!meets(sight, weights)) discard;
    vec3 depths = vec3(pointA.z, pointB.z, pointC.z);
    float depth = faceMean(depths, weights, min(depths.x, min(depths.y, depths.z)));
    distanceOut = depth * worldPerDepth(sight);
    Ray ray = rayThrough(gl_FragCoord.xy);
    Window window = windowOf(ray, gl_FragCoord.xy);
    if (distanceOut < window.begin || distanceOut > window.end) discard;
    float g = faceMean(vec3(pointA.w, pointB.w, pointC.w), weights, pointA.w);
    colour = vec4(levelColour(edgeC.z, g) * (kLit ? facingOf(sight) : 1.0), 1.0);
    gl_FragDepth = depthAt(ray, distanceOut);
}
