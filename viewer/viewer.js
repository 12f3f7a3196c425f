// SPDX-License-Identifier: GPL-3.0-or-later
//
// The viewer: the state, the animation loop, and the commands.
'use strict';

const WHOLE_RUN = 30;           // seconds, about, in which the whole run plays at the initial speed
const LONGEST_FRAME = 0.1;      // seconds; after a pause of the browser the run does not jump
const HIGHLIGHT = 0.3;          // seconds of playing around an event in which it is marked
const TRAIL = 6;                // seconds of playing that a trail covers
const COLOR_NAMES = ['background', 'edge', 'edgeBehind', 'hull', 'point', 'box', 'disc', 'discFill',
                     'trail', 'voronoi', 'circle', 'circleFill', 'removed', 'added', 'selected',
                     'selectedFill', 'waveEdge', 'waveLowEdge', 'text', 'quiet', 'hover', 'arrow', 'link'];

/** The n-th of the numbers 1, 2 and 5 times a power of ten; the zeroth is 1. */
function roundSpeed(n) {
  const step = ((n % 3) + 3) % 3;
  return [1, 2, 5][step] * 10 ** ((n - step) / 3);
}

class Viewer {
  constructor(recording) {
    this.recording = recording;
    this.playback = new Playback(recording);
    this.triangleList = new TriangleList(this.playback);
    this.hullEdges = new HullEdges(this.playback);
    this.x = new Float64Array(recording.points);
    this.y = new Float64Array(recording.points);
    this.r = new Float64Array(recording.points);
    this.w = new Float64Array(recording.points);     // weights
    this.hidden = new Uint8Array(recording.points);  // VISIBLE, or how others hide it
    this.images = recording.periodic === null ? null : new Images(recording);  // x and y are theirs
    this.colors = {};
    this.direction = 0;  // of playing: 1, -1, or 0 while paused
    this.pointer = null;
    this.hoverPoint = -1;
    this.hoverEdge = -1;
    this.encounters = hasEncounters(recording) ? new Encounters(recording) : null;
    this.cells = new Cells(this);
    this.changes = new Changes(recording);
    this.filter = new EventFilter(recording);
    this.coloring = null;     // Coloring, if points have colors
    this.heat = null;         // Heat, from its first use on
    this.unit = '';           // of lengths
    this.showsLegend = false;
    this.selectedPoint = new SelectedPoint(this);
    this.selected = -1;       // edge
    this.certificate = null;  // its certificate, or its last one if the edge is not there
    this.switches = {
      wave: recording.wave !== null, delaunay: true, hull: recording.periodic === null, voronoi: false, circle: false,
      discs: hasDiscs(recording), trails: false, arrows: false, heat: false, scale: false, axes: false,
      links: hasEncounters(recording),
      ids: recording.points <= 40,
    };
    const span = recording.until - recording.from;
    this.speedStep = span > 0 ? Math.round(3 * Math.log10(span / WHOLE_RUN)) : 0;
    this.stage = new Stage();
    this.flatView = new FlatView(this);
    this.waveView = recording.wave === null ? null : new WaveView(this);
    this.request = 0;   // of a frame; 0: there is none
    this.lastFrame = 0;
    this.frame = this.frame.bind(this);
    writeHeader(recording);
    this.timeline = new Timeline(this);
    this.list = new EventList(this);
    this.panel = new CertificatePanel(this);
    this.pointPanel = new PointPanel(this);
    this.legend = new Legend(this);
    this.exporter = new Exporter(this);
    this.pointerInput = new PointerInput(this);
    this.controls = new Controls(this);
    this.followEnvironment();
  }

  get view() {
    return this.switches.wave ? this.waveView : this.flatView;
  }

  pointName(point) {
    return this.recording.names === null ? String(point) : this.recording.names[point];
  }

  /** "ada, point 3", or "Point 3". */
  longName(point) {
    return this.recording.names === null ? `Point ${point}` : `${this.recording.names[point]}, point ${point}`;
  }

  /** A speed that few points exceed at the start of their motions. */
  fastSpeed() {
    if (this.fast === undefined) {
      const {recording} = this;
      const step = Math.max(Math.ceil(recording.motions / 5000), 1);
      const speeds = [];
      for (let i = 0; i < recording.motions; i += step) {
        const begin = recording.motionData[recording.stride * i];
        speeds.push(Math.hypot(motionVelocity(recording, i, begin, 0), motionVelocity(recording, i, begin, 1)));
      }
      speeds.sort((a, b) => a - b);
      this.fast = speeds[Math.floor(0.9 * (speeds.length - 1))] ?? 0;
    }
    return this.fast;
  }

  isPlaying() {
    return this.direction !== 0;
  }

