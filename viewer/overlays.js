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
const CLIP_MARGIN = 4;

/** The recent path of each point, with its turns. */
function drawTrails(context, view) {
  const {viewer} = view;
  const {recording, playback} = viewer;
  const length = viewer.trailLength() / TRAIL_PARTS;
  context.strokeStyle = viewer.colors.trail;
  context.lineWidth = 2.2;
  context.lineJoin = 'round';
  for (let part = 0; part < TRAIL_PARTS; ++part) {
    const end = playback.time - part * length;
    if (end <= recording.from) break;
    const begin = Math.max(end - length, recording.from);
    context.globalAlpha = 0.95 * (1 - part / TRAIL_PARTS);
    context.beginPath();
    for (let point = 0; point < recording.points; ++point) {
      traceMotion(context, view, playback.current[point], begin, end);
    }
    context.stroke();
  }
  context.globalAlpha = 1;
}

/** Adds the path from `end` back to `begin` of a point whose present motion is given. */
function traceMotion(context, view, motion, begin, end) {
  const {recording} = view.viewer;
  const {camera} = view;
  const steps = recording.degree === 1 ? 1 : TRAIL_STEPS;
  for (; motion >= 0; motion = recording.motionPrevious[motion]) {
    const row = recording.motionRow[motion];
    const start = row < 0 ? recording.from : recording.rowTime[row];
    if (start >= end) continue;
    const first = Math.max(start, begin);
    if (recording.motionThere[motion]) {
      context.moveTo(camera.screenX(motionX(recording, motion, end)),
                     camera.screenY(motionY(recording, motion, end)));
      for (let step = 1; step <= steps; ++step) {
        const time = end + (first - end) * step / steps;
        context.lineTo(camera.screenX(motionX(recording, motion, time)),
                       camera.screenY(motionY(recording, motion, time)));
      }
    }
    if (start <= begin) return;
    end = start;
  }
}

/** The edge of the diagram for each edge: between the centres of its two triangles, or a ray from
 * the centre of its only triangle. */
function drawVoronoi(context, view) {
  const {playback, recording, colors} = view.viewer;
  const {width, height} = view.camera;
  const far = 4 * (width + height);
  context.beginPath();
  for (let i = 0; i < playback.liveCount; ++i) {
    setVoronoiEnds(view, playback.live[i], far);
    if (!clipSegment(ENDS, width, height, CLIP_MARGIN)) continue;
    context.moveTo(ENDS[0], ENDS[1]);
    context.lineTo(ENDS[2], ENDS[3]);
  }
  context.strokeStyle = colors.voronoi;
  context.lineWidth = 1.6;
  context.stroke();
}

function setVoronoiEnds(view, edge, far) {
  const {sx, sy, sw} = view;
  const {playback, recording} = view.viewer;
  const a = recording.edgeA[edge], b = recording.edgeB[edge];
  const [left, right] = cornersOf(playback, edge);
  // On the screen y is down, so that the left of ab is at (dy, -dx).
  const dx = sx[b] - sx[a], dy = sy[b] - sy[a], length = Math.hypot(dx, dy);
  // Where the edge of the diagram crosses the line of ab.
  const part = 0.5 + (sw[a] - sw[b]) / (2 * length * length);
  const mx = sx[a] + part * dx, my = sy[a] + part * dy;
  const hasLeft = left >= 0 && setCenter(view, a, b, left, 0);
  const hasRight = right >= 0 && setCenter(view, a, b, right, 2);
  const ux = dy / length, uy = -dx / length;
  // A ray begins far from the picture where the centre is, but has to reach across it.
  const reach = (x, y) => far + Math.hypot(x - mx, y - my);
  if (!hasLeft) {
    const x = hasRight ? ENDS[2] : mx, y = hasRight ? ENDS[3] : my, r = reach(x, y);
    ENDS[0] = x + r * ux;
    ENDS[1] = y + r * uy;
  }
  if (!hasRight) {
    const x = hasLeft ? ENDS[0] : mx, y = hasLeft ? ENDS[1] : my, r = reach(x, y);
    ENDS[2] = x - r * ux;
    ENDS[3] = y - r * uy;
  }
}

function setCenter(view, a, b, c, at) {
  const {sx, sy, sw} = view;
  powerCenter(CENTER, sx[a], sy[a], sw[a], sx[b], sy[b], sw[b], sx[c], sy[c], sw[c]);
  ENDS[at] = CENTER.x;
  ENDS[at + 1] = CENTER.y;
  return Number.isFinite(CENTER.x) && Number.isFinite(CENTER.y);
}

