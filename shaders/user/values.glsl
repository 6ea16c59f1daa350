// Numbers of data as a user's code sees them: typed. Values between voxels keep their fraction, but for
// toRaw().
struct useruint8_t {
    float uservalue;
};

struct useruint16_t {
    float uservalue;
};

struct userint16_t {
    float uservalue;
};

uint toRaw(useruint8_t v) { return uint(v.uservalue + 0.5); }
uint toRaw(useruint16_t v) { return uint(v.uservalue + 0.5); }
int toRaw(userint16_t v) { return int(floor(v.uservalue + 0.5)); }
float toRaw(float v) { return v; }

float toNormalized(useruint8_t v) { return v.uservalue / 255.0; }
float toNormalized(useruint16_t v) { return v.uservalue / 65535.0; }
float toNormalized(userint16_t v) { return max(v.uservalue / 32767.0, -1.0); }
float toNormalized(float v) { return v; }

float valueOf(useruint8_t v) { return v.uservalue; }
float valueOf(useruint16_t v) { return v.uservalue; }
float valueOf(userint16_t v) { return v.uservalue; }
float valueOf(float v) { return v; }
