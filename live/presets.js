// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the page begins with: the columns and rows of a file of points, and the options of KineticDelaunay. All in
// a box of SIDE by SIDE, and the same each time.

const SIDE = 100;
const BOX = [0, 0, SIDE, SIDE];

/** Numbers from 0 to 1, the same in every browser. */
function randomNumbers(seed) {
  let state = seed >>> 0 || 1;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) / 4294967296;
  };
}

/** The text of a file of points: the names of its columns, and its rows. */
function pointsFile(names, rows) {
  return `${names.join()}\n${rows.map((row) => `${row.join()}\n`).join('')}`;
}

/** `count` places on a grid, each moved by up to `share` of half the room that discs of the radius leave. */
function jitteredGrid(count, radius, share, random, [left, bottom, right, top] = BOX) {
  const width = right - left, height = top - bottom;
  const columns = Math.max(Math.round(Math.sqrt(count * width / height)), 1), rows = Math.ceil(count / columns);
  const reachX = share * Math.max(width / columns / 2 - radius, 0);
  const reachY = share * Math.max(height / rows / 2 - radius, 0);
  return Array.from({length: count}, (_, i) => [
    left + (i % columns + 0.5) * width / columns + reachX * (2 * random() - 1),
    bottom + (Math.floor(i / columns) + 0.5) * height / rows + reachY * (2 * random() - 1),
  ]);
}

/** The radius with which `count` discs cover the share of the box. */
function radiusOfShare(count, share) {
  return Math.sqrt(share * SIDE * SIDE / (Math.PI * count));
}

/** Rows of places and velocities, and of the columns `names`; and options besides the box. */
function beginning(rows, options = {}, names = []) {
  return {names: ['x', 'y', 'vx', 'vy', ...names], rows, options: {box: BOX, ...options}};
}

function gas(count) {
  const random = randomNumbers(7), radius = radiusOfShare(count, 0.18);
  const velocity = () => 40 * (random() - 0.5);
  const rows = jitteredGrid(count, radius, 0.9, random).map((place) => [...place, velocity(), velocity()]);
  return beginning(rows, {radius, rim: true, collisions: 'elastic'});
}

function falling(count) {
  const random = randomNumbers(13), radius = radiusOfShare(count, 0.08);
  const velocity = () => 30 * (random() - 0.5);
  const rows = jitteredGrid(count, radius, 0.8, random).map((place) => [...place, velocity(), velocity()]);
  return beginning(rows, {radius, rim: true, collisions: 'elastic'});
}

function packing(count) {
  const random = randomNumbers(11), radius = radiusOfShare(count, 0.05), growth = radius / 4;
  const velocity = () => 12 * (random() - 0.5);
  const rows = jitteredGrid(count, radius, 0.9, random).map(
    (place) => [...place, velocity(), velocity(), radius * (0.6 + 0.4 * random()), growth * (0.6 + 0.4 * random())]);
  return beginning(rows, {rim: true, collisions: 'elastic'}, ['radius', 'growth']);
}

function crowds(count) {
  const random = randomNumbers(5), half = Math.floor(count / 2), radius = radiusOfShare(count, 0.1);
  const walk = () => 6 + 3 * random(), drift = () => 2 * (random() - 0.5);
  const group = (number, sides, direction) => jitteredGrid(number, radius, 0.8, random, sides).map(
    (place) => [...place, direction * walk(), drift()]);
  const rows = [...group(half, [0, 10, 42, 90], 1), ...group(count - half, [58, 10, 100, 90], -1)];
  return beginning(rows, {radius, rim: true, collisions: 'elastic'});
}

function flock(count) {
  const random = randomNumbers(3), velocity = () => 24 * (random() - 0.5);
  return beginning(jitteredGrid(count, 0, 0.9, random).map((place) => [...place, velocity(), velocity()]));
}

