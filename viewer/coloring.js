// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points' colors: which numbers they can stand for, and which color a number has. The scale is
// that of the whole run, so that colors can be compared over time; a fiftieth of the numbers at
// either end may lie beyond it.
'use strict';

const RANGE_TIMES = 7;      // at which all numbers are looked at for the scale
const RANGE_BEYOND = 0.02;  // share of the numbers beyond either end of the scale
const MOST_LINEAR = 30;     // ratio of the ends up to which the scale of areas and densities is linear
const MOST_KINDS = 8;

/** What points can be colored by; `of(viewer, point)` is a number, NaN for none, after the cells have
 * been updated if `needsCells`. Numbers of kinds and components are indices of a palette, with names or none. */
const QUANTITIES = [
  {id: 'area', label: 'Cell area', unit: 'area', needsCells: true, isRatio: true,
   of: ({cells}, point) => cells.area[point] || NaN},
  {id: 'density', label: 'Density', unit: '1 / area', needsCells: true, isRatio: true,
   of: ({cells}, point) => 1 / (cells.area[point] || NaN)},
  {id: 'speed', label: 'Speed', unit: 'length / time',
   of: ({recording, playback}, point) => speedOf(recording, playback, point)},
  {id: 'degree', label: 'Neighbors', unit: '', needsCells: true, isWhole: true,
   of: ({cells}, point) => cells.degree[point]},
  {id: 'changes', label: 'Changes so far', unit: '', isWhole: true,
   of: ({changes}, point) => changes.count[point]},
  {id: 'size', label: 'Disc radius', unit: 'length', isOffered: (recording) => recording.motionSizes !== null,
   of: ({r}, point) => r[point]},
  {id: 'component', label: 'Component in range', unit: '', isOffered: hasEncounters,
   of: ({encounters: {component, size}}, point) => (size[point] > 1 ? component[point] % KIND_COLORS.length : NaN),
   paletteOf: () => KIND_COLORS, namesOf: () => []},
  {id: 'members', label: 'Points in the component', unit: '', isWhole: true, isOffered: hasEncounters,
   of: ({encounters}, point) => encounters.size[point]},
  {id: 'kind', label: 'Kind', unit: '', isOffered: (recording) => kindsOf(recording).length > 1,
   of: ({recording}, point) => kindNumbers(recording)[point],
   paletteOf: (recording) => kindsOf(recording).map((_, i) => kindColor(i)), namesOf: (recording) => kindsOf(recording)},
];

function speedOf(recording, playback, point) {
  const motion = playback.current[point];
  if (motion < 0 || recording.motionThere[motion] !== 1) return NaN;
  return Math.hypot(motionVelocity(recording, motion, playback.time, 0),
                    motionVelocity(recording, motion, playback.time, 1));
}

/** The kinds of points: their names without the number at the end; none if there are too many. */
function kindsOf(recording) {
  if (recording.names === null) return [];
  if (recording.kindNames === undefined) {
    const all = [...new Set(recording.names.map(kindOfName))].sort();
    recording.kindNames = all.length <= MOST_KINDS ? all : [];
  }
  return recording.kindNames;
}

