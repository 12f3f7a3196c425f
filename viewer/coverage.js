// SPDX-License-Identifier: GPL-3.0-or-later
//
// Many thin lines or small dots of one color on a 2D context. Where the context has no graphics card,
// its own paths take several times as long as to find the covered share of each pixel here and to draw
// that as one image. Lines are one pixel wide and shared between the two nearest pixels at each step
// (Wu, An efficient antialiasing technique, SIGGRAPH 1991).
'use strict';

class Coverage {
  constructor() {
    this.canvas = document.createElement('canvas');
    this.context = this.canvas.getContext('2d', {willReadFrequently: true});
    this.image = null;
    this.bytes = this.words = null;
    this.columns = this.rows = 0;
  }

  /** Begins an image of so many pixels, in which nothing is covered. */
  begin(columns, rows, color) {
    if (this.image === null || this.columns !== columns || this.rows !== rows) {
      this.columns = this.canvas.width = columns;
      this.rows = this.canvas.height = rows;
      this.image = this.context.createImageData(columns, rows);
      this.bytes = this.image.data;
      this.words = new Uint32Array(this.bytes.buffer);
    }
    const [red, green, blue] = parseColor(color);
    const pixel = Uint8Array.of(255 * red + 0.5, 255 * green + 0.5, 255 * blue + 0.5, 0);
    this.words.fill(new Uint32Array(pixel.buffer)[0]);
  }

  /** Adds a line between two places in pixels; `strength` of 256 is one that covers. */
  line(x0, y0, x1, y1, strength) {
    const dx = x1 - x0, dy = y1 - y0;
    if (Math.abs(dx) >= Math.abs(dy)) {
      if (dx >= 0) this.walk(x0, y0, x1, dy / dx, this.columns, this.rows, 4, 4 * this.columns, strength);
      else this.walk(x1, y1, x0, dy / dx, this.columns, this.rows, 4, 4 * this.columns, strength);
    } else if (dy >= 0) {
      this.walk(y0, x0, y1, dx / dy, this.rows, this.columns, 4 * this.columns, 4, strength);
    } else {
      this.walk(y1, x1, y0, dx / dy, this.rows, this.columns, 4 * this.columns, 4, strength);
    }
  }

  /** From `first` to `last` along one axis, on which the picture has `most` pixels; `place` is on the other
   * axis at the first one, with `others` pixels. Steps are in bytes. */
  walk(first, place, last, slope, most, others, step, otherStep, strength) {
    const {bytes} = this;
    const begin = Math.max(Math.round(first), 0), end = Math.min(Math.round(last), most);
    let across = place + (begin + 0.5 - first) * slope - 0.5;
    for (let i = begin, at = begin * step + 3; i < end; ++i, at += step, across += slope) {
      const lower = Math.floor(across);
      if (lower < 0 || lower >= others - 1) continue;
      const upperShare = Math.floor((across - lower) * strength);
      const k = at + lower * otherStep, alpha = bytes[k], next = bytes[k + otherStep];
      bytes[k] = alpha + ((255 - alpha) * (strength - upperShare) >> 8);
      bytes[k + otherStep] = next + ((255 - next) * upperShare >> 8);
    }
  }

  /** Adds a dot of a radius of about a pixel or less, shared between the four nearest pixels. */
  dot(x, y, radius) {
    const column = Math.floor(x - 0.5), row = Math.floor(y - 0.5);
    if (column < 0 || row < 0 || column >= this.columns - 1 || row >= this.rows - 1) return;
    const right = x - 0.5 - column, below = y - 0.5 - row, area = 256 * Math.PI * radius * radius;
    const k = 4 * (row * this.columns + column) + 3, next = k + 4 * this.columns;
    this.cover(k, area * (1 - right) * (1 - below));
    this.cover(k + 4, area * right * (1 - below));
    this.cover(next, area * (1 - right) * below);
    this.cover(next + 4, area * right * below);
  }

  cover(k, share) {
    const alpha = this.bytes[k];
    this.bytes[k] = alpha + ((255 - alpha) * Math.min(share, 256) >> 8);
  }

  /** Draws the image on a context of the same size. */
  drawOn(context, alpha) {
    this.context.putImageData(this.image, 0, 0);
    context.save();
    context.resetTransform();
    context.globalAlpha = alpha;
    context.drawImage(this.canvas, 0, 0);
    context.restore();
  }
}
