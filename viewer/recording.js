// SPDX-License-Identifier: GPL-3.0-or-later
//
// The recording: reads the JSON object in the page into flat arrays, and checks it. Its members are
// described in include/kinetri/io/viewer_page.h. Every pair of points that is ever an edge gets a
// number here, so that executing an event needs no look-up.
'use strict';

const FIELD_REMOVED = 1, FIELD_ADDED = 2, FIELD_POINT_A = 4, FIELD_POINT_B = 8;
const FIELD_ABOVE = 16, FIELD_BELOW = 32;

/**
 * The recording of the JSON text. Throws RecordingError where it is damaged. A recording that `grows` also has
 * what growth.js needs; its arrays may be longer than it is.
 *
 * Arrays by row:
 *   rowKind                    index in `kinds` and `kindColors`
 *   rowNumber                  of the event in the run; -1 in a thinned recording, and of a row that
 *                              changes triangles only
 *   rowTime                    the binary64 number nearest to the exact time
 *   rowLow, rowHigh            the numbers around the exact time; equal if it is one number
 *   rowRemoved, rowAdded       edges; -1 for none
 *   rowA, rowB                 points; -1 for none
 *   rowMotion, rowTriangle     the first motion that begins with this row or a later one, and the
 *                              first triangle that it changes; one entry more than there are rows
 *   instantBegin, instantEnd   the rows of the same time
 *
 * Arrays by motion: motionPoint; motionRow (-1: from the start); motionThere; motionPrevious (the
 * previous motion of the point, or -1); motionNext; motionData, `stride` numbers each; motionSizes,
 * three each: radius at the epoch, its growth, and the weight beside it; null where points have none.
 *
 * Arrays by coincidence, a change of the point that has the vertex of a point (that of another point,
 * which coincides with it for a while and hides it, or its own): coincidenceRow (-1: from the start);
 * coincidencePoint; coincidenceShown, the point that has the vertex, and coincidenceBefore, the one
 * before.
 *
 * Arrays by edge: edgeA < edgeB. The first `initialEdges` are there at the start. In a periodic box
 * (`periodic` is not null) edgeX and edgeY are the offset of edgeB against edgeA, and edgeA may be edgeB;
 * else they are null.
 *
 * Arrays by triangle that is added (triangleAdded is 1) or removed (0), those of the start first:
 * three triangleCorners, counterclockwise; three triangleSides, the edges from each corner to the
 * next. In a periodic box there are also triangleForward, for each side 1 if it leads from edgeA to edgeB,
 * else 0; and triangleOffsets, two numbers a corner, against corner 0; else these are null.
 */
function readRecording(text, grows = false) {
  let json;
  try {
    json = JSON.parse(text);
  } catch (error) {
    throw new RecordingError(`it is not JSON (${error.message})`);
  }
  demand(json !== null && typeof json === 'object', 'it is not a JSON object');
  const format = json.periodic === undefined ? 2 : 3;
  demand(json.format === format, `its format is ${json.format}, but this page plays format ${format}`);
  const {from, until, points} = json;
  demand(Number.isFinite(from) && Number.isFinite(until) && from <= until,
         'its times from and until are not two numbers in order');
  demand(Number.isInteger(points) && points >= 0, 'its number of points is not a whole number');
  const recording = {
    from, until, points,
    program: String(json.program ?? ''),
    title: String(json.title ?? ''),
    view: String(json.view ?? ''),
    names: json.names ?? null,
    box: json.box ?? null,
    periodic: readPeriodicBox(json.periodic),
    radius: json.radius ?? 0,
    thinned: json.thinned ?? null,
    wave: json.wave ?? null,
    encounters: null,
  };
  demand(recording.names === null ||
         (Array.isArray(json.names) && json.names.length === points), 'not every point has a name');
  demand(recording.box === null || (Array.isArray(json.box) && json.box.length === 4 &&
         json.box.every(Number.isFinite)), 'its box is not four numbers');
  demand(Number.isFinite(recording.radius) && recording.radius >= 0, 'its radius is not a number');
  demand(recording.thinned === null || Number.isInteger(recording.thinned.events),
         'it does not say how many events the run had');
  demand(recording.wave === null || (Number.isFinite(recording.wave.height) &&
         recording.wave.width > 0), 'its wave has no height or no width');

  const ids = points <= 65536 ? 'Uint16' : 'Uint32';
  recording.encounters = readEncounters(recording, json.encounters, ids);
  const edges = new EdgeNumbers(points, recording.periodic !== null);
  const triangles = readTriangles(recording, json.triangles, ids, edges);
  const initial = decodeNumbers(json.initial_edges, ids, 'the list of edges at the start');
  demand(initial.length % 2 === 0, 'the list of edges at the start ends within an edge');
  const sides = edges.count;
  for (let i = 0; i < initial.length; i += 2) {
    edges.number(initial[i], initial[i + 1], 'the list of edges at the start');
  }
  recording.initialEdges = edges.count;
  demand(2 * (edges.count - sides) === initial.length,
         'an edge is twice in the list of those at the start');
  readEvents(recording, json.events, ids, edges);
  readMotions(recording, json.motions, ids);
  readCoincidences(recording, json.coincidences, ids);
  recording.edgeA = edges.a.finish();
  recording.edgeB = edges.b.finish();
  recording.edgeX = edges.x?.finish() ?? null;
  recording.edgeY = edges.y?.finish() ?? null;
  findInstants(recording);
  checkEdges(recording);
  const state = findTriangles(recording, triangles, edges);
  if (grows) recording.growth = new Growth(recording, edges, state);
  return recording;
}

