// SPDX-License-Identifier: GPL-3.0-or-later
//
// What all painters share. A painter draws lines, circles, triangles and texts; later ones cover
// earlier ones. There is one for WebGL 2 (webgl_painter.js) and one for a 2D context, which may also
// be one that writes SVG (canvas_painter.js, svg_context.js). Places and widths are in CSS pixels, y
// down. The contract:
//
//   begin(width, height, ratio, background)   `ratio`: pixels of the display per CSS pixel
//   lines(batch, style)       x0, y0, x1, y1 each; style: color, width, dash, cap
//   circles(batch, style)     x, y, radius each; style: fill, stroke, width, dash
//   triangles(batch, style)   three corners each; style: color
//   text(text, x, y, style)   style: color, halo, font, align
//   end()
//
// Colors are those of CSS. A style may also have an `alpha` from 0 to 1, and a `palette`, a list of
// colors: then each item has the color `palette[shade]` in the place of `color` or `fill`.
'use strict';

const LINE = 4, CIRCLE = 3, TRIANGLE = 6;  // numbers that an item takes
const NO_DASH = [];
const EMPTY_STYLE = {};

/** Items of one kind in typed arrays, which are kept from frame to frame and grow as needed. */
class Batch {
  constructor(size, room = 64) {
    this.size = size;
    this.count = 0;
    this.data = new Float32Array(size * room);
    this.shades = new Uint16Array(room);
  }

  clear() {
    this.count = 0;
    return this;
  }

  grow() {
    const data = new Float32Array(2 * this.data.length);
    data.set(this.data);
    this.data = data;
    const shades = new Uint16Array(2 * this.shades.length);
    shades.set(this.shades);
    this.shades = shades;
  }

  line(x0, y0, x1, y1, shade = 0) {
    if (this.count === this.shades.length) this.grow();
    const {data} = this;
    let at = LINE * this.count;
    data[at] = x0;
    data[++at] = y0;
    data[++at] = x1;
    data[++at] = y1;
    this.shades[this.count++] = shade;
  }

  circle(x, y, radius, shade = 0) {
    if (this.count === this.shades.length) this.grow();
    const {data} = this;
    let at = CIRCLE * this.count;
    data[at] = x;
    data[++at] = y;
    data[++at] = radius;
    this.shades[this.count++] = shade;
  }

  triangle(ax, ay, bx, by, cx, cy, shade = 0) {
    if (this.count === this.shades.length) this.grow();
    const {data} = this;
    let at = TRIANGLE * this.count;
    data[at] = ax;
    data[++at] = ay;
    data[++at] = bx;
    data[++at] = by;
    data[++at] = cx;
    data[++at] = cy;
    this.shades[this.count++] = shade;
  }
}

const PARSED_COLORS = new Map();

/** [red, green, blue, alpha], each from 0 to 1, of `#rrggbb`, `rgb(r g b)` or `rgb(r g b / a%)`, also
 * with commas. */
function parseColor(color) {
  let parsed = PARSED_COLORS.get(color);
  if (parsed === undefined) {
    if (color.startsWith('#')) {
      parsed = [1, 3, 5].map((i) => parseInt(color.slice(i, i + 2), 16) / 255);
      parsed.push(1);
    } else {
      const numbers = color.match(/[\d.]+/g).map(Number);
      parsed = numbers.slice(0, 3).map((c) => c / 255);
      parsed.push(numbers.length > 3 ? numbers[3] / (color.includes('%') ? 100 : 1) : 1);
    }
    PARSED_COLORS.set(color, parsed);
  }
  return parsed;
}
