// SPDX-License-Identifier: GPL-3.0-or-later
//
// Many thin lines or small dots of one color on a 2D context. Where the context has no graphics card,
// its own paths take several times as long as to find the covered share of each pixel here and to draw
// that as one image. Lines are one pixel wide and shared between the two nearest pixels at each step
// (Wu, An efficient antialiasing technique, SIGGRAPH 1991).
//
// A pixel is a byte, its depth d: the share exp(-d / DEPTH) of what is behind it is seen. What lies over
// each other adds its depths.
'use strict';

const DEPTH = 255 / Math.log(256);  // 255: nothing behind it is seen, as far as 8 bits can tell
const MARGIN = 2;                   // pixels about the part that is drawn, so that steps need no check
const TILE = 64;                    // pixels; the part's size is so many, so that it rarely changes
const DEPTH_OF_SHARE = Uint8Array.from({length: 257}, (_, i) =>  // of 256ths
  Math.round(DEPTH * -Math.log(1 - Math.min(i, 255) / 256)));

class Coverage {
  constructor() {
    this.canvas = document.createElement('canvas');
    this.context = this.canvas.getContext('2d', {willReadFrequently: true});
    this.depths = new Uint8ClampedArray(0);
    this.depthOf = new Uint8Array(257);  // of a share of a line, in 256ths
    this.words = new Uint32Array(256);   // the pixels of the depths
    this.pixels = new Uint32Array(0);
    this.image = null;
    this.left = this.top = this.width = this.height = this.stride = 0;
  }

  /** Begins the part of a picture of so many pixels that the places in `data`, pairs of coordinates
   * that are `step` apart, may cover. Returns whether there is any. */
  begin(columns, rows, data, count, step, ratio) {
    let left = Infinity, top = Infinity, right = -Infinity, bottom = -Infinity;
    for (let at = 0; at < count; at += step) {
      const x = data[at], y = data[at + 1];
      if (x < left) left = x;
      if (x > right) right = x;
      if (y < top) top = y;
      if (y > bottom) bottom = y;
    }
    if (!(right >= 0 && bottom >= 0 && ratio * left <= columns && ratio * top <= rows)) return false;
    const tiles = (pixels) => TILE * Math.ceil(pixels / TILE);
    this.left = TILE * Math.floor(Math.max(ratio * left, 0) / TILE);
    this.top = TILE * Math.floor(Math.max(ratio * top, 0) / TILE);
    this.width = tiles(Math.min(ratio * right, columns) - this.left);
    this.height = tiles(Math.min(ratio * bottom, rows) - this.top);
    this.stride = this.width + 2 * MARGIN;
    const size = this.stride * (this.height + 2 * MARGIN);
    if (this.depths.length < size) this.depths = new Uint8ClampedArray(2 * size);
    this.depths.fill(0, 0, size);
    return true;
  }

  /** Adds lines, four coordinates each; `strength` of 1 is one that covers. */
  addLines(data, count, ratio, strength) {
    const {left, top, width, height, depthOf} = this;
    for (let i = 0; i <= 256; ++i) depthOf[i] = DEPTH_OF_SHARE[Math.round(strength * i)];
    for (let at = 0; at < 4 * count; at += 4) {
      let x0 = ratio * data[at] - left, y0 = ratio * data[at + 1] - top;
      let x1 = ratio * data[at + 2] - left, y1 = ratio * data[at + 3] - top;
      const isInside = x0 >= 0 && y0 >= 0 && x1 >= 0 && y1 >= 0 &&
        x0 <= width && y0 <= height && x1 <= width && y1 <= height;
      if (!isInside) {
        ENDS[0] = x0;
        ENDS[1] = y0;
        ENDS[2] = x1;
        ENDS[3] = y1;
        if (!clipSegment(ENDS, width, height, 0)) continue;
        [x0, y0, x1, y1] = ENDS;
      }
      const dx = x1 - x0, dy = y1 - y0;
      if (Math.abs(dx) >= Math.abs(dy)) {
        if (dx >= 0) this.walkRight(x0, y0, x1, dy / dx);
        else this.walkRight(x1, y1, x0, dy / dx);
      } else if (dy >= 0) {
        this.walkDown(y0, x0, y1, dx / dy);
      } else {
        this.walkDown(y1, x1, y0, dx / dy);
      }
    }
  }

