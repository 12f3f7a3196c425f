// SPDX-License-Identifier: GPL-3.0-or-later
//
// The common part of the flat view and the wave view: the points' positions on the screen, their
// ids, and which point or edge is at a position on the screen.
'use strict';

const LABEL_CELL = 6;  // pixels; a label takes the cells that it touches, so that none overlap
const LABEL_HEIGHT = 13;
const LABEL_FONT = '11px system-ui, sans-serif';
const SEEN_MARGIN = 16;
const VIEW_MARGIN = 12;  // pixels between what is selected and the border; a picture of everything has more
const POINT_REACH = 5;  // pixels beside a dot
const NOTHING = {kind: 'none', id: -1};
const SHIFT = {x: 0, y: 0};
const SEGMENT = new Float64Array(4);

class View {
  constructor(viewer) {
    this.viewer = viewer;
    this.width = this.height = 1;
    this.sx = new Float64Array(viewer.recording.points);  // on the screen; NaN: not there
    this.sy = new Float64Array(viewer.recording.points);
    this.labeled = new Uint8Array(0);
    this.labelWidth = new Float32Array(viewer.recording.points);  // 0: not measured yet
    // For drawing; each is filled and drawn before the next use.
    this.lineBatch = new Batch(LINE);
    this.circleBatch = new Batch(CIRCLE);
    this.triangleBatch = new Batch(TRIANGLE);
  }

  /** Writes the ids of as many points as there is room for, the lesser ids first; "3 +2" where two others
   * coincide with the point 3. */
  drawIds(painter) {
    const {sx, sy, width, height, labelWidth} = this;
    const {colors, hidden, playback: {coincident}} = this.viewer;
    const columns = Math.ceil(width / LABEL_CELL) + 1;
    const cells = columns * (Math.ceil(height / LABEL_CELL) + 1);
    if (this.labeled.length < cells) this.labeled = new Uint8Array(cells);
    this.labeled.fill(0);
    const {context} = this.viewer.stage.canvasPainter;
    context.font = LABEL_FONT;
    const style = {color: colors.text, halo: colors.background, font: LABEL_FONT};
    for (let point = 0; point < sx.length; ++point) {
      if (hidden[point] === COINCIDENT || !this.isSeen(sx[point], sy[point], 0)) continue;
      const name = this.viewer.pointName(point);
      if (labelWidth[point] === 0) labelWidth[point] = context.measureText(name).width + 1;
      const more = coincident[point] === 0 ? '' : ` +${coincident[point]}`;
      const width = labelWidth[point] + (more === '' ? 0 : context.measureText(more).width);
      const x = sx[point] + 6, y = sy[point] - 5;
      if (this.takeRoom(x, y - LABEL_HEIGHT + 3, width, columns)) {
        painter.text(name + more, x, y, style);
      }
    }
  }

  /** Whether there is room for a label, which is then taken. */
  takeRoom(x, y, width, columns) {
    const {labeled} = this;
    const left = Math.max(Math.floor(x / LABEL_CELL), 0);
    const right = Math.floor((x + width) / LABEL_CELL);
    const top = Math.max(Math.floor(y / LABEL_CELL), 0);
    const bottom = Math.max(Math.floor((y + LABEL_HEIGHT) / LABEL_CELL), top);
    const last = Math.min(right, columns - 1);
    for (let row = top; row <= bottom; ++row) {
      for (let column = left; column <= last; ++column) {
        if (labeled[columns * row + column] === 1) return false;
      }
    }
    for (let row = top; row <= bottom; ++row) {
      labeled.fill(1, columns * row + left, columns * row + last + 1);
    }
    return true;
  }

  /** A ring about the dot of a point. */
  drawRing(painter, point, more, color, width = 2, alpha = 1) {
    if (Number.isNaN(this.sx[point])) return;
    const ring = this.circleBatch.clear();
    ring.circle(this.sx[point], this.sy[point], this.pointRadius() + more);
    painter.circles(ring, {stroke: color, width, alpha});
  }

