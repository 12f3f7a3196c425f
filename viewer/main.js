// SPDX-License-Identifier: GPL-3.0-or-later
//
// The start: reads the recording, makes the viewer, and `window.kinetri`.
'use strict';

const HINT_TIME = 8000;  // milliseconds for which the hint stays

/**
 * The object for the console:
 *
 *   time, event        the time shown, and the number of rows executed
 *   span               [from, until], the times that the recording covers
 *   counts             {points, rows, instants, edges}; edges: the present number
 *   edges()            the edges, [a, b] with a < b, sorted; in a periodic box [a, b, x, y], with the offset
 *                      of b against a
 *   triangles()        the triangles, [a, b, c] counterclockwise, a the least id, sorted; in a periodic box
 *                      [a, b, c, x, y, x, y], with the offsets of b and c against a
 *   positions()        [x, y] of each point by id at the time shown, in a periodic box of its image there;
 *                      null if it is not there
 *   radii()            the radius of each point by id at the time shown; null if it is not there
 *   hidden()           the ids of the points that others hide, ascending
 *   inRange()          [a, b] of each pair within range at the time shown, sorted; in a periodic box
 *                      [a, b, x, y], as edges(); null if that is not in the recording
 *   components()       the least id in the component of each point by id; null as before
 *   goTo(time)         executes each row whose exact time is at or before `time`, and no other
 *   stepForward()      to just after the next instant; false if there is none
 *   stepBackward()     to just after the previous instant, or to the start; false at the start
 *   point              the id of the selected point, or null
 *   velocity(point)    [vx, vy] at the time shown
 *   scale()            the colors of numbers, from the least to the greatest
 *   areas()            the area of the cell of each point by id; null where it is unbounded or none
 *   colored()          {id, least, greatest, shades}: what colors stand for, and the shade of each
 *                      point by id; null without colors
 *   screen(x, y)       the position on the page of a point of the plane, in CSS pixels (flat view)
 *   pan(dx, dy)        moves the picture, in CSS pixels
 *   zoom(factor)       zooms about the middle
 *   drawNow()          draws now; returns how many milliseconds that took
 */
function consoleObject(viewer) {
  const {playback, recording} = viewer;
  return Object.freeze({
    get time() { return playback.time; },
    get event() { return playback.event; },
    get span() { return [recording.from, recording.until]; },
    get counts() {
      const {points, rows, instants} = recording;
      return {points, rows, instants, edges: playback.liveCount};
    },
    edges() {
      const edges = Array.from(playback.live.subarray(0, playback.liveCount), (edge) =>
        (recording.edgeX === null ? [recording.edgeA[edge], recording.edgeB[edge]] :
          [recording.edgeA[edge], recording.edgeB[edge], recording.edgeX[edge], recording.edgeY[edge]]));
      return edges.sort(compareLists);
    },
    triangles() {
      const {triangleList} = viewer;
      triangleList.update();
      const result = [];
      for (let i = 0; i < 3 * triangleList.triangles; i += 3) {
        const offsets = triangleList.offsets.slice(i / 3 * 4, i / 3 * 4 + 4);
        result.push([...triangleList.corners.subarray(i, i + 3), ...offsets]);
      }
      return result.sort(compareLists);
    },
    positions() {
      viewer.place();
      return Array.from(viewer.x, (x, point) => (Number.isNaN(x) ? null : [x, viewer.y[point]]));
    },
    radii() {
      viewer.place();
      return Array.from(viewer.r, (r, point) => (Number.isNaN(viewer.x[point]) ? null : r));
    },
    hidden() {
      viewer.place();
      return Array.from(viewer.hidden.keys()).filter((point) => viewer.hidden[point] !== VISIBLE);
    },
    inRange() {
      if (viewer.encounters === null) return null;
      viewer.place();
      const {live, liveCount} = viewer.encounters, {a, b, x, y} = recording.encounters;
      const pairs = Array.from(live.subarray(0, liveCount), (i) => (x === null ? [a[i], b[i]] : [a[i], b[i], x[i], y[i]]));
      return pairs.sort(compareLists);
    },
    components() {
      if (viewer.encounters === null) return null;
      viewer.place();
      viewer.encounters.connect();
      return Array.from(viewer.encounters.component);
    },
    goTo(time) {
      if (!Number.isFinite(time)) throw new TypeError('goTo: expected a finite time');
      viewer.goTo(time);
    },
    stepForward: () => viewer.stepForward(),
    stepBackward: () => viewer.stepBackward(),
    velocity(point) {
      const motion = playback.current[point];
      return [0, 1].map((k) => motionVelocity(recording, motion, playback.time, k));
    },
    scale: () => SCALE.slice(),
    get point() { return viewer.selectedPoint.id < 0 ? null : viewer.selectedPoint.id; },
    areas() {
      viewer.place();
      viewer.cells.update();
      return Array.from(viewer.cells.area, (area) => (area > 0 ? area : null));
    },
    colored() {
      if (viewer.coloring === null) return null;
      const {quantity, least, greatest, shades} = viewer.coloring;
      return {id: quantity.id, least, greatest, shades: Array.from(shades)};
    },
    screen(x, y) {
      const {left, top} = element('picture').getBoundingClientRect();
      const {camera} = viewer.flatView;
      return [left + camera.screenX(x), top + camera.screenY(y)];
    },
    pan(dx, dy) {
      viewer.view.drag(dx, dy, true);
      viewer.requestFrame();
    },
    zoom: (factor) => viewer.zoom(factor),
    drawNow() {
      const start = performance.now();
      viewer.drawNow();
      return performance.now() - start;
    },
  });
}

