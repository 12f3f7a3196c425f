// SPDX-License-Identifier: GPL-3.0-or-later
//
// The panel of the selected point: its motion, its neighbors now, the area of its cell over time, and
// its events.
'use strict';

const AREA_TIMES = 96;       // at which the area is computed for the plot
const MOST_LINKS = 40;       // neighbors with a button each
const EVENTS_AROUND = 4;     // before and after the time shown

class PointPanel {
  constructor(viewer) {
    this.viewer = viewer;
    this.root = element('point');
    this.plot = element('area-plot');
    this.facts = element('point-facts');
    this.shown = -1;        // the point that areas and events are of
    this.shownEvent = -1;   // of the playback when neighbors and events were written
    this.shownPartners = -1; // the number of changes of the encounters when they were written
    this.areas = null;
    this.rows = null;       // its events
    this.root.addEventListener('click', (event) => {
      const button = event.target.closest('button');
      if (button === null) return;
      const {point, row} = button.dataset;
      if (point !== undefined) viewer.selectedPoint.select(Number(point));
      if (row !== undefined) viewer.goToRow(Number(row));
    });
    const toggle = (id, run) => element(id).addEventListener('click', run);
    toggle('point-follow', () => viewer.selectedPoint.toggleFollowing());
    toggle('point-trail', () => viewer.selectedPoint.toggleTrail());
    toggle('point-only', () => viewer.toggleOnlyPoint());
  }

  update() {
    const {viewer} = this;
    const {id: point} = viewer.selectedPoint;
    this.root.hidden = point < 0;
    if (point < 0) {
      this.shown = -1;
      return;
    }
    if (this.shown !== point) this.start(point);
    for (const [id, isOn] of [['follow', viewer.selectedPoint.follows], ['trail', viewer.selectedPoint.showsTrail],
                              ['only', viewer.filter.point === point]]) {
      element(`point-${id}`).setAttribute('aria-pressed', String(isOn));
    }
    if (this.shownEvent !== viewer.playback.event) this.writeLists();
    if (viewer.encounters !== null && this.shownPartners !== viewer.encounters.changes) this.writePartners();
    this.writeMotion();
    this.drawPlot();
  }

  start(point) {
    const {recording} = this.viewer;
    this.shown = point;
    this.shownEvent = this.shownPartners = -1;
    this.areas = null;
    const rows = [];
    for (let row = 0; row < recording.rows; ++row) if (concerns(recording, row, point)) rows.push(row);
    this.rows = rows;
    element('point-title').textContent = this.viewer.longName(point);
    this.facts.replaceChildren();
    this.parts = {};
    const labels = ['Position', 'Velocity', 'Speed'];
    if (recording.degree > 1) labels.push('Acceleration');
    if (hasDiscs(recording)) labels.push('Radius');
    if (recording.coincidences > 0) labels.push('Same place');
    labels.push('Cell area', 'Neighbors');
    if (this.viewer.encounters !== null) labels.push('In range');
    labels.push('Events');
    for (const label of labels) {
      const dt = document.createElement('dt'), dd = document.createElement('dd');
      dt.textContent = label;
      this.facts.append(dt, dd);
      this.parts[label] = dd;
    }
  }

  /** What goes by the time. */
  writeMotion() {
    const {viewer, parts} = this;
    const {recording, playback, selectedPoint: {id: point}} = viewer;
    const motion = playback.current[point], {time} = playback;
    const isThere = !Number.isNaN(viewer.x[point]);
    element('point-says').textContent = !isThere ? 'This point is not there at the time shown.' :
      viewer.hidden[point] === HIDDEN ? 'Others hide this point: it has no power cell.' :
      viewer.hidden[point] === COINCIDENT ? `${viewer.pointName(playback.shown[point])} hides this point: they ` +
        'coincide for a while.' : '';
    const pair = (x, y) => `(${shortNumber(x, 7)}, ${shortNumber(y, 7)})`;
    const say = (label, text) => { parts[label].textContent = isThere ? text() : '\u2013'; };
    const velocity = (k) => motionVelocity(recording, motion, time, k) + (viewer.images?.rate(point, k) ?? 0);
    say('Position', () => pair(viewer.x[point], viewer.y[point]));
    say('Velocity', () => pair(velocity(0), velocity(1)));
    say('Speed', () => shortNumber(Math.hypot(velocity(0), velocity(1))));
    if (parts.Acceleration !== undefined) {
      say('Acceleration', () => pair(motionAcceleration(recording, motion, time, 0),
                                     motionAcceleration(recording, motion, time, 1)));
    }
    if (parts.Radius !== undefined) say('Radius', () => shortNumber(viewer.r[point], 7));
    say('Cell area', () => {
      const area = areaOfCell(playback, point, recording.box);
      const at = knownTime(playback);
      return (Number.isNaN(area) ? 'without bounds' : shortNumber(area, 6)) +
        (at < time ? ` at t \u2248 ${shortNumber(at, 7)}, the last exact instant` : '');
    });
  }

