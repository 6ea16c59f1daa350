// Polygons in which planes across the view cut a box, front to back.
//
// A plane meets a box in a polygon of 3 to 6 corners. From the nearest corner three ways along edges
// lead to the farthest, none with an edge of another; each plane meets each way once. Between two of
// the ways lies one edge more, which it may meet. Taken in turn, these six points go around the
// polygon; the point of an edge that is not met falls on the one before it.
// Source: C. Rezk-Salama and A. Kolb, A Vertex Program for Efficient Box-Plane Intersection, Vision,
// Modeling and Visualization 2005.
// Constants: kInstances: a slice is an instance; otherwise it is the next 12 vertices.
#include "lib/layer_uniforms.glsl"
#include "volume/slice_block.glsl"

layout(location = 0) flat out float planeDistance;  // behind where rays start, along the view

const float kTiny = 1.0e-30;

float rise(int axis) {
    return slices.edges[axis].w;
}

// Shares of the edges where a plane that is `height` behind the nearest corner meets the way along
// axes i, j, k.
vec3 onWay(int i, int j, int k, float height) {
    vec3 shares;
    shares[i] = clamp(height / max(rise(i), kTiny), 0.0, 1.0);
    shares[j] = clamp((height - rise(i)) / max(rise(j), kTiny), 0.0, 1.0);
    shares[k] = clamp((height - rise(i) - rise(j)) / max(rise(k), kTiny), 0.0, 1.0);
    return shares;
}

// The same on the edge along k that begins where the edge along i ends.
vec3 onEdgeBetween(int i, int j, int k, float height) {
    float share = (height - rise(i)) / max(rise(k), kTiny);
    if (!(share >= 0.0 && share <= 1.0)) return onWay(i, j, k, height);
    vec3 shares = vec3(0.0);
    shares[i] = 1.0;
    shares[k] = share;
    return shares;
}

vec3 cornerOf(int corner, float height) {
    if (corner == 0) return onWay(0, 1, 2, height);
    if (corner == 1) return onEdgeBetween(0, 1, 2, height);
    if (corner == 2) return onWay(2, 0, 1, height);
    if (corner == 3) return onEdgeBetween(2, 0, 1, height);
    if (corner == 4) return onWay(1, 2, 0, height);
    return onEdgeBetween(1, 2, 0, height);
}

void main() {
    int slice = kInstances ? gl_InstanceID : gl_VertexID / 12;
    int vertex = gl_VertexID % 12;
    // A fan of four triangles.
    int corner = vertex % 3 == 0 ? 0 : vertex / 3 + vertex % 3;
    planeDistance = slices.planes.x + float(slice) * slices.planes.y;
    vec3 shares = cornerOf(corner, planeDistance - slices.planes.z);
    vec3 position = slices.corner.xyz + shares.x * slices.edges[0].xyz +
                    shares.y * slices.edges[1].xyz + shares.z * slices.edges[2].xyz;
    gl_Position = layer.clipFromData * vec4(position, 1.0);
}
