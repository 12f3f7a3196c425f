// SPDX-License-Identifier: GPL-3.0-or-later
//
// Layers of the flat view that are shown when asked for: arrows of velocities, the heat of events over the
// plane, a scale bar, and what belongs to the selected point.
'use strict';

const MOST_ARROWS = 1500;
const ARROW_HEAD = 0.28, ARROW_TURN = 0.45;  // of its length; radians
const LEAST_HEAT_CELLS = 16, MOST_HEAT_CELLS = 72;  // along the longer side
const HEAT_LEVELS = 12;
const BAR_ROOM = 130;                        // pixels; the longest scale bar
const NEIGHBOR_RING = 3;

/** Velocities: the length of an arrow is the way of its point in the time in which a fast point reaches its
 * neighbor. If there are many points, only some have arrows. */
function drawArrows(painter, view) {
  const {viewer, sx, sy, sides, camera, detail} = view;
  const {recording, playback, colors} = viewer;
  const {time} = playback;
  const step = Math.max(Math.ceil(detail.inView / MOST_ARROWS), 1);
  const length = Math.max(1.6 * detail.spacing * Math.sqrt(step), 14);
  const perUnit = Math.min(length, 60) / (viewer.fastSpeed() || 1);
  const batch = view.lineBatch.clear();
  for (let point = 0, seen = 0; point < sx.length; ++point) {
    if (sides[point] !== 0 || Number.isNaN(sx[point]) || seen++ % step !== 0) continue;
    const motion = playback.current[point];
    const rate = (coordinate) => viewer.images?.rate(point, coordinate) ?? 0;
    const dx = perUnit * (motionVelocity(recording, motion, time, 0) + rate(0));
    const dy = -perUnit * (motionVelocity(recording, motion, time, 1) + rate(1));
    if (dx === 0 && dy === 0) continue;
    const x = sx[point] + dx, y = sy[point] + dy;
    batch.line(sx[point], sy[point], x, y);
    for (const turn of [ARROW_TURN, -ARROW_TURN]) {
      const cos = ARROW_HEAD * Math.cos(turn), sin = ARROW_HEAD * Math.sin(turn);
      batch.line(x, y, x - cos * dx + sin * dy, y - sin * dx - cos * dy);
    }
  }
  painter.lines(batch, {color: colors.arrow, width: 1.5, cap: 'round'});
}

/** The heat map: counts of the filtered events on a grid over the initial view of the camera. */
class Heat {
  constructor(viewer) {
    this.viewer = viewer;
    const [left, bottom, right, top] = viewer.flatView.extents.whole;
    this.left = left;
    this.bottom = bottom;
    const cells = Math.min(Math.max(Math.sqrt(2 * viewer.recording.rows), LEAST_HEAT_CELLS), MOST_HEAT_CELLS);
    this.size = Math.max(right - left, top - bottom) / Math.round(cells);
    this.columns = Math.max(Math.ceil((right - left) / this.size), 1);
    this.rows = Math.max(Math.ceil((top - bottom) / this.size), 1);
    this.level = new Uint8Array(this.columns * this.rows);
    this.count();
  }

  /** Plays the run to see where the edges and points of each event are. */
  count() {
    const {recording, filter} = this.viewer;
    const {rowTime, rowRemoved, rowAdded, rowA, edgeA, edgeB, edgeX, edgeY, periodic} = recording;
    let counts = new Float64Array(this.level.length);
    const playback = new Playback(recording);
    const place = (point, row, coordinate) => {
      const motion = playback.current[point];
      return motion < 0 ? NaN : motionCoordinate(recording, motion, rowTime[row], coordinate);
    };
    for (let row = 0; row < recording.rows; ++row) {
      playback.goToEvent(row);
      if (!filter.shows(row)) continue;
      const edge = rowRemoved[row] >= 0 ? rowRemoved[row] : rowAdded[row];
      const a = edge >= 0 ? edgeA[edge] : rowA[row], b = edge >= 0 ? edgeB[edge] : a;
      if (a < 0) continue;
      let x = (place(a, row, 0) + place(b, row, 0)) / 2, y = (place(a, row, 1) + place(b, row, 1)) / 2;
      if (periodic !== null) {
        const image = middleInBox(recording, x, y, rowTime[row], edge < 0 ? 0 : edgeX[edge], edge < 0 ? 0 : edgeY[edge]);
        x = image.x;
        y = image.y;
      }
      const column = Math.floor((x - this.left) / this.size), line = Math.floor((y - this.bottom) / this.size);
      if (column >= 0 && line >= 0 && column < this.columns && line < this.rows) {
        ++counts[line * this.columns + column];
      }
    }
    this.most = counts.reduce((a, b) => Math.max(a, b), 0);
    counts = this.spread(this.spread(counts, 1), this.columns);
    const most = counts.reduce((a, b) => Math.max(a, b), 0);
    for (let i = 0; i < counts.length; ++i) {
      this.level[i] = most === 0 ? 0 : Math.round(HEAT_LEVELS * Math.sqrt(counts[i] / most));
    }
  }

