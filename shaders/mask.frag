#version 330 core
// Text and polygons: coverages from the store, in one colour.
flat in ivec4 data;   // index of pixel (0, 0), step to the right, step down
flat in vec4 fill;
uniform samplerBuffer masks;
out vec4 color;       // premultiplied

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  color = fill * texelFetch(masks, data.x + at.x * data.y + at.y * data.z).r;
}
