// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Voronoi or power cells at the time shown, from the triangles that the recording has: corners,
// areas, and numbers of neighbors. Points that coincide for a while share the area of one cell equally;
// those that are hidden have the shown one as their only neighbor. In binary64; an area errs by some units in the last place of the
// squared distance from the point to the corners of its cell.
'use strict';

const ANCHOR = {x: 0, y: 0};

class Cells {
  constructor(viewer) {
    this.viewer = viewer;
    const {points} = viewer.recording;
    this.area = new Float64Array(points);    // NaN: without bounds; 0: there is no cell
    this.degree = new Uint32Array(points);   // number of neighbors
    this.isSpecial = new Uint8Array(points); // 1: the cell is unbounded, or the box cuts it
    this.anchorX = new Float64Array(points); // a place in each other cell: the mean of its corners
    this.anchorY = new Float64Array(points);
    this.ends = new Float64Array(0);         // of the cells' common sides: to the right, to the left
    this.polygons = new Map();               // the special cells within the box
    this.shifts = new Float64Array(0);       // in a periodic box
  }

  /** Computes all cells for the viewer's positions. */
  update() {
    const {viewer, area, degree, isSpecial, anchorX, anchorY} = this;
    const {x, y, w, playback, recording} = viewer;
    const {live, liveCount} = playback, {left, right} = playback.triangles;
    const {edgeA, edgeB, box} = recording;
    for (const list of [area, degree, isSpecial, anchorX, anchorY]) list.fill(0);
    this.polygons.clear();
    if (this.ends.length < 4 * liveCount) this.ends = new Float64Array(8 * liveCount);
    const {ends} = this;
    if (recording.periodic !== null) {
      this.updatePeriodic();
      return;
    }
    const setEnd = (at, a, b, c) => {
      if (c >= 0) {
        powerCenter(ANCHOR, x[a], y[a], w[a], x[b], y[b], w[b], x[c], y[c], w[c]);
      } else {
        ANCHOR.x = ANCHOR.y = NaN;
      }
      ends[at] = ANCHOR.x;
      ends[at + 1] = ANCHOR.y;
      const isInside = Number.isFinite(ANCHOR.x) && Number.isFinite(ANCHOR.y) && (box === null ||
        ANCHOR.x >= box[0] && ANCHOR.y >= box[1] && ANCHOR.x <= box[2] && ANCHOR.y <= box[3]);
      if (!isInside) isSpecial[a] = isSpecial[b] = 1;
    };
    for (let i = 0; i < liveCount; ++i) {
      const edge = live[i], a = edgeA[edge], b = edgeB[edge], at = 4 * i;
      ++degree[a];
      ++degree[b];
      setEnd(at, a, b, right[edge]);
      setEnd(at + 2, a, b, left[edge]);
      // Around a, the side that it shares with b leads from the right to the left of ab.
      const rx = ends[at], ry = ends[at + 1], lx = ends[at + 2], ly = ends[at + 3];
      area[a] += ((rx - x[a]) * (ly - y[a]) - (ry - y[a]) * (lx - x[a])) / 2;
      area[b] += ((lx - x[b]) * (ry - y[b]) - (ly - y[b]) * (rx - x[b])) / 2;
      anchorX[a] += rx + lx;
      anchorY[a] += ry + ly;
      anchorX[b] += rx + lx;
      anchorY[b] += ry + ly;
    }
    for (let point = 0; point < degree.length; ++point) {
      anchorX[point] /= 2 * degree[point];
      anchorY[point] /= 2 * degree[point];
      if (isSpecial[point] === 1) area[point] = NaN;
    }
    if (box !== null) this.cutSpecial();
    if (recording.coincidences > 0) this.share();
  }

  /** The same in a periodic box. Each cell is about the image of its point that is in the box; `ends` are
   * beside the first point of an edge, and `shifts` lead to them from those beside the second. */
  updatePeriodic() {
    const {viewer, area, degree, anchorX, anchorY, ends} = this;
    const {x, y, w, images, recording: {edgeA, edgeB, edgeX, edgeY, coincidences}} = viewer;
    const {live, liveCount, triangles} = viewer.playback;
    if (this.shifts.length < 2 * liveCount) this.shifts = new Float64Array(4 * liveCount);
    const {shifts} = this, shift = {x: 0, y: 0};
    const place = (a, [id, k, l]) => {
      images.shift(a, id, k, l, shift);
      return [x[id] + shift.x, y[id] + shift.y];
    };
    for (let i = 0; i < liveCount; ++i) {
      const edge = live[i], a = edgeA[edge], b = edgeB[edge], at = 4 * i;
      const q = place(a, [b, edgeX[edge], edgeY[edge]]);
      shifts[2 * i] = shift.x;
      shifts[2 * i + 1] = shift.y;
      for (const isLeft of [false, true]) {
        const corner = triangles.imageAt(edge, isLeft);
        powerCenter(ANCHOR, x[a], y[a], w[a], ...q, w[b], ...place(a, corner), w[corner[0]]);
        ends[at + (isLeft ? 2 : 0)] = ANCHOR.x;
        ends[at + (isLeft ? 3 : 1)] = ANCHOR.y;
      }
      const add = (point, px, py, rx, ry, lx, ly) => {
        ++degree[point];
        area[point] += ((rx - px) * (ly - py) - (ry - py) * (lx - px)) / 2;
        anchorX[point] += rx + lx - 2 * (px - x[point]);
        anchorY[point] += ry + ly - 2 * (py - y[point]);
      };
      const [rx, ry, lx, ly] = ends.subarray(at, at + 4);
      add(a, x[a], y[a], rx, ry, lx, ly);
      add(b, ...q, lx, ly, rx, ry);
    }
    for (let point = 0; point < degree.length; ++point) {
      anchorX[point] /= 2 * degree[point];
      anchorY[point] /= 2 * degree[point];
    }
    if (coincidences > 0) this.share();
  }

