// SPDX-License-Identifier: GPL-3.0-or-later
//
// The module for JavaScript, in node. usage: node module_test.mjs PACKAGE, or PAGE.html for the module of a live page.
// Ends with 77, which ctest takes for skipped, if the package has not been built.
//
// The oracle for triangulations is a definition: no point is inside the circle of a triangle, decided by whole
// numbers. Coordinates are multiples of 1/4096, and so are velocities times the times at which it is asked.
import assert from 'node:assert/strict';
import {execFileSync, spawnSync} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import path from 'node:path';
import test from 'node:test';
import {fileURLToPath, pathToFileURL} from 'node:url';

const isPage = process.argv[2].endsWith('.html');
const live = path.join(path.dirname(fileURLToPath(import.meta.url)), '../../live');
const folder = isPage ? live : path.resolve(process.argv[2]);
if (!isPage && !existsSync(path.join(folder, 'kinetri.wasm'))) {
  console.log(`there is no module in ${folder}; scripts/test.sh --live builds it`);
  process.exit(77);
}

/** The bytes of the module of the page; undefined: those of the package. */
function bytesOfPage() {
  if (!isPage) return undefined;
  const [, text] = readFileSync(process.argv[2], 'utf8').match(/ id="module">([^<]*)</);
  return new Function(`${readFileSync(path.join(live, 'unpack.js'), 'utf8')}; return unpacked;`)()(text);
}

const {KineticDelaunay, KinetriError, load} = await import(pathToFileURL(path.join(folder, 'kinetri.mjs')));

test('a class is used only after the module is loaded', () => {
  assert.throws(() => new KineticDelaunay([[0, 0]]), /not loaded; expected `await load\(\)`/);
});

test('bytes that are no module are refused', async () => {
  await assert.rejects(load(new Uint8Array([1, 2, 3])), /cannot compile the module/);
});

await load(bytesOfPage());

const FINEST = 4096;
const whole = (x) => {
  assert.ok(Number.isInteger(FINEST * x), `${x} is a multiple of 1/${FINEST}`);
  return BigInt(FINEST * x);
};

/** Positive if d is inside of the circle through a, b and c, which are counterclockwise. */
function inCircle(a, b, c, d) {
  const rows = [a, b, c].map(([x, y]) => [x - d[0], y - d[1], (x - d[0]) ** 2n + (y - d[1]) ** 2n]);
  const [p, q, r] = rows;
  return p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
}

function orientation(a, b, c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/** Checks that the triangles are those of a Delaunay triangulation of the places, by the definition. */
function checkDelaunay(points) {
  const numbers = points.positions(), places = [];
  for (let i = 0; i < numbers.length; i += 2) {
    places.push(Number.isNaN(numbers[i]) ? null : [whole(numbers[i]), whole(numbers[i + 1])]);
  }
  const triangles = points.triangles(), edges = new Set();
  assert.ok(triangles.length > 0);
  for (let i = 0; i < triangles.length; i += 3) {
    const ids = Array.from(triangles.subarray(i, i + 3)), corners = ids.map((id) => places[id]);
    assert.ok(orientation(...corners) > 0n, `the triangle ${ids} is counterclockwise`);
    for (const place of places) if (place !== null) assert.ok(inCircle(...corners, place) <= 0n);
    ids.forEach((a, k) => edges.add([a, ids[(k + 1) % 3]].sort((p, q) => p - q).join()));
  }
  const listed = points.edges();
  assert.equal(edges.size, listed.length / 2);
  for (let i = 0; i < listed.length; i += 2) assert.ok(edges.has(`${listed[i]},${listed[i + 1]}`));
  // With h corners on the hull, n points have 2 n - 2 - h triangles: none is missing.
  const count = places.filter((place) => place !== null).length;
  assert.equal(listed.length / 2, count + triangles.length / 3 - 1);
}

function randomNumbers(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 4294967296;
  };
}

