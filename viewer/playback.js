// SPDX-License-Identifier: GPL-3.0-or-later
//
// Playing a recording: the edges, triangles and trajectories after a given number of events,
// forward and backward, and the positions of the points at a time.
'use strict';

const VISIBLE = 0, HIDDEN = 1, COINCIDENT = 2;

/**
 * A recording at a time. The first `event` rows are executed: those whose exact time is at or
 * before `time`; after a step, those up to the end of its instant. `live` holds the `liveCount`
 * present edges, in no order; `where[edge]` is the index of an edge in `live`, or -1;
 * `triangles` has the triangles at these edges;
 * `current[point]` is the motion in force, or -1 before the point is inserted; `shown[point]` is the
 * point that has its vertex: itself, or one that coincides with it for a while and hides it;
 * `coincident[point]` is the number of points that this point hides so.
 */
class Playback {
  constructor(recording) {
    this.recording = recording;
    this.time = recording.from;
    this.event = 0;
    this.live = new Uint32Array(recording.edgeA.length);
    this.where = new Int32Array(recording.edgeA.length).fill(-1);
    this.liveCount = 0;
    for (let edge = 0; edge < recording.initialEdges; ++edge) this.addEdge(edge);
    this.triangles = new Triangles(recording.edgeA.length, recording.periodic !== null);
    for (let i = 0; i < recording.rowTriangle[0]; ++i) this.triangles.set(recording, i, true);
    this.current = new Int32Array(recording.points).fill(-1);
    for (let i = 0; i < recording.starting; ++i) this.current[recording.motionPoint[i]] = i;
    this.shown = Uint32Array.from({length: recording.points}, (_, point) => point);
    this.coincident = new Uint32Array(recording.points);
    this.nextCoincidence = 0;
    this.executeCoincidences(-1);
  }

  /** Makes room after the recording has grown. */
  grow() {
    const {triangles, recording: {edgeA}} = this;
    this.live = withRoom(this.live, edgeA.length);
    this.where = withRoom(this.where, edgeA.length, -1);
    triangles.left = withRoom(triangles.left, edgeA.length, -1);
    triangles.right = withRoom(triangles.right, edgeA.length, -1);
  }

  /** A copy that can be played independently. */
  clone() {
    const copy = Object.create(Playback.prototype);
    Object.assign(copy, this);
    copy.live = this.live.slice();
    copy.where = this.where.slice();
    copy.triangles = this.triangles.clone();
    copy.current = this.current.slice();
    copy.shown = this.shown.slice();
    copy.coincident = this.coincident.slice();
    return copy;
  }

  addEdge(edge) {
    this.where[edge] = this.liveCount;
    this.live[this.liveCount++] = edge;
  }

  removeEdge(edge) {
    const last = this.live[--this.liveCount];
    this.live[this.where[edge]] = last;
    this.where[last] = this.where[edge];
    this.where[edge] = -1;
  }

  show(point, shown) {
    const before = this.shown[point];
    if (before !== point) --this.coincident[before];
    if (shown !== point) ++this.coincident[shown];
    this.shown[point] = shown;
  }

  /** The other points that coincide with the point for a while. */
  coincidentWith(point) {
    const {shown, recording} = this;
    if (recording.coincidences === 0) return [];
    return Array.from(shown.keys()).filter((other) => other !== point && shown[other] === shown[point]);
  }

  executeCoincidences(row) {
    const {coincidences, coincidenceRow, coincidencePoint, coincidenceShown} = this.recording;
    for (let i = this.nextCoincidence; i < coincidences && coincidenceRow[i] === row; ++i) {
      this.show(coincidencePoint[i], coincidenceShown[i]);
      this.nextCoincidence = i + 1;
    }
  }

  undoCoincidences(row) {
    const {coincidenceRow, coincidencePoint, coincidenceBefore} = this.recording;
    for (let i = this.nextCoincidence - 1; i >= 0 && coincidenceRow[i] === row; --i) {
      this.show(coincidencePoint[i], coincidenceBefore[i]);
      this.nextCoincidence = i;
    }
  }

  /** Executes the row `event`. */
  execute() {
    const {recording} = this;
    const {rowRemoved, rowAdded, rowTriangle, triangleAdded, rowMotion, motionPoint} = recording;
    const row = this.event++;
    if (rowRemoved[row] >= 0) this.removeEdge(rowRemoved[row]);
    if (rowAdded[row] >= 0) this.addEdge(rowAdded[row]);
    for (let i = rowTriangle[row]; i < rowTriangle[row + 1]; ++i) {
      this.triangles.set(recording, i, triangleAdded[i] === 1);
    }
    for (let i = rowMotion[row]; i < rowMotion[row + 1]; ++i) this.current[motionPoint[i]] = i;
    this.executeCoincidences(row);
  }