/** The triangles at the start, and the changes that are in the recording: those of `count` rows,
 * `removed` and `added` triangles of each, whose corners follow each other in `id`. */
function readTriangles(recording, json, ids, edges) {
  demand(json !== null && typeof json === 'object', 'the triangles are not there');
  const initial = decodeNumbers(json.initial, ids, 'the list of triangles at the start');
  const row = decodeNumbers(json.event, 'Uint32', 'the list of events that change triangles');
  const removed = decodeNumbers(json.removed, 'Uint32', 'the list of numbers of removed triangles');
  const added = decodeNumbers(json.added, 'Uint32', 'the list of numbers of added triangles');
  const id = decodeNumbers(json.ids, ids, 'the list of triangles of events');
  demand(initial.length % 3 === 0, 'the list of triangles at the start ends within a triangle');
  const {count} = json;
  demand(row.length === count && removed.length === count && added.length === count,
         `it has ${count} events that change triangles, but ${row.length} indices and ` +
         `${removed.length} and ${added.length} numbers of triangles of them`);
  let total = 0;
  for (let i = 0; i < count; ++i) {
    demand(i === 0 || row[i - 1] < row[i], 'the events that change triangles are not in order');
    total += removed[i] + added[i];
  }
  demand(3 * total === id.length, `it has ${id.length} corners of ${total} triangles of events`);
  const initialOffsets = readOffsets(recording, json.initial_offsets, 'triangles at the start', initial.length / 3 * 2);
  const offsets = readOffsets(recording, json.offsets, 'triangles of events', 2 * total);
  for (let i = 0; i < initial.length; i += 3) {
    for (let k = 0; k < 3; ++k) {
      const [x, y] = sideOffset(initialOffsets, i / 3, k);
      edges.number(initial[i + k], initial[i + (k + 1) % 3], 'the list of triangles at the start', x, y);
    }
  }
  return {initial, initialOffsets, count, row, removed, added, id, offsets};
}

/** The offsets in a list, two numbers each; null in the plane. */
function readOffsets({periodic}, text, what, count) {
  if (periodic === null) return null;
  const offsets = decodeNumbers(text, 'Int32', `the list of offsets of ${what}`);
  demand(offsets.length === 2 * count, `it has ${offsets.length / 2} offsets of ${what}, not ${count}`);
  return offsets;
}

/** The offset of corner k against corner 0 of the i-th triangle, of which `offsets` has those of corners 1
 * and 2; zero in the plane. */
function cornerOffset(offsets, i, k) {
  return offsets === null || k === 0 ? NO_OFFSET : [offsets[4 * i + 2 * k - 2], offsets[4 * i + 2 * k - 1]];
}

const NO_OFFSET = [0, 0];

/** The offset of corner k + 1 against corner k. */
function sideOffset(offsets, i, k) {
  if (offsets === null) return NO_OFFSET;
  const p = cornerOffset(offsets, i, k), q = cornerOffset(offsets, i, (k + 1) % 3);
  return [q[0] - p[0], q[1] - p[1]];
}

