// SPDX-License-Identifier: GPL-3.0-or-later
//
// What can scroll shows it: it fades out at the sides beyond which there is more (style.css).
'use strict';

const FADE = 32;  // pixels

/** Lets the elements of the classes `scrolls-across` and `scrolls-down` fade out where they go on. */
function showWhatScrolls() {
  const resized = new ResizeObserver((entries) => entries.forEach(({target}) => update(target)));
  const update = (place) => {
    const isAcross = place.classList.contains('scrolls-across');
    const before = isAcross ? place.scrollLeft : place.scrollTop;
    const more = isAcross ? place.scrollWidth - place.clientWidth : place.scrollHeight - place.clientHeight;
    place.style.setProperty('--before', `${Math.min(Math.max(before, 0), FADE)}px`);
    // A part of a pixel is no more to see.
    place.style.setProperty('--after', `${more - before > 1 ? Math.min(more - before, FADE) : 0}px`);
  };
  for (const place of document.querySelectorAll('.scrolls-across, .scrolls-down')) {
    place.addEventListener('scroll', () => update(place), {passive: true});
    new MutationObserver(() => update(place)).observe(place, {
      attributeFilter: ['hidden'], characterData: true, childList: true, subtree: true,
    });
    resized.observe(place);
  }
}
