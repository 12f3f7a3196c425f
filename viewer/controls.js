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
    {id: 'fit', keys: ['f', '0'], label: 'Show everything', run: () => viewer.fit()},
    {keys: ['n'], label: 'Select the edge that is removed next',
     run: () => viewer.selectNextRemoved()},
    {keys: ['p', ']'], label: 'Select the point in the middle, then the next one',
     run: () => viewer.selectedPoint.selectNext(1)},
    {keys: ['['], label: 'Select the previous point', run: () => viewer.selectedPoint.selectNext(-1)},
    {keys: ['j'], label: 'Follow the selected point', run: () => viewer.selectedPoint.toggleFollowing()},
    {keys: ['r'], label: 'Show the trail of the selected point', run: () => viewer.selectedPoint.toggleTrail()},
    {id: 'find', keys: ['/'], label: 'Find a point by id or name', run: () => openSearch()},
    {keys: ['k'], label: 'Color by the next quantity', run: () => viewer.colorByNext()},
    {id: 'legend', keys: ['g'], label: 'Show or hide the legend', run: () => viewer.toggleLegend()},
    {id: 'export', keys: ['s'], label: 'Export a picture, a film or a link', run: () => viewer.exporter.toggle()},
    {id: 'list', keys: ['e'], label: 'Show or hide the list of events',
     run: () => viewer.toggleList()},
    {id: 'theme', keys: ['l'], label: 'Switch between light and dark', run: () => viewer.toggleTheme()},
    {id: 'close', keys: ['Escape'], label: 'Close the panel', run: () => viewer.closePanels()},
    {id: 'help', keys: ['?'], label: 'Help: keys and pointer', run: () => viewer.toggleHelp()},
  ];
}

