// SPDX-License-Identifier: GPL-3.0-or-later
//
// The live page: a viewer (viewer/) whose recording grows, since the run goes on at its end. The end is the
// present: there points are taken, thrown, added, erased and pinned. Going back plays the recording.
// This is a module, after kinetri.mjs, presets.js and unpack.js in the same element; the viewer's scripts are
// before it.

const BUDGET = 8;             // milliseconds of a frame for events
const TURN = 0.1;             // time between two turns of a flock
const MOST_ROWS = 300000;     // of the recording, before it begins anew
const SPARE_IDS = 4096;       // for points that are added
const MOST_LOG = 100e6;       // characters of the logs that are kept
const REFRESH = 250;          // milliseconds between two updates of list, histogram and counters
const REST = 120;             // milliseconds: a pointer that rests so long throws nothing
const HEAVY = 1e9;            // mass of a point that is held or pinned
const ABOVE_FLOOR = 0.005;    // of the height of the box: how near a point that falls is put to the floor
const MOST_FOR_NEXT = 20000;  // points for which the next event is looked for
const MOST_POINTS = 100000;   // of a preset
const MANY = 20000;           // points for whose beginning one has to wait
const CHANGES = ['radius', 'growth', 'collisions', 'gravity'];  // of a preset, that can be asked for
const RESPONSES = ['none', 'log', 'swap', 'elastic', 'stop', 'remove'];
const TOOLS = {take: 'Take and throw', add: 'Add', erase: 'Erase', pin: 'Pin', wall: 'Draw a wall'};
const MESSAGE = {take: 'Drag a point to throw it', add: 'Click to add a point', erase: 'Click a point to erase it',
                 pin: 'Click a point to pin it, or to let it go', wall: 'Drag to draw a wall of discs that are pinned'};

/** A point that is held: it goes where the pointer is. */
class Hold {
  constructor(viewer, id, event) {
    this.viewer = viewer;
    this.id = id;
    this.pointer = event.pointerId;
    this.moves = 0;
    this.velocity = viewer.velocityOf(id);  // before it was held
    this.places = [];
    this.move(event);
  }

  move(event) {
    const {viewer} = this, {camera} = viewer.flatView;
    const place = [camera.planeX(event.offsetX), camera.planeY(event.offsetY)];
    [this.x, this.y] = viewer.inBox(...place, viewer.r[this.id]);
    this.screen = {x: event.offsetX, y: event.offsetY};
    this.places.push({x: this.x, y: this.y, at: event.timeStamp});
    while (this.places.length > 2 && this.places[0].at < event.timeStamp - REST) this.places.shift();
  }

  /** The velocity of the pointer, in the time of the run. */
  thrown(event) {
    const first = this.places[0], elapsed = event.timeStamp - first.at;
    if (!(elapsed > 0) || this.places.at(-1).at < event.timeStamp - REST) return [0, 0];
    const perSecond = 1000 / elapsed / this.viewer.speed();
    return [(this.x - first.x) * perSecond, (this.y - first.y) * perSecond];
  }
}

class LiveViewer extends Viewer {
  constructor(recording, points, {options, preset, gravity, asked}) {
    super(recording);
    this.points = points;
    this.options = options;
    this.preset = preset;
    this.gravity = gravity;        // downwards, of the preset; points of a file have accelerations of their own
    this.asked = asked;            // changes of the preset
    this.clock = recording.until;  // up to which the run has gone, and at which points are changed
    this.turned = this.clock;
    this.next = undefined;         // the next event; null: there is none; undefined: not looked for
    this.hold = null;
    this.wall = null;              // that is being drawn: {pointer, x, y}, the place of its last disc
    this.openPlaces = [];          // of walls, where other discs still are
    this.tool = 'take';
    this.pinned = new Map();       // velocity and acceleration of each pinned point, before
    this.logs = {events: [], motions: [], size: 0};
    this.refreshed = 0;
    this.isSlow = false;
    if (preset === null) this.chooseSpeed();
    this.listenToPointer();
    this.makeBar();
    this.refresh();
  }

  /** The speed at which a fast point needs some eight seconds for the width of the picture. */
  chooseSpeed() {
    const [left, bottom, right, top] = this.flatView.extents.whole, fast = this.fastSpeed();
    if (fast > 0) this.speedStep = Math.round(3 * Math.log10(Math.max(right - left, top - bottom) / (8 * fast)));
  }