/** Compares two lists of equally many numbers by the first that differ. */
function compareLists(s, t) {
  const k = s.findIndex((number, i) => number !== t[i]);
  return k < 0 ? 0 : s[k] - t[k];
}

/** Shows for some seconds, or until something is pressed, a hint on what can be selected. */
function showHint() {
  const hint = element('hint');
  const hide = () => { hint.hidden = true; };
  hint.textContent = `${window.matchMedia('(pointer: coarse)').matches ? 'Tap' : 'Click'} a point or an edge for details`;
  hint.hidden = false;
  for (const type of ['pointerdown', 'keydown', 'wheel']) window.addEventListener(type, hide, {once: true, passive: true});
  setTimeout(hide, HINT_TIME);
}

/** Starts playing, unless the reader prefers less motion or the address says otherwise; and shows a hint on
 * what can be selected. */
function beginSoftly(viewer, asked) {
  if (viewer.recording.points === 0) return;
  if (asked === '') showHint();
  if (asked !== '' || window.matchMedia('(prefers-reduced-motion: reduce)').matches) return;
  if (!viewer.isPlaying()) viewer.togglePlaying(1);
}

/** Shows the error on the page. */
function showMessage(error) {
  const isOurs = error instanceof RecordingError;
  const title = document.createElement('h1'), text = document.createElement('p');
  title.textContent = isOurs ? 'This recording is damaged' : 'This page has failed';
  text.textContent = isOurs ?
    `It cannot be played: ${error.message}. Write the page again with kinetri.` :
    `This is an error in the viewer: ${error}. Please report it, and attach the page.`;
  element('message').replaceChildren(title, text);
  element('message').hidden = false;
  element('viewer').hidden = true;
}

/** Shows the page with the viewer that `make` makes, and follows its address. Returns the viewer. */
function showViewer(make) {
  element('viewer').hidden = false;
  const isEmbedded = new URLSearchParams(window.location.search).has('embed');
  document.documentElement.classList.toggle('embedded', isEmbedded);
  const viewer = make();
  showWhatScrolls();
  const follow = () => {
    const fragment = window.location.hash || `#${viewer.recording.view}`;
    const problems = followAddress(viewer, fragment);
    element('address-note').hidden = problems.length === 0;
    element('address-note').textContent = 'The address of this page asks for something that is ' +
      `not possible: ${problems.join(', and ')}.`;
  };
  follow();
  window.addEventListener('hashchange', follow);
  window.kinetri = consoleObject(viewer);
  return viewer;
}

// A page that is live (live/) has no recording, and starts by itself.
if (element('module') === null) {
  try {
    const source = element('recording');
    demand(source !== null, 'there is no recording in the page');
    const recording = readRecording(source.textContent);
    source.remove();  // it takes memory
    const viewer = showViewer(() => new Viewer(recording));
    beginSoftly(viewer, window.location.hash + recording.view);
  } catch (error) {
    showMessage(error);
    if (!(error instanceof RecordingError)) throw error;
  }
}