  /** Walks along x, with y in 65536ths of a pixel. */
  walkRight(first, place, last, slope) {
    const {depths, depthOf, stride} = this;
    const begin = (first + (MARGIN + 0.5)) | 0, end = (last + (MARGIN + 0.5)) | 0;
    let y = (65536 * (place + (begin - MARGIN + 0.5 - first) * slope + (MARGIN - 0.5))) | 0;
    const step = (65536 * slope) | 0;
    for (let x = begin; x < end; ++x, y += step) {
      const at = (y >> 16) * stride + x, share = (y >> 8) & 255;
      depths[at] += depthOf[256 - share];
      depths[at + stride] += depthOf[share];
    }
  }

  /** The same along y. */
  walkDown(first, place, last, slope) {
    const {depths, depthOf, stride} = this;
    const begin = (first + (MARGIN + 0.5)) | 0, end = (last + (MARGIN + 0.5)) | 0;
    let x = (65536 * (place + (begin - MARGIN + 0.5 - first) * slope + (MARGIN - 0.5))) | 0;
    const step = (65536 * slope) | 0;
    for (let y = begin, row = begin * stride; y < end; ++y, row += stride, x += step) {
      const at = row + (x >> 16), share = (x >> 8) & 255;
      depths[at] += depthOf[256 - share];
      depths[at + 1] += depthOf[share];
    }
  }

  /** Adds dots, `step` numbers each, of a radius of about a pixel or less: each is shared between the four
   * nearest pixels. */
  addDots(data, count, step, ratio, radius) {
    const {left, top, width, height, depths, stride} = this;
    const area = 256 * Math.PI * radius * radius;
    for (let i = 0, at = 0; i < count; ++i, at += step) {
      const x = ratio * data[at] - left, y = ratio * data[at + 1] - top;
      if (!(x >= 0 && y >= 0 && x <= width && y <= height)) continue;
      const px = x + (MARGIN - 0.5), py = y + (MARGIN - 0.5), column = px | 0, row = py | 0;
      const right = px - column, below = py - row, k = row * stride + column;
      const lower = area * below, upper = area - lower;
      depths[k] += DEPTH_OF_SHARE[Math.min(upper * (1 - right), 255) | 0];
      depths[k + 1] += DEPTH_OF_SHARE[Math.min(upper * right, 255) | 0];
      depths[k + stride] += DEPTH_OF_SHARE[Math.min(lower * (1 - right), 255) | 0];
      depths[k + stride + 1] += DEPTH_OF_SHARE[Math.min(lower * right, 255) | 0];
    }
  }

  /** Draws the part on the context of the picture, in the color. Where the picture is of the color
   * `background`, the result needs no blending; null: it may have anything. */
  drawOn(context, color, alpha, background) {
    const columns = this.stride, rows = this.height + 2 * MARGIN;
    if (this.image === null || this.image.width !== columns || this.image.height !== rows) {
      this.image = new ImageData(columns, rows);
      this.pixels = new Uint32Array(this.image.data.buffer);
    }
    this.setWords(parseColor(color), alpha, background === null ? null : parseColor(background));
    const {words, pixels, depths} = this;
    for (let i = 0; i < pixels.length; ++i) pixels[i] = words[depths[i]];
    const x = this.left - MARGIN, y = this.top - MARGIN;
    if (background !== null) {
      context.putImageData(this.image, x, y);
      return;
    }
    if (this.canvas.width < columns || this.canvas.height < rows) {
      this.canvas.width = columns;
      this.canvas.height = rows;
    }
    this.context.putImageData(this.image, 0, 0);
    context.save();
    context.resetTransform();
    context.globalAlpha = 1;
    context.drawImage(this.canvas, 0, 0, columns, rows, x, y, columns, rows);
    context.restore();
  }

  setWords([red, green, blue, opacity], alpha, background) {
    const bytes = new Uint8ClampedArray(this.words.buffer);
    for (let depth = 0; depth < 256; ++depth) {
      const share = opacity * alpha * (depth === 255 ? 1 : 1 - Math.exp(-depth / DEPTH));
      const over = background === null ? 1 : share;
      for (let k = 0; k < 3; ++k) {
        const behind = background === null ? 0 : background[k];
        bytes[4 * depth + k] = 255 * (behind + over * ([red, green, blue][k] - behind));
      }
      bytes[4 * depth + 3] = background === null ? 255 * share : 255;
    }
  }
}
