// SPDX-License-Identifier: GPL-3.0-or-later
//
// The painter of a 2D context. Where there is no graphics card, it is faster than WebGL as browsers
// emulate it, if three rules are kept: paths stay short, since the time of a path grows faster than
// its length; many lines are no wider than a pixel of the display, and many dots of about a pixel are
// no paths at all (coverage.js); and discs that are too small for their shape to be seen are squares.
'use strict';

const PATH_ITEMS = 500;  // at most in a path
const MANY = 1500;       // lines; more are drawn with hairlines
const PATH_ARCS = 40;    // at most in a path; arcs take longer
const SMALL = 1.5, SMALL_OF_MANY = 3;  // radius of a disc that is drawn as a square
const TINY = 0.8;        // radius of a disc that is drawn as a line, in pixels of the display
const SQUARE_SIDE = Math.sqrt(Math.PI);  // of the square that is as large as the circle of radius 1

class CanvasPainter {
  constructor(context) {
    this.context = context;
    this.coverage = context instanceof CanvasRenderingContext2D ? new Coverage() : null;
    this.ratio = 1;
    this.background = '#ffffff';
    this.isEmpty = true;  // nothing has been drawn since begin()
    this.order = new Uint32Array(0);
    this.starts = new Uint32Array(1);
  }

  begin(width, height, ratio, background) {
    const {context} = this;
    this.ratio = ratio;
    this.background = background;
    this.isEmpty = true;
    context.globalAlpha = 1;
    context.setLineDash(NO_DASH);
    context.lineJoin = 'round';
    context.fillStyle = background;
    context.fillRect(0, 0, width, height);
  }

  end() {}

  lines(batch, {color, width, alpha = 1, dash = NO_DASH, cap = 'butt', palette = null}) {
    const {context} = this;
    context.globalAlpha = alpha;
    context.lineWidth = batch.count > MANY ? Math.min(width, 1 / this.ratio) : width;
    context.setLineDash(dash);
    context.lineCap = cap;
    if (palette === null && dash === NO_DASH && batch.count > MANY && this.coverage !== null) {
      this.coverLines(batch, color, width, alpha);
    } else if (palette === null) {
      context.strokeStyle = color;
      this.strokeLines(batch, null, 0, batch.count);
    } else {
      this.sort(batch, palette);
      this.forEachShade(palette, (shade, first, end) => {
        context.strokeStyle = shade;
        this.strokeLines(batch, this.order, first, end);
      });
    }
    context.globalAlpha = 1;
    if (dash !== NO_DASH) context.setLineDash(NO_DASH);
    context.lineCap = 'butt';
    this.isEmpty = false;
  }

  coverLines({data, count}, color, width, alpha) {
    const {coverage, context, ratio} = this;
    const {canvas} = context;
    // Both ends of each.
    if (!coverage.begin(canvas.width, canvas.height, data, LINE * count, 2, ratio)) return;
    coverage.addLines(data, count, ratio, Math.min(width * ratio, 1));
    this.drawCovered(color, alpha);
  }

  coverDots({data, count}, color, alpha) {
    const {coverage, context, ratio} = this;
    const {canvas} = context;
    if (!coverage.begin(canvas.width, canvas.height, data, CIRCLE * count, CIRCLE, ratio)) return;
    coverage.addDots(data, count, CIRCLE, ratio, data[2] * ratio);
    this.drawCovered(color, alpha);
  }

  drawCovered(color, alpha) {
    this.coverage.drawOn(this.context, color, alpha, this.isEmpty ? this.background : null);
  }

  strokeLines({data}, order, first, end) {
    const {context} = this;
    for (let begin = first; begin < end; begin += PATH_ITEMS) {
      const last = Math.min(begin + PATH_ITEMS, end);
      context.beginPath();
      for (let i = begin; i < last; ++i) {
        const at = LINE * (order === null ? i : order[i]);
        context.moveTo(data[at], data[at + 1]);
        context.lineTo(data[at + 2], data[at + 3]);
      }
      context.stroke();
    }
  }

  circles(batch, {fill, stroke, width = 1, alpha = 1, dash = NO_DASH, palette = null}) {
    const {context} = this;
    context.globalAlpha = alpha;
    if (palette !== null) {
      this.sort(batch, palette);
      this.forEachShade(palette, (shade, first, end) => this.fillCircles(batch, this.order, first, end, shade));
    } else if (fill !== undefined && this.areDots(batch)) {
      this.coverDots(batch, fill, alpha);
    } else if (fill !== undefined) {
      this.fillCircles(batch, null, 0, batch.count, fill);
    }
    if (stroke !== undefined) {
      context.strokeStyle = stroke;
      context.lineWidth = width;
      context.setLineDash(dash);
      this.traceCircles(batch, null, 0, batch.count, false);
      if (dash !== NO_DASH) context.setLineDash(NO_DASH);
    }
    context.globalAlpha = 1;
    this.isEmpty = false;
  }