  /** Whether what is shown is the present. */
  isPresent() {
    return this.playback.event === this.recording.rows && this.playback.time >= this.recording.until;
  }

  hasNext() {
    return true;
  }

  // ---- time ----

  togglePlaying(direction) {
    this.direction = this.direction === direction ? 0 : direction;
    if (this.direction === -1 && this.playback.time <= this.recording.from) this.direction = 0;
    this.requestFrame();
  }

  stepForward() {
    if (!this.isPresent()) return super.stepForward();
    this.direction = 0;
    const events = this.attempt(() => this.points.step());
    if (events === 0) this.say('Nothing changes any more: there is no next event');
    this.goOn();
    return events > 0;
  }

  advance(now) {
    if (this.direction === 1 && this.isPresent()) {
      const elapsed = this.lastFrame === 0 ? 0 : Math.min((now - this.lastFrame) / 1000, LONGEST_FRAME);
      if (elapsed > 0) this.run(elapsed * this.speed());
      return;
    }
    const isForward = this.direction === 1;
    super.advance(now);
    // At the end of the recording the run goes on.
    if (!isForward || this.direction === 1) return;
    this.goToEnd();
    this.direction = 1;
  }

  /** Lets the run go on for a while. */
  run(duration) {
    const {points, hold, preset} = this;
    const arrived = this.attempt(() => {
      points.advanceTo(this.clock);
      if (hold !== null) this.pull(hold, duration);
      if (this.openPlaces.length > 0) this.fillWall(this.openPlaces);
      if (preset?.turn !== undefined && this.clock - this.turned >= TURN) {
        preset.turn(points, 0.25);
        this.turned = this.clock;
      }
      return points.advanceTo(this.clock + duration, BUDGET);
    });
    this.isSlow = arrived === false;
    if (arrived) this.clock += duration;
    this.goOn();
  }

  /** Lets a point that is held reach the pointer in two frames. */
  pull(hold, duration) {
    const positions = this.points.positions();
    const {id} = hold, reach = 2 * duration;
    if (Number.isNaN(positions[2 * id] ?? NaN)) {
      this.hold = null;
      return;
    }
    this.points.setVelocities([id], [[(hold.x - positions[2 * id]) / reach, (hold.y - positions[2 * id + 1]) / reach]]);
  }

  /** Appends what has happened to the recording, and shows the present. */
  goOn() {
    const {points, recording, playback} = this;
    this.next = undefined;
    this.grow(points.takeRecording());
    // The time of an event need not be a number: then points are changed at the next one.
    if (recording.rows > 0) this.clock = Math.max(this.clock, recording.rowHigh[recording.rows - 1]);
    if (recording.rows > MOST_ROWS) this.beginAnew();
    playback.time = recording.until;
    playback.goToEvent(recording.rows);
    this.keepLogs();
    this.requestFrame();
  }

  /** Forgets what was, in the recording. */
  beginAnew() {
    const {points, recording, playback, triangleList, hullEdges, filter, changes} = this;
    this.closePanels();
    points.record(recording.points);
    const fresh = readRecording(points.takeRecording(), true);
    Object.assign(recording, fresh);
    recording.growth.recording = recording;
    Object.assign(playback, new Playback(recording));
    Object.assign(hullEdges, new HullEdges(playback));
    Object.assign(changes, new Changes(recording));
    triangleList.event = -1;
    filter.count.fill(0);
    filter.counted = 0;
    this.heat = null;
    this.switches.heat = false;
    this.filterChanged();
    this.say('The recording begins anew here: it had become too long');
  }

  keepLogs() {
    const {points, logs} = this;
    for (const [name, text] of [['events', points.takeEvents()], ['motions', points.takeMotions()]]) {
      if (logs.size > MOST_LOG || text === '') continue;
      logs[name].push(text);
      logs.size += text.length;
    }
  }

  /** The result of a call of the library; undefined, with its message on the page, if it fails. */
  attempt(call) {
    try {
      return call();
    } catch (error) {
      if (!(error instanceof KinetriError)) throw error;
      this.direction = 0;
      this.hold = null;
      this.say(error.message);
      return undefined;
    }
  }

  say(text) {
    element('status').textContent = text;
    clearTimeout(this.silence);
    this.silence = setTimeout(() => { element('status').textContent = ''; }, 6000);
  }

