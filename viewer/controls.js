// SPDX-License-Identifier: GPL-3.0-or-later
//
// Buttons, switches and keys. Each command is one entry of `actionsOf`, from which the buttons, the
// keys and the list of keys are made.
'use strict';

/** The commands: name of the button's element if there is one, keys, label, function. */
function actionsOf(viewer) {
  return [
    {id: 'play', keys: [' '], label: 'Play or pause', run: () => viewer.togglePlaying(1)},
    {id: 'back', keys: ['b'], label: 'Play backward', run: () => viewer.togglePlaying(-1)},
    {id: 'next', keys: ['ArrowRight'], label: 'Next event', run: () => viewer.stepForward()},
    {id: 'previous', keys: ['ArrowLeft'], label: 'Previous event',
     run: () => viewer.stepBackward()},
    {id: 'start', keys: ['Home'], label: 'Go to the start', run: () => viewer.goToStart()},
    {id: 'end', keys: ['End'], label: 'Go to the end', run: () => viewer.goToEnd()},
    {id: 'faster', keys: ['ArrowUp'], label: 'Faster', run: () => viewer.changeSpeed(1)},
    {id: 'slower', keys: ['ArrowDown'], label: 'Slower', run: () => viewer.changeSpeed(-1)},
    {id: 'zoom-in', keys: ['+', '='], label: 'Zoom in', run: () => viewer.zoom(1.3)},
    {id: 'zoom-out', keys: ['-'], label: 'Zoom out', run: () => viewer.zoom(1 / 1.3)},
    {id: 'fit', keys: ['f', '0'], label: 'Fit the whole picture', run: () => viewer.fit()},
    {keys: ['n'], label: 'Certificate of the edge that is removed next',
     run: () => viewer.selectNextRemoved()},
    {id: 'list', keys: ['e'], label: 'Show or hide the list of events',
     run: () => viewer.toggleList()},
    {id: 'theme', keys: ['l'], label: 'Light or dark colours', run: () => viewer.toggleTheme()},
    {id: 'close', keys: ['Escape'], label: 'Close the certificate', run: () => viewer.select(-1)},
    {id: 'help', keys: ['?'], label: 'Show this list of keys', run: () => viewer.toggleHelp()},
  ];
}

/** The switches that are of use for the recording; `mark` is the colour of what it switches. */
function switchesOf(recording) {
  const isWeighted = recording.motionSizes !== null;
  const all = [
    {id: 'wave', key: 'w', label: 'Wave', isThere: recording.wave !== null, mark: '--accent'},
    {id: 'delaunay', key: 'd', label: isWeighted ? 'Regular' : 'Delaunay', isThere: true,
     mark: '--edge'},
    {id: 'hull', key: 'h', label: 'Hull', isThere: true, mark: '--hull'},
    {id: 'voronoi', key: 'v', label: isWeighted ? 'Power' : 'Voronoi', isThere: true,
     mark: '--voronoi'},
    {id: 'circle', key: 'c', label: isWeighted ? 'Power circle' : 'Circumcircle', isThere: true,
     mark: '--circle'},
    {id: 'discs', key: 'o', label: 'Discs', isThere: hasDiscs(recording), mark: '--disc'},
    {id: 'trails', key: 't', label: 'Trails', isThere: !turnsAreLeftOut(recording),
     mark: '--trail'},
    {id: 'ids', key: 'i', label: recording.names === null ? 'Ids' : 'Names', isThere: true,
     mark: '--quiet'},
  ];
  return all.filter((one) => one.isThere);
}

/** Whether the switch has an effect in the wave view. */
function isOfWave(id) {
  return ['wave', 'delaunay', 'ids'].includes(id);
}

const KEY_NAMES = {' ': 'Space', ArrowRight: '\u2192', ArrowLeft: '\u2190', ArrowUp: '\u2191',
                   ArrowDown: '\u2193', Escape: 'Esc', '-': '\u2212'};

class Controls {
  constructor(viewer) {
    this.viewer = viewer;
    this.keys = new Map();
    const actions = actionsOf(viewer);
    for (const action of actions) {
      for (const key of action.keys) this.keys.set(key, action.run);
      if (action.id === undefined) continue;
      const button = element(`button-${action.id}`);
      button.addEventListener('click', action.run);
      button.title = `${action.label} (${keyName(action.keys[0])})`;
      button.setAttribute('aria-label', action.label);
    }
    element('button-help-close').setAttribute('aria-label', 'Close the list of keys');
    element('button-help-close').addEventListener('click', () => viewer.toggleHelp());
    this.switches = switchesOf(viewer.recording);
    for (const one of this.switches) this.addSwitch(one);
    this.writeKeys(actions);
    document.addEventListener('keydown', (event) => this.press(event));
  }

  addSwitch(one) {
    const button = document.createElement('button');
    one.button = button;
    button.id = `switch-${one.id}`;
    button.textContent = one.label;
    button.title = `${one.label} (${keyName(one.key)})`;
    button.style.setProperty('--mark', `var(${one.mark})`);
    const run = () => {
      if (!button.hidden) this.viewer.toggleSwitch(one.id);
    };
    button.addEventListener('click', run);
    this.keys.set(one.key, run);
    element('switches').append(button);
  }

  writeKeys(actions) {
    const list = element('keys');
    const entries = actions.map(({keys, label}) => [keys.map(keyName), label]);
    for (const {key, label} of this.switches) entries.push([[keyName(key)], `Switch: ${label}`]);
    for (const [keys, label] of entries) {
      const dt = document.createElement('dt'), dd = document.createElement('dd');
      for (const key of keys) {
        const kbd = document.createElement('kbd');
        kbd.textContent = key;
        dt.append(kbd);
      }
      dd.textContent = label;
      list.append(dt, dd);
    }
  }

  press(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (element('help').open && event.key !== '?') return;
    const {target} = event;
    if ((event.key === ' ' || event.key === 'Enter') && target instanceof HTMLButtonElement) return;
    let key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    // In the list, up and down go from event to event.
    if (target === element('list')) {
      key = {ArrowDown: 'ArrowRight', ArrowUp: 'ArrowLeft'}[key] ?? key;
    }
    const run = this.keys.get(key);
    if (run === undefined) return;
    event.preventDefault();
    run();
  }

  /** Updates the buttons after a change. */
  update() {
    const {viewer} = this;
    const {playback, recording, direction} = viewer;
    for (const {id, button} of this.switches) {
      button.setAttribute('aria-pressed', String(viewer.switches[id]));
      button.hidden = viewer.switches.wave && !isOfWave(id);
    }
    this.setIcon('play', direction === 1 ? 'pause' : 'play');
    this.setIcon('back', direction === -1 ? 'pause' : 'back');
    const atStart = playback.event === 0 && playback.time === recording.from;
    element('button-previous').disabled = element('button-start').disabled = atStart;
    element('button-next').disabled = playback.event === recording.rows;
    element('button-end').disabled =
      playback.event === recording.rows && playback.time === recording.until;
    element('button-list').setAttribute('aria-pressed', String(!element('events').hidden));
  }

  setIcon(id, icon) {
    const use = element(`button-${id}`).querySelector('use');
    const href = `#icon-${icon}`;
    if (use.getAttribute('href') !== href) use.setAttribute('href', href);
  }
}

function keyName(key) {
  return KEY_NAMES[key] ?? (key.length === 1 ? key.toUpperCase() : key);
}
