// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of the page's address after '#': a time, and what is shown. It makes links to a moment
// possible, and screenshots by a headless browser.
//
//   #t=2.5&show=voronoi,ids&hide=hull&edge=4-17&theme=dark&list=off
//
// t        the time
// event    a number of events: the state just after them, instead of a time
// show     switches to turn on: wave, delaunay, hull, voronoi, circle, discs, trails, ids
// hide     switches to turn off
// edge     the ids of the ends of an edge whose certificate is shown
// theme    light or dark
// list     on or off: the list of events
// draw     webgl or canvas: how the picture is drawn; without it, by the faster one
'use strict';

/** Follows the fragment of an address. Returns messages about the parts that cannot be followed. */
function followAddress(viewer, fragment) {
  const problems = [];
  for (const [name, value] of new URLSearchParams(fragment.replace(/^#/, ''))) {
    const follow = ADDRESS_WORDS[name];
    if (follow === undefined) {
      problems.push(`'${name}' is unknown; expected ${Object.keys(ADDRESS_WORDS).join(', ')}`);
    } else if (!follow(viewer, value)) {
      problems.push(`${name}: '${value}' is not possible; expected ` +
        EXPECTED_VALUES[name](viewer.recording));
    }
  }
  return problems;
}

const ADDRESS_WORDS = {
  t(viewer, value) {
    const time = value.trim() === '' ? NaN : Number(value);
    if (Number.isFinite(time)) viewer.goTo(time);
    return Number.isFinite(time);
  },

  event(viewer, value) {
    const event = Number(value);
    const isThere = /^\d+$/.test(value) && event <= viewer.recording.rows;
    if (isThere) event === 0 ? viewer.goToStart() : viewer.goToRow(event - 1);
    return isThere;
  },

  show: (viewer, value) => setSwitches(viewer, value, true),
  hide: (viewer, value) => setSwitches(viewer, value, false),

  edge(viewer, value) {
    const {recording, playback} = viewer;
    const ends = value.split('-').map(Number).sort((a, b) => a - b);
    for (let i = 0; i < playback.liveCount; ++i) {
      const edge = playback.live[i];
      if (recording.edgeA[edge] !== ends[0] || recording.edgeB[edge] !== ends[1]) continue;
      viewer.select(edge);
      return true;
    }
    return false;
  },

  theme(viewer, value) {
    if (value !== 'light' && value !== 'dark') return false;
    viewer.setTheme(value === 'dark');
    return true;
  },

  list(viewer, value) {
    if (value !== 'on' && value !== 'off') return false;
    if (element('events').hidden === (value === 'on')) viewer.toggleList();
    return true;
  },

  draw(viewer, value) {
    const isDone = (value === 'webgl' || value === 'canvas') && viewer.stage.choose(value);
    viewer.requestFrame();
    return isDone;
  },
};

const EXPECTED_VALUES = {
  t: () => 'a number',
  event: ({rows}) => `a whole number from 0 to ${rows}`,
  show: (recording) => `of ${switchIds(recording).join(', ')}`,
  hide: (recording) => `of ${switchIds(recording).join(', ')}`,
  edge: () => 'the ids of two points that an edge joins at that time, as in 4-17',
  theme: () => 'light or dark',
  list: () => 'on or off',
  draw: () => 'webgl, where the browser has it, or canvas',
};

const switchIds = (recording) => switchesOf(recording).map(({id}) => id);

function setSwitches(viewer, value, isOn) {
  const known = switchIds(viewer.recording);
  const ids = value.split(',');
  for (const id of ids) {
    if (known.includes(id) && viewer.switches[id] !== isOn) viewer.toggleSwitch(id);
  }
  return ids.every((id) => known.includes(id));
}