function kindOfName(name) {
  return String(name).replace(/[\s_#.-]*\d+$/, '') || '(number)';
}

function kindNumbers(recording) {
  if (recording.kindNumbers === undefined) {
    const kinds = kindsOf(recording);
    recording.kindNumbers = recording.names.map((name) => kinds.indexOf(kindOfName(name)));
  }
  return recording.kindNumbers;
}

function quantitiesOf(recording) {
  return QUANTITIES.filter(({isOffered}) => isOffered === undefined || isOffered(recording));
}

/** The number of edges added or removed at each point up to the time shown. */
class Changes {
  constructor(recording) {
    this.recording = recording;
    this.event = 0;
    this.count = new Int32Array(recording.points);
  }

  update({event}) {
    while (this.event < event) this.add(this.event++, 1);
    while (this.event > event) this.add(--this.event, -1);
  }

  add(row, one) {
    const {rowRemoved, rowAdded, edgeA, edgeB} = this.recording;
    for (let k = 0; k < 2; ++k) {
      const edge = k === 0 ? rowRemoved[row] : rowAdded[row];
      if (edge < 0) continue;
      this.count[edgeA[edge]] += one;
      this.count[edgeB[edge]] += one;
    }
  }
}

/** The colors by one quantity. */
class Coloring {
  constructor(viewer, quantity) {
    this.viewer = viewer;
    this.quantity = quantity;
    this.shades = new Uint16Array(viewer.recording.points);
    this.hasShade = new Uint8Array(viewer.recording.points);
    this.isLogarithmic = false;
    if (quantity.paletteOf !== undefined) {
      this.palette = quantity.paletteOf(viewer.recording);
      this.least = 0;
      this.greatest = this.palette.length - 1;
    } else {
      this.palette = SCALE;
      this.findRange();
    }
  }

  /** Samples the numbers at some times of the run. */
  findRange() {
    const {viewer, quantity} = this;
    const {from, until, points} = viewer.recording;
    const {time, event} = viewer.playback;
    const numbers = [];
    const step = Math.max(Math.ceil(points / 5000), 1);
    for (let i = 0; i < RANGE_TIMES; ++i) {
      viewer.playback.goTo(from + (until - from) * i / (RANGE_TIMES - 1));
      viewer.place();
      this.measure();
      for (let point = 0; point < points; point += step) {
        if (Number.isNaN(viewer.x[point])) continue;
        const number = quantity.of(viewer, point);
        if (Number.isFinite(number)) numbers.push(number);
      }
    }
    viewer.playback.time = time;
    viewer.playback.goToEvent(event);
    viewer.place();
    const sorted = Float64Array.from(numbers).sort(), last = sorted.length - 1;
    const beyond = quantity.isWhole ? 0 : RANGE_BEYOND;
    this.least = last < 0 ? 0 : sorted[Math.floor(beyond * last)];
    this.greatest = last < 0 ? 0 : sorted[Math.ceil((1 - beyond) * last)];
    this.isLogarithmic = quantity.isRatio === true && this.greatest > MOST_LINEAR * this.least;
    this.isCut = last >= 0 && (sorted[0] < this.least || sorted[last] > this.greatest);
  }

  measure() {
    if (this.quantity.needsCells) this.viewer.cells.update();
    this.viewer.encounters?.connect();
    if (this.quantity.id === 'changes') this.viewer.changes.update(this.viewer.playback);
  }

  /** Computes the shade of each point at the time shown. */
  update() {
    this.measure();
    const {viewer, quantity, shades, hasShade, palette, isLogarithmic} = this;
    const least = isLogarithmic ? Math.log(this.least) : this.least;
    const greatest = isLogarithmic ? Math.log(this.greatest) : this.greatest;
    const perUnit = greatest > least ? (palette.length - 1) / (greatest - least) : 0;
    for (let point = 0; point < shades.length; ++point) {
      const number = Number.isNaN(viewer.x[point]) ? NaN : quantity.of(viewer, point);
      hasShade[point] = Number.isFinite(number) ? 1 : 0;
      if (hasShade[point] === 0) continue;
      const shade = Math.round(((isLogarithmic ? Math.log(number) : number) - least) * perUnit);
      shades[point] = Math.min(Math.max(shade, 0), palette.length - 1);
    }
  }
}

/** Fills the discs, the cells, or, if there are too many, large dots. */
function drawColors(painter, view) {
  const {viewer} = view;
  const {coloring, switches, recording, hidden} = viewer;
  coloring.update();
  const {shades, hasShade, palette} = coloring;
  const {camera, sx, sy, detail, width, height} = view;
  const onDiscs = switches.discs && hasDiscs(recording);
  if (!onDiscs && detail.showsCells(painter)) {
    if (!coloring.quantity.needsCells) viewer.cells.update();
    const batch = view.triangleBatch.clear();
    viewer.cells.forEachTriangle((point, ax, ay, bx, by, cx, cy) => {
      if (hasShade[point] === 0) return;
      const x0 = camera.screenX(ax), x1 = camera.screenX(bx), x2 = camera.screenX(cx);
      if (x0 < 0 && x1 < 0 && x2 < 0 || x0 > width && x1 > width && x2 > width) return;
      const y0 = camera.screenY(ay), y1 = camera.screenY(by), y2 = camera.screenY(cy);
      if (y0 < 0 && y1 < 0 && y2 < 0 || y0 > height && y1 > height && y2 > height) return;
      batch.triangle(x0, y0, x1, y1, x2, y2, shades[point]);
    });
    painter.triangles(batch, {palette});
    return;
  }
  const batch = view.circleBatch.clear();
  for (let point = 0; point < sx.length; ++point) {
    if (hasShade[point] === 0 || hidden[point] !== VISIBLE) continue;
    const radius = onDiscs ? viewer.r[point] * camera.scale : detail.spacing / 2;
    if (view.isSeen(sx[point], sy[point], radius)) batch.circle(sx[point], sy[point], radius, shades[point]);
  }
  painter.circles(batch, {palette});
}
