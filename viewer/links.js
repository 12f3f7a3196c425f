// SPDX-License-Identifier: GPL-3.0-or-later
//
// The layer of the flat view that shows pairs within range as links.
'use strict';

const LINK_FIELD = 24;       // pixels; the side of a field in which the links are measured
const LINKS_COVER = 0.3;     // of a field; links that would cover more are fainter
const LINK_LEVELS = 18;      // of strength; two of them halve it
const THINNEST_LINK = 0.02;  // pixels; what is thinner is a share of a pixel's color
const FAINTEST_LINK = 0.4;

/** Between points that are within range of each other. In a crowd they are thinner and fainter, so that
 * what is between and behind them is seen. Links that leave a periodic box are fainter. */
function drawLinks(painter, view) {
  const {encounters, colors, images, recording: {encounters: {a, b}}} = view.viewer;
  const width = 1.6 * view.detail.lineWidth();
  const levels = linkLevels(view, width);
  const draw = (level, isLeaving) => {
    const batch = view.lineBatch.clear();
    for (let i = 0; i < encounters.liveCount; ++i) {
      if (levels[i] !== level) continue;
      const encounter = encounters.live[i];
      view.setShiftOfEncounter(encounter);
      if (isLeaving === (SHIFT.x !== 0 || SHIFT.y !== 0)) view.addLink(batch, a[encounter], b[encounter]);
    }
    if (batch.count === 0) return;
    const {width: lineWidth, alpha} = linkStyle(width, level);
    painter.lines(batch, {color: colors.link, cap: 'round', width: lineWidth, alpha: isLeaving ? LEAVING * alpha : alpha});
  };
  for (let level = LINK_LEVELS - 1; level >= 0; --level) {
    if (images !== null) draw(level, true);
    draw(level, false);
  }
}

/** With less ink at each level. The line becomes thinner, since lines of one batch that lie over each other
 * add their widths but not their strengths (canvas_painter.js); only in the end it becomes fainter. */
function linkStyle(width, level) {
  const ink = width / 2 ** (level / 2);
  return {width: Math.max(ink, THINNEST_LINK), alpha: Math.min(Math.max(ink / THINNEST_LINK, FAINTEST_LINK), 1)};
}

/** The level of each link, by the ink that all links would have in the fields along it. */
function linkLevels(view, width) {
  const {viewer: {encounters, recording: {encounters: {a, b}}}, sx, sy} = view;
  const columns = Math.ceil(view.width / LINK_FIELD), rows = Math.ceil(view.height / LINK_FIELD);
  const ink = new Float64Array(columns * rows);
  /** Calls what(field, ink) for places along the link, half of a field apart at most; if it leaves a periodic
   * box, along both drawings of it. */
  const walk = (encounter, what) => {
    view.setShiftOfEncounter(encounter);
    const {x, y} = SHIFT;
    const x0 = sx[a[encounter]], y0 = sy[a[encounter]];
    const dx = sx[b[encounter]] + x - x0, dy = sy[b[encounter]] + y - y0;
    walkFrom(x0, y0, dx, dy, what);
    if (x !== 0 || y !== 0) walkFrom(x0 - x, y0 - y, dx, dy, what);
  };
  const walkFrom = (x0, y0, dx, dy, what) => {
    const length = Math.hypot(dx, dy);
    const steps = Math.min(Math.ceil(2 * length / LINK_FIELD), columns + rows);
    for (let step = 0; step < steps; ++step) {
      const share = (step + 0.5) / steps;
      const column = Math.floor((x0 + share * dx) / LINK_FIELD), row = Math.floor((y0 + share * dy) / LINK_FIELD);
      if (column >= 0 && row >= 0 && column < columns && row < rows) {
        what(row * columns + column, width * length / steps);
      }
    }
  };
  const levels = new Uint8Array(encounters.liveCount);
  for (let i = 0; i < levels.length; ++i) walk(encounters.live[i], (field, more) => { ink[field] += more; });
  for (let i = 0; i < levels.length; ++i) {
    let sum = 0, fields = 0;
    walk(encounters.live[i], (field) => {
      sum += ink[field];
      ++fields;
    });
    const cover = fields === 0 ? 0 : sum / fields / LINK_FIELD ** 2;
    levels[i] = Math.min(Math.max(Math.round(2 * Math.log2(cover / LINKS_COVER)), 0), LINK_LEVELS - 1);
  }
  return levels;
}