  // ---- commands ----

  /** Plays in the direction, or pauses if it is playing in that direction. At the end it starts
   * from the other end. */
  togglePlaying(direction) {
    const {from, until} = this.recording;
    this.direction = this.direction === direction ? 0 : direction;
    if (this.direction === 1 && this.playback.time >= until) this.playback.goTo(from);
    if (this.direction === -1 && this.playback.time <= from) this.playback.goTo(until);
    if (from === until) this.direction = 0;
    this.requestFrame();
  }

  goTo(time) {
    this.playback.goTo(time);
    this.requestFrame();
  }

  goToRow(row) {
    this.direction = 0;
    this.playback.goToRow(row);
    this.requestFrame();
  }

  goToStart() {
    this.playback.goToEvent(0);
    this.playback.time = this.recording.from;
    this.requestFrame();
  }

  goToEnd() {
    this.goTo(this.recording.until);
    this.playback.goToEvent(this.recording.rows);
  }

  stepForward() {
    this.direction = 0;
    this.requestFrame();
    return this.playback.stepForward();
  }

  stepBackward() {
    this.direction = 0;
    this.requestFrame();
    return this.playback.stepBackward();
  }

  changeSpeed(steps) {
    this.speedStep = Math.min(Math.max(this.speedStep + steps, -900), 900);
    this.requestFrame();
  }

  zoom(factor) {
    this.view.zoom(factor);
    this.requestFrame();
  }

  fit() {
    this.view.fit();
    this.requestFrame();
  }

  toggleSwitch(id) {
    this.switches[id] = !this.switches[id];
    if (id === 'heat' && this.heat === null) this.heat = new Heat(this);
    this.requestFrame();
  }

  /** Colors the points by the quantity with the id; 'none' for none. */
  colorBy(id) {
    const quantity = quantitiesOf(this.recording).find((one) => one.id === id);
    this.coloring = quantity === undefined ? null : new Coloring(this, quantity);
    if (this.coloring !== null && !isSmallScreen()) this.showsLegend = true;
    element('color').value = quantity === undefined ? 'none' : id;
    this.requestFrame();
  }

  /** The next quantity, or none after the last. */
  colorByNext() {
    const ids = ['none', ...quantitiesOf(this.recording).map(({id}) => id)];
    this.colorBy(ids[(ids.indexOf(element('color').value) + 1) % ids.length]);
  }

  toggleLegend() {
    this.showsLegend = !this.showsLegend;
    this.requestFrame();
  }

  toggleKind(kind) {
    const {hiddenKinds} = this.filter;
    if (!hiddenKinds.delete(kind)) hiddenKinds.add(kind);
    this.filterChanged();
  }

  toggleOnlyPoint() {
    this.filter.point = this.filter.point === this.selectedPoint.id ? -1 : this.selectedPoint.id;
    this.filterChanged();
  }

  filterChanged() {
    this.filter.update();
    if (this.heat !== null) this.heat.count();
    this.list.filterChanged();
    this.timeline.draw();
    this.requestFrame();
  }

  closePanels() {
    this.select(-1);
    this.selectedPoint.select(-1);
  }

  /** Shows the certificate of the edge, which is there; -1 shows none. */
  select(edge) {
    if (edge >= 0) this.selectedPoint.select(-1);
    this.selected = edge;
    this.certificate = edge < 0 ? null : certificateOf(this.playback, edge);
    this.showSelected();
    this.requestFrame();
  }

  /** Moves the picture if what is selected is not in it. */
  showSelected() {
    const {recording: {edgeA, edgeB}, selected, selectedPoint: {id}} = this;
    if (selected < 0 && id < 0) return;
    this.place();
    this.view.bringIntoView(id >= 0 ? [id] : [edgeA[selected], edgeB[selected]]);
  }

  selectNextRemoved() {
    const {rows, rowRemoved} = this.recording;
    for (let row = this.playback.event; row < rows; ++row) {
      if (rowRemoved[row] >= 0 && this.playback.where[rowRemoved[row]] >= 0) {
        this.select(rowRemoved[row]);
        return;
      }
    }
  }

  toggleList() {
    element('events').hidden = !element('events').hidden;
    this.requestFrame();
  }

  toggleTheme() {
    this.setTheme(!document.documentElement.classList.contains('dark'));
  }

  toggleHelp() {
    const help = element('help');
    if (help.open) help.close();
    else help.showModal();
  }

  /** Appends a part to a recording that grows. */
  grow(text) {
    const {recording, playback, hullEdges, filter} = this, first = recording.rows;
    recording.growth.append(text);
    playback.grow();
    hullEdges.count(first);
    filter.add(first);
    if (this.selected >= 0) this.certificate = continueCertificate(this.certificate, playback, first);
  }