  /** Moves the picture by as little as brings the points into it; those that are not there are left out. */
  bringIntoView(points) {
    this.project();
    const there = points.filter((point) => !Number.isNaN(this.sx[point]));
    if (there.length === 0) return;
    const move = (places, from, until) => {
      const least = Math.min(...places), greatest = Math.max(...places);
      const low = from + VIEW_MARGIN, high = until - VIEW_MARGIN;
      if (greatest - least > high - low) return (low + high) / 2 - (least + greatest) / 2;
      return Math.max(low - least, 0) - Math.max(greatest - high, 0);
    };
    const dx = move(there.map((point) => this.sx[point]), this.axisLeft ?? 0, this.width);
    const dy = move(there.map((point) => this.sy[point]), 0, this.height - (this.axisBottom ?? 0));
    if (dx !== 0 || dy !== 0) this.drag(dx, dy, true);
  }

  /** Whether a disc on the screen is in the picture; false for a point that is not there. */
  isSeen(x, y, radius) {
    return x >= -radius && y >= -radius && x <= this.width + radius &&
      y <= this.height + radius;
  }

  /** Adds the part of a segment that may be seen. */
  addSegment(batch, x0, y0, x1, y1, shade = 0) {
    const {width, height} = this;
    const right = width + SEEN_MARGIN, bottom = height + SEEN_MARGIN;
    if (x0 < -SEEN_MARGIN && x1 < -SEEN_MARGIN || x0 > right && x1 > right ||
        y0 < -SEEN_MARGIN && y1 < -SEEN_MARGIN || y0 > bottom && y1 > bottom) {
      return;
    }
    const isInside = x0 >= -width && x0 <= 2 * width && x1 >= -width && x1 <= 2 * width &&
      y0 >= -height && y0 <= 2 * height && y1 >= -height && y1 <= 2 * height;
    if (isInside) {
      batch.line(x0, y0, x1, y1, shade);
      return;
    }
    // Of a long one numbers of 32 bits would not keep the direction. What is not finite is left out.
    ENDS[0] = x0;
    ENDS[1] = y0;
    ENDS[2] = x1;
    ENDS[3] = y1;
    if (clipSegment(ENDS, width, height, SEEN_MARGIN)) {
      batch.line(ENDS[0], ENDS[1], ENDS[2], ENDS[3], shade);
    }
  }

  /** Adds the edge; one that leaves a periodic box at both ends. */
  addEdge(batch, edge, shade = 0) {
    this.setShift(edge);
    this.addLink(batch, this.viewer.recording.edgeA[edge], this.viewer.recording.edgeB[edge], shade);
  }

  /** Adds the line from point a to the image of point b that is SHIFT away from b; if SHIFT is not zero, also the
   * one from the corresponding image of a to b. */
  addLink(batch, a, b, shade = 0) {
    const {sx, sy} = this;
    const {x, y} = SHIFT;
    this.addSegment(batch, sx[a], sy[a], sx[b] + x, sy[b] + y, shade);
    if (x !== 0 || y !== 0) this.addSegment(batch, sx[a] - x, sy[a] - y, sx[b], sy[b], shade);
  }

  /** Sets SHIFT to what leads, on the screen, from the second end of the edge to the image at which the edge
   * ends if it begins at the first end; it is zero unless it leaves a periodic box. */
  setShift(edge) {
    const {recording: {edgeA, edgeB, edgeX, edgeY}} = this.viewer;
    if (edgeX === null) SHIFT.x = SHIFT.y = 0;
    else this.setShiftOf(edgeA[edge], edgeB[edge], edgeX[edge], edgeY[edge]);
  }

  /** Sets SHIFT likewise for an encounter, that is for two points within range of each other. */
  setShiftOfEncounter(encounter) {
    const {recording: {encounters: {a, b, x, y}}} = this.viewer;
    if (x === null) SHIFT.x = SHIFT.y = 0;
    else this.setShiftOf(a[encounter], b[encounter], x[encounter], y[encounter]);
  }

  /** Sets SHIFT likewise for two points and the offset of the second against the first. */
  setShiftOf(from, to, x, y) {
    this.viewer.images.shift(from, to, x, y, SHIFT);
    SHIFT.x *= this.camera.scale;
    SHIFT.y *= -this.camera.scale;
  }

  /** Sets SHIFT to what leads, on the screen, from a point to the image of it that is nearest to the position;
   * zero without a periodic box. */
  setShiftToward(point, x, y) {
    const {viewer: {images}, camera, sx, sy} = this;
    SHIFT.x = SHIFT.y = 0;
    if (images === null || Number.isNaN(sx[point])) return;
    images.box.toShortest((sx[point] - x) / camera.scale, (y - sy[point]) / camera.scale, SHIFT);
    SHIFT.x *= camera.scale;
    SHIFT.y *= -camera.scale;
  }

