// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangles, as the recording has them, and their centers.
'use strict';

/**
 * The triangles at some moment, by their sides. Of an edge ab with a < b, `left[edge]` is the third
 * corner of the triangle to the left of ab, and `right[edge]` that of the triangle to its right; -1
 * if there is no triangle. In a periodic box `leftX`, `leftY`, `rightX` and `rightY` are the offsets of
 * these corners against a.
 */
class Triangles {
  constructor(edges, isPeriodic = false) {
    this.left = new Int32Array(edges).fill(-1);
    this.right = new Int32Array(edges).fill(-1);
    this.isPeriodic = isPeriodic;
    if (isPeriodic) for (const name of OFFSETS_OF_CORNERS) this[name] = new Int32Array(edges);
  }

  clone() {
    const copy = new Triangles(0, this.isPeriodic);
    copy.left = this.left.slice();
    copy.right = this.right.slice();
    if (this.isPeriodic) for (const name of OFFSETS_OF_CORNERS) copy[name] = this[name].slice();
    return copy;
  }

  /** In a periodic box, the corner to the left or to the right of the edge: [id, x, y]; null if there is
   * none. */
  imageAt(edge, isLeft) {
    const id = isLeft ? this.left[edge] : this.right[edge];
    if (id < 0) return null;
    return isLeft ? [id, this.leftX[edge], this.leftY[edge]] : [id, this.rightX[edge], this.rightY[edge]];
  }

  /** Adds or removes the i-th triangle of the recording. */
  set(recording, i, isThere) {
    if (this.isPeriodic) {
      this.setImages(recording, i, isThere);
      return;
    }
    const {triangleCorners, triangleSides, edgeA} = recording;
    for (let k = 3 * i; k < 3 * i + 3; ++k) {
      const edge = triangleSides[k];
      const side = triangleCorners[k] === edgeA[edge] ? this.left : this.right;
      side[edge] = isThere ? triangleCorners[k === 3 * i ? k + 2 : k - 1] : -1;
    }
  }

  setImages({triangleCorners, triangleSides, triangleForward, triangleOffsets}, i, isThere) {
    for (let k = 3 * i; k < 3 * i + 3; ++k) {
      const edge = triangleSides[k], isLeft = triangleForward[k] === 1;
      const side = isLeft ? this.left : this.right;
      const apex = k === 3 * i ? k + 2 : k - 1;
      side[edge] = isThere ? triangleCorners[apex] : -1;
      const a = isLeft ? k : k === 3 * i + 2 ? 3 * i : k + 1;
      (isLeft ? this.leftX : this.rightX)[edge] = triangleOffsets[2 * apex] - triangleOffsets[2 * a];
      (isLeft ? this.leftY : this.rightY)[edge] = triangleOffsets[2 * apex + 1] - triangleOffsets[2 * a + 1];
    }
  }

  /** How many edges of the i-th triangle of the recording have this triangle beside them now: 0 to
   * 3; -1 if one of them has another triangle there. */
  sidesInUse({triangleCorners, triangleSides, triangleForward, triangleOffsets, edgeA}, i) {
    let count = 0;
    for (let k = 3 * i; k < 3 * i + 3; ++k) {
      const edge = triangleSides[k];
      const isLeft = this.isPeriodic ? triangleForward[k] === 1 : triangleCorners[k] === edgeA[edge];
      const side = isLeft ? this.left : this.right, apex = k === 3 * i ? k + 2 : k - 1;
      if (side[edge] < 0) continue;
      if (side[edge] !== triangleCorners[apex]) return -1;
      if (this.isPeriodic) {
        const [, x, y] = this.imageAt(edge, isLeft), a = isLeft ? k : k === 3 * i + 2 ? 3 * i : k + 1;
        if (x !== triangleOffsets[2 * apex] - triangleOffsets[2 * a] ||
            y !== triangleOffsets[2 * apex + 1] - triangleOffsets[2 * a + 1]) return -1;
      }
      ++count;
    }
    return count;
  }
}

const OFFSETS_OF_CORNERS = ['leftX', 'leftY', 'rightX', 'rightY'];

/** The list of the triangles of a playback, three corners each, counterclockwise; in a periodic box with the
 * offsets of corners 1 and 2 against corner 0, four numbers a triangle. `update` makes them those of the time
 * shown. */
