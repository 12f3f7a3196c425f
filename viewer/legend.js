// SPDX-License-Identifier: GPL-3.0-or-later
//
// The legend of the shown colors, dashes and rings; and the scale of the points'
// colors.
'use strict';

const SCALE_STEPS = 32;

/** The lines of the legend: {mark: CSS of the sample, text}. */
function legendLines(viewer) {
  const {switches, recording, coloring, selectedPoint, selected, filter} = viewer;
  const line = (color, width, style = 'solid') => `border-top: ${width}px ${style} var(--${color})`;
  const isWeighted = recording.motionSizes !== null;
  const lines = [];
  const add = (isShown, mark, text) => { if (isShown) lines.push({mark, text}); };
  add(switches.delaunay || switches.wave, line('edge', 2),
      `edge of the ${isWeighted ? 'regular' : 'Delaunay'} triangulation`);
  if (!switches.wave) {
    add(switches.hull, line('hull', 3), 'convex hull');
    add(switches.voronoi, line('voronoi', 2), isWeighted ? 'power diagram' : 'Voronoi diagram');
    add(switches.circle, line('circle', 3),
        `${isWeighted ? 'power circle' : 'circumcircle'} of the triangle under the pointer`);
    add(switches.trails || selectedPoint.showsTrail, line('trail', 3), 'where points have been');
    add(switches.arrows, line('arrow', 2), 'velocity');
    add(switches.links, line('link', 2), `in range: ${hasDiscs(recording) ? 'a gap of' : ''} at most ${
      shortNumber(recording.encounters?.range ?? 0)}${viewer.unit === '' ? '' : ` ${viewer.unit}`}`);
    add(switches.heat, 'background: linear-gradient(to right, rgb(213 94 0 / 10%), rgb(213 94 0 / 75%)); height: 12px',
        `events here, up to ${viewer.heat?.most ?? 0}`);
    add(isWeighted, 'border: 2px solid var(--quiet); border-radius: 50%; height: 12px; width: 12px',
        'point that others hide; its disc is dashed');
    add(recording.coincidences > 0, 'background: var(--point) content-box; border: 1.5px solid var(--point); ' +
        'border-radius: 50%; height: 11px; padding: 2px; width: 11px', 'points that coincide for a while');
  }
  add(true, line('added', 4), 'edge added now; ring: its point');
  add(true, line('removed', 3, 'dashed'), 'edge removed now');
  add(selected >= 0, line('selected', 4), 'selected edge; dotted: its quadrilateral');
  add(selectedPoint.id >= 0, 'border: 3px solid var(--added); border-radius: 50%; height: 14px; width: 14px',
      'selected point, and its neighbors');
  add(recording.thinned !== null && !switches.wave && (switches.voronoi || coloring?.quantity.needsCells === true),
      'border-top: 2px dotted var(--quiet)', 'cells between two exact instants are of the triangulation of the earlier one');
  add(coloring?.quantity.id === 'component', `background: linear-gradient(to right, ${KIND_COLORS.join(', ')}); height: 12px`,
      'component of points in range; points alone have no color');
  if (coloring?.quantity.namesOf !== undefined) {
    coloring.quantity.namesOf(recording).forEach((kind, i) => add(true, `background: ${kindColor(i)}; height: 12px; width: 12px`, kind));
  }
  if (!element('events').checkVisibility() && element('histogram').checkVisibility()) {
    filter.kinds.forEach((kind) => add(true, `background: ${recording.kindColors[kind]}; height: 14px; width: 4px`,
                                       `${recording.kinds[kind].replace(/_/g, ' ')} on the timeline`));
  }
  return lines;
}

/** Such as "Cell area, in m²": with the unit of lengths if it is known. */
function quantityTitle(viewer, {quantity: {label, unit}, isLogarithmic}) {
  const {unit: length} = viewer;
  const units = {area: `${length}\u00b2`, '1 / area': `1 / ${length}\u00b2`,
                 'length / time': `${length} per unit of time`, length};
  return [label, unit === '' || length === '' ? '' : `in ${units[unit]}`,
          isLogarithmic ? 'logarithmic' : ''].filter(Boolean).join(', ');
}

class Legend {
  constructor(viewer) {
    this.viewer = viewer;
    this.root = element('legend');
    this.scale = element('legend-scale');
    this.lines = element('legend-lines');
    this.shown = '';
  }

  update() {
    const {viewer} = this;
    this.root.hidden = !viewer.showsLegend;
    if (this.root.hidden) return;
    const lines = legendLines(viewer);
    const {coloring} = viewer;
    const key = JSON.stringify([lines, coloring?.quantity.id, coloring?.least, viewer.unit]);
    if (key === this.shown) return;
    this.shown = key;
    this.lines.replaceChildren(...lines.map(({mark, text}) => {
      const item = document.createElement('li'), sample = document.createElement('span');
      sample.className = 'sample';
      const inner = document.createElement('i');
      inner.style.cssText = mark;
      sample.append(inner);
      item.append(sample, text);
      return item;
    }));
    this.scale.hidden = coloring === null || coloring.quantity.paletteOf !== undefined;
    if (this.scale.hidden) return;
    const [title, bar, least, greatest] = this.scale.children;
    title.textContent = quantityTitle(viewer, coloring);
    const steps = Array.from({length: SCALE_STEPS}, (_, i) => scaleColor(i / (SCALE_STEPS - 1)));
    bar.style.background = `linear-gradient(to right, ${steps.join(', ')})`;
    [least.textContent, greatest.textContent] = scaleEnds(coloring);
  }
}

/** The numbers at the ends of the scale. */
function scaleEnds({least, greatest, isCut}) {
  const [low, high] = [least, greatest].map((number) => shortNumber(number, 3));
  return isCut ? [`\u2264 ${low}`, `\u2265 ${high}`] : [low, high];
}

/** The scale on a picture that is saved. */
function drawLegendScale(painter, viewer, x, y) {
  const {coloring, colors} = viewer;
  if (coloring === null) return;
  const style = {color: colors.text, halo: colors.background, font: LABEL_FONT};
  const batch = new Batch(TRIANGLE);
  if (coloring.quantity.paletteOf !== undefined) {
    coloring.quantity.namesOf(viewer.recording).forEach((kind, i) => {
      batch.triangle(x, y - 14 * i - 9, x + 9, y - 14 * i - 9, x + 9, y - 14 * i, i);
      batch.triangle(x, y - 14 * i - 9, x + 9, y - 14 * i, x, y - 14 * i, i);
      painter.text(kind, x + 14, y - 14 * i, style);
    });
    painter.triangles(batch, {palette: coloring.palette});
    return;
  }
  const width = 160, step = width / SHADES;
  for (let i = 0; i < SHADES; ++i) {
    const left = x + step * i, right = left + step;
    batch.triangle(left, y - 26, right, y - 26, right, y - 16, i);
    batch.triangle(left, y - 26, right, y - 16, left, y - 16, i);
  }
  painter.triangles(batch, {palette: SCALE});
  const [low, high] = scaleEnds(coloring);
  painter.text(quantityTitle(viewer, coloring), x, y - 31, style);
  painter.text(low, x, y - 3, style);
  painter.text(high, x + width, y - 3, {...style, align: 'right'});
}