  /** What a click selects: a point, an edge, or, where cells are shown, the point of a cell: {kind, id}. In
   * the middle third of an edge the edge is meant, even if a point is near. */
  thingAt(x, y, reach) {
    const {switches, coloring} = this.viewer;
    const point = this.pointAt(x, y, Math.max(this.pointRadius() + POINT_REACH, reach));
    const edge = switches.delaunay || switches.wave ? this.edgeAt(x, y, reach) : -1;
    if (point >= 0 && (edge < 0 || !this.isInMiddle(edge, x, y))) return {kind: 'point', id: point};
    if (edge >= 0) return {kind: 'edge', id: edge};
    if (!switches.wave && (switches.voronoi || coloring !== null)) {
      const owner = this.ownerAt(x, y);
      if (owner >= 0) return {kind: 'cell', id: owner};
    }
    return NOTHING;
  }

  isInMiddle(edge, x, y) {
    this.distanceToEdge(edge, x, y);
    const [x0, y0, x1, y1] = SEGMENT, dx = x1 - x0, dy = y1 - y0;
    const along = ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy);
    return along > 1 / 3 && along < 2 / 3;
  }

  /** The squared distance of a position on the screen from the edge, as it is drawn; and in SEGMENT the ends of
   * the nearest drawing of it. */
  distanceToEdge(edge, x, y) {
    const {sx, sy} = this;
    const {edgeA, edgeB} = this.viewer.recording, a = edgeA[edge], b = edgeB[edge];
    this.setShift(edge);
    const first = distanceToSegment(sx[a], sy[a], sx[b] + SHIFT.x, sy[b] + SHIFT.y, x, y);
    const isTwice = SHIFT.x !== 0 || SHIFT.y !== 0;
    const second = isTwice ? distanceToSegment(sx[a] - SHIFT.x, sy[a] - SHIFT.y, sx[b], sy[b], x, y) : Infinity;
    const isSecond = second < first;
    SEGMENT[0] = sx[a] - (isSecond ? SHIFT.x : 0);
    SEGMENT[1] = sy[a] - (isSecond ? SHIFT.y : 0);
    SEGMENT[2] = sx[b] + (isSecond ? 0 : SHIFT.x);
    SEGMENT[3] = sy[b] + (isSecond ? 0 : SHIFT.y);
    return isSecond ? second : first;
  }

  /** The point in whose cell the position is: the least power to it. */
  ownerAt(x, y) {
    const {sx, sy, sw} = this;
    let owner = -1, least = Infinity;
    for (let point = 0; point < sx.length; ++point) {
      this.setShiftToward(point, x, y);
      const dx = sx[point] + SHIFT.x - x, dy = sy[point] + SHIFT.y - y;
      const power = dx * dx + dy * dy - sw[point];
      if (power < least) {
        least = power;
        owner = point;
      }
    }
    return this.shownAt(owner);
  }

  /** The point that is shown in the place of a point; -1 for -1. */
  shownAt(point) {
    return point < 0 ? -1 : this.viewer.playback.shown[point];
  }

  pointAt(x, y, reach) {
    let nearest = -1, least = reach * reach;
    for (let point = 0; point < this.sx.length; ++point) {
      this.setShiftToward(point, x, y);
      const dx = this.sx[point] + SHIFT.x - x, dy = this.sy[point] + SHIFT.y - y;
      const distance = dx * dx + dy * dy;
      if (distance <= least) {
        least = distance;
        nearest = point;
      }
    }
    return this.shownAt(nearest);
  }

  /** The edge nearest to a position on the screen, within reach; or -1. */
  edgeAt(x, y, reach) {
    const {playback} = this.viewer;
    let nearest = -1, least = reach * reach;
    for (let i = 0; i < playback.liveCount; ++i) {
      const edge = playback.live[i];
      const distance = this.distanceToEdge(edge, x, y);
      if (distance <= least) {
        least = distance;
        nearest = edge;
      }
    }
    return nearest;
  }
}

/** The squared distance of the position (x, y) from a segment. */
function distanceToSegment(x0, y0, x1, y1, x, y) {
  const dx = x1 - x0, dy = y1 - y0;
  const along = ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy);
  const t = Math.min(Math.max(along, 0), 1);
  const ex = x0 + t * dx - x, ey = y0 + t * dy - y;
  return ex * ex + ey * ey;
}
