// SPDX-License-Identifier: GPL-3.0-or-later
//
// Kinetri for JavaScript: loads kinetri.wasm (live/engine.cpp), and the class KineticDelaunay, whose words
// are those of the Python package. It needs nothing but WebAssembly. live/kinetri.d.ts has the types.

/** What the module reports: the message is that of the library. */
export class KinetriError extends Error {}

let wasm = null;  // the exports of the module

const bytesAt = (address, size) => new Uint8Array(wasm.memory.buffer, address, size);
const decoder = new TextDecoder(), encoder = new TextEncoder();

/** What the module calls: it prints errors, and asks for the time and for the digits of numbers. */
const system = {
  fd_write(file, vectors, count, resultAt) {
    const view = new DataView(wasm.memory.buffer);
    let text = '', written = 0;
    for (let i = 0; i < count; ++i) {
      const size = view.getUint32(vectors + 8 * i + 4, true);
      text += decoder.decode(bytesAt(view.getUint32(vectors + 8 * i, true), size));
      written += size;
    }
    if (text.trim() !== '') console.error(text.trimEnd());
    view.setUint32(resultAt, written, true);
    return 0;
  },
  clock_time_get(clock, precision, resultAt) {
    const now = BigInt(Math.round(1e6 * performance.now()));
    new DataView(wasm.memory.buffer).setBigUint64(resultAt, now, true);
    return 0;
  },
  // As cmake/platforms/wasm/standard_library.h says.
  kinetri_digits(number, at) {
    const text = number.toExponential(), bytes = bytesAt(at, text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return text.length;
  },
  proc_exit(code) {
    throw new KinetriError(`the module has stopped with the code ${code}`);
  },
};

const NOT_THERE = 52;  // the error number of a system call that does not exist

/** An object with a function for each import of the module: those that are not in `system` fail. */
function importsOf(module) {
  const imports = {};
  for (const {module: from, name, kind} of WebAssembly.Module.imports(module)) {
    if (kind !== 'function') throw new KinetriError(`the module needs ${from}.${name}, which is no function`);
    imports[from] ??= {};
    imports[from][name] = system[name] ?? (() => NOT_THERE);
  }
  return imports;
}

/**
 * Loads the module, once; necessary before the first KineticDelaunay. `source` is a WebAssembly.Module, its
 * bytes, or nothing: then kinetri.wasm is read from the folder of this file.
 */
export async function load(source) {
  if (wasm !== null) return;
  if (typeof WebAssembly !== 'object') {
    throw new KinetriError('this browser has no WebAssembly; expected one from 2023 or later');
  }
  let module = source ?? await readModule(new URL('kinetri.wasm', import.meta.url));
  if (!(module instanceof WebAssembly.Module)) {
    try {
      module = await WebAssembly.compile(module);
    } catch (error) {
      throw new KinetriError(`this browser cannot compile the module (${error.message}); expected one from 2023 or later`);
    }
  }
  const instance = await WebAssembly.instantiate(module, importsOf(module));
  wasm = instance.exports;
  wasm._initialize();
}

async function readModule(url) {
  if (url.protocol === 'file:' && typeof process === 'object') {
    return (await import('node:fs/promises')).readFile(url);
  }
  const response = await fetch(url);
  if (!response.ok) throw new KinetriError(`${url} cannot be read: ${response.status} ${response.statusText}`);
  return response.arrayBuffer();
}

// ---- arguments and results ----

const textOf = () => decoder.decode(bytesAt(wasm.kinetri_text(), wasm.kinetri_text_size()));
const idsOf = () => new Uint32Array(wasm.memory.buffer, wasm.kinetri_ids(), wasm.kinetri_ids_size()).slice();
const numbersOf = () =>
  new Float64Array(wasm.memory.buffer, wasm.kinetri_numbers(), wasm.kinetri_numbers_size()).slice();

/** Throws the error of a call whose result says that it has failed. */
function checked(result, failure = -1) {
  if (result === failure) throw new KinetriError(textOf());
  return result;
}

/** Calls function(address, ...) with the addresses of copies of the typed arrays in the module's memory. */
function withCopies(arrays, run) {
  const addresses = arrays.map((array) => {
    const address = wasm.kinetri_allocate(Math.max(array.byteLength, 1));
    if (address === 0) throw new KinetriError('there is no memory left for the arguments');
    bytesAt(address, array.byteLength).set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
    return address;
  });
  try {
    return run(...addresses);
  } finally {
    for (const address of addresses) wasm.kinetri_release(address);
  }
}

/** Rows of `width` numbers, from a list of lists or a flat array, as a Float64Array. */
function rowsOf(name, value, width, count) {
  const list = Array.isArray(value) ? value : Array.from(value);
  if (Array.isArray(list[0])) {
    const wrong = list.findIndex((row) => row?.length !== width);
    if (wrong >= 0) throw new KinetriError(`${name}: row ${wrong} has ${list[wrong]?.length} numbers; expected ${width}`);
  }
  const numbers = Float64Array.from(list.flat());
  const expected = count === undefined ? Math.floor(numbers.length / width) : count;
  if (numbers.length !== width * expected) {
    throw new KinetriError(`${name}: there are ${numbers.length} numbers; expected ${width} for each of ${expected} points`);
  }
  return numbers;
}

/** The points as a file that `kinetri simulate` reads. */
function pointsText(positions, velocities, options) {
  const places = rowsOf('positions', positions, 2), count = places.length / 2;
  const columns = {};
  const add = (names, name, value) => {
    if (value === undefined || value === null) return;
    const numbers = rowsOf(name, value, names.length, count);
    names.forEach((column, k) => { columns[column] = (i) => numbers[names.length * i + k]; });
  };
  add(['x', 'y'], 'positions', places);
  add(['vx', 'vy'], 'velocities', velocities ?? new Float64Array(2 * count));
  add(['ax', 'ay'], 'accelerations', options.accelerations);
  add(['jx', 'jy'], 'jerks', options.jerks);
  add(['radius'], 'radii', options.radii);
  add(['growth'], 'growths', options.growths);
  add(['mass'], 'masses', options.masses);
  const names = Object.keys(columns), lines = [names.join()];
  for (let i = 0; i < count; ++i) lines.push(names.map((name) => columns[name](i)).join());
  return `${lines.join('\n')}\n`;
}

/** The event of a line of the event log. */
function eventOf(line) {
  const [number, kind, time, lower, upper, ...rest] = line.split(',');
  const ids = rest.map((field) => (field === '' ? null : Number(field)));
  const edge = (i) => (ids[i] === null ? null : [ids[i], ids[i + 1]]);
  return {
    number: Number(number), kind, time: Number(time), lower: Number(lower), upper: Number(upper),
    removed: edge(0), added: edge(2), points: ids.slice(4, 6).filter((id) => id !== null),
  };
}

// ---- the class ----

/**
 * The Delaunay triangulation of moving points, exact at every time, from time 0 on; in a box, and with discs
 * that collide, if the options say so. Points have ids: 0, 1, 2, ... in their order.
 */
export class KineticDelaunay {
  #engine = 0;
  #callback = null;

  /**
   * `positions` and `velocities` (all 0 if left out) are lists of pairs, or flat arrays. Options, all of which
   * may be left out: `accelerations`, `jerks`; `box`, [xmin, ymin, xmax, ymax]; `radii` and `growths` of
   * discs, their `masses`; `radius` of all discs; `collisions`, one of none, log, swap, elastic, stop and
   * remove; `rim`, whether the discs, not their centers, stay in the box; `regular`, for the regular
   * triangulation of the discs. Throws KinetriError with the message of the library.
   */
  constructor(positions, velocities, options = {}) {
    this.#open(pointsText(positions, velocities, options), options);
  }

  /** The points of a text as `kinetri simulate` reads it from a file; options as of the constructor. */
  static read(text, options = {}) {
    const points = new KineticDelaunay([], []);
    points.close();
    points.#open(text, options);
    return points;
  }

  #open(text, {box = null, radius = -1, collisions = 'none', rim = false, regular = false, exactOnly = false}) {
    if (wasm === null) throw new KinetriError('the module is not loaded; expected `await load()` before');
    const response = withCopies([encoder.encode(`${collisions}\0`)], (name) => wasm.kinetri_response(name));
    if (response < 0) {
      throw new KinetriError(`collisions: '${collisions}' is unknown; expected none, log, swap, elastic, stop or remove`);
    }
    const bytes = encoder.encode(text), sides = box === null ? [] : [rowsOf('box', box, 4, 1)];
    this.#engine = withCopies([bytes, ...sides], (address, boxAddress = 0) => checked(wasm.kinetri_open(
      address, bytes.length, boxAddress, radius, response, rim ? 1 : 0, regular ? 1 : 0, exactOnly ? 1 : 0), 0));
  }

  /** Frees the memory of the points. They cannot be used any more. */
  close() {
    wasm.kinetri_close(this.#there());
    this.#engine = 0;
  }

  #there() {
    if (this.#engine === 0) throw new KinetriError('the points have been closed');
    return this.#engine;
  }

  // ---- the present ----

  /** The present time, rounded to the nearest number. The triangulation is that just after the exact one. */
  get time() {
    return wasm.kinetri_time(this.#there());
  }

  /** The number of points. */
  get length() {
    return wasm.kinetri_points(this.#there());
  }

  /** x and y of each point by id, rounded; NaN for a point that has been erased. */
  positions() {
    wasm.kinetri_positions(this.#there());
    return numbersOf();
  }

  /** The components of the velocity of each point by id; NaN for a point that has been erased. */
  velocities() {
    wasm.kinetri_velocities(this.#there());
    return numbersOf();
  }

  /** The components of the acceleration of each point by id; NaN for a point that has been erased. */
  accelerations() {
    wasm.kinetri_accelerations(this.#there());
    return numbersOf();
  }

  /** The radius of each point by id; NaN for a point that has been erased. */
  radii() {
    wasm.kinetri_radii(this.#there());
    return numbersOf();
  }

  /** The mass of each point by id; NaN for a point that has been erased. */
  masses() {
    wasm.kinetri_masses(this.#there());
    return numbersOf();
  }

  /** The ids of the ends of the edges, two an edge, the smaller first; sorted. */
  edges() {
    wasm.kinetri_edges(this.#there());
    return idsOf();
  }

  /** The ids of the corners of the triangles, three each, counterclockwise, the least first; sorted. */
  triangles() {
    wasm.kinetri_triangles(this.#there());
    return idsOf();
  }

  /** Checks the present state against exact static geometry. The list of failures is empty if it passes. */
  audit() {
    checked(wasm.kinetri_audit(this.#there()));
    return textOf().split('\n').filter((line) => line !== '');
  }

  /** Counts so far: {events, filtered, exact}, the last two of certificates by what has decided them. */
  statistics() {
    wasm.kinetri_counters(this.#there());
    const [events, filtered, exact] = numbersOf();
    return {events, filtered, exact};
  }

  // ---- time ----

  /**
   * Executes all events up to the time, included. With `milliseconds` it stops when these are over. Returns
   * whether it has arrived: if not, the present time is that of the last event.
   */
  advanceTo(time, milliseconds = Infinity) {
    if (!Number.isFinite(time)) throw new KinetriError(`the time is ${time}; expected a finite number`);
    return this.#reported(wasm.kinetri_advance(this.#there(), time, milliseconds)) === 1;
  }

  /** Executes all events of the next time with events, and returns their number; 0 if there is none. */
  step() {
    return this.#reported(wasm.kinetri_step(this.#there()));
  }

  /**
   * The next event, as those of `watch`, or null; `polynomial` has the coefficients, from the constant one on,
   * of a polynomial of which the exact time is the root between `lower` and `upper`. Costs as much as making
   * the points anew.
   */
  nextEvent() {
    return checked(wasm.kinetri_next_event(this.#there())) === 0 ? null : JSON.parse(textOf());
  }

  /**
   * Calls callback(event) for each event from now on, in order, after the function that executes it: {number,
   * kind, time, lower, upper, removed, added, points}. The exact time is between `lower` and `upper`, which
   * are equal if it is a number; `time` is the nearest one. The callback must not change the points.
   */
  watch(callback) {
    if (this.#callback === null) wasm.kinetri_log_events(this.#there());
    this.#callback = callback;
    wasm.kinetri_take_events(this.#there());
  }

  #report() {
    if (this.#callback === null) return;
    wasm.kinetri_take_events(this.#there());
    for (const line of textOf().split('\n')) if (line !== '') this.#callback(eventOf(line));
  }

  /** The result of a call, after the events that it has executed; throws its error. */
  #reported(result) {
    const message = result === -1 ? textOf() : '';
    this.#report();
    if (result === -1) throw new KinetriError(message);
    return result;
  }

  // ---- changes, now ----

  /** Gives all points, or those with the ids, these velocities. The arguments are (velocities) or (ids, velocities). */
  setVelocities(...values) {
    const [ids, velocities] = values.length === 1 ? [this.#ids(), values[0]] : values;
    const points = Uint32Array.from(ids), vectors = rowsOf('velocities', velocities, 2, points.length);
    this.#reported(withCopies([points, vectors], (p, v) =>
      wasm.kinetri_set_velocities(this.#there(), p, points.length, v)));
  }

  /**
   * Moves points to positions from which they go on with these velocities (0 if left out) and accelerations
   * (theirs, if left out). Only points that were made with accelerations can have others than 0.
   */
  setMotions(ids, positions, velocities, accelerations) {
    const points = Uint32Array.from(ids), places = rowsOf('positions', positions, 2, points.length);
    const vectors = velocities === undefined ? new Float64Array(2 * points.length) :
      rowsOf('velocities', velocities, 2, points.length);
    const more = accelerations === undefined ? [] : [rowsOf('accelerations', accelerations, 2, points.length)];
    this.#reported(withCopies([points, places, vectors, ...more], (p, x, v, a = 0) =>
      wasm.kinetri_set_motions(this.#there(), p, points.length, x, v, a)));
  }

  /** The mass of a point for elastic collisions: at first that of the options, or 1. */
  setMass(id, mass) {
    checked(wasm.kinetri_set_mass(this.#there(), id, mass));
  }

  /** Inserts a point and returns its id. For accelerations see setMotions. */
  insert([x, y], [vx, vy] = [0, 0], radius = 0, [ax, ay] = [0, 0]) {
    return this.#reported(wasm.kinetri_insert(this.#there(), x, y, vx, vy, radius, ax, ay));
  }

  /** Erases a point. Its id is not used again. */
  erase(id) {
    this.#reported(wasm.kinetri_erase(this.#there(), id));
  }

  #ids() {
    const positions = this.positions(), ids = [];
    for (let id = 0; 2 * id < positions.length; ++id) if (!Number.isNaN(positions[2 * id])) ids.push(id);
    return ids;
  }

  // ---- what is written down ----

  /** From now on the motion log (docs/PROGRAM.md, "Motions") is written, from the present motions on. */
  logMotions() {
    wasm.kinetri_log_motions(this.#there());
  }

  /** What has been written since the last call. */
  takeMotions() {
    wasm.kinetri_take_motions(this.#there());
    return textOf();
  }

  /** From now on the event log is written, as `kinetri simulate --events` writes it; instead of `watch`. */
  logEvents() {
    wasm.kinetri_log_events(this.#there());
  }

  /** What has been written since the last call. */
  takeEvents() {
    wasm.kinetri_take_events(this.#there());
    return textOf();
  }

  /** Records for the viewer page, anew; there may be up to `capacity` ids. */
  record(capacity) {
    wasm.kinetri_record(this.#there(), capacity);
  }

  /** The JSON text of what has been recorded since the last call. */
  takeRecording() {
    checked(wasm.kinetri_take_recording(this.#there()));
    return textOf();
  }
}