  // ---- the pointer ----

  /** A place in the box, as near as possible, of a disc of the radius. */
  inBox(x, y, radius = this.radiusOfNew()) {
    const {box} = this.recording;
    if (box === null) return [x, y];
    const clearance = this.options.rim ? radius : 0;
    const within = (value, low, high, more = 0) =>
      Math.min(Math.max(value, low + clearance + more), high - clearance - more);
    // On the floor itself a point would rebound without end.
    const above = this.gravity === 0 ? 0 : ABOVE_FLOOR * (box[3] - box[1]);
    return [within(x, box[0], box[2]), within(y, box[1], box[3], above)];
  }

  /** These listeners are called before those of PointerInput, since they are for the way down. */
  listenToPointer() {
    const listen = (type, handler) => element('picture').addEventListener(type, (event) => {
      if (handler.call(this, event) === true) event.stopImmediatePropagation();
    }, {capture: true});
    listen('pointerdown', this.press);
    listen('pointermove', this.drag);
    listen('pointerup', this.release);
    listen('pointercancel', this.release);
  }

  press(event) {
    if (event.button !== 0 || !this.isPresent()) return false;
    const {view} = this, reach = REACH[event.pointerType] ?? REACH.mouse;
    // Another finger.
    if (this.wall !== null) return true;
    if (this.hold !== null) this.giveUp(this.hold);
    if (this.pointerInput.down.size > 0) return false;
    const point = view === this.flatView ? view.pointAt(event.offsetX, event.offsetY, reach + 2) : -1;
    if (this.tool === 'wall') return this.beginWall(event);
    if (point < 0) return false;
    if (this.tool !== 'take') return true;
    element('picture').setPointerCapture(event.pointerId);
    this.hold = new Hold(this, point, event);
    if (this.usesMasses()) this.attempt(() => this.points.setMass(point, HEAVY));
    return true;
  }

  /** Since there is a second finger, both move and zoom the picture, and the point goes on as before. */
  giveUp(hold) {
    this.hold = null;
    this.change(() => {
      if (this.usesMasses() && !this.pinned.has(hold.id)) this.points.setMass(hold.id, 1);
      if (this.isPlaying()) this.points.setVelocities([hold.id], [hold.velocity]);
    });
    this.pointerInput.moved = 0;
    this.pointerInput.down.set(hold.pointer, hold.screen);
  }

  drag(event) {
    // A button that was released where the page does not learn of it.
    if (event.buttons === 0 && (this.hold ?? this.wall)?.pointer === event.pointerId) return this.release(event);
    const {hold, wall} = this;
    if (wall !== null) {
      if (wall.pointer === event.pointerId) this.goOnWithWall(event);
      return true;
    }
    if (hold === null) return false;
    if (hold.pointer !== event.pointerId) return true;
    hold.moves += Math.abs(event.movementX) + Math.abs(event.movementY);
    hold.move(event);
    this.pointer = {x: event.offsetX, y: event.offsetY, reach: REACH.mouse};
    if (!this.isPlaying() && hold.moves > CLICK_MOVES) {
      this.change(() => this.points.setMotions([hold.id], [[hold.x, hold.y]], [this.velocityOf(hold.id)]));
    }
    return true;
  }

  release(event) {
    const {hold, wall} = this;
    if (wall !== null) {
      if (wall.pointer === event.pointerId) this.wall = null;
      return true;
    }
    if (hold === null) return this.click(event);
    if (hold.pointer !== event.pointerId) return true;
    this.hold = null;
    if (this.usesMasses() && !this.pinned.has(hold.id)) this.attempt(() => this.points.setMass(hold.id, 1));
    if (hold.moves <= CLICK_MOVES) this.selectedPoint.select(hold.id);
    else if (this.isPlaying()) {
      const before = this.pinned.get(hold.id);
      this.pinned.delete(hold.id);
      this.change(() => this.send(hold.id, hold.thrown(event), before?.acceleration));
    }
    return true;
  }

