// SPDX-License-Identifier: GPL-3.0-or-later
//
// Periodic boxes: each point stands for all its images, moved by whole multiples of the two vectors of the
// box. An offset is a pair of whole numbers, how often either vector is added. Everything is in binary64,
// for drawing.
'use strict';

/** The box of the JSON value: the numbers of a vector as its functions of time, {x(t), y(t)}. */
function readPeriodicBox(json) {
  if (json === undefined) return null;
  demand(Array.isArray(json) && json.length === 10 && json.every(Number.isFinite),
         'its periodic box is not ten numbers');
  return {numbers: json};
}

/** The coordinate (0: x, 1: y) of a vector of the box (0 or 1), and how fast it changes. */
function boxVector({numbers}, vector, coordinate, time) {
  return numbers[5 * vector + 1 + coordinate] + boxRate({numbers}, vector, coordinate) * (time - numbers[5 * vector]);
}

function boxRate({numbers}, vector, coordinate) {
  return numbers[5 * vector + 3 + coordinate];
}

/** What follows the name of a point for its image with this offset. */
function offsetText(x, y) {
  return x === 0 && y === 0 ? '' : ` (${x}, ${y})`;
}

/** Whether an edge with these ends and this offset of the second one against the first is named so, and not
 * in the other direction. */
function isForward(a, b, x, y) {
  return a === b ? x > 0 || x === 0 && y > 0 : a < b;
}

const MOST_DISC_IMAGES = 100;

/**
 * The parallelogram that pictures show of a box: (ux, uy) is its first side, (vx, vy) its second one. That is
 * the second vector of the box less `turns` times the first one, so that it leans by half of the first one at
 * most and the picture of a box that is sheared does not become longer and longer.
 */
class DrawnBox {
  constructor(box, time) {
    this.ux = boxVector(box, 0, 0, time);
    this.uy = boxVector(box, 0, 1, time);
    const x = boxVector(box, 1, 0, time), y = boxVector(box, 1, 1, time);
    this.turns = Math.round((this.ux * x + this.uy * y) / (this.ux * this.ux + this.uy * this.uy));
    this.vx = x - this.turns * this.ux;
    this.vy = y - this.turns * this.uy;
    this.area = this.ux * this.vy - this.uy * this.vx;
  }

  /** The corners, [x, y, x, y, ...], counterclockwise from the origin on. */
  corners() {
    const {ux, uy, vx, vy} = this;
    return [0, 0, ux, uy, ux + vx, uy + vy, vx, vy];
  }

  /** The part of a vector along either side. */
  along(x, y) {
    return (x * this.vy - y * this.vx) / this.area;
  }

  across(x, y) {
    return (this.ux * y - this.uy * x) / this.area;
  }

  /** Calls visit(x, y) for the centers of the other images of the disc that reach into the box; not if there are
   * very many, as just before a box loses its area. */
  forEachDiscImage(x, y, radius, visit) {
    const {ux, uy, vx, vy} = this, area = Math.abs(this.area);
    const along = this.along(x, y), across = this.across(x, y);
    const i = radius * Math.hypot(vx, vy) / area, j = radius * Math.hypot(ux, uy) / area;
    const left = Math.floor(along - i), right = Math.floor(along + i);
    const lower = Math.floor(across - j), upper = Math.floor(across + j);
    if (!((right - left + 1) * (upper - lower + 1) <= MOST_DISC_IMAGES)) return;
    for (let k = left; k <= right; ++k) {
      for (let l = lower; l <= upper; ++l) {
        if (k !== 0 || l !== 0) visit(x - k * ux - l * vx, y - k * uy - l * vy);
      }
    }
  }

  /** What is to be added to the vector, in `result`, for the shortest one that differs from it by whole
   * multiples of the sides. */
  toShortest(dx, dy, result) {
    const {ux, uy, vx, vy} = this;
    const k = -Math.round(this.along(dx, dy)), l = -Math.round(this.across(dx, dy));
    let least = Infinity;
    for (let i = k - 1; i <= k + 1; ++i) {
      for (let j = l - 1; j <= l + 1; ++j) {
        const x = i * ux + j * vx, y = i * uy + j * vy;
        const distance = (dx + x) ** 2 + (dy + y) ** 2;
        if (!(distance < least)) continue;
        least = distance;
        result.x = x;
        result.y = y;
      }
    }
  }
}

/** The images of all points that are in the box as it is drawn. */
class Images {
  constructor(recording) {
    this.recording = recording;
    this.movesX = new Float64Array(recording.points);  // how often each side of the box is added
    this.movesY = new Float64Array(recording.points);
    this.box = null;
  }

  /** Moves the positions into the box at the time. */
  wrap(time, xs, ys) {
    const box = this.box = new DrawnBox(this.recording.periodic, time);
    const {movesX, movesY} = this;
    for (let point = 0; point < xs.length; ++point) {
      const x = xs[point], y = ys[point];
      const k = movesX[point] = -Math.floor(box.along(x, y)), l = movesY[point] = -Math.floor(box.across(x, y));
      xs[point] = x + k * box.ux + l * box.vx;
      ys[point] = y + k * box.uy + l * box.vy;
    }
  }

  /** What is to be added to the image of `to` in the box for the one that has the offset (x, y) against the
   * image of `from` in the box; in `result`. Without an offset it is zero exactly. */
  shift(from, to, x, y, result) {
    const {movesX, movesY, box} = this;
    const k = x + box.turns * y + movesX[from] - movesX[to], l = y + movesY[from] - movesY[to];
    result.x = k * box.ux + l * box.vx;
    result.y = k * box.uy + l * box.vy;
  }

  /** What is added to the place of the point at another time, or to its velocity, for the image that is in
   * the box now. */
  moveAt(point, coordinate, time) {
    return this.sum(point, (vector) => boxVector(this.recording.periodic, vector, coordinate, time));
  }

  rate(point, coordinate) {
    return this.sum(point, (vector) => boxRate(this.recording.periodic, vector, coordinate));
  }

  sum(point, component) {
    const l = this.movesY[point], k = this.movesX[point] - this.box.turns * l;
    return (k === 0 ? 0 : k * component(0)) + (l === 0 ? 0 : l * component(1));
  }
}

const BOX_TIMES = 32;  // at which the box is looked at for the extent of the picture

/** The bounding box of the box at all times of the run, and beside it as much as the distance of the points,
 * half of its greater side at most: so much is seen of edges that leave the box. */
function extentOfBox({periodic, from, until, points}) {
  const xs = [], ys = [];
  for (let i = 0; i <= BOX_TIMES; ++i) {
    const share = i / BOX_TIMES;
    const corners = new DrawnBox(periodic, (1 - share) * from + share * until).corners();
    corners.forEach((number, k) => (k % 2 === 0 ? xs : ys).push(number));
  }
  const least = [Math.min(...xs), Math.min(...ys)], greatest = [Math.max(...xs), Math.max(...ys)];
  const side = Math.max(greatest[0] - least[0], greatest[1] - least[1]);
  const room = side / Math.max(Math.sqrt(points), 2);
  return [least[0] - room, least[1] - room, greatest[0] + room, greatest[1] + room];
}
