// SPDX-License-Identifier: GPL-3.0-or-later
//
// The start of the live page: what its address asks for, the module, and the viewer. After all other scripts.

const MOST_POINTS = 100000;   // of a preset
const MANY = 20000;           // points for whose beginning one has to wait

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
    recording.encounters = noPairs();
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
    if (window.location.search === '') return;
    const back = document.createElement('a');
    back.href = window.location.pathname;
    back.textContent = 'Begin as usual';
    element('message').append(' ', back);
  }
}

start();