  /** In a periodic box, visits the triangles of cells as forEachTriangle, and those images of each cell that
   * cover what it covers of the box. */
  forEachPeriodicTriangle(visit) {
    const {ends, shifts, anchorX, anchorY, viewer: {images: {box}, playback, recording: {edgeA, edgeB}}} = this;
    const sides = (each) => {
      for (let i = 0; i < playback.liveCount; ++i) {
        const edge = playback.live[i], [rx, ry, lx, ly] = ends.subarray(4 * i, 4 * i + 4);
        const dx = shifts[2 * i], dy = shifts[2 * i + 1];
        each(edgeA[edge], rx, ry, lx, ly);
        each(edgeB[edge], lx - dx, ly - dy, rx - dx, ry - dy);
      }
    };
    // The copies of the box in which the corners of each cell are.
    const copies = Array.from(anchorX, () => ({k: [], l: []}));
    sides((point, x, y) => {
      copies[point].k.push(Math.floor(box.along(x, y)));
      copies[point].l.push(Math.floor(box.across(x, y)));
    });
    sides((point, x0, y0, x1, y1) => forEachCopy(copies[point].k, copies[point].l, (k, l) => {
      const dx = k * box.ux + l * box.vx, dy = k * box.uy + l * box.vy;
      visit(point, anchorX[point] - dx, anchorY[point] - dy, x0 - dx, y0 - dy, x1 - dx, y1 - dy);
    }));
  }

  /** Shares the areas of the cells of points that coincide. */
  share() {
    const {area, degree, viewer: {hidden, playback: {shown, coincident}}} = this;
    for (let point = 0; point < area.length; ++point) {
      area[point] /= 1 + coincident[point];
      degree[point] += coincident[point];
    }
    for (let point = 0; point < area.length; ++point) {
      if (hidden[point] !== COINCIDENT) continue;
      area[point] = area[shown[point]];
      degree[point] = 1;
    }
  }

  /** The special cells: what their bisectors leave of the box. */
  cutSpecial() {
    const {viewer, isSpecial, polygons, area} = this;
    const {x, y, w, playback, recording} = viewer;
    const [left, bottom, right, top] = recording.box;
    for (let point = 0; point < isSpecial.length; ++point) {
      if (isSpecial[point] === 1) polygons.set(point, [left, bottom, right, bottom, right, top, left, top]);
    }
    for (let i = 0; i < playback.liveCount; ++i) {
      const edge = playback.live[i], a = recording.edgeA[edge], b = recording.edgeB[edge];
      if (isSpecial[a] === 1) polygons.set(a, nearerPart(polygons.get(a), x, y, w, a, b));
      if (isSpecial[b] === 1) polygons.set(b, nearerPart(polygons.get(b), x, y, w, b, a));
    }
    for (const [point, polygon] of polygons) area[point] = areaOf(polygon);
  }

  /** Visits the cells as triangles: (point, three corners in the plane). Cells without bounds are
   * left out. */
  forEachTriangle(visit) {
    if (this.viewer.images !== null) {
      this.forEachPeriodicTriangle(visit);
      return;
    }
    const {ends, isSpecial, anchorX, anchorY, polygons} = this;
    const {playback, recording} = this.viewer;
    for (let i = 0; i < playback.liveCount; ++i) {
      const edge = playback.live[i], at = 4 * i;
      for (let k = 0; k < 2; ++k) {
        const point = k === 0 ? recording.edgeA[edge] : recording.edgeB[edge];
        if (isSpecial[point] === 1) continue;
        visit(point, anchorX[point], anchorY[point], ends[at], ends[at + 1], ends[at + 2], ends[at + 3]);
      }
    }
    for (const [point, polygon] of polygons) {
      for (let k = 2; k + 3 < polygon.length; k += 2) {
        visit(point, polygon[0], polygon[1], polygon[k], polygon[k + 1], polygon[k + 2], polygon[k + 3]);
      }
    }
  }
}

/** The part of a convex polygon, [x, y, x, y, ...], in which the power of a is at most that of
 * b (Sutherland and Hodgman, Reentrant polygon clipping, Communications of the ACM 17, 1974). */
