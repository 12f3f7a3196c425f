// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of the page's address after '#': the time and the view, for links and for screenshots by a
// headless browser.
//
//   #t=2.5&show=voronoi,ids&hide=hull&edge=4-17&theme=dark&list=off
//
// t        the time
// event    a number of events: the state just after them, instead of a time
// show     switches to turn on: wave, delaunay, hull, voronoi, circle, discs, trails, arrows, links,
//          heat, scale, axes, ids
// hide     switches to turn off
// point    the id or name of a point that is selected
// follow   on or off: whether the camera follows it
// color    what points are colored by: none, area, density, speed, degree, changes, size,
//          component, members, kind
// at       the position in the middle of the flat view, and the width of the plane that it shows:
//          x,y,width
// kinds    the kinds of event that are shown
// unit     of lengths, such as m
// legend   on or off
// play     on or off
// edge     the ids of the ends of an edge whose certificate is shown; in a periodic box also with its
//          offset, as in 4-17,1,-2
// theme    light or dark
// list     on or off: the list of events
// draw     webgl or canvas: how the picture is drawn; without it, by the faster one
'use strict';

/** Applies the fragment of an address. Returns messages about parts that cannot be applied. */
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
    // In a periodic box an offset may follow, as in 3-7,1,-2.
    const [ids, ...offset] = value.split(',');
    const ends = ids.split('-').map(Number).sort((a, b) => a - b), {edgeX, edgeY} = recording;
    for (let i = 0; i < playback.liveCount; ++i) {
      const edge = playback.live[i];
      if (recording.edgeA[edge] !== ends[0] || recording.edgeB[edge] !== ends[1]) continue;
      if (edgeX !== null && offset.length === 2 &&
          (edgeX[edge] !== Number(offset[0]) || edgeY[edge] !== Number(offset[1]))) continue;
      viewer.select(edge);
      return true;
    }
    return false;
  },

  point: (viewer, value) => viewer.selectedPoint.find(value),
  follow: ({selectedPoint}, value) =>
    followSwitch(value, selectedPoint.follows, () => selectedPoint.toggleFollowing()),

  color(viewer, value) {
    const isThere = value === 'none' || quantitiesOf(viewer.recording).some(({id}) => id === value);
    if (isThere) viewer.colorBy(value);
    return isThere;
  },

  at(viewer, value) {
    const numbers = value.split(',').map((text) => (text.trim() === '' ? NaN : Number(text)));
    const isPossible = numbers.length === 3 && numbers.every(Number.isFinite) && numbers[2] > 0;
    if (isPossible) viewer.flatView.camera.look(...numbers);
    viewer.requestFrame();
    return isPossible;
  },

  kinds(viewer, value) {
    const {filter, recording} = viewer;
    const ids = value.split(',').map((kind) => recording.kinds.indexOf(kind));
    if (ids.includes(-1)) return false;
    filter.hiddenKinds = new Set(filter.kinds.filter((kind) => !ids.includes(kind)));
    viewer.filterChanged();
    return true;
  },

  unit(viewer, value) {
    viewer.unit = value;
    viewer.requestFrame();
    return true;
  },

  legend: (viewer, value) => followSwitch(value, viewer.showsLegend, () => viewer.toggleLegend()),
  play: (viewer, value) => followSwitch(value, viewer.isPlaying(), () => viewer.togglePlaying(viewer.direction || 1)),

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
  point: () => 'the id or the name of a point',
  follow: () => 'on or off',
  color: (recording) => `none or one of ${quantitiesOf(recording).map(({id}) => id).join(', ')}`,
  at: () => 'two coordinates and a width, as in 10,20,5',
  kinds: ({kinds}) => `of ${kinds.join(', ')}`,
  unit: () => 'a text',
  legend: () => 'on or off',
  play: () => 'on or off',
  edge: () => 'the ids of two points that an edge joins at that time, as in 4-17',
  theme: () => 'light or dark',
  list: () => 'on or off',
  draw: () => 'webgl, where the browser has it, or canvas',
};

/** Applies "on" or "off" to something that `toggle` changes. */
function followSwitch(value, isOn, toggle) {
  if (value !== 'on' && value !== 'off') return false;
  if (isOn !== (value === 'on')) toggle();
  return true;
}

/** The address of the page with the present view. */
function linkTo(viewer) {
  const {recording, playback, switches, filter, coloring} = viewer;
  // A live page starts at its first time whenever it is opened, and without a range.
  const words = recording.growth === undefined ? [['t', playback.time]] : [];
  const all = switchIds(recording).filter((id) => recording.growth === undefined || id !== 'links');
  words.push(['show', all.filter((id) => switches[id]).join(',')]);
  words.push(['hide', all.filter((id) => !switches[id]).join(',')]);
  if (coloring !== null) words.push(['color', coloring.quantity.id]);
  if (!filter.isEverything()) {
    words.push(['kinds', filter.kinds.filter((kind) => !filter.hiddenKinds.has(kind))
      .map((kind) => recording.kinds[kind]).join(',')]);
  }
  if (viewer.selected >= 0 && playback.where[viewer.selected] >= 0) {
    const {edgeA, edgeB, edgeX, edgeY} = recording, {selected} = viewer;
    words.push(['edge', `${edgeA[selected]}-${edgeB[selected]}` +
      (edgeX === null ? '' : `,${edgeX[selected]},${edgeY[selected]}`)]);
  }
  if (viewer.selectedPoint.id >= 0) words.push(['point', viewer.selectedPoint.id]);
  if (viewer.selectedPoint.follows) words.push(['follow', 'on']);
  const {camera} = viewer.flatView;
  if (!camera.isFitted) words.push(['at', [camera.x, camera.y, camera.width / camera.scale].join(',')]);
  if (viewer.unit !== '') words.push(['unit', viewer.unit]);
  if (viewer.showsLegend) words.push(['legend', 'on']);
  words.push(['theme', document.documentElement.classList.contains('dark') ? 'dark' : 'light']);
  const fragment = words.filter(([, value]) => value !== '')
    .map(([name, value]) => `${name}=${encodeURIComponent(value).replace(/%2C/g, ',')}`).join('&');
  return `${window.location.href.replace(/#.*$/, '')}#${fragment}`;
}

const switchIds = (recording) => switchesOf(recording).map(({id}) => id);

function setSwitches(viewer, value, isOn) {
  const known = switchIds(viewer.recording);
  const ids = value.split(',');
  for (const id of ids) {
    if (known.includes(id) && viewer.switches[id] !== isOn) viewer.toggleSwitch(id);
  }
  return ids.every((id) => known.includes(id));
}