  fillCircles(batch, order, first, end, color) {
    const {context} = this;
    context.fillStyle = context.strokeStyle = color;
    this.traceCircles(batch, order, first, end, true);
  }

  /** Fills or strokes circles. */
  traceCircles(batch, order, first, end, isFill) {
    const {context} = this;
    for (let begin = first; begin < end;) {
      const trace = this.wayOf(batch, order, begin, isFill);
      const most = Math.min(begin + (trace === this.addArc ? PATH_ARCS : PATH_ITEMS), end);
      context.beginPath();
      let i = begin;
      do {
        const at = CIRCLE * (order === null ? i : order[i]);
        trace.call(this, batch.data[at], batch.data[at + 1], batch.data[at + 2]);
      } while (++i < most && this.wayOf(batch, order, i, isFill) === trace);
      begin = i;
      if (trace === this.addBar) {
        context.lineWidth = 1 / this.ratio;
        context.stroke();
      } else {
        isFill ? context.fill() : context.stroke();
      }
    }
  }

  /** Whether these are many circles of one size that is about a pixel or less, as dots are. */
  areDots({data, count}) {
    return this.coverage !== null && count > MANY && data[2] * this.ratio <= TINY &&
      data[CIRCLE * (count - 1) + 2] === data[2];
  }

  /** How a circle is added to the path. */
  wayOf({data, count}, order, i, isFill) {
    const radius = data[CIRCLE * (order === null ? i : order[i]) + 2];
    if (!isFill || radius > (count > MANY ? SMALL_OF_MANY : SMALL)) return this.addArc;
    return radius * this.ratio > TINY ? this.addSquare : this.addBar;
  }

  addArc(x, y, radius) {
    this.context.moveTo(x + radius, y);
    this.context.arc(x, y, radius, 0, 2 * Math.PI);
  }

  addSquare(x, y, radius) {
    const half = SQUARE_SIDE / 2 * radius;
    this.context.rect(x - half, y - half, 2 * half, 2 * half);
  }

  /** Of a pixel's height, and as long as gives it the area of the circle. */
  addBar(x, y, radius) {
    const half = Math.PI / 2 * radius * radius * this.ratio;
    this.context.moveTo(x - half, y);
    this.context.lineTo(x + half, y);
  }

  triangles(batch, {color, alpha = 1, palette = null}) {
    const {context} = this;
    context.globalAlpha = alpha;
    if (palette === null) {
      this.fillTriangles(batch, null, 0, batch.count, color);
    } else {
      this.sort(batch, palette);
      this.forEachShade(palette, (shade, first, end) => this.fillTriangles(batch, this.order, first, end, shade));
    }
    context.globalAlpha = 1;
    this.isEmpty = false;
  }

  /** The path of an opaque color is stroked too, as thin as possible, so that no seams are seen between
   * colors. */
  fillTriangles({data, count}, order, first, end, color) {
    const {context} = this;
    context.fillStyle = context.strokeStyle = color;
    context.lineWidth = 1 / this.ratio;
    for (let begin = first; begin < end; begin += PATH_ITEMS) {
      const last = Math.min(begin + PATH_ITEMS, end);
      context.beginPath();
      for (let i = begin; i < last; ++i) {
        const at = TRIANGLE * (order === null ? i : order[i]);
        context.moveTo(data[at], data[at + 1]);
        context.lineTo(data[at + 2], data[at + 3]);
        context.lineTo(data[at + 4], data[at + 5]);
        context.closePath();
      }
      context.fill();
      if (order !== null && count <= 4 * MANY && !color.includes('/')) context.stroke();
    }
  }

  text(text, x, y, {color, halo, font, align = 'left'}) {
    const {context} = this;
    context.font = font;
    context.textAlign = align;
    if (halo !== undefined) {
      context.lineWidth = 3;
      context.strokeStyle = halo;
      context.strokeText(text, x, y);
    }
    this.isEmpty = false;
    context.fillStyle = color;
    context.fillText(text, x, y);
  }

  /** Sorts the items by shade, in linear time: `order` has them so, those of a shade from its entry in
   * `starts` on. */
  sort({shades, count}, palette) {
    if (this.order.length < count) this.order = new Uint32Array(2 * count);
    if (this.starts.length < palette.length + 1) this.starts = new Uint32Array(palette.length + 1);
    const {order, starts} = this;
    starts.fill(0);
    for (let i = 0; i < count; ++i) ++starts[shades[i] + 1];
    for (let shade = 0; shade < palette.length; ++shade) starts[shade + 1] += starts[shade];
    for (let i = 0; i < count; ++i) order[starts[shades[i]]++] = i;
    starts.copyWithin(1, 0, palette.length);
    starts[0] = 0;
  }

  forEachShade(palette, visit) {
    for (let shade = 0; shade < palette.length; ++shade) {
      const first = this.starts[shade], end = this.starts[shade + 1];
      if (first < end) visit(palette[shade], first, end);
    }
  }
}