function nearerPart(polygon, x, y, w, a, b) {
  // Positive where a is nearer.
  const dx = x[b] - x[a], dy = y[b] - y[a];
  const value = (px, py) =>
    dx * dx + dy * dy - (w[b] - w[a]) - 2 * (dx * (px - x[a]) + dy * (py - y[a]));
  const result = [];
  for (let i = 0; i < polygon.length; i += 2) {
    const j = (i + 2) % polygon.length;
    const from = value(polygon[i], polygon[i + 1]), to = value(polygon[j], polygon[j + 1]);
    if (from >= 0) result.push(polygon[i], polygon[i + 1]);
    if (from >= 0 !== to >= 0) {
      const share = from / (from - to);
      result.push(polygon[i] + share * (polygon[j] - polygon[i]),
                  polygon[i + 1] + share * (polygon[j + 1] - polygon[i + 1]));
    }
  }
  return result;
}

/** The area of a counterclockwise polygon, [x, y, x, y, ...]. */
function areaOf(polygon) {
  let sum = 0;
  for (let i = 4; i < polygon.length; i += 2) {
    sum += (polygon[i - 2] - polygon[0]) * (polygon[i + 1] - polygon[1]) -
      (polygon[i - 1] - polygon[1]) * (polygon[i] - polygon[0]);
  }
  return sum / 2;
}

/** The area of the cell of one point at the known time of a playback, or its share if others coincide with
 * it; NaN if the cell is unbounded, 0 if there is none. */
function areaOfCell(playback, point, box) {
  const shown = playback.shown[point];
  return areaOfWholeCell(playback, shown, box) / (1 + playback.coincident[shown]);
}

function areaOfWholeCell(playback, point, box) {
  const {recording, live, liveCount, current, triangles} = playback;
  if (recording.periodic !== null) return areaOfPeriodicCell(playback, point);
  const time = knownTime(playback);
  const {edgeA, edgeB} = recording;
  const at = (p) => [motionX(recording, current[p], time), motionY(recording, current[p], time),
                     motionWeight(recording, current[p], time)];
  const here = current[point];
  if (here < 0 || recording.motionThere[here] !== 1) return 0;
  const p = at(point);
  let sum = 0, isOpen = false, degree = 0;
  let polygon = box === null ? null : [box[0], box[1], box[2], box[1], box[2], box[3], box[0], box[3]];
  for (let i = 0; i < liveCount; ++i) {
    const edge = live[i];
    if (edgeA[edge] !== point && edgeB[edge] !== point) continue;
    const isFirst = edgeA[edge] === point;
    const other = isFirst ? edgeB[edge] : edgeA[edge];
    ++degree;
    const q = at(other);
    if (polygon !== null) {
      polygon = nearerPart(polygon, [p[0], q[0]], [p[1], q[1]], [p[2], q[2]], 0, 1);
      continue;
    }
    const ends = [isFirst ? triangles.right[edge] : triangles.left[edge],
                  isFirst ? triangles.left[edge] : triangles.right[edge]].map((corner) => {
      if (corner < 0) return null;
      powerCenter(ANCHOR, ...p, ...q, ...at(corner));
      return [ANCHOR.x - p[0], ANCHOR.y - p[1]];
    });
    if (ends[0] === null || ends[1] === null) isOpen = true;
    else sum += (ends[0][0] * ends[1][1] - ends[0][1] * ends[1][0]) / 2;
  }
  if (degree === 0 && recording.motionSizes !== null) return 0;
  if (degree === 0 && polygon === null) return NaN;
  return polygon !== null ? areaOf(polygon) : isOpen ? NaN : sum;
}

/** The same in a periodic box, in which all cells are bounded. */
function areaOfPeriodicCell(playback, point) {
  const {recording, live, liveCount, current, triangles} = playback;
  const time = knownTime(playback), {periodic, edgeA, edgeB, edgeX, edgeY} = recording;
  const place = ([id, k, l]) => [0, 1].map((coordinate) =>
    (coordinate === 0 ? motionX : motionY)(recording, current[id], time) +
    k * boxVector(periodic, 0, coordinate, time) + l * boxVector(periodic, 1, coordinate, time));
  let sum = 0;
  for (let i = 0; i < liveCount; ++i) {
    const edge = live[i];
    if (edgeA[edge] !== point && edgeB[edge] !== point) continue;
    const p = place([edgeA[edge], 0, 0]), q = place([edgeB[edge], edgeX[edge], edgeY[edge]]);
    const weight = (id) => motionWeight(recording, current[id], time);
    const [right, left] = [false, true].map((isLeft) => {
      const corner = triangles.imageAt(edge, isLeft);
      powerCenter(ANCHOR, ...p, weight(edgeA[edge]), ...q, weight(edgeB[edge]), ...place(corner), weight(corner[0]));
      return [ANCHOR.x, ANCHOR.y];
    });
    const part = (from, [x, y], to) => ((from[0] - x) * (to[1] - y) - (from[1] - y) * (to[0] - x)) / 2;
    if (edgeA[edge] === point) sum += part(right, p, left);
    if (edgeB[edge] === point) sum += part(left, q, right);
  }
  return sum;
}
