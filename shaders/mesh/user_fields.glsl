// What a user's code reads of a mesh at a sample in a cell: its layer's field and others. A sample stands
// for a part of the ray's piece in a cell that is no longer than the layer's step.
// Constants: kOtherFields, how many others there are, at most kMostOtherFields; kOtherAt1 to kOtherAt5: where their
// values sit. slotOf() is generated: 0 for the layer's field, 1 for the first of the others, and so on.
#include "contract/user_code.glsl"
#include "mesh/cell_exit.glsl"
#include "mesh/corner_values.glsl"
#include "mesh/walk_ray.glsl"

layout(binding = kOtherFieldUnit) uniform samplerBuffer otherFields[kMostOtherFields];

float ownValue;   // as it is stored
float ownDepth;

float sampleExtent(float extent) {
    return extent / max(ceil(extent / layer.grid.w), 1.0);
}

float placeSample(float value, float distance) {
    ownValue = value + codeHeader.y;
    ownDepth = distance / pieceScale;
    return ownValue;
}

// The value of a field at the sample: linear between where the ray enters the cell and where it leaves.
float fieldHere(samplerBuffer values, int valuesAt) {
    Walk end = pieceWalk;
    vec4 corners = cornerValues(values, valuesAt, end.left,
                                ivec4(end.a.id, end.b.id, end.c.id, end.behind.id));
    if (valuesAt == kValuesAtCells) return corners.x;
    OtherFace entry = otherFace(end.a, end.b, end.c, end.behind, end.weights);
    vec3 depths = onOther(entry, vec3(end.a.depth, end.b.depth, end.c.depth), end.behind.depth);
    float begin = meanOf(depths, entry.weights, end.depth);
    float back = meanOf(corners.xyz, end.weights, corners.x);
    float front = meanOf(onOther(entry, corners.xyz, corners.w), entry.weights, back);
    float extent = end.depth - begin;
    return extent > 0.0 ? mix(front, back, clamp((ownDepth - begin) / extent, 0.0, 1.0)) : front;
}

float valueHere(int channel) {
    int slot = slotOf(channel);
    if (kOtherFields > 0 && slot == 1) return fieldHere(otherFields[0], kOtherAt1);
    if (kOtherFields > 1 && slot == 2) return fieldHere(otherFields[1], kOtherAt2);
    if (kOtherFields > 2 && slot == 3) return fieldHere(otherFields[2], kOtherAt3);
    if (kOtherFields > 3 && slot == 4) return fieldHere(otherFields[3], kOtherAt4);
    if (kOtherFields > 4 && slot == 5) return fieldHere(otherFields[4], kOtherAt5);
    return ownValue;
}

float nearestValue(int channel) {
    return valueHere(channel);
}

float interpolatedValue(int channel) {
    return valueHere(channel);
}

float sampledValue(int channel) {
    return valueHere(channel);
}