  /** A click with one of the other tools. */
  click(event) {
    if (!this.isPresent() || this.tool === 'take' || event.type !== 'pointerup') return false;
    if (this.view !== this.flatView || this.pointerInput.moved > CLICK_MOVES) return false;
    const {camera} = this.flatView, reach = REACH[event.pointerType] ?? REACH.mouse;
    const point = this.view.pointAt(event.offsetX, event.offsetY, reach + 2);
    this.pointerInput.cancel(event);
    if (this.tool === 'add') {
      if (point >= 0 || !this.hasRoom()) return true;
      const place = this.inBox(camera.planeX(event.offsetX), camera.planeY(event.offsetY));
      this.change(() => this.points.insert(place, [0, 0], this.radiusOfNew(), [0, -this.gravity]));
    } else if (point >= 0) {
      if (this.tool === 'erase') this.erase(point);
      else this.togglePin(point);
    }
    return true;
  }

  /** Whether there is an id for another point. */
  hasRoom() {
    if (this.recording.points > this.playback.current.findLastIndex((motion) => motion >= 0) + 1) return true;
    this.say('There are no ids left: begin anew to add more points');
    return false;
  }

  /** The radius of a new disc: that of the smallest, if they differ. */
  radiusOfNew() {
    if (this.options.radius !== undefined) return this.options.radius;
    const radii = this.points.radii().filter((radius) => radius > 0);
    return radii.length === 0 ? 0 : Math.min(...radii);
  }

  /** Begins a wall: a row of pinned discs. Without elastic collisions nothing would rebound from it. */
  beginWall(event) {
    if (this.view !== this.flatView) return false;
    if (!this.usesMasses() || !(this.radiusOfNew() > 0)) {
      this.say('A wall needs discs that collide elastically: start Gas, Packing or Two crowds');
      return true;
    }
    const {camera} = this.flatView;
    element('picture').setPointerCapture(event.pointerId);
    const [x, y] = this.inBox(camera.planeX(event.offsetX), camera.planeY(event.offsetY));
    this.wall = {pointer: event.pointerId, x, y};
    this.addToWall([[x, y]]);
    return true;
  }

  /** Adds discs, each beside the last one, up to the pointer. */
  goOnWithWall(event) {
    const {wall} = this, {camera} = this.flatView, step = 2.02 * this.radiusOfNew();
    const [toX, toY] = this.inBox(camera.planeX(event.offsetX), camera.planeY(event.offsetY));
    const places = [];
    for (;;) {
      const distance = Math.hypot(toX - wall.x, toY - wall.y);
      if (distance < step) break;
      wall.x += (toX - wall.x) * step / distance;
      wall.y += (toY - wall.y) * step / distance;
      places.push(this.inBox(wall.x, wall.y));
    }
    if (places.length > 0) this.addToWall(places);
  }

  addToWall(places) {
    this.change(() => this.fillWall([...this.openPlaces, ...places]));
    if (this.openPlaces.length > 0) this.say('Where discs are in the way, the wall closes when they have left');
  }

  /** Adds the discs of walls for which there is room now. */
  fillWall(places) {
    const {points} = this, radius = this.radiusOfNew();
    this.openPlaces = places.filter(([x, y]) => {
      const positions = points.positions();
      const isFree = points.radii().every((other, id) =>
        !(Math.hypot(positions[2 * id] - x, positions[2 * id + 1] - y) < other + radius));
      if (!isFree) return true;
      if (!this.hasRoom()) return false;
      const id = points.insert([x, y], [0, 0], radius);
      points.setMass(id, HEAVY);
      this.pinned.set(id, {velocity: [0, 0], acceleration: [0, -this.gravity]});
      return false;
    });
  }

  erase(point) {
    if (this.selectedPoint.id === point) this.closePanels();
    this.pinned.delete(point);
    this.change(() => this.points.erase(point));
  }

  togglePin(point) {
    const before = this.pinned.get(point);
    if (before === undefined) {
      this.pinned.set(point, {velocity: this.velocityOf(point), acceleration: this.accelerationOf(point)});
    } else {
      this.pinned.delete(point);
    }
    this.change(() => {
      if (this.usesMasses()) this.points.setMass(point, before === undefined ? HEAVY : 1);
      this.send(point, before?.velocity ?? [0, 0], before?.acceleration ?? [0, 0]);
    });
  }

  /** Lets a point go on with the velocity, and with the acceleration if that is another one than it has. */
  send(point, velocity, acceleration = this.accelerationOf(point)) {
    const {points} = this;
    points.setVelocities([point], [velocity]);
    const [ax, ay] = this.accelerationOf(point);
    if (acceleration[0] === ax && acceleration[1] === ay) return;
    // Its motion begins at the present place, which is a pair of numbers.
    const place = Array.from(points.positions().subarray(2 * point, 2 * point + 2));
    points.setMotions([point], [place], [velocity], [acceleration]);
  }