function randomPoints(count, seed) {
  const random = randomNumbers(seed), pair = () => [Math.floor(1000 * random()) / 8, Math.floor(1000 * random()) / 8];
  return [Array.from({length: count}, pair), Array.from({length: count}, () => pair().map((x) => x / 4 - 16))];
}

test('the example of the README', () => {
  const points = new KineticDelaunay([[0, 0], [1, 0], [1, 1], [0, 2]], [[0, 0], [0, 0], [0, 0], [0, -1]]);
  const seen = [];
  points.watch((event) => seen.push(event));
  assert.deepEqual(points.nextEvent(), {kind: 'flip', time: 1, lower: 1, upper: 1, polynomial: points.nextEvent().polynomial,
                                        removed: [0, 2], added: [1, 3], points: []});
  assert.equal(points.time, 0);
  assert.equal(points.advanceTo(1.5), true);
  assert.deepEqual(seen, [{number: 0, kind: 'flip', time: 1, lower: 1, upper: 1, removed: [0, 2], added: [1, 3], points: []}]);
  assert.deepEqual(Array.from(points.edges()), [0, 1, 0, 3, 1, 2, 1, 3, 2, 3]);
  assert.deepEqual(Array.from(points.positions().subarray(6)), [0, 0.5]);
  points.setVelocities([3], [[2, 0]]);
  assert.deepEqual(Array.from(points.velocities().subarray(6)), [2, 0]);
  assert.notEqual(points.nextEvent(), null);
  const id = points.insert([0.5, 0.25]);
  assert.equal(id, 4);
  assert.equal(points.length, 5);
  points.erase(id);
  assert.equal(points.length, 4);
  assert.ok(Number.isNaN(points.positions()[8]));
  assert.deepEqual(seen.slice(1).map(({kind, points: ids}) => [kind, ...ids]).filter(([kind]) => kind !== 'rebuild'),
                   [['trajectory', 3], ['insert', 4], ['erase', 4]]);
});

test('the polynomial of a time has it as its root', () => {
  const [positions, velocities] = randomPoints(20, 3);
  const points = new KineticDelaunay(positions, velocities);
  for (let i = 0; i < 50; ++i) {
    const {lower, upper, polynomial} = points.nextEvent();
    assert.ok(lower <= upper);
    const sign = (t) => {  // at k / 2^1074, exactly
      const shift = 1074n, [numerator] = [scaled(t)];
      let value = 0n, power = 1n;
      const terms = polynomial.map(BigInt), degree = BigInt(terms.length - 1);
      terms.forEach((term, k) => {
        value += term * power << (shift * (degree - BigInt(k)));
        power *= numerator;
      });
      return value > 0n ? 1 : value < 0n ? -1 : 0;
    };
    if (lower === upper) assert.equal(sign(lower), 0);
    else assert.equal(sign(lower) * sign(upper), -1);
    assert.ok(points.step() > 0);
  }
});

/** t times 2^1074. */
function scaled(t) {
  const view = new DataView(new ArrayBuffer(8));
  view.setFloat64(0, t);
  const bits = view.getBigUint64(0), exponent = (bits >> 52n) & 2047n;
  const mantissa = (bits & ((1n << 52n) - 1n)) | (exponent === 0n ? 0n : 1n << 52n);
  const size = mantissa << (exponent === 0n ? 0n : exponent - 1n);
  return bits >> 63n === 1n ? -size : size;
}

test('the triangulation is Delaunay by definition, at many times and after changes', () => {
  const [positions, velocities] = randomPoints(40, 1);
  const points = new KineticDelaunay(positions, velocities);
  let events = 0;
  points.watch(() => ++events);
  checkDelaunay(points);
  for (let time = 0.25; time <= 3; time += 0.25) {
    points.advanceTo(time);
    checkDelaunay(points);
    assert.deepEqual(points.audit(), []);
  }
  assert.ok(events > 100);
  assert.equal(points.statistics().events, events);
  points.setMotions([5, 6], [[1, 2], [3, 4]], [[0.5, 0], [0, 0]]);
  points.erase(7);
  points.insert([11.5, 60], [1, 1]);
  checkDelaunay(points);
  points.advanceTo(4);
  checkDelaunay(points);
  assert.deepEqual(points.audit(), []);
});