  /** Undoes the row before `event`. */
  undo() {
    const {recording} = this;
    const {rowRemoved, rowAdded, rowTriangle, triangleAdded, rowMotion, motionPoint,
           motionPrevious} = recording;
    const row = --this.event;
    if (rowAdded[row] >= 0) this.removeEdge(rowAdded[row]);
    if (rowRemoved[row] >= 0) this.addEdge(rowRemoved[row]);
    for (let i = rowTriangle[row + 1] - 1; i >= rowTriangle[row]; --i) {
      this.triangles.set(recording, i, triangleAdded[i] === 0);
    }
    for (let i = rowMotion[row + 1] - 1; i >= rowMotion[row]; --i) {
      this.current[motionPoint[i]] = motionPrevious[i];
    }
    this.undoCoincidences(row);
  }

  /** Executes or undoes rows until `event` of them are executed. */
  goToEvent(event) {
    while (this.event < event) this.execute();
    while (this.event > event) this.undo();
  }

  /** Goes to the time; before the start or after the end, to the start or the end. */
  goTo(time) {
    const {from, until} = this.recording;
    this.time = Math.min(Math.max(time, from), until);
    this.goToEvent(rowsAtOrBefore(this.recording, this.time));
  }

  /** Goes to just after the instant of a row. */
  goToRow(row) {
    this.time = shownTime(this.recording, row);
    this.goToEvent(this.recording.instantEnd[row]);
  }

  /** Goes to just after the next instant. Returns whether there is one. */
  stepForward() {
    if (this.event === this.recording.rows) return false;
    this.goToRow(this.event);
    return true;
  }

  /**
   * Goes back to just after the last instant before the time shown, or to the start if there is
   * none. Returns whether anything changed.
   */
  stepBackward() {
    const {from, instantBegin} = this.recording;
    if (this.event === 0) {
      const moved = this.time > from;
      this.time = from;
      return moved;
    }
    if (this.time > shownTime(this.recording, this.event - 1)) {
      this.goToRow(this.event - 1);
      return true;
    }
    const begin = instantBegin[this.event - 1];
    this.goToEvent(begin);
    this.time = begin === 0 ? from : shownTime(this.recording, begin - 1);
    return true;
  }
}

/** The time at which the state just after a row is shown: the least binary64 number that is not
 * before the exact time of the row. */
function shownTime(recording, row) {
  return Math.min(recording.rowHigh[row], recording.until);
}

/** The last time up to the one shown at which the triangulation is known to be that of the points: the time
 * shown; but between two instants of a thinned recording, the earlier one. */
function knownTime({recording, event, time}) {
  if (recording.thinned === null || event === recording.rows) return time;
  return event === 0 ? recording.from : shownTime(recording, event - 1);
}

/** The number of rows whose exact time is at or before the binary64 number `time`. */
function rowsAtOrBefore(recording, time) {
  let low = 0, high = recording.rows;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (recording.rowHigh[middle] <= time) low = middle + 1;
    else high = middle;
  }
  return low;
}

// Positions and velocities of a motion by its number, in binary64. The error is some units in the
// last place of the largest term.

function motionX(recording, motion, time) {
  return motionCoordinate(recording, motion, time, 0);
}

function motionY(recording, motion, time) {
  return motionCoordinate(recording, motion, time, 1);
}

function motionCoordinate({motionData: data, stride, degree}, motion, time, coordinate) {
  const i = stride * motion + 1 + coordinate;
  const s = time - data[stride * motion];
  if (degree === 1) return data[i] + data[i + 2] * s;
  const jerk = degree === 3 ? data[i + 6] : 0;
  return data[i] + s * (data[i + 2] + s * (data[i + 4] / 2 + s * jerk / 6));
}

function motionVelocity({motionData: data, stride, degree}, motion, time, coordinate) {
  const i = stride * motion + 3 + coordinate;
  if (degree === 1) return data[i];
  const s = time - data[stride * motion];
  return data[i] + s * (data[i + 2] + (degree === 3 ? s * data[i + 4] / 2 : 0));
}

function motionAcceleration({motionData: data, stride, degree}, motion, time, coordinate) {
  if (degree === 1) return 0;
  const i = stride * motion + 5 + coordinate;
  return data[i] + (degree === 3 ? data[i + 2] * (time - data[stride * motion]) : 0);
}