  usesMasses() {
    return this.options.collisions === 'elastic';
  }

  velocityOf(point) {
    return Array.from(this.points.velocities().subarray(2 * point, 2 * point + 2));
  }

  accelerationOf(point) {
    return Array.from(this.points.accelerations().subarray(2 * point, 2 * point + 2));
  }

  /** A change of the points, now. */
  change(call) {
    this.attempt(() => {
      this.points.advanceTo(this.clock);
      call();
    });
    this.goOn();
  }

  // ---- what is drawn ----

  draw() {
    super.draw();
    if (this.points === undefined) return;  // the constructor of Viewer draws
    if (!this.isPlaying() && this.isPresent()) this.findNext();
    if (performance.now() - this.refreshed > REFRESH || !this.isPlaying()) this.refresh();
  }

  /** Finds the next event, while the run is paused. */
  findNext() {
    if (this.next !== undefined || this.points.length > MOST_FOR_NEXT) return;
    this.next = this.attempt(() => this.points.nextEvent()) ?? null;
    this.requestFrame();
  }

  /** The next event: its edge and its points, and the circle through the four points when they are on one. */
  drawMore(painter, view) {
    const {next, recording, playback, colors, pinned} = this;
    for (const point of pinned?.keys() ?? []) view.drawRing(painter, point, 6, colors.hull, 3);
    if (!next || !this.isPresent()) return;
    for (const point of next.points) view.drawRing(painter, point, 7, colors.removed, 2.5);
    const {removed, added} = next;
    const place = (id) => {
      const motion = playback.current[id];
      return [motionX(recording, motion, next.time), motionY(recording, motion, next.time),
              motionWeight(recording, motion, next.time)];
    };
    const line = (edge, style) => {
      const batch = view.lineBatch.clear();
      const [p, q] = edge;
      view.addSegment(batch, view.sx[p], view.sy[p], view.sx[q], view.sy[q]);
      painter.lines(batch, style);
    };
    if (removed !== null) line(removed, {color: colors.removed, width: 3, dash: REMOVED_DASH});
    if (added !== null) line(added, {color: colors.added, width: 2, dash: REMOVED_DASH});
    if (next.kind !== 'flip') return;
    const [a, b, c] = [...removed, added[0]].map(place), center = {x: 0, y: 0};
    powerCenter(center, ...a, ...b, ...c);
    const radius = Math.sqrt((a[0] - center.x) ** 2 + (a[1] - center.y) ** 2 - a[2]) * view.camera.scale;
    if (!(radius < 1e6)) return;
    const circle = view.circleBatch.clear();
    circle.circle(view.camera.screenX(center.x), view.camera.screenY(center.y), radius);
    painter.circles(circle, {stroke: colors.circle, width: 2});
    const dots = view.circleBatch.clear();
    for (const [x, y] of [...removed, ...added].map(place)) {
      dots.circle(view.camera.screenX(x), view.camera.screenY(y), 3.5);
    }
    painter.circles(dots, {fill: colors.circle});
  }

  // ---- the bar ----