/** Turns each point toward the mean velocity of itself and its neighbors, by a share. */
function turnFlock(points, share) {
  const before = points.velocities(), edges = points.edges();
  const sum = before.slice(), count = new Float64Array(before.length / 2).fill(1);
  for (let i = 0; i < edges.length; i += 2) {
    const a = edges[i], b = edges[i + 1];
    for (let k = 0; k < 2; ++k) {
      sum[2 * a + k] += before[2 * b + k];
      sum[2 * b + k] += before[2 * a + k];
    }
    ++count[a];
    ++count[b];
  }
  const ids = [], velocities = [];
  for (let id = 0; id < count.length; ++id) {
    if (Number.isNaN(before[2 * id])) continue;
    const turned = [0, 1].map((k) => before[2 * id + k] + share * (sum[2 * id + k] / count[id] - before[2 * id + k]));
    const speed = Math.hypot(before[2 * id], before[2 * id + 1]), now = Math.hypot(...turned);
    ids.push(id);
    velocities.push(turned.map((component) => (now > 0 ? component * speed / now : component)));
  }
  points.setVelocities(ids, velocities);
}

function oneMover(count) {
  const random = randomNumbers(9);
  const rows = jitteredGrid(count, 0, 0.7, random).map((place) => [...place, 0, 0]);
  if (rows.length > 0) rows[0].splice(2, 2, 31, 19);
  return beginning(rows);
}

/** The two indices of each of `count` points of a lattice of `size` x `size`; its last line may be incomplete. */
function squareLattice(count, size) {
  return Array.from({length: count}, (_, i) => [Math.floor(i / size), i % size]);
}

/** A lattice whose columns move up and down: at many times all its points are cocircular with others. */
function lattice(count) {
  // Multiples of this step are exact.
  const size = Math.ceil(Math.sqrt(count)), step = Math.floor(1024 * SIDE / (size + 1)) / 1024;
  return beginning(squareLattice(count, size).map(
    ([column, row]) => [step * (column + 1), step * (row + 1), 0, column % 2 === 0 ? step : -step]));
}

/** The wave of the paper: a row of points moves up, and hands its velocity on to each row that it meets. */
function wave(count) {
  const size = Math.max(Math.ceil(Math.sqrt(count)), 2), step = SIDE / size;
  const rows = squareLattice(count, size).map(
    ([row, column]) => [step * (column + 0.5), step * (row + 0.5), 0, row === 0 ? step : 0]);
  return beginning(rows, {radius: step / 128, collisions: 'swap'});
}

const PRESETS = {
  gas: {label: 'Gas', make: gas, count: 120},
  falling: {label: 'Falling discs', make: falling, count: 60, gravity: 30},
  packing: {label: 'Packing', make: packing, count: 150},
  crowds: {label: 'Two crowds', make: crowds, count: 240},
  flock: {label: 'Flock', make: flock, count: 200, turn: turnFlock},
  mover: {label: 'One mover', make: oneMover, count: 400},
  lattice: {label: 'Lattice', make: lattice, count: 144},
  wave: {label: 'Wave', make: wave, count: 225},
};

/**
 * The file and the options of a preset with `number` points, with the changes that are asked for; null: none.
 * `gravity` is an acceleration downwards. Discs that grow without a response to contacts change the
 * triangulation, the regular one.
 */
function pointsOf(preset, number, {radius = null, growth = null, collisions = null, gravity = null} = {}) {
  const {names, rows, options} = preset.make(number);
  const setColumn = (name, value) => {
    if (!names.includes(name)) names.push(name);
    for (const row of rows) row[names.indexOf(name)] = value;
  };
  if (collisions !== null) options.collisions = collisions;
  const isTouching = (options.collisions ?? 'none') !== 'none', hasRadii = names.includes('radius');
  let size = radius ?? options.radius ?? null;
  if (size === null && !hasRadii && (isTouching || growth !== null)) size = radiusOfShare(number, 0.05);
  if (size !== null) options.radius = size;
  if (growth !== null || hasRadii) {  // then each disc has a radius of its own
    if (size !== null) setColumn('radius', size);
    if (growth !== null) setColumn('growth', growth);
    delete options.radius;
    options.regular = !isTouching;
  }
  const fall = gravity ?? preset.gravity ?? 0;
  if (fall !== 0) {
    setColumn('ax', 0);
    setColumn('ay', -fall);
  }
  return {text: pointsFile(names, rows), options, gravity: fall};
}