/** The triangle under the pointer, and its circumcircle: with weights the circle whose centre has
 * the squared radius as its power to the three, if that is positive. */
function drawCircumcircle(context, view) {
  const {triangleList, pointer, colors} = view.viewer;
  const {sx, sy, sw} = view;
  if (pointer === null) return;
  triangleList.update();
  const {corners, triangles} = triangleList;
  for (let i = 0; i < 3 * triangles; i += 3) {
    const a = corners[i], b = corners[i + 1], c = corners[i + 2];
    if (!isInTriangle(sx, sy, a, b, c, pointer.x, pointer.y)) continue;
    context.beginPath();
    context.moveTo(sx[a], sy[a]);
    context.lineTo(sx[b], sy[b]);
    context.lineTo(sx[c], sy[c]);
    context.closePath();
    context.fillStyle = colors.circleFill;
    context.fill();
    powerCenter(CENTER, sx[a], sy[a], sw[a], sx[b], sy[b], sw[b], sx[c], sy[c], sw[c]);
    const dx = sx[a] - CENTER.x, dy = sy[a] - CENTER.y;
    const radius = Math.sqrt(dx * dx + dy * dy - sw[a]);
    if (!(radius < 1e6)) return;  // a line, as far as the picture goes; or not real
    context.strokeStyle = colors.circle;
    context.lineWidth = 2.5;
    context.beginPath();
    context.arc(CENTER.x, CENTER.y, radius, 0, 2 * Math.PI);
    context.stroke();
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
function drawEventsAround(context, view) {
  const {playback, recording} = view.viewer;
  const while_ = view.viewer.highlightLength();
  const {time, event} = playback;
  for (let row = event - 1; row >= 0; --row) {
    const since = time - shownTime(recording, row);
    const isPresent = recording.instantEnd[row] === event && since === 0;
    if (!isPresent && !(since < while_ && row >= event - MOST_EVENTS_SHOWN)) break;
    drawEvent(context, view, row, isPresent ? 1 : 1 - since / while_);
  }
  for (let row = event; row < Math.min(event + MOST_EVENTS_SHOWN, recording.rows); ++row) {
    const ahead = recording.rowTime[row] - time;
    if (!(ahead < while_)) break;
    drawEvent(context, view, row, 0.8 * (1 - ahead / while_), true);
  }
}

function drawEvent(context, view, row, strength, isAhead = false) {
  const {recording, colors} = view.viewer;
  context.globalAlpha = Math.max(strength, 0);
  context.lineCap = 'round';
  strokeEdge(context, view, recording.rowRemoved[row], colors.removed, 2.5, [7, 5]);
  if (!isAhead) {
    strokeEdge(context, view, recording.rowAdded[row], colors.added, 4, []);
    for (const point of [recording.rowA[row], recording.rowB[row]]) {
      if (point < 0) continue;
      context.strokeStyle = colors.added;
      context.lineWidth = 2.5;
      context.beginPath();
      context.arc(view.sx[point], view.sy[point], view.pointRadius() + 5, 0, 2 * Math.PI);
      context.stroke();
    }
  }
  context.setLineDash([]);
  context.lineCap = 'butt';
  context.globalAlpha = 1;
}

function strokeEdge(context, view, edge, color, width, dashes) {
  if (edge < 0) return;
  const {recording} = view.viewer;
  const a = recording.edgeA[edge], b = recording.edgeB[edge];
  context.strokeStyle = color;
  context.lineWidth = width;
  context.setLineDash(dashes);
  context.beginPath();
  context.moveTo(view.sx[a], view.sy[a]);
  context.lineTo(view.sx[b], view.sy[b]);
  context.stroke();
}

/** The selected edge and its quadrilateral. */
function drawSelection(context, view) {
  const {viewer, sx, sy} = view;
  const {certificate, colors, selected} = viewer;
  if (certificate !== null) {
    const {a, b, left, right} = certificate;
    context.beginPath();
    for (const c of [left, right]) {
      if (c < 0) continue;
      context.moveTo(sx[a], sy[a]);
      context.lineTo(sx[c], sy[c]);
      context.lineTo(sx[b], sy[b]);
      context.closePath();
    }
    context.fillStyle = colors.selectedFill;
    context.fill();
    context.strokeStyle = colors.selected;
    context.lineWidth = 1.5;
    context.setLineDash([2, 4]);
    context.stroke();
    context.setLineDash([]);
  }
  const isThere = viewer.playback.where[selected] >= 0;
  strokeEdge(context, view, selected, colors.background, 7, []);
  strokeEdge(context, view, selected, colors.selected, 4, isThere ? [] : [3, 6]);
  context.setLineDash([]);
}
