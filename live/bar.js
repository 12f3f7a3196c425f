// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bar of the live page, above the picture: what the page begins with, what the pointer does, what is measured, and
// what is saved. It says what the run needs and what comes next.

const RESPONSES = ['none', 'log', 'swap', 'elastic', 'stop', 'remove'];
const TOOLS = {take: 'Take and throw', add: 'Add', erase: 'Erase', pin: 'Pin', wall: 'Draw a wall'};
const MESSAGE = {take: 'Drag a point to throw it', add: 'Click to add a point', erase: 'Click a point to erase it',
                 pin: 'Click a point to pin it, or to let it go', wall: 'Drag to draw a wall of discs that are pinned'};
const CHANGES = ['radius', 'growth', 'collisions', 'gravity'];  // of a preset, that can be asked for

const BAR = `
  <form id="live-start" class="choices">
    <label>Start <select id="live-preset"></select></label>
    <label>with <input id="live-count" type="number" min="1" max="100000"> points</label>
    <label>Radius <input id="live-radius" type="number" min="0" max="49" step="any" placeholder="as preset"></label>
    <label>Growth <input id="live-growth" type="number" min="0" max="100" step="any" title="By how much each radius grows in a unit of time" placeholder="as preset"></label>
    <label title="What discs do that touch; log: they are noted, and pass through each other">Contacts <select id="live-collisions"></select></label>
    <label>Gravity <input id="live-gravity" type="number" min="-1000" max="1000" step="any" placeholder="as preset"></label>
    <button class="choice">Start</button>
  </form>
  <div class="choices" id="live-tools" role="group" aria-label="What the pointer does"></div>
  <div class="choices" role="group" aria-label="What is measured">
    <label>Range <input id="live-range" type="number" min="0" step="any" placeholder="none"></label>
    <button class="choice" id="live-nearest" type="button" title="A line from each point to its nearest neighbor">Nearest neighbors</button>
  </div>
  <div class="choices" role="group" aria-label="The run">
    <button class="choice" id="live-audit" type="button">Audit</button>
    <button class="choice" id="live-motions" type="button">Save motions</button>
    <button class="choice" id="live-events" type="button">Save events</button>
  </div>
  <p id="live-says" role="status"></p>
  <p id="live-commands" hidden></p>`;

const HELP = `
  <p class="quiet">This run goes on. Take a point and throw it, or hold it; the other tools add, erase and pin points, and draw
  walls. While the run is paused, the next event is marked. Go back in time to see what has happened; points are changed at the
  present (End). Range shows who is near whom. Save motions and events to repeat the run with the program.</p>`;

class LiveBar {
  constructor(viewer) {
    this.viewer = viewer;
    this.saved = new Set();  // which logs, of the run up to the time `savedAt`
    this.savedAt = NaN;
    const bar = document.createElement('div');
    bar.id = 'live';
    bar.className = 'scrolls-across';
    bar.innerHTML = BAR;
    document.querySelector('.notes').append(bar);
    document.querySelector('#help p').insertAdjacentHTML('beforebegin', HELP);
    this.makeForm();
    for (const [id, label] of Object.entries(TOOLS)) this.addTool(id, label);
    const range = element('live-range');
    range.addEventListener('change', () => {
      const asked = Number(range.value);
      if (asked >= 0) viewer.measureRange(asked);
    });
    const nearest = element('live-nearest');
    // Else it need not be among the neighbors.
    nearest.hidden = viewer.recording.motionSizes !== null;
    nearest.addEventListener('click', () => {
      viewer.showsNearest = !viewer.showsNearest;
      this.refresh();
      viewer.requestFrame();
    });
    element('live-audit').addEventListener('click', () => this.audit());
    element('live-motions').addEventListener('click', () => this.save('motions'));
    element('live-events').addEventListener('click', () => this.save('events'));
  }

