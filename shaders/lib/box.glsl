// Where origin + t direction is inside the box [low, high]: x enters, y leaves; x > y: never.
// An axis along which the direction is 0 is decided by the origin alone: 0 / 0 is never made.
vec2 boxSpan(vec3 origin, vec3 direction, vec3 low, vec3 high) {
    vec2 span = vec2(-3.0e38, 3.0e38);
    for (int axis = 0; axis < 3; ++axis) {
        float a = low[axis] - origin[axis], b = high[axis] - origin[axis];
        float d = direction[axis];
        if (d == 0.0) {
            if (a > 0.0 || b < 0.0) return vec2(1.0, -1.0);
        } else {
            span = vec2(max(span.x, min(a / d, b / d)), min(span.y, max(a / d, b / d)));
        }
    }
    return span;
}