  /** Smooths the counts: each gives a quarter to either neighbor, `step` apart. */
  spread(counts, step) {
    const result = new Float64Array(counts.length);
    const line = step === 1 ? this.columns : counts.length;
    for (let i = 0; i < counts.length; ++i) {
      const hasBefore = step === 1 ? i % line > 0 : i >= step;
      const hasAfter = step === 1 ? i % line < line - 1 : i + step < counts.length;
      result[i] = (2 * counts[i] + (hasBefore ? counts[i - step] : 0) + (hasAfter ? counts[i + step] : 0)) / 4;
    }
    return result;
  }

  draw(painter, view) {
    const {camera} = view;
    const batch = view.triangleBatch.clear();
    for (let line = 0; line < this.rows; ++line) {
      for (let column = 0; column < this.columns; ++column) {
        const level = this.level[line * this.columns + column];
        if (level === 0) continue;
        const x0 = Math.round(camera.screenX(this.left + column * this.size));
        const x1 = Math.round(camera.screenX(this.left + (column + 1) * this.size));
        const y0 = Math.round(camera.screenY(this.bottom + line * this.size));
        const y1 = Math.round(camera.screenY(this.bottom + (line + 1) * this.size));
        batch.triangle(x0, y0, x1, y0, x1, y1, level - 1);
        batch.triangle(x0, y0, x1, y1, x0, y1, level - 1);
      }
    }
    painter.triangles(batch, {palette: HEAT_COLORS, alpha: 1});
  }
}

/** The image within a periodic box of the middle of an edge, if (x, y) is the middle without its offset. */
function middleInBox({periodic}, x, y, time, k, l) {
  const move = (coordinate) => (k * boxVector(periodic, 0, coordinate, time) + l * boxVector(periodic, 1, coordinate, time)) / 2;
  const box = new DrawnBox(periodic, time), px = x + move(0), py = y + move(1);
  const along = Math.floor(box.along(px, py)), across = Math.floor(box.across(px, py));
  return {x: px - along * box.ux - across * box.vx, y: py - along * box.uy - across * box.vy};
}

const HEAT_COLORS = Array.from({length: HEAT_LEVELS}, (_, i) =>
  `rgb(213 94 0 / ${Math.round(75 * (i + 1) / HEAT_LEVELS)}%)`);

/** The longest length of the form 1, 2 or 5 times a power of ten that fits. */
function drawScaleBar(painter, view) {
  const {viewer, camera, width, height} = view;
  const {colors, unit} = viewer;
  let n = Math.ceil(3 * Math.log10(BAR_ROOM / camera.scale)) + 1;
  while (roundSpeed(n) * camera.scale > BAR_ROOM) --n;
  const length = roundSpeed(n) * camera.scale, right = width - 16, y = height - 16 - view.axisBottom;
  const batch = view.lineBatch.clear();
  batch.line(right - length, y, right, y);
  batch.line(right - length, y - 4, right - length, y + 4);
  batch.line(right, y - 4, right, y + 4);
  painter.lines(batch, {color: colors.background, width: 5});
  painter.lines(batch, {color: colors.text, width: 1.5});
  painter.text(`${shortNumber(roundSpeed(n))}${unit === '' ? '' : ` ${unit}`}`, right - length / 2, y - 7,
               {color: colors.text, halo: colors.background, font: LABEL_FONT, align: 'center'});
}

/** The cell of the selected point and its neighbors, its trail, and a ring about it. */
function drawSelectedPoint(painter, view) {
  const {viewer} = view;
  const {playback, recording, colors} = viewer;
  const {id: point, edges: pointEdges, showsTrail} = viewer.selectedPoint;
  if (showsTrail) {
    const batch = view.lineBatch.clear();
    addPath(batch, view, playback.current[point], recording.from, playback.time);
    painter.lines(batch, {color: colors.trail, width: 3, cap: 'round'});
  }
  const sides = view.lineBatch.clear();
  for (const edge of pointEdges) {
    setVoronoiEnds(view, edge);
    const {edgeA, edgeB} = recording;
    // In a periodic box, that beside the first end, or beside the second.
    view.setShift(edge);
    if (edgeA[edge] === point) view.addSegment(sides, ENDS[0], ENDS[1], ENDS[2], ENDS[3]);
    if (edgeB[edge] === point) {
      view.addSegment(sides, ENDS[0] - SHIFT.x, ENDS[1] - SHIFT.y, ENDS[2] - SHIFT.x, ENDS[3] - SHIFT.y);
    }
  }
  painter.lines(sides, {color: colors.background, width: 5, cap: 'round'});
  painter.lines(sides, {color: colors.voronoi, width: 3, cap: 'round'});
  const edges = view.lineBatch.clear();
  for (const edge of pointEdges) view.addEdge(edges, edge);
  painter.lines(edges, {color: colors.selected, width: 1.8});
}

/** Rings about the selected point and its neighbors, above the dots. */
function drawPointRings(painter, view) {
  const {viewer} = view;
  const {selectedPoint, colors} = viewer;
  const point = selectedPoint.id;
  for (const edge of selectedPoint.edges) {
    view.drawRing(painter, selectedPoint.neighborAt(edge), NEIGHBOR_RING, colors.selected, 1.5);
  }
  view.drawRing(painter, point, 6, colors.background, 6);
  view.drawRing(painter, point, 6, colors.added, 3);
}
