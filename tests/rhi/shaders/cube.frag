#version 460
layout(set = 0, binding = 0) uniform textureCube image;
layout(set = 0, binding = 1) uniform sampler nearest;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
void main() {
    int face = int(gl_FragCoord.x);
    vec3 d = vec3(0);
    d[face >> 1] = (face & 1) == 0 ? 1.0 : -1.0;
    color = texture(samplerCube(image, nearest), d);
}
