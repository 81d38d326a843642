#version 330 core
// One quad of an instance. Pixels, y down from the upper left corner: the framebuffer's first row is
// the picture's top, so what is read back needs no flipping.
layout(location = 0) in vec4 quad_in;    // first corner, size along the axis and across it
layout(location = 1) in vec4 frame_in;   // centre of the shape, direction of its axis
layout(location = 2) in vec4 box_in;     // half size, corner radius, half line width
layout(location = 3) in ivec4 data_in;   // see the fragment shaders; last, 1 if the quad is level
layout(location = 4) in vec4 fill_in;
layout(location = 5) in vec4 stroke_in;
uniform vec2 to_clip;                    // 2 / size of the image in pixels

// All flat: interpolation rounds differently from one CPU to the next, constants do not.
flat out vec4 frame;
flat out vec4 box;
flat out ivec4 data;
flat out vec4 fill;
flat out vec4 stroke;

void main() {
  vec2 along = data_in.w == 1 ? vec2(1.0, 0.0) : frame_in.zw;
  vec2 across = vec2(-along.y, along.x);
  float u = float(gl_VertexID & 1) * quad_in.z;
  float v = float(gl_VertexID >> 1) * quad_in.w;
  gl_Position = vec4((quad_in.xy + along * u + across * v) * to_clip - 1.0, 0.0, 1.0);
  frame = frame_in;
  box = box_in;
  data = data_in;
  fill = fill_in;
  stroke = stroke_in;
}
