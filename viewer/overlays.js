// SPDX-License-Identifier: GPL-3.0-or-later
//
// The overlays of the flat view: trails, the Voronoi or power diagram, the circumcircle or power
// circle of the triangle under the pointer, the events around the time shown, and the selected edge.
'use strict';

const TRAIL_PARTS = 5;             // each fainter than the one before it
const TRAIL_STEPS = 4;             // in a part of the trail of an accelerated point
const MOST_EVENTS_SHOWN = 24;      // before and after the time shown, besides those at it
const MOST_COPIES = 64;            // of a segment or a cell in a periodic box
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
  const {camera} = view, {images} = view.viewer;
  const steps = recording.degree === 1 ? 1 : TRAIL_STEPS;
  // The image that is in a periodic box now has been elsewhere before.
  const moveAt = (coordinate, time) =>
    (images === null ? 0 : images.moveAt(recording.motionPoint[motion], coordinate, time));
  const screenX = (time) => camera.screenX(motionX(recording, motion, time) + moveAt(0, time));
  const screenY = (time) => camera.screenY(motionY(recording, motion, time) + moveAt(1, time));
  for (; motion >= 0; motion = recording.motionPrevious[motion]) {
    const row = recording.motionRow[motion];
    const start = row < 0 ? recording.from : recording.rowTime[row];
    if (start >= end) continue;
    const first = Math.max(start, begin);
    if (recording.motionThere[motion]) {
      let x = screenX(end), y = screenY(end);
      for (let step = 1; step <= steps; ++step) {
        const time = end + (first - end) * step / steps;
        const nextX = screenX(time), nextY = screenY(time);
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
  const {playback, colors, images} = view.viewer;
  const batch = view.lineBatch.clear();
  for (let i = 0; i < playback.liveCount; ++i) {
    setVoronoiEnds(view, playback.live[i]);
    if (images === null) view.addSegment(batch, ENDS[0], ENDS[1], ENDS[2], ENDS[3]);
    else addImagesOfSegment(batch, view, ...ENDS);
  }
  painter.lines(batch, {color: colors.voronoi, alpha, width: view.detail.lineWidth() + 0.2});
}

/** Adds the images of a segment that cover what its images cover of the periodic box. */
function addImagesOfSegment(batch, view, x0, y0, x1, y1) {
  const {camera, viewer: {images: {box}}} = view;
  const ends = [[x0, y0], [x1, y1]].map(([x, y]) => [camera.planeX(x), camera.planeY(y)]);
  const k = ends.map(([x, y]) => Math.floor(box.along(x, y))), l = ends.map(([x, y]) => Math.floor(box.across(x, y)));
  forEachCopy(k, l, (i, j) => {
    const dx = -(i * box.ux + j * box.vx) * camera.scale, dy = (i * box.uy + j * box.vy) * camera.scale;
    view.addSegment(batch, x0 + dx, y0 + dy, x1 + dx, y1 + dy);
  });
}

/** Calls visit(i, j) for the copies of the box from the least to the greatest of these numbers; only for some
 * if there are many, as just before a box loses its area. */
function forEachCopy(k, l, visit) {
  const [left, right] = [Math.min(...k), Math.max(...k)], [bottom, top] = [Math.min(...l), Math.max(...l)];
  if (!((right - left + 1) * (top - bottom + 1) <= MOST_COPIES)) {
    visit(k[0], l[0]);
    return;
  }
  for (let i = left; i <= right; ++i) for (let j = bottom; j <= top; ++j) visit(i, j);
}

/** Writes the ends of the diagram's edge to ENDS. A ray ends outside of the picture. */
function setVoronoiEnds(view, edge) {
  if (view.viewer.images !== null) {
    setPeriodicVoronoiEnds(view, edge);
    return;
  }
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

/** In a periodic box: beside the first end of the edge. There are no rays. */
function setPeriodicVoronoiEnds(view, edge) {
  const {sx, sy, sw} = view;
  const a = view.viewer.recording.edgeA[edge];
  for (const isLeft of [true, false]) {
    const [b, c] = imagesBeside(view, edge, isLeft);
    powerCenter(CENTER, sx[a], sy[a], sw[a], b.x, b.y, b.w, c.x, c.y, c.w);
    ENDS[isLeft ? 0 : 2] = CENTER.x;
    ENDS[isLeft ? 1 : 3] = CENTER.y;
  }
}

/** In a periodic box, on the screen: the image of the second end of the edge, and that of the corner to the
 * left or to the right, for an edge that begins at the first end. */
function imagesBeside(view, edge, isLeft) {
  const {sx, sy, sw} = view;
  const {playback: {triangles}, recording: {edgeA, edgeB, edgeX, edgeY}} = view.viewer;
  const place = ([id, x, y]) => {
    view.setShiftOf(edgeA[edge], id, x, y);
    return {x: sx[id] + SHIFT.x, y: sy[id] + SHIFT.y, w: sw[id]};
  };
  return [place([edgeB[edge], edgeX[edge], edgeY[edge]]), place(triangles.imageAt(edge, isLeft))];
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
  if (pointer === null) return;
  triangleList.update();
  for (let i = 0; i < triangleList.triangles; ++i) {
    const {x, y, w} = cornersOnScreen(view, triangleList, i);
    if (!isInTriangle(x, y, pointer.x, pointer.y)) continue;
    const triangle = view.triangleBatch.clear();
    triangle.triangle(x[0], y[0], x[1], y[1], x[2], y[2]);
    painter.triangles(triangle, {color: colors.circleFill});
    powerCenter(CENTER, x[0], y[0], w[0], x[1], y[1], w[1], x[2], y[2], w[2]);
    const dx = x[0] - CENTER.x, dy = y[0] - CENTER.y;
    const radius = Math.sqrt(dx * dx + dy * dy - w[0]);
    if (!(radius < 1e6)) return;  // a line, as far as the picture goes; or not real
    const circle = view.circleBatch.clear();
    circle.circle(CENTER.x, CENTER.y, radius);
    painter.circles(circle, {stroke: colors.circle, width: 2.5});
    return;
  }
}

const TRIANGLE_ON_SCREEN = {x: [0, 0, 0], y: [0, 0, 0], w: [0, 0, 0]};

/** The corners of the i-th triangle of the list; in a periodic box of the image that is under the pointer, if
 * one is. */
function cornersOnScreen(view, {corners, offsets}, i) {
  const {sx, sy, sw, camera, viewer: {images, pointer}} = view, {x, y, w} = TRIANGLE_ON_SCREEN;
  for (let k = 0; k < 3; ++k) {
    const corner = corners[3 * i + k];
    SHIFT.x = SHIFT.y = 0;
    if (images !== null && k > 0) {
      view.setShiftOf(corners[3 * i], corner, offsets[4 * i + 2 * k - 2], offsets[4 * i + 2 * k - 1]);
    }
    x[k] = sx[corner] + SHIFT.x;
    y[k] = sy[corner] + SHIFT.y;
    w[k] = sw[corner];
  }
  if (images === null) return TRIANGLE_ON_SCREEN;
  const {box} = images, image = {x: x.slice(), y: y.slice(), w};
  const px = camera.planeX(pointer.x), py = camera.planeY(pointer.y);
  const parts = (of) => x.map((_, k) => of.call(box, px - camera.planeX(x[k]), py - camera.planeY(y[k])));
  const moves = (numbers) => [Math.floor(Math.min(...numbers)), Math.ceil(Math.max(...numbers))];
  let found = TRIANGLE_ON_SCREEN;
  forEachCopy(moves(parts(box.along)), moves(parts(box.across)), (k, l) => {
    if (found !== TRIANGLE_ON_SCREEN) return;
    for (let c = 0; c < 3; ++c) {
      image.x[c] = x[c] + (k * box.ux + l * box.vx) * camera.scale;
      image.y[c] = y[c] - (k * box.uy + l * box.vy) * camera.scale;
    }
    if (isInTriangle(image.x, image.y, pointer.x, pointer.y)) found = image;
  });
  return found;
}

function isInTriangle(sx, sy, x, y) {
  return isLeft(sx, sy, 0, 1, x, y) && isLeft(sx, sy, 1, 2, x, y) && isLeft(sx, sy, 2, 0, x, y);
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
    const {a, b, left, right, offsets} = certificate;
    const triangles = view.triangleBatch.clear(), sides = view.lineBatch.clear();
    const place = (id, offset) => {
      SHIFT.x = SHIFT.y = 0;
      if (offset !== undefined) view.setShiftOf(a, id, ...offset);
      return [sx[id] + SHIFT.x, sy[id] + SHIFT.y];
    };
    const q = place(b, offsets?.[1]);
    for (const [c, offset] of [[left, offsets?.[2]], [right, offsets?.[3]]]) {
      if (c < 0) continue;
      const r = place(c, offset);
      triangles.triangle(sx[a], sy[a], ...r, ...q);
      view.addSegment(sides, sx[a], sy[a], ...r);
      view.addSegment(sides, ...r, ...q);
    }
    painter.triangles(triangles, {color: colors.selectedFill});
    painter.lines(sides, {color: colors.selected, width: 1.5, dash: QUADRILATERAL_DASH});
  }
  const isThere = viewer.playback.where[selected] >= 0;
  strokeEdge(painter, view, selected, {color: colors.background, width: 7});
  strokeEdge(painter, view, selected,
             {color: colors.selected, width: 4, dash: isThere ? NO_DASH : GONE_DASH});
}