/** Lists of the triangles that rows add and remove. */
class TriangleChanges {
  constructor(edges) {
    this.edges = edges;
    this.corners = new Numbers(Uint32Array);
    this.sides = new Numbers(Uint32Array);
    this.isAdded = new Numbers(Uint8Array);
    this.forward = edges.x === null ? null : new Numbers(Uint8Array);
    this.offsets = edges.x === null ? null : new Numbers(Int32Array);
  }

  /** In a periodic box, of three images [id, x, y]; the first one need not have the offset zero. */
  addImages(images, isAdded, what) {
    const [, x, y] = images[0];
    images.forEach((p, k) => {
      const q = images[(k + 1) % 3];
      this.corners.push(p[0]);
      this.sides.push(this.edges.number(p[0], q[0], what, q[1] - p[1], q[2] - p[2]));
      this.forward.push(isForward(p[0], q[0], q[1] - p[1], q[2] - p[2]) ? 1 : 0);
      this.offsets.push(p[1] - x);
      this.offsets.push(p[2] - y);
    });
    this.isAdded.push(isAdded ? 1 : 0);
  }

  /** The i-th of the triangles with these corners and offsets. */
  addListed(id, offsets, i, isAdded, what) {
    if (this.forward === null) this.add(id[3 * i], id[3 * i + 1], id[3 * i + 2], isAdded, what);
    else this.addImages([0, 1, 2].map((k) => [id[3 * i + k], ...cornerOffset(offsets, i, k)]), isAdded, what);
  }

  add(a, b, c, isAdded, what) {
    this.addSide(a, b, what);
    this.addSide(b, c, what);
    this.addSide(c, a, what);
    this.isAdded.push(isAdded ? 1 : 0);
  }

  addSide(p, q, what) {
    this.corners.push(p);
    this.sides.push(this.edges.number(p, q, what));
  }
}

/** All triangles that rows change: those of flips follow from the edges. Checks that each removed
 * triangle is there, and that no added one lies on the same side of an edge as another one. */
function findTriangles(recording, {initial, initialOffsets, ...groups}, edges) {
  const isPeriodic = recording.periodic !== null;
  const state = {edges, triangles: new Triangles(edges.count, isPeriodic), changes: new TriangleChanges(edges)};
  for (let i = 0; i < initial.length / 3; ++i) {
    state.changes.addListed(initial, initialOffsets, i, true, 'the start');
  }
  followTriangles(recording, state, 0, 'the start');
  recording.rowTriangle = new Uint32Array(recording.rows + 1);
  changeTriangles(recording, state, groups, 0);
  recording.triangleCorners = state.changes.corners.finish();
  recording.triangleSides = state.changes.sides.finish();
  recording.triangleAdded = state.changes.isAdded.finish();
  recording.triangleForward = state.changes.forward?.finish() ?? null;
  recording.triangleOffsets = state.changes.offsets?.finish() ?? null;
  return state;
}

/** Executes the changes of triangles from the first one on. */
function followTriangles({edgeA}, {edges, triangles, changes}, first, what) {
  demand(edges.count <= edgeA.length, `${what} has a triangle with a side that is never an edge`);
  const present = {edgeA, triangleCorners: changes.corners.values, triangleSides: changes.sides.values,
                   triangleForward: changes.forward?.values ?? null,
                   triangleOffsets: changes.offsets?.values ?? null};
  for (let i = first; i < changes.isAdded.length; ++i) {
    const isAdded = changes.isAdded.values[i] === 1;
    if (triangles.sidesInUse(present, i) !== (isAdded ? 0 : 3)) {
      const name = present.triangleCorners.slice(3 * i, 3 * i + 3).join('\u2013');
      demand(false, isAdded ? `${what} adds the triangle ${name}, which overlaps another one` :
             `${what} removes the triangle ${name}, which is not there then`);
    }
    triangles.set(present, i, isAdded);
  }
}