  makeBar() {
    const bar = document.createElement('div');
    bar.id = 'live';
    bar.className = 'scrolls-across';
    bar.innerHTML = `
      <form id="live-start" class="choices">
        <label>Start <select id="live-preset"></select></label>
        <label>with <input id="live-count" type="number" min="1" max="100000"> points</label>
        <label>Radius <input id="live-radius" type="number" min="0" step="any" placeholder="its own"></label>
        <label>Growth <input id="live-growth" type="number" min="0" step="any" placeholder="its own"></label>
        <label>Contacts <select id="live-collisions"></select></label>
        <label>Gravity <input id="live-gravity" type="number" step="any" placeholder="its own"></label>
        <button class="choice">Start</button>
      </form>
      <div class="choices" id="live-tools" role="group" aria-label="What the pointer does"></div>
      <div class="choices" role="group" aria-label="The run">
        <button class="choice" id="live-audit" type="button">Audit</button>
        <button class="choice" id="live-motions" type="button">Save motions</button>
        <button class="choice" id="live-events" type="button">Save events</button>
      </div>
      <p id="live-says" role="status"></p>
      <p id="live-commands" hidden></p>`;
    document.querySelector('.notes').append(bar);
    const select = element('live-preset');
    for (const [id, {label}] of Object.entries(PRESETS)) select.append(new Option(label, id));
    if (element('points') !== null) select.append(new Option('Points of the file', 'points'));
    select.value = this.preset?.id ?? 'points';
    const contacts = element('live-collisions');
    contacts.append(new Option('its own', ''), ...RESPONSES.map((response) => new Option(response)));
    const count = element('live-count');
    count.value = this.preset?.number ?? this.points.length;
    for (const name of CHANGES) element(`live-${name}`).value = this.asked[name] ?? '';
    // The points of a file have their own.
    const disable = () => {
      for (const name of CHANGES) element(`live-${name}`).disabled = select.value === 'points';
    };
    disable();
    select.addEventListener('change', () => {
      count.value = PRESETS[select.value]?.count ?? '';
      disable();
    });
    element('live-start').addEventListener('submit', (event) => {
      event.preventDefault();
      const query = new URLSearchParams({start: select.value, points: count.value});
      for (const name of CHANGES) {
        const {value, disabled} = element(`live-${name}`);
        if (value !== '' && !disabled) query.set(name, value);
      }
      window.location.search = `?${query}`;
    });
    for (const [id, label] of Object.entries(TOOLS)) {
      const button = document.createElement('button');
      button.type = 'button';
      button.className = 'choice';
      button.dataset.tool = id;
      button.textContent = label;
      button.addEventListener('click', () => {
        this.tool = id;
        this.say(MESSAGE[id]);
        this.refresh();
      });
      element('live-tools').append(button);
    }
    element('live-audit').addEventListener('click', () => this.audit());
    element('live-motions').addEventListener('click', () => this.save('motions'));
    element('live-events').addEventListener('click', () => this.save('events'));
  }

  audit() {
    const begin = performance.now();
    const failures = this.attempt(() => this.points.audit());
    if (failures === undefined) return;
    this.say(failures.length === 0 ?
      `The audit has passed, exactly, in ${Math.round(performance.now() - begin)} ms` :
      `The audit has failed: ${failures[0]}. Please report this`);
  }

  /** Saves a log of the run so far, and shows the commands that take both logs. */
  save(name) {
    const {logs} = this;
    this.direction = 0;  // so that both logs end here
    this.change(() => {});
    if (logs.size > MOST_LOG) {
      this.say('The run is too long to be saved: begin anew');
      return;
    }
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob(logs[name], {type: 'text/csv'}));
    link.download = `live.${name}.csv`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    this.say(`Saved, and paused: save the ${name === 'events' ? 'motions' : 'events'} as well for the commands`);
    element('live-commands').hidden = false;
    element('live-commands').textContent = this.commands();
  }

  /** What repeats the run, and what checks its logs. */
  commands() {
    const {box, rim, regular, collisions} = this.options;
    const options = [`--until ${this.clock}`];
    if (box) options.push(`--box ${Array.from(box).join()}`);
    if (rim) options.push('--rim');
    if (collisions && collisions !== 'none') options.push(`--collisions ${collisions}`);
    const logs = 'live.motions.csv', events = 'live.events.csv', same = options.join(' ');
    const more = regular ? ' --regular' : '';
    return [`kinetri simulate ${logs} --replay ${events} ${same}${more} --edges edges.csv --html run.html`,
            `kinetri-verify ${logs} ${events} ${same} --edges edges.csv`].join('\n');
  }

  /** Updates what need not be up to date in each frame. */
  refresh() {
    this.refreshed = performance.now();
    this.list.filterChanged();
    this.timeline.scrub.disabled = this.recording.from === this.recording.until;
    this.timeline.draw();
    const {points, recording} = this;
    element('summary').textContent = [`${points.length.toLocaleString('en')} points`,
      `${recording.rows.toLocaleString('en')} events`, recording.program].join(' \u00b7 ');
    for (const button of element('live-tools').children) {
      button.setAttribute('aria-pressed', String(button.dataset.tool === this.tool));
    }
    const {filtered, exact} = points.statistics();
    element('live-says').textContent = [
      `Certificates: ${filtered.toLocaleString('en')} by floating point, ${exact.toLocaleString('en')} exactly`,
      this.isSlow && this.isPlaying() ? 'slow motion: this machine needs more time for the events' : '',
      this.nextText(),
    ].filter(Boolean).join(' \u00b7 ');
  }

  nextText() {
    const {next} = this;
    if (this.isPlaying() || !this.isPresent()) return '';
    if (this.points.length > MOST_FOR_NEXT) {
      return `the next event is looked for among up to ${MOST_FOR_NEXT.toLocaleString('en')} points`;
    }
    if (next === undefined) return '';
    if (next === null) return 'there is no next event';
    const edges = [next.removed, next.added].filter((edge) => edge !== null).map((edge) => edge.join('\u2013'));
    const what = [next.points.join(', '), edges.join(' \u2192 ')].filter(Boolean).join(', ');
    return `next: ${next.kind.replace(/_/g, ' ')} ${what} at t = ${exactTimeText(next)}`;
  }
}

