// SPDX-License-Identifier: GPL-3.0-or-later
//
// The overlays of the flat view: trails, the Voronoi or power diagram, the circumcircle or power
// circle of the triangle under the pointer, the events around the time shown, and the selected edge.
'use strict';

const TRAIL_PARTS = 5;             // each fainter than the one before it
const TRAIL_STEPS = 4;             // in a part of the trail of an accelerated point
const MOST_EVENTS_SHOWN = 24;      // before and after the time shown, besides those at it
const CENTER = {x: 0, y: 0};
const ENDS = new Float64Array(4);
const REMOVED_DASH = [7, 5], GONE_DASH = [3, 6], QUADRILATERAL_DASH = [2, 4];

/** The recent path of each point, with its turns. */
function drawTrails(painter, view) {
  const {viewer} = view;
  const {recording, playback, colors} = viewer;
  const length = viewer.trailLength() / TRAIL_PARTS;
  for (let part = 0; part < TRAIL_PARTS; ++part) {
    const end = playback.time - part * length;
    if (end <= recording.from) break;
    const begin = Math.max(end - length, recording.from);
    const batch = view.lineBatch.clear();
    for (let point = 0; point < recording.points; ++point) {
      addPath(batch, view, playback.current[point], begin, end);
    }
    painter.lines(batch, {color: colors.trail, width: 2.2, cap: 'round',
                          alpha: 0.95 * (1 - part / TRAIL_PARTS)});
  }
}

/** Adds the path from `end` back to `begin` of a point whose present motion is given. */
function addPath(batch, view, motion, begin, end) {
  const {recording} = view.viewer;
  const {camera} = view;
  const steps = recording.degree === 1 ? 1 : TRAIL_STEPS;
  for (; motion >= 0; motion = recording.motionPrevious[motion]) {
    const row = recording.motionRow[motion];
    const start = row < 0 ? recording.from : recording.rowTime[row];
    if (start >= end) continue;
    const first = Math.max(start, begin);
    if (recording.motionThere[motion]) {
      let x = camera.screenX(motionX(recording, motion, end));
      let y = camera.screenY(motionY(recording, motion, end));
      for (let step = 1; step <= steps; ++step) {
        const time = end + (first - end) * step / steps;
        const nextX = camera.screenX(motionX(recording, motion, time));
        const nextY = camera.screenY(motionY(recording, motion, time));
        view.addSegment(batch, x, y, nextX, nextY);
        x = nextX;
        y = nextY;
      }
    }
    if (start <= begin) return;
    end = start;
  }
}

/** The edge of the diagram for each edge: between the centers of its two triangles, or a ray from
 * the center of its only triangle. */
function drawVoronoi(painter, view) {
  const alpha = view.detail.edgeStrength();
  if (alpha === 0) return;
  const {playback, colors} = view.viewer;
  const batch = view.lineBatch.clear();
  for (let i = 0; i < playback.liveCount; ++i) {
    setVoronoiEnds(view, playback.live[i]);
    view.addSegment(batch, ENDS[0], ENDS[1], ENDS[2], ENDS[3]);
  }
  painter.lines(batch, {color: colors.voronoi, alpha, width: view.detail.lineWidth() + 0.2});
}

/** Writes the ends of the diagram's edge to ENDS. A ray ends outside of the picture. */
function setVoronoiEnds(view, edge) {
  const {sx, sy, sw, width, height} = view;
  const {playback, recording} = view.viewer;
  const a = recording.edgeA[edge], b = recording.edgeB[edge];
  const left = playback.triangles.left[edge], right = playback.triangles.right[edge];
  const hasLeft = left >= 0 && setCenter(view, a, b, left, 0);
  const hasRight = right >= 0 && setCenter(view, a, b, right, 2);
  if (hasLeft && hasRight) return;
  // On the screen y is down, so that the left of ab is at (dy, -dx).
  const dx = sx[b] - sx[a], dy = sy[b] - sy[a], length = Math.hypot(dx, dy);
  // Where the edge of the diagram crosses the line of ab.
  const part = 0.5 + (sw[a] - sw[b]) / (2 * length * length);
  const mx = sx[a] + part * dx, my = sy[a] + part * dy;
  const ux = dy / length, uy = -dx / length;
  // A ray begins far from the picture where the center is, but has to reach across it.
  const far = 4 * (width + height);
  if (!hasLeft) {
    const x = hasRight ? ENDS[2] : mx, y = hasRight ? ENDS[3] : my;
    const reach = far + Math.hypot(x - mx, y - my);
    ENDS[0] = x + reach * ux;
    ENDS[1] = y + reach * uy;
  }
  if (!hasRight) {
    const x = hasLeft ? ENDS[0] : mx, y = hasLeft ? ENDS[1] : my;
    const reach = far + Math.hypot(x - mx, y - my);
    ENDS[2] = x - reach * ux;
    ENDS[3] = y - reach * uy;
  }
}

