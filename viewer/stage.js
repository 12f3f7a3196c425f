// SPDX-License-Identifier: GPL-3.0-or-later
//
// The two canvases of the picture. Where there is a graphics card, WebGL draws on the lower one, and
// the upper one has the texts. Elsewhere the upper one has everything: browsers emulate WebGL without
// a card, but a 2D context is then several times faster (bench/README.md).
'use strict';

class Stage {
  constructor() {
    this.canvas = element('picture');
    this.glCanvas = element('scene');
    this.canvasPainter = new CanvasPainter(this.canvas.getContext('2d'));
    this.webglPainter = null;
    this.width = this.height = this.ratio = 1;
    this.choose('auto');
    this.glCanvas.addEventListener('webglcontextlost', () => this.choose('canvas'));
  }

  /** Draws with 'webgl', 'canvas', or by 'auto' with the faster one. Returns whether that is possible. */
  choose(way) {
    if (way !== 'canvas' && this.webglPainter === null) this.start(way === 'webgl');
    const usesWebGL = way !== 'canvas' && this.webglPainter !== null;
    this.painter = usesWebGL ? this.webglPainter : this.canvasPainter;
    this.glCanvas.hidden = !usesWebGL;
    return way !== 'webgl' || usesWebGL;
  }

  start(isEmulationWelcome) {
    const gl = this.glCanvas.getContext('webgl2', {
      alpha: false, antialias: false, depth: false, stencil: false,
      failIfMajorPerformanceCaveat: !isEmulationWelcome,
    });
    if (gl === null || !isEmulationWelcome && isEmulated(gl)) return;
    try {
      this.webglPainter = new WebGLPainter(gl, this.canvasPainter);
    } catch (error) {
      console.info(`Kinetri draws without WebGL: ${error.message}`);
    }
  }

  resize(width, height) {
    this.width = width;
    this.height = height;
  }

  /** Draws what `view` has. */
  draw(view, background) {
    const {width, height} = this;
    // The wave is drawn triangle by triangle, which batches cannot do.
    const painter = view.usesContext ? this.canvasPainter : this.painter;
    this.glCanvas.hidden = painter !== this.webglPainter;
    sizedContext(this.canvas, width, height);
    this.ratio = this.canvas.width / Math.max(width, 1);
    if (painter === this.webglPainter) {
      this.glCanvas.width = this.canvas.width;
      this.glCanvas.height = this.canvas.height;
    }
    painter.begin(width, height, this.ratio, background);
    view.draw(painter);
    painter.end();
  }
}

/** Whether WebGL is emulated without a graphics card. Not all browsers take that for the major caveat
 * that it is. */
function isEmulated(gl) {
  const names = gl.getExtension('WEBGL_debug_renderer_info');
  const name = gl.getParameter(names === null ? gl.RENDERER : names.UNMASKED_RENDERER_WEBGL);
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