/** Makes and executes the changes of triangles of the rows from the first one on. */
function changeTriangles(recording, state, {count, row, removed, added, id, offsets = null}, firstRow) {
  const {rows, rowKind, kinds, rowTriangle} = recording;
  const {triangles, changes} = state;
  let at = 0, group = 0;
  for (let r = firstRow; r < rows; ++r) {
    const first = changes.isAdded.length, what = `event ${r}`;
    rowTriangle[r] = first;
    if (kinds[rowKind[r]] === 'flip') addFlip(recording, r, triangles, changes);
    if (group < count && firstRow + row[group] === r) {
      const last = removed[group] + added[group];
      for (let i = 0; i < last; ++i, ++at) changes.addListed(id, offsets, at, i >= removed[group], what);
      ++group;
    }
    followTriangles(recording, state, first, what);
  }
  demand(group === count, `triangles change with event ${firstRow + row[group]}, which is not there`);
  rowTriangle[rows] = changes.isAdded.length;
}

/** The triangles of a flip: the two at the removed edge, which go, and the two at the added one. */
function addFlip(recording, row, triangles, changes) {
  const {rowRemoved, rowAdded, edgeA, edgeB} = recording, {left, right} = triangles;
  const removed = rowRemoved[row], added = rowAdded[row], what = `event ${row}`;
  demand(removed >= 0 && added >= 0, `${what} is a flip without two edges`);
  const a = edgeA[removed], b = edgeB[removed], c = left[removed], d = right[removed];
  if (recording.periodic !== null) {
    addFlipOfImages(recording, removed, added, triangles, changes, what);
    return;
  }
  demand(Math.min(c, d) === edgeA[added] && Math.max(c, d) === edgeB[added],
         `${what} adds an edge that is not the other diagonal of the triangles at the removed one`);
  changes.add(a, b, c, false, what);
  changes.add(b, a, d, false, what);
  changes.add(a, d, c, true, what);
  changes.add(d, b, c, true, what);
}

/** The same in a periodic box. */
function addFlipOfImages({edgeA, edgeB, edgeX, edgeY}, removed, added, triangles, changes, what) {
  const a = [edgeA[removed], 0, 0], b = [edgeB[removed], edgeX[removed], edgeY[removed]];
  const c = triangles.imageAt(removed, true), d = triangles.imageAt(removed, false);
  demand(c !== null && d !== null && changes.edges.number(c[0], d[0], what, d[1] - c[1], d[2] - c[2]) === added,
         `${what} adds an edge that is not the other diagonal of the triangles at the removed one`);
  changes.addImages([a, b, c], false, what);
  changes.addImages([b, a, d], false, what);
  changes.addImages([a, d, c], true, what);
  changes.addImages([d, b, c], true, what);
}

