// SPDX-License-Identifier: GPL-3.0-or-later
//
// The live page: a viewer (viewer/) whose recording grows, since the run goes on at its end. The end is the
// present: there points are taken, thrown, added, erased and pinned. Going back plays the recording.
// This is a module, with the other scripts of live/ in the same element; the viewer's scripts are before it.

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
const PAST = 'This is the past: go to the end (End) to change points';

/** A point that is held: it goes where the pointer is. */
class Hold {
  constructor(viewer, id, event) {
    this.viewer = viewer;
    this.id = id;
    this.pointer = event.pointerId;
    this.moves = 0;
    this.velocity = viewer.velocityOf(id);  // before it was held
    this.mass = viewer.massOf(id);
    this.places = [];
    this.move(event);
  }

  move(event) {
    const {viewer} = this, {camera} = viewer.flatView;
    const place = [camera.planeX(event.offsetX), camera.planeY(event.offsetY)];
    [this.x, this.y] = viewer.inBox(...place, viewer.r[this.id]);
    this.screen = {x: event.offsetX, y: event.offsetY};
    // Of the pointer itself, which may leave the box.
    this.places.push({x: place[0], y: place[1], at: event.timeStamp});
    while (this.places.length > 2 && this.places[0].at < event.timeStamp - REST) this.places.shift();
  }

