#version 330 core
// A box with round or sharp corners in its own frame, filled and outlined; lines are narrow boxes.
// Text is a mask of coverages; everything else points at the store's first byte, which is 255.
flat in vec4 frame;   // centre, direction of the axis
flat in vec4 box;     // half size, corner radius, half line width
flat in ivec4 data;   // mask: index of pixel (0, 0), step to the right, step down
flat in vec4 fill;
flat in vec4 stroke;
uniform samplerBuffer masks;
out vec4 color;       // premultiplied

// Share of the pixel around q >= 0 that a sharp box covers; exact if the box is axis-aligned.
float sharp(vec2 q, vec2 half_size) {
  // On each axis the pixel reaches from q - 0.5 to q + 0.5, the box to half_size.
  vec2 o = max(min(half_size - q + 0.5, min(2.0 * half_size, 1.0)), 0.0);
  return o.x * o.y;
}

void main() {
  vec2 p = gl_FragCoord.xy - frame.xy;
  vec2 q = abs(vec2(dot(p, frame.zw), p.y * frame.z - p.x * frame.w));
  float line = box.w;
  float radius = box.z;
  vec2 corner = q - box.xy + radius;
  float d = length(max(corner, 0.0)) + min(max(corner.x, corner.y), 0.0) - radius;
  // Of two parallel edges closer than a pixel each takes away its part.
  vec2 hi = clamp(vec2(0.5, 0.5 + line) - d, 0.0, 1.0);
  vec2 lo = clamp(vec2(0.5 - 2.0 * min(box.x, box.y), 0.5 - line) - d, 0.0, 1.0);
  vec2 cover = hi - lo;
  if (radius == 0.0)
    cover = vec2(sharp(q, box.xy), sharp(q, box.xy + line) - sharp(q, box.xy - line));
  ivec2 at = ivec2(gl_FragCoord.xy);
  float mask = texelFetch(masks, data.x + at.x * data.y + at.y * data.z).r;
  float f = fill.a * cover.x * mask;
  float s = stroke.a * cover.y;
  color = vec4(stroke.rgb, 1.0) * s + vec4(fill.rgb, 1.0) * (f * (1.0 - s));
}
