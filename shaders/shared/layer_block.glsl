// What a pass needs to know of the camera and of one layer; read by C++ (after `using glm::mat4;
// using glm::vec4;`) and by GLSL as an std140 block.
//
// "Data space" is the world translated by the dataset's f64 origin: world = origin + data. A ray
// starts on the plane of depth `planeDepth`, in front of all data of the scene (on the eye's own
// plane where the eye is inside), so that distances along it stay exact far away from the eye. Its
// start is the same point of the world for every layer. With u in [-1, 1] to the right and v in
// [-1, 1] upwards in the picture:
//   start     = rayStart + u rayStartRight + v rayStartUp            (data space)
//   direction = rayDirection + u rayDirectionRight + v rayDirectionUp (before normalisation)
struct LayerBlock {
    vec4 rayStart;           // w: planeDepth, the depth of all starts, world units, >= 0
    vec4 rayStartRight;
    vec4 rayStartUp;
    vec4 rayDirection;       // the view direction, of length 1; w: 1 perspective, 0 orthographic
    vec4 rayDirectionRight;  // 0 in an orthographic camera
    vec4 rayDirectionUp;
    vec4 viewport;           // width, height, 1 / width, 1 / height; pixels
    mat4 clipFromData;       // for triangles: reversed depth, 1 at the near plane, 0 far away
    mat4 gridFromData;       // voxels: grid point (i, j, k) has grid coordinates (i, j, k)
    vec4 grid;               // voxels: number of grid points along x, y, z; w: step, world units; of
                             // a mesh: the longest part that a sample of a user's code stands for
    vec4 surfaceColour;      // surface: linear RGB
    vec4 edge;               // wireframe: linear RGB, width in pixels
    vec4 gather;             // x: extinction scale, y: 2^exposure; interval of f: z: lowest, w: highest
    vec4 clipPlanes[6];      // data space: kept where dot(xyz, position) >= w
    vec4 light;              // data space: its place; w: 1, or 0 where it is at the eye
    vec4 sections;           // cross-sections: grid coordinates of where they meet; w: bit i: the one across axis i is shown
    vec4 reflection;         // of it: ambient, diffuse, specular, exponent
    vec4 jitter;             // voxels: x, y: lower and upper 16 bits of the seed
    vec4 shownLow;           // voxels: corners of the box outside of which nothing shows, grid coordinates,
    vec4 shownHigh;          // where rays pass over empty space; the first is above: nothing shows
};