  /** The velocity of the pointer, in the time of the run. */
  thrown(event) {
    const first = this.places[0], last = this.places.at(-1), elapsed = event.timeStamp - first.at;
    if (!(elapsed > 0) || last.at < event.timeStamp - REST) return [0, 0];
    const perSecond = 1000 / elapsed / this.viewer.speed();
    return [(last.x - first.x) * perSecond, (last.y - first.y) * perSecond];
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
    this.encounters = new PairsInRange(this);
    this.switches.links = false;   // until there is a range
    this.showsNearest = false;
    this.bar = new LiveBar(this);
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
      this.letGo();
      return;
    }
    this.points.setVelocities([id], [[(hold.x - positions[2 * id]) / reach, (hold.y - positions[2 * id + 1]) / reach]]);
  }

  /** The panel of a point gets its new events. */
  grow(text) {
    const {recording, pointPanel} = this;
    let row = recording.rows;
    super.grow(text);
    if (pointPanel.rows === null) return;
    for (; row < recording.rows; ++row) if (concerns(recording, row, pointPanel.shown)) pointPanel.rows.push(row);
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
    const {encounters} = recording;
    Object.assign(recording, readRecording(points.takeRecording(), true), {encounters});
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
      this.letGo();
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
    if (event.button !== 0) return false;
    if (!this.isPresent()) {
      if (this.tool !== 'take' || this.pointUnder(event) >= 0) this.say(PAST);
      return false;
    }
    // Another finger.
    if (this.wall !== null) return true;
    if (this.hold !== null) this.giveUp(this.hold);
    if (this.pointerInput.down.size > 0) return false;
    const point = this.pointUnder(event);
    if (this.tool === 'wall') return this.beginWall(event);
    if (point < 0) return false;
    if (this.tool !== 'take') return true;
    element('picture').setPointerCapture(event.pointerId);
    this.hold = new Hold(this, point, event);
    this.attempt(() => this.setMass(point, HEAVY));
    return true;
  }

  /** The point where the pointer is, -1 if there is none. */
  pointUnder(event) {
    const {view} = this, reach = REACH[event.pointerType] ?? REACH.mouse;
    return view === this.flatView ? view.pointAt(event.offsetX, event.offsetY, reach + 2) : -1;
  }

  /** The point that is held, if it is still there, has its mass again; or another one. */
  letGo(mass = this.hold?.mass) {
    const {hold} = this;
    this.hold = null;
    if (hold !== null && !Number.isNaN(this.massOf(hold.id))) this.attempt(() => this.setMass(hold.id, mass));
  }

  /** Since there is a second finger, both move and zoom the picture, and the point goes on as before. */
  giveUp(hold) {
    this.letGo();
    this.change(() => {
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
    if (Number.isNaN(this.massOf(hold.id))) {  // a contact has erased it
      this.letGo();
      return true;
    }
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
    const isThrown = hold.moves > CLICK_MOVES && this.isPlaying();
    const before = isThrown ? this.pinned.get(hold.id) : undefined;
    this.letGo(before?.mass);
    if (hold.moves <= CLICK_MOVES) this.selectedPoint.select(hold.id);
    if (!isThrown) return true;
    this.pinned.delete(hold.id);
    this.change(() => this.send(hold.id, hold.thrown(event), before?.acceleration));
    return true;
  }

  /** A click with one of the other tools. */
  click(event) {
    if (!this.isPresent() || this.tool === 'take' || event.type !== 'pointerup') return false;
    if (this.view !== this.flatView || this.pointerInput.moved > CLICK_MOVES) return false;
    const {camera} = this.flatView, point = this.pointUnder(event);
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
    this.say('No more points can be added to this run: press Start');
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
      this.say('A wall needs discs that collide elastically: start Gas, for instance');
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
      this.pinned.set(id, {velocity: [0, 0], acceleration: [0, -this.gravity], mass: this.massOf(id)});
      this.setMass(id, HEAVY);
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
      this.pinned.set(point, {velocity: this.velocityOf(point), acceleration: this.accelerationOf(point),
                              mass: this.massOf(point)});
    } else {
      this.pinned.delete(point);
    }
    this.change(() => {
      this.setMass(point, before?.mass ?? HEAVY);
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

  /** Where masses count. */
  setMass(point, mass) {
    if (this.usesMasses()) this.points.setMass(point, mass);
  }

  massOf(point) {
    return this.points.masses()[point] ?? NaN;
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

  /** At the present that of the next event. */
  selectNextRemoved() {
    const {next, playback, recording: {edgeA, edgeB}} = this;
    if (!this.isPresent()) {
      super.selectNextRemoved();
    } else if (!next?.removed) {
      this.say(this.isPlaying() ? 'Pause first: then the next event is known' : 'The next event removes no edge');
    } else {
      const [a, b] = [...next.removed].sort((p, q) => p - q);
      const edge = playback.live.subarray(0, playback.liveCount).find((one) => edgeA[one] === a && edgeB[one] === b);
      if (edge !== undefined) this.select(edge);
    }
  }

  nearest() {
    return nearestNeighbors(this);
  }

  drawNearest(painter, view) {
    const batch = view.lineBatch.clear();
    this.nearest().forEach((other, point) => {
      if (other >= 0) view.addSegment(batch, view.sx[point], view.sy[point], view.sx[other], view.sy[other]);
    });
    painter.lines(batch, {color: this.colors.arrow, width: 2.5, cap: 'round'});
  }

  /** The next event: its edge and its points, and the circle through the four points when they are on one. */
  drawMore(painter, view) {
    const {next, recording, playback, colors, pinned} = this;
    if (this.showsNearest) this.drawNearest(painter, view);
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

  // ---- what the bar asks for ----

  toggleSwitch(id) {
    super.toggleSwitch(id);
    if (id === 'links' && this.switches.links && !(this.encounters.range > 0)) {
      this.say('Who is in range? Write a range in the field Range');
    }
  }

  /** Shows who is within the range; 0: nobody. */
  measureRange(range) {
    this.encounters.range = range;
    this.switches.links = range > 0;
    this.place();
    this.refresh();
    this.requestFrame();
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
    const {points, recording, pointPanel} = this;
    if (this.switches.heat) this.heat.count();
    if (!this.isPlaying() && this.areasUntil !== recording.until) pointPanel.areas = null;
    this.areasUntil = recording.until;
    element('summary').textContent = [counted(points.length, 'point'), counted(recording.rows, 'event'),
      recording.program].join(' \u00b7 ');
    this.bar.refresh();
  }
}