function readEvents(recording, json, ids, edges) {
  demand(json !== null && typeof json === 'object', 'the events are not there');
  const count = json.count;
  const kind = decodeNumbers(json.kind, 'Uint8', 'the list of kinds of event');
  const fields = decodeNumbers(json.fields, 'Uint8', 'the list of fields of events');
  const time = decodeNumbers(json.time, 'Float64', 'the list of times of events');
  const id = decodeNumbers(json.ids, ids, 'the list of ids in events');
  const offsets = recording.periodic === null ? null :
    decodeNumbers(json.offsets, 'Int32', 'the list of offsets of edges');
  demand(kind.length === count && fields.length === count && time.length === count,
         `it has ${count} events, but ${kind.length} kinds, ${fields.length} fields and ` +
         `${time.length} times of them`);
  demand(Array.isArray(json.kinds), 'the names of the kinds of event are not there');
  demand(Array.isArray(json.colors) && json.colors.length === json.kinds.length &&
         json.colors.every((color) => /^#[0-9a-f]{6}$/.test(color)), 'the kinds of event have no colors');
  Object.assign(recording, {
    rows: count, kinds: json.kinds.map(String), kindColors: json.colors, rowKind: kind, rowTime: time,
    rowNumber: new Float64Array(count), rowLow: new Float64Array(count), rowHigh: new Float64Array(count),
    rowRemoved: new Int32Array(count), rowAdded: new Int32Array(count),
    rowA: new Int32Array(count), rowB: new Int32Array(count),
  });
  readRows(recording, {kind, fields, time, id, offsets, number: json.first ?? 0}, edges, 0);
}

/** Reads the rows from the first one on. */
function readRows(recording, {kind, fields, time, id, offsets = null, number}, edges, firstRow) {
  let at = 0, offset = 0;
  const take = (row) => {
    demand(at < id.length, `the ids of event ${row} are not there`);
    return id[at++];
  };
  const takeEdge = (row) => {
    const a = take(row), b = take(row);
    if (offsets === null) return edges.number(a, b, `event ${row}`);
    demand(offset + 2 <= offsets.length, `an offset of event ${row} is not there`);
    return edges.number(a, b, `event ${row}`, offsets[offset++], offsets[offset++]);
  };
  const takePoint = (row) => {
    const point = take(row);
    demand(point < recording.points, `event ${row} names the point ${point}, but the ids end with ` +
           `${recording.points - 1}`);
    return point;
  };
  for (let i = 0; i < kind.length; ++i) {
    const row = firstRow + i, field = fields[i];
    demand(kind[i] < recording.kinds.length, `event ${row} is of a kind without a name`);
    demand(Number.isFinite(time[i]), `the time of event ${row} is not a number`);
    recording.rowKind[row] = kind[i];
    recording.rowTime[row] = time[i];
    recording.rowNumber[row] = recording.rowRemoved[row] = recording.rowAdded[row] = -1;
    recording.rowA[row] = recording.rowB[row] = -1;
    const isEvent = field & (FIELD_REMOVED | FIELD_ADDED | FIELD_POINT_A | FIELD_POINT_B);
    if (isEvent && recording.thinned === null) recording.rowNumber[row] = number++;
    if (field & FIELD_REMOVED) recording.rowRemoved[row] = takeEdge(row);
    if (field & FIELD_ADDED) recording.rowAdded[row] = takeEdge(row);
    if (field & FIELD_POINT_A) recording.rowA[row] = takePoint(row);
    if (field & FIELD_POINT_B) recording.rowB[row] = takePoint(row);
    recording.rowLow[row] = field & FIELD_BELOW ? neighborDouble(time[i], -1) : time[i];
    recording.rowHigh[row] = field & FIELD_ABOVE ? neighborDouble(time[i], 1) : time[i];
    demand(row === 0 || (recording.rowLow[row - 1] <= recording.rowLow[row] &&
                         recording.rowHigh[row - 1] <= recording.rowHigh[row]),
           `event ${row} is before event ${row - 1}`);
  }
  demand(at === id.length, `${id.length - at} ids belong to no event`);
  demand(offsets === null || offset === offsets.length, 'offsets belong to no edge');
}

function readMotions(recording, json, ids) {
  demand(json !== null && typeof json === 'object', 'the trajectories are not there');
  const {count, degree} = json;
  demand([1, 2, 3].includes(degree), `the trajectories are of degree ${degree}, not 1, 2 or 3`);
  const stride = 3 + 2 * degree;
  const event = decodeNumbers(json.event, 'Uint32', 'the list of events of trajectories');
  const point = decodeNumbers(json.point, ids, 'the list of points of trajectories');
  const there = decodeNumbers(json.there, 'Uint8', 'the list of points that are there');
  const data = decodeNumbers(json.data, 'Float64', 'the list of trajectories');
  demand(event.length === count && point.length === count && there.length === count &&
         data.length === stride * count, `it has ${count} trajectories, but ${event.length} ` +
         `events, ${point.length} points and ${data.length / stride} places of them`);
  demand(Number.isInteger(json.starting) && json.starting >= 0 && json.starting <= count,
         'it does not say which trajectories are those of the start');
  const rowMotion = new Uint32Array(recording.rows + 1).fill(count);
  const motionRow = new Int32Array(count).fill(-1);
  const previous = new Int32Array(count).fill(-1), next = new Int32Array(count).fill(-1);
  const last = new Int32Array(recording.points).fill(-1);
  for (let i = count - 1; i >= json.starting; --i) {
    demand(event[i] < recording.rows, `trajectory ${i} begins with an event that is not there`);
    demand(i + 1 === count || event[i] <= event[i + 1], `trajectory ${i + 1} begins too early`);
    motionRow[i] = event[i];
    rowMotion[event[i]] = i;
  }
  for (let row = recording.rows - 1; row >= 0; --row) {
    rowMotion[row] = Math.min(rowMotion[row], rowMotion[row + 1]);
  }
  for (let i = 0; i < count; ++i) {
    demand(point[i] < recording.points, `trajectory ${i} is of point ${point[i]}, but the ids ` +
           `end with ${recording.points - 1}`);
    previous[i] = last[point[i]];
    if (previous[i] >= 0) next[previous[i]] = i;
    last[point[i]] = i;
  }
  demand(data.every(Number.isFinite), 'a trajectory has a place or speed that is no number');
  const sizes = json.sizes === undefined ? null :
    decodeNumbers(json.sizes, 'Float64', 'the list of sizes of discs');
  demand(sizes === null || (sizes.length === 3 * count && sizes.every(Number.isFinite)),
         'not every trajectory has a radius, a growth and a weight');
  Object.assign(recording, {degree, stride, motions: count, starting: json.starting, rowMotion,
                            motionRow, motionPoint: point, motionThere: there, motionData: data,
                            motionSizes: sizes,
                            motionPrevious: previous, motionNext: next});
}

function readCoincidences(recording, json, ids) {
  const {rows, points} = recording;
  const {count, starting, ...lists} = json ?? {count: 0, starting: 0, event: '', point: '', shown: ''};
  const row = Int32Array.from(decodeNumbers(lists.event, 'Uint32', 'the list of events of coincidences'));
  const point = decodeNumbers(lists.point, ids, 'the list of points that coincide');
  const shown = decodeNumbers(lists.shown, ids, 'the list of points that are shown');
  demand(row.length === count && point.length === count && shown.length === count,
         `it has ${count} coincidences, but ${row.length} events, ${point.length} points and ` +
         `${shown.length} shown points of them`);
  demand(Number.isInteger(starting) && starting >= 0 && starting <= count,
         'it does not say which coincidences are those of the start');
  const before = new Uint32Array(count), now = new Map();
  row.fill(-1, 0, starting);
  for (let i = 0; i < count; ++i) {
    demand(row[i] < rows && row[i] >= (i < starting ? -1 : 0) && (i === 0 || row[i - 1] <= row[i]),
           `coincidence ${i} is at a wrong event`);
    demand(point[i] < points && shown[i] < points, `coincidence ${i} is of a point that is not there`);
    before[i] = now.get(point[i]) ?? point[i];
    now.set(point[i], shown[i]);
  }
  Object.assign(recording, {coincidences: count, coincidenceRow: row, coincidencePoint: point,
                            coincidenceShown: shown, coincidenceBefore: before});
}

/** Whether the points have discs about them. */
function hasDiscs({radius, motionSizes}) {
  return radius > 0 || motionSizes !== null;
}

/** Whether points turn at times that are left out. */
function turnsAreLeftOut(recording) {
  return recording.thinned !== null && recording.motions > recording.starting;
}

/** Finds the rows of the same time, which are one step. */
function findInstants(recording) {
  recording.instants = 0;
  recording.instantBegin = new Uint32Array(recording.rows);
  recording.instantEnd = new Uint32Array(recording.rows);
  findInstantsFrom(recording, 0);
}

function findInstantsFrom(recording, firstRow) {
  const {rows, rowLow, rowHigh, instantBegin: begin, instantEnd: end} = recording;
  for (let row = firstRow; row < rows; ++row) {
    const goesOn = row > 0 && rowLow[row] === rowLow[row - 1] && rowHigh[row] === rowHigh[row - 1];
    begin[row] = goesOn ? begin[row - 1] : row;
    if (!goesOn) ++recording.instants;
  }
  for (let row = rows - 1; row >= 0 && (row >= firstRow || begin[row] === begin[firstRow]); --row) {
    end[row] = row + 1 < rows && begin[row + 1] === begin[row] ? end[row + 1] : row + 1;
  }
}

/** Checks that each event removes an edge that is there, and adds one that is not. */
function checkEdges(recording) {
  const {rows, edgeA, edgeB, rowRemoved, rowAdded} = recording;
  const isThere = new Uint8Array(edgeA.length);
  isThere.fill(1, 0, recording.initialEdges);
  const edgeName = (edge) => `${edgeA[edge]}\u2013${edgeB[edge]}`;
  for (let row = 0; row < rows; ++row) {
    const removed = rowRemoved[row], added = rowAdded[row];
    if (removed >= 0) {
      demand(isThere[removed] === 1, `event ${row} removes the edge ${edgeName(removed)}, which ` +
             'is not there then');
      isThere[removed] = 0;
    }
    if (added >= 0) {
      demand(isThere[added] === 0, `event ${row} adds the edge ${edgeName(added)}, which is there ` +
             'already');
      isThere[added] = 1;
    }
  }
}