/** The radius of the disc about the point, in binary64. */
function motionRadius({motionData: data, stride, motionSizes: sizes, radius}, motion, time) {
  if (sizes === null) return radius;
  return sizes[3 * motion] + sizes[3 * motion + 1] * (time - data[stride * motion]);
}

/** The weight of the point in the triangulation, in binary64. */
function motionWeight(recording, motion, time) {
  if (recording.motionSizes === null) return 0;
  const radius = motionRadius(recording, motion, time);
  return radius * radius + recording.motionSizes[3 * motion + 2];
}

/** Whether the motion is one that moves at all. */
function isMoving({motionData: data, stride}, motion) {
  for (let i = stride * motion + 3; i < stride * (motion + 1); ++i) {
    if (data[i] !== 0) return true;
  }
  return false;
}

/** Writes the positions of all points at a time to xs and ys; NaN for points that are not there. */
function placePoints(playback, time, xs, ys) {
  const {recording, current} = playback;
  const {motionThere, motionData: data, stride, degree} = recording;
  for (let point = 0; point < recording.points; ++point) {
    const motion = current[point];
    if (motion >= 0 && motionThere[motion] === 1 && degree === 1) {
      // As motionX and motionY, in the case that has to be fast.
      const i = stride * motion, s = time - data[i];
      xs[point] = data[i + 1] + data[i + 3] * s;
      ys[point] = data[i + 2] + data[i + 4] * s;
    } else if (motion >= 0 && motionThere[motion] === 1) {
      xs[point] = motionX(recording, motion, time);
      ys[point] = motionY(recording, motion, time);
    } else {
      xs[point] = ys[point] = NaN;
    }
  }
  if (recording.thinned !== null) placeTurningPoints(playback, time, xs, ys);
}

/** Writes the radii and weights of all points at a time to rs and ws; 0 for points that are not
 * there. */
function sizePoints(playback, time, rs, ws) {
  const {recording, current} = playback;
  if (!hasDiscs(recording)) return;  // all are 0, as they were
  for (let point = 0; point < recording.points; ++point) {
    const motion = current[point];
    const isThere = motion >= 0 && recording.motionThere[motion] === 1;
    rs[point] = isThere ? Math.max(motionRadius(recording, motion, time), 0) : 0;
    ws[point] = isThere ? motionWeight(recording, motion, time) : 0;
  }
}

/** Writes to `hidden` which points are there without being vertices, since others hide them: COINCIDENT
 * those that coincide with the point that is shown, and with weights HIDDEN the others without an edge.
 * Where there is no edge at all, one point is the only vertex: that of least power anywhere. */
function findHidden(playback, xs, ys, ws, hidden) {
  const {recording, live, liveCount, shown} = playback;
  const hasWeights = recording.motionSizes !== null;
  if (!hasWeights && recording.coincidences === 0) return;  // none is, as before
  for (let point = 0; point < recording.points; ++point) {
    hidden[point] = Number.isNaN(xs[point]) ? VISIBLE : shown[point] !== point ? COINCIDENT :
      hasWeights ? HIDDEN : VISIBLE;
  }
  if (!hasWeights) return;
  for (let i = 0; i < liveCount; ++i) {
    hidden[recording.edgeA[live[i]]] = hidden[recording.edgeB[live[i]]] = VISIBLE;
  }
  if (liveCount > 0) return;
  let least = Infinity, vertex = -1;
  for (let point = 0; point < recording.points; ++point) {
    const power = xs[point] * xs[point] + ys[point] * ys[point] - ws[point];
    if (!(power < least) || hidden[point] === COINCIDENT) continue;
    least = power;
    vertex = point;
  }
  if (vertex >= 0) hidden[vertex] = VISIBLE;
}

/**
 * Where events are left out, it is unknown where a point turned that has another trajectory from
 * the next instant on. It is shown on the straight line between its positions at the two instants.
 */
function placeTurningPoints(playback, time, xs, ys) {
  const {recording, event} = playback;
  if (event === recording.rows) return;
  const {motionPoint, motionThere, rowMotion, rowTime, instantEnd} = recording;
  const before = event === 0 ? recording.from : rowTime[event - 1], after = rowTime[event];
  const share = (time - before) / (after - before);
  for (let i = rowMotion[event]; i < rowMotion[instantEnd[event]]; ++i) {
    const point = motionPoint[i], previous = playback.current[point];
    if (previous < 0 || !motionThere[previous] || !motionThere[i] || !(share <= 1)) continue;
    const between = (a, b) => a + (b - a) * share;
    xs[point] = between(motionX(recording, previous, before), motionX(recording, i, after));
    ys[point] = between(motionY(recording, previous, before), motionY(recording, i, after));
  }
}