  /** What the page begins with: it is opened again with that in its address. */
  makeForm() {
    const {preset, points, asked} = this.viewer;
    const select = element('live-preset');
    for (const [id, {label}] of Object.entries(PRESETS)) select.append(new Option(label, id));
    if (element('points') !== null) select.append(new Option('Points of the file', 'points'));
    select.value = preset?.id ?? 'points';
    const contacts = element('live-collisions');
    contacts.append(new Option('as preset', ''), ...RESPONSES.map((response) => new Option(response)));
    const count = element('live-count');
    count.value = preset?.number ?? points.length;
    for (const name of CHANGES) element(`live-${name}`).value = asked[name] ?? '';
    // The points of a file have their own.
    const disable = () => {
      for (const name of CHANGES) element(`live-${name}`).disabled = select.value === 'points';
    };
    disable();
    select.addEventListener('change', () => {
      count.value = PRESETS[select.value]?.count ?? '';
      disable();
    });
    element('live-start').addEventListener('submit', (event) => {
      event.preventDefault();
      const query = new URLSearchParams({start: select.value, points: count.value});
      for (const name of CHANGES) {
        const {value, disabled} = element(`live-${name}`);
        if (value !== '' && !disabled) query.set(name, value);
      }
      window.location.search = `?${query}`;
    });
  }

  addTool(id, label) {
    const {viewer} = this, button = document.createElement('button');
    button.type = 'button';
    button.className = 'choice';
    button.dataset.tool = id;
    button.textContent = label;
    button.addEventListener('click', () => {
      viewer.tool = id;
      viewer.say(MESSAGE[id]);
      this.refresh();
    });
    element('live-tools').append(button);
  }

  audit() {
    const {viewer} = this, begin = performance.now();
    const failures = viewer.attempt(() => viewer.points.audit());
    if (failures === undefined) return;
    const what = viewer.isPresent() ? 'The audit' : 'The audit of the present';
    viewer.say(failures.length === 0 ?
      `${what} has passed, exactly, in ${Math.round(performance.now() - begin)} ms` :
      `${what} has failed: ${failures[0]}. Please report this`);
  }

  /** Saves a log of the run so far, and shows the commands that take both logs. */
  save(name) {
    const {viewer} = this, {logs} = viewer;
    viewer.direction = 0;  // so that both logs end here
    viewer.change(() => {});
    if (logs.size > MOST_LOG) {
      viewer.say('The run is too long to be saved: begin anew');
      return;
    }
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob(logs[name], {type: 'text/csv'}));
    link.download = `live.${name}.csv`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    if (this.savedAt !== viewer.clock) this.saved.clear();
    this.savedAt = viewer.clock;
    this.saved.add(name);
    const other = ['motions', 'events'].find((one) => !this.saved.has(one));
    viewer.say(other === undefined ? 'Both are saved, and the run is paused: the commands repeat and check it' :
      `Saved, and paused: save the ${other} as well for the commands`);
    element('live-commands').textContent = viewer.commands();
    this.refresh();
  }

  refresh() {
    const {viewer} = this, {points, tool, isSlow} = viewer;
    for (const button of element('live-tools').children) {
      button.setAttribute('aria-pressed', String(button.dataset.tool === tool));
    }
    element('live-commands').hidden = this.savedAt !== viewer.clock;
    element('live-nearest').setAttribute('aria-pressed', String(viewer.showsNearest));
    const {filtered, exact} = points.statistics();
    element('live-says').textContent = [
      isSlow && viewer.isPlaying() ? 'Slow motion: this machine needs more time for the events' : '',
      this.nextText(),
      viewer.encounters.text(),
      `Certificates: ${filtered.toLocaleString('en')} decided by floating point with error bounds, ${exact.toLocaleString('en')} by exact arithmetic`,
    ].filter(Boolean).join(' \u00b7 ');
  }

  nextText() {
    const {viewer} = this, {next} = viewer;
    if (viewer.isPlaying() || !viewer.isPresent()) return '';
    if (viewer.points.length > MOST_FOR_NEXT) {
      return `the next event is shown for up to ${MOST_FOR_NEXT.toLocaleString('en')} points`;
    }
    if (next === undefined) return '';
    if (next === null) return 'there is no next event';
    const edges = [next.removed, next.added].filter((edge) => edge !== null).map((edge) => edge.join('\u2013'));
    const what = [next.points.join(', '), edges.join(' \u2192 ')].filter(Boolean).join(', ');
    return `next: ${next.kind.replace(/_/g, ' ')} ${what} at t = ${exactTimeText(next)}`;
  }
}

/** "0.5, exactly", or "0.7071\u2026, a root of" and what its polynomial is. */
function exactTimeText({time, lower, upper, polynomial}) {
  if (lower === upper) return `${time}, exactly`;
  const degree = polynomial.length - 1;
  const digits = Math.max(...polynomial.map((coefficient) => coefficient.length));
  if (degree === 1) return `${time}\u2026, a fraction`;
  return `${time}\u2026, a root of a polynomial of degree ${degree} with integer coefficients of up to ${digits} digits`;
}
