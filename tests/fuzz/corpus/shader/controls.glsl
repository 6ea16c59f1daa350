// a comment /* with another
#uicontrol float gain slider(min=0, max=2, default=1)
#uicontrol vec3 tint color(default="red")
#uicontrol invlerp normalized(range=[0, 1])
float twice(float x) { return 2.0 * x; }
void main() {
    for (int i = 0; i < 3; ++i) { float y = twice(float(i)); }
    emitRGBA(vec4(tint * gain, normalized()));
}
