// SPDX-License-Identifier: GPL-3.0-or-later
//
// A recording that grows while it is shown, of a run that goes on (live/). Its parts have the format of a
// recording, without edges, triangles and trajectories of the start; indices of events count from the
// first event of the part.
'use strict';

const ROW_ARRAYS = ['rowKind', 'rowNumber', 'rowTime', 'rowLow', 'rowHigh', 'rowRemoved', 'rowAdded', 'rowA', 'rowB',
                    'instantBegin', 'instantEnd'];

/** The typed array, or a copy with room for more numbers than `length`; new ones are `fill`. */
function withRoom(array, length, fill = 0) {
  if (length <= array.length) return array;
  const result = new array.constructor(Math.max(2 * array.length, length + 1024)).fill(fill);
  result.set(array);
  return result;
}

/** What a recording needs in order to grow. */
class Growth {
  constructor(recording, edges, state) {
    this.recording = recording;
    this.edges = edges;  // EdgeNumbers
    this.state = state;  // of the triangles, at the end of the recording
    this.lastMotion = new Int32Array(recording.points).fill(-1);
    for (let i = 0; i < recording.motions; ++i) this.lastMotion[recording.motionPoint[i]] = i;
    this.shown = new Map();
    for (let i = 0; i < recording.coincidences; ++i) {
      this.shown.set(recording.coincidencePoint[i], recording.coincidenceShown[i]);
    }
  }

  /** Appends the part of the JSON text, up to its end. */
  append(text) {
    const json = JSON.parse(text), {recording} = this;
    recording.until = json.until;
    if (json.events.count === 0) return;
    const ids = recording.points <= 65536 ? 'Uint16' : 'Uint32', first = recording.rows;
    recording.rows += json.events.count;
    this.appendRows(json.events, ids, first);
    this.appendMotions(json.motions, ids, first);
    this.appendCoincidences(json.coincidences, ids, first);
    findInstantsFrom(recording, first);
    this.appendTriangles(json.triangles, ids, first);
  }

  appendRows(json, ids, first) {
    const {recording, edges} = this;
    for (const name of ROW_ARRAYS) recording[name] = withRoom(recording[name], recording.rows);
    readRows(recording, {
      kind: decodeNumbers(json.kind, 'Uint8', 'kinds'), fields: decodeNumbers(json.fields, 'Uint8', 'fields'),
      time: decodeNumbers(json.time, 'Float64', 'times'), id: decodeNumbers(json.ids, ids, 'ids'), number: json.first,
    }, edges, first);
  }

  appendTriangles(json, ids, first) {
    const {recording, edges, state} = this;
    const groups = {
      count: json.count, row: decodeNumbers(json.event, 'Uint32', 'events of triangles'),
      removed: decodeNumbers(json.removed, 'Uint32', 'removed triangles'),
      added: decodeNumbers(json.added, 'Uint32', 'added triangles'), id: decodeNumbers(json.ids, ids, 'corners'),
    };
    // A side may be of a triangle alone, if it comes and goes within an event.
    for (let i = 0; i < groups.id.length; i += 3) {
      for (let k = 0; k < 3; ++k) edges.number(groups.id[i + k], groups.id[i + (k + 1) % 3], 'a part');
    }
    recording.edgeA = edges.a.values;
    recording.edgeB = edges.b.values;
    state.triangles.left = withRoom(state.triangles.left, recording.edgeA.length, -1);
    state.triangles.right = withRoom(state.triangles.right, recording.edgeA.length, -1);
    recording.rowTriangle = withRoom(recording.rowTriangle, recording.rows + 1);
    changeTriangles(recording, state, groups, first);
    recording.triangleCorners = state.changes.corners.values;
    recording.triangleSides = state.changes.sides.values;
    recording.triangleAdded = state.changes.isAdded.values;
  }

  appendMotions(json, ids, first) {
    const {recording, lastMotion} = this;
    const {count, degree} = json;
    const row = decodeNumbers(json.event, 'Uint32', 'events'), point = decodeNumbers(json.point, ids, 'points');
    const there = decodeNumbers(json.there, 'Uint8', 'points'), data = decodeNumbers(json.data, 'Float64', 'places');
    const sizes = json.sizes === undefined ? null : decodeNumbers(json.sizes, 'Float64', 'sizes');
    if (degree > recording.degree) this.widen(degree);
    const begin = recording.motions, end = begin + count, stride = 3 + 2 * degree;
    recording.motionPoint = withRoom(recording.motionPoint, end);
    recording.motionRow = withRoom(recording.motionRow, end);
    recording.motionThere = withRoom(recording.motionThere, end);
    recording.motionPrevious = withRoom(recording.motionPrevious, end);
    recording.motionNext = withRoom(recording.motionNext, end);
    recording.motionData = withRoom(recording.motionData, recording.stride * end);
    if (recording.motionSizes !== null) recording.motionSizes = withRoom(recording.motionSizes, 3 * end);
    recording.rowMotion = withRoom(recording.rowMotion, recording.rows + 1);
    let next = first;  // the first row whose first motion is not known
    for (let i = 0; i < count; ++i) {
      const motion = begin + i;
      for (; next <= first + row[i]; ++next) recording.rowMotion[next] = motion;
      recording.motionRow[motion] = first + row[i];
      recording.motionPoint[motion] = point[i];
      recording.motionThere[motion] = there[i];
      recording.motionNext[motion] = -1;
      recording.motionPrevious[motion] = lastMotion[point[i]];
      if (lastMotion[point[i]] >= 0) recording.motionNext[lastMotion[point[i]]] = motion;
      lastMotion[point[i]] = motion;
      recording.motionData.fill(0, recording.stride * motion, recording.stride * (motion + 1));
      recording.motionData.set(data.subarray(stride * i, stride * (i + 1)), recording.stride * motion);
      if (sizes !== null) recording.motionSizes?.set(sizes.subarray(3 * i, 3 * (i + 1)), 3 * motion);
    }
    recording.rowMotion.fill(end, next, recording.rows + 1);
    recording.motions = end;
  }

  /** Makes room for derivatives of a higher degree. */
  widen(degree) {
    const {recording} = this;
    const {stride, motions, motionData} = recording;
    recording.degree = degree;
    recording.stride = 3 + 2 * degree;
    recording.motionData = new Float64Array(recording.stride * motions);
    for (let i = 0; i < motions; ++i) {
      recording.motionData.set(motionData.subarray(stride * i, stride * (i + 1)), recording.stride * i);
    }
  }

  appendCoincidences(json, ids, first) {
    if (json === undefined) return;
    const {recording, shown} = this;
    const row = decodeNumbers(json.event, 'Uint32', 'events'), point = decodeNumbers(json.point, ids, 'points');
    const now = decodeNumbers(json.shown, ids, 'points'), end = recording.coincidences + json.count;
    for (const name of ['coincidenceRow', 'coincidencePoint', 'coincidenceShown', 'coincidenceBefore']) {
      recording[name] = withRoom(recording[name], end);
    }
    for (let i = 0, at = recording.coincidences; i < json.count; ++i, ++at) {
      recording.coincidenceRow[at] = first + row[i];
      recording.coincidencePoint[at] = point[i];
      recording.coincidenceShown[at] = now[i];
      recording.coincidenceBefore[at] = shown.get(point[i]) ?? point[i];
      shown.set(point[i], now[i]);
    }
    recording.coincidences = end;
  }
}