/** The switches that are of use for the recording; `mark` is the color of what it switches. */
function switchesOf(recording) {
  const isWeighted = recording.motionSizes !== null;
  const all = [
    {id: 'wave', key: 'w', label: 'Wave', isThere: recording.wave !== null, mark: '--accent'},
    {id: 'delaunay', key: 'd', label: isWeighted ? 'Regular' : 'Delaunay', isThere: true,
     mark: '--edge'},
    {id: 'hull', key: 'h', label: 'Hull', isThere: recording.periodic === null, mark: '--hull'},
    {id: 'voronoi', key: 'v', label: isWeighted ? 'Power' : 'Voronoi', isThere: true,
     mark: '--voronoi'},
    {id: 'circle', key: 'c', label: isWeighted ? 'Power circle' : 'Circumcircle', isThere: true,
     mark: '--circle'},
    {id: 'discs', key: 'o', label: 'Discs', isThere: hasDiscs(recording), mark: '--disc'},
    {id: 'trails', key: 't', label: 'Trails', isThere: !turnsAreLeftOut(recording),
     mark: '--trail'},
    {id: 'arrows', key: 'a', label: 'Velocities', isThere: !turnsAreLeftOut(recording), mark: '--arrow'},
    {id: 'links', key: 'y', label: 'In range', isThere: hasEncounters(recording), mark: '--link'},
    {id: 'heat', key: 'm', label: 'Heat map', isThere: recording.rows > 0 || recording.growth !== undefined, mark: '--removed'},
    {id: 'scale', key: 'u', label: 'Scale bar', isThere: true, mark: '--quiet'},
    {id: 'axes', key: 'x', label: 'Axes', isThere: true, mark: '--quiet'},
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
      if (action.id !== 'legend') button.setAttribute('aria-label', action.label);
    }
    this.addClosing('button-help-close', 'Close the help', () => viewer.toggleHelp());
    this.addClosing('button-close-point', 'Close the panel', () => viewer.closePanels());
    this.addClosing('button-export-close', 'Close', () => viewer.exporter.toggle());
    this.switches = switchesOf(viewer.recording);
    for (const one of this.switches) this.addSwitch(one);
    this.addChoices();
    this.writeKeys(actions);
    document.addEventListener('keydown', (event) => this.press(event));
  }

  addClosing(id, label, run) {
    element(id).setAttribute('aria-label', label);
    element(id).addEventListener('click', run);
  }

  /** The choice of colors, the kinds of event, and the search. */
  addChoices() {
    const {viewer} = this;
    const select = element('color');
    for (const {id, label} of [{id: 'none', label: 'none'}, ...quantitiesOf(viewer.recording)]) {
      select.append(new Option(label, id));
    }
    select.addEventListener('change', () => viewer.colorBy(select.value));
    const {kinds} = viewer.filter;
    for (const kind of kinds.length > 1 ? kinds : []) {
      const button = document.createElement('button');
      button.className = 'choice';
      button.dataset.kind = kind;
      button.textContent = `${viewer.recording.kinds[kind].replace(/_/g, ' ')} ${viewer.filter.count[kind]}`;
      button.style.setProperty('--mark', viewer.recording.kindColors[kind]);
      button.addEventListener('click', () => viewer.toggleKind(kind));
      element('kinds').append(button);
    }
    element('find').addEventListener('submit', (event) => {
      event.preventDefault();
      const text = element('find-text');
      const isFound = viewer.selectedPoint.find(text.value);
      element('status').textContent = isFound ? `${viewer.longName(viewer.selectedPoint.id)} is selected` :
        `There is no point '${text.value}'`;
      if (isFound) text.blur();
    });
    element('find-text').addEventListener('blur', () => {
      element('find').classList.remove('open');
      if (viewer.selectedPoint.id >= 0) element('status').textContent = '';
    });
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
    entries.push([['Shift', '\u2190\u2191\u2192\u2193'], 'Move the picture']);
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
    if (element('help').open && event.key !== '?' || element('export').open) return;
    const {target} = event;
    if (target.matches('input:not([type=range]), select')) {
      if (event.key === 'Escape') target.blur();
      return;
    }
    if (event.shiftKey && event.key.startsWith('Arrow')) {
      this.pan(event);
      return;
    }
    if ((event.key === ' ' || event.key === 'Enter') && target instanceof HTMLButtonElement) return;
    // There, up and down scroll.
    if (target.matches('#legend, .panel-body') && /^Arrow(Up|Down)$/.test(event.key)) return;
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

  /** Pans by a tenth of the picture. */
  pan(event) {
    const {viewer} = this;
    const [dx, dy] = {ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
    event.preventDefault();
    viewer.selectedPoint.follows = false;
    viewer.view.drag(dx * viewer.width / 10, dy * viewer.height / 10, true);
    viewer.requestFrame();
  }

  /** Updates the buttons after a change. */
  update() {
    const {viewer} = this;
    const {playback, recording, direction} = viewer;
    for (const {id, button} of this.switches) {
      button.setAttribute('aria-pressed', String(viewer.switches[id]));
      button.hidden = viewer.switches.wave && !isOfWave(id);
    }
    element('color-label').hidden = viewer.switches.wave;
    element('button-legend').setAttribute('aria-pressed', String(viewer.showsLegend));
    for (const button of element('kinds').children) {
      button.setAttribute('aria-pressed', String(!viewer.filter.hiddenKinds.has(Number(button.dataset.kind))));
    }
    this.setIcon('play', direction === 1 ? 'pause' : 'play');
    this.setIcon('back', direction === -1 ? 'pause' : 'back');
    const atStart = playback.event === 0 && playback.time === recording.from;
    element('button-previous').disabled = element('button-start').disabled = atStart;
    element('button-next').disabled = !viewer.hasNext();
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

/** Focuses the search field. */
function openSearch() {
  element('find').classList.add('open');
  element('find-text').focus();
  element('find-text').select();
}

function keyName(key) {
  return KEY_NAMES[key] ?? (key.length === 1 ? key.toUpperCase() : key);
}
