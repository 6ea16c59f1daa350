// A boundary face under a pixel: how far it is, and how it is lit. Constants: kHeadlight.
#include "lib/layer.glsl"
#include "mesh/boundary_face.glsl"

layout(location = 0) out vec4 colour;
layout(location = 1) out float distanceOut;

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
    float size = length(normal);
    float light = kHeadlight ? (size > 0.0 ? abs(slant) / size : 0.0) : 1.0;
    colour = vec4(shade * light, 1.0);
}
