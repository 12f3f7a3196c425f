// SPDX-License-Identifier: GPL-3.0-or-later
//
// The painter of WebGL 2: items are instances, whose numbers are sent to the graphics card in each
// frame as they are in the batch. Texts are written on the canvas above, by the painter of its 2D
// context.
'use strict';

const UNIFORMS = ['size', 'pixel', 'color', 'stroke', 'width', 'dash', 'hasShades', 'isRound'];
const TRANSPARENT = [0, 0, 0, 0];

class WebGLPainter {
  /** Throws an Error where a shader does not compile. */
  constructor(gl, texts) {
    this.gl = gl;
    this.texts = texts;
    this.width = this.height = this.ratio = 1;
    this.colors = new Uint8Array(0);
    this.items = gl.createBuffer();
    this.shades = gl.createBuffer();
    this.lineProgram = this.program(LINE_SHADERS, LINE);
    this.circleProgram = this.program(CIRCLE_SHADERS, CIRCLE);
    this.triangleProgram = this.program(TRIANGLE_SHADERS, TRIANGLE);
  }

  program({vertex, fragment}, size) {
    const {gl} = this;
    const program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      throw new Error(`a shader does not compile: ${gl.getProgramInfoLog(program)}`);
    }
    const uniforms = {};
    for (const name of UNIFORMS) uniforms[name] = gl.getUniformLocation(program, name);
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const attribute = (name, numbers, type, isNormalized, stride, offset) => {
      const location = gl.getAttribLocation(program, name);
      if (location < 0) return;
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, numbers, type, isNormalized, stride, offset);
      gl.vertexAttribDivisor(location, 1);
    };
    gl.bindBuffer(gl.ARRAY_BUFFER, this.items);
    attribute('item', Math.min(size, 4), gl.FLOAT, false, 4 * size, 0);
    attribute('third', 2, gl.FLOAT, false, 4 * size, 16);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.shades);
    attribute('shade', 4, gl.UNSIGNED_BYTE, true, 0, 0);
    return {program, uniforms, array, size};
  }

  begin(width, height, ratio, background) {
    const {gl} = this;
    Object.assign(this, {width, height, ratio});
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    const [red, green, blue] = parseColor(background);
    gl.clearColor(red, green, blue, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.texts.context.clearRect(0, 0, width, height);
  }

  end() {
    this.gl.bindVertexArray(null);
  }

  lines(batch, style) {
    this.draw(this.lineProgram, batch, style, style.color, TRANSPARENT, 4);
  }

  circles(batch, style) {
    const stroke = style.stroke === undefined ? TRANSPARENT : parseColor(style.stroke);
    this.draw(this.circleProgram, batch, style, style.fill, stroke, 4);
  }

  triangles(batch, style) {
    this.draw(this.triangleProgram, batch, style, style.color, TRANSPARENT, 3);
  }

  draw({program, uniforms, array, size}, batch, style, color, stroke, corners) {
    const {gl} = this;
    const {alpha = 1, dash = NO_DASH, width = 1, palette = null} = style;
    if (batch.count === 0) return;
    gl.useProgram(program);
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.items);
    gl.bufferData(gl.ARRAY_BUFFER, batch.data, gl.STREAM_DRAW, 0, size * batch.count);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.shades);
    this.sendShades(batch, palette);
    const [red, green, blue, opacity] = palette !== null ? [0, 0, 0, 1] :
      color === undefined ? TRANSPARENT : parseColor(color);
    gl.uniform2f(uniforms.size, this.width, this.height);
    gl.uniform1f(uniforms.pixel, 1 / this.ratio);
    gl.uniform4f(uniforms.color, red, green, blue, opacity * alpha);
    gl.uniform4f(uniforms.stroke, stroke[0], stroke[1], stroke[2], stroke[3] * alpha);
    gl.uniform1f(uniforms.width, stroke === TRANSPARENT && size === CIRCLE ? 0 : width);
    gl.uniform2f(uniforms.dash, dash[0] ?? 0, dash[1] ?? 0);
    gl.uniform1i(uniforms.hasShades, palette === null ? 0 : 1);
    gl.uniform1i(uniforms.isRound, style.cap === 'round' ? 1 : 0);
    gl.drawArraysInstanced(corners === 3 ? gl.TRIANGLES : gl.TRIANGLE_STRIP, 0, corners, batch.count);
  }

  /** The colors of the items, four bytes each; without a palette, as many that nothing reads. */
  sendShades({shades, count}, palette) {
    const {gl} = this;
    if (this.colors.length < 4 * count) this.colors = new Uint8Array(8 * count);
    const {colors} = this;
    if (palette !== null) {
      const bytes = new Uint8Array(palette.flatMap((color) =>
        parseColor(color).map((part) => Math.round(255 * part))));
      for (let i = 0; i < count; ++i) {
        const from = 4 * shades[i];
        for (let k = 0; k < 4; ++k) colors[4 * i + k] = bytes[from + k];
      }
    }
    gl.bufferData(gl.ARRAY_BUFFER, colors, gl.STREAM_DRAW, 0, 4 * count);
  }

  text(text, x, y, style) {
    this.texts.text(text, x, y, style);
  }
}
