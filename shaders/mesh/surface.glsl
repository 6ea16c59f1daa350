// A boundary face under a pixel: how far it is, what of it counts, and how it is lit.
// Constants: kHeadlight; kInterval: only values in an interval count; kEdges: drawn over faces;
// kClipPlanes.
#include "lib/window.glsl"
#include "mesh/boundary_face.glsl"

layout(location = 0) in float vertexValue;

layout(location = 0) out vec4 colour;
layout(location = 1) out float distanceOut;

// The line through two corners a and b seen in the picture; x, y: in pixels from this pixel's
// centre, times w. Homogeneous, so that a corner behind the eye needs no clipping.
float pixelsFromLine(vec3 a, vec3 b) {
    vec3 line = cross(a, b);
    return abs(line.z) / max(length(line.xy), 1.0e-37);
}

vec3 besidePixel(vec3 position) {
    vec4 clip = layer.clipFromData * vec4(position, 1.0);
    vec2 pixels = 0.5 * layer.viewport.xy;
    return vec3((clip.xy - pictureFrom(gl_FragCoord.xy) * clip.w) * pixels, clip.w);
}

// 1 on an edge of the face, 0 away from it, between over the width of a pixel.
float edgeCover(vec3 a, vec3 b, vec3 c) {
    vec3 p = besidePixel(a);
    vec3 q = besidePixel(b);
    vec3 r = besidePixel(c);
    float away = min(pixelsFromLine(p, q), min(pixelsFromLine(q, r), pixelsFromLine(r, p)));
    return clamp(0.5 * layer.edge.w + 0.5 - away, 0.0, 1.0);
}

// Writes the distance along the pixel's ray, and `shade` under a light at the eye: c |n . w|.
void shadeFace(vec3 shade) {
    BoundaryFace face = boundaryFace(gl_PrimitiveID);
    Ray ray = rayThrough(gl_FragCoord.xy);
    vec3 a = positionOf(face.vertices.x);
    vec3 b = positionOf(face.vertices.y);
    vec3 c = positionOf(face.vertices.z);
    // Scaled, so that the product of two edges stays in range whatever the unit of the mesh.
    vec3 ab = b - a;
    vec3 ac = c - a;
    vec3 normal = cross(ab / max(length(ab), 1.0e-37), ac / max(length(ac), 1.0e-37));
    float slant = dot(normal, ray.direction);
    vec3 ends = vec3(dot(a - ray.origin, ray.direction), dot(b - ray.origin, ray.direction),
                     dot(c - ray.origin, ray.direction));
    float low = min(ends.x, min(ends.y, ends.z));
    float high = max(ends.x, max(ends.y, ends.z));
    float met = slant != 0.0 ? dot(normal, a - ray.origin) / slant : low;
    distanceOut = max(clamp(met, low, high), 0.0);
    Window window = clipped(Window(-kNoHit, kNoHit), ray);
    if (distanceOut < window.begin || distanceOut > window.end) discard;
    if (kInterval && (vertexValue < layer.gather.z || vertexValue > layer.gather.w)) discard;
    float size = length(normal);
    float light = kHeadlight ? (size > 0.0 ? abs(slant) / size : 0.0) : 1.0;
    vec3 lit = shade * light;
    colour = vec4(kEdges ? mix(lit, layer.edge.rgb, edgeCover(a, b, c)) : lit, 1.0);
}
