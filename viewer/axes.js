// SPDX-License-Identifier: GPL-3.0-or-later
//
// Axes: a strip at the left and one at the bottom of the flat view, with ticks at round numbers and labels that
// do not overlap.
'use strict';

const TICK = 5;               // pixels
const AXIS_BOTTOM = 22;       // height of the strip
const LEAST_TICKS_APART = 28; // pixels
const LABELS_APART = 14;
const MOST_DECIMALS = 15;     // of a label that is not written with an exponent
const LARGEST_PLAIN = 1e15;

/** A label: the number `mantissa` times 10 to the `exponent`. */
function tickText(mantissa, exponent) {
  const value = Number(`${mantissa}e${exponent}`);
  const isPlain = Math.abs(value) < LARGEST_PLAIN && exponent >= -MOST_DECIMALS;
  const text = isPlain ? value.toFixed(Math.max(-exponent, 0)) : String(value);
  return text.replace(/^-/, '\u2212');
}

/** The ticks of an axis from one number to another one, `scale` pixels a unit: {value, text, width}. They are
 * as many multiples of 1, 2 or 5 times a power of ten as fit, if a step whose widest label has the width w needs
 * `room(w)` pixels. None if binary64 numbers cannot distinguish them. */
function ticksOf(from, to, scale, measure, room) {
  for (let n = Math.ceil(3 * Math.log10(LEAST_TICKS_APART / scale)); ; ++n) {
    const kind = ((n % 3) + 3) % 3, exponent = (n - kind) / 3, factor = [1, 2, 5][kind];
    const step = Number(`${factor}e${exponent}`);
    const first = Math.ceil(from / step), last = Math.floor(to / step);
    if (!(step > 0 && step < Infinity) || !(Math.max(Math.abs(first), Math.abs(last)) * factor < 2 ** 53)) return [];
    const ticks = [];
    for (let k = first; k <= last; ++k) {
      const text = tickText(k * factor, exponent);
      ticks.push({value: Number(`${k * factor}e${exponent}`), text, width: measure(text)});
    }
    const widest = ticks.reduce((most, {width}) => Math.max(most, width), 0);
    if (step * scale >= room(widest)) return ticks;
  }
}

/** The axes of a view: {left, x, y}; `left` is the width of the strip at the left. */
function axesOf(view) {
  const {viewer, camera, width, height} = view;
  const {context} = viewer.stage.canvasPainter;
  context.font = LABEL_FONT;
  const measure = (text) => context.measureText(text).width;
  const y = ticksOf(camera.planeY(height - AXIS_BOTTOM), camera.planeY(0), camera.scale, measure,
                    () => LEAST_TICKS_APART);
  const widest = y.reduce((most, tick) => Math.max(most, tick.width), measure(viewer.unit));
  const left = Math.ceil(widest) + TICK + 9;
  const x = ticksOf(camera.planeX(left), camera.planeX(width), camera.scale, measure,
                    (labels) => Math.max(labels + LABELS_APART, LEAST_TICKS_APART));
  return {left, x, y};
}

/** Draws the axes over the picture, and returns how wide the strip at the left is. */
function drawAxes(painter, view) {
  const {viewer, camera, width, height} = view;
  const {colors, unit} = viewer;
  const {left, x, y} = axesOf(view);
  const bottom = height - AXIS_BOTTOM;
  const strips = view.triangleBatch.clear();
  for (const [x0, y0, x1, y1] of [[0, 0, left, height], [0, bottom, width, height]]) {
    strips.triangle(x0, y0, x1, y0, x1, y1);
    strips.triangle(x0, y0, x1, y1, x0, y1);
  }
  painter.triangles(strips, {color: colors.background});
  const lines = view.lineBatch.clear();
  lines.line(left, 0, left, bottom);
  lines.line(left, bottom, width, bottom);
  const style = {color: colors.text, font: LABEL_FONT};
  for (const tick of x) {
    const at = camera.screenX(tick.value);
    lines.line(at, bottom, at, bottom + TICK);
    if (at - tick.width / 2 < left || at + tick.width / 2 > width - 2) continue;
    painter.text(tick.text, at, height - 4, {...style, align: 'center'});
  }
  for (const tick of y) {
    const at = camera.screenY(tick.value);
    lines.line(left - TICK, at, left, at);
    if (at < 8 || at > bottom - 4) continue;
    painter.text(tick.text, left - TICK - 3, at + 4, {...style, align: 'right'});
  }
  painter.lines(lines, {color: colors.text, width: 1});
  if (unit !== '') painter.text(unit, left - TICK - 3, height - 4, {...style, color: colors.quiet, align: 'right'});
  return left;
}