  /** What changes with events only. */
  writeLists() {
    const {viewer, parts, rows} = this;
    const {recording, playback, selectedPoint} = viewer;
    this.shownEvent = playback.event;
    const {id: point, edges} = selectedPoint, {shown} = playback;
    const coincident = playback.coincidentWith(point);
    if (parts['Same place'] !== undefined) this.writePoints(parts['Same place'], coincident);
    // The one that hides others is their only neighbor.
    const links = shown[point] === point ? coincident : [shown[point]];
    const neighbors = [...edges.map((edge) => selectedPoint.neighborAt(edge)), ...links].sort((a, b) => a - b);
    this.writePoints(parts.Neighbors, neighbors);
    let done = 0;
    while (done < rows.length && rows[done] < playback.event) ++done;
    const around = rows.slice(Math.max(done - EVENTS_AROUND, 0), done + EVENTS_AROUND);
    parts.Events.replaceChildren(`${rows.length}, ${done} so far`, ...around.map((row) => {
      const line = document.createElement('div');
      line.className = row < playback.event ? '' : 'quiet';
      line.append(linkButton(`${kindName(recording, row)} ${eventNumber(recording, row)}`, {row}),
                  ` t \u2248 ${shortNumber(recording.rowTime[row])}`);
      return line;
    }));
  }

  /** What changes as points come into range and leave it. */
  writePartners() {
    const {viewer, parts} = this;
    this.shownPartners = viewer.encounters.changes;
    this.writePoints(parts['In range'], viewer.encounters.partners(viewer.selectedPoint.id));
  }

  /** Their number, and buttons that select them. */
  writePoints(place, points) {
    place.replaceChildren(`${points.length}${points.length > 0 ? ': ' : ''}`, ...points.slice(0, MOST_LINKS)
      .flatMap((point) => [linkButton(this.viewer.pointName(point), {point}), ' ']));
  }

  /** The areas at AREA_TIMES + 1 times of the run, or the known times before them. */
  findAreas() {
    const {recording, selectedPoint: {id: point}} = this.viewer;
    const {from, until} = recording;
    const playback = new Playback(recording);
    this.areas = new Float64Array(AREA_TIMES + 1);
    this.areaTimes = new Float64Array(AREA_TIMES + 1);
    for (let i = 0; i <= AREA_TIMES; ++i) {
      playback.goTo(i === AREA_TIMES ? until : from + (until - from) * i / AREA_TIMES);
      this.areas[i] = areaOfCell(playback, point, recording.box);
      this.areaTimes[i] = knownTime(playback);
    }
  }

  drawPlot() {
    const {viewer, plot} = this;
    const {colors, playback, recording} = viewer;
    const {from, until} = recording;
    const width = plot.clientWidth, height = plot.clientHeight;
    if (width === 0) return;
    if (this.areas === null) this.findAreas();
    const context = sizedContext(plot, width, height);
    context.clearRect(0, 0, width, height);
    const finite = this.areas.filter(Number.isFinite);
    const most = finite.reduce((a, b) => Math.max(a, b), 0);
    const top = 16, bottom = height - 4;
    context.font = LABEL_FONT;
    context.fillStyle = colors.quiet;
    context.textAlign = 'left';
    context.fillText(most > 0 ? `Cell area over time, up to ${shortNumber(most, 4)}` :
                     'The cell has no bounds at any time', 2, 11);
    const span = until - from || 1;
    context.strokeStyle = colors.voronoi;
    context.lineWidth = 2;
    context.beginPath();
    this.areas.forEach((area, i) => {
      if (!(area >= 0)) return;
      const x = 1 + (width - 2) * (this.areaTimes[i] - from) / span, y = bottom - (bottom - top) * area / (most || 1);
      const isStart = i === 0 || !(this.areas[i - 1] >= 0);
      isStart ? context.moveTo(x, y) : context.lineTo(x, y);
    });
    context.stroke();
    const now = 1 + (width - 2) * (playback.time - from) / span;
    context.strokeStyle = colors.selected;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(now, top);
    context.lineTo(now, bottom);
    context.stroke();
    plot.setAttribute('aria-label', `The area of the cell over time; at ${shortNumber(playback.time)}, ` +
      `the time shown, it is ${this.parts['Cell area'].textContent}`);
  }
}

function linkButton(name, data) {
  const button = document.createElement('button');
  button.className = 'link';
  button.textContent = name;
  Object.assign(button.dataset, data);
  return button;
}