test('flat arrays are the same as pairs', () => {
  const [positions, velocities] = randomPoints(10, 2);
  const pairs = new KineticDelaunay(positions, velocities);
  const flat = new KineticDelaunay(Float64Array.from(positions.flat()), Float64Array.from(velocities.flat()));
  pairs.logEvents();
  flat.logEvents();
  pairs.advanceTo(2);
  flat.advanceTo(2);
  const log = pairs.takeEvents();
  assert.ok(log.split('\n').length > 10);
  assert.equal(flat.takeEvents(), log);
});

test('discs collide, and stay in their box', () => {
  const points = new KineticDelaunay([[2, 2], [6, 2]], [[1, 0], [-1, 0]],
                                     {box: [0, 0, 8, 4], radius: 1, rim: true, collisions: 'elastic'});
  const seen = [];
  points.watch(({kind, time}) => seen.push([kind, time]));
  points.advanceTo(3.5);
  assert.deepEqual(seen, [['collision', 1], ['wall', 3], ['wall', 3]].slice(0, seen.length));
  assert.equal(seen.length, 1 + 2 * (seen.length > 1));
  assert.deepEqual(Array.from(points.radii()), [1, 1]);
  const growing = new KineticDelaunay([[1, 1], [5, 1]], null, {radii: [1, 1], growths: [0.5, 0.5], collisions: 'log'});
  assert.equal(growing.nextEvent().time, 2);
});

test('points fall, and can be given other accelerations', () => {
  const fall = [0, -2], box = [0, 0, 10, 10];
  const points = new KineticDelaunay([[2, 8], [6, 8], [4, 2]], null, {accelerations: [fall, fall, fall], box});
  points.advanceTo(1);
  assert.deepEqual(Array.from(points.positions()), [2, 7, 6, 7, 4, 1]);
  assert.deepEqual(Array.from(points.velocities()), [0, -2, 0, -2, 0, -2]);
  assert.deepEqual(Array.from(points.accelerations()), [0, -2, 0, -2, 0, -2]);
  points.setMotions([0], [[2, 7]], [[0, 0]], [[0, 0]]);  // it stays there
  assert.equal(points.insert([5, 5], [1, 0], 0, fall), 3);
  assert.equal(points.insert([9, 5]), 4);
  const bounces = [];
  points.watch(({kind, points: [id], lower, upper}) => { if (kind === 'wall') bounces.push([id, lower, upper]); });
  points.advanceTo(2);
  const places = Array.from(points.positions());
  assert.deepEqual(places.filter((_, i) => i < 4 || i > 5), [2, 7, 6, 4, 6, 4, 9, 5]);
  assert.deepEqual(Array.from(points.accelerations()), [0, 0, 0, -2, 0, -2, 0, -2, 0, 0]);
  // At the square root of 2 it rebounds.
  const [[id, lower, upper], ...others] = bounces;
  assert.deepEqual([id, others], [2, []]);
  assert.ok(lower ** 2 <= 2 && 2 <= upper ** 2 && upper - lower < 1e-15);
  assert.deepEqual(points.audit(), []);
  const straight = new KineticDelaunay([[0, 0], [1, 0], [0, 1]], [[1, 0], [0, 0], [0, 1]]);
  assert.throws(() => straight.insert([5, 5], [0, 0], 0, fall), /the points have no accelerations; expected 0, or points/);
  assert.throws(() => straight.setMotions([0], [[0, 0]], [[0, 0]], [fall]), /the points have no accelerations/);
  straight.setMotions([0], [[0, 0.5]], [[0, 0]], [[0, 0]]);
  assert.deepEqual(Array.from(straight.accelerations()), [0, 0, 0, 0, 0, 0]);
  assert.equal(straight.length, 3);
});