class TriangleList {
  constructor(playback) {
    this.offsets = [];
    this.playback = playback;
    this.event = -1;  // of the playback when the list was made
    this.corners = new Uint32Array(0);
    this.triangles = 0;
  }

  update() {
    const {playback} = this;
    if (this.event === playback.event) return;
    this.event = playback.event;
    const {edgeA, edgeB} = playback.recording;
    const {left} = playback.triangles;
    if (playback.recording.periodic !== null) {
      this.listImages();
      return;
    }
    // An edge has two triangles at most, a triangle three edges.
    if (this.corners.length < 2 * playback.liveCount) {
      this.corners = new Uint32Array(2 * playback.liveCount + 64);
    }
    this.triangles = 0;
    for (let i = 0; i < playback.liveCount; ++i) {
      const edge = playback.live[i], a = edgeA[edge];
      // Each triangle once: at the side that leads away from its least corner.
      if (left[edge] < a) continue;
      const at = 3 * this.triangles++;
      this.corners[at] = a;
      this.corners[at + 1] = edgeB[edge];
      this.corners[at + 2] = left[edge];
    }
  }

  /** Lists the triangles of a periodic box, each once: by the least of its three names. */
  listImages() {
    const {live, liveCount, triangles, recording: {edgeA, edgeB, edgeX, edgeY}} = this.playback;
    const corners = [];
    this.offsets = [];
    const add = (a, b, c) => {
      const images = [a, b, c];
      const names = images.map((p, k) => {
        const q = images[(k + 1) % 3], r = images[(k + 2) % 3];
        return [p[0], q[0], r[0], q[1] - p[1], q[2] - p[2], r[1] - p[1], r[2] - p[2]];
      });
      const isLess = (s, t) => {
        const k = s.findIndex((number, i) => number !== t[i]);
        return k >= 0 && s[k] < t[k];
      };
      if (isLess(names[1], names[0]) || isLess(names[2], names[0])) return;
      corners.push(...names[0].slice(0, 3));
      this.offsets.push(...names[0].slice(3));
    };
    for (let i = 0; i < liveCount; ++i) {
      const edge = live[i], a = [edgeA[edge], 0, 0], b = [edgeB[edge], edgeX[edge], edgeY[edge]];
      add(a, b, triangles.imageAt(edge, true));
      add(b, a, triangles.imageAt(edge, false));
    }
    this.corners = Uint32Array.from(corners);
    this.triangles = corners.length / 3;
  }
}

/** The place of equal power to three weighted points a, b and c, in `center.x` and `center.y`; not
 * finite where the points are collinear. Of points without weights it is the center of the circle
 * through them. */
function powerCenter(center, ax, ay, aw, bx, by, bw, cx, cy, cw) {
  const ux = bx - ax, uy = by - ay, vx = cx - ax, vy = cy - ay;
  const u = ux * ux + uy * uy - (bw - aw), v = vx * vx + vy * vy - (cw - aw);
  const d = 2 * (ux * vy - uy * vx);
  center.x = ax + (vy * u - uy * v) / d;
  center.y = ay + (ux * v - vx * u) / d;
}

/** The edges of a playback with a triangle on one side only, or none. `update` makes them those of the time
 * shown. */
class HullEdges {
  constructor(playback) {
    this.playback = playback;
    // Flips keep these edges: the number of other rows before each row tells whether they are the same.
    this.changes = new Uint32Array(playback.recording.rows + 1);
    this.count(0);
    this.shown = -1;  // how many changes there were when the list was made
    this.edges = [];
  }

  /** Counts from the row on, to which the recording may have grown. */
  count(first) {
    const {rows, rowKind, kinds} = this.playback.recording;
    const changes = this.changes = withRoom(this.changes, rows + 1);
    for (let row = first; row < rows; ++row) {
      changes[row + 1] = changes[row] + (kinds[rowKind[row]] === 'flip' ? 0 : 1);
    }
  }

  update() {
    const {playback, changes} = this;
    const {live, liveCount} = playback, {left, right} = playback.triangles;
    if (this.shown === changes[playback.event]) return;
    this.shown = changes[playback.event];
    this.edges.length = 0;
    for (let i = 0; i < liveCount; ++i) {
      const edge = live[i];
      if (left[edge] < 0 || right[edge] < 0) this.edges.push(edge);
    }
  }
}