/** "0.5 exactly", or "0.7071\u2026, the root of 2t\u00b2 \u2212 1". */
function exactTimeText({time, lower, upper, polynomial}) {
  if (lower === upper) return `${time}, exactly`;
  const degree = polynomial.length - 1;
  const digits = Math.max(...polynomial.map((coefficient) => coefficient.length));
  if (degree === 1) return `${time}\u2026, a fraction`;
  return `${time}\u2026, a root of a polynomial of degree ${degree} with whole coefficients of up to ${digits} digits`;
}

// ---- the start ----

/** The number that the address gives the name; null if there is none. */
function askedNumber(query, name, least, greatest) {
  const text = query.get(name) ?? '', number = Number(text);
  if (text === '') return null;
  if (!(number >= least && number <= greatest)) {
    throw new KinetriError(`${name}=${text}; expected a number from ${least} to ${greatest}`);
  }
  return number;
}

/**
 * What the address asks for: ?start=gas&points=300, and for a preset also radius, growth, collisions and gravity.
 * Without it the points of the file, or the first preset.
 */
function asked() {
  const query = new URLSearchParams(window.location.search);
  const file = element('points');
  const id = query.get('start') ?? (file === null ? Object.keys(PRESETS)[0] : 'points');
  if (id === 'points' && file !== null) {
    const options = JSON.parse(file.dataset.options ?? '{}');
    return {text: file.textContent, options, preset: null, gravity: 0, asked: {}};
  }
  const preset = PRESETS[id];
  if (preset === undefined) {
    throw new KinetriError(`start=${id} is unknown; expected one of ${Object.keys(PRESETS).join(', ')}`);
  }
  const number = Number(query.get('points') || preset.count);
  if (!Number.isInteger(number) || number < 1 || number > MOST_POINTS) {
    throw new KinetriError(`points=${query.get('points')}; expected a whole number from 1 to ${MOST_POINTS}`);
  }
  const changes = {
    radius: askedNumber(query, 'radius', 0, SIDE), growth: askedNumber(query, 'growth', 0, SIDE),
    collisions: query.get('collisions') || null, gravity: askedNumber(query, 'gravity', -1000, 1000),
  };
  return {...pointsOf(preset, number, changes), preset: {...preset, id, number}, asked: changes};
}

/** Says what to wait for, and waits until that can be seen. */
function sayWait(text) {
  element('message').textContent = text;
  element('message').hidden = false;
  return new Promise((done) => { setTimeout(done, 50); });
}

async function start() {
  try {
    const begin = asked();
    const {number} = begin.preset ?? {};
    if (number > MANY) await sayWait(`${number.toLocaleString('en')} points: this takes a while.`);
    await load(unpacked(element('module').textContent));
    element('module').textContent = '';
    const points = KineticDelaunay.read(begin.text, begin.options);
    points.logEvents();
    points.logMotions();
    points.record(2 * points.length + SPARE_IDS);
    const recording = readRecording(points.takeRecording(), true);
    recording.title = 'Kinetri live';
    element('message').hidden = true;
    const viewer = showViewer(() => new LiveViewer(recording, points, begin));
    viewer.say(MESSAGE.take);
    window.live = viewer;
    if (!window.matchMedia('(prefers-reduced-motion: reduce)').matches) viewer.togglePlaying(1);
  } catch (error) {
    showMessage(error);
    if (!(error instanceof KinetriError)) throw error;
    element('message').firstChild.textContent = 'This cannot be shown';
    element('message').lastChild.textContent = `${error.message[0].toUpperCase()}${error.message.slice(1)}.`;
  }
}

start();