  /** Whether there is a next event. */
  hasNext() {
    return this.playback.event < this.recording.rows;
  }

  /** What a viewer draws over the flat view besides. */
  drawMore() {}

  // ---- durations, in the time of the run ----

  speed() {
    return roundSpeed(this.speedStep);
  }

  highlightLength() {
    return this.isPlaying() ? HIGHLIGHT * this.speed() : 0;
  }

  trailLength() {
    return TRAIL * this.speed();
  }

  // ---- the page around the picture ----

  setTheme(isDark) {
    document.documentElement.classList.toggle('dark', isDark);
    const style = getComputedStyle(document.documentElement);
    for (const name of COLOR_NAMES) {
      const property = name === 'background' ? 'picture' :
        name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
      this.colors[name] = style.getPropertyValue(`--${property}`).trim();
    }
    this.timeline.draw();
    this.requestFrame();
  }

  followEnvironment() {
    const dark = window.matchMedia('(prefers-color-scheme: dark)');
    this.setTheme(dark.matches);
    dark.addEventListener('change', () => this.setTheme(dark.matches));
    if (isSmallScreen()) this.toggleList();
    const resized = new ResizeObserver(() => this.resize());
    resized.observe(element('view'));
    resized.observe(element('histogram'));
    resized.observe(element('list'));
    this.resize();
  }

  resize() {
    const {clientWidth, clientHeight} = element('view');
    this.width = clientWidth;
    this.height = clientHeight;
    this.stage.resize(clientWidth, clientHeight);
    this.flatView.resize(clientWidth, clientHeight);
    this.waveView?.resize(clientWidth, clientHeight);
    this.showSelected();
    this.list.shownEvent = -1;
    this.timeline.draw();
    this.draw();
  }

  // ---- frames ----

  requestFrame() {
    if (this.request === 0) this.request = requestAnimationFrame(this.frame);
  }

  /** Draws without waiting for the next frame, which needs not draw the same again. */
  drawNow() {
    cancelAnimationFrame(this.request);
    this.request = 0;
    this.draw();
    if (this.isPlaying()) this.requestFrame();
  }

  frame(now) {
    this.request = 0;
    if (this.isPlaying()) this.advance(now);
    this.lastFrame = this.isPlaying() ? now : 0;
    this.draw();
    if (this.isPlaying()) this.requestFrame();
  }

  advance(now) {
    const {from, until} = this.recording;
    const elapsed = this.lastFrame === 0 ? 0 : Math.min((now - this.lastFrame) / 1000, LONGEST_FRAME);
    const time = this.playback.time + this.direction * this.speed() * elapsed;
    this.playback.goTo(time);
    if (time >= until || time <= from && this.direction < 0) this.direction = 0;
  }

  draw() {
    this.place();
    this.followSelected();
    this.selectedPoint.update();
    this.pointerInput.find();
    this.stage.draw(this.view, this.colors.background);
    this.pointerInput.updateTip();
    this.timeline.update();
    this.list.update();
    this.panel.update();
    this.pointPanel.update();
    this.showSide();
    this.legend.update();
    this.controls.update();
    writePresent(this);
  }

  /** Computes the positions and sizes of the points, which of them are hidden, and who is within range. */
  place() {
    const {playback, x, y, r, w, hidden} = this;
    placePoints(playback, playback.time, x, y);
    this.images?.wrap(playback.time, x, y);
    sizePoints(playback, playback.time, r, w);
    findHidden(playback, x, y, w, hidden);
    this.encounters?.update(playback.time);
  }

  /** Updates the certificate of the selected edge; of an edge that is not there it stays. */
  followSelected() {
    const {certificate, playback, recording} = this;
    if (this.selected < 0 || playback.where[this.selected] < 0) return;
    const {begin, end} = certificate;
    const first = begin.row < 0 ? 0 : recording.instantEnd[begin.row];
    const last = end.row < 0 ? recording.rows : recording.instantBegin[end.row];
    if (playback.event >= first && playback.event <= last) return;
    this.certificate = certificateOf(playback, this.selected);
  }

  /** Shows the column beside the picture if there is something in it. */
  showSide() {
    const hasList = !element('events').hidden && !document.documentElement.classList.contains('embedded');
    const isEmpty = !hasList && this.selected < 0 && this.selectedPoint.id < 0;
    element('side').hidden = isEmpty;
    element('viewer').classList.toggle('without-side', isEmpty);
  }
}

/** Whether panels cover the picture, as on a phone (style.css has the same). */
function isSmallScreen() {
  return window.matchMedia('(max-width: 820px), (max-height: 520px)').matches;
}
