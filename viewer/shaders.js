// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shaders of webgl_painter.js, in GLSL ES 3.00. Each item is an instance of a square, or of a
// triangle; the edges of lines and circles are smoothed over one pixel of the display. Colors leave
// a shader multiplied by their alpha.
'use strict';

const SHADER_HEAD = `#version 300 es
precision highp float;
uniform vec2 size;    // of the picture, in CSS pixels
uniform float pixel;  // of the display, in CSS pixels
uniform vec4 color, stroke;
uniform float width;
uniform vec2 dash;    // length and gap; the length 0: no dashes
uniform bool hasShades;
`;
const TO_SCREEN = `
vec4 onScreen(vec2 place) {
  return vec4(2.0 * place.x / size.x - 1.0, 1.0 - 2.0 * place.y / size.y, 0.0, 1.0);
}
`;

const LINE_SHADERS = {
  vertex: `${SHADER_HEAD}${TO_SCREEN}
in vec4 item, shade;
flat out vec4 paint;
flat out float halfLength;
out vec2 at;  // along the line from its middle, and across
uniform bool isRound;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  vec2 run = item.zw - item.xy;
  float length_ = max(length(run), 1e-6);
  vec2 along = run / length_, across = vec2(-along.y, along.x);
  float half_ = width / 2.0;
  halfLength = length_ / 2.0;
  at = corner * vec2(halfLength + (isRound ? half_ : 0.0) + pixel, half_ + pixel);
  gl_Position = onScreen((item.xy + item.zw) / 2.0 + along * at.x + across * at.y);
  paint = hasShades ? vec4(shade.rgb, shade.a * color.a) : color;
}`,
  fragment: `${SHADER_HEAD}
flat in vec4 paint;
flat in float halfLength;
in vec2 at;
out vec4 result;
uniform bool isRound;
void main() {
  float beyond = abs(at.x) - halfLength;
  float distance_ = isRound && beyond > 0.0 ? length(vec2(beyond, at.y)) : abs(at.y);
  float cover = clamp((width / 2.0 - distance_) / pixel + 0.5, 0.0, 1.0);
  if (!isRound) cover *= clamp(0.5 - beyond / pixel, 0.0, 1.0);
  cover = min(cover, width / pixel);
  if (dash.x > 0.0 && mod(at.x + halfLength, dash.x + dash.y) > dash.x) cover = 0.0;
  result = vec4(paint.rgb, 1.0) * paint.a * cover;
}`,
};

const CIRCLE_SHADERS = {
  vertex: `${SHADER_HEAD}${TO_SCREEN}
in vec3 item;
in vec4 shade;
flat out vec4 paint;
flat out float radius;
out vec2 at;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  radius = item.z;
  at = corner * (radius + width / 2.0 + pixel);
  gl_Position = onScreen(item.xy + at);
  paint = hasShades ? vec4(shade.rgb, shade.a * color.a) : color;
}`,
  fragment: `${SHADER_HEAD}
flat in vec4 paint;
flat in float radius;
in vec2 at;
out vec4 result;
void main() {
  float distance_ = length(at);
  float inside = clamp((radius - distance_) / pixel + 0.5, 0.0, 1.0) * min(1.0, 2.0 * radius / pixel);
  result = vec4(paint.rgb, 1.0) * paint.a * inside;
  float ring = clamp((width / 2.0 - abs(distance_ - radius)) / pixel + 0.5, 0.0, 1.0);
  if (dash.x > 0.0 && mod(atan(at.y, at.x) * radius, dash.x + dash.y) > dash.x) ring = 0.0;
  float over = stroke.a * ring;
  result = result * (1.0 - over) + vec4(stroke.rgb, 1.0) * over;
}`,
};

const TRIANGLE_SHADERS = {
  vertex: `${SHADER_HEAD}${TO_SCREEN}
in vec4 item, shade;
in vec2 third;
flat out vec4 paint;
void main() {
  gl_Position = onScreen(gl_VertexID == 0 ? item.xy : gl_VertexID == 1 ? item.zw : third);
  paint = hasShades ? vec4(shade.rgb, shade.a * color.a) : color;
}`,
  fragment: `${SHADER_HEAD}
flat in vec4 paint;
out vec4 result;
void main() {
  result = vec4(paint.rgb, 1.0) * paint.a;
}`,
};
