// SPDX-License-Identifier: GPL-3.0-or-later
//
// The elements of the page: canvases, and the texts that describe what is shown.
'use strict';

function element(id) {
  return document.getElementById(id);
}

/** The canvas's context, in CSS pixels, at the display's resolution or with `ratio` pixels per CSS pixel. */
function sizedContext(canvas, width, height, ratio = window.devicePixelRatio || 1) {
  const columns = Math.max(Math.round(width * ratio), 1);
  const rows = Math.max(Math.round(height * ratio), 1);
  if (canvas.width !== columns || canvas.height !== rows) {
    canvas.width = columns;
    canvas.height = rows;
  }
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return context;
}

/** "1 point", "1,024 points". */
function counted(number, noun) {
  return `${number.toLocaleString('en')} ${noun}${number === 1 ? '' : 's'}`;
}

/** Writes the texts that stay the same while the run plays. */
function writeHeader(recording) {
  const {title, program, points, thinned, instants, rows} = recording;
  element('title').textContent = title || 'Kinetri';
  const events = thinned === null ? counted(rows, 'event') :
    `${counted(instants, 'instant')} of ${counted(thinned.events, 'event')}`;
  element('summary').textContent = [counted(points, 'point'), events,
    `t from ${shortNumber(recording.from)} to ${shortNumber(recording.until)}`, program]
    .filter(Boolean).join(' \u00b7 ');
  const notes = [];
  if (thinned !== null) {
    notes.push(`The run had ${counted(thinned.events, 'event')}; ` +
      `this page has ${counted(instants, 'instant')} of it, each with its exact triangulation. ` +
      'Between two of them it shows the edges and cells of the earlier one' +
      (turnsAreLeftOut(recording) ? ', and points that turn move in a straight line.' : '.'));
  }
  if (recording.encounters !== null && !hasEncounters(recording)) {
    notes.push(`The run had ${counted(recording.encounters.inAll, 'encounter')}, too many for this page.`);
  }
  element('note').hidden = notes.length === 0;
  element('note').textContent = notes.join(' ');
}

/** Writes the time, the number of events and the speed. */
function writePresent(viewer) {
  const {recording, playback} = viewer;
  const span = recording.until - recording.from || 1;
  const decimals = Math.min(Math.max(4 - Math.floor(Math.log10(span)), 0), 12);
  const isLarge = Math.abs(playback.time) >= 1e9;
  element('time').textContent =
    `t = ${isLarge ? shortNumber(playback.time, 10) : playback.time.toFixed(decimals)}`;
  element('present').textContent = `event ${playback.event} of ${recording.rows}`;
  element('speed').textContent = `${shortNumber(viewer.speed())} / s`;
  element('picture').setAttribute('aria-label', `The triangulation at time ` +
    `${shortNumber(playback.time)}, after event ${playback.event} of ${recording.rows}`);
}
