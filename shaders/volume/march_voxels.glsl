// Nearest voxels are constant around their grid points: pieces from wall to wall are exact, whatever
// the layer's step.
// Uses: model.

RayState marchedByVoxels(Ray ray, March march) {
    RayState state = beginRay(ray);
    float at = distanceOf(march, float(march.first));
    float end = distanceOf(march, float(march.steps));
    ivec3 point = clamp(ivec3(floor(positionAt(march, at) + 0.5)), ivec3(0), lastPoint());
    ivec3 ahead = ivec3(sign(march.direction));
    bool finished = false;
    for (int rounds = kMaxRaySamples; rounds > 0 && !finished; --rounds) {
        vec3 walls = vec3(point) + 0.5 * vec3(ahead) - march.origin;
        vec3 way = mix(walls / march.direction, vec3(3.0e38), equal(ahead, ivec3(0)));
        float leave = min(way.x, min(way.y, way.z));
        float value = valueAt(vec3(point));
        bool counts = !kInterval || (value >= layer.gather.z && value <= layer.gather.w);
        if (lacksValue(value)) counts = false;
        float back = clamp(leave, at, end);
        Segment piece = sampledPiece(value, value, back - at, at);
        if (kShaded) litValueAt(ray, march, 0.5 * (at + back), pieceLight);
        if (counts) finished = stepRay(state, piece) && kEarlyStop;
        finished = finished || leave >= end;
        at = back;
        ivec3 next = way.x == leave ? ivec3(1, 0, 0) : way.y == leave ? ivec3(0, 1, 0) : ivec3(0, 0, 1);
        point = clamp(point + next * ahead, ivec3(0), lastPoint());
    }
    return state;
}
