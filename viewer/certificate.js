// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificate of an edge: the polynomial that is positive while the edge is Delaunay, the time
// during which the edge has this certificate, and the events that begin and end it.
'use strict';

/** The corners opposite to the edge, left and right, or -1 where there is no triangle; in a periodic box then
 * their offsets. */
function cornersOf({triangles}, edge) {
  const corners = [triangles.left[edge], triangles.right[edge]];
  if (!triangles.isPeriodic) return corners;
  return [...corners, triangles.leftX[edge], triangles.leftY[edge], triangles.rightX[edge], triangles.rightY[edge]];
}

/**
 * The certificate of the edge, which is there. Members: a, b, left, right (corners, -1 for none);
 * kind 'in-circle', 'orientation' or 'none'; begin and end: {row, reason}, row -1 for the ends of
 * the recording, reason 'edge', 'corners', 'motion' or 'recording'; from and until, in binary64;
 * fails: whether the certificate's failure ends it; removal: the row that removes the edge, or -1;
 * in a periodic box offsets, those of a, b, left and right against a;
 * and, unless the kind is 'none', `polynomial` with its `origin` and `divisor`, and `coefficients`.
 */
function certificateOf(playback, edge) {
  const {recording} = playback;
  const a = recording.edgeA[edge], b = recording.edgeB[edge];
  const beside = cornersOf(playback, edge), [left, right] = beside;
  const result = {edge, a, b, left, right, event: playback.event, kind: 'none'};
  if (recording.periodic !== null) {
    result.offsets = [[0, 0], [recording.edgeX[edge], recording.edgeY[edge]], beside.slice(2, 4), beside.slice(4, 6)];
  }
  result.begin = endOfLife(playback, edge, beside, -1);
  result.end = endOfLife(playback, edge, beside, 1);
  result.from = result.begin.row < 0 ? recording.from : recording.rowTime[result.begin.row];
  result.until = result.end.row < 0 ? recording.until : recording.rowTime[result.end.row];
  result.fails = result.end.reason === 'edge' && isFailure(recording, result.end.row);
  result.removal = -1;
  for (let row = playback.event; row < recording.rows && result.removal < 0; ++row) {
    if (recording.rowRemoved[row] === edge) result.removal = row;
  }
  result.origin = result.from;
  const motion = (point, k) => (result.offsets === undefined ? playback.current[point] :
    {motion: playback.current[point], offset: result.offsets[k]});
  if (left >= 0 && right >= 0) {
    result.kind = 'in-circle';
    result.divisor = 6n ** 4n;
    result.polynomial =
      delaunayPolynomial(recording, [a, b, left, right].map(motion), result.origin);
  } else if (left >= 0 || right >= 0) {
    result.kind = 'orientation';
    result.divisor = 6n ** 2n;
    const corners = left >= 0 ? [a, b, left] : [b, a, right];
    result.polynomial = orientationPolynomial(recording, corners.map((point) => motion(point)), result.origin);
  } else {
    return result;
  }
  result.coefficients = roundedCoefficients(result.polynomial, result.divisor);
  return result;
}

/**
 * Of a certificate that held up to the end of a recording, which now has more rows, from `first` on: the same, which
 * goes on to the new end; or another object, if a row has ended it.
 */
function continueCertificate(certificate, playback, first) {
  const {recording} = playback, {edge} = certificate;
  if (certificate.end.row >= 0) return certificate;
  const cursor = playback.clone();
  cursor.goToEvent(first);
  if (cursor.where[edge] < 0) return certificate;
  const end = endOfLife(cursor, edge, cornersOf(cursor, edge), 1);
  if (end.row < 0) {
    certificate.until = recording.until;
    return certificate;
  }
  const removal = recording.rowRemoved.indexOf(edge, first);
  const fails = end.reason === 'edge' && isFailure(recording, end.row);
  return {...certificate, end, until: recording.rowTime[end.row], fails, removal: removal < recording.rows ? removal : -1};
}

/** Whether the row, which removes an edge, is the failure of its certificate. An edge may also be
 * removed because a point is inserted or erased, or because points meet; rows of a thinned recording
 * are net effects. The edges of a point that others hide from then on go with rows of their own. */
function isFailure(recording, row) {
  const {thinned, kinds, rowKind, rowA, rowRemoved, instantBegin, edgeA, edgeB} = recording;
  if (thinned !== null) return false;
  const kind = kinds[rowKind[row]];
  if (kind !== 'rebuild') return kind === 'flip' || kind === 'hull_insert';
  const edge = rowRemoved[row];
  for (let i = instantBegin[row]; i < row; ++i) {
    if (kinds[rowKind[i]] !== 'hide') continue;
    if (rowA[i] === edgeA[edge] || rowA[i] === edgeB[edge]) return true;
  }
  return false;
}

/** What ends the time during which the edge has these corners and their motions, forward (direction
 * 1) or backward (-1). */
function endOfLife(playback, edge, beside, direction) {
  const {recording} = playback;
  const cursor = playback.clone();
  const a = recording.edgeA[edge], b = recording.edgeB[edge];
  const corners = [a, b, beside[0], beside[1]].filter((point) => point >= 0);
  const limit = direction > 0 ? recording.rows : 0;
  while (cursor.event !== limit) {
    const first = direction > 0 ? cursor.event : recording.instantBegin[cursor.event - 1];
    const last = direction > 0 ? recording.instantEnd[first] : cursor.event;
    const change = firstChange(recording, corners, first, last, direction);
    cursor.goToEvent(direction > 0 ? last : first);
    if (cursor.where[edge] < 0) {
      return {row: rowOfEdge(recording, edge, first, last, direction), reason: 'edge'};
    }
    if (change.motion >= 0) return {row: change.motion, reason: 'motion'};
    const now = cornersOf(cursor, edge);
    if (now.some((number, k) => number !== beside[k])) {
      // Corners may change although no edge does: with the last row of the instant.
      return {row: change.edges < 0 ? last - 1 : change.edges, reason: 'corners'};
    }
  }
  return {row: -1, reason: 'recording'};
}

/** Of the rows of an instant, the first one that gives one of the corners a new motion, and the
 * first one that changes an edge between two corners or at an end of the edge; -1 for none. */
function firstChange(recording, corners, first, last, direction) {
  const {rowRemoved, rowAdded, rowMotion, motionPoint, edgeA, edgeB} = recording;
  const isEnd = (point) => point === corners[0] || point === corners[1];
  const touches = (edge) => edge >= 0 && (isEnd(edgeA[edge]) || isEnd(edgeB[edge]));
  // What belongs to the quadrilateral itself names the cause better than what is only beside it.
  const within = (edge) =>
    edge >= 0 && corners.includes(edgeA[edge]) && corners.includes(edgeB[edge]);
  const lost = direction > 0 ? rowRemoved : rowAdded;
  const change = {edges: -1, motion: -1};
  let named = false;
  for (let row = first; row < last; ++row) {
    for (let i = rowMotion[row]; i < rowMotion[row + 1]; ++i) {
      if (change.motion < 0 && corners.includes(motionPoint[i])) change.motion = row;
    }
    if (!named && within(lost[row])) {
      change.edges = row;
      named = true;
    } else if (change.edges < 0 && (touches(rowRemoved[row]) || touches(rowAdded[row]))) {
      change.edges = row;
    }
  }
  return change;
}

/** The row that removes the edge, or, backward, that adds it. */
function rowOfEdge(recording, edge, first, last, direction) {
  const rows = direction > 0 ? recording.rowRemoved : recording.rowAdded;
  for (let row = first; row < last; ++row) if (rows[row] === edge) return row;
  return first;
}