function setCenter(view, a, b, c, at) {
  const {sx, sy, sw} = view;
  powerCenter(CENTER, sx[a], sy[a], sw[a], sx[b], sy[b], sw[b], sx[c], sy[c], sw[c]);
  ENDS[at] = CENTER.x;
  ENDS[at + 1] = CENTER.y;
  return Number.isFinite(CENTER.x) && Number.isFinite(CENTER.y);
}

/** The triangle under the pointer, and its circumcircle: with weights the circle whose center has
 * the squared radius as its power to the three, if that is positive. */
function drawCircumcircle(painter, view) {
  const {triangleList, pointer, colors} = view.viewer;
  const {sx, sy, sw} = view;
  if (pointer === null) return;
  triangleList.update();
  const {corners, triangles} = triangleList;
  for (let i = 0; i < 3 * triangles; i += 3) {
    const a = corners[i], b = corners[i + 1], c = corners[i + 2];
    if (!isInTriangle(sx, sy, a, b, c, pointer.x, pointer.y)) continue;
    const triangle = view.triangleBatch.clear();
    triangle.triangle(sx[a], sy[a], sx[b], sy[b], sx[c], sy[c]);
    painter.triangles(triangle, {color: colors.circleFill});
    powerCenter(CENTER, sx[a], sy[a], sw[a], sx[b], sy[b], sw[b], sx[c], sy[c], sw[c]);
    const dx = sx[a] - CENTER.x, dy = sy[a] - CENTER.y;
    const radius = Math.sqrt(dx * dx + dy * dy - sw[a]);
    if (!(radius < 1e6)) return;  // a line, as far as the picture goes; or not real
    const circle = view.circleBatch.clear();
    circle.circle(CENTER.x, CENTER.y, radius);
    painter.circles(circle, {stroke: colors.circle, width: 2.5});
    return;
  }
}

function isInTriangle(sx, sy, a, b, c, x, y) {
  return isLeft(sx, sy, a, b, x, y) && isLeft(sx, sy, b, c, x, y) && isLeft(sx, sy, c, a, x, y);
}

/** Whether a position on the screen, where y is down, is to the left of an edge or on it. */
function isLeft(sx, sy, p, q, x, y) {
  return (sx[q] - sx[p]) * (y - sy[p]) - (sy[q] - sy[p]) * (x - sx[p]) <= 0;
}

/** The edges of the events around the time shown: removed ones dashed, added ones bold. */
function drawEventsAround(painter, view) {
  const {playback, recording} = view.viewer;
  const while_ = view.viewer.highlightLength();
  const {time, event} = playback;
  for (let row = event - 1; row >= 0; --row) {
    const since = time - shownTime(recording, row);
    const isPresent = recording.instantEnd[row] === event && since === 0;
    if (!isPresent && !(since < while_ && row >= event - MOST_EVENTS_SHOWN)) break;
    drawEvent(painter, view, row, isPresent ? 1 : 1 - since / while_);
  }
  for (let row = event; row < Math.min(event + MOST_EVENTS_SHOWN, recording.rows); ++row) {
    const ahead = recording.rowTime[row] - time;
    if (!(ahead < while_)) break;
    drawEvent(painter, view, row, 0.8 * (1 - ahead / while_), true);
  }
}

function drawEvent(painter, view, row, strength, isAhead = false) {
  const {recording, colors} = view.viewer;
  const alpha = Math.max(strength, 0);
  strokeEdge(painter, view, recording.rowRemoved[row],
             {color: colors.removed, width: 2.5, dash: REMOVED_DASH, cap: 'round', alpha});
  if (isAhead) return;
  strokeEdge(painter, view, recording.rowAdded[row],
             {color: colors.added, width: 4, cap: 'round', alpha});
  for (const point of [recording.rowA[row], recording.rowB[row]]) {
    if (point >= 0) view.drawRing(painter, point, 5, colors.added, 2.5, alpha);
  }
}

function strokeEdge(painter, view, edge, style) {
  if (edge < 0) return;
  const batch = view.lineBatch.clear();
  view.addEdge(batch, edge);
  painter.lines(batch, style);
}

/** The selected edge and its quadrilateral. */
function drawSelection(painter, view) {
  const {viewer, sx, sy} = view;
  const {certificate, colors, selected} = viewer;
  if (certificate !== null) {
    const {a, b, left, right} = certificate;
    const triangles = view.triangleBatch.clear(), sides = view.lineBatch.clear();
    for (const c of [left, right]) {
      if (c < 0) continue;
      triangles.triangle(sx[a], sy[a], sx[c], sy[c], sx[b], sy[b]);
      view.addSegment(sides, sx[a], sy[a], sx[c], sy[c]);
      view.addSegment(sides, sx[c], sy[c], sx[b], sy[b]);
    }
    painter.triangles(triangles, {color: colors.selectedFill});
    painter.lines(sides, {color: colors.selected, width: 1.5, dash: QUADRILATERAL_DASH});
  }
  const isThere = viewer.playback.where[selected] >= 0;
  strokeEdge(painter, view, selected, {color: colors.background, width: 7});
  strokeEdge(painter, view, selected,
             {color: colors.selected, width: 4, dash: isThere ? NO_DASH : GONE_DASH});
}