test('masses are those of the options, and can be changed', () => {
  const points = new KineticDelaunay([[2, 2], [6, 2]], [[1, 0], [-1, 0]], {radius: 1, collisions: 'elastic', masses: [3, 1]});
  assert.deepEqual(Array.from(points.masses()), [3, 1]);
  points.setMass(1, 3);
  assert.deepEqual(Array.from(points.masses()), [3, 3]);
  points.advanceTo(2);  // equal masses exchange their velocities
  assert.deepEqual(Array.from(points.velocities()), [-1, 0, 1, 0]);
  points.erase(0);
  assert.deepEqual(Array.from(points.masses()), [NaN, 3]);
  assert.throws(() => points.setMass(1, 0), KinetriError);
});

test('errors say what is wrong, and change nothing', () => {
  assert.throws(() => new KineticDelaunay([[0, 0], [1]]), (error) =>
    error instanceof KinetriError && /positions: row 1 has 1 numbers; expected 2/.test(error.message));
  assert.throws(() => new KineticDelaunay([[0, 0], [NaN, 1]]), /is not finite; expected a finite number/);
  assert.throws(() => new KineticDelaunay([[0, 0]], [[0, 0], [1, 1]]), /velocities: there are 4 numbers; expected 2 for each of 1/);
  assert.throws(() => new KineticDelaunay([[0, 0]], null, {collisions: 'bounce'}), /'bounce' is unknown; expected none, log/);
  assert.throws(() => new KineticDelaunay([[9, 9]], null, {box: [0, 0, 1, 1]}), /points:2: .*box/);
  const points = new KineticDelaunay([[0, 0], [1, 0], [0, 1]], null, {box: [-2, -2, 2, 2]});
  points.advanceTo(1);
  assert.throws(() => points.advanceTo(0.5), KinetriError);
  assert.throws(() => points.advanceTo(NaN), /expected a finite number/);
  assert.throws(() => points.erase(17), KinetriError);
  assert.throws(() => points.insert([5, 0]), KinetriError);
  assert.equal(points.length, 3);
  assert.deepEqual(points.audit(), []);
  points.close();
  assert.throws(() => points.edges(), /have been closed/);
});

test('time that is too short stops it at an event', () => {
  const [positions, velocities] = randomPoints(200, 4);
  const points = new KineticDelaunay(positions, velocities);
  assert.equal(points.advanceTo(10, 0), false);
  assert.ok(points.time < 10);
  assert.equal(points.advanceTo(0.5), true);
  assert.deepEqual(points.audit(), []);
});

/** Why there is no package to be packed; false: there is. */
function lackOfPackage() {
  if (isPage) return 'a page is no package';
  return spawnSync('npm', ['--version']).error ? 'npm is not installed' : false;
}

test('the package is packed by npm, and the program of its README works where it is installed', {
  skip: lackOfPackage(),
}, (context) => {
  const place = mkdtempSync(path.join(tmpdir(), 'kinetri-'));
  context.after(() => rmSync(place, {recursive: true}));
  const npm = (...words) => execFileSync('npm', words, {cwd: place, encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore']});
  const [{filename, files}] = JSON.parse(npm('pack', '--json', folder));
  assert.deepEqual(files.map((file) => file.path).sort(),
                   ['LICENSE', 'README.md', 'kinetri.d.ts', 'kinetri.mjs', 'kinetri.wasm', 'package.json']);
  npm('install', '--offline', '--no-audit', filename);
  const [, program] = /```js\n([^`]*)```/.exec(readFileSync(path.join(folder, 'README.md'), 'utf8'));
  writeFileSync(path.join(place, 'program.mjs'), program);
  const output = execFileSync('node', ['program.mjs'], {cwd: place, encoding: 'utf8'});
  assert.ok(output.startsWith(`${/\/\/ (flip .*)/.exec(program)[1]}\n`), output);
  for (const kind of ['trajectory', 'insert', 'erase']) assert.match(output, new RegExp(`^${kind} 1.5 null null$`, 'm'));
});
