// SPDX-License-Identifier: GPL-3.0-or-later
//
// Color scales. Numbers are shown by viridis, whose lightness rises evenly and which the color-blind
// can read: nine of its colors, evenly spaced, as Stéfan van der Walt and Nathaniel Smith published
// them (matplotlib 1.5, 2015), and between them straight lines. Kinds are shown by the colors of
// Masataka Okabe and Kei Ito (Color universal design, 2008).
'use strict';

const VIRIDIS = ['#440154', '#472d7b', '#3b528b', '#2c728e', '#21918c', '#28ae80', '#5ec962', '#addc30',
                 '#fde725'];
const SHADES = 64;
const KIND_COLORS = ['#0072b2', '#e69f00', '#009e73', '#cc79a7', '#56b4e9', '#d55e00', '#f0e442', '#8a8f98'];

/** The color of a fraction from 0 to 1. */
function scaleColor(share) {
  const place = Math.min(Math.max(share, 0), 1) * (VIRIDIS.length - 1);
  const i = Math.min(Math.floor(place), VIRIDIS.length - 2);
  const from = parseColor(VIRIDIS[i]), to = parseColor(VIRIDIS[i + 1]);
  const parts = [0, 1, 2].map((k) => Math.round(255 * (from[k] + (to[k] - from[k]) * (place - i))));
  return `rgb(${parts.join(' ')})`;
}

const SCALE = Array.from({length: SHADES}, (_, i) => scaleColor(i / (SHADES - 1)));

/** The color of the i-th kind; after the last color they begin again. */
function kindColor(i) {
  return KIND_COLORS[i % KIND_COLORS.length];
}
